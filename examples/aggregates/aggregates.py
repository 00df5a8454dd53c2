"""A block of mortar with aggregates is compressed: weak interfaces crack, aggregates do not.

    scripts/yade -n -x examples/aggregates/aggregates.py [--steps 3000] [--collider Lebesgue] …

50 mm of mortar with round aggregates, twelve-sided, between ends that approach each other at 2 m/s.
Their interfaces have half the mortar's strength. Plane strain. Writes aggregates.png.
"""
import os
import sys

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import BrittleFEMat, FESolver  # noqa: E402
from yadefrag import circle, plotMesh, rectangle  # noqa: E402

SIDE, SIZE, SPEED, GAP = 50e-3, 1.5e-3, 1., 2e-3  # m, m, m/s, m


def aggregates(random):
    """(x, y, radius) of circles inside the block that do not overlap."""
    placed = []
    for radius in np.repeat([7e-3, 5e-3, 3.5e-3], [4, 7, 12]):
        for _ in range(3000):
            x, y = random.uniform(radius + GAP, SIDE - radius - GAP, 2)
            if all(np.hypot(x - a, y - b) > radius + r + GAP for a, b, r in placed):
                placed.append((x, y, radius))
                break
    return placed


def build(passes):
    O.materials.append(BrittleFEMat(young=20e9, poisson=.2, density=2100, tensileStrength=3e6, fractureEnergy=40,
                                    shearFactor=3, frictionAngle=.6, strengthScatter=.1, label='mortar'))
    O.materials.append(BrittleFEMat(young=60e9, poisson=.2, density=2700, tensileStrength=12e6, fractureEnergy=80,
                                    shearFactor=3, frictionAngle=.6, label='stone'))
    stones = aggregates(np.random.default_rng(2))
    rings = [circle((x, y), radius, 12) for x, y, radius in stones]
    fe = FESolver(passes=passes)
    fe.addPolygon(
        rectangle((0, 0), (SIDE, SIDE)), size=SIZE, jointStrength=None,
        joints=[side for ring in rings for side in zip(ring, np.roll(ring, -1, axis=0))],
        material=lambda x, y: 'stone' if any(np.hypot(x - a, y - b) < .97 * r for a, b, r in stones) else 'mortar',
        interfaceStrength=1.5e6, interfaceEnergy=15, velocity=lambda x, y: (0, SPEED * (1 - 2 * y / SIDE)),
        fixed=lambda x, y: 'y' if y < 1e-9 or y > SIDE - 1e-9 else False)
    return fe


options = common.Options(__doc__, steps=3000).parse()
fe = build(options.passes)
common.setEngines(fe, options.collider)
run = common.Run(fe).go(options.steps)
run.report()
if not options.no_pictures:
    axes = plotMesh(fe, fe.materialNumbers)
    drawn = next(drawn for drawn in axes.collections if drawn.colorbar)
    drawn.colorbar.remove()
    keys = [Patch(color=drawn.to_rgba(number), label=name) for number, name in enumerate(('mortar', 'stone'))]
    axes.legend(handles=[*keys, Line2D([], [], color='r', label='cohesive crack')], ncol=3, frameon=False,
                loc='lower center', bbox_to_anchor=(.5, 1))
    axes.figure.savefig(os.path.join(options.out, 'aggregates.png'), dpi=150)
    common.tell(options, 'aggregates.png')
