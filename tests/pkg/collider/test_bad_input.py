"""Positions and bounds that are no numbers: one clear error, and the scene as it was."""
import math

import numpy as np
import pytest

import scenes
from scenes import O, addSpheres, matrix, setEngines
from yade import utils
from yade.minieigenHP import Vector3


def snapshot():
    """All that a failed search must leave alone."""
    bounds = [None if b.bound is None else
              (tuple(b.bound.min), tuple(b.bound.max), tuple(b.bound.refPos), b.bound.sweepLength,
               b.bound.lastUpdateIter) for b in O.bodies]
    states = [(tuple(b.state.pos), tuple(b.state.vel), tuple(b.state.ori)) for b in O.bodies]
    interactions = [(i.id1, i.id2, i.isReal, tuple(i.cellDist)) for i in O.interactions.all()]
    # as text, since a NaN is not equal to itself
    return repr((len(O.bodies), bounds, states, interactions))


def start(collider, periodic=False, warm=True):
    rng = np.random.default_rng(1)
    if periodic:
        O.periodic = True
        O.cell.hSize = matrix(np.eye(3))
    O.dt = 1
    addSpheres(rng.uniform(.1, .9, (20, 3)), [.1] * 20, rng.normal(size=(20, 3)) * 1e-4)
    engine = setEngines(collider(verletDist=0))
    if warm:
        O.step()
        assert scenes.realPairs()
    return engine


def nanPosition(body):
    body.state.pos = Vector3(math.nan, .5, .5)


@pytest.mark.rivalAborts('asserts are on')
@pytest.mark.parametrize('periodic', [False, True], ids=['open', 'periodic'])
@pytest.mark.parametrize('warm', [False, True], ids=['first', 'later'])
@pytest.mark.parametrize('position, radius', [
    ((math.nan, .5, .5), .1), ((.5, .5, math.nan), .1), ((.5, math.inf, .5), .1), ((-math.inf, .5, .5), .1),
    ((.5, .5, .5), -.1), ((.5, .5, .5), math.nan)])
def testBadBody(collider, position, radius, warm, periodic):
    start(collider, periodic, warm)
    O.bodies[5].state.pos, O.bodies[5].shape.radius = Vector3(position), radius
    before = snapshot()
    with pytest.raises(RuntimeError) as error:
        O.step()
    assert '#5' in str(error.value)
    assert snapshot() == before


@pytest.mark.rivalAborts('asserts are on')
def testBadFacet(collider):
    """A bound made by YADE's own functor, not by the collider."""
    start(collider)
    O.bodies.append(utils.facet([(0, 0, 0), (1, 0, 0), (0, 1, 0)]))
    O.bodies[20].state.pos = Vector3(0, math.nan, 0)
    before = snapshot()
    with pytest.raises(RuntimeError) as error:
        O.step()
    assert '#20' in str(error.value)
    assert snapshot() == before


@pytest.mark.rivalAborts('asserts are on')
def testTooLargeLeavesTheScene(collider):
    """The error for a body beyond half the cell comes before anything is changed, too."""
    start(collider, periodic=True)
    O.bodies[5].shape.radius = .4
    before = snapshot()
    with pytest.raises(RuntimeError):
        O.step()
    assert snapshot() == before


@pytest.mark.rivalAborts('asserts are on')
def testGoesOnAfterRepair(collider):
    """The same scene, mended, runs on and misses nothing."""
    start(collider)
    good = Vector3(O.bodies[5].state.pos)
    nanPosition(O.bodies[5])
    with pytest.raises(RuntimeError):
        O.step()
    O.bodies[5].state.pos = good
    assert scenes.stepAndCheck(steps=5)


def testBadBodiesThatDoNotCount(collider):
    """Unbounded or erased bodies may be anything."""
    start(collider, warm=False)
    nanPosition(O.bodies[5])
    O.bodies[5].bounded = False
    nanPosition(O.bodies[6])
    O.bodies.erase(6)
    O.step()
    assert not any({5, 6} & set(p) for p in scenes.allPairs())


def testInfiniteWallIsNoError(collider):
    start(collider)
    O.bodies.append(utils.wall(.5, axis=1))
    O.step()
    assert any(20 in p for p in scenes.realPairs())


@pytest.mark.rivalFails('it accepts them')
@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf])
def testVerletDistIsFinite(collider, value):
    engine = start(collider)
    engine.verletDist = value
    before = snapshot()
    with pytest.raises(RuntimeError, match='verletDist is .*: it must be'):
        engine()
    assert snapshot() == before
