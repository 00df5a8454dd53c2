"""Functions of YADE's O by which runs begin, rest and end: all between two steps, also by Ctrl-C;
long runs, with a progress bar on a terminal.

Python raises KeyboardInterrupt between any two instructions of the main thread, where code that has to finish may
lose it, and in no other thread. Within `wholeSteps` it is counted only: the run ends after its step, and then each
thread that waits for it raises KeyboardInterrupt."""

import atexit
import concurrent.futures
import contextlib
import functools
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

from yade import wrapper
from yadefrag import _yadefrag, messages
from yadefrag.arguments import shown, shownPath, whole
from yadefrag.files import keptAside, requireWritable
from yadefrag.scene import scene_check

_LOOK = .05  # s, from one check for Ctrl-C to the next
_saving = threading.RLock()  # held while a run rests for a save
_count = SimpleNamespace(pauses=0, interrupts=0)
_LOGGERS = ('ThreadRunner', 'yadeWrapper.cpp')  # YADE's lines about an error of a step
_refusals = SimpleNamespace(waiting=0, levels={})  # runs that a script waits for; {logger: its level before}
MOST_STEPS = 2**62  # the largest number that YADE can count


class _Thread(threading.local):
    """The interrupts that a thread knows, and the depth of its `wholeSteps`."""

    def __init__(self):
        self.known, self.depth = _count.interrupts, 0
        if threading.current_thread() is not threading.main_thread():
            # Else Linux may deliver the signal here, and the main thread goes on waiting.
            signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])


_mine = _Thread()


@contextlib.contextmanager
def wholeSteps() -> Iterator[None]:
    """Ctrl-C raises KeyboardInterrupt at the begin of the block and at its end, nowhere within it."""
    _raiseInterrupt()
    _mine.depth += 1
    try:
        yield
    finally:
        _mine.depth -= 1
    _raiseInterrupt()


def _raiseInterrupt():
    if _mine.known != _count.interrupts:
        _mine.known = _count.interrupts
        _yadefrag.stopRun()
        raise KeyboardInterrupt


def _interrupt(number, frame):
    """Python calls it in the main thread."""
    _count.interrupts += 1
    if not _mine.depth:
        _mine.known = _count.interrupts
        signal.default_int_handler(number, frame)


def _stay(hasEnded):
    while not hasEnded():
        if _mine.known != _count.interrupts:
            _yade.pause(wrapper.Omega())


def _aside(call):
    """call() in another thread: Python handles no signals in this one while YADE waits in it."""
    with concurrent.futures.ThreadPoolExecutor(1) as other:
        try:
            called = other.submit(call)
            _stay(lambda: concurrent.futures.wait([called], _LOOK).done)
        except BaseException:  # of a script's own handler
            _yadefrag.stopRun()  # else it would wait for the next run, and take its error
            raise
    return called.result()


@contextlib.contextmanager
def _raisedHere():
    """The block waits for a run, and raises the error if FESolver refuses a step: YADE's lines about the same error
    are not written. Errors of other engines are written as ever."""
    _refusals.waiting += 1
    try:
        yield
    finally:
        _refusals.waiting -= 1
        while _refusals.levels and not _refusals.waiting:
            from yade import log
            name, level = _refusals.levels.popitem()
            if level < 0:
                log.unsetLevel(name)  # that of the default
            else:
                log.setLevel(name, level)


def silenceRefusal() -> None:
    """FESolver calls this in a step that it refuses."""
    for name in _LOGGERS if _refusals.waiting else ():
        from yade import log
        _refusals.levels.setdefault(name, log.getAllLevels().get(name, -1))
        log.setLevel(name, 0)


def _rests():
    with _saving:
        return not wrapper.Omega().running


def waitForEnd() -> None:
    """O.wait() without its delay of up to 40 ms; an exception of a step is not raised again."""
    with wholeSteps():
        _stay(lambda: _yadefrag.waitForEnd() and _rests())


