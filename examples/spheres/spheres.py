"""Impact of a steel ball on 20,000 spheres, with YADE's engines and with those of yadefrag.

    scripts/spheres           sets up, builds and runs this
    scripts/yade -n -x examples/spheres/spheres.py [--steps 1000] [--seed 1] [--engines YADE,collider,yadefrag]

The same scene is run with each set of engines: collider, interaction loop and integrator. Prints a table and checks the contacts; writes
out/spheres.png and out/spheres_times.png. Exit status 1 if a contact is missing anywhere.

Expected agreement. In each run, at each check, the contacts must be exactly the pairs of spheres that
overlap, which SciPy finds without any collider. The two runs have the same contacts as long as their
trajectories agree. At first these agree to the last digit or nearly so: the engines visit the contacts in
different orders, so that the forces on a sphere are summed in different orders, and the rounding
differs by 1e-16. An impact is chaotic: such differences grow with each collision. A pair may then
touch in one run and just not in the other; its overlap cannot exceed the difference of the two
spheres' positions, and that is checked.
"""
import argparse
import os
import sys
import time

import matplotlib
import numpy as np
from tqdm import tqdm

matplotlib.use('Agg')
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import drawing  # noqa: E402
import overlaps  # noqa: E402
from yade import O, utils  # noqa: E402
from yade.wrapper import (  # noqa: E402
    Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom, InsertionSortCollider, InteractionLoop, Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack, NewtonIntegrator)
from yadefrag import CurveIntegrator, CurveLoop, LebesgueCollider, inCurveOrder  # noqa: E402

ENGINES = {  # collider, interaction loop, integrator
    'YADE': (InsertionSortCollider, InteractionLoop, NewtonIntegrator),
    'collider': (LebesgueCollider, InteractionLoop, NewtonIntegrator),
    'yadefrag': (LebesgueCollider, CurveLoop, CurveIntegrator)}

RADIUS = 5e-3  # m
SHAPE = (40, 25, 20)  # spheres along x, y, z: 20,000
SPEED = 80.  # m/s
CHECKS = (0, .05, .15, .35, .65, 1)  # of the steps
OUT = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..', 'out')


def build(seed):
    """The scene: a bed of 20,000 spheres on a floor, and a steel ball above it; sets O.dt."""
    O.reset()
    sand = FrictMat(young=1e8, poisson=.3, density=2600, frictionAngle=.5, label='sand')
    steel = FrictMat(young=1e9, poisson=.3, density=7800, frictionAngle=.3, label='steel')
    O.materials.append(sand)
    O.materials.append(steel)
    centres = bed(seed)
    # Neighbours in space are neighbours in memory.
    for centre in inCurveOrder(centres.tolist()):
        O.bodies.append(utils.sphere(centre, RADIUS, material='sand', color=(.8, .7, .5)))
    radius = 6 * RADIUS
    top = centres[:, 2].max() + RADIUS
    ball = O.bodies.append(utils.sphere((0, 0, top + radius + .5e-3), radius, material='steel'))
    O.bodies[ball].state.vel = (.25 * SPEED, 0, -SPEED)
    O.bodies.append(utils.wall(0, axis=2, material='sand'))
    O.dt = .3 * RADIUS * (2600 / 1e8) ** .5


def bed(seed):
    """Centres (20000, 3), m: hexagonal layers, spheres just apart, with random shifts of 1 % of a
    radius."""
    i, j, k = (a.ravel() for a in np.meshgrid(*map(range, SHAPE), indexing='ij'))
    x = 2 * i + (j + k) % 2
    y = 3 ** .5 * (j + (k % 2) / 3)
    z = 2 * (2 / 3) ** .5 * k
    centres = np.stack([x, y, z], axis=1) * 1.012 * RADIUS
    centres += np.random.default_rng(seed).uniform(-.01, .01, centres.shape) * RADIUS
    centres[:, :2] -= (centres[:, :2].max(axis=0) + centres[:, :2].min(axis=0)) / 2
    centres[:, 2] += RADIUS * 1.011 - centres[:, 2].min()
    return centres


