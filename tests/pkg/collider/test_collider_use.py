"""A collider in a script: probed, timed, replaced, its attributes, how often it searches."""
import builtins
import functools

import numpy as np
import pytest

import scenes
from scenes import O, addSpheres, clear, gas, listed, setEngines, stepAndCheck, theCollider
import yade.wrapper as w
import yadefrag
from yade import timing, utils
from yade.minieigenHP import Vector3


def testProbe(collider):
    """BoxFactory requests free room from the collider: no sphere may be put into another one."""
    O.dt = 1e-3
    O.materials.append(w.FrictMat(density=1000, young=1e6))
    addSpheres([(.5, .5, .5)], [.1])
    factory = w.BoxFactory(maxParticles=150, extents=(.4, .4, .4), center=(.5, .5, .5), rMin=.03,
                           rMax=.05, vMin=.5, vMax=.5, normal=(0, 0, 1), massFlowRate=1000,
                           materialId=0, maxAttempt=2000, stopIfFailed=False)
    engine = setEngines(collider())
    O.engines = O.engines + [factory]
    known = len(O.bodies)
    for _ in range(60):
        O.step()
        # Those that fly have moved since the request of the factory only if they were made earlier.
        requireFree(range(known, len(O.bodies)))
        known = len(O.bodies)
    assert known > 60 and engine.numAction > 0


def requireFree(ids):
    """These spheres overlap no other one."""
    centres, radii = scenes.spheresNow()
    for i in ids:
        gap = np.linalg.norm(centres - centres[i], axis=1) - radii - radii[i]
        gap[i] = 1
        assert np.nanmin(gap) > -1e-9, f'body {i} is inside body {np.nanargmin(gap)}'


def testIsActivated(collider):
    engine = gas(collider, speed=1e-5)
    for change in (lambda: None, lambda: addSpheres([(.5, .5, .5)], [.1])):
        change()
        assert engine.isActivated()
        O.step()
        O.step()
        assert not engine.isActivated()
    O.interactions.clear()
    assert engine.isActivated()
    assert collider(verletDist=0).isActivated()


def testTiming(collider):
    engine = gas(collider, verletDist=0)
    O.timingEnabled = True
    for _ in range(20):
        O.step()
    assert engine.execCount == 20 and engine.execTime > 0
    timing.stats()
    timing.reset()
    assert engine.execCount == 0 and engine.execTime == 0


def testReplaceCollider(collider):
    """In the middle of a run, from YADE's collider to ours and back: what it finds is neither doubled nor kept when far."""
    gas(collider.rival, verletDist=.1)
    stepAndCheck(steps=5)
    many = len(listed())
    for make in (collider, collider.rival, collider):
        utils.replaceCollider(make(verletDist=0))
        assert stepAndCheck(steps=5) > 5
        pairs = [p[:2] for p in listed()]
        assert len(pairs) == len(set(pairs)) < many


def testAttributeNames(collider):
    """Every attribute that InsertionSortCollider has, with the same default; how they are given, read and set:
    test_about.py, test_forms.py. A class may have defaults of its own for how far and how often it searches."""
    values, ours = w.InsertionSortCollider().dict(), collider().dict()
    own = {'boundDispatcher', 'numReinit', 'targetInterv', 'minSweepDistFactor'}
    assert set(values) <= set(ours) and {name for name in values if ours[name] != values[name]} <= own


def testNumActionCountsStrides(collider):
    def actions(verletDist):
        clear()
        engine = gas(collider, verletDist=verletDist, targetInterv=0)
        stepAndCheck(steps=60)
        return engine.numAction
    every, small, large = actions(0), actions(.02), actions(.1)
    assert every == 60
    assert every > small > large >= 1


def testVerletDistIsResolved(collider):
    """A negative verletDist becomes that share of the least sphere radius; with no spheres to measure it by there is
    a search in every step."""
    engine = gas(collider, verletDist=-.5)
    O.step()
    assert engine.verletDist == pytest.approx(.5 * min(b.shape.radius for b in O.bodies))
    clear()
    O.bodies.append(utils.box((0, 0, 0), (1, 1, 1)))
    engine = setEngines(collider())
    for _ in range(3):
        O.step()
    assert engine.numAction == 3
    assert engine.verletDist <= 0


