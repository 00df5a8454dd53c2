"""Sizes of the fragments of expanding rings of three strengths, eight rings each, with confidence bands.

    scripts/yade -n -x examples/small/monte_carlo.py [FOLDER of the picture and the runs] [rings of each strength]

At 10⁴ per second, compared with the result of Zhou, Molinari and Ramesh 2006 (Appl. Phys. Lett. 88,
261917) for rings in one dimension. An interrupted call continues where it stopped: monte_carlo.jsonl.
"""
import math
import os
import sys

import numpy as np
from yadefrag import *

YOUNG, DENSITY, ENERGY, RATE, AROUND, CELLS = 275e9, 2750, 100, 1e4, 50e-3, 900  # Pa, kg/m³, J/m², 1/s, m, -
STRENGTHS, R = (240e6, 300e6, 375e6), AROUND / 2 / math.pi  # Pa, m


def theory(strength):
    """(m) Mean size of a fragment."""
    r = RATE * YOUNG**2 * ENERGY / (math.sqrt(YOUNG / DENSITY) * strength**3)
    return 4.5 * YOUNG * ENERGY / strength**2 / (1 + .77 * r**.25 + 5.4 * r**.75)


def scene(choices):
    strength = choices['strength']
    O.materials.append(BrittleFEMat(young=YOUNG, poisson=0, density=DENSITY, planeStress=True, frictionAngle=0,
                                    tensileStrength=strength, fractureEnergy=ENERGY, strengthScatter=1e-4,
                                    seed=choices['seed']))
    angles, half = 2 * math.pi * np.arange(CELLS) / CELLS, math.pi / CELLS
    nodes = np.concatenate([radius * np.stack([np.cos(a), np.sin(a)], 1) for a, radius in (
        (angles, R * (1 - half)), (angles, R * (1 + half)), (angles + half, R * math.cos(half)))])
    inner, outer, middle = np.arange(3 * CELLS).reshape(3, CELLS)
    corners = [inner, outer, np.roll(outer, -1), np.roll(inner, -1), inner]
    triangles = np.stack([np.stack([a, b, middle], 1) for a, b in zip(corners, corners[1:])], 1)
    fe = FESolver()
    outward = lambda x, y, length: (length * x / math.hypot(x, y), length * y / math.hypot(x, y))
    fe.addTriangles(nodes, triangles.reshape(-1, 3), material=0, velocity=lambda x, y: outward(x, y, RATE * R),
                    displacement=lambda x, y: outward(x, y, .98 * strength / YOUNG * R))
    O.engines, O.dt = [fe], .4 * fe.criticalTimeStep()
    return fe


def sizes(fe):
    """(m) Lengths along the ring."""
    return [AROUND * piece['mass'] / fe.masses.sum() for piece in fe.fragments(held=True)]


if __name__ == '__main__':
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
    runs = [dict(strength=s, seed=k) for s in STRENGTHS for k in range(int(sys.argv[2]) if len(sys.argv) > 2 else 8)]
    table = ensemble(scene, runs, sizes, duration=1.2e-6, resume=os.path.join(folder, 'monte_carlo.jsonl'))
    for row in table.statistics('strength'):
        print('%g MPa: mean size %.4g mm, from %.4g to %.4g mm, theory %.4g mm, %d rings' %
              (row['by'] / 1e6, 1e3 * row['mean'], 1e3 * row['low'], 1e3 * row['high'], 1e3 * theory(row['by']), row['runs']))
    axes = table.plot(by='strength', label='mean size (m), dashed: theory')
    axes.plot(STRENGTHS, list(map(theory, STRENGTHS)), 'k--')
    axes.set_xlabel('strength (Pa)')
    axes.figure.savefig(os.path.join(folder, 'monte_carlo.png'), dpi=120)
