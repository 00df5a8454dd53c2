"""Concentric elastic rings with initial velocities in different directions.

    scripts/yade -n -x examples/rings/rings.py [--n 8] [--steps 6000] [--collider Lebesgue] …

The benchmark "rings" of Diekmann et al., ECCOMAS 2000, §6, figure 12: nested rings, the outer ones
with slightly more elements. Here of a rubber (E 50 MPa), 2 mm thick, 0.4 mm apart, smooth, 5 m/s,
no friction. All in SI units, plane strain, per metre of thickness. Writes rings.png.
"""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import FEMat, FESolver  # noqa: E402
from yadefrag import ring  # noqa: E402

INNERMOST, THICKNESS, GAP = 10e-3, 2e-3, .4e-3  # m
SEGMENTS, MORE = 128, 8  # of the innermost ring; additional ones of each next ring
SPEED = 5.  # m/s


def build(n, passes, smooth, seed):
    """n concentric rings; returns the solver."""
    O.materials.append(FEMat(young=50e6, poisson=.4, density=1100, frictionAngle=0, label='rubber'))
    fe = FESolver(passes=passes)
    random = np.random.default_rng(seed)
    for k, angle in enumerate(random.uniform(0, 2 * np.pi, n)):
        inner = INNERMOST + k * (THICKNESS + GAP)
        outer = inner + THICKNESS
        segments = SEGMENTS + MORE * k
        size = 1.05 * 2 * np.pi * outer / segments  # slightly too long to divide a segment
        fe.addPolygon(*ring((0, 0), inner, outer, segments), size=size, material='rubber',
                      smooth=smooth, velocity=SPEED * np.array([np.cos(angle), np.sin(angle)]),
                      selfContact=False)
    return fe


def main():
    parser = common.Options(__doc__, steps=6000)
    parser.add_argument('--n', type=common.wholeNumber, default=8, help='rings; default: 8')
    parser.add_argument('--straight', action='store_true', help='straight instead of smooth')
    parser.add_argument('--seed', type=common.atLeast(0), default=1, help='default: 1')
    options = parser.parse()
    fe = build(options.n, options.passes, not options.straight, options.seed)
    run, film = common.filmed(fe, options, 'mises', 5)
    print(f'{options.n} rings, {"straight" if options.straight else "smooth"}, '
          f'{options.collider}, passes={options.passes}')
    run.report()
    if film:
        import pictures
        top = np.percentile(np.concatenate([s.values for s in film.shots]), 99)
        pictures.frames(film, os.path.join(options.out, 'rings.png'),
                        f'{options.n} rubber rings that start in different directions at '
                        f'{SPEED:g} m/s', columns=3, top=top, unit='ms')
    common.tell(options, 'rings.png')
    return fe


fe = main()
