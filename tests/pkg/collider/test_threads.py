"""yade -j1, -j2, -j3: collider, loop and integrator give the same interactions in the same order, and the same motion; so
does the same scene a second time, as YADE's checkColliderConstantness.py requires of its own collider."""
import functools
import json
import os
import subprocess

import pytest
import yade
import yade.wrapper as w
from yade import pack, utils
from yade.minieigenHP import Vector3
import scenes
from project import yadeCommand
from scenes import O, setEngines


kHere = os.path.dirname(os.path.abspath(__file__))
# Scenes of threads_scene.py: the least number of interactions, or of contacts where bodies are stirred.
kScenes = dict(gas=500, mixed=500, periodic=500, stirred=1600, NewtonIntegrator=0, CurveIntegrator=0)


@functools.cache
def dump(name, threads, scenes=tuple(kScenes)):
    """What threads_scene.py prints: {scene: {'threads': number, 'moments': [{'interactions': number, 'bits': text}]}}."""
    done = subprocess.run(
        yadeCommand() + [f'-j{threads}', os.path.join(kHere, 'threads_scene.py'), name, *scenes],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600)
    lines = [x[4:] for x in done.stdout.splitlines() if x.startswith('@@@ ')]
    assert done.returncode == 0 and len(lines) == len(scenes), done.stdout[-1500:] + done.stderr[-1500:]
    return dict(zip(scenes, map(json.loads, lines)))


@pytest.mark.parametrize('scene', kScenes)
def testThreads(collider, scene):
    one, two, three = (dump(collider.name, threads)[scene] for threads in (1, 2, 3))
    assert [found['threads'] for found in (one, two, three)] == [1, 2, 3]
    assert one['moments'] == two['moments'] == three['moments']
    counts = [moment['contacts' if scene == 'stirred' else 'interactions'] for moment in one['moments']]
    assert min(counts) >= kScenes[scene]


def testIntegratorsAgree(collider):
    found = dump(collider.name, 1)
    assert found['NewtonIntegrator']['moments'] == found['CurveIntegrator']['moments']


def testTwoProcesses(collider):
    """Nothing depends on addresses: two runs of one scene are the same, order included."""
    assert dump(collider.name, 1)['mixed'] == dump.__wrapped__(collider.name, 1, ('mixed',))['mixed']


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
        history.append([(i.id1, i.id2, i.isReal, tuple(i.cellDist)) for i in O.interactions.all()])
    return history, scenes.positions().tolist()


@pytest.mark.parametrize('periodic', [False, True], ids=['open', 'periodic'])
def testTwiceAndAsTheRivals(collider, periodic):
    """The list that YADE has stored for its own collider is of the real interactions."""
    def real(history):
        return [sorted((*sorted(i[:2]), i[3] if i[0] < i[1] else tuple(-c for c in i[3]))
                       for i in moment if i[2]) for moment in history[0]]
    first, second = run(collider, periodic), run(collider, periodic)
    assert first == second and len(first[0][-1]) > 50
    assert real(first) == real(run(collider.rival, periodic))


def testAfterReload(collider):
    """Loaded from memory, the scene gives the same list once more."""
    build(collider, True)
    O.run(100, True)
    O.saveTmp('constant')
    lists = []
    for _ in range(2):
        O.loadTmp('constant')
        O.run(400, True)
        lists.append([(i.id1, i.id2, i.isReal, tuple(i.cellDist)) for i in O.interactions.all()])
    assert lists[0] == lists[1] != []