def _waitWith(omega, begin):
    """begin(), then YADE's O.wait(), which has the errors of engines, but not of a run that has ended before."""
    with _raisedHere():
        _aside(begin)
        while not _rests():
            _aside(lambda: _yade.wait(omega))
        why = _yadefrag.whyStopped()
        if not why and omega.subStep != -1:
            _yadefrag.stopRun()  # if paused, the last step may not be complete
            if omega.subStep != -1:
                why = 'An engine has failed in step %d; YADE has written the reason to stderr.' % omega.iter
        if why:
            raise RuntimeError(why)


@contextlib.contextmanager
def _resting():
    """Interrupts a run of another thread between two steps, and continues it afterwards."""
    omega = wrapper.Omega()
    if _yadefrag.isInStep() or not omega.running or \
            not any(isinstance(e, wrapper.FESolver) for e in omega.engines):
        yield
        return
    with _saving:
        before = omega.stopAtIter, omega.stopAtTime, _count.pauses
        _yadefrag.stopRun()
        # A failed step, the end of the run and O.pause() are final.
        isToGoOn = omega.subStep == -1 and before == (omega.stopAtIter, omega.stopAtTime, _count.pauses)
        try:
            yield
        finally:
            if isToGoOn:
                _yadefrag.beginRun(_yade.run, None, omega, -1)


class _Functions:
    """In the place of YADE's own, which are in _yade."""

    def run(self, nSteps=-1, wait=False):
        """Returns after the run has begun: YADE may crash if it is stopped before."""
        messages.tellNumbers()
        scene_check.tellUnmoved()
        _yadefrag.whyStopped()
        with wholeSteps():
            if wait:
                _waitWith(self, lambda: _yadefrag.beginRun(_yade.run, _yade.wait, self, nSteps))
            else:
                _yadefrag.beginRun(_yade.run, None, self, nSteps)

    def wait(self: Any) -> None:
        with wholeSteps():
            if self.running or not _rests():
                _waitWith(self, lambda: _yade.wait(self))

    def pause(self):
        _count.pauses += 1
        _yade.pause(self)

    def reset(self):
        """YADE waits for the end of a run with Python's lock held, which its last step may need; and objects in
        lists that were passed to it are never freed."""
        if _yadefrag.isInStep():
            return _yade.reset(self)
        _yadefrag.stopRun()
        messages.forget()
        _yade.reset(self)
        _yadefrag.freeListItems()

    def exitNoBacktrace(self, status=0):
        """YADE waits for the run as in `reset`."""
        if not _yadefrag.isInStep():
            _yadefrag.stopRun()
        _yade.exitNoBacktrace(self, status)

    def saveTmp(self, mark='', quiet=False):
        with _resting():
            _yade.saveTmp(self, mark, quiet)

    def save(self, file, quiet=False):
        """Names a file that cannot be written: YADE would not report it, or not end if it is compressed. The former
        file is kept then."""
        if not isinstance(file, str) or file.startswith(':memory:'):
            with _resting():
                return _yade.save(self, file, quiet)
        try:
            requireWritable(file)
            with _resting(), keptAside(file):
                _yade.save(self, file, quiet)
                requireWritable(file)  # YADE does not report that the last part of the file was lost
        except (OSError, RuntimeError) as error:
            cause = getattr(error, 'strerror', '')
            if not cause and str(error) != 'output stream error':
                raise
            raise RuntimeError('%s could not be saved: its file cannot be opened or the disk is full%s.' %
                               (shownPath(file), ' (%s)' % cause if cause else '')) from None


_own = {name: call for name, call in vars(_Functions).items() if not name.startswith('_')}
_yade = SimpleNamespace(**{name: getattr(wrapper.Omega, name) for name in _own})


