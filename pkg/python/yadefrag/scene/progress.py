"""Long runs: a progress bar on a terminal, and Ctrl-C between two steps."""

import sys
import time
from collections.abc import Callable

from yade import wrapper
from yadefrag import _yadefrag
from yadefrag.arguments import shown, whole
from yadefrag.fe.contents import requireNoStep
from yadefrag.scene import lifecycle, refusals

MOST_STEPS = 2**62  # the largest number that YADE can count


def runSteps(steps: int, every: int | None = None, call: Callable[[], object] | None = None) -> int:
    """Runs `steps` steps of the scene; returns the number of steps done.

    every, call  if given, call() is called after each `every` steps
    On a terminal a bar shows steps, simulated time and remaining time. Ctrl-C stops after a whole step
    and raises KeyboardInterrupt, so that it ends a script with a loop of runs, too, also one in a
    thread; O.pause() from a PyRunner stops as well, without an exception. The scene is left in that
    state, and the run can be continued. RuntimeError if an engine stopped the run, with the message of
    FESolver; messages of other engines are written by YADE.
    """
    steps = whole('steps', steps, most=MOST_STEPS)
    every = None if every is None else whole('every', every, most=MOST_STEPS)
    if (call is None) != (every is None) or call is not None and not callable(call):
        raise ValueError('call is %s with every=%s: give a function and the number of steps between its '
                         'calls.' % (shown(call), shown(every)))
    requireNoStep('runSteps')
    omega = wrapper.Omega()
    done, begin = 0, lifecycle.stepsDone()
    bar = _Bar(steps)
    try:
        portion = 1
        while done < steps:
            with lifecycle.wholeSteps():
                now = min(portion, steps - done, every - done % every if every else steps)
                start = time.perf_counter()
                part, isPaused = runPart(now)
                done += part
                bar.show(done, omega.time)
            if call is not None and every and part and done % every == 0:
                call()
            if isPaused:
                break
            # Portions of about a tenth of a second: the bar moves between them.
            portion = _portion(now, time.perf_counter() - start)
    except KeyboardInterrupt:
        bar.close()
        print('Stopped after %d of %d steps, at %.6g s.' %
              (lifecycle.stepsDone() - begin, steps, omega.time), file=sys.stderr)
        raise
    finally:
        bar.close()
    return done


def runPart(steps: int) -> tuple[int, bool]:
    """Runs `steps` steps; returns the number of steps done, and whether the run was paused
    meanwhile.

    RuntimeError if an engine stopped the run, KeyboardInterrupt after Ctrl-C.
    """
    omega = wrapper.Omega()
    begin, pauses = lifecycle.stepsDone(), lifecycle.pauses()
    try:
        with refusals.raisedHere():
            omega.run(steps)
            lifecycle.waitForEnd()
    except BaseException:
        _yadefrag.stopRun()
        omega.stopAtIter = -1
        raise
    if lifecycle.stepsDone() - begin == steps and pauses == lifecycle.pauses():
        return steps, False
    _yadefrag.stopRun()  # O.wait() does not wait for the end of a paused run's last step
    done = lifecycle.stepsDone() - begin
    if done < steps:
        omega.stopAtIter = -1  # otherwise the next O.run() would stop there
    if omega.subStep != -1:
        why = _yadefrag.whyStopped()
        raise RuntimeError('The run stopped in step %d%s' % (omega.iter, ': ' + why if why else '.'))
    return done, True


def _portion(steps, seconds):
    return max(1, min(2 * steps, int(.1 * steps / max(seconds, 1e-9))))


class _Bar:
    """Does nothing unless standard error is a terminal."""

    def __init__(self, steps):
        self.bar = None
        if sys.stderr is not None and sys.stderr.isatty():
            import tqdm  # only if it is visible
            self.bar = tqdm.tqdm(total=steps, unit='step', file=sys.stderr)

    def show(self, done, seconds):
        if self.bar is not None:
            self.bar.set_postfix_str('t = %.4g s' % seconds, refresh=False)
            self.bar.update(done - self.bar.n)

    def close(self):
        if self.bar is not None:
            self.bar.close()
            self.bar = None
