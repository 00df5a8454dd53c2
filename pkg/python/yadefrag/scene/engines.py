"""A complete list of engines; what scripts ask of InsertionSortCollider and InteractionLoop, for our classes."""

from __future__ import annotations

import builtins
import functools
import math
import sys
from collections.abc import Collection
from typing import Any

import numpy

from yade import utils, wrapper
from yadefrag.arguments import ArrayLike, FESolver, flag, number, numbersOf, refuse

# Shapes of YADE, besides spheres, that engines(spheres=True) has functors for.
_WITH_FUNCTORS = ('Box', 'Facet', 'Wall')


def engines(fe: FESolver, gravity: ArrayLike | None = None, spheres: bool = False, damping: float = 0.,
            collider: Any = None, moving: bool = False, loop: Any = None, integrator: Any = None) -> list[Any]:
    """List of engines for O.engines, in the correct order.

    fe        an FESolver
    gravity   m/s², for the FE bodies and spheres: a pair, or three numbers with z = 0; None: that of
              fe.gravity. Where there is an integrator, its `gravity` is that of all bodies from then on,
              also when it is changed
    spheres   False: no YADE spheres; the engines are [ForceResetter, fe], since FESolver searches
              by itself. True: also a collider, a loop over the contacts and an integrator, with the
              functors for spheres, clumps of spheres, walls, boxes and facets beside FE bodies, and
              Cundall and Strack's law
    moving    without spheres: True if YADE's walls, boxes or facets move; adds the integrator after
              fe, which moves them
    damping   of the integrator; acts on YADE's bodies only
    collider  None: LebesgueCollider; or another class of colliders
    loop      None: CurveLoop; or another class, such as InteractionLoop. Or a loop with functors of
              your own, which is used as it is: engines for other laws, for example
    integrator  None: CurveIntegrator; or another class, such as NewtonIntegrator
    Add other engines at the end: O.engines = engines(fe) + [PyRunner(...)]. ValueError before any
    change.
    """
    if not isinstance(fe, wrapper.FESolver):
        refuse('fe', fe, 'an FESolver')
    spheres, moving = flag('spheres', spheres), flag('moving', moving)
    finder = _classOf('collider', collider, wrapper.LebesgueCollider, wrapper.Collider)
    mover = _classOf('integrator', integrator, wrapper.CurveIntegrator, wrapper.NewtonIntegrator)
    if not isinstance(loop, wrapper.InteractionLoop):
        loop = _classOf('loop', loop, wrapper.CurveLoop, wrapper.InteractionLoop)
    damping = number('damping', damping, lambda v: math.isfinite(v) and v >= 0, '0 or positive')
    pull = tuple(fe.gravity) if gravity is None else _inPlane(gravity)
    if not (spheres or moving):
        if any(pull) or gravity is not None:
            fe.gravity = pull
        return [wrapper.ForceResetter(), fe]
    behind = mover(damping=damping)
    behind.gravity = (*pull, 0.)[:3]
    fe.gravity, fe.takesGravity = pull, True
    if not spheres:
        return [wrapper.ForceResetter(), fe, behind]
    if isinstance(loop, type):
        loop = loop([wrapper.Ig2_Sphere_Sphere_ScGeom(), wrapper.Ig2_Sphere_SurfaceSegment_ScGeom()] +
                    [getattr(wrapper, 'Ig2_%s_Sphere_ScGeom' % shape)() for shape in _WITH_FUNCTORS],
                    [wrapper.Ip2_FrictMat_FrictMat_FrictPhys()], [wrapper.Law2_ScGeom_FrictPhys_CundallStrack()])
    bounds = [getattr(wrapper, 'Bo1_%s_Aabb' % shape)() for shape in ('Sphere', 'SurfaceSegment', *_WITH_FUNCTORS)]
    return [wrapper.ForceResetter(), finder(bounds), loop, fe, behind]


def _classOf(name, given, usual, base):
    """The class `given`, or the usual one for None."""
    if given is None:
        return usual
    if not isinstance(given, type) or not issubclass(given, base):
        refuse(name, given, 'None, or a class derived from %s' % base.__name__)
    return given


def _inPlane(gravity):
    found = numbersOf(gravity, 2) or numbersOf(gravity, 3)
    if found is None:
        refuse('gravity', gravity, 'a pair of numbers (m/s²), or None')
    return found


def dumpBounds(self: wrapper.Collider) -> tuple[list[tuple], ...]:
    """The ends of all bounds along x, y and z, in ascending order: a tuple of three lists, as from
    InsertionSortCollider.

    An entry is (coordinate (m), number): the number of the body, negative at the lower end of its bound; in a
    periodic scene (coordinate within the cell, number, period). Both ends of a body without a bound, such as
    a clump, are its position. Empty lists before the first search. The ends are sorted at this call.
    """
    if not self.numAction:
        return [], [], []
    omega = wrapper.Omega()
    ids, ends = [], []
    for body in omega.bodies:
        bound = body.bound
        ids.append(body.id)
        ends.append((bound.min, bound.max) if bound and math.isfinite(bound.min[0]) else [body.state.pos] * 2)
    numbers, places = numpy.array(ids, int), numpy.array(ends, float).reshape(-1, 2, 3)
    spans = omega.cell.size if omega.periodic else (None,) * 3
    return tuple(_sortedEnds(numbers, places[:, :, axis], span) for axis, span in enumerate(spans))


def _sortedEnds(ids, ends, span):
    """`ends` (n, 2): the lower and the upper ones."""
    numbers, coordinates = numpy.stack([-ids, ids], axis=1).ravel(), ends.ravel()
    periods = numpy.zeros(len(numbers), int)
    if span is not None:
        periods = numpy.floor(coordinates / span).astype(int)
        coordinates = coordinates - periods * span
    order = numpy.argsort(coordinates, kind='stable')
    columns = [coordinates[order].tolist(), numbers[order].tolist()]
    if span is not None:
        columns.append(periods[order].tolist())
    return list(zip(*columns))


def _findingOurs(typedEngine, names):
    """utils.typedEngine of YADE's class in a scene with a class of `names` (of YADE's: ours) instead."""
    @functools.wraps(typedEngine)
    def found(name):
        engines = wrapper.Omega().engines
        if all(type(one).__name__ != name for one in engines):
            for one in engines:
                if type(one).__name__ in names.get(name, ()):
                    return one
        return typedEngine(name)
    return found


def installColliders(names: Collection[str]) -> None:
    """`names`: those of the colliders."""
    for name in names:
        getattr(wrapper, name).dumpBounds = dumpBounds
    former = utils.typedEngine
    found = _findingOurs(former, {'InsertionSortCollider': names, 'InteractionLoop': ['CurveLoop'],
                                'NewtonIntegrator': ['CurveIntegrator']})
    # YADE has copied its functions to the names of scripts, and to yade.mpy, which finds its collider by it.
    for holder in utils, builtins, sys.modules['__main__'], sys.modules.get('yade.mpy'):
        if getattr(holder, 'typedEngine', None) is former:
            holder.typedEngine = found
