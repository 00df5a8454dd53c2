"""Expanding ceramic rings break: the mean size of their fragments relative to the formula.

s/s₀ = 4.5 / (1 + 0.77 ė^0.25 + 5.4 ė^0.75), s₀ = E·Gc/σc², ė = ε̇/ė₀, ė₀ = c·σc³/(E²·Gc), of Zhou,
Molinari and Ramesh 2006, for a ring in one dimension; a fit. Seeds differ by 5 %: three rings.
"""
import math

import numpy as np

from yadefrag import circle

YOUNG, DENSITY, STRENGTH, ENERGY = 275e9, 2750, 300e6, 100  # Pa, kg/m³, Pa, J/m²
AROUND, RATE, DURATION, RINGS = 50e-3, 1e4, 1e-6, 3  # m, 1/s, s
RADIUS = AROUND / (2 * math.pi)
WAVE = math.sqrt(YOUNG / DENSITY)


def expected():
    """(m) The mean size by the formula."""
    rate = RATE / (WAVE * STRENGTH**3 / (YOUNG**2 * ENERGY))
    return 4.5 * YOUNG * ENERGY / STRENGTH**2 / (1 + .77 * rate**.25 + 5.4 * rate**.75)


def ring(count):
    """`count` square cells around, each divided into four triangles: (nodes, triangles)."""
    angles = 2 * np.pi * np.arange(count) / count
    width = AROUND / count
    radii = RADIUS - width / 2, RADIUS + width / 2, RADIUS * math.cos(math.pi / count)
    turned = angles, angles, angles + np.pi / count
    nodes = np.concatenate([r * np.stack([np.cos(a), np.sin(a)], axis=1)
                            for r, a in zip(radii, turned)])
    here = np.arange(count)
    after, middle = np.roll(here, -1), here + 2 * count
    corners = np.stack([here, here + count, after + count, after], axis=1)
    return nodes, np.concatenate([np.stack([corners[:, k], corners[:, (k + 1) % 4], middle], axis=1)
                                  for k in range(4)])


def out(centre, factor):
    """A field that points away from the centre, with the length `factor` × radius."""
    def along(x, y):
        scale = factor * RADIUS / math.hypot(x - centre, y)
        return scale * (x - centre), scale * y
    return along


def scene(choices):
    """The rings beside each other, expanding, just below their strength."""
    fe = choices.solver()
    count, kind = round(AROUND / choices.size(1e-4)), choices.get('mesh', 'crossed')
    for seed in range(1, RINGS + 1):
        material = choices.material(
            young=YOUNG, poisson=0, density=DENSITY, frictionAngle=0, planeStress=True,
            tensileStrength=STRENGTH, fractureEnergy=ENERGY, strengthScatter=1e-4, seed=seed)
        centre = 4 * RADIUS * seed
        of = dict(material=material, element=choices.get('element', 'linear'),
                  velocity=out(centre, RATE), displacement=out(centre, .98 * STRENGTH / YOUNG))
        if kind == 'crossed':
            nodes, triangles = ring(count)
            fe.addTriangles(nodes + (centre, 0), triangles, **of)
        else:
            width = AROUND / count
            outer, inner = (circle((centre, 0), RADIUS + side * width / 2, count)
                            for side in (1, -1))
            fe.addPolygon(outer, holes=[inner], size=width, mesh=kind, meshSeed=seed, **of)
    choices.engines(fe)
    return fe


def measure(fe):
    """Mean size of the parts that no cohesive crack connects, relative to the formula."""
    return RINGS * AROUND / len(fe.fragments(held=True)) / expected()


VARY = [{},
        {'fracture': ['instant']},
        {'size': [2e-4, 5e-5]},
        {'fracture': ['instant'], 'size': [2e-4, 5e-5]},
        {'timeStep': [.98, .2]},
        {'plane': ['strain']},
        {'bulkViscosity': [1.]},
        {'passes': [2]},
        {'collider': ['none', 'InsertionSortCollider']},
        {'threads': [2]},
        {'mesh': ['irregular']},
        {'element': ['smoothed']}]
ARGUMENTS = dict(duration=DURATION, reference=1.,
                 title='Expanding ring: error of the fragments\' mean size')
