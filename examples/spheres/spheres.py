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
from scipy.spatial import cKDTree
from tqdm import tqdm

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402
from yade import O, utils  # noqa: E402
from yade.wrapper import (  # noqa: E402
    Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom, InsertionSortCollider, InteractionLoop, Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack, NewtonIntegrator, Sphere)
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
NAMES = {'YADE': "YADE's engines", 'collider': 'LebesgueCollider', 'yadefrag': "yadefrag's engines"}
COLOURS = {'collider': '#d1495b', 'loop': '#3d8fb5', 'integrator': '#8fb996', 'rest': '#cccccc'}


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
            before = positions()  # the contacts of the next step belong to these positions
            result['seconds'] += _timed(1)
            result['snapshots'].append(snapshot(before))
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


# --- overlaps, found with SciPy's k-d tree and without a collider

def positions():
    """Centres (n, 3) of all spheres, m, in the order of their ids."""
    return np.array([b.state.pos for b in O.bodies if isinstance(b.shape, Sphere)])


def snapshot(before):
    """State after a step that began at the centres `before` (n, 3): a dict of arrays.

    `contacts` are the real sphere–sphere interactions as a sorted set, one number per pair;
    `overlapping` the pairs that overlap at `before`; `x`, `speed`, `radii` the spheres.
    """
    spheres = [b for b in O.bodies if isinstance(b.shape, Sphere)]
    radii = np.array([b.shape.radius for b in spheres])
    n = len(spheres)
    pairs = np.array([(i.id1, i.id2) for i in O.interactions], int).reshape(-1, 2)
    pairs = np.sort(pairs[(pairs < n).all(axis=1)], axis=1)
    return dict(before=before, radii=radii, contacts=np.sort(pairs[:, 0] * n + pairs[:, 1]),
                overlapping=overlapping(before, radii), x=positions(),
                speed=np.array([b.state.vel.norm() for b in spheres]))


def overlapping(x, radii):
    """Sorted pairs i * n + j, i < j, of spheres whose distance is below the sum of their radii.

    Of spheres of one size the tree finds those that are near, the few larger ones are compared with all.
    """
    n, r = len(x), np.median(radii)
    found = [_touching(np.full(n, b), np.arange(n), x, radii) for b in np.flatnonzero(radii > 1.001 * r)]
    near = cKDTree(x).query_pairs(2.003 * r, output_type='ndarray')
    return np.unique(np.concatenate([*found, _touching(*near.T, x, radii)]))


def _touching(i, j, x, radii):
    low, high = np.minimum(i, j), np.maximum(i, j)
    overlap = radii[low] + radii[high] - np.linalg.norm(x[low] - x[high], axis=1)
    keep = (overlap > 0) & (low != high)
    return low[keep] * len(x) + high[keep]


def compare(results, checks):
    """Prints the agreement at each check; returns the number of wrong contacts."""
    wrong = 0
    for k, step in enumerate(checks):
        shots = [r['snapshots'][k] for r in results]
        for r, shot in zip(results, shots):
            bad = np.setxor1d(shot['contacts'], shot['overlapping'])
            if len(bad):
                print(f'step {step}, {r["name"]}: {len(bad)} contacts are not the overlaps')
                wrong += len(bad)
        line = f'step {step:5}: contacts {len(shots[0]["contacts"]):6,}'
        if len(shots) > 1:
            line += '; ' + _difference(shots[0], shots[-1])
            wrong += _impossible(shots[0], shots[-1])
        print(line)
    print('\nAll contacts are the pairs that overlap.' if not wrong
          else f'\n{wrong} contacts are WRONG.')
    if len(results) > 1:
        print('(Positions differ since forces are summed in another order; see spheres.py.)')
    return wrong


def _difference(a, b):
    moved = np.linalg.norm(a['before'] - b['before'], axis=1).max()
    differing = len(np.setxor1d(a['contacts'], b['contacts']))
    return f'differing {differing}; positions differ by at most {moved:.1e} m'


def _impossible(a, b):
    """Contacts of only one run that overlap by more than the difference of the two runs'
    positions."""
    pairs = np.setxor1d(a['contacts'], b['contacts'])
    i, j = np.divmod(pairs, len(a['radii']))
    touch = a['radii'][i] + a['radii'][j]
    overlap = [touch - np.linalg.norm(s['before'][i] - s['before'][j], axis=1) for s in (a, b)]
    moved = np.linalg.norm(a['before'] - b['before'], axis=1)
    bad = np.maximum(*overlap) > (moved[i] + moved[j]) * (1 + 1e-9) + 1e-15
    return int(bad.sum())


