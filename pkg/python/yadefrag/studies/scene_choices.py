"""The choices between speed and accuracy that tradeoff() varies by name.

KNOWN lists them. A scene function gets a `Choices` and builds the scene with its helpers, so that it
does not depend on which choices are varied.
"""

import math
import os
from typing import Any

from yade import wrapper
from yadefrag import arguments
from yadefrag.arguments import FEMat, FESolver
from yadefrag.fe.contents import requireSolver

COLLIDERS = ('LebesgueCollider', 'LinearCodeCollider', 'HierarchyCollider', 'InsertionSortCollider')
_PROCESSORS = os.cpu_count() or 1
LINEAR_VISCOSITY, QUADRATIC_VISCOSITY = .06, 1.2  # usual coefficients of bulk viscosity


def _isNumber(value):
    number = arguments.real(value)
    return number is not None and math.isfinite(number)


def _isOneOf(*allowed):
    return lambda value: any(value is a if isinstance(a, bool) else
                             type(value) is type(a) and value == a for a in allowed)


# name: (function that checks a value, description of valid values)
KNOWN = {
    'passes': (_isOneOf(1, 2), '1 or 2'),
    'contactTolerance': (lambda v: _isNumber(v) and 1e-9 <= v <= .1 or _isOneOf('fine', 'default', 'coarse')(v),
                         "'fine', 'default', 'coarse' or a number from 1e-9 to 0.1"),
    'smooth': (_isOneOf(True, False), 'True or False'),
    'size': (lambda v: _isNumber(v) and v > 0, 'a positive length (m)'),
    'timeStep': (lambda v: _isNumber(v) and v > 0,
                 'a positive fraction of the critical time step'),
    'halo': (lambda v: _isNumber(v) and 0 <= v <= .5,
             'a fraction of the shortest segment, at most 0.5, or 0 for one that depends on the speed'),
    'collider': (lambda v: v == 'none' or v in COLLIDERS,
                 "'none' or one of " + ', '.join(map(repr, COLLIDERS))),
    'verletDist': (_isNumber, 'a length (m), or a negative multiple of the smallest radius'),
    'plane': (_isOneOf('strain', 'stress'), "'strain' or 'stress'"),
    'bulkViscosity': (lambda v: _isNumber(v) and v >= 0,
                      '0 or a positive multiple of the usual bulk viscosity'),
    'fracture': (_isOneOf('none', 'instant', 'cohesive'), "'none', 'instant' or 'cohesive'"),
    'threads': (lambda v: isinstance(v, int) and not isinstance(v, bool) and 1 <= v <= _PROCESSORS,
                'a whole number from 1 to the %d processors of this machine' % _PROCESSORS),
}


def check(name: str, value: Any) -> None:
    """ValueError, with one sentence, for an invalid value of a known choice; other names are not checked."""
    if name in KNOWN and not KNOWN[name][0](value):
        raise ValueError('vary has the choice %s=%s, it must be %s.' % (name, arguments.shown(value), KNOWN[name][1]))


