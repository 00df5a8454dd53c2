"""Our loop, integrator and collider in scenes of few bodies, and their memory in a large one: scripts/bench small [--readme]

Inside yade. Engines take turns within a round; a step is timed by the processor time of the process, and ratios to YADE's
engines are formed within a round. Peak memory is that of a process of its own.
"""
import json
import os
import resource
import statistics
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade import O, utils  # noqa: E402
from yade import wrapper as w  # noqa: E402
import yadefrag  # noqa: E402,F401

import measured_tables  # noqa: E402
import scenes  # noqa: E402

# Collider, loop and integrator.
ENGINES = {'YADE': ('InsertionSortCollider', 'InteractionLoop', 'NewtonIntegrator'),
           'our loop and integrator': ('InsertionSortCollider', 'CurveLoop', 'CurveIntegrator'),
           'all ours': ('LebesgueCollider', 'CurveLoop', 'CurveIntegrator')}
WARM = 1000  # steps: spheres come to rest, data are moved together, the collider adapts its interval


def heap(n, clumps):
    """n spheres of clumps of two in loose layers that fall into a heap on a floor between four walls."""
    O.reset()
    O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2600, frictionAngle=.4))
    side = max(2, round((n / 4)**.5))
    for k in range(n):
        x, y, z = k % side, k // side % side, k // side**2
        at = (2.2 * x + .1 * (z % 2), 2.2 * y + .05 * (z % 3), 1.1 + 2.2 * z)
        if clumps:
            O.bodies.appendClumped([utils.sphere((at[0] - .4, *at[1:]), .6), utils.sphere((at[0] + .4, *at[1:]), .6)])
        else:
            O.bodies.append(utils.sphere(at, 1))
    for axis, place in ((0, -1.2), (0, 2.2 * side - 1), (1, -1.2), (1, 2.2 * side - 1), (2, 0)):
        O.bodies.append(utils.wall(place, axis=axis))
    O.dt = .3 * utils.PWaveTimeStep()
    return dict(bound=[w.Bo1_Sphere_Aabb(), w.Bo1_Wall_Aabb()], geom=[w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Wall_Sphere_ScGeom()],
                phys=[w.Ip2_FrictMat_FrictMat_FrictPhys()], law=[w.Law2_ScGeom_FrictPhys_CundallStrack()],
                newton=dict(gravity=(0, 0, -9.81), damping=.2))


def use(parts, engines):
    """The engines of that name."""
    collider, loop, integrator = (getattr(w, name) for name in ENGINES[engines])
    O.engines = [w.ForceResetter(), collider(parts['bound']), loop(parts['geom'], parts['phys'], parts['law']),
                 integrator(**parts['newton'])]


def milliseconds(n, clumps, engines, steps=3000):
    """Processor time of a step."""
    use(heap(n, clumps), engines)
    O.run(WARM, True)
    start = time.process_time()
    O.run(steps, True)
    return 1e3 * (time.process_time() - start) / steps


def printPeak(n, engines):
    """[MB] of this process with the packing of scenes.py, after some steps."""
    use(scenes.build('packing', n, 1), engines)
    O.run(100, True)
    print(json.dumps([resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024]), flush=True)


def main(arguments):
    """Measure, write."""
    parser = measured_tables.parser('small', __doc__)
    parser.add_argument('--rounds', type=int, default=9, help='default: %(default)s')
    options = parser.parse_args(arguments)
    rows = []
    for n, clumps in ((64, False), (64, True), (256, False), (256, True)):
        rounds = [[milliseconds(n, clumps, engines, steps=200000 // n) for engines in ENGINES] for _ in range(options.rounds)]
        ratios = [f'{statistics.median(turn[k] / turn[0] for turn in rounds):.2f}' for k in (1, 2)]
        rows.append(dict(zip(('scene', *ENGINES), (
            f'{n} {"clumps of two" if clumps else "spheres"}, ms per step',
            measured_tables.digits(statistics.median(turn[0] for turn in rounds)), *(f'× {one}' for one in ratios)))))
    both = [measured_tables.measuredBy(options, 'small.py', 'peak', 27000, engines)[0] for engines in ENGINES]
    rows.append(dict(zip(rows[0], ('packing of 27,000 spheres, MB', *(f'{one:.0f}' for one in both)))))
    measured_tables.publish(options, 'small', rows, f'processor time of a thread, medians of {options.rounds} rounds in turns, and peak memory, '
                            f'{measured_tables.origin.line()}, `scripts/bench small`')


if sys.argv[1:2] == ['peak']:
    printPeak(int(sys.argv[2]), sys.argv[3])
else:
    main(sys.argv[1:])
