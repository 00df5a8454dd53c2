"""Impact of a plate and its spall, around the axis: a flyer of 2 mm hits a disc of 4 mm. Until the release from the
edge arrives, the strain at the axis is uniaxial: the velocity of the rear face is that of the flyer, then less by the
pull-back Δu of the spall (Antoun et al. 2003, Spall Fracture, ch. 2). The mean stress fails; the tension across the
spall is ½ρcΔu where all waves are elastic, and ρcΔu/(1 + c/cb) where the rebound is elastic, but the tension before it
plastic (Romanchenko and Stepanov 1980)."""
import math

import numpy
import pytest
from yadefrag import crackTable, PlasticFEMat, rectangle
from axis_scene import body, O
from fe_scene import ready

FLYER, DISC, SIZE = 2e-3, 4e-3, 1e-4  # m
STEEL = dict(young=200e9, poisson=.29, density=7830, yieldStress=1.6e9)  # hard: elastic in these pulses
COPPER = dict(young=124e9, poisson=.34, density=8960, yieldStress=90e6)


class Waves:
    """Speeds of elastic and plastic waves, `c` and `cb` (m/s); `share`: axial over mean stress of elastic ones."""

    def __init__(self, young, poisson, density, yieldStress):
        bulk, shear = young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))
        self.density, self.yieldStress = density, yieldStress
        self.c, self.cb = math.sqrt((bulk + 4 * shear / 3) / density), math.sqrt(bulk / density)
        self.share = (bulk + 4 * shear / 3) / bulk
        self.limit = yieldStress * (bulk + 4 * shear / 3) / (2 * shear)  # Pa, axial, where waves begin to yield


class Impact:
    """A flyer that hits a disc of the same material; only the disc fails. `times` (n,), `velocities` (n, k) of the rear
    face's nodes, along the axis, at `radii` (k,); `change` of the energy, of all."""

    def __init__(self, material, speed, radius, until, flyer=FLYER, fine=1, part=.8, seed=0, **failure):
        mesh = dict(mesh='irregular', meshSeed=seed)
        self.fe = fe = body(PlasticFEMat(**material, frictionAngle=0), rectangle((0, -flyer), (radius, 0)), SIZE / fine,
                            velocity=(0, speed), **mesh)
        fe.linearViscosity, fe.quadraticViscosity = .06, 1.2
        O.materials.append(PlasticFEMat(**material, frictionAngle=0, **failure))
        fe.addPolygon(rectangle((0, 0), (radius, DISC)), size=SIZE / fine, material=1, **mesh)
        ready(fe, part)
        start, rows = fe.energy['total'], []
        rear = numpy.flatnonzero(fe._reference[:, 1] > DISC - 1e-9)
        self.radii = fe._reference[rear, 0]
        while fe.time < until:
            O.run(round(2 * .8 / part), True)
            rows.append((fe.time, *fe.velocities[rear, 1]))
        self.times, self.velocities = numpy.array(rows)[:, 0], numpy.array(rows)[:, 1:]
        self.change = fe.energy['total'] / start - 1

    def near(self, radius, within=1e-3):
        """(m/s) Velocity of the rear face around a radius, over time."""
        return self.velocities[:, abs(self.radii - radius) < within].mean(axis=1)

    def plateau(self, start, stop):
        return self.near(0)[(start < self.times) & (self.times < stop)].mean()

    def pullBack(self, plateau, start):
        """(m/s) From a plateau to the least velocity since `start`."""
        return plateau - self.near(0)[self.times > start].min()

    def placeOfSpall(self):
        """(m) Distance of cracks near the axis from the rear face, the mean by their damage."""
        table = crackTable(self.fe)
        table = table[table['x'] < 2e-3]
        return self.fe.nodes[:, 1].max() - numpy.average(table['y'], weights=table['damage'])