# --- pictures

def drawFrames(result, times, file):
    """Frames side by side: a section through the bed, spheres coloured by speed (m/s)."""
    shots = result['snapshots']
    half = 1e2 * np.abs(shots[0]['x'][:, 0]).max() * 1.03
    top = 1e2 * np.sort(shots[-1]['x'][:, 2])[-10] + 2
    figure, axes = plt.subplots(2, -(-len(shots) // 2), figsize=(13, 7.6), sharex=True, sharey=True,
                                layout='constrained')
    norm = LogNorm(.05, 80)
    for axis, shot, when in zip(axes.flat, shots, times):
        spheres = _cut(axis, shot, norm)
        axis.set_title(f'{1e3 * when:.1f} ms', loc='left', fontsize=11)
        axis.set_xlim(-half, half)
        axis.set_ylim(0, top)
        axis.set_aspect('equal')
        axis.set_facecolor('#f4f4f4')
    for axis in axes[-1]:
        axis.set_xlabel('x, cm')
    for axis in axes[:, 0]:
        axis.set_ylabel('z, cm')
    figure.colorbar(spheres, ax=axes, label='speed, m/s', shrink=.8, pad=.01, extend='both',
                    ticks=[.1, 1, 10], format='%g')
    figure.suptitle(f'Steel ball into {len(shots[0]["x"]) - 1:,} spheres, cut at y = 0', fontsize=13)
    figure.savefig(file, dpi=100)
    plt.close(figure)


def _cut(axis, shot, norm):
    """Draw the spheres behind the plane y = 0, the nearest last."""
    x, radii = shot['x'], shot['radii']
    order = np.flatnonzero((x[:, 1] > -radii * .5) & (x[:, 1] < .1))
    big = radii[order] > 2 * np.median(radii)
    rank = np.argsort(-x[order, 1] + 10 * big)
    order = order[rank]
    spheres = EllipseCollection(2e2 * radii[order], 2e2 * radii[order], np.zeros(len(order)),
                                units='xy', offsets=1e2 * x[order][:, [0, 2]],
                                offset_transform=axis.transData, norm=norm, cmap='plasma',
                                edgecolors='#00000080',
                                linewidths=np.where(big[rank], 1.6, .3))
    spheres.set_array(np.clip(shot['speed'][order], 1e-3, None))
    axis.add_collection(spheres)
    return spheres


def drawTimes(results, file):
    """Bars of the whole time, split into collider, interaction loop, integrator and the rest."""
    figure, axis = plt.subplots(figsize=(8, 1.4 + .8 * len(results)), layout='constrained')
    left = np.zeros(len(results))
    y = np.arange(len(results))[::-1]
    parts = {k: [r[k] for r in results] for k in ('collider', 'loop', 'integrator')}
    parts['rest'] = [max(0, r['seconds'] - r['collider'] - r['loop'] - r['integrator'])
                     for r in results]
    names = dict(loop='interaction loop')
    for part, values in parts.items():
        axis.barh(y, values, left=left, height=.6, color=COLOURS[part], label=names.get(part, part))
        left += values
    axis.bar_label(axis.containers[-1], [f'{r["seconds"]:.1f} s' for r in results], padding=4)
    axis.set_yticks(y, [NAMES[r['name']] for r in results])
    axis.set_xlim(0, 1.12 * left.max())
    axis.set_xlabel('time, s')
    axis.spines[['top', 'right']].set_visible(False)
    figure.suptitle('Projectile into 20,000 spheres: distribution of the time', fontsize=12)
    axis.legend(loc='lower center', bbox_to_anchor=(.5, 1), ncol=4, frameon=False)
    figure.savefig(file, dpi=110)
    plt.close(figure)


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
    missing = compare(results, checks)
    os.makedirs(options.out, exist_ok=True)
    drawFrames(results[-1], [c * O.dt for c in checks], os.path.join(options.out, 'spheres.png'))
    drawTimes(results, os.path.join(options.out, 'spheres_times.png'))
    print('Pictures:', ', '.join(os.path.relpath(os.path.join(options.out, name))
                                 for name in ('spheres.png', 'spheres_times.png')))
    return 1 if missing else 0


if __name__ == '__main__':
    status = main(sys.argv[1:])
    sys.stdout.flush()
    os._exit(status)  # yade -x would end with 0
