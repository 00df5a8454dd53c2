"""Split Hopkinson bar around the axis (Kolsky 1949, Proc. Phys. Soc. B 62, 676): pulses of a striker, and the law of a
metal that is got back from strains at gauges. Bars of steel, 12.7 mm thick and short; gauges are half a bar away from
the specimen, so that pulses pass one after the other. Lateral inertia (Pochhammer and Chree) makes them oscillate, by
25 % behind the front: means are compared, over the plateau or over 10 µs."""
import math

import numpy
import pytest
from yadefrag import FEMat, PlasticFEMat, rectangle
from axis_scene import BAR as WAVE, body, DENSITY, O, STEEL, YOUNG
from fe_scene import ready

RADIUS, STRIKER, BAR, SPEED = 6.35e-3, .15, .36, 20  # m, m, m, m/s
PULSE, ARRIVAL = 2 * STRIKER / WAVE, .5 * BAR / WAVE  # s; at the gauge of the incident bar
SPECIMEN_RADIUS, SPECIMEN, SPECIMEN_YOUNG = 4e-3, 4e-3, 70e9  # m, m, Pa
MESHES = pytest.mark.parametrize('fine, part', [(1, .8), (1.5, .8), (1, .4)], ids=['default', 'refined', 'half step'])


class Run:
    """A striker, a bar, a specimen if it has a law, and a second bar of a given radius; strains at both gauges over
    time: `times`, `incident` with the reflected pulse, `transmitted`, (n,). Four triangles fill a bar's radius, six
    that of the specimen; `fine` times as many."""

    def __init__(self, law=None, radius=RADIUS, fine=1, part=.8):
        self.size = RADIUS / 4 / fine
        length = SPECIMEN if law else 0
        self.fe = fe = body(FEMat(**STEEL), rectangle((0, -BAR - STRIKER), (RADIUS, -BAR)), self.size,
                            velocity=(0, SPEED))
        fe.addPolygon(rectangle((0, -BAR), (RADIUS, 0)), size=self.size, material=0)
        fe.addPolygon(rectangle((0, length), (radius, length + BAR)), size=self.size, material=0)
        if law:
            O.materials.append(PlasticFEMat(young=SPECIMEN_YOUNG, poisson=.33, density=2700, frictionAngle=0, **law))
            fe.addPolygon(rectangle((0, 0), (SPECIMEN_RADIUS, length)), size=SPECIMEN_RADIUS / 6 / fine, material=1)
        ready(fe, part)
        self.before = fe.energy['total']
        gauges = self.gauge(-BAR / 2, RADIUS), self.gauge(length + BAR / 2, radius)
        rows = []
        while fe.time < 3 * ARRIVAL + 1.2 * PULSE:
            O.run(max(1, round(2.5e-7 / O.dt)), True)
            strain = fe.strain[:, 1]
            rows.append((fe.time, *(strain[gauge].mean() for gauge in gauges)))
        self.times, self.incident, self.transmitted = numpy.array(rows).T
        self.interval = self.times[1] - self.times[0]

    def gauge(self, y, radius):
        """Triangles at the surface of a bar, two sizes long."""
        at = self.fe._reference[self.fe.triangles].mean(axis=1)
        return numpy.flatnonzero((abs(at[:, 1] - y) < self.size) & (at[:, 0] > radius - self.size))

    def during(self, start, stop):
        """Of parts of a pulse: samples of the one at the first gauge, and of both others, one bar later."""
        return [numpy.flatnonzero((begin + start * PULSE < self.times) & (self.times < begin + stop * PULSE))
                for begin in (ARRIVAL, 3 * ARRIVAL)]

    def requireBalance(self):
        """Of all energies; measured 10⁻⁷."""
        assert self.fe.energy['total'] == pytest.approx(self.before, rel=1e-6) and not self.fe.warnings

    def duration(self):
        """(s) Of the first pulse, at half of its height."""
        height = self.incident / (-SPEED / (2 * WAVE)) - .5
        on = numpy.flatnonzero((height > 0) & (self.times < ARRIVAL + 1.2 * PULSE))
        first, last = on[0], on[-1]
        fall = height[last] / (height[last] - height[last + 1]) * (self.times[last + 1] - self.times[last])
        rise = height[first] / (height[first] - height[first - 1]) * (self.times[first] - self.times[first - 1])
        return self.times[last] + fall - self.times[first] + rise


