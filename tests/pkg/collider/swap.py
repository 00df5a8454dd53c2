"""Puts one collider class in the place of every collider YADE would make in this process.

Names (YADE's modules, the namespace that scripts run in), objects that come without a name (C++
generators, O.load, the default engines) and typedEngine('InsertionSortCollider') all lead to the
new class. `swap.count` counts: `made` by name, `found` as objects and replaced, `runs`
that began with the new class among the engines, `rivals`: runs that began with one left (0!).
"""
import collections
import sys

import yade.utils
import yade.wrapper as w

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
        for name in ('load', 'reload', 'loadTmp', 'stringToScene', 'reset', 'switchScene',
                     'switchToScene'):
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
