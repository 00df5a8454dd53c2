"""Scenes for codes_yade.py, built inside yade from a seed.

gas, packing, polydisperse   spheres alone
mindlin   a block as in `packing`, with the law of Hertz and Mindlin
stirred   a block as in `packing`: its outermost spheres are fixed, and a bar of spheres through its middle turns
hopper    an inverted pyramid of facets, filled with spheres, which leave through its open end

Every builder is called as builder(n, seed), appends bodies to O.bodies (which should be empty) and
returns a dict:

    bound, geom, phys, law   lists of functors
    newton                   keyword arguments for NewtonIntegrator
    dt                       time step, s
    turning                  the engine that moves the bar, if there is one

SI units. The smallest sphere has the radius RADIUS. Lattices are turned at random, so that neither
a sweep along the axes nor a grid meets rows of equal coordinates by chance, and bodies are appended
in random order (a collider gets no ready-made neighbourhoods in memory).
"""
import math

import numpy as np
from yade import O
from yade.minieigenHP import Vector3
from yade.utils import facet
from yade.wrapper import (
    Bo1_Facet_Aabb, Bo1_Sphere_Aabb, Body, FrictMat, Ig2_Facet_Sphere_ScGeom, Ig2_Sphere_Sphere_ScGeom,
    Ip2_FrictMat_FrictMat_FrictPhys, Ip2_FrictMat_FrictMat_MindlinPhys, Law2_ScGeom_FrictPhys_CundallStrack,
    Law2_ScGeom_MindlinPhys_Mindlin, RotationEngine, Sphere)

RADIUS = 1e-3  # m
DENSITY = 2600.0  # kg/m3
SPEED = 1.0  # m/s, standard deviation of each velocity component in a gas
PER_STEP = .005 * RADIUS  # m, of the ends of the bar
SIDES = ((1, 0), (-1, 0), (0, 1), (0, -1))  # where the hopper's four walls are, seen from above
SLOPE = math.tan(math.radians(60))  # of the walls
OPENING = 6 * RADIUS  # m, half of the width of the open end
FACET = 10 * RADIUS  # m, about the length of a facet


def gas(n, seed):
    """A loose cloud of n equal spheres, volume fraction .1, free to expand.

    Sites are drawn from a lattice 7.5 % wider than the spheres. Velocities are normal, 1 m/s per
    component; young 10 MPa; a sphere moves .005 radii per step. No damping.
    """
    rng = np.random.default_rng(seed)
    spacing = 2.15 * RADIUS
    positions = _lattice(rng, n, spacing, _occupancy(.1, spacing, 1))
    _addSpheres(rng, positions, np.full(n, RADIUS), rng.normal(0, SPEED, (n, 3)), _material(1e7))
    return _parts(1e7, damping=0)


def packing(n, seed):
    """A dense block of n equal spheres, volume fraction .6, nearly at rest.

    A face-centred lattice with a fifth of its sites empty, neighbours overlapping by .1 % (about 9
    contacts per sphere). The outermost spheres are fixed and hold the block together; the others
    have normal velocities, .02 m/s per component. Young 10 MPa, damping .2.
    """
    rng = np.random.default_rng(seed)
    positions = _block(rng, n)
    velocities = rng.normal(0, .02, (n, 3))
    skin = _skin(positions)
    velocities[skin] = 0
    _addSpheres(rng, positions, np.full(n, RADIUS), velocities, _material(1e7),
                np.where(skin, 'xyzXYZ', ''))
    return _parts(1e7, damping=.2)


def mindlin(n, seed):
    """As `packing`; young 100 MPa."""
    parts = packing(n, seed)
    O.materials[0].young = 1e8
    return {**parts, 'phys': [Ip2_FrictMat_FrictMat_MindlinPhys()], 'law': [Law2_ScGeom_MindlinPhys_Mindlin()],
            'dt': _timeStep(1e8)}


