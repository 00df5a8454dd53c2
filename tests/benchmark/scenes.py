"""Scenes for the benchmark, built inside yade from a seed.

Every builder is called as builder(n, seed), appends bodies to O.bodies (which should be empty) and
returns a dict:

    bound, geom, phys, law   lists of functors
    newton                   keyword arguments for NewtonIntegrator
    dt                       time step, s
    perStep                  None, or a function of the step number, called before each step

SI units. The smallest sphere has the radius RADIUS. Lattices are turned at random, so that neither
a sweep along the axes nor a grid meets rows of equal coordinates by chance, and bodies are appended
in random order (a collider gets no ready-made neighbourhoods in memory).
"""
import functools
import math

import numpy as np
from yade import O
from yade.wrapper import (
    Bo1_Sphere_Aabb, Body, FrictMat, Ig2_Sphere_Sphere_ScGeom, Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack, Sphere)

RADIUS = 1e-3  # m
DENSITY = 2600.0  # kg/m3
SPEED = 1.0  # m/s, standard deviation of each velocity component in a gas


def gas(n, seed, speed=SPEED):
    """A loose cloud of n equal spheres, volume fraction .1, free to expand.

    Sites are drawn from a lattice 7.5 % wider than the spheres. Velocities are normal, 1 m/s per
    component; young 10 MPa; a sphere moves .005 radii per step. No damping.
    """
    rng = np.random.default_rng(seed)
    spacing = 2.15 * RADIUS
    positions = _lattice(rng, n, spacing, _occupancy(.1, spacing, 1))
    _addSpheres(rng, positions, np.full(n, RADIUS), rng.normal(0, speed, (n, 3)), _material(1e7))
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


def polydisperse(n, seed, ratio=20., speed=SPEED):
    """A gas of n spheres with radii from RADIUS to RADIUS * ratio, volume fraction .25.

    The volume is spread evenly over the logarithm of the radius (each octave of radii holds the
    same volume), so most spheres are small; one has the largest radius. Velocities as in `gas`,
    whatever the size. (Few bodies and a large ratio: the cube is at least 2.5 of the largest
    diameters wide, and the volume fraction less.)
    """
    rng = np.random.default_rng(seed)
    positions, radii = _sizeClasses(rng, n, ratio, .25)
    _addSpheres(rng, positions, radii, rng.normal(0, speed, (n, 3)), _material(1e7))
    return _parts(1e7, damping=0)