def kinds(weaker):
    """Meshes and steps, and a smaller strength with a smaller speed."""
    given = {'default': {}, 'second mesh': dict(seed=1), 'third mesh': dict(seed=2), 'refined': dict(fine=1.5),
             'half step': dict(part=.4), 'weaker': weaker}
    return pytest.mark.parametrize('kind', given.values(), ids=given)


@kinds(weaker=dict(spallStress=.8e9, speed=75))
def test_strengthOfSteelIsGotBack(kind):
    """3 %: a triangle fails at the end of a step, at a stress above the strength by part of the step's change; the
    front of the pull-back is some triangles wide. The plateau's .5 %: what is left of the front's oscillation."""
    given = {'spallStress': 1e9, 'speed': 92, **kind}
    waves, impact = Waves(**STEEL), Impact(STEEL, radius=9e-3, until=1.6e-6, fractureEnergy=1e4, **given)
    assert impact.plateau(.95e-6, 1.2e-6) == pytest.approx(given['speed'], rel=5e-3)
    found = waves.density * waves.c * impact.pullBack(given['speed'], 1.3e-6) / 2
    assert found / (given['spallStress'] * waves.share) == pytest.approx(1, abs=.03)
    assert impact.placeOfSpall() == pytest.approx(FLYER, rel=.15)
    assert abs(impact.change) < 3e-5


@kinds(weaker=dict(spallStress=1e9, speed=75))
def test_strengthOfCopperIsGotBack(kind):
    """3 %, as above. The elastic part of the rebound is 18 m/s, more than the 8 m/s by which the formulas differ. The
    velocity of the plateau is less than the flyer's by the elastic precursor; 1 %: its reflections."""
    given = {'spallStress': 1.35e9, 'speed': 100, **kind}
    waves, impact = Waves(**COPPER), Impact(COPPER, radius=11.5e-3, until=2.5e-6, fractureEnergy=5e3, **given)
    plateau = impact.plateau(1.3e-6, 1.6e-6)
    slower = waves.limit / waves.density * (1 / waves.cb - 1 / waves.c)
    assert plateau == pytest.approx(given['speed'] - slower, rel=.01)
    found = waves.density * waves.c * impact.pullBack(plateau, 1.8e-6) / (1 + waves.c / waves.cb)
    assert found / (given['spallStress'] + 2 / 3 * waves.yieldStress) == pytest.approx(1, abs=.03)
    assert impact.placeOfSpall() == pytest.approx(FLYER, rel=.15)
    assert abs(impact.change) < 2e-5


def since(times, values, level, start):
    """The time at which `values` are first below a level, after `start`."""
    last = numpy.flatnonzero((times > start) & (values < level))[0]
    return numpy.interp(-level, -values[last - 1:last + 1], times[last - 1:last + 1])


@pytest.mark.parametrize('kind', [{}, dict(fine=2), dict(part=.4)], ids=['default', 'refined', 'half step'])
def test_releaseFromTheEdgeArrivesAtTheSpeedOfSound(kind):
    """A thick flyer. The release starts at the rim of the touching faces. On a radius of 2 mm it is seen within 1 %, as
    a fall of the velocity by 2 %. On the axis it is focused: a fall by 5 % is seen up to 4 % early, three triangles
    before it."""
    speed, radius, c = 100, 10e-3, Waves(**STEEL).c
    impact = Impact(STEEL, speed, radius, until=1.1 * math.hypot(radius, DISC) / c, flyer=5e-3, **kind)
    front = since(impact.times, -impact.near(0), -speed / 2, 0)
    assert front == pytest.approx(DISC / c, rel=.02)  # half of it: it is as wide
    for place, within, fall, allowed in ((2e-3, 2.5e-4, .02, .01), (0, 5e-4, .05, .04)):
        wanted = math.hypot(radius - place, DISC) / c
        arrival = since(impact.times, impact.near(place, within), (1 - fall) * speed, .8 * wanted)
        assert arrival == pytest.approx(wanted, rel=allowed)
