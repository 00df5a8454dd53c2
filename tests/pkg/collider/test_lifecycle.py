"""A collider's life in YADE: saved, loaded, reset, switched, with interactions that go; yade -j1, -j2, -j3: collider,
loop and integrator give the same interactions in the same order, and the same motion; so does the same scene a second
time, as YADE's checkColliderConstantness.py requires of its own collider. Positions and bounds that are no numbers,
and scenes in which the number of pairs explodes: one clear error, and the scene as it was."""
import functools
import json
import math
import os
import resource
import subprocess

import numpy as np
import pytest
import yade
import yade.wrapper as w
from yade import pack, utils
from yade.minieigenHP import Vector3
import scenes
from project import yadeCommand
from scenes import addSpheres, gas, listed, O, setEngines, stepAndCheck, theCollider


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


@pytest.mark.parametrize('verletDist', [0, -.5])
def testInteractionsClearedAndErased(collider, verletDist):
    """eraseNonReal drops the potential ones; none of the true contacts may be lost for it."""
    gas(collider, verletDist=verletDist)
    stepAndCheck(steps=3)
    O.interactions.clear()
    assert len(O.interactions) == 0 and stepAndCheck(steps=3)
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


# --- threads, processes and repetition

kHere = os.path.dirname(os.path.abspath(__file__))
# Scenes of threads_scene.py: the least number of interactions, or of contacts where bodies are stirred.
kScenes = dict(gas=500, mixed=500, periodic=500, stirred=1600, mindlin=1600, viscoelastic=1600, cohesive=1600, NewtonIntegrator=0,
               CurveIntegrator=0)


@functools.cache
def dump(name, threads):
    """What threads_scene.py prints: {scene: {'threads': number, 'moments': [{'interactions': number, 'bits': text}]}}.
    """
    done = subprocess.run(
        yadeCommand() + [f'-j{threads}', os.path.join(kHere, 'threads_scene.py'), name, *kScenes],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600)
    lines = [x[4:] for x in done.stdout.splitlines() if x.startswith('@@@ ')]
    assert done.returncode == 0 and len(lines) == len(kScenes), done.stdout[-1500:] + done.stderr[-1500:]
    return dict(zip(kScenes, map(json.loads, lines)))


@pytest.mark.parametrize('scene', kScenes)
def testThreads(collider, scene):
    """Nor does anything depend on addresses: each number is a process of its own."""
    one, two, three = (dump(collider.name, threads)[scene] for threads in (1, 2, 3))
    assert [found['threads'] for found in (one, two, three)] == [1, 2, 3]
    assert one['moments'] == two['moments'] == three['moments']
    counts = [moment['contacts' if kScenes[scene] == 1600 else 'interactions'] for moment in one['moments']]
    assert min(counts) >= kScenes[scene]


kMoments = (1, 99, 400, 1000)   # steps between two looks


def build(collider, periodic, **attributes):
    """Two hundred spheres of YADE's own check data fall on a box larger than the cell."""
    scenes.clear()
    O.periodic = periodic
    if periodic:
        O.cell.hSize = scenes.matrix([[1, 0, 0], [0, 3, 0], [0, 0, 1]])
    O.materials.append(w.FrictMat(density=1, young=1e5, poisson=.3, frictionAngle=.5, label='low'))
    O.bodies.append(utils.box((.5, .06, .5), (2, .05, 2), fixed=True))
    O.materials.append(w.FrictMat(density=1000, young=1e4, poisson=.3, frictionAngle=.5))
    cloud = pack.SpherePack()
    cloud.load(os.path.join(os.path.dirname(yade.__file__), 'tests/checks/data/100spheres'))
    for shift in ((0, .2, 0), (.1, .3, 0)):
        O.bodies.append([utils.sphere(c + Vector3(*shift), r) for c, r in cloud])
    O.dt = 5e-4
    return setEngines(collider(allowBiggerThanPeriod=True, targetInterv=50, **attributes),
                      newton=w.NewtonIntegrator(damping=.6, gravity=(0, -10, 0)))


def run(collider, periodic, **attributes):
    build(collider, periodic, **attributes)
    history = []
    for steps in kMoments:
        O.run(steps, True)
        history.append(inOrder())
    return history, scenes.positions().tolist()


def inOrder():
    return [(i.id1, i.id2, i.isReal, tuple(i.cellDist)) for i in O.interactions.all()]


@pytest.mark.parametrize('periodic', [False, True], ids=['open', 'periodic'])
def testTwiceAndAsTheRivals(collider, periodic):
    """The list that YADE has stored for its own collider is of the real interactions."""
    def real(history):
        return [sorted((*sorted(i[:2]), i[3] if i[0] < i[1] else tuple(-c for c in i[3]))
                       for i in moment if i[2]) for moment in history[0]]
    first, second = run(collider, periodic), run(collider, periodic)
    assert first == second and len(first[0][-1]) > 50
    assert real(first) == real(run(collider.rival, periodic))


# --- bad input

def snapshot():
    """All that a failed search must leave alone."""
    bounds = [None if b.bound is None else (tuple(b.bound.min), tuple(b.bound.max), tuple(b.bound.refPos),
                                            b.bound.sweepLength, b.bound.lastUpdateIter) for b in O.bodies]
    states = [(tuple(b.state.pos), tuple(b.state.vel), tuple(b.state.ori)) for b in O.bodies]
    collider = O.engines[1]
    # as text, since a NaN is not equal to itself
    return repr((len(O.bodies), bounds, states, inOrder(), O.iter, collider.verletDist, collider.interval,
                 collider.numAction))


def start(collider, periodic=False, warm=True):
    rng = np.random.default_rng(1)
    if periodic:
        O.periodic = True
        O.cell.hSize = scenes.matrix(np.eye(3))
    O.dt = 1
    addSpheres(rng.uniform(.1, .9, (20, 3)), [.1] * 20, rng.normal(size=(20, 3)) * 1e-4)
    engine = setEngines(collider(verletDist=0))
    if warm:
        O.step()
        assert scenes.realPairs()
    return engine


kNowhere = Vector3(math.nan, .5, .5)


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
    O.bodies[5].state.pos = kNowhere
    with pytest.raises(RuntimeError):
        O.step()
    O.bodies[5].state.pos = good
    assert scenes.stepAndCheck(steps=5)


def testBadBodiesThatDoNotCount(collider):
    """Unbounded or erased bodies may be anything."""
    start(collider, warm=False)
    O.bodies[5].state.pos = kNowhere
    O.bodies[5].bounded = False
    O.bodies[6].state.pos = kNowhere
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
    before = snapshot()
    with pytest.raises(RuntimeError) as error:
        O.step()
    assert 'memory' in str(error.value) and len(str(error.value)) <= 300
    assert snapshot() == before
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
