"""Positions and bounds that are no numbers, and scenes in which the number of pairs explodes: one clear error, and the scene
as it was."""
import math
import resource

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


@pytest.mark.parametrize('periodic', [False, True], ids=['open', 'periodic'])
@pytest.mark.parametrize('warm', [False, True], ids=['first', 'later'])
@pytest.mark.parametrize('position, radius', [
    ((math.nan, .5, .5), .1), ((.5, .5, math.nan), .1), ((.5, math.inf, .5), .1), ((-math.inf, .5, .5), .1),
    ((.5, .5, .5), -.1), ((.5, .5, .5), math.nan), ((0, math.nan, 0), None), ((.5, .5, .5), .4)])
def testBadBody(collider, position, radius, warm, periodic):
    """`radius` None: a facet, whose bound is made by YADE's own functor, not by the collider."""
    start(collider, periodic, warm)
    if radius is None:
        O.bodies.append(utils.facet([(0, 0, 0), (1, 0, 0), (0, 1, 0)]))
    number = 20 if radius is None else 5
    O.bodies[number].state.pos = Vector3(position)
    if radius is not None:
        O.bodies[number].shape.radius = radius
    if radius == .4 and not periodic:  # too large for the cell only
        O.step()
        return
    before = snapshot()
    with pytest.raises(RuntimeError) as error:
        O.step()
    assert '#%d' % number in str(error.value) or radius == .4
    assert snapshot() == before


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


@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf])
def testVerletDistIsFinite(collider, value):
    engine = start(collider)
    engine.verletDist = value
    before = snapshot()
    with pytest.raises(RuntimeError, match='verletDist is .*: it must be'):
        engine()
    assert snapshot() == before


# --- refused before they take the memory

@pytest.fixture
def littleMemory():
    """Leaves this process 1 GB more than it has."""
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    with open('/proc/self/statm') as file:
        used = int(file.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + 2**30, hard))
    yield
    resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def state():
    collider = O.engines[1]
    return ([(tuple(b.state.pos), b.bound is None) for b in O.bodies], len(O.interactions), O.iter,
            collider.verletDist, collider.interval, collider.numAction)


@pytest.mark.parametrize('cell, spread, radius', [
    (None, 1e-3, .02), (.01, .01, .02), (.1, .1, .02), (.1, .1, .03)],
    ids=['one place', 'larger than the cell', 'many images', 'over half of the cell'])
def testAllOnOneAnother(collider, littleMemory, cell, spread, radius):
    rng = np.random.default_rng(1)
    if cell:
        O.periodic = True
        O.cell.setBox(cell, cell, cell)
    addSpheres(rng.uniform(0, spread, (20000, 3)), [radius] * 20000)
    setEngines(collider())
    before = state()
    with pytest.raises(RuntimeError) as error:
        O.step()
    assert 'memory' in str(error.value) and len(str(error.value)) <= 300
    assert state() == before
    for body in O.bodies:       # the same scene, mended, runs
        body.shape.radius *= 1e-3
    O.step()
    assert len(O.interactions.all()) < 10**5


def testManyPairsThatFit(collider, littleMemory):
    """A million pairs are no reason to refuse."""
    rng = np.random.default_rng(2)
    addSpheres(rng.uniform(0, 1, (20000, 3)), [.03] * 20000)
    setEngines(collider(verletDist=0))
    O.engines = O.engines[:2]
    O.step()
    assert len(O.interactions.all()) > 100000