class Choices:
    """One setting, as the argument of a scene function.

    Helpers apply the known choices; where the setting does not have a choice, the scene's own value is
    used. `choices[name]` and `choices.get(name, default)` return any other choice. All choices that
    the scene used are recorded: a setting with a choice that the scene never used is refused.
    """

    def __init__(self, settings: dict[str, Any]) -> None:
        if not isinstance(settings, dict):
            arguments.refuse('settings', settings, 'a dict {name: value}')
        self._settings = dict(settings)
        self.used = {}  # name: value, of all choices that were used

    def get(self, name: str, default: Any = None) -> Any:
        """The value of the choice `name`, or `default` if the setting does not have it."""
        value = self._settings.get(name, default)
        self.used[name] = value
        return value

    def __getitem__(self, name: str) -> Any:
        if name not in self._settings:
            raise ValueError('the scene needs the choice %s, which is not in vary.' % arguments.shown(name))
        return self.get(name)

    def neverAsked(self) -> list[str]:
        """Names in the setting that the scene did not use; `threads` is used in any case."""
        return [n for n in self._settings if n not in self.used and n != 'threads']

    def size(self, default: float) -> float:
        """Length of the elements' edges (m); `default` if the setting does not have `size`."""
        return self.get('size', default)

    def smooth(self, default: bool = False) -> bool:
        """True if the boundary is to be smooth, for addPolygon(smooth=...)."""
        return self.get('smooth', default)

    def timeStep(self, critical: float, default: float = .8) -> float:
        """(s) The setting's fraction `timeStep` of the critical time step `critical` (s)."""
        critical = arguments.number('critical', critical, lambda v: v > 0, 'a positive number (s)')
        return critical * arguments.number('timeStep', self.get('timeStep', default), lambda v: v > 0,
                                        KNOWN['timeStep'][1])

    def solver(self, **settings: Any) -> FESolver:
        """An FESolver with `settings`; passes, halo, contactTolerance and bulk viscosity as in the setting.
        ValueError as FESolver."""
        for name, usual in (('passes', 1), ('halo', 0), ('contactTolerance', 'default')):
            settings[name] = self.get(name, settings.get(name, usual))
        times = self.get('bulkViscosity')
        if times is not None:
            settings.update(linearViscosity=times * LINEAR_VISCOSITY, quadraticViscosity=times * QUADRATIC_VISCOSITY)
        else:
            self.used['bulkViscosity'] = settings.get('linearViscosity', 0) / LINEAR_VISCOSITY
        return wrapper.FESolver(**settings)

    def material(self, **attributes: Any) -> FEMat:
        """An FEMat, added to O.materials; a BrittleFEMat if there is a `tensileStrength`.

        plane 'stress' or 'strain' sets planeStress; fracture 'none' omits tensileStrength and the
        other constants of fracture, 'instant' sets fractureEnergy to 0, 'cohesive' keeps the
        scene's value, which must be positive: otherwise ValueError.
        """
        isBrittle = attributes.get('tensileStrength', 0) > 0
        plane = self.get('plane', 'stress' if attributes.get('planeStress') else 'strain')
        attributes['planeStress'] = plane == 'stress'
        if isBrittle:
            own = 'cohesive' if attributes.get('fractureEnergy', 0) > 0 else 'instant'
            fracture = self.get('fracture', own)
            if fracture == 'cohesive' and own != 'cohesive':
                raise ValueError("fracture is 'cohesive', but the scene's material has no "
                                 'fractureEnergy (J/m²).')
            if fracture == 'instant':
                attributes['fractureEnergy'] = 0
            isBrittle = fracture != 'none'
        if not isBrittle:
            for name in wrapper.BrittleFEMat().dict():
                if name not in wrapper.FEMat().dict():
                    attributes.pop(name, None)
        made = (wrapper.BrittleFEMat if isBrittle else wrapper.FEMat)(**attributes)
        wrapper.Omega().materials.append(made)
        return made

    def collider(self, functors: list, default: str = 'LebesgueCollider') -> Any:
        """A collider with the bound functors `functors`; None if the setting has 'none'."""
        name = self.get('collider', default)
        distance = self.get('verletDist')
        if name == 'none':
            return None
        made = getattr(wrapper, name)(functors)
        if distance is not None:
            made.verletDist = distance
        self.used['verletDist'] = made.verletDist
        return made

    def engines(self, fe: FESolver, spheres: bool = False) -> None:
        """Sets O.engines and O.dt for bodies of the FESolver `fe`, with `spheres` also for those.

        The step is the setting's fraction of fe.criticalTimeStep(), or .8 of it.
        """
        requireSolver(fe)
        w, dt = wrapper, self.timeStep(fe.criticalTimeStep())
        bounds = [w.Bo1_Sphere_Aabb()] * bool(spheres) + [w.Bo1_SurfaceSegment_Aabb()]
        engines = [w.ForceResetter(), self.collider(bounds)]
        if spheres:
            engines.append(w.InteractionLoop(
                [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Sphere_SurfaceSegment_ScGeom()],
                [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]))
        engines += [fe] + [w.NewtonIntegrator()] * bool(spheres)
        omega = w.Omega()
        omega.engines = [e for e in engines if e is not None]
        omega.dt = dt
