"""Squares in a frame: a quarter of them starts in random directions with the same speed.

    scripts/yade -n -x examples/squares/squares.py [--n 8] [--steps 12000] [--collider Lebesgue] …

The benchmark "squares" of Diekmann et al., ECCOMAS 2000, §6, figure 11: a rigid frame filled with
rows and columns of squares with 4 segments a side. Here 10 mm steel squares, 2 mm apart, 50 m/s,
no friction. All in SI units, plane strain, per metre of thickness. Writes squares.png.
"""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import FEMat, FESolver  # noqa: E402
from yadefrag import rectangle, rectangleMesh  # noqa: E402

EDGE, GAP, WALL = 10e-3, 2e-3, 5e-3  # m
SEGMENTS = 4  # along an edge
SPEED = 50.  # m/s


def build(n, passes, seed):
    """n × n squares and the frame around them; returns the solver."""
    O.materials.append(FEMat(young=210e9, poisson=.3, density=7800,
                             frictionAngle=0, label='steel'))
    fe = FESolver(passes=passes)
    random = np.random.default_rng(seed)
    velocities = np.zeros((n * n, 2))
    moving = random.choice(n * n, max(1, n * n // 4), replace=False)
    angles = random.uniform(0, 2 * np.pi, len(moving))
    velocities[moving] = SPEED * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    for k, velocity in enumerate(velocities):
        low = GAP + (EDGE + GAP) * np.array([k % n, k // n])
        nodes, triangles = rectangleMesh(low, low + EDGE, SEGMENTS, SEGMENTS, crossed=True)
        fe.addTriangles(nodes, triangles, material='steel', velocity=velocity, selfContact=False)
    inside = n * (EDGE + GAP) + GAP
    fe.addPolygon(rectangle((-WALL, -WALL), (inside + WALL, inside + WALL)),
                  [rectangle((0, 0), (inside, inside))], size=EDGE / SEGMENTS, material='steel',
                  fixed=lambda x, y: True, selfContact=False)
    return fe


def main():
    parser = common.Options(__doc__, steps=12000)
    parser.add_argument('--n', type=common.wholeNumber, default=8,
                        help='squares in a row and in a column; default: 8')
    parser.add_argument('--seed', type=common.atLeast(0), default=1, help='default: 1')
    options = parser.parse()
    fe = build(options.n, options.passes, options.seed)
    run, film = common.filmed(fe, options, 'speed', 3)
    print(f'{options.n} × {options.n} squares, {options.collider}, passes={options.passes}')
    run.report()
    if film:
        import pictures
        pictures.frames(film, os.path.join(options.out, 'squares.png'),
                        f'{options.n} × {options.n} steel squares in a rigid frame, a quarter of '
                        f'them starts at {SPEED:g} m/s', columns=2, top=SPEED, cmap='YlOrRd',
                        width=11)
    common.tell(options, 'squares.png')
    return fe


fe = main()
