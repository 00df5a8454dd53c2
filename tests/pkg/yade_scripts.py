"""Runs YADE's own scripts with a collider put in place of YADE's; own.py starts it.

One line of JSON per script, after '@@@ '. Works in the current directory, which should be a
temporary one. A module of its own, so that no script can overwrite a name in it.
"""
import builtins
import json
import os
import random
import sys
import time as clock
import unittest
import unittest.mock

import yade
import yade.plot
import yade.wrapper
from swap import Swap, kRivals

O = builtins.O

kSteps = 300        # of an example; enough for contacts to come and go
kYadeTests = os.path.join(os.path.dirname(yade.__file__), 'tests')


class Enough(Exception):
    """Raised inside an example once it has run its steps."""


class YadeCheckError(Exception):
    """The name that YADE's check scripts raise."""


def colliderClass(name):
    if name == 'InsertionSortCollider':
        return yade.wrapper.InsertionSortCollider
    import yadefrag
    return getattr(yadefrag, name)


def report(name, swap, before, started, **more):
    counted = {k: v - before[k] for k, v in swap.count.items()}
    print('@@@ ' + json.dumps(dict(name=name, seconds=round(clock.time() - started, 2),
                                   **counted, **more)), flush=True)


def execute(path, scope):
    """None, or what went wrong in one line."""
    try:
        with open(path, encoding='utf-8') as file:
            exec(compile(file.read(), path, 'exec'), scope)
    except (Enough, SystemExit):
        return None
    except BaseException as error:
        return f'{type(error).__name__}: {error}'
    return None


def runChecks(swap, names, scope):
    for name in names:
        O.reset()
        O.engines = yade.utils.defaultEngines
        started, before = clock.time(), dict(swap.count)
        scope.update(checksPath=kYadeTests + '/checks', YadeCheckError=YadeCheckError)
        error = execute(f'{kYadeTests}/checks/{name}', scope)
        report(name, swap, before, started, error=error)


def runUnit(swap, names):
    import yade.tests
    for name in names:
        O.reset()
        started, before = clock.time(), dict(swap.count)
        if name == 'wrapper':   # demands that a class be called as it was asked for
            import yade.tests.wrapper as tests
            tests.allClasses = [c for c in tests.allClasses if c not in kRivals]
        suite = unittest.defaultTestLoader.loadTestsFromName('yade.tests.' + name)
        result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
        bad = [str(case) for case, _ in result.failures + result.errors]
        report(name, swap, before, started, error='; '.join(bad) or None, tests=result.testsRun)


class Leash:
    """Lets an example run kSteps steps in all, in the foreground, then ends it."""

    def __init__(self):
        self.steps = 0
        self.run, self.step = yade.wrapper.Omega.run, yade.wrapper.Omega.step
        leash = self
        yade.wrapper.Omega.run = lambda omega, nSteps=-1, wait=False: leash.go(omega, nSteps)
        yade.wrapper.Omega.step = lambda omega: leash.go(omega, 1)
        yade.wrapper.Omega.wait = lambda omega: None

    def go(self, omega, steps):
        steps = kSteps if steps < 0 else steps
        steps = min(steps, kSteps - self.steps)
        self.steps += steps
        if steps:
            self.run(omega, steps, True)
        if self.steps >= kSteps:
            raise Enough

    def finish(self):
        """The steps that the script leaves to the person in front of the window."""
        try:
            self.go(O, kSteps)
        except Enough:
            return None
        except Exception as error:
            return f'{type(error).__name__}: {error}'


def makeRepeatable():
    """No windows, no plots, and packings from a fixed seed."""
    yade.qt = sys.modules['yade.qt'] = unittest.mock.MagicMock(spec=None)
    yade.plot.plot = lambda *_, **__: None
    makeCloud = yade.pack.SpherePack.makeCloud

    def seeded(*arguments, **keywords):
        if len(arguments) < 13:
            keywords.setdefault('seed', 1)
        return makeCloud(*arguments, **keywords)
    yade.pack.SpherePack.makeCloud = seeded


def contacts():
    """[id1, id2, overlap] of the real interactions; overlap is None where the geometry has none."""
    return sorted([i.id1, i.id2, getattr(i.geom, 'penetrationDepth', None)]
                  for i in O.interactions)


def runExamples(swap, names, scope):
    makeRepeatable()
    leash = Leash()
    for path in names:
        O.reset()
        O.engines = yade.utils.defaultEngines
        O.dt = 1e-8
        random.seed(1)
        leash.steps = 0
        started, before = clock.time(), dict(swap.count)
        home = os.getcwd()
        os.chdir(os.path.dirname(path))
        error = execute(path, scope) or leash.finish()
        os.chdir(home)
        report(path, swap, before, started, error=error, steps=leash.steps, iteration=O.iter,
               bodies=len(O.bodies), contacts=contacts())


def main(scope):
    """`scope`: the globals of yade's __main__, where YADE's runners look names up, too."""
    name, kind, *names = sys.argv[1:]
    sys.argv = sys.argv[:1]
    swap = Swap(colliderClass(name))
    swap.install(scope)
    if kind == 'checks':
        runChecks(swap, names, scope)
    elif kind == 'unit':
        runUnit(swap, names)
    else:
        runExamples(swap, names, scope)
