"""Builders and checks shared by the in-yade tests, and true sphere-sphere contacts from centres and radii alone.
All lengths in m, times in s."""
import builtins
import itertools

import numpy as np
import yade.timing  # noqa: F401  for tests
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Matrix3, Vector3

O = builtins.O


def clear():
    """An empty aperiodic scene with no engines, timing off."""
    O.reset()
    O.engines = []
    O.periodic = False
    O.timingEnabled = False
    O.stopAtIter = 0
    O.dt = 1e-3
    O.bodies.enableRedirection = False


def makeCollider(name, functors=None, **attributes):
    """A collider of class `name` with `functors` (default: spheres, facets, boxes, walls)."""
    if name.startswith('InsertionSort'):
        cls = getattr(w, name)
    else:
        import yadefrag
        cls = getattr(yadefrag, name)
    if functors is None:
        functors = [w.Bo1_Sphere_Aabb(), w.Bo1_Facet_Aabb(), w.Bo1_Box_Aabb(), w.Bo1_Wall_Aabb()]
    return cls(functors, **attributes)


def loop(name='InteractionLoop'):
    """An interaction loop for spheres, facets, boxes and walls; contacts go when they open."""
    return getattr(w, name)(
        [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Facet_Sphere_ScGeom(), w.Ig2_Box_Sphere_ScGeom(),
         w.Ig2_Wall_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()])


def setEngines(collider, *more, newton=True, interactionLoop=None):
    """The usual loop around `collider`; `more` engines run before the integrator. Gives it back."""
    engines = [w.ForceResetter(), collider, interactionLoop or loop(), *more]
    if newton:
        engines.append(newton if newton is not True else w.NewtonIntegrator(damping=0))
    O.engines = engines
    return collider


def addSpheres(centres, radii, velocities=None, dynamic=False, **attributes):
    """Spheres; those not `dynamic` keep their velocity whatever forces act. Returns the ids."""
    n = len(centres)
    bodies = []
    for k in range(n):
        body = utils.sphere(Vector3(*map(float, centres[k])), float(radii[k]), **attributes)
        if velocities is not None:
            body.state.vel = Vector3(*map(float, velocities[k]))
        if not dynamic:
            body.state.blockedDOFs = 'xyzXYZ'
        bodies.append(body)
    return list(O.bodies.append(bodies))


def spheresNow():
    """(centres (n,3), radii (n)) by body id; NaN where there is no sphere."""
    n = len(O.bodies)
    centres, radii = np.full((n, 3), np.nan), np.full(n, np.nan)
    for body in O.bodies:
        if isinstance(body.shape, w.Sphere) and body.bounded:
            centres[body.id] = body.state.pos
            radii[body.id] = body.shape.radius
    return centres, radii


def realPairs():
    """{(id1, id2) sorted: cellDist of the larger id} of all real interactions."""
    pairs = {}
    for i in O.interactions:
        sign = 1 if i.id1 < i.id2 else -1
        pairs[tuple(sorted((i.id1, i.id2)))] = tuple(sign * int(c) for c in i.cellDist)
    return pairs


def allPairs():
    """The set of (id1, id2), sorted, of all interactions, potential ones included."""
    return {tuple(sorted((i.id1, i.id2))) for i in O.interactions.all()}


def stepAndCheck(avoid=0, mayMiss=(), steps=1):
    """Steps once (or more) and compares the real sphere contacts with the oracle each time.

    `mayMiss`: ids of bodies that may be one search late in the first of these steps.
    Returns how many contacts there were in all."""
    total = 0
    for k in range(steps):
        centres, radii = spheresNow()
        O.step()
        late = mayMiss if k == 0 else ()
        total += compare(centres, radii, avoid, late)
    return total


