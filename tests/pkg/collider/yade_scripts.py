"""Runs YADE's own scripts with a collider put in place of YADE's; run_yade_scripts.py starts it.

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

import numpy
import yade
import yade.plot
import yade.wrapper
from swap import Swap, kRivals

O = builtins.O

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
    print('\n@@@ ' + json.dumps(dict(name=name, seconds=round(clock.time() - started, 2),
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
        if name == 'wrapper':   # requires the class under its original name
            import yade.tests.wrapper as tests
            tests.allClasses = [c for c in tests.allClasses if c not in kRivals]
        suite = unittest.defaultTestLoader.loadTestsFromName('yade.tests.' + name)
        result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
        bad = [str(case) for case, _ in result.failures + result.errors]
        report(name, swap, before, started, error='; '.join(bad) or None, tests=result.testsRun)


class Leash:
    """Lets an example run a number of steps in all, in the foreground, then ends it.

    On the way it notes the contacts and positions at some `moments`, dense at first: later, two
    runs of a dense scene part by rounding alone.
    """

    def __init__(self):
        self.step = yade.wrapper.Omega.step     # Omega.run would sleep 40 ms each time
        self.restart()
        yade.wrapper.Omega.run = lambda omega, nSteps=-1, wait=False: self.go(omega, nSteps)
        yade.wrapper.Omega.step = lambda omega: self.go(omega, 1)
        yade.wrapper.Omega.wait = lambda omega: None

    def restart(self):
        self.steps, self.limit, self.next, self.moments = 0, None, 1, []

    def go(self, omega, steps):
        if self.limit is None:
            self.limit = max(300, min(3000, 600000 // (len(O.bodies) + 100)))
        last = self.limit if steps < 0 else min(self.limit, self.steps + steps)
        while self.steps < last:
            until = min(self.next, last)
            for _ in range(until - self.steps):
                self.step(omega)
            self.steps = until
            if until == self.next:
                self.next = until + max(1, min(8, until // 3))
                self.moments.append(dict(step=until, contacts=contacts(), positions=positions()))
        if self.steps >= self.limit:
            raise Enough

    def finish(self):
        """The steps that the script leaves to the person in front of the window."""
        try:
            self.go(O, -1)
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
    # utils.randomColor() seeds from the clock with every body
    seed = random.seed
    random.seed = lambda *a: seed(*a) if a and a[0] is not None else None


def contacts():
    """[id1, id2, overlap] of the real interactions; overlap is None where the geometry has none."""
    return sorted([i.id1, i.id2, getattr(i.geom, 'penetrationDepth', None)]
                  for i in O.interactions)


def positions():
    return [tuple(b.state.pos) for b in O.bodies]


def radius():
    """A typical length of the bodies: the median radius of the spheres, 1 without any."""
    radii = sorted(b.shape.radius for b in O.bodies if isinstance(b.shape, yade.wrapper.Sphere))
    return radii[len(radii) // 2] if radii else 1.


def runExamples(swap, names, scope):
    makeRepeatable()
    leash = Leash()
    for path in names:
        O.reset()
        O.engines = yade.utils.defaultEngines
        O.dt = 1e-8
        random.seed(1)
        numpy.random.seed(1)
        leash.restart()
        started, before = clock.time(), dict(swap.count)
        home = os.getcwd()
        os.chdir(os.path.dirname(path))
        error = execute(path, scope) or leash.finish()
        os.chdir(home)
        report(path, swap, before, started, error=error, radius=radius(), moments=leash.moments)


def main(scope):
    """CLASS[+all] checks|unit|examples|reference NAME...; a reference is an example searched every step;
    all: with CurveLoop and CurveIntegrator.

    `scope`: the globals of yade's __main__, where YADE's runners look names up, too."""
    name, kind, *names = sys.argv[1:]
    sys.argv = sys.argv[:1]
    name, *ours = name.split('+')
    swap = Swap(colliderClass(name), everyStep=kind == 'reference', ours=bool(ours))
    swap.install(scope)
    if kind == 'checks':
        runChecks(swap, names, scope)
    elif kind == 'unit':
        runUnit(swap, names)
    else:
        runExamples(swap, names, scope)
