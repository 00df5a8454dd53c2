"""One Ctrl-C ends a script's run after a whole step: loops of runs, too, in the main thread and in others; an error of
a step ends it with its own sentence."""
import builtins
import os
import signal
import threading
import time

import pytest

import fe_scene
import yadefrag
from yade import utils, wrapper as w
from yadefrag import runSteps

O = builtins.O


@pytest.fixture
def fe():
    solver = fe_scene.fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.05, material='m', velocity=lambda x, y: (x, y))
    fe_scene.ready(solver, .5)
    return solver


def waiting():
    O.run(10)
    O.wait()


RUNS = dict(short=lambda fe: runSteps(10), long=lambda fe: runSteps(10**9),
            called=lambda fe: runSteps(10, every=3, call=lambda: None), waits=lambda fe: waiting(),
            run=lambda fe: O.run(10, True), longRun=lambda fe: O.run(10**9, True),
            relax=lambda fe: fe.relax(1e-300, most=40), longRelax=lambda fe: fe.relax(1e-300))


def interruptAfter(seconds):
    threading.Timer(seconds, lambda: os.kill(os.getpid(), signal.SIGINT)).start()


def checkAtRest():
    assert not O.running and O.subStep == -1
    begin = O.iter
    assert runSteps(10) == 10 == O.iter - begin  # goes on, and no interrupt is left


@pytest.mark.filterwarnings('ignore:relax')
@pytest.mark.parametrize('where', ['main', 'thread'])
@pytest.mark.parametrize('name', RUNS)
def test_oneEndsALoopOfRuns(name, where, fe):
    told = []

    def forEver():
        latest = time.monotonic() + 60
        try:
            while time.monotonic() < latest:
                RUNS[name](fe)
        except KeyboardInterrupt:
            told.append(O.iter)

    for k in range(4):
        interruptAfter(.1 + .0137 * k)
        if where == 'main':
            forEver()
        else:
            thread = threading.Thread(target=forEver)
            thread.start()
            with pytest.raises(KeyboardInterrupt):
                while thread.is_alive():
                    time.sleep(.02)
            thread.join(60)
        assert len(told) == k + 1
        checkAtRest()


def test_messageCountsSteps(fe, capsys):
    interruptAfter(.2)
    with pytest.raises(KeyboardInterrupt):
        runSteps(10**9)
    assert 'Stopped after %d of 1000000000 steps' % O.iter in capsys.readouterr().err
    assert O.stopAtIter == -1  # no later run ends at a part of this one
    checkAtRest()


def test_anotherHandlerIsKept(fe):
    """A script's own handler is called during a run, and its exception ends the run."""
    class Mine(Exception):
        pass

    def handler(number, frame):
        raise Mine

    before = signal.signal(signal.SIGINT, handler)
    try:
        for run in RUNS['long'], RUNS['longRun']:
            interruptAfter(.1)
            with pytest.raises(Mine):
                run(fe)
            assert signal.getsignal(signal.SIGINT) is handler
            assert not O.running
    finally:
        signal.signal(signal.SIGINT, before)
    checkAtRest()


def spheres(law=True, collider='LebesgueCollider', gap=0.):
    O.bodies.append([utils.sphere((0, 0, 0), .5), utils.sphere((0, 0, .99 + gap), .5)])
    O.bodies[1].state.vel = (0, 0, -1)
    return [w.ForceResetter(), getattr(w, collider)([w.Bo1_Sphere_Aabb()]),
            w.CurveLoop([w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                        [w.Law2_ScGeom_FrictPhys_CundallStrack()] if law else []), w.CurveIntegrator(damping=0)]


def runner(command, at=1):
    return [w.PyRunner(command=command, iterPeriod=at, initRun=at == 1)]


FAILURES = {
    'PyRunner': (lambda: runner('missing()'), "'missing' is not defined"),
    "YADE's engine": (lambda: spheres(collider='InsertionSortCollider')[:2],
                      'unable to locate NewtonIntegrator|An engine has failed in step 0'),
    'no law': (lambda: spheres(law=False), 'CurveLoop has no Law2 functor .* 0 and 1'),
    'no law, later': (lambda: spheres(law=False, gap=.03), 'CurveLoop has no Law2 functor .* 0 and 1'),
    'no material': (lambda: spheres() + [setattr(O.bodies[1], 'material', None)][:0], '#1 has no material'),
    'no number': (lambda: spheres() + runner('O.bodies[1].state.pos = (float("nan"), 0, 0)'), 'not finite'),
    'no number, later': (lambda: spheres() + runner('O.bodies[1].state.pos = (float("nan"), 0, 0)', 20), 'not finite'),
}


@pytest.mark.parametrize('name', FAILURES)
def test_errorsAreRaised(name):
    """However soon after the begin of the run. YADE's own O.wait() may be too late for its engines in C++."""
    make, text = FAILURES[name]
    for _ in range(15):
        O.reset()
        O.dt = 1e-3
        O.engines = make()
        for _ in range(2):  # the second run begins with the rest of the failed step
            with pytest.raises(RuntimeError, match=text):
                O.run(50, True)


def test_oneEndsRunsThatArePausedAndBegunAnew(fe):
    """O.run() and O.pause(), each soon after the other, and Ctrl-C in between: nothing runs on."""
    for k in range(40):
        latest = time.monotonic() + 60
        interruptAfter(.01 + .0007 * k)
        with pytest.raises(KeyboardInterrupt):
            while time.monotonic() < latest:
                O.run(10**9)
                O.pause()
        O.pause()  # in vain, unless the interrupt came between the two
        assert not O.running
    checkAtRest()
