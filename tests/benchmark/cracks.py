"""What a mesh decides about cracks, and bodies that are small beside a cohesive zone: scripts/bench cracks

plate   a plate of glass with a notch, pulled by 12 MPa, on several meshes (Ha and Bobaru 2010, Int. J. Fract. 162, 229;
        fastest crack of glass in tests: Bowden et al. 1967, Nature 216, 38, 1580 m/s): does its crack branch, how fast is it
block   rock of 20 x 40 mm between rough platens, by the length of its zone: load over that of Mohr and Coulomb
pane    a beam without a notch, bent: largest stress by beam theory over the strength

With --readme the table goes into docs/data and the pages.
"""
import math
import os
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import measured_tables  # noqa: E402
from yade import O  # noqa: E402
from yadefrag import BrittleFEMat, FESolver, crackTable, engines, rectangle  # noqa: E402

SEEDS = (1, 2, 3)


def plate(seed, size=.5e-3):
    """(x where the crack branches or None, m; its largest speed in 4 microseconds, m/s)."""
    O.reset()
    young, energy = 72e9, 135.
    O.materials.append(BrittleFEMat(young=young, poisson=.22, density=2440, planeStress=True, fractureEnergy=energy,
                                    tensileStrength=math.sqrt(young * energy / (4.2 * size)), label='glass'))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (.1, .04)), size=size, meshSeed=seed, material='glass',
                  joints=[((0, .02), (.05, .02))])
    fe.pressure(lambda x, y: y < 1e-9 or y > .04 - 1e-9, -12e6)
    O.engines, O.dt = engines(fe), .7 * fe.criticalTimeStep()
    moments = []
    while O.time < 60e-6:
        O.run(20, True)
        at = opened(fe)
        if len(at):
            moments.append((O.time, at[:, 0].max()))
            if at[:, 0].max() > .095:
                break
    return branchOf(opened(fe)), speedOf(moments)


def opened(fe):
    """(n, 2) Middles of the sides beyond the notch that have spent half of their energy, m."""
    table = crackTable(fe)
    table = table[(table['damage'] > .5) & (table['x'] > .0505)]
    return numpy.column_stack([table['x'], table['y']])


def branchOf(at, apart=.006):
    """Where two cracks are that far apart for the first time."""
    for x in numpy.arange(.052, .098, .001):
        y = at[abs(at[:, 0] - x) < .001, 1]
        if len(y) and y.max() - y.min() > apart:
            return x
    return None


def speedOf(moments, span=4e-6):
    times, places = map(numpy.array, zip(*moments))
    ends = numpy.searchsorted(times, times + span)
    return max((places[j] - places[i]) / (times[j] - times[i]) for i, j in enumerate(ends) if j < len(times))


def block(zone, seed, size=1.25e-3):
    """Largest load over that of Mohr and Coulomb; the zone is given over the width, and so long of sliding cracks, too."""
    O.reset()
    width, young, strength, friction, factor = .02, 30e9, 5e6, .6, 3
    O.materials.append(BrittleFEMat(young=young, poisson=.2, density=2500, frictionAngle=friction, tensileStrength=strength,
                                    shearFactor=factor, shearEnergyFactor=factor**2, label='rock',
                                    fractureEnergy=zone * width * strength**2 / young))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (width, 2 * width)), size=size, meshSeed=seed, material='rock')
    top = numpy.flatnonzero(fe.nodes[:, 1] > 2 * width - 1e-9)
    fe.prescribe(top, vx=0, vy=[(0, 0), (2e-4, -.3)])
    fe.prescribe(lambda x, y: y < 1e-9, vx=0, vy=0)
    wanted = 2 * factor * strength * math.cos(friction) / (1 - math.sin(friction))
    return largest(fe, lambda: -fe.reaction(top)[1] / width) / wanted


def pane(zone, seed, height=.01):
    """Largest stress of beam theory over the strength."""
    O.reset()
    young, strength, rows = 70e9, 60e6, 12
    O.materials.append(BrittleFEMat(young=young, poisson=.2, density=2500, planeStress=True, tensileStrength=strength,
                                    fractureEnergy=zone * height * strength**2 / young, label='glass'))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (4 * height, height)), size=height / rows, meshSeed=seed, material='glass')
    ends = [numpy.flatnonzero(abs(fe.nodes[:, 0] - x) < 1e-9) for x in (0, 4 * height)]
    for end, sign in zip(ends, (-1, 1)):
        fe.prescribe(end, vx=lambda x, y, t, sign=sign: sign * (height / 2 - y) * 20 * min(1, t / 1e-4))
    arms = height / 2 - fe.nodes[ends[1], 1]
    return largest(fe, lambda: 6 * (fe.reactions[ends[1], 0] @ arms) / height**2) / strength


def largest(fe, load):
    """Largest value of a load until it has fallen by a third."""
    O.engines, O.dt = engines(fe), .5 * fe.criticalTimeStep()
    most = 0.
    for _ in range(4000):
        O.run(10, True)
        now = load()
        most = max(most, now)
        if fe.numCracks and now < .67 * most:
            return most
    raise RuntimeError('the load did not fall.')


def main(arguments):
    parser = measured_tables.parser('cracks', __doc__)
    parser.add_argument('--meshes', type=int, default=11)
    options = parser.parse_args(arguments)
    runs = [plate(seed) for seed in range(1, options.meshes + 1)]
    branched = [x for x, _ in runs if x]
    rows = [{'scene': 'notched plate of glass: meshes in which the crack branches', 'zone over body': '–', 'wanted': 'all',
             'measured': f'{len(branched)} of {len(runs)}'},
            {'scene': 'the same: largest speed of the crack, m/s', 'zone over body': '–', 'wanted': '1580',
             'measured': f'{min(v for _, v in runs):.0f} to {max(v for _, v in runs):.0f}'}]
    for name, of, zones in (('rock between rough platens: load over Mohr and Coulomb', block, (.25, 1)),
                            ('bent pane without a notch: stress over strength', pane, (.5,))):
        for zone in zones:
            found = [of(zone, seed) for seed in SEEDS]
            rows.append({'scene': name, 'zone over body': f'{zone:g}', 'wanted': '1', 'measured': f'{min(found):.2f} to {max(found):.2f}'})
    measured_tables.publish(options, 'cracks', rows, f'{measured_tables.origin.line()}, `scripts/bench cracks`')


if __name__ == '__main__':
    main(sys.argv[1:])
