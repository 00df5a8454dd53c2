"""Runs in the background: reads see one state, others may not change the scene, saves are whole."""
import builtins
import concurrent.futures
import os
import threading

import numpy as np
import pytest

import yadefrag
from fe_scene import brittle, brittleImpact, O, steps
from project import inYade
from test_same_bits import differences, state
from yade import wrapper as w
from yadefrag import _yadefrag
from yadefrag.fe.contents import betweenSteps


def cracking():
    """A block that begins to crack, for some 300 steps from now on."""
    solver = brittleImpact()
    steps(120)
    return solver


@pytest.fixture
def running():
    """A solver whose scene cracks in the background."""
    solver = cracking()
    O.run()
    yield solver
    _yadefrag.stopRun()


def inThread(call):
    """What `call` returns or raises in another thread; this one waits meanwhile."""
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        future = executor.submit(call)
        return future.exception() or future.result()


# --- reads

def test_filesAreOfOneStep(running, folder):
    """Positions and displacements of one step differ by the stress-free places, which do not move."""
    import meshio
    path = os.path.join(folder, 'a.vtu')
    counts = set()
    for _ in range(60):
        yadefrag.exportVTK(running, path)
        mesh = meshio.read(path)
        reference = running._reference[:len(mesh.points)]
        places = (mesh.points - mesh.point_data['displacement'])[:, :2]
        assert np.abs(places - reference).max() < 1e-12
        counts.add(len(mesh.points))
    assert O.running and len(counts) > 3  # it cracked meanwhile


def test_allReadsSeeWholeSteps(running, folder):
    record = yadefrag.recordFracture(running, os.path.join(folder, 'a.csv'))
    first = running.numCracks
    for _ in range(15):
        assert running.minAngle > 0
        record()
        assert len(yadefrag.fragmentTable(running)) > 0
        for field in ('mises', 'speed', 'fragment'):
            yadefrag.plotMesh(running, field)
        with betweenSteps(running):
            assert len(running.nodes) == len(running.velocities) == len(running.contactForces)
            assert running.numSegments == sum(map(len, running.surfaces))
            assert running.damping == 0
            before = running.nodes
            assert np.array_equal(running.nodes, before)
    assert O.running and running.numCracks > first


def test_readsOfManyThreads(running):
    """Threads that hold the lock, and give Python's lock up meanwhile, do not block one another."""
    stop, seen = threading.Event(), []

    def read():
        while not stop.is_set():
            with betweenSteps(running):
                seen.append(len(running.nodes) == len(running.masses))
                sum(range(20000))
    threads = [threading.Thread(target=read) for _ in range(3)]
    for thread in threads:
        thread.start()
    begin = O.iter
    while O.iter < begin + 20:
        running.energy
    _yadefrag.stopRun()
    for _ in range(20):  # O.step() has Python's lock all the time
        O.step()
    stop.set()
    for thread in threads:
        thread.join()
    assert all(seen) and len(seen) > 20


def test_settingsChangeBetweenSteps(running):
    for value in range(50):
        running.damping = value
        assert running.damping == value
    with pytest.raises(ValueError, match='damping'):
        running.damping = -1
    assert running.damping == 49


# --- changes

kSquare = yadefrag.rectangle((2, 2), (3, 3))


def changes(solver):
    loads = solver.loads
    return [lambda: solver.addPolygon(kSquare, size=.5, material=brittle()), lambda: solver.removeBody(0),
            lambda: setattr(solver, 'loads', loads), lambda: solver.prescribe([0], vx=1)]


def test_nothingChangesWhileItRuns(running):
    """Neither in the main thread nor in another one."""
    for call in changes(running):
        with pytest.raises(RuntimeError, match='^The simulation is running: call O.pause'):
            call()
        assert 'The simulation is running' in str(inThread(call))
    assert O.running and len(set(running.components)) == 2


def test_othersMayChangeWhatRests():
    solver = cracking()
    assert inThread(changes(solver)[0]) == 2
    O.step()


def test_changesWaitForTheLastStep():
    """O.pause() returns in the middle of a step, and O.wait() does not wait for its end."""
    solver = cracking()
    for _ in range(40):
        begin = O.iter
        O.run()
        while O.iter == begin:
            pass
        O.pause()
        added = solver.addPolygon(kSquare, size=.5, material=brittle())
        assert O.subStep == -1
        solver.removeBody(added)


