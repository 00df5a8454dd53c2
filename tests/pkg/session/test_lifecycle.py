"""A collider's life in YADE: saved, loaded, reset, switched, with interactions that go."""
import os

import numpy as np
import pytest

import scenes
from scenes import O, addSpheres, gas, listed, stepAndCheck, theCollider
import yade.wrapper as w


def runOn(steps=15):
    history, contacts = [], 0
    for _ in range(steps):
        contacts += stepAndCheck()
        history.append(set(scenes.realPairs()))
    assert contacts > 20
    return history, scenes.positions().tolist()


@pytest.mark.parametrize('name', [
    'scene.xml', 'scene.xml.gz', 'scene.xml.bz2', 'scene.yade', 'scene.yade.gz', 'memory', 'text'])
@pytest.mark.parametrize('steps', [0, 7])
def testSaveAndLoad(collider, folder, name, steps):
    """The loaded scene has the same collider with the same attributes, misses no contact, and runs on alike."""
    path = os.path.join(folder, name)
    gas(collider, verletDist=.01, minSweepDistFactor=.2, avoidSelfInteractionMask=4, label='mine')
    stepAndCheck(steps=steps)
    before = [i for i in listed() if i[2]]      # YADE saves the real ones
    if name == 'memory':
        O.saveTmp('here')
    elif name == 'text':
        text = O.sceneToString()
    else:
        O.save(path)
    expected = runOn()
    scenes.clear()
    for k in range(2):
        if name == 'memory':
            O.loadTmp('here')
        elif name == 'text':
            O.stringToScene(text)
        elif k == 0:
            O.load(path)
        else:
            O.reload()
        engine = theCollider(collider)
        assert (engine.verletDist, engine.minSweepDistFactor) == (.01, .2)
        assert (engine.avoidSelfInteractionMask, engine.label) == (4, 'mine')
        assert len(engine.boundDispatcher.functors) == 4
        assert listed() == before
        assert runOn() == expected


def testOldColliderOnANewScene(collider):
    """The same object goes on in a scene made after O.reset(): nothing of the old one is left."""
    engine = gas(collider, n=120)
    stepAndCheck(steps=3)
    O.reset()
    O.dt = 1
    addSpheres(np.random.default_rng(2).uniform(0, 1, (60, 3)), [.08] * 60)
    O.engines = [w.ForceResetter(), engine, scenes.loop(), w.NewtonIntegrator()]
    engine.newton = None
    engine.doSort = True
    assert stepAndCheck(steps=3)


def testSwitchScene(collider):
    """Two scenes, each with its own collider, in turn."""
    gas(collider, seed=1)
    stepAndCheck(steps=2)
    O.switchScene()
    try:
        gas(collider, seed=2, n=60)
        for _ in range(3):
            stepAndCheck(steps=3)
            O.switchScene()
            stepAndCheck(steps=3)
            O.switchScene()
    finally:
        O.resetAllScenes()


def testAddScene(collider):
    gas(collider, seed=1)
    stepAndCheck()
    other = O.addScene()
    O.switchToScene(other)
    gas(collider, seed=3, n=50)
    assert stepAndCheck(steps=3)
    O.switchToScene(0)
    assert len(O.bodies) == 100
    assert stepAndCheck(steps=3)
    O.resetAllScenes()


@pytest.mark.parametrize('verletDist', [0, -.5])
def testInteractionsCleared(collider, verletDist):
    gas(collider, verletDist=verletDist)
    stepAndCheck(steps=3)
    O.interactions.clear()
    assert len(O.interactions) == 0
    assert stepAndCheck(steps=3)


def testInteractionsErased(collider):
    """eraseNonReal drops the potential ones; none of the true contacts may be lost for it."""
    gas(collider, verletDist=0)
    stepAndCheck(steps=3)
    O.interactions.eraseNonReal()
    assert stepAndCheck(steps=20)


@pytest.mark.parametrize('verletDist', [0, -.5])
def testDoSort(collider, verletDist):
    """doSort=True is a rebuild from nothing: the same interactions, and the flag falls."""
    engine = gas(collider, verletDist=verletDist, targetInterv=0)
    stepAndCheck(steps=5)
    engine()
    before = listed()
    engine.doSort = True
    engine()
    assert listed() == before
    assert not engine.doSort
    O.interactions.erase(*before[0][:2])
    engine.doSort = True
    engine()
    assert listed()[0][:2] == before[0][:2] and len(listed()) == len(before)


def testCalledByHand(collider):
    """collider() outside of a step is a whole search."""
    engine = gas(collider)
    engine()
    assert listed()
    assert engine.numAction == 1