def compare(centres, radii, avoid=0, mayMiss=()):
    """Asserts that the real contacts are those of the oracle at `centres`, cellDist included."""
    # YADE advances the cell before the engines run, so the present hSize is the one they saw.
    hSize = np.array([[O.cell.hSize[r, c] for c in range(3)] for r in range(3)]) \
        if O.periodic else None
    sure, possible = contacts(centres, radii, hSize)
    masks, clumps = {b.id: b.mask for b in O.bodies}, {b.id: b.clumpId for b in O.bodies}
    sure, possible = (masked(pairs, masks, avoid, clumps) for pairs in (sure, possible))
    found = {k: v for k, v in realPairs().items() if all(isinstance(O.bodies[b].shape, w.Sphere) for b in k)}
    missed = {p for p in sure if p not in found and not set(p) & set(mayMiss)}
    extra = {p for p in found if p not in possible and not set(p) & set(mayMiss)}
    assert not missed, f'step {O.iter}: {len(missed)} of {len(sure)} contacts missed: ' \
        f'{sorted(missed)[:5]}'
    assert not extra, f'step {O.iter}: contacts that are none: {sorted(extra)[:5]}'
    if hSize is not None:
        wrong = {p: (found[p], possible[p]) for p in found if p in possible and found[p] != possible[p]}
        assert not wrong, f'step {O.iter}: cellDist (found, right): {list(wrong.items())[:3]}'
    return len(sure)


def positions():
    """(n,3) of all bodies that exist, in the order of their ids."""
    return np.array([b.state.pos for b in O.bodies])


def matrix(rows):
    """A YADE Matrix3 from a (3,3) array."""
    return Matrix3(*[float(x) for x in np.asarray(rows).ravel()])


def gas(collider, n=100, seed=1, speed=.004, **attributes):
    """`n` spheres of random places, sizes and velocities in a unit box; returns their collider."""
    rng = np.random.default_rng(seed)
    O.dt = 1
    addSpheres(rng.uniform(0, 1, (n, 3)), rng.uniform(.03, .07, n), rng.normal(size=(n, 3)) * speed)
    return setEngines(collider(**attributes))


def theCollider(collider):
    """The only collider in O.engines, which is of the class that `collider` makes."""
    found = [e for e in O.engines if isinstance(e, w.Collider)]
    assert [type(e).__name__ for e in found] == [collider.name]
    return found[0]


def listed():
    """Everything about the interactions that has to survive."""
    return sorted((i.id1, i.id2, i.isReal, tuple(i.cellDist)) for i in O.interactions.all())