def run(name, seed, checks):
    """Run the scene with these engines; returns a dict of times, counts and snapshots."""
    build(seed)
    collider, loop, integrator = ENGINES[name]
    O.engines = [
        ForceResetter(),
        collider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], label='collider'),
        loop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
             [Law2_ScGeom_FrictPhys_CundallStrack()], label='loop'),
        integrator(damping=.1, gravity=(0, 0, -9.81)),
    ]
    O.timingEnabled = True
    result = dict(name=name, seconds=0., snapshots=[])
    with tqdm(total=checks[-1], desc=name, unit='step', disable=None) as bar:
        for stop in checks:
            while O.iter < stop - 1:
                result['seconds'] += _timed(min(25, stop - 1 - O.iter))
                bar.update(O.iter - bar.n)
            before = overlaps.positions()  # the contacts of the next step belong to these positions
            result['seconds'] += _timed(1)
            result['snapshots'].append(overlaps.snapshot(before))
            bar.update(O.iter - bar.n)
    result.update(collider=O.engines[1].execTime * 1e-9, loop=O.engines[2].execTime * 1e-9,
                  integrator=O.engines[3].execTime * 1e-9, activations=O.engines[1].execCount,
                  interactions=len(O.interactions), real=O.interactions.countReal())
    return result


def _timed(steps):
    start = time.perf_counter()
    O.run(steps, True)
    return time.perf_counter() - start


def table(results):
    """The comparison as Markdown: a column for each set of engines, and the ratio of the first to the last."""
    rows = [('whole run, s', 'seconds'), ('collider, s', 'collider'),
            ('interaction loop, s', 'loop'), ('integrator, s', 'integrator'),
            ('collider activations', 'activations'), ('potential interactions', 'potential'),
            ('real contacts', 'real')]
    for r in results:
        r['potential'] = r['interactions'] - r['real']
    head = ['', *[r['name'] for r in results], *(['ratio'] if len(results) > 1 else [])]
    lines = [head, ['---', *['--:'] * (len(head) - 1)]]
    for title, key in rows:
        values = [r[key] for r in results]
        cells = [f'{v:.2f}' if isinstance(v, float) else f'{v:,}' for v in values]
        if len(values) > 1:
            cells.append(f'{values[0] / values[-1]:.2f}' if values[-1] else '')
        lines.append([title, *cells])
    return '\n'.join('| ' + ' | '.join(line) + ' |' for line in lines)


def main(arguments):
    """Run, compare, print, draw; returns the exit status."""
    parser = argparse.ArgumentParser(prog='spheres.py', description=__doc__.split('\n')[0])
    parser.add_argument('--steps', type=int, default=1000, help='default: 1000')
    parser.add_argument('--seed', type=int, default=1, help='default: 1')
    parser.add_argument('--engines', type=lambda text: text.split(','), default=['YADE', 'yadefrag'],
                        help=f'some of {",".join(ENGINES)}; default: YADE,yadefrag')
    parser.add_argument('--out', default=OUT, help='folder for the pictures; default: out')
    options = parser.parse_args(arguments)
    if options.steps < 20:
        parser.error(f'--steps is {options.steps}; it must be at least 20')
    checks = [max(2, round(options.steps * share)) for share in CHECKS]
    unknown = [name for name in options.engines if name not in ENGINES]
    if unknown:
        parser.error(f'no engines {unknown[0]!r}; there are {", ".join(ENGINES)}')
    results = [run(name, options.seed, checks) for name in options.engines]
    print(f'\nProjectile into 20,000 spheres, {options.steps} steps of {O.dt:.2g} s\n')
    print(table(results), '\n')
    missing = overlaps.compare(results, checks)
    os.makedirs(options.out, exist_ok=True)
    drawing.frames(results[-1], [c * O.dt for c in checks],
                   os.path.join(options.out, 'spheres.png'))
    drawing.times(results, os.path.join(options.out, 'spheres_times.png'))
    print('Pictures:', ', '.join(os.path.relpath(os.path.join(options.out, name))
                                 for name in ('spheres.png', 'spheres_times.png')))
    return 1 if missing else 0


if __name__ == '__main__':
    status = main(sys.argv[1:])
    sys.stdout.flush()
    os._exit(status)  # yade -x would end with 0