def install() -> None:
    for name, call in _own.items():
        setattr(wrapper.Omega, name, functools.wraps(getattr(_yade, name))(call))
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # a handler of the script is kept
        signal.signal(signal.SIGINT, _interrupt)
    _yadefrag.watchListItems()
    # The process must not end in the middle of a step.
    atexit.register(_yadefrag.stopRun)


def requireNoStep(what: str) -> None:
    """A run within a step would wait for the end of that step, which waits for the run: RuntimeError."""
    if _yadefrag.isInStep():
        raise RuntimeError('%s runs the scene: it cannot be called within a step, as from a PyRunner.' % what)
    _yadefrag.requirePaused()


def runSteps(steps: int, every: int | None = None, call: Callable[[], object] | None = None) -> int:
    """Runs `steps` steps of the scene; returns the number of steps done.

    every, call  if given, call() is called after each `every` steps
    On a terminal a bar shows steps, simulated time and remaining time. Ctrl-C stops after a whole step
    and raises KeyboardInterrupt, so that it ends a script with a loop of runs, too, also one in a
    thread; O.pause() from a PyRunner stops as well, without an exception. The scene is left in that
    state, and the run can be continued. O.resetTime() in a step counts anew, as in O.run(). RuntimeError if an engine stopped the run, with the message of
    FESolver; messages of other engines are written by YADE.
    """
    steps = whole('steps', steps, most=MOST_STEPS)
    every = None if every is None else whole('every', every, most=MOST_STEPS)
    if (call is None) != (every is None) or call is not None and not callable(call):
        raise ValueError('call is %s with every=%s: give a function and the number of steps between its '
                         'calls.' % (shown(call), shown(every)))
    requireNoStep('runSteps')
    omega = wrapper.Omega()
    done, begin = 0, omega.iter
    try:
        with _bar(steps) as bar:
            portion = 1
            while done < steps:
                with wholeSteps():
                    now = min(portion, steps - done, every - done % every if every else steps)
                    start = time.perf_counter()
                    part, isPaused = runPart(now)
                    done += part
                    if bar is not None:
                        bar.set_postfix_str('t = %.4g s' % omega.time, refresh=False)
                        bar.update(done - bar.n)
                if call is not None and every and part and done % every == 0:
                    call()
                if isPaused:
                    break
                # Portions of about a tenth of a second: the bar moves between them.
                seconds = max(time.perf_counter() - start, 1e-9)
                portion = max(1, min(2 * now, int(.1 * now / seconds)))
    except KeyboardInterrupt:
        print('Stopped after %d of %d steps, at %.6g s.' % (omega.iter - begin, steps, omega.time), file=sys.stderr)
        raise
    return done


def _bar(steps):
    """Of None unless standard error is a terminal: a run on a server needs no tqdm."""
    if sys.stderr is None or not sys.stderr.isatty():
        return contextlib.nullcontext()
    import tqdm
    return tqdm.tqdm(total=steps, unit='step')


def runPart(steps: int) -> tuple[int, bool]:
    """Runs `steps` steps; returns the number of steps done, and whether the run was paused
    meanwhile.

    RuntimeError if an engine stopped the run, KeyboardInterrupt after Ctrl-C.
    """
    omega = wrapper.Omega()
    begin, pauses = omega.iter, _count.pauses
    try:
        with _raisedHere():
            omega.run(steps)
            waitForEnd()
    except BaseException:
        _yadefrag.stopRun()
        omega.stopAtIter = -1
        raise
    if omega.iter - begin == steps and pauses == _count.pauses:
        return steps, False
    _yadefrag.stopRun()  # O.wait() does not wait for the end of a paused run's last step
    done = max(0, omega.iter - begin)  # O.resetTime() may be called in a step
    if done < steps:
        omega.stopAtIter = -1  # otherwise the next O.run() would stop there
    if omega.subStep != -1:
        why = _yadefrag.whyStopped()
        raise RuntimeError('The run stopped in step %d%s' % (omega.iter, ': ' + why if why else '.'))
    return done, True