def heap(material=None, periodic=False, spacing=1.45):
    """Spheres of three sizes, a clump among them, that fall on a facet floor, a box and a wall."""
    clear()
    chance = np.random.default_rng(3)
    O.materials.append(material or w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    if periodic:
        O.periodic = True
        O.cell.setBox(9, 9, 9)
    for place in np.ndindex(6, 6, 4):
        at = np.array(place) * spacing + chance.uniform(-.2, .2, 3) + (1, 1, 1.6)
        ball = utils.sphere(Vector3(*at), chance.choice([.5, .7, .75]))
        ball.state.vel = Vector3(*chance.normal(0, 3, 3))
        ball.state.angVel = Vector3(*chance.normal(0, 5, 3))
        O.bodies.append(ball)
    O.bodies.appendClumped([utils.sphere((4, 4, 9), .6), utils.sphere((4.8, 4, 9), .6)])
    if not periodic:
        O.bodies.append([utils.facet([(-30, -30, 0), (30, -30, 0), (0, 40, 0)]),
                         utils.box((0, 4, 1), (.8, 6, 1), fixed=True), utils.wall(9.5, axis=1)])
    O.dt = 2e-4


def packing(shape, spacing, dt, isTurning=False, seed=2, material=None):
    """Spheres with friction in random motion, in an order that is not that of their places."""
    clear()
    chance = np.random.default_rng(seed)
    places = np.array(list(np.ndindex(shape))) * spacing
    chance.shuffle(places)
    O.materials.append(material or w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    addSpheres(places, [.5] * len(places), chance.normal(0, 2, (len(places), 3)), dynamic=True)
    for body in O.bodies if isTurning else ():
        body.state.angVel = chance.normal(0, 3, 3)
    O.dt = dt


def state():
    """All numbers of bodies and real contacts, as bytes."""
    numbers = [[*b.state.pos, *b.state.vel, *b.state.angVel, *b.state.ori] for b in O.bodies if b]
    contacts = [[i.id1, i.id2, i.iterMadeReal, *i.geom.normal, *i.geom.contactPoint, i.geom.penetrationDepth,
                 i.geom.refR1, i.geom.refR2, *i.geom.shearInc, i.phys.kn, i.phys.ks, *i.phys.normalForce,
                 *i.phys.shearForce] for i in O.interactions]
    forces = [[*O.forces.f(b.id), *O.forces.t(b.id)] for b in O.bodies if b]
    return [np.array(rows, float).tobytes() for rows in (numbers, contacts, forces)]


kRelative = 1e-11   # rounding allowed on a sum of radii
kAbsolute = 8e-16   # rounding allowed on a coordinate (a few ulps)


def contacts(centres, radii, hSize=None, block=512):
    """Contacts of all pairs, found by comparing every pair.

    centres (n,3) and radii (n) in any one length unit; hSize (3,3): columns are the period vectors,
    None for an aperiodic scene. Rows that are NaN never touch. Returns (sure, possible), two dicts
    (i, j) -> cellDist with i < j: `sure` overlap beyond rounding, `possible` includes the ties.
    cellDist is the triple of periods by which body j has to be shifted (zeros if aperiodic).
    """
    centres = np.asarray(centres, float).reshape(-1, 3)
    radii = np.asarray(radii, float)
    finder = _aperiodic if hSize is None else _periodic
    periods = np.zeros((3, 3)) if hSize is None else np.asarray(hSize, float)
    sure, possible = {}, {}
    for start in range(0, len(centres), block):
        rows = np.arange(start, min(start + block, len(centres)))
        for i, j, dist in finder(centres, radii, rows, periods):
            shift = dist @ periods.T
            scale = np.maximum(abs(centres[i]).max(axis=1), abs(centres[j]).max(axis=1))
            reach = radii[i] + radii[j]
            overlap = reach - np.linalg.norm(centres[j] - centres[i] + shift, axis=1)
            # The error of the shift itself counts, too.
            slack = kRelative * reach + kAbsolute * (scale + 4 * abs(shift).max(axis=1))
            for k in np.nonzero(overlap >= -slack)[0]:
                key = (int(i[k]), int(j[k]))
                possible[key] = tuple(int(c) for c in dist[k])
                if overlap[k] > slack[k]:
                    sure[key] = possible[key]
    return sure, possible


def _aperiodic(centres, radii, rows, _):
    # Of every pair first one coordinate, with more room than a contact has: most of the time is in the others.
    room = 1.001 * radii + 1e-12 * abs(centres).max(axis=1)
    near = abs(centres[rows, 0, None] - centres[:, 0]) <= room[rows, None] + room
    i, j = np.nonzero(near & (rows[:, None] < np.arange(len(centres))))
    yield rows[i], j, np.zeros((len(i), 3), int)


def _periodic(centres, radii, rows, hSize):
    """All lattice images that can be within reach, however the cell is sheared."""
    i, j = np.nonzero((rows[:, None] < np.arange(len(centres))) & ~np.isnan(radii[rows, None] + radii))
    i = rows[i]
    inverse = np.linalg.inv(hSize)
    fraction = (centres[j] - centres[i]) @ inverse.T
    nearest = -np.rint(fraction).astype(int)
    fraction = fraction + nearest
    # |row of the inverse| · |hSize f| >= |f|: no contact where some |f| exceeds this
    limit = 1e-6 + 2 * np.nanmax(radii) * np.linalg.norm(inverse, axis=1)
    for offset in itertools.product(*(range(-int(k), int(k) + 1) for k in np.ceil(limit))):
        keep = (abs(fraction + offset) <= limit).all(axis=1)
        yield i[keep], j[keep], nearest[keep] + np.array(offset)


def masked(pairs, masks, avoid, clumps):
    """Those of `pairs` that may collide: masks share a bit, not both alike within `avoid`,
    not members of one clump. masks, clumps: {body id: number}; -1: no clump."""
    def may(i, j):
        if not masks[i] & masks[j]:
            return False
        if masks[i] == masks[j] and masks[i] & avoid:
            return False
        return clumps[i] < 0 or clumps[i] != clumps[j]
    return {key: value for key, value in pairs.items() if may(*key)}
