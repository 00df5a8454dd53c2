"""One measurement of one collider in one scene: run inside yade, prints one line of JSON.

    scripts/yade -n -x -j1 tests/benchmark/measure.py scene=gas n=10000 seed=1 \\
        collider=InsertionSortCollider budget=10 steps=200 verletDist=-.1 targetInterv=0

budget   seconds for the measured steps (the scene and the first activation are not included)
steps    at most so many measured steps (0: by the number of bodies, see `_stepLimit`)
warm     steps before these, for a collider that adapts (0: at most 60, see `_warmUp`)
other    attributes of the collider

Small scenes are built and measured again, up to five times within the budget, and the medians kept
(`rounds`: how often).

Times are taken by YADE's own per-engine counters (s); `wallPerStep` is the clock around O.step and
`sumPerStep` collider + loop + integrator. Values per step are means over the measured steps, cut to
whole cycles between two activations when that leaves at least half of them. The first step and all
warm-up steps are left out. When fewer than three activations fall into the measured steps, the
collider is called by hand after further steps, until there are three
(`activationsForced` counts these, which do not enter the per-step values).
"""
import json
import os
import resource
import statistics
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import yade.wrapper  # noqa: E402
from yade import O, config  # noqa: E402
from yade.wrapper import ForceResetter, InteractionLoop, NewtonIntegrator  # noqa: E402

import scenes  # noqa: E402

WANTED_ACTIVATIONS = 3
MOST_ROUNDS = 5


def main(arguments):
    """Parse key=value arguments, measure, print; failures are printed as {"error": ...}."""
    settings = {}
    try:
        for argument in arguments:
            key, _, value = argument.partition('=')
            settings[key] = value if key in ('scene', 'collider') else json.loads(_number(value))
        row = measure(settings.pop('scene', 'gas'), settings.pop('n', 1000),
                      settings.pop('seed', 1), settings.pop('collider', 'InsertionSortCollider'),
                      settings.pop('budget', 10), (settings.pop('steps', 0), settings.pop('warm', 0)),
                      settings)
    except LookupError as error:
        row = dict(error=str(error))
    except Exception as error:  # the caller needs one line of JSON in any case
        row = dict(error=f'{type(error).__name__}: {error}')
    print(json.dumps(row), flush=True)


def measure(scene, n, seed, collider, budget, lengths, settings):
    """Measure, with `lengths` = (measured steps, steps before); returns the dict that is printed.

    Raises LookupError for an unknown engine.
    """
    makeCollider = _findEngine(collider)
    row = dict(scene=scene, n=n, seed=seed, collider=collider, settings=settings,
               yade=config.version)
    end, rounds = time.perf_counter() + budget, []
    while len(rounds) < MOST_ROUNDS:
        start = time.perf_counter()
        rounds.append(_round(scene, n, seed, lambda b: makeCollider(b, **settings), budget, lengths))
        now = time.perf_counter()
        if now + (now - start) > end:
            break
    medians = {key: statistics.median_low(r[key] for r in rounds) for key in rounds[0]}
    return dict(row, rounds=len(rounds), **medians, peakMemory=_peakMemory())


def _round(scene, n, seed, makeCollider, budget, lengths):
    """Build the scene and measure it once; returns a dict of numbers."""
    start = time.perf_counter()
    parts = scenes.build(scene, n, seed)
    engines = [ForceResetter(), makeCollider(parts['bound']),
               InteractionLoop(parts['geom'], parts['phys'], parts['law']),
               NewtonIntegrator(**parts['newton'])]
    O.engines = engines
    O.timingEnabled = True
    row = dict(build=time.perf_counter() - start, memoryBuilt=_peakMemory())
    stepper = Stepper(engines, parts['perStep'])
    row['first'] = stepper.step().times[1]
    row['interactionsAfterFirst'] = len(O.interactions)
    row['realAfterFirst'] = O.interactions.countReal()
    steps, warm = lengths
    for _ in range(warm):
        stepper.step()
    warmUp = _warmUp(stepper, .3 * budget)
    records = _record(stepper, steps or _stepLimit(n), budget)
    row.update(_summary(records), warmUpSteps=warmUp, bodies=len(O.bodies),
               interactions=len(O.interactions), real=O.interactions.countReal())
    row['potential'] = row['interactions'] - row['real']
    row.update(_activations(records, stepper, engines[1], budget))
    return row


