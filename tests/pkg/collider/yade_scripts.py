"""Runs YADE's own scripts with one collider class in the place of every collider that YADE would make:
`yade -n -x yade_scripts.py CLASS KIND NAME...`, see main().

One line of JSON per script, after '@@@ '. Works in the current directory, which should be a
temporary one. The scripts run in yade's __main__, this is a module, so that no script can overwrite a name in it.

Names (YADE's modules, the namespace that scripts run in), objects that come without a name (C++
generators, O.load, the default engines) and typedEngine('InsertionSortCollider') all lead to the
new class. `swap.count` counts: `made` by name, `found` as objects and replaced, `runs`
that began with the new class among the engines, `rivals`: runs that began with one left (0!).
"""
import os
import sys

if __name__ == '__main__':
    kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
    sys.path[:0] = [kHere, os.path.join(kHere, '..', 'helpers')]
    import yade_scripts
    yade_scripts.main(globals())
    sys.exit()

import builtins
import collections
import json
import random
import time as clock
import unittest
import unittest.mock

import numpy
import yade
import yade.plot
import yade.utils
import yade.wrapper as w

O = builtins.O
kRivals = ('InsertionSortCollider', 'GeneralIntegratorInsertionSortCollider')


class _Constructor(type):
    """Metaclass of the stand-in for a collider's name: calling it makes the other class."""

    def __call__(cls, *arguments, **attributes):
        return cls.make(*arguments, **attributes)

    def __instancecheck__(cls, thing):
        return isinstance(thing, cls.target)


class Swap:
    """`target` is the class to put in; YADE's own works too (then objects are left as they are).

    `everyStep` takes the strides away, whatever a script sets: the reference for contacts. `ours`: CurveLoop
    and CurveIntegrator in the place of YADE's, where scripts make them; `loops` counts runs with the loop.
    """

    def __init__(self, target, everyStep=False, ours=False):
        self.target, self.everyStep = target, everyStep
        self.loop = w.CurveLoop if ours else None
        self.rivals = {name: getattr(w, name) for name in kRivals}
        self.left = [c for c in self.rivals.values() if c is not target]
        self.count = collections.Counter(made=0, found=0, runs=0, rivals=0, loops=0)

    def install(self, namespace):
        """From here on, everywhere; `namespace` is the dict of globals that scripts run in."""
        for name, rival in self.rivals.items():
            self._rename(rival, self._constructor(name), namespace)
        if self.loop:
            self._rename(w.InteractionLoop, self.loop, namespace)
            self._rename(w.NewtonIntegrator, w.CurveIntegrator, namespace)
        original = yade.utils.typedEngine
        self._rename(original, lambda name: original(
            self.target.__name__ if name in kRivals else name), namespace)
        yade.utils.defaultEngines = self.swapped(yade.utils.defaultEngines)
        self._wrapOmega()
        self.swapScene()

    def _constructor(self, name):
        def make(*arguments, **attributes):
            self.count['made'] += 1
            engine = self.target(*arguments, **attributes)
            if name.startswith('General'):
                engine.verletDist = 0   # its integrators do not watch the strides
            return engine
        return _Constructor(name, (), dict(make=staticmethod(make), target=self.target))

    def _rename(self, old, new, namespace):
        for module in list(sys.modules.values()):
            scope = getattr(module, '__dict__', None)
            if isinstance(scope, dict) and getattr(module, '__name__', '') != __name__:
                self._renameIn(scope, old, new)
        self._renameIn(namespace, old, new)

    @staticmethod
    def _renameIn(scope, old, new):
        for name in [n for n, value in list(scope.items()) if value is old]:
            scope[name] = new

    def isRival(self, engine):
        return type(engine) in self.left

    def copy(self, rival):
        """A collider of the new class with the attributes and bound functors of `rival`."""
        engine = self.target(list(rival.boundDispatcher.functors))
        attributes = rival.dict()
        for name in ('boundDispatcher', 'numReinit'):
            attributes.pop(name, None)
        engine.updateAttrs(attributes)
        if type(rival).__name__.startswith('General'):
            engine.verletDist = 0
        self.count['found'] += 1
        return engine

    def swapped(self, engines):
        return [self.copy(e) if self.isRival(e) else e for e in engines]

    def swapScene(self):
        """Replaces what is among the engines of the present scene."""
        engines = self._get(w.Omega())
        if any(self.isRival(e) for e in engines):
            self._set(w.Omega(), self.swapped(engines))

    def _beforeRun(self):
        self.swapScene()
        engines = self._get(w.Omega())
        if self.everyStep:
            for engine in engines:
                if isinstance(engine, w.Collider):
                    engine.verletDist = 0
        self.count['runs'] += any(type(e) is self.target for e in engines)
        self.count['loops'] += self.loop is not None and any(type(e) is self.loop for e in engines)
        self.count['rivals'] += any(self.isRival(e) for e in engines)

    _get = staticmethod(w.Omega.engines.fget)
    _set = staticmethod(w.Omega.engines.fset)

    def _wrapOmega(self):
        for name in ('run', 'step'):
            self._wrap(w.Omega, name, before=self._beforeRun)
        for name in ('load', 'reload', 'loadTmp', 'stringToScene', 'reset', 'switchScene', 'switchToScene'):
            self._wrap(w.Omega, name, after=self.swapScene)
        self._wrap(w.FileGenerator, 'load', after=self.swapScene)

        def get(omega):
            self.swapScene()
            return self._get(omega)

        w.Omega.engines = property(get, lambda omega, e: self._set(omega, self.swapped(e)))

    @staticmethod
    def _wrap(cls, name, before=lambda: None, after=lambda: None):
        original = getattr(cls, name)

        def wrapped(*arguments, **keywords):
            before()
            result = original(*arguments, **keywords)
            after()
            return result
        setattr(cls, name, wrapped)


