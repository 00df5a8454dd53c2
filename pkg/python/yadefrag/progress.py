"""Long runs: a bar of progress on a terminal, and Ctrl-C between two steps."""

import sys
import time
import warnings

from yade import wrapper
from yadefrag import _yadefrag, lifecycle
from yadefrag.guards import requireNoStep
from yadefrag.values import shown, whole

MOST_STEPS = 2**62  # that YADE can count


def runSteps(steps, every=None, call=None):
    """Runs `steps` steps of the scene; returns how many were done.

    every, call  if given, call() is called after each `every` steps
    On a terminal a bar shows steps, simulated time and time left. Ctrl-C stops after a whole step,
    with the scene as it is then, and so does O.pause() from a PyRunner; the run can be taken up
    again. RuntimeError where an engine stopped the run, with what FESolver said; what other engines say
    is in YADE's own message.
    """
    steps = whole('steps', steps, most=MOST_STEPS)
    every = None if every is None else whole('every', every, most=MOST_STEPS)
    if call is not None and (every is None or not callable(call)):
        raise ValueError('call is %s with every=%s: give a function and after how many steps it is '
                         'to be called.' % (shown(call), shown(every)))
    requireNoStep('runSteps')
    warnOfNoSolver()
    omega = wrapper.Omega()
    done, begin = 0, lifecycle.stepsDone()
    bar = _Bar(steps)
    try:
        portion = 1
        while done < steps:
            now = min(portion, steps - done, every - done % every if every else steps)
            start = time.perf_counter()
            part, isPaused = runPart(now)
            done += part
            bar.show(done, omega.time)
            if call is not None and part and done % every == 0:
                call()
            if isPaused:
                break
            # Portions of about a tenth of a second: Ctrl-C is heard between them.
            portion = _portion(now, time.perf_counter() - start)
    except KeyboardInterrupt:
        _yadefrag.stopRun()
        done = lifecycle.stepsDone() - begin
        bar.close()
        print('Stopped after %d of %d steps, at %.6g s.' % (done, steps, omega.time),
              file=sys.stderr)
        return done
    finally:
        bar.close()
    return done


def warnOfNoSolver():
    """Before the first step: FE bodies without an engine that moves them are a slip of the script."""
    omega = wrapper.Omega()
    if omega.iter > 0 or any(isinstance(one, (wrapper.FESolver, wrapper.ParallelEngine))
                             for one in omega.engines):
        return
    if any(isinstance(body.shape, wrapper.SurfaceSegment) and body.shape.component >= 0
           for body in omega.bodies):
        warnings.warn('O.engines has no FESolver, so that nothing moves its bodies: '
                      'O.engines = engines(fe) sets the engines.', stacklevel=3)


def runPart(steps):
    """Runs `steps` steps; returns how many were done, and whether the run was paused meanwhile.

    RuntimeError where an engine stopped the run.
    """
    omega = wrapper.Omega()
    begin, pauses = lifecycle.stepsDone(), lifecycle.pauses()
    _yadefrag.whyStopped()
    omega.run(steps)
    lifecycle.waitForEnd()
    if lifecycle.stepsDone() - begin == steps and pauses == lifecycle.pauses():
        return steps, False
    _yadefrag.stopRun()  # O.wait() does not wait for the end of the step that was paused
    done = lifecycle.stepsDone() - begin
    if done < steps:
        omega.stopAtIter = -1  # or the next O.run() would stop there
    if omega.subStep != -1:
        why = _yadefrag.whyStopped()
        raise RuntimeError('The run stopped in step %d%s' % (omega.iter, ': ' + why if why else '.'))
    return done, True


def _portion(steps, seconds):
    return max(1, min(2 * steps, int(.1 * steps / max(seconds, 1e-9))))


class _Bar:
    """Nothing unless standard error is a terminal."""

    def __init__(self, steps):
        self.bar = None
        if sys.stderr is not None and sys.stderr.isatty():
            import tqdm  # only where it is seen
            self.bar = tqdm.tqdm(total=steps, unit='step', file=sys.stderr)

    def show(self, done, seconds):
        if self.bar is not None:
            self.bar.set_postfix_str('t = %.4g s' % seconds, refresh=False)
            self.bar.update(done - self.bar.n)

    def close(self):
        if self.bar is not None:
            self.bar.close()
            self.bar = None