def polydisperse(n, seed, ratio=20.):
    """A gas of n spheres with radii from RADIUS to RADIUS * ratio, volume fraction .25.

    The volume is spread evenly over the logarithm of the radius (each octave of radii holds the
    same volume), so most spheres are small; one has the largest radius. Velocities as in `gas`,
    whatever the size. (Few bodies and a large ratio: the cube is at least 2.5 of the largest
    diameters wide, and the volume fraction less.)
    """
    rng = np.random.default_rng(seed)
    positions, radii = _sizeClasses(rng, n, ratio, .25)
    _addSpheres(rng, positions, radii, rng.normal(0, SPEED, (n, 3)), _material(1e7))
    return _parts(1e7, damping=0)


def stirred(n, seed):
    """Spheres in random order; `turning` is the engine that moves the bar."""
    rng = np.random.default_rng(seed)
    positions = rng.permutation(_block(rng, n))
    half = np.abs(positions).max()
    reach = .75 * half
    skin = _skin(positions)
    bar = (np.abs(positions[:, 1]) < 2.2 * RADIUS) & (np.abs(positions[:, 2]) < .8 * half) & ~skin
    bar &= np.hypot(positions[:, 0], positions[:, 1]) < reach
    material = _material(1e7)
    for position, fixed in zip(positions.tolist(), (skin | bar).tolist()):
        O.bodies.append(_sphere(position, RADIUS, (0, 0, 0), material, 'xyzXYZ' if fixed else ''))
    parts = _parts(1e7, damping=.2)
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
    material = _material(1e7)
    _addSpheres(rng, positions, np.full(n, RADIUS), np.tile([0, 0, -.3], (n, 1)), material)
    for corners in facets(positions[:, 2].max() + 2 * RADIUS):
        O.bodies.append(facet([Vector3(*corner) for corner in corners], material=material))
    parts = _parts(1e7, damping=0)
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
    sites = _block(rng, int(edge ** 3 * .6 / (4 / 3 * math.pi * RADIUS ** 3)))
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


# --- materials and bodies -------------------------------------------------------------------------
def _material(young):
    material = FrictMat(young=young, poisson=.3, density=DENSITY, frictionAngle=.3)
    O.materials.append(material)
    return material


def _timeStep(young):
    return .3 * RADIUS * math.sqrt(DENSITY / young)


def _parts(young, damping):
    return dict(bound=[Bo1_Sphere_Aabb()], geom=[Ig2_Sphere_Sphere_ScGeom()],
                phys=[Ip2_FrictMat_FrictMat_FrictPhys()],
                law=[Law2_ScGeom_FrictPhys_CundallStrack()], newton=dict(damping=damping),
                dt=_timeStep(young))


def _sphere(position, radius, velocity, material, blocked=''):
    """One sphere as utils.sphere makes it, in a third of the time."""
    body, shape = Body(), Sphere()
    shape.radius = radius
    body.shape = shape
    body.mat = material
    state = body.state
    state.pos = state.refPos = position
    state.vel = velocity
    mass = 4 / 3 * math.pi * radius ** 3 * DENSITY
    inertia = .4 * mass * radius ** 2
    state.mass = mass
    state.inertia = (inertia, inertia, inertia)
    state.blockedDOFs = blocked
    return body


def _addSpheres(rng, positions, radii, velocities, material, blocked=None):
    order = rng.permutation(len(positions))
    blocked = np.full(len(positions), '') if blocked is None else blocked
    columns = (positions, radii, velocities, blocked)
    for position, radius, velocity, dofs in zip(*[c[order].tolist() for c in columns]):
        O.bodies.append(_sphere(position, radius, velocity, material, dofs))


# --- placement ------------------------------------------------------------------------------------
def _occupancy(fraction, spacing, perCell):
    """Share of the lattice sites to fill for this volume fraction."""
    return fraction * spacing ** 3 / (perCell * 4 / 3 * math.pi * RADIUS ** 3)