# --- the scripts

kYadeTests = os.path.join(os.path.dirname(yade.__file__), 'tests')


class Enough(Exception):
    """Raised inside an example once it has run its steps."""


class YadeCheckError(Exception):
    """The name that YADE's check scripts raise."""


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

    On the way it notes contacts, positions, forces and kinetic energy at some `moments`, dense at first: later, two
    runs of a dense scene part by rounding alone.
    """

    def __init__(self):
        self.step = w.Omega.step     # Omega.run would sleep 40 ms each time
        self.restart()
        w.Omega.run = lambda omega, nSteps=-1, wait=False: self.go(omega, nSteps)
        w.Omega.step = lambda omega: self.go(omega, 1)
        w.Omega.wait = lambda omega: None

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
                self.moments.append(dict(step=until, contacts=contacts(), positions=positions(), forces=forces(),
                                         kinetic=yade.utils.kineticEnergy()))
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
    return sorted([i.id1, i.id2, getattr(i.geom, 'penetrationDepth', None)] for i in O.interactions)


def positions():
    return [tuple(b.state.pos) for b in O.bodies]


def forces():
    O.forces.f(0, sync=True)   # adds up those of threads
    return [tuple(O.forces.f(b.id)) for b in O.bodies]


def laws():
    """Names of the laws of the loops, and how many contacts each has."""
    loops = [e for e in O.engines if isinstance(e, w.InteractionLoop)]
    names = sorted({type(law).__name__ for loop in loops for law in loop.lawDispatcher.functors})
    return names, len(O.interactions), [(e.fastGeometries, e.fastForces) for e in loops if hasattr(e, 'fastForces')]


def radius():
    """A typical length of the bodies: the median radius of the spheres, 1 without any."""
    radii = sorted(b.shape.radius for b in O.bodies if isinstance(b.shape, w.Sphere))
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
        report(path, swap, before, started, error=error, radius=radius(), laws=laws(), moments=leash.moments)


def main(scope):
    """CLASS[+all] checks|unit|examples|reference NAME...; a reference is an example searched every step;
    all: with CurveLoop and CurveIntegrator.

    `scope`: the globals of yade's __main__, where YADE's runners look names up, too."""
    name, kind, *names = sys.argv[1:]
    sys.argv = sys.argv[:1]
    name, *ours = name.split('+')
    if name != 'InsertionSortCollider':
        import yadefrag  # noqa: F401  adds its classes
    swap = Swap(getattr(w, name), everyStep=kind == 'reference', ours=bool(ours))
    swap.install(scope)
    if kind == 'checks':
        runChecks(swap, names, scope)
    elif kind == 'unit':
        runUnit(swap, names)
    else:
        runExamples(swap, names, scope)
