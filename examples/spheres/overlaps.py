"""Overlapping spheres, found with SciPy's k-d tree and without a collider, and the comparison of two runs."""
import numpy as np
from scipy.spatial import cKDTree
from yade import O
from yade.wrapper import Sphere


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
