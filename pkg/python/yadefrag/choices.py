"""The choices between speed and accuracy that tradeoff() knows by name, and what a scene asks for.

KNOWN names them; a scene function gets a `Choices` and builds with its helpers, so that it does not
depend on which of them are varied.
"""

import math
import os

from yade import wrapper
from yadefrag import values
from yadefrag.shown import requireSolver

COLLIDERS = ('LebesgueCollider', 'LinearCodeCollider', 'HierarchyCollider',
             'InsertionSortCollider')
LINEAR_VISCOSITY, QUADRATIC_VISCOSITY = .06, 1.2  # usual coefficients of bulk viscosity


def _isNumber(value):
    number = values.real(value)
    return number is not None and math.isfinite(number)


def _isPenalty(value):
    """'penalty' or 'penalty:F' with 0 < F ≤ 1."""
    kind, _, factor = value.partition(':') if isinstance(value, str) else ('', '', '')
    if kind != 'penalty':
        return False
    try:
        return ':' not in value or 0 < float(factor) <= 1
    except ValueError:
        return False


def _isOneOf(*allowed):
    return lambda value: any(value is a if isinstance(a, bool) else
                             type(value) is type(a) and value == a for a in allowed)


# name: (is a value right, what is right)
KNOWN = {
    'correction': (lambda v: v == 'lagrange' or _isPenalty(v),
                   "'lagrange', 'penalty', or 'penalty:F' with a factor F above 0 and at most 1"),
    'passes': (_isOneOf(1, 2), '1 or 2'),
    'entry': (_isOneOf('path', 'flags'), "'path' or 'flags'"),
    'smooth': (_isOneOf(True, False), 'True or False'),
    'size': (lambda v: _isNumber(v) and v > 0, 'a positive length (m)'),
    'timeStep': (lambda v: _isNumber(v) and v > 0,
                 'a positive fraction of the critical time step'),
    'halo': (lambda v: _isNumber(v) and 0 <= v <= .5,
             'a share of the shortest segment, at most 0.5, or 0 for one that follows the speed'),
    'collider': (lambda v: v == 'none' or v in COLLIDERS,
                 "'none' or one of " + ', '.join(map(repr, COLLIDERS))),
    'verletDist': (_isNumber, 'a length (m), or a negative multiple of the smallest radius'),
    'plane': (_isOneOf('strain', 'stress'), "'strain' or 'stress'"),
    'bulkViscosity': (lambda v: _isNumber(v) and v >= 0,
                      '0 or a positive multiple of the usual bulk viscosity'),
    'fracture': (_isOneOf('none', 'instant', 'cohesive'), "'none', 'instant' or 'cohesive'"),
    'threads': (lambda v: isinstance(v, int) and not isinstance(v, bool)
                and 1 <= v <= (os.cpu_count() or 1),
                'a whole number from 1 to the %d processors of this machine' %
                (os.cpu_count() or 1)),
}


def check(name, value):
    """ValueError, one sentence, for a value that a known choice cannot have; others are free."""
    if name in KNOWN and not KNOWN[name][0](value):
        raise ValueError('vary has the choice %s=%s, it must be %s.' %
                         (name, values.shown(value), KNOWN[name][1]))


class Choices:
    """One setting, as a scene function sees it.

    Helpers build what the known choices are about, each with the scene's own value where the
    setting says nothing; `choices[name]` and `choices.get(name, default)` give any other choice.
    What was asked for is remembered: a setting of which the scene never asked something is refused.
    """

    def __init__(self, settings):
        if not isinstance(settings, dict):
            values.refuse('settings', settings, 'a dict {name: value}')
        self._settings = dict(settings)
        self.used = {}  # name: value, of all choices that were asked for

    def get(self, name, default=None):
        """The value of the choice `name`, or `default` where the setting has none."""
        value = self._settings.get(name, default)
        self.used[name] = value
        return value

    def __getitem__(self, name):
        if name not in self._settings:
            raise ValueError('the scene needs the choice %s, which vary does not have.' %
                             values.shown(name))
        return self.get(name)

    def neverAsked(self):
        """Names of the setting that the scene did not ask for; `threads` needs no asking."""
        return [n for n in self._settings if n not in self.used and n != 'threads']

    def size(self, default):
        """Length of the elements' edges (m); `default` where the setting has no `size`."""
        return self.get('size', default)

    def smooth(self, default=False):
        """Is the boundary to be smooth, for addPolygon(smooth=...)."""
        return self.get('smooth', default)

    def timeStep(self, critical, default=.8):
        """(s) The setting's fraction `timeStep` of the step `critical` (s)."""
        critical = values.number('critical', critical, lambda v: v > 0, 'a positive number (s)')
        return critical * values.number('timeStep', self.get('timeStep', default), lambda v: v > 0,
                                        KNOWN['timeStep'][1])

    def solver(self, **settings):
        """An FESolver with `settings`, and correction, entry, passes, halo and bulk viscosity as chosen.

        'penalty:F' is correction='penalty' with penaltyFactor=F. ValueError as FESolver.
        """
        correction = values.text('correction',
                                 self.get('correction', settings.pop('correction', 'lagrange')))
        kind, _, factor = correction.partition(':')
        settings.update(correction=kind, passes=self.get('passes', settings.get('passes', 1)),
                        entry=self.get('entry', settings.get('entry', 'path')),
                        halo=self.get('halo', settings.get('halo', 0)))
        if factor:
            settings['penaltyFactor'] = float(factor)
        times = self.get('bulkViscosity')
        if times is not None:
            settings.update(linearViscosity=times * LINEAR_VISCOSITY,
                            quadraticViscosity=times * QUADRATIC_VISCOSITY)
        else:
            self.used['bulkViscosity'] = settings.get('linearViscosity', 0) / LINEAR_VISCOSITY
        return wrapper.FESolver(**settings)

    def material(self, **attributes):
        """An FEMat, put into O.materials; a BrittleFEMat if there is a `tensileStrength`.

        plane 'stress' or 'strain' is planeStress; fracture 'none' leaves tensileStrength and the
        like out, 'instant' sets fractureEnergy to 0, 'cohesive' keeps the scene's, which must be
        positive: else ValueError.
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

    def collider(self, functors, default='LebesgueCollider'):
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

    def engines(self, fe, spheres=False):
        """Sets O.engines and O.dt for bodies of the FESolver `fe`, with `spheres` also for those.

        The step is the setting's fraction of fe.criticalTimeStep(), .8 where it has none.
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
