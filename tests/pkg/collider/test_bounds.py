"""dumpBounds() and typedEngine('InsertionSortCollider') of the colliders, as with YADE's own."""

import numpy as np
import pytest

import yade.wrapper as w
from scenes import O, addSpheres, clear, setEngines
from yade import utils


def dumped(engine, periodic):
    clear()
    O.periodic = periodic
    if periodic:
        O.cell.setBox(3., 4., 5.)
    rng = np.random.default_rng(3)
    addSpheres(rng.uniform(-6, 6, (40, 3)), rng.uniform(.2, .4, 40), np.zeros((40, 3)), dynamic=False)
    O.bodies.append(w.Body())  # without a bound
    O.bodies[-1].state.pos, O.bodies[-1].dynamic = (1, 2, 3), False
    setEngines(engine)
    O.dt = 1e-9
    before = engine.dumpBounds()
    O.step()
    return before, engine.dumpBounds()


@pytest.mark.parametrize('periodic', [False, True])
def test_dumpedAsByYade(collider, periodic):
    """With bounds that are not enlarged, the same numbers."""
    expected = dumped(w.InsertionSortCollider([w.Bo1_Sphere_Aabb()], verletDist=0), periodic)
    found = dumped(collider(verletDist=0), periodic)
    assert found[0] == expected[0] == ([], [], [])
    assert isinstance(found[1], tuple) and [len(axis) for axis in found[1]] == [82] * 3
    for mine, yades in zip(found[1], expected[1]):
        assert all(type(one) is tuple and list(map(type, one)) == list(map(type, two))
                   for one, two in zip(mine, yades))
        assert [one[0] for one in mine] == pytest.approx([two[0] for two in yades], abs=1e-12)
        assert sorted(one[1:] for one in mine) == sorted(two[1:] for two in yades)


def test_erasedBodiesAreLeftOut(collider):
    engine = collider()
    dumped(engine, False)
    O.bodies.erase(7)
    O.step()
    assert all(len(axis) == 80 and all(abs(one[1]) != 7 for one in axis) for axis in engine.dumpBounds())


def test_foundByTheNameOfYadesCollider(collider):
    engine = collider()
    clear()
    setEngines(engine)
    assert utils.typedEngine('InsertionSortCollider') == engine == utils.typedEngine(type(engine).__name__)
    assert type(utils.typedEngine('NewtonIntegrator')) is w.NewtonIntegrator
    with pytest.raises(IndexError):
        utils.typedEngine('GravityEngine')
    rival = w.InsertionSortCollider()
    O.engines = [engine, rival]
    assert utils.typedEngine('InsertionSortCollider') == rival  # if there is one
