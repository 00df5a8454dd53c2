"""Scenes for test_memory.py. `soak SECONDS`: builds, cracks, saves, loads, removes and adds for some seconds. `all
CLASS...`: small scenes that go through all of the plugin; then some of finite elements."""
import ctypes
import gc
import json
import math
import os
import pathlib
import random
import re
import sys
import tempfile
import time

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', '..', 'pkg', 'helpers')]

import numpy as np  # noqa: E402

import scenes  # noqa: E402
import yadefrag  # noqa: E402
from fe_scene import (bodyOf, brittle, brittleImpact, engines, heapSpheres, solverOfScene, steps,  # noqa: E402
                      throwBall)
from scenes import O  # noqa: E402
from yade import utils, wrapper as w  # noqa: E402
from yade.minieigenHP import Vector3  # noqa: E402

kColliders = (None, 'LebesgueCollider', 'HierarchyCollider', 'InsertionSortCollider')
kSquare = yadefrag.rectangle((2, 2), (2.01, 2.01))


def memory():
    """kB in use, once all that is free has gone back to the system."""
    gc.collect()
    ctypes.CDLL('libc.so.6').malloc_trim(0)
    return int(re.search(r'VmRSS:\s+(\d+)', pathlib.Path('/proc/self/status').read_text())[1])


def cycle(number, folder, draw):
    """One scene from its beginning to its end; returns its number of cracks."""
    O.reset()
    finder = kColliders[number % len(kColliders)]
    solver = brittleImpact(finder, threads=1 + number % 2, fractureEnergy=0, strengthScatter=.1)
    if finder and draw.random() < .5:
        heapSpheres()
    solver.minFragmentArea = draw.choice((0, 4e-6))
    yadefrag.runSteps(130)
    path = os.path.join(folder, draw.choice(('a.yade', 'a.yade.gz', 'a.xml')))
    record = yadefrag.recordFracture(solver, os.path.join(folder, 'a.csv'))
    O.run()
    for _ in range(4):  # of a scene that runs
        yadefrag.fragmentTable(solver)
        solver.damping = draw.random()
        record()
        yadefrag.exportVTK(solver, os.path.join(folder, 'a.vtu'))
    O.save(path)
    added = draw.random() < .5
    O.pause()
    if added:
        number = solver.addPolygon(kSquare, size=.005, material=brittle())
        yadefrag.runSteps(5)
        solver.removeBody(number)
    yadefrag.runSteps(20)
    O.load(path)
    solver = solverOfScene()
    yadefrag.runSteps(20)
    solver.removeBody(0)
    yadefrag.runSteps(5)
    cracks = solver.numCracks
    O.saveTmp()
    O.loadTmp()
    return cracks


def soak(seconds):
    """Prints a line of JSON: cracks, and the memory in use after each round (kB)."""
    draw = random.Random(1)
    end = time.time() + seconds
    cracks, used = [], []
    with tempfile.TemporaryDirectory() as folder:
        while time.time() < end or len(used) < 3 * len(kColliders):
            cracks.append(cycle(len(used), folder, draw))
            O.reset()
            used.append(memory())
    print('@@@ ' + json.dumps(dict(cracks=cracks, memory=used)), flush=True)


# --- all of the plugin

def addOthers():
    """In the spheres' unit box a facet, a wall, a box and a clump."""
    O.bodies.append(utils.facet([Vector3(0, 0, .3), Vector3(1, 0, .3), Vector3(0, 1, .3)]))
    O.bodies.append(utils.wall(0, axis=2))
    O.bodies.append(utils.box((.5, .5, 1), (.5, .5, .02), fixed=True))
    O.bodies.appendClumped([utils.sphere(Vector3(.5, .5, z), .06) for z in (.5, .56)])


def insertAndErase(rng):
    for k in range(0, 40, 3):
        O.bodies.erase(k)
    O.run(3, True)
    scenes.addSpheres(rng.uniform(-1, 2, (10, 3)), rng.uniform(.02, .15, 10))
    O.run(3, True)


def saveAndLoad():
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        for name in ('a.xml', 'a.yade.gz'):
            path = os.path.join(folder, name)
            O.save(path)
            O.load(path)
            O.run(2, True)


def badInput():
    """A body that is nowhere: the search raises and the scene remains valid."""
    state = O.bodies[1].state
    good = Vector3(state.pos)
    state.pos = Vector3(math.nan, 0, 0)
    try:
        O.engines[1]()
    except RuntimeError:
        state.pos = good
        O.run(2, True)
        return
    raise AssertionError('a position that is no number was accepted')


