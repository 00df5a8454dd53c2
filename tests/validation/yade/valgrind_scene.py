"""A small scene that goes through all of the plugin, for test_valgrind.py: CLASS...; then one
of finite elements."""
import math
import os
import sys
import tempfile

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', '..', 'pkg', 'helpers')]

import numpy as np

import fe_valgrind_scene
import scenes
from scenes import O
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Vector3


def build(rng):
    """50 moving spheres in a unit box with a facet, a wall, a box and a clump."""
    O.dt = 1
    scenes.addSpheres(rng.uniform(0, 1, (50, 3)), rng.uniform(.05, .1, 50),
                      rng.normal(size=(50, 3)) * .01)
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
        scenes.addSpheres(rng.uniform(0, 1, (50, 3)), rng.uniform(.05, .1, 50),
                          rng.normal(size=(50, 3)) * .01)
    else:
        build(rng)
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


for className in sys.argv[1:]:
    for isPeriodic in (False, True):
        print(f'@@@ {className} {isPeriodic} {run(className, isPeriodic)}', flush=True)
scenes.clear()
fe_valgrind_scene.main()
print('\n@@@ done', flush=True)
