"""Outlines that touch, as files have them: rounded or digitised one by one; and networks of traces."""
import numpy as np

import yadefrag


def turned(outlines, angle):
    c, s = np.cos(angle), np.sin(angle)
    return [np.array(outline) @ np.array([[c, s], [-s, c]]) for outline in outlines]


def rounded(outlines, digits):
    return [[tuple(p) for p in np.round(outline, digits).tolist()] for outline in outlines]


def digitised(outlines, error, seed):
    """Each outline's vertices with errors of its own (m)."""
    random = np.random.default_rng(seed)
    return [[tuple(p) for p in np.array(outline) + random.uniform(-error, error, (len(outline), 2))]
            for outline in outlines]


def bricks(rows, columns, low=(0, 0)):
    """Running bond of .25 × .065 m: each corner lies on the middle of another one's side."""
    found = []
    for row in range(rows):
        for k in range(columns):
            x, y = low[0] + .25 * k + .125 * (row % 2), low[1] + .065 * row
            found.append(yadefrag.rectangle((x, y), (x + .25, y + .065)))
    return found


def rubbleMasonry(rows, seed):
    """Courses of random height, of stones of random length, 1 m long: T-junctions at random."""
    random = np.random.default_rng(seed)
    found, y = [], 0.
    for _ in range(rows):
        high = y + random.uniform(.05, .12)
        ends = np.concatenate([[0], np.cumsum(random.uniform(.1, .3, 4))])
        ends *= 1 / ends[-1]
        found += [yadefrag.rectangle((a, y), (b, high)) for a, b in zip(ends, ends[1:])]
        y = high
    return found


def traces(count, seed, hair=1e-5):
    """Two sets of traces in the unit square; ends that miss or cross another trace by a hair (m)."""
    random = np.random.default_rng(seed)
    lines = []
    for i in range(count):
        angle = random.normal((.3, 1.9)[i % 2], .25)
        middle, half = random.uniform(0, 1, 2), random.lognormal(-2.2, .5)
        way = half * np.array([np.cos(angle), np.sin(angle)])
        a, b = middle - way, middle + way
        if lines and random.uniform() < .5:  # ends near a trace that is there
            c, d = lines[random.integers(len(lines))]
            b = c + random.uniform(.1, .9) * (d - c) + random.uniform(-hair, hair, 2)
        lines.append((a, b))
        if random.uniform() < .1:  # mapped twice
            lines.append((a + random.uniform(-hair, hair, 2), b + random.uniform(-hair, hair, 2)))
    return [(tuple(a.tolist()), tuple(b.tolist())) for a, b in lines]
