"""Slender elastic bars that are folded by a heavy block.

    scripts/yade -n -x examples/bars/bars.py [--n 8] [--steps 5000] [--collider Lebesgue] …

The benchmark "bars" of Diekmann et al., ECCOMAS 2000, §6, figure 13: elastic bars are compressed by
a heavy block and interfolded. Here rubber bars (E 5 MPa), 2 × 60 mm, 0.5 mm apart and each slightly
wavy, stand between walls on a rigid floor; the block above falls on them at 10 m/s and does not
rotate. Friction 0.2, the bars touch themselves. All in SI units, plane strain, per metre of
thickness. Writes bars.png.
"""
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import FEMat, FESolver  # noqa: E402
from yadefrag import rectangle, rectangleMesh  # noqa: E402

LENGTH, THICKNESS, GAP = 60e-3, 2e-3, .5e-3  # m
CELLS = 60, 2  # along and across a bar
WAVE = .4e-3  # m, amplitude of a bar's middle line
SIDE, WALL, BLOCK = 4e-3, 3e-3, 15e-3  # m: free space beside the bars, thickness of wall and block
SPEED = 10.  # m/s


def build(n, passes, seed):
    """n bars in a trough, and the block above them; returns the solver."""
    O.materials.append(FEMat(young=5e6, poisson=.4, density=1100, frictionAngle=math.atan(.2),
                             label='rubber'))
    O.materials.append(FEMat(young=5e8, poisson=.3, density=7800, frictionAngle=math.atan(.2),
                             label='heavy'))
    fe = FESolver(passes=passes)
    random = np.random.default_rng(seed)
    for k in range(n):
        addBar(fe, SIDE + k * (THICKNESS + GAP), *random.uniform(-1, 1, 2))
    right = 2 * SIDE + n * (THICKNESS + GAP) - GAP
    top = LENGTH + GAP + BLOCK
    trough = [(-WALL, -WALL), (right + WALL, -WALL), (right + WALL, top), (right, top), (right, 0),
              (0, 0), (0, top), (-WALL, top)]
    fe.addPolygon(trough, size=1e-3, material='heavy', fixed=lambda x, y: True, selfContact=False)
    fe.addPolygon(rectangle((.3e-3, LENGTH + GAP), (right - .3e-3, top)), size=1.5e-3,
                  material='heavy', velocity=(0, -SPEED), fixed=lambda x, y: 'x', selfContact=False)
    return fe


def addBar(fe, left, one, two):
    """A bar whose middle line is the sum of two sine waves with the amplitudes one and two ×
    WAVE."""
    nodes, triangles = rectangleMesh((0, GAP / 10), (THICKNESS, GAP / 10 + LENGTH), CELLS[1],
                                     CELLS[0], crossed=True)
    y = nodes[:, 1] * np.pi / LENGTH
    nodes = nodes + np.stack([left + WAVE * .25 * (one * np.sin(2 * y) + two * np.sin(3 * y)),
                              0 * y], axis=1)
    fe.addTriangles(nodes, triangles, material='rubber')


def main():
    parser = common.Options(__doc__, steps=5000)
    parser.add_argument('--n', type=common.wholeNumber, default=8, help='bars; default: 8')
    parser.add_argument('--seed', type=common.atLeast(0), default=1, help='default: 1')
    options = parser.parse()
    fe = build(options.n, options.passes, options.seed)
    run, film = common.filmed(fe, options, 'mises', 5)
    print(f'{options.n} bars, {options.collider}, passes={options.passes}')
    run.report()
    if film:
        import pictures
        top = np.percentile(np.concatenate([s.values for s in film.shots]), 99)
        pictures.frames(film, os.path.join(options.out, 'bars.png'),
                        f'{options.n} rubber bars under a heavy block that falls at {SPEED:g} m/s',
                        columns=6, top=top, unit='ms', outline=.4)
    common.tell(options, 'bars.png')
    return fe


fe = main()