def probe():
    """BoxFactory requests free room from the collider."""
    factory = w.BoxFactory(maxParticles=5, extents=(.4, .4, .4), center=(.5, .5, 1.5), rMin=.03,
                           rMax=.05, vMin=.5, vMax=.5, normal=(0, 0, 1), massFlowRate=1000,
                           materialId=0, maxAttempt=100, stopIfFailed=False)
    before = len(O.bodies)
    O.engines = O.engines + [factory]
    O.run(3, True)
    O.engines = O.engines[:-1]
    assert len(O.bodies) > before


def run(name, periodic):
    """Returns how many interactions there were in all."""
    rng = np.random.default_rng(1)
    scenes.clear()
    if periodic:
        O.periodic = True
        O.cell.hSize = scenes.matrix([[1, .2, 0], [0, 1, 0], [0, 0, 1]])
        O.cell.velGrad = scenes.matrix(np.diag([.01, 0, -.01]))
    O.dt = 1
    scenes.addSpheres(rng.uniform(0, 1, (50, 3)), rng.uniform(.05, .1, 50), rng.normal(size=(50, 3)) * .01)
    if not periodic:
        addOthers()
    collider = scenes.makeCollider(name)
    scenes.setEngines(collider, interactionLoop=scenes.loop('CurveLoop') if name == 'LebesgueCollider' else None)
    O.run(5, True)
    insertAndErase(rng)
    badInput()
    saveAndLoad()
    if not periodic:
        probe()
    collider, = [e for e in O.engines if type(e).__name__ == name]
    collider.doSort = True
    collider.trueHalo = False
    O.run(2, True)
    return len(O.interactions.all())


# --- finite elements

def buildFE():
    fe = bodyOf(yadefrag.circle((0, 0), .1, 12), .05, velocity=(2, 0), smooth=True)
    fe.addPolygon(yadefrag.rectangle((.102, -.1), (.2, .1)), size=.05, material='m')
    throwBall((.15, .151), .05, (0, -1), blocked='')
    engines(fe)


def readAll(fe):
    for name in ('nodes', 'velocities', 'displacements', 'masses', 'triangles', 'stress', 'components', 'contactForces',
                 'surfaces', 'energy'):
        assert len(getattr(fe, name))
    return fe.fragments()


def refuse(fe):
    try:
        fe.addPolygon([(0, 0), (1, 1), (1, 0), (0, 1)], size=.1, material='m')
    except ValueError:
        return
    raise AssertionError('an outline that crosses itself was accepted')


def crack(finder):
    """A block that shatters: new bodies, bodies that go, saved in between."""
    O.reset()
    fe = bodyOf(yadefrag.rectangle((0, 0), (.02, .012)), .003, brittle(frictionAngle=.2, strengthScatter=.1, label='b'),
                dict(minFragmentArea=6e-6), smooth=True)
    fe.addPolygon(yadefrag.rectangle((.008, .0121), (.014, .018)), size=.003, material='b', velocity=(0, -60))
    engines(fe, finder)
    steps(60)
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        O.save(os.path.join(folder, 'a.yade'))
        O.load(os.path.join(folder, 'a.yade'))
    fe = solverOfScene()
    steps(60)
    readAll(fe)
    fe.fragments(held=True)
    assert fe.numCracks > 10 and fe.dropped['count'] > 0 and fe.fragmentOf.min() == -1
    fe.removeBody(0)
    O.step()


def finiteElements():
    """All of FESolver."""
    buildFE()
    steps(60)
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        for name in ('a.xml', 'b.yade'):
            O.save(os.path.join(folder, name))
            O.load(os.path.join(folder, name))
            steps(20)
    fe = solverOfScene()
    readAll(fe)
    refuse(fe)
    assert fe.numSearches > 0 and fe.energy['contact'] != 0
    fe.removeBody(0)
    O.step()
    fe.removeBody(1)
    O.step()
    for finder in ('LebesgueCollider', 'InsertionSortCollider'):
        crack(finder)
    O.reset()


if sys.argv[1] == 'soak':
    soak(float(sys.argv[2]))
else:
    for className in sys.argv[2:]:
        for isPeriodic in (False, True):
            print(f'@@@ {className} {isPeriodic} {run(className, isPeriodic)}', flush=True)
    scenes.clear()
    finiteElements()
    print('\n@@@ done', flush=True)
