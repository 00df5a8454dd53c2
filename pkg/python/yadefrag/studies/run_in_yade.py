"""One run of tradeoff() or ensemble(), in a separate yade: `yade -n -x run_in_yade.py JOB RESULT`.

JOB and RESULT are JSON files. The result has `result`: 'ok', 'refused', 'blew up', 'failed' or
'unloadable' (no run of this scene can succeed), a `message`, and, if it is 'ok', the figures.
"""

import importlib
import json
import math
import os
import sys
import time
import warnings
from collections.abc import Callable
from typing import Any

import numpy

from yade.wrapper import Omega
import yadefrag  # noqa: F401  (adds its classes to yade.wrapper)
from yadefrag import arguments
from yadefrag.studies.scene_choices import Choices

NAME = '__tradeoff__'  # module name of the loaded script: not '__main__'
CHECK_EVERY = .5  # s of run between two checks for a blow-up
MOST_WARNINGS = 50  # that a run passes on
MOST_RADII = 10  # largest displacement of a sphere in one step


class BlewUp(Exception):
    """The run's results are not finite or not physical."""


def load(job: dict[str, Any]) -> list[Any]:
    """[function] of the job, with sys.path and sys.argv as for the script itself."""
    sys.path[:0] = [p for p in job['path'] if p not in sys.path]
    sys.argv[:] = [job['file']]
    if job['module'] == '__main__':
        # As yade runs a script: with YADE's names defined.
        names = dict(vars(sys.modules['__main__']), __name__=NAME)
        with open(job['file'], encoding='utf-8') as script:
            exec(compile(script.read(), job['file'], 'exec'), names)
    else:
        names = vars(importlib.import_module(job['module']))
    return [names[name] if name else None for name in job['functions']]


def requireSane(omega: Omega) -> None:
    """All values are finite, no energy is created, no sphere has an absurd speed; BlewUp with a sentence otherwise."""
    for fe in omega.engines:
        if type(fe).__name__ != 'FESolver':
            continue
        energy = fe._energyBalance
        if not math.isfinite(energy.excess):
            raise BlewUp('the energy is %r J.' % energy.excess)
        if energy.excess > max(energy.most, energy.rounding):
            raise BlewUp('the energy grew by %.3g J by numerical errors; the bodies had %.3g J.'
                         % (energy.excess, energy.most))
    for body in omega.bodies:
        radius = getattr(body.shape, 'radius', None)
        if radius is None:
            continue
        speed = body.state.vel.norm()
        if not (math.isfinite(speed) and math.isfinite(body.state.pos.norm())):
            raise BlewUp('body %d is at no finite place or speed.' % body.id)
        if speed * omega.dt > MOST_RADII * radius:
            raise BlewUp('body %d moves by %.3g of its radii in one step.' % (body.id, speed * omega.dt / radius))


def run(omega: Omega, duration: float, watch: Callable[[Any], Any] | None, every: float,
        built: Any) -> tuple[dict[str, float], list]:
    """Runs `duration` (s simulated); returns (the run's figures, with times of the steps only; watch's results)."""
    if not (math.isfinite(omega.dt) and omega.dt > 0):
        raise ValueError('O.dt is %r s, the scene must set a positive one.' % omega.dt)
    if duration <= omega.dt / 2:
        raise ValueError('duration is %.6g s, at most half of the scene\'s step of %.6g s: no step '
                         'would be done.' % (duration, omega.dt))
    seen = []
    begin, first, wall, cpu, checked = omega.time, omega.iter, 0., 0., 0.
    end = begin + duration - omega.dt / 2
    moment = begin + every if watch else end  # next call of watch
    while omega.time < end:
        start = time.perf_counter(), time.process_time()
        omega.step()  # not O.run, which waits in units of 40 ms
        while omega.time < min(moment, end) and time.perf_counter() < start[0] + CHECK_EVERY:
            omega.step()
        wall, cpu = wall + time.perf_counter() - start[0], cpu + time.process_time() - start[1]
        if wall - checked > CHECK_EVERY:
            requireSane(omega)
            checked = wall
        if watch and omega.time >= min(moment, end):
            seen.append(watch(built))
            moment += every
    requireSane(omega)
    simulated = omega.time - begin
    return dict(wall=wall / simulated, cpu=cpu / simulated, seconds=wall, steps=omega.iter - first), seen


def measured(measure: Callable, watch: Callable | None, built: Any, seen: list, isSeveral: bool) -> Any:
    """A finite float, or a list of them, or, of several quantities, a dict of these; BlewUp if they are not finite."""
    value = measure(built, seen) if watch else measure(built)
    if isSeveral and isinstance(value, tuple) and len(value) > 1:
        value = {'value %d' % i: one for i, one in enumerate(value)}
    if isSeveral and isinstance(value, dict) and value:
        return {str(name): _numbers(one) for name, one in value.items()}
    return _numbers(value)


def _numbers(value):
    array = numpy.asarray(value, dtype=float)
    if array.ndim > 1 or array.size == 0:
        raise TypeError('measure returned the shape %s, it must be a number or an array (n).' %
                        arguments.shown(array.shape))
    if not numpy.isfinite(array).all():
        raise BlewUp('the measured value is not finite.')
    return array.tolist()


def perform(job: dict[str, Any]) -> dict[str, Any]:
    """The result of a job, a dict; never raises exceptions of the scene."""
    choices = Choices(job['settings'])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always', UserWarning)
        result = attempt(job, choices)
    said = [str(one.message) for one in caught if issubclass(one.category, UserWarning)]
    for one in Omega().engines:
        if type(one).__name__ == 'FESolver':
            said += one.warnings
    return dict(result, used=dict(choices.used, threads=Omega().numThreads),
                warnings=list(dict.fromkeys(said))[:MOST_WARNINGS])


def attempt(job: dict[str, Any], choices: Choices) -> dict[str, Any]:
    """The result without the choices that were used."""
    try:
        scene, measure, watch = load(job)
    except Exception as error:  # a script may raise anything
        return dict(result='unloadable', message='%s: %s' % (type(error).__name__, error))
    stage = 'refused'
    try:
        built = scene(choices)
        for name in choices.neverAsked():
            raise ValueError('the scene never used the choice %s.' % arguments.shown(name))
        stage = 'blew up'
        figures, seen = run(Omega(), job['duration'], watch, job['every'], built)
        stage = 'failed'
        value = measured(measure, watch, built, seen, job.get('isSeveral', False))
    except BlewUp as error:
        return dict(result='blew up', message=str(error))
    except ValueError as error:
        return dict(result='failed' if stage == 'failed' else 'refused', message=str(error))
    except RuntimeError as error:
        return dict(result=stage, message=str(error))
    except Exception as error:  # a bug in the scene: the other runs continue
        return dict(result='failed', message='%s: %s' % (type(error).__name__, error))
    return dict(figures, result='ok', message='', value=value)


def main(jobFile: str, resultFile: str) -> None:
    with open(jobFile, encoding='utf-8') as f:
        job = json.load(f)
    result = perform(job)
    with open(resultFile + '.part', 'w', encoding='utf-8') as f:
        json.dump(result, f, default=repr)
    os.replace(resultFile + '.part', resultFile)  # a complete file, or none


if __name__ == '__main__':
    main(*sys.argv[1:])