@MESHES
def test_pulsesAreThoseOfOneDimension(fine, part):
    """The second bar has half of the section: −1/3 of the stress is reflected, 4/3 go on. 1 %: lateral inertia."""
    run = Run(radius=RADIUS / math.sqrt(2), fine=fine, part=part)
    first, later = run.during(.2, .8)
    pulse = DENSITY * WAVE * SPEED / 2
    assert -YOUNG * run.incident[first].mean() == pytest.approx(pulse, rel=.01)
    assert run.duration() == pytest.approx(PULSE, rel=.01)
    assert YOUNG * run.incident[later].mean() == pytest.approx(pulse / 3, rel=.01)
    assert -YOUNG * run.transmitted[later].mean() == pytest.approx(4 / 3 * pulse, rel=.01)
    run.requireBalance()


IDEAL = dict(yieldStress=400e6)
HARDENING = dict(yieldStress=300e6, hardening=800e6, hardeningExponent=1)
RATE = dict(yieldStress=300e6, rateFactor=.025)


def curve(run):
    """As in a laboratory, from the gauges only: plastic strain, its rate (1/s), true stress (Pa)."""
    times = (3 * ARRIVAL - .1 * PULSE < run.times) & (run.times < 3 * ARRIVAL + .9 * PULSE)
    rate = 2 * WAVE / SPECIMEN * run.incident[times]
    strain = numpy.cumsum(rate) * run.interval
    stress = -YOUNG * (RADIUS / SPECIMEN_RADIUS)**2 * run.transmitted[times] * (1 - strain)  # the volume stays the same
    return -numpy.log(1 - strain) - stress / SPECIMEN_YOUNG, rate / (1 - strain), stress


def workOfPulses(run):
    """(J) That the pulses have left in the specimen."""
    later = run.times > 3 * ARRIVAL - .15 * PULSE
    squares = (run.incident[~later]**2).sum() - (run.incident[later]**2 + run.transmitted[later]**2).sum()
    return math.pi * RADIUS**2 * WAVE * YOUNG * run.interval * squares


@pytest.mark.parametrize('law, fine, part', [(IDEAL, 1, .8), (HARDENING, 1, .8), (HARDENING, 1.5, .8),
                                             (HARDENING, 1, .4), (RATE, 1, .8)],
                         ids=['ideal', 'hardening', 'refined', 'half step', 'rate'])
def test_lawIsGotBack(law, fine, part):
    """3 % for means over 10 µs: the pulses oscillate. From a strain of .03 on, when both ends bear the same force."""
    run = Run(law, fine=fine, part=part)
    strain, rate, stress = curve(run)
    on = strain > .03
    assert strain.max() > .15
    effect = law.get('rateFactor', 0) * numpy.log(rate[on])
    flow = (law['yieldStress'] + law.get('hardening', 0) * strain[on]) * (1 + effect)
    mean = numpy.full(count := round(1e-5 / run.interval), 1 / count)
    ratio = numpy.convolve(stress[on], mean, 'valid') / numpy.convolve(flow, mean, 'valid')
    assert ratio == pytest.approx(numpy.ones(len(ratio)), abs=.03)
    if 'rateFactor' in law:  # alone: a fifth of the stress
        assert (stress[on].mean() / law['yieldStress'] - 1) / effect.mean() == pytest.approx(1, abs=.03)
    # 2 %: contact takes .5 % of the work.
    assert workOfPulses(run) == pytest.approx(run.fe.energy['plastic'], rel=.02)
    # Both ends of the specimen bear the same force, within 1 % of that of the first pulse.
    first, later = run.during(.2, .8)
    pulse = run.incident[first].mean()
    assert pulse + run.incident[later].mean() == pytest.approx(run.transmitted[later].mean(), abs=.01 * abs(pulse))
    run.requireBalance()
