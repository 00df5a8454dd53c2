"""Replaces functions of YADE's O for runs in the background: stop, save and reset act between steps."""

import atexit
import contextlib
import functools
import threading

from yade import wrapper
from yadefrag import _yadefrag, messages
from yadefrag.arguments import shownPath
from yadefrag.io.files import requireWritable
from yadefrag.scene import interrupts, refusals, scene_check

_Omega = wrapper.Omega
_saving = threading.RLock()  # held while a run is interrupted for a save
_pauses = 0
_stepsBefore = 0  # sum over all calls of O.resetTime()


def pauses() -> int:
    """Number of calls of O.pause()."""
    return _pauses


def stepsDone() -> int:
    """Steps so far: O.iter, corrected for O.resetTime()."""
    return _Omega().iter + _stepsBefore


@contextlib.contextmanager
def _resting():
    """Interrupts a run of another thread between two steps, and continues it afterwards."""
    omega = _Omega()
    if _yadefrag.isInStep() or not omega.running or \
            not any(isinstance(e, wrapper.FESolver) for e in omega.engines):
        yield
        return
    with _saving:
        before = omega.stopAtIter, omega.stopAtTime, _pauses
        _yadefrag.stopRun()
        # A failed step, the end of the run and O.pause() are final.
        isToGoOn = omega.subStep == -1 and before == (omega.stopAtIter, omega.stopAtTime, _pauses)
        try:
            yield
        finally:
            if isToGoOn:
                omega.run()


def _savedWhole(save):
    @functools.wraps(save)
    def saved(self, *arguments, **settings):
        with _resting():
            return save(self, *arguments, **settings)
    return saved


def _savedOrRefused(save):
    """O.save that names a file which cannot be written. YADE alone would not report it for a small scene,
    and would never end for a compressed file."""
    @functools.wraps(save)
    def saved(self, *arguments, **settings):
        name = (*arguments, settings.get('file'))[0]
        isFile = isinstance(name, str) and not name.startswith(':memory:')
        try:
            if isFile:
                requireWritable(name)
            save(self, *arguments, **settings)
            if isFile:
                requireWritable(name)  # YADE does not report that the last part of the file was lost
        except (OSError, RuntimeError) as error:
            cause = getattr(error, 'strerror', '')
            if not cause and str(error) != 'output stream error':
                raise
            raise RuntimeError('%s could not be saved: its file cannot be opened or the disk is full%s.' %
                               (shownPath(name), ' (%s)' % cause if cause else '')) from None
    return saved


def _countPauses(pause):
    @functools.wraps(pause)
    def counted(self):
        global _pauses
        _pauses += 1
        pause(self)
    return counted


def _countSteps(resetTime):
    """O.resetTime() after which a run in progress still ends after its number of steps."""
    @functools.wraps(resetTime)
    def counted(self):
        global _stepsBefore
        ahead = self.stopAtIter - self.iter
        _stepsBefore += self.iter
        resetTime(self)
        if ahead > 0:
            self.stopAtIter = ahead
    return counted


def _waitForAll(wait):
    """O.wait() that Ctrl-C ends, and that does not end during the interruption for a save."""
    @functools.wraps(wait)
    def waited(self):
        with interrupts.waiting():
            interrupts.aside(lambda: wait(self))
            _waitOn(self, wait)
    return waited


def _waitOn(omega, wait):
    """After a first wait: until no save interrupts the run any more."""
    while True:
        with _saving:
            if not omega.running:
                return
        interrupts.aside(lambda: wait(omega))


def waitForEnd() -> None:
    """O.wait() without its delay of up to 40 ms; an exception of a step is not raised again."""
    with interrupts.waiting():
        while True:
            _yadefrag.waitForEnd()
            with _saving:
                if not _Omega().running:
                    return


def _runBegun(run, wait):
    """O.run() that returns after the run has begun: YADE may crash if a run is stopped before. If the script
    waits, each error of a step is raised, not only those for which YADE's O.wait() is in time."""
    def begin(omega, nSteps):
        try:
            with interrupts.held():
                _yadefrag.beginRun(run, None, omega, nSteps)
        except KeyboardInterrupt:
            _yadefrag.stopRun()
            raise

    def beginAndWait(omega, nSteps):
        with interrupts.waiting(), refusals.raisedHere():
            interrupts.aside(lambda: _yadefrag.beginRun(run, wait, omega, nSteps))
            _waitOn(omega, wait)
            _raiseError(omega)

    @functools.wraps(run)
    def runs(self, nSteps=-1, wait=False):
        messages.tellNumbers()
        scene_check.tellUnmoved()
        _yadefrag.whyStopped()
        (beginAndWait if wait else begin)(self, nSteps)
    return runs


def _raiseError(omega):
    """YADE's O.wait() raises no error of a run that has ended before it was called."""
    why = _yadefrag.whyStopped()
    if not why and omega.subStep != -1:
        _yadefrag.stopRun()  # if paused, the last step may not be complete
    if not why and omega.subStep != -1:
        why = 'An engine has failed in step %d; YADE has written the reason to stderr.' % omega.iter
    if why:
        raise RuntimeError(why)


def _wholeStep(step):
    """O.step() with the messages that come before a run; Ctrl-C ends it after its last engine, not in a PyRunner,
    which would fail."""
    @functools.wraps(step)
    def stepped(self):
        if untold:
            messages.tellNumbers()
        if solvers.data:
            scene_check.tellUnmoved()
        during(step, self)
    untold, solvers, during = messages.untold, scene_check.solvers, interrupts.during
    return stepped


def _resetStopped(reset):
    """YADE's O.reset() waits for the last step with Python's lock held, which a PyRunner would
    need; and objects in lists that were passed to it are never freed."""
    @functools.wraps(reset)
    def stopped(self):
        if _yadefrag.isInStep():
            return reset(self)
        _yadefrag.stopRun()
        messages.forget()
        reset(self)
        _yadefrag.freeListItems()
    return stopped


def _underOldName(get):
    """O.energy['feExternal'], whose present name is 'feOutside'."""
    @functools.wraps(get)
    def item(self, name):
        return get(self, 'feOutside' if name == 'feExternal' else name)
    return item


def install() -> None:
    wrapper.EnergyTracker.__getitem__ = _underOldName(wrapper.EnergyTracker.__getitem__)
    for name in ('save', 'saveTmp', 'sceneToString'):
        setattr(_Omega, name, _savedWhole(getattr(_Omega, name)))
    _Omega.save = _savedOrRefused(_Omega.save)
    _Omega.pause = _countPauses(_Omega.pause)
    _Omega.resetTime = _countSteps(_Omega.resetTime)
    _Omega.run = _runBegun(_Omega.run, _Omega.wait)
    _Omega.wait = _waitForAll(_Omega.wait)
    _Omega.step = _wholeStep(_Omega.step)
    _Omega.reset = _resetStopped(_Omega.reset)
    interrupts.install()
    _yadefrag.watchListItems()
    # The process must not end in the middle of a step.
    atexit.register(_yadefrag.stopRun)
