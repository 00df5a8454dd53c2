"""Scenes in which the number of pairs explodes are refused before they take the memory."""
import resource

import numpy as np
import pytest

import scenes
from scenes import O, addSpheres, setEngines


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


@pytest.mark.rivalAborts('it takes all memory')
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
