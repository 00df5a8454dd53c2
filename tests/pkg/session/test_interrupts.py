"""One Ctrl-C ends a script's run after a whole step: loops of runs, too, in the main thread and in others."""

import builtins
import os
import signal
import threading
import time

import pytest

import yadefrag
from yade import utils, wrapper as w
from yadefrag import runSteps

O = builtins.O


def made(size):
    O.reset()
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.3, label='m'))
    solver = w.FESolver()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=size, material='m', velocity=lambda x, y: (x, y))
    O.engines = [solver]
    O.dt = .5 * solver.criticalTimeStep()
    return solver


@pytest.fixture
def fe():
    return made(.05)


def waiting():
    O.run(10)
    O.wait()


RUNS = dict(short=lambda fe: runSteps(10), long=lambda fe: runSteps(10**9), step=lambda fe: O.step(),
            called=lambda fe: runSteps(10, every=3, call=lambda: None), waits=lambda fe: waiting(),
            run=lambda fe: O.run(10, True), longRun=lambda fe: O.run(10**9, True),
            relax=lambda fe: fe.relax(1e-300, most=40), longRelax=lambda fe: fe.relax(1e-300))


def forEver(run, fe, told):
    try:
        while time.monotonic() < told['latest']:
            run(fe)
    except KeyboardInterrupt:
        told['interrupts'] = told.get('interrupts', 0) + 1


def interruptAfter(seconds):
    threading.Timer(seconds, lambda: os.kill(os.getpid(), signal.SIGINT)).start()


def checkAtRest():
    assert not O.running and O.subStep == -1
    begin = O.iter
    assert runSteps(10) == 10 == O.iter - begin  # goes on, and no interrupt is left


@pytest.mark.filterwarnings('ignore:relax')
@pytest.mark.parametrize('name', RUNS)
def test_oneEndsALoopOfRuns(name, fe):
    for k in range(4):
        told = dict(latest=time.monotonic() + 60)
        interruptAfter(.1 + .0137 * k)
        forEver(RUNS[name], fe, told)
        assert told.get('interrupts') == 1
        checkAtRest()


@pytest.mark.filterwarnings('ignore:relax')
@pytest.mark.parametrize('name', RUNS)
def test_oneEndsALoopInAThread(name, fe):
    for k in range(4):
        told = dict(latest=time.monotonic() + 60)
        thread = threading.Thread(target=forEver, args=(RUNS[name], fe, told))
        thread.start()
        interruptAfter(.1 + .0137 * k)
        with pytest.raises(KeyboardInterrupt):
            while thread.is_alive():
                time.sleep(.02)
        thread.join(60)
        assert told.get('interrupts') == 1
        checkAtRest()


def test_aRunnerIsNotInterrupted(fe):
    """Not in the middle of its command, which would end the step by an error."""
    done = []
    builtins.slowly = lambda: done.append(time.sleep(.3))
    O.engines = O.engines + [w.PyRunner(command='slowly()', iterPeriod=1, initRun=True)]
    try:
        interruptAfter(.1)
        with pytest.raises(KeyboardInterrupt):
            O.step()
    finally:
        del builtins.slowly
    assert len(done) == O.iter == 1


def test_messageCountsSteps(fe, capsys):
    interruptAfter(.2)
    with pytest.raises(KeyboardInterrupt):
        runSteps(10**9)
    assert 'Stopped after %d of 1000000000 steps' % O.iter in capsys.readouterr().err
    assert O.stopAtIter == -1  # no later run ends at a part of this one
    finer = made(.01)  # is not at rest to rounding by then
    begin = O.iter
    interruptAfter(.2)
    with pytest.raises(KeyboardInterrupt):
        finer.relax(1e-300)
    assert 'relax: stopped after %d steps' % (O.iter - begin) in capsys.readouterr().err


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


def test_errorsOfAFirstStepAreRaised():
    """However soon after the begin of the run."""
    for _ in range(30):
        O.reset()
        O.engines = [w.PyRunner(command='missing()', iterPeriod=1, initRun=True)]
        for _ in range(2):  # the second run begins with the rest of the failed step
            with pytest.raises(RuntimeError, match="'missing' is not defined"):
                O.run(5, True)


def test_errorsOfAnyEngineAreRaised():
    """YADE's own O.wait() may be too late for those of engines in C++."""
    for _ in range(30):
        O.reset()
        O.bodies.append(utils.sphere((0, 0, 0), 1))
        O.engines = [w.InsertionSortCollider([w.Bo1_Sphere_Aabb()])]
        with pytest.raises(RuntimeError, match='unable to locate NewtonIntegrator|An engine has failed in step 0'):
            O.run(5, True)


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
