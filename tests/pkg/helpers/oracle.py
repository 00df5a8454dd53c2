"""True sphere-sphere contacts from centres and radii alone: no collider, no YADE, plain NumPy."""
import itertools

import numpy as np

kRelative = 1e-11   # rounding allowed on a sum of radii
kAbsolute = 8e-16   # rounding allowed on a coordinate (a few ulps)


def contacts(centres, radii, hSize=None, block=512):
    """Contacts of all pairs, found by comparing every pair.

    centres (n,3) and radii (n) in any one length unit; hSize (3,3): columns are the period vectors,
    None for an aperiodic scene. Rows that are NaN never touch. Returns (sure, possible), two dicts
    (i, j) -> cellDist with i < j: `sure` overlap beyond rounding, `possible` includes the ties.
    cellDist is the triple of periods by which body j has to be shifted (zeros if aperiodic).
    """
    centres = np.asarray(centres, float).reshape(-1, 3)
    radii = np.asarray(radii, float)
    finder = _aperiodic if hSize is None else _periodic
    sure, possible = {}, {}
    for start in range(0, len(centres), block):
        rows = np.arange(start, min(start + block, len(centres)))
        for i, j, overlap, slack, dist in finder(centres, radii, rows, hSize):
            for k in np.nonzero(overlap >= -slack)[0]:
                key = (int(i[k]), int(j[k]))
                possible[key] = tuple(int(c) for c in dist[k])
                if overlap[k] > slack[k]:
                    sure[key] = possible[key]
    return sure, possible


def _pairs(radii, rows, n):
    i, j = np.meshgrid(rows, np.arange(n), indexing='ij')
    upper = (i < j) & ~np.isnan(radii)[i] & ~np.isnan(radii)[j]
    return i[upper], j[upper]


def _overlap(centres, radii, i, j, delta):
    scale = np.maximum(abs(centres[i]).max(axis=1), abs(centres[j]).max(axis=1))
    reach = radii[i] + radii[j]
    overlap = reach - np.sqrt((delta**2).sum(axis=1))
    return overlap, kRelative * reach + kAbsolute * scale


def _aperiodic(centres, radii, rows, _):
    # Of every pair first one coordinate, with more room than a contact has: most of the time is in the others.
    room = 1.001 * radii + 1e-12 * abs(centres).max(axis=1)
    near = abs(centres[rows, 0, None] - centres[:, 0]) <= room[rows, None] + room
    near &= rows[:, None] < np.arange(len(centres))
    i, j = np.nonzero(near)
    i = rows[i]
    overlap, slack = _overlap(centres, radii, i, j, centres[j] - centres[i])
    yield i, j, overlap, slack, np.zeros((len(i), 3), int)


def _periodic(centres, radii, rows, hSize):
    """All lattice images that can be within reach, however the cell is sheared."""
    hSize = np.asarray(hSize, float)
    i, j = _pairs(radii, rows, len(centres))
    delta = centres[j] - centres[i]
    inverse = np.linalg.inv(hSize)
    fraction = delta @ inverse.T
    nearest = -np.rint(fraction).astype(int)
    fraction = fraction + nearest
    # |row of the inverse| · |hSize f| >= |f|: no contact where some |f| exceeds this
    limit = 1e-6 + 2 * np.nanmax(radii) * np.linalg.norm(inverse, axis=1)
    for offset in itertools.product(*(range(-int(k), int(k) + 1) for k in np.ceil(limit))):
        keep = (abs(fraction + offset) <= limit).all(axis=1)
        if not keep.any():
            continue
        dist = nearest[keep] + np.array(offset)
        shift = dist @ hSize.T
        overlap, slack = _overlap(centres, radii, i[keep], j[keep], delta[keep] + shift)
        # the error of the shift itself counts too
        yield i[keep], j[keep], overlap, slack + 4 * kAbsolute * abs(shift).max(axis=1), dist


def masked(pairs, masks, avoid=0, clumps=None):
    """Those of `pairs` that may collide: masks share a bit, not both alike within `avoid`,
    not members of one clump. masks (n,) ints; clumps (n,) ints, -1: none."""
    def may(i, j):
        if not masks[i] & masks[j]:
            return False
        if masks[i] == masks[j] and masks[i] & avoid:
            return False
        return clumps is None or clumps[i] < 0 or clumps[i] != clumps[j]
    return {key: value for key, value in pairs.items() if may(*key)}
