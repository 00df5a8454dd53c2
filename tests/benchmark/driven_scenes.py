"""Scenes with a bar that stirs and with a hopper of facets, built inside yade; see scenes.py, whose dict they return.

stirred   a block as in `packing`: its outermost spheres are fixed, and a bar of spheres through its middle turns
hopper    an inverted pyramid of facets, filled with spheres, which leave through its open end
"""
import math

import numpy as np
from yade import O
from yade.minieigenHP import Vector3
from yade.utils import facet
from yade.wrapper import Bo1_Facet_Aabb, Ig2_Facet_Sphere_ScGeom, RotationEngine

import scenes
from scenes import RADIUS

PER_STEP = .005 * RADIUS  # m, of the ends of the bar
SIDES = ((1, 0), (-1, 0), (0, 1), (0, -1))  # where the hopper's four walls are, seen from above
SLOPE = math.tan(math.radians(60))  # of the walls
OPENING = 6 * RADIUS  # m, half of the width of the open end
FACET = 10 * RADIUS  # m, about the length of a facet


def stirred(n, seed):
    """Spheres in random order; `turning` is the engine that moves the bar."""
    rng = np.random.default_rng(seed)
    positions = rng.permutation(scenes._block(rng, n))
    half = np.abs(positions).max()
    reach = .75 * half
    skin = scenes._skin(positions)
    bar = (np.abs(positions[:, 1]) < 2.2 * RADIUS) & (np.abs(positions[:, 2]) < .8 * half) & ~skin
    bar &= np.hypot(positions[:, 0], positions[:, 1]) < reach
    material = scenes._material(1e7)
    for position, fixed in zip(positions.tolist(), (skin | bar).tolist()):
        O.bodies.append(scenes._sphere(position, RADIUS, (0, 0, 0), material, 'xyzXYZ' if fixed else ''))
    parts = scenes._parts(1e7, damping=.2)
    speed = PER_STEP / parts['dt'] / reach
    turning = RotationEngine(ids=np.flatnonzero(bar).tolist(), angularVelocity=speed, rotationAxis=(0, 0, 1),
                             zeroPoint=(0, 0, 0), rotateAroundZero=True)
    return dict(parts, turning=turning)


def hopper(n, seed):
    """n spheres of `packing`'s lattice in a hopper, all with .3 m/s downwards, under gravity.

    Its walls rise by 60 degrees from an opening 12 radii wide, and are divided into facets about 10 radii long.
    """
    rng = np.random.default_rng(seed)
    positions = _filled(rng, n)
    material = scenes._material(1e7)
    scenes._addSpheres(rng, positions, np.full(n, RADIUS), np.tile([0, 0, -.3], (n, 1)), material)
    for corners in facets(positions[:, 2].max() + 2 * RADIUS):
        O.bodies.append(facet([Vector3(*corner) for corner in corners], material=material))
    parts = scenes._parts(1e7, damping=0)
    parts['bound'].append(Bo1_Facet_Aabb())
    parts['geom'].append(Ig2_Facet_Sphere_ScGeom())
    parts['newton']['gravity'] = (0, 0, -9.81)
    return parts


def walls():
    """Points on the four walls, and normals to the inside, (4, 3) each."""
    points = np.array([(x * OPENING, y * OPENING, 0) for x, y in SIDES])
    normals = np.array([(-x * SLOPE, -y * SLOPE, 1) for x, y in SIDES]) / math.hypot(SLOPE, 1)
    return points, normals


def _filled(rng, n):
    """(n, 3): sites of a turned lattice that touch or clear the walls, the lowest ones above the opening."""
    points, normals = walls()
    # Volume of the pyramid up to a height h: (W³ - w³) SLOPE / 6 with the width W = w + 2 h / SLOPE.
    volume = n * 4 / 3 * math.pi * RADIUS ** 3 / .5
    width = ((2 * OPENING) ** 3 + 6 * volume / SLOPE) ** (1 / 3)
    height = (width - 2 * OPENING) * SLOPE / 2
    edge = max(width, height) * 1.3
    sites = scenes._block(rng, int(edge ** 3 * .6 / (4 / 3 * math.pi * RADIUS ** 3)))
    sites[:, 2] += edge / 2 - .1 * edge
    inside = sites[:, 2] > RADIUS
    for point, normal in zip(points, normals):
        inside &= (sites - point) @ normal > (1 - 1e-3) * RADIUS
    sites = sites[inside]
    if len(sites) < n:
        raise RuntimeError(f'the hopper has room for {len(sites)} spheres, not {n}')
    return sites[np.argsort(sites[:, 2])[:n]]


def facets(height):
    """Corners (m, 3, 3) of the walls' triangles, up to a height."""
    rows = max(1, round(height * math.hypot(1, 1 / SLOPE) / FACET))
    levels = np.linspace(0, height, rows + 1)
    columns = max(1, round((OPENING + height / SLOPE / 2) * 2 / FACET))
    across = np.linspace(-1, 1, columns + 1)
    found = []
    for x, y in SIDES:
        half = OPENING + levels / SLOPE
        grid = np.array([[(x * h - y * h * a, y * h + x * h * a, z) for a in across] for h, z in zip(half, levels)])
        a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
        found += [np.stack(corners, axis=2).reshape(-1, 3, 3) for corners in ((a, b, c), (a, c, d))]
    return np.concatenate(found)
