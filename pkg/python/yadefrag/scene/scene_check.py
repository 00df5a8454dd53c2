"""Messages about contacts, forces and steps that FE bodies of a scene will not have, one sentence each."""

import weakref
from collections.abc import Mapping
from typing import Any

from yade import wrapper
from yadefrag.messages import tellNumbers, warn

# These engines apply no forces to bodies, or apply them anew in each step.
_WITHOUT_FORCES = (wrapper.FESolver, wrapper.Collider, wrapper.PeriodicEngine, wrapper.NewtonIntegrator)
_THICK = 10  # thickness over the diameter of spheres above which one of the two is likely to be a mistake
_RIGID = ('Wall', 'Box', 'Facet')  # shapes that FE bodies touch as rigid bodies
_UNMOVED = ('O.engines has no FESolver, so that nothing moves its bodies: O.engines = engines(fe) sets the '
             'engines.')

solvers: Any = weakref.WeakSet()  # with bodies
_looked = None  # scene and number of its bodies when they were last searched


def _dispatchers(engines, holder, attribute, alone):
    """Those of the engines of one kind, and those that are engines themselves."""
    return [getattr(one, attribute) for one in engines if isinstance(one, holder)] + \
        [one for one in engines if isinstance(one, alone)]


def _found(dispatchers, *shapes):
    """The first functor for a body's shape, or for those of two bodies; None if there is none."""
    return next(filter(None, (one.dispFunctor(*shapes) for one in dispatchers)), None)


def sentences(kinds: Mapping[str, int], spheres: int, beside: int, leaving: int, loose: int, gravityZ: float,
              rigidBodies: bool, largest: float = 0., thickness: float = 0.) -> list[str]:
    """List of sentences about the scene; FESolver calls it when bodies or engines are new.

    kinds                   {name of a shape: a body with it}, without surface segments
    spheres                 number of spheres, up to 2
    beside, leaving, loose  a sphere that is beside the plane z = 0, leaves it, may leave it; -1: none
    gravityZ                m/s², of NewtonIntegrator
    rigidBodies             True: FESolver's bodies have contact with those of _RIGID
    largest                 m, radius of the largest sphere
    thickness               m, largest thickness of FESolver's bodies
    """
    tellNumbers()  # O.step() has not told them
    omega = wrapper.Omega()
    engines = [engine for engine in omega.engines if not engine.dead]
    loops = _dispatchers(engines, wrapper.InteractionLoop, 'geomDispatcher', wrapper.IGeomDispatcher)
    finders = _dispatchers(engines, wrapper.Collider, 'boundDispatcher', wrapper.BoundDispatcher)
    found = []
    for shape, body in kinds.items():
        if shape in _RIGID and rigidBodies:
            continue
        functor = _found(loops, omega.bodies[body].shape, wrapper.SurfaceSegment())
        if functor is None:
            found.append(_untouched(shape, body))
        elif shape not in (*functor.bases, 'GridNode'):
            found.append('FE bodies touch bodies of the shape %s, such as #%d, as a sphere at their position, and '
                         'go through the rest of them.' % (shape, body))
    if 'Sphere' in kinds:
        if _found(finders, wrapper.SurfaceSegment()) is None:
            found.append('Spheres go through FE bodies: the collider has no Bo1_SurfaceSegment_Aabb; '
                         'engines(fe, spheres=True) has it.')
        found += _throughOthers(kinds, spheres, loops, finders)
        found += _outOfPlane(beside, leaving, loose, gravityZ)
        if thickness > _THICK * 2 * largest:
            found.append('FE bodies are %g m thick, and the largest sphere has a diameter of %g m: masses and '
                         'forces of FE bodies are those of their whole thickness; addPolygon(thickness=%g) '
                         'fits these spheres.' % (thickness, 2 * largest, 2 * largest))
    if gravityZ and loose < 0:
        found.append('The gravity of NewtonIntegrator along z does not act on FE bodies: they move in '
                     'the plane z = 0 only.')
    found += ['%s does not act on FE bodies; the gravity of NewtonIntegrator does.' % type(one).__name__
              for one in engines if isinstance(one, wrapper.FieldApplier) and not isinstance(one, wrapper.NewtonIntegrator)]
    if not any(isinstance(one, wrapper.ForceResetter) for one in engines):
        other = [one for one in engines if not isinstance(one, _WITHOUT_FORCES)]
        if other:
            found.append('O.engines has no ForceResetter: the forces of %s on bodies add up from step '
                         'to step.' % type(other[0]).__name__)
    return found


def _throughOthers(kinds, spheres, loops, finders):
    """Spheres and other bodies without a functor, if there is a loop at all."""
    bodies = wrapper.Omega().bodies
    sphere = bodies[kinds['Sphere']].shape
    if not loops or not finders:
        return
    for shape, body in kinds.items():
        if shape == 'Sphere' and spheres < 2:
            continue
        other = bodies[body].shape
        name = 'Ig2_Sphere_Sphere_ScGeom' if shape == 'Sphere' else 'Ig2_%s_Sphere_ScGeom' % shape
        lacking = ('no InteractionLoop has an ' + name if _found(loops, other, sphere) is None else
                   'the collider has no Bo1_%s_Aabb' % shape if _found(finders, other) is None else '')
        if lacking:
            yield ('Spheres go through bodies of the shape %s, such as #%d: %s%s.' %
                   (shape, body, lacking, '; engines(fe, spheres=True) has it' * (shape in (*_RIGID, 'Sphere'))))


def _untouched(shape, body):
    if shape == 'Sphere':
        return ('Spheres go through FE bodies: no InteractionLoop has an Ig2_Sphere_SurfaceSegment_ScGeom; '
                'engines(fe, spheres=True) has it.')
    if shape in _RIGID:
        return ('FE bodies go through bodies of the shape %s, such as #%d: FESolver.rigidBodies is '
                'False.' % (shape, body))
    return ('FE bodies go through bodies of the shape %s, such as #%d: they touch each other, spheres, '
            'walls, boxes and facets only; a body of FESolver with fixed nodes can take its place.' % (shape, body))


def _outOfPlane(beside, leaving, loose, gravityZ):
    if beside >= 0:
        return ['Sphere #%d is beside the plane z = 0 of the FE bodies, and does not touch them.' % beside]
    if leaving >= 0:
        return ['Sphere #%d leaves the plane z = 0, and then passes FE bodies: its centre must be in it, '
                "and 'z' among its blockedDOFs." % leaving]
    if loose >= 0 and gravityZ:
        return ['Gravity along z moves sphere #%d out of the plane z = 0 of the FE bodies; block its z, '
                'or use gravity along y.' % loose]
    return []


def tellUnmoved() -> None:
    """Before a run: a warning, once for each scene and number of bodies, about FE bodies whose FESolver is no engine, and
    has no step of its own in which it could warn. It is also in the `warnings` of all solvers with bodies."""
    global _looked
    omega = wrapper.Omega()
    if not solvers or any(isinstance(one, (wrapper.FESolver, wrapper.ParallelEngine)) for one in omega.engines):
        return
    former, _looked = _looked, (omega.tags['id'], len(omega.bodies))
    if _looked == former or not any(isinstance(body.shape, wrapper.SurfaceSegment) and body.shape.component >= 0
                                    for body in omega.bodies):
        return
    for solver in solvers:
        solver._note(_UNMOVED)
    warn(_UNMOVED)