def _block(rng, n):
    """n face-centred sites (n, 3), volume fraction .6, neighbours overlapping by .1 %."""
    spacing = 2 * RADIUS * (1 - 1e-3) * math.sqrt(2)
    basis = [(0, 0, 0), (0, .5, .5), (.5, 0, .5), (.5, .5, 0)]
    return _lattice(rng, n, spacing, _occupancy(.6, spacing, len(basis)), basis)


def _skin(positions):
    """Which positions (n, 3) of a cube around the origin lie within 2.2 radii of its faces."""
    distance = np.abs(positions).max(axis=1)
    return distance > distance.max() - 2.2 * RADIUS


def _lattice(rng, n, spacing, occupancy, basis=((0, 0, 0),)):
    """n random sites (n, 3) of a turned cubic lattice in a cube around the origin."""
    edge = (n * spacing ** 3 / (occupancy * len(basis))) ** (1 / 3)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    reach = np.ceil(np.abs(turn).sum(axis=1) * edge * .55 / spacing).astype(int) + 2
    parts = []
    for shift in basis:
        taken = rng.random(2 * reach + 1, dtype=np.float32) < occupancy
        parts.append((np.argwhere(taken) - reach + shift) @ (turn * spacing))
    return _nearest(np.concatenate(parts), n)


def _nearest(sites, n):
    """The n sites nearest to the origin in the largest coordinate, so the outline is a cube."""
    distance = np.abs(sites).max(axis=1)
    return sites[np.argpartition(distance, n - 1)[:n]]


def _sizeClasses(rng, n, ratio, fraction):
    """Positions (n, 3) and radii (n) of spheres from RADIUS to RADIUS * ratio that do not overlap.

    Half an octave of radii at a time, the largest first: each takes random sites of a lattice of
    its own, among those that clear every larger sphere.
    """
    radii = -np.sort(-_radii(rng, n, RADIUS, RADIUS * ratio))
    radii[0] = RADIUS * ratio
    edge = max((4 / 3 * math.pi * (radii ** 3).sum() / fraction) ** (1 / 3), 5 * radii[0])
    positions = np.empty((n, 3))
    bounds = [0]
    while bounds[-1] < n:
        first = bounds[-1]
        top = radii[first] * 1.01
        last = int(np.searchsorted(-radii, -top / math.sqrt(2)))
        free = _freeSites(positions, radii, bounds, top, edge)
        if len(free) < last - first:
            raise RuntimeError(f'no room for {last - first} spheres of radius {top}: {len(free)}')
        positions[first:last] = free[rng.permutation(len(free))[:last - first]]
        bounds.append(last)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return positions @ turn, radii


def _freeSites(positions, radii, bounds, radius, edge):
    """Lattice sites (m, 3) in the cube [0, edge]^3 where a sphere meets none of those placed."""
    spacing = 2 * radius
    side = max(1, int(edge / spacing))
    free = np.ones((side,) * 3, bool)
    for first, last in zip(bounds, bounds[1:]):
        reach = int((radii[first] + radius) / spacing + .5) + 1
        offsets = np.argwhere(np.ones((2 * reach + 1,) * 3, bool)) - reach
        chunk = max(1, 2000000 // len(offsets))
        for i in range(first, last, chunk):
            centres = positions[i:min(i + chunk, last), None, :]
            near = np.rint(centres / spacing - .5).astype(int) + offsets
            gaps = ((near + .5) * spacing - centres)
            hit = np.einsum('ijk,ijk->ij', gaps, gaps) < (
                radii[i:min(i + chunk, last), None] + radius) ** 2
            hit &= ((near >= 0) & (near < side)).all(axis=2)
            x, y, z = near[hit].T
            free[x, y, z] = False
    return (np.argwhere(free) + .5) * spacing


def _radii(rng, n, low, high):
    """n radii with density proportional to r^-4 (equal volume per log radius)."""
    u = rng.random(n)
    return (low ** -3 + u * (high ** -3 - low ** -3)) ** (-1 / 3)


