"""A search of the bodies that changed leaves the interactions of a search of all.

The oracle's contacts are all there at every step, and the potential interactions are those that
brute force finds from the bounds, whenever these were made."""
import math
import random

import numpy as np
import pytest
import yadefrag  # noqa: F401
from yade import utils
from yade.minieigenHP import Vector3

from scenes import (
    O, addSpheres, allPairs, clear, makeCollider, positions, realPairs, setEngines, stepAndCheck)

RADIUS = .02


def _cloud(n, seed, speed=0.):
    """`n` spheres in a unit box, a hundredth of them fast; the fast ones' ids and the collider."""
    clear()
    rng = np.random.default_rng(seed)
    velocities = rng.normal(size=(n, 3)) * speed
    fast = rng.choice(n, max(1, n // 100), replace=False)
    velocities[fast] = rng.normal(size=(len(fast), 3)) * .02
    O.dt = .1
    addSpheres(rng.uniform(0, 1, (n, 3)), np.full(n, RADIUS), velocities)
    return fast, setEngines(makeCollider('LebesgueCollider'))


def _pairsByBounds(collider):
    """(sure, possible) pairs of spheres, by brute force: those that could touch within the rooms
    that their bounds have now."""
    bodies = [b for b in O.bodies if b and b.bound and isinstance(b.shape, utils.Sphere)]
    centres = np.array([b.bound.refPos for b in bodies])
    radii = np.array([b.shape.radius for b in bodies])
    sweeps = np.array([b.bound.sweepLength for b in bodies])
    ids = np.array([b.id for b in bodies])
    # Of every pair first one coordinate: most of the time is in the others.
    room = 1.001 * (radii + sweeps)
    near = abs(centres[:, 0, None] - centres[:, 0]) <= room[:, None] + room
    i, j = np.nonzero(np.triu(near, 1))
    apart = np.maximum(abs(centres[i] - centres[j]) - (sweeps[i] + sweeps[j])[:, None], 0)
    distance = np.sqrt((apart**2).sum(axis=1)) - radii[i] - radii[j]
    may = np.array([b.mask for b in bodies])
    clumps = np.array([b.clumpId for b in bodies])
    allowed = (may[i] & may[j] != 0) & ((clumps[i] < 0) | (clumps[i] != clumps[j]))

    def names(where):
        return {(min(a, b), max(a, b)) for a, b in zip(ids[i[where]], ids[j[where]])}
    return names(allowed & (distance < -1e-12)), names(distance < 1e-12)


def _check(collider):
    sure, possible = _pairsByBounds(collider)
    found = allPairs()
    assert sure <= found, f'step {O.iter}: missing {sorted(sure - found)[:3]}'
    assert found <= possible, f'step {O.iter}: too many {sorted(found - possible)[:3]}'
    return len(sure)


def _searches(collider, steps):
    """The number of bodies of each search in some steps; all are compared with brute force."""
    for _ in range(steps):
        before = collider.numAction
        stepAndCheck()
        if collider.numAction > before:
            _check(collider)
            yield collider.searched


@pytest.mark.parametrize('seed', range(3))
def testSamePairsWhileSomeMove(seed):
    """A few fast ones among slow ones: most searches are of few, some of all."""
    _, collider = _cloud(600, seed, speed=.0005)
    assert sum(0 < count < 600 for count in _searches(collider, 80)) >= 5


def testRadiiThatGrowAndShrink():
    rng = random.Random(5)
    _, collider = _cloud(400, 6, speed=.0005)
    for step in range(40):
        for id in rng.sample(range(400), 4):
            O.bodies[id].shape.radius *= rng.choice([.8, 1.3])
        collider()  # growth alone does not call for a search
        _check(collider)
        stepAndCheck()
    assert collider.searchedTotal < 400 * collider.numAction / 2


def testMasksAndClumpsThatChange():
    rng = random.Random(7)
    _, collider = _cloud(400, 8)
    O.step()
    touching = sorted(realPairs())
    for step in range(20):
        a, b = rng.choice(touching)
        O.bodies[a].mask = rng.choice([1, 2, 3])
        collider()
        sure, _ = _pairsByBounds(collider)
        assert sure <= allPairs()
    for id in range(400):
        O.bodies[id].mask = 1
    pair = touching[0]
    others = [id for id in range(400) if id not in pair][:2]
    clump = O.bodies.clump([*pair, *others])  # YADE releases none of the last two
    collider()
    O.bodies.releaseFromClump(pair[0], clump)
    collider()
    sure, _ = _pairsByBounds(collider)
    assert pair in sure and sure <= allPairs()


def testWallsFacetsAndBoxesThatMove():
    rng = np.random.default_rng(9)
    _, collider = _cloud(300, 10, speed=.0005)
    ids = O.bodies.append([utils.wall(.5, 0), utils.box((.5, .5, .5), (.1, .2, .05)),
                           utils.facet([(.2, .2, .2), (.8, .2, .2), (.2, .8, .3)])])
    O.bodies[ids[0]].state.vel = (.01, 0, 0)
    O.bodies[ids[1]].state.angVel = (0, 0, .05)
    O.bodies[ids[1]].state.blockedDOFs = O.bodies[ids[2]].state.blockedDOFs = 'xyzXYZ'
    some = 0
    for step in range(60):
        O.step()
        some += 0 < collider.searched < 200
        found = {p for p in allPairs() if set(p) & set(ids)}
        for id in ids:
            bare = O.bodies[id].bound
            for body in (b for b in O.bodies if b.id not in ids and b.bound):
                low, high = body.bound.min, body.bound.max
                meets = all(low[k] <= bare.max[k] and bare.min[k] <= high[k] for k in range(3))
                assert meets == (tuple(sorted((id, body.id))) in found), (step, id, body.id)
    assert some >= 5


def testSameOutcomeAsWithSearchesOfAll():
    """The oracle's contacts in both runs are those of one motion, to the last bit."""
    def run(all):
        _cloud(500, 12, speed=.0005)
        collider = O.engines[1]
        for _ in range(50):
            collider.doSort = all
            stepAndCheck()
        return positions(), collider.searchedTotal
    (few, fewSearched), (every, allSearched) = run(False), run(True)
    assert (few == every).all()
    assert fewSearched < allSearched / 3


# --- rooms: where a sphere may be until the next search

# A sphere that keeps its velocity gets a room around the middle of its path.
LARGE = .1
SPEED = 1.  # m/s
INTERVAL = 20


def _flight(velocity, **attributes):
    """One sphere in free flight and a distant one at rest; returns the first one."""
    clear()
    O.dt = 1e-3
    addSpheres([(0, 0, 0), (50, 0, 0)], [LARGE, LARGE], [velocity, (0, 0, 0)])
    setEngines(makeCollider('LebesgueCollider', adaptInterval=False, targetInterv=INTERVAL,
                            minSweepDistFactor=.01, **attributes))
    return O.bodies[0]


def _roomsOf(body, steps):
    """(centre relative to the position, length) of each new room of the body."""
    rooms = []
    for _ in range(steps):
        before, position = tuple(body.bound.refPos) if body.bound else None, body.state.pos
        O.step()
        if tuple(body.bound.refPos) != before:
            rooms.append((np.array(body.bound.refPos - position), body.bound.sweepLength))
    return rooms


@pytest.mark.parametrize('velocity', [(SPEED, 0, 0), (0, -SPEED, .5 * SPEED), (.3, .4, -SPEED)])
def testAStraightFlightHasItsRoomAroundTheMiddleOfItsPath(velocity):
    body = _flight(velocity)
    rooms = _roomsOf(body, 6 * INTERVAL)
    path = INTERVAL * O.dt * np.array(velocity)
    centre, length = rooms[0]  # nothing is known about the sphere
    assert not centre.any() and length == pytest.approx(1.02 * SPEED * INTERVAL * O.dt)
    # As many steps as before, in half the room: .5 of the path, and .02 of it for acceleration.
    assert 5 <= len(rooms) <= 7
    for centre, length in rooms[1:]:
        assert centre == pytest.approx(.5 * path, rel=1e-9)
        assert length == pytest.approx(.52 * SPEED * INTERVAL * O.dt)


def testALimitedRoomLastsTwiceAsLong():
    """verletDist allows 5 of the 20 steps around the position, nearly 10 around the path's middle."""
    body = _flight((SPEED, 0, 0), verletDist=5e-3)
    rooms = _roomsOf(body, 100)
    assert rooms[0][1] == 5e-3 and rooms[1][1] == 5e-3
    assert rooms[1][0][0] == pytest.approx(5e-3 / 1.04)
    assert 10 <= len(rooms) <= 13


def testASphereThatTurnsBackHasItsRoomAroundItsPosition():
    body = _flight((SPEED, 0, 0))
    _roomsOf(body, 3 * INTERVAL)
    assert np.array(body.bound.refPos - body.state.pos).any()
    body.state.vel = Vector3(-SPEED, 0, 0)
    centre, length = _roomsOf(body, INTERVAL)[0]
    assert not centre.any() and length == pytest.approx(1.02 * SPEED * INTERVAL * O.dt)


@pytest.mark.parametrize('speed', [math.inf, math.nan, 1e300])
def testSpeedsWithoutAPathAreNoExceptions(speed):
    body = _flight((SPEED, 0, 0))
    collider = O.engines[1]
    _roomsOf(body, 3 * INTERVAL)
    body.state.vel = Vector3(speed, 0, 0)
    collider()
    assert np.isfinite(np.array(body.bound.refPos)).all()
    assert body.bound.sweepLength == collider.verletDist


def _flightBesideARow():
    """The ids of 300 spheres at rest, beside which one flies, and the collider after some searches."""
    clear()
    O.dt = 1e-3
    ids = addSpheres([(3 * k * LARGE, 0, 0) for k in range(300)], np.full(300, LARGE))
    addSpheres([(0, 10, 0)], [LARGE], [(0, SPEED, 0)])
    collider = setEngines(makeCollider('LebesgueCollider', adaptInterval=False, targetInterv=INTERVAL))
    for _ in range(3 * INTERVAL):
        O.step()
    return ids, collider


def testRadiiAreReadByEverySearch():
    """An explicit search reads all."""
    ids, collider = _flightBesideARow()
    O.bodies[ids[100]].shape.radius = O.bodies[ids[101]].shape.radius = 1.6 * LARGE
    before = collider.numAction
    while collider.numAction == before:
        O.step()
    assert 1 < collider.searched < 10
    assert (ids[100], ids[101]) in realPairs()
    clear()
    addSpheres([(0, 0, 0), (3 * LARGE, 0, 0)], [LARGE, LARGE], [(0, 0, 0), (0, SPEED, 0)])
    collider = setEngines(makeCollider('LebesgueCollider'))
    O.step()
    assert not allPairs()
    O.bodies[0].shape.radius = 2.5 * LARGE
    collider()
    assert allPairs() == {(0, 1)}


@pytest.mark.parametrize('axis', range(3))
def testAPositionThatIsNoNumberIsRefusedWhenOthersMove(axis):
    """Searches of few bodies check the positions of all."""
    _, collider = _flightBesideARow()
    position = [30., 0., 0.]
    position[axis] = math.nan
    O.bodies[100].state.pos = Vector3(*position)
    with pytest.raises(RuntimeError, match='#100'):
        for _ in range(INTERVAL):
            O.step()
    assert collider.numAction > 1