def clusters(n, seed):
    """Two dense blocks 20 block edges apart, and 1 % of the n spheres far outside.

    The blocks are as in `packing` and approach each other at 1 m/s each (their outermost spheres
    keep that velocity). The outliers are spread over a cube of 100 block edges, with velocities as
    in `gas`. Young 10 MPa, no damping.
    """
    rng = np.random.default_rng(seed)
    nOut = max(1, n // 100)
    halves = ((n - nOut) // 2, n - nOut - (n - nOut) // 2)
    edge = (max(halves) * 4 / 3 * math.pi * RADIUS ** 3 / .6) ** (1 / 3)
    positions, velocities, skins = [], [], []
    for m, side in zip(halves, (-1, 1)):
        block = _block(rng, m)
        skin = _skin(block)
        velocity = rng.normal(0, .02, (m, 3))
        velocity[skin] = 0
        positions.append(block + [side * 10 * edge, 0, 0])
        velocities.append(velocity - [side * SPEED, 0, 0])
        skins.append(skin)
    out = rng.uniform(-50, 50, (4 * nOut, 3)) * edge
    positions.append(out[np.abs(out).max(axis=1) > 12 * edge][:nOut])
    velocities.append(rng.normal(0, SPEED, (nOut, 3)))
    skins.append(np.zeros(nOut, bool))
    _addSpheres(rng, np.concatenate(positions), np.full(n, RADIUS), np.concatenate(velocities),
                _material(1e7), np.where(np.concatenate(skins), 'xyzXYZ', ''))
    return _parts(1e7, damping=0)


def plane(n, seed):
    """Plane impact: n - 1 spheres with centres at z = 0 hit by one of ten times their radius.

    A square piece of a triangular lattice (touching: neighbours overlap by .01 %), at rest. The
    projectile comes along x at 60 m/s and touches after about 10 steps. z and the rotations about x
    and y are blocked. Young 1 GPa (the projectile moves .03 radii per step), damping .1.
    """
    rng = np.random.default_rng(seed)
    positions = _triangular(rng, n - 1, 2 * RADIUS * (1 - 1e-4))
    big = 10 * RADIUS
    start = [_startOf(positions, big) - .3 * RADIUS, 0, 0]
    radii = np.append(np.full(n - 1, RADIUS), big)
    velocities = np.zeros((n, 3))
    velocities[-1] = [60, 0, 0]
    _addSpheres(rng, np.vstack([positions, start]), radii, velocities, _material(1e9),
                np.full(n, 'zXY'))
    return _parts(1e9, damping=.1)


def projectile(n, seed):
    """A dense block of n - 1 spheres hit by one at 100 times the speed of the thermal jitter.

    The block as in `packing`, but with nothing fixed on the side that is hit, and with velocities
    of .3 m/s per component; the projectile has three times the radius, comes along x at 30 m/s and
    touches after about 10 steps. Young 100 MPa (it moves .045 radii per step), damping .1.
    """
    rng = np.random.default_rng(seed)
    positions = _block(rng, n - 1)
    big = 3 * RADIUS
    start = [_startOf(positions, big) - .45 * RADIUS, 0, 0]
    radii = np.append(np.full(n - 1, RADIUS), big)
    skin = _skin(positions) & (positions[:, 0] > positions[:, 0].min() + 2.2 * RADIUS)
    velocities = np.vstack([rng.normal(0, .3, (n - 1, 3)), [30, 0, 0]])
    velocities[:-1][skin] = 0
    _addSpheres(rng, np.vstack([positions, start]), radii, velocities, _material(1e8),
                np.append(np.where(skin, 'xyzXYZ', ''), ''))
    return _parts(1e8, damping=.1)


def insertion(n, seed, perStep=10):
    """`gas`, and 10 bodies more appended before each step.

    The new spheres come from a square nozzle 10 radii beside the cloud, 15 sites wide, that draws
    back along x as it fills its layers, at the cloud's density and speeds.
    """
    rng = np.random.default_rng(seed)
    spacing = 2.15 * RADIUS
    positions = _lattice(rng, n, spacing, _occupancy(.1, spacing, 1))
    material = _material(1e7)
    _addSpheres(rng, positions, np.full(n, RADIUS), rng.normal(0, SPEED, (n, 3)), material)
    sites = _nozzle(rng, positions[:, 0].max() + 10 * RADIUS, 15, .1)

    def append(step):
        for _ in range(perStep):
            body = _sphere(next(sites), RADIUS, rng.normal(0, SPEED, 3).tolist(), material)
            O.bodies.append(body)

    parts = _parts(1e7, damping=0)
    parts['perStep'] = append
    return parts


def exchange(n, seed, perStep=100):
    """`insertion` of 100 bodies before each step, while as many others are erased."""
    parts = insertion(n, seed, perStep)
    rng, append = np.random.default_rng(seed + 1), parts['perStep']
    alive = list(rng.permutation(n))

    def step(number):
        first = len(O.bodies)
        append(number)
        alive.extend(range(first, len(O.bodies)))
        for _ in range(perStep):
            place = int(rng.integers(len(alive)))
            alive[place], alive[-1] = alive[-1], alive[place]
            O.bodies.erase(int(alive.pop()))

    parts['perStep'] = step
    return parts


def rest(n, seed):
    """`packing` with nothing fixed and nothing in motion, but for one sphere far outside."""
    rng = np.random.default_rng(seed)
    positions = _block(rng, n - 1)
    far = [2 * positions[:, 0].max(), 0, 0]
    velocities = np.zeros((n, 3))
    velocities[-1] = [10 * SPEED, 0, 0]
    # Without contact, so that they stay at rest.
    _addSpheres(rng, np.vstack([positions * 1.01, far]), np.full(n, RADIUS), velocities,
                _material(1e7))
    return _parts(1e7, damping=0)


SCENES = {**{f.__name__: f for f in (gas, packing, polydisperse, clusters, plane, projectile, insertion, exchange, rest)},
          # At a quarter and four times the speed; radii 1:50.
          **{f'{f.__name__}{name}': functools.partial(f, speed=part * SPEED) for f in (gas, polydisperse)
             for name, part in (('025', .25), ('4', 4))}, 'polydisperse50': functools.partial(polydisperse, ratio=50.)}


def build(name, n, seed):
    """Reset YADE, build the scene `name` with n bodies, set O.dt; return its dict.

    Raises ValueError for an unknown scene or fewer than 100 bodies.
    """
    if name not in SCENES:
        raise ValueError(f"scene is {name!r}; it must be one of {', '.join(SCENES)}")
    if n < 100:
        raise ValueError(f'n is {n}; a scene needs at least 100 bodies')
    O.reset()
    parts = SCENES[name](n, seed)
    O.dt = parts['dt']
    return parts


# --- materials and bodies -------------------------------------------------------------------------
def _material(young):
    material = FrictMat(young=young, poisson=.3, density=DENSITY, frictionAngle=.3)
    O.materials.append(material)
    return material


def _parts(young, damping):
    return dict(bound=[Bo1_Sphere_Aabb()], geom=[Ig2_Sphere_Sphere_ScGeom()],
                phys=[Ip2_FrictMat_FrictMat_FrictPhys()],
                law=[Law2_ScGeom_FrictPhys_CundallStrack()], newton=dict(damping=damping),
                dt=.3 * RADIUS * math.sqrt(DENSITY / young), perStep=None)


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


def _triangular(rng, n, spacing):
    """n sites (n, 3) of a turned triangular lattice at z = 0 in a square around the origin."""
    reach = int(math.sqrt(n)) + 4
    i, j = np.meshgrid(np.arange(-reach, reach + 1), np.arange(-reach, reach + 1))
    x = (i + .5 * (j % 2)).ravel() * spacing
    y = j.ravel() * (spacing * math.sqrt(.75))
    angle = rng.uniform(0, math.pi / 3)
    c, s = math.cos(angle), math.sin(angle)
    return _nearest(np.stack([c * x - s * y, s * x + c * y, np.zeros_like(x)], axis=1), n)


def _startOf(positions, radius):
    """x at which a sphere of this radius, coming along the x axis, touches the block."""
    off = np.hypot(positions[:, 1], positions[:, 2])
    near = off < radius + RADIUS
    touch = positions[near, 0] - np.sqrt((radius + RADIUS) ** 2 - off[near] ** 2)
    return touch.min()


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


def _nozzle(rng, start, side, fraction):
    """Endless generator of sites (lists of 3): square layers, side x side, from x = start on."""
    spacing = 3.4 * RADIUS
    count = round(side ** 2 * _occupancy(fraction, spacing, 1))
    layer = 0
    while True:
        y, z = np.divmod(rng.permutation(side ** 2)[:count], side)
        x = np.full(count, start + layer * spacing)
        y, z = (y - side / 2) * spacing, (z - side / 2) * spacing
        yield from np.stack([x, y, z], axis=1).tolist()
        layer += 1