def test_aPyRunnerMayChangeWhatRuns():
    """Before the first step of the solver, too, and after it has paused the run."""
    solver = cracking()
    added = []

    def addOne():
        if len(added) < 2:
            O.pause()
            left = 2 + 2 * len(added)
            added.append(solver.addPolygon(yadefrag.rectangle((left, 0), (left + 1, 1)), size=.5, material=brittle()))
    builtins.addOne = addOne
    O.engines = [w.PyRunner(command='addOne()', iterPeriod=1)] + O.engines
    try:
        O.run(5, True)
        O.run(5, True)
    finally:
        del builtins.addOne
    assert added == [2, 3]


# --- pauses and saves

@pytest.mark.parametrize('at', [1, 4, 7])
def test_pauseEndsTheRun(at, folder):
    solver = brittleImpact()
    O.engines = O.engines + [w.PyRunner(command='O.pause()', iterPeriod=at, initRun=False)]
    O.step()  # from which the PyRunner counts
    for _ in range(3):
        begin = O.iter
        assert yadefrag.runSteps(20) == O.iter - begin == at
        assert O.subStep == -1
    called = []
    assert yadefrag.runSteps(20, every=1, call=lambda: called.append(O.iter)) == at == len(called)
    path = os.path.join(folder, 'a.gif')
    assert yadefrag.animate(solver, path, 20, 2) == 2 + (at - 1) // 2  # of at = 4: at steps 0, 2, 4 and its end
    assert os.path.getsize(path)


def test_resetTimeIsNoEnd():
    brittleImpact()
    assert yadefrag.runSteps(3, every=1, call=O.resetTime) == 3 and O.iter == 0


def test_failureEndsTheRun():
    brittleImpact()
    O.engines = O.engines + [w.PyRunner(command='1 / 0', iterPeriod=4, initRun=False)]
    with pytest.raises(RuntimeError):
        yadefrag.runSteps(20)


def test_savedInTheBackground():
    """Each save is of a whole step: the run that is loaded goes on with the same bits."""
    cracking()
    last = O.iter + 150
    steps(150)
    wanted = state()
    O.reset()
    cracking()
    marks = []

    def save():
        while O.iter < last - 5:
            O.saveTmp(str(len(marks)))
            marks.append(str(len(marks)))
    saver = threading.Thread(target=save)
    O.run(150)
    saver.start()
    O.wait()
    assert O.iter == last and not O.running
    saver.join()
    assert differences(wanted, state()) == []
    seen = set()
    for mark in marks[::max(1, len(marks) // 6)]:
        O.loadTmp(mark)
        seen.add(O.iter)
        while O.iter < last:
            O.step()
        assert differences(wanted, state()) == []
    assert len(seen) > 1


# --- ends

kScene = '''
import sys
import time

import yadefrag
from yade import utils, wrapper as w

kind = sys.argv[1]
if kind == 'moved':  # bodies and contacts are moved in memory, with Python's lock
    O.bodies.append([utils.sphere((i % 14 * .97, i // 14 % 14 * .97, i // 196 * .97), .5) for i in range(14 ** 3)])
    O.engines = [w.ForceResetter(), w.InsertionSortCollider([w.Bo1_Sphere_Aabb()]),
                 w.CurveLoop([w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                             [w.Law2_ScGeom_FrictPhys_CundallStrack()]), w.CurveIntegrator(damping=.2)]
    O.dt = 1e-4
    O.run()
    while O.iter < 31:
        pass
    print('@@@ end', O.iter, flush=True)
    O.exitNoBacktrace()
material = w.BrittleFEMat(young=1e7, poisson=.3, density=1000, tensileStrength=1e4)
solver = w.FESolver()
solver.addTriangles(*yadefrag.rectangleMesh((0, 0), (1, .5), 16, 8), material=material,
                    velocity=lambda x, y: (20 * (x - .5), 20 * (y - .25)))
O.engines = [w.ForceResetter(), solver]
if kind != 'alone':
    O.engines = O.engines + [w.PyRunner(command='solver.numCracks', iterPeriod=1)]
O.dt = .5 * solver.criticalTimeStep()
O.run()
while O.iter < 3:
    time.sleep(.001)
if kind == 'reset':
    for _ in range(20):
        O.reset()
        O.engines = [w.PyRunner(command='solver.numCracks', iterPeriod=1)]
        O.run()
print('@@@ end', O.iter, flush=True)
if kind == 'exit':
    O.exitNoBacktrace()
'''


@pytest.mark.parametrize('kind', ['alone', 'PyRunner', 'reset', 'exit', 'moved'])
def test_scriptEndsWhileItRuns(kind, tmp_path):
    (tmp_path / 'scene.py').write_text(kScene)
    done = inYade(tmp_path / 'scene.py', kind, timeout=60)
    assert done.returncode == 0, done.stdout[-2000:]
    assert '@@@ end' in done.stdout