class Record:
    """One step: engine times (s, in the order of O.engines), wall time (s), collider run or not."""

    def __init__(self, times, wall, activated):
        self.times, self.wall, self.activated = times, wall, activated


class Stepper:
    """Steps the scene and takes the engines' times."""

    def __init__(self, engines, perStep):
        self._engines, self._perStep, self.count = engines, perStep, 0

    def step(self):
        """One step; returns its Record."""
        if self._perStep:
            self._perStep(self.count)
        self.count += 1
        before = [(e.execTime, e.execCount) for e in self._engines]
        start = time.perf_counter()
        O.step()
        wall = time.perf_counter() - start
        times = [(e.execTime - b[0]) * 1e-9 for e, b in zip(self._engines, before)]
        return Record(times, wall, self._engines[1].execCount > before[1][1])


def _warmUp(stepper, budget):
    """Step until the collider ran twice more, 60 steps or `budget` s passed; returns the steps."""
    end, activations = time.perf_counter() + budget, 0
    for done in range(1, 61):
        activations += stepper.step().activated
        if done >= 10 and (activations >= 2 or time.perf_counter() > end):
            break
    return done


def _record(stepper, steps, budget):
    """Records of at most `steps` steps within about `budget` s (at least 10)."""
    end, records = time.perf_counter() + budget, []
    while len(records) < 10 or (len(records) < steps and time.perf_counter() < end):
        records.append(stepper.step())
    return records


def _stepLimit(n):
    """Enough steps for some activations, few enough that the scene stays the scene it is."""
    return 400 if n <= 3000 else 300 if n <= 30000 else 150


def _summary(records):
    """Per-step means (s) over whole activation cycles, or over all records if too few are left."""
    marks = [i for i, r in enumerate(records) if r.activated]
    part = records
    if len(marks) > 1 and 2 * (marks[-1] - marks[0]) >= len(records):
        part = records[marks[0] + 1:marks[-1] + 1]
    mean = [statistics.fmean(column) for column in zip(*[r.times for r in part])]
    return dict(steps=len(records), stepsCounted=len(part), colliderPerStep=mean[1],
                loopPerStep=mean[2], integratorPerStep=mean[3], sumPerStep=sum(mean[1:]),
                wallPerStep=statistics.fmean(r.wall for r in part))


def _activations(records, stepper, collider, budget):
    """Times of single later activations: those met, and calls by hand while there are too few."""
    times = [r.times[1] for r in records if r.activated]
    met = len(times)
    end = time.perf_counter() + budget
    while len(times) < WANTED_ACTIVATIONS and (not times or time.perf_counter() < end):
        for _ in range(10):
            stepper.step()
        start = time.perf_counter()
        collider()
        times.append(time.perf_counter() - start)
    return dict(perActivation=statistics.median(times), activations=met,
                activationsForced=len(times) - met, perActivationLongest=max(times))


def _findEngine(name):
    """The class of engines of this name, from yadefrag or from YADE."""
    try:
        import yadefrag
        found = getattr(yadefrag, name, None)
        reason = 'it is neither in yadefrag nor in YADE'
    except ImportError as error:
        found, reason = None, f'yadefrag cannot be imported ({error})'
    found = found or getattr(yade.wrapper, name, None)
    if not found:
        raise LookupError(f'no class {name}: {reason}')
    return found


def _number(text):
    """Python's way to write a number or a bool, as JSON (-.1, 1., True)."""
    return {'True': 'true', 'False': 'false'}.get(text) or repr(
        int(text) if text.lstrip('-').isdigit() else float(text))


def _peakMemory():
    """Peak resident size of this process, bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


main(sys.argv[1:])