@pytest.mark.parametrize('verletDist', [0, .05])
def testWithoutIntegrator(collider, verletDist):
    """No NewtonIntegrator: a search in every step, bodies moved from outside included. Strides without an integrator:
    refused like YADE's, or no contact missed."""
    rng = np.random.default_rng(5)
    addSpheres(rng.uniform(0, 1, (80, 3)), [.05] * 80)
    setEngines(collider(verletDist=verletDist), newton=False)
    total = 0
    try:
        for _ in range(10):
            for body in O.bodies:
                body.state.pos = Vector3(*rng.uniform(0, 1, 3))
            total += stepAndCheck()
        assert total > 50
    except RuntimeError as error:
        assert verletDist and 'NewtonIntegrator' in str(error)


def testAnotherIntegratorAndADeadCollider(collider):
    """dead=True stops it; alive again, it catches up."""
    gas(collider)
    stepAndCheck(steps=3)
    engine = theCollider(collider)
    O.engines = [w.ForceResetter(), engine, scenes.loop(), w.NewtonIntegrator()]
    assert stepAndCheck(steps=5)
    engine.dead = True
    for _ in range(5):
        O.step()
    engine.dead = False
    addSpheres([(.5, .5, .5)], [.1])
    assert stepAndCheck(steps=5)


# --- as YADE's own: dumpBounds() and typedEngine('InsertionSortCollider')

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
    engine = collider(label='theOne')
    clear()
    setEngines(engine)
    assert builtins.theOne.label == 'theOne'
    assert utils.typedEngine('InsertionSortCollider') == engine == utils.typedEngine(type(engine).__name__)
    assert type(utils.typedEngine('NewtonIntegrator')) is w.NewtonIntegrator
    with pytest.raises(IndexError):
        utils.typedEngine('GravityEngine')
    rival = w.InsertionSortCollider()
    O.engines = [engine, rival]
    assert utils.typedEngine('InsertionSortCollider') == rival  # if there is one


# --- inCurveOrder returns a permutation, in the order of the Lebesgue curve

def _later(a, b):
    """Of two cells (three whole numbers each): -1, 0, 1 as a comes before b on the curve. The axis
    whose coordinates differ in the highest bit decides; of equal bits, z before y before x."""
    best, axis = 0, 2
    for k in (2, 1, 0):
        bit = (int(a[k]) ^ int(b[k])).bit_length()
        if bit > best:
            best, axis = bit, k
    return (a[axis] > b[axis]) - (a[axis] < b[axis])


def _cells(places):
    places = np.asarray(places, float)
    low = places.min(axis=0)
    return np.floor((places - low) * ((2**21 - 1) / (places.max(axis=0) - low).max())).astype(int)


@pytest.mark.parametrize('flat', [None, 0, 2])
def testBodiesAreAPermutationInCurveOrder(flat):
    clear()
    rng = np.random.default_rng(1)
    places = rng.normal(size=(500, 3)) * [1, 10, .1] + [1e3, 0, -5]
    if flat is not None:
        places[:, flat] = 3
    bodies = [utils.sphere(p, .1) for p in places]
    ordered = yadefrag.inCurveOrder(bodies)
    assert sorted(map(id, ordered)) == sorted(map(id, bodies))
    assert len(O.bodies) == 0
    found = _cells([b.state.pos for b in ordered])
    expected = sorted(_cells(places).tolist(), key=functools.cmp_to_key(_later))
    assert found.tolist() == expected
    assert [tuple(p) for p in yadefrag.inCurveOrder(places)] == \
        [tuple(b.state.pos) for b in ordered]


def testPlacesWithRadiiAndEqualPlaces():
    pairs = [((0, 0, 0), .1), ((1, 1, 1), .2), ((0, 0, 0), .3), ((1, 0, 0), .4)]
    assert yadefrag.inCurveOrder(pairs) == [pairs[0], pairs[2], pairs[3], pairs[1]]
    assert yadefrag.inCurveOrder(iter([(2, 2, 2)])) == [(2, 2, 2)]
    assert yadefrag.inCurveOrder([]) == []
