"""Rooms: where a sphere may be until the next search.

A sphere that keeps its velocity gets a room around the middle of its path; contacts are those of the
oracle in any case (test_agreement.py, test_changed.py)."""
import math

import numpy as np
import pytest
import yadefrag  # noqa: F401
from yade.minieigenHP import Vector3

from scenes import O, addSpheres, allPairs, clear, makeCollider, realPairs, setEngines, stepAndCheck

RADIUS = .1
SPEED = 1.  # m/s
INTERVAL = 20


def _flight(velocity, **attributes):
    """One sphere in free flight and a distant one at rest; returns the first one."""
    clear()
    O.dt = 1e-3
    addSpheres([(0, 0, 0), (50, 0, 0)], [RADIUS, RADIUS], [velocity, (0, 0, 0)])
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


def testFlightsThatMeetAreFoundInTime():
    """Two beams cross: first contacts at the step of the oracle, turned by any angle."""
    for turn in np.linspace(0, math.pi, 5):
        clear()
        O.dt = 2e-3
        c, s = math.cos(turn), math.sin(turn)
        rows = np.arange(-20, 0) * 3. * RADIUS
        places = np.concatenate([[(c * x, s * x, .3 * x) for x in rows],
                                 [(-s * x, c * x, -.3 * x) for x in rows]])
        speeds = np.concatenate([np.tile((c, s, .3), (20, 1)), np.tile((-s, c, -.3), (20, 1))])
        addSpheres(places, np.full(40, RADIUS), 2 * speeds)
        setEngines(makeCollider('LebesgueCollider'))
        met = 0
        for _ in range(500):
            stepAndCheck()
            met += bool(realPairs())
        assert met > 50


def testRadiiAreReadByEverySearch():
    clear()
    O.dt = 1e-3
    ids = addSpheres([(3 * k * RADIUS, 0, 0) for k in range(300)], np.full(300, RADIUS))
    addSpheres([(0, 10, 0)], [RADIUS], [(0, SPEED, 0)])
    collider = setEngines(makeCollider('LebesgueCollider', adaptInterval=False, targetInterv=INTERVAL))
    for _ in range(3 * INTERVAL):
        O.step()
    O.bodies[ids[100]].shape.radius = O.bodies[ids[101]].shape.radius = 1.6 * RADIUS
    before = collider.numAction
    while collider.numAction == before:
        O.step()
    assert 1 < collider.searched < 10
    assert (ids[100], ids[101]) in realPairs()


def testAnExplicitSearchReadsAll():
    clear()
    addSpheres([(0, 0, 0), (3 * RADIUS, 0, 0)], [RADIUS, RADIUS], [(0, 0, 0), (0, SPEED, 0)])
    collider = setEngines(makeCollider('LebesgueCollider'))
    O.step()
    assert not allPairs()
    O.bodies[0].shape.radius = 2.5 * RADIUS
    collider()
    assert allPairs() == {(0, 1)}


@pytest.mark.parametrize('axis', range(3))
def testAPositionThatIsNoNumberIsRefusedWhenOthersMove(axis):
    """Searches of few bodies check the positions of all."""
    clear()
    O.dt = 1e-3
    addSpheres([(3 * k * RADIUS, 0, 0) for k in range(300)], np.full(300, RADIUS))
    addSpheres([(0, 10, 0)], [RADIUS], [(0, SPEED, 0)])
    collider = setEngines(makeCollider('LebesgueCollider', adaptInterval=False, targetInterv=INTERVAL))
    for _ in range(3 * INTERVAL):
        O.step()
    position = [30., 0., 0.]
    position[axis] = math.nan
    O.bodies[100].state.pos = Vector3(*position)
    with pytest.raises(RuntimeError, match='#100'):
        for _ in range(INTERVAL):
            O.step()
    assert collider.numAction > 1
