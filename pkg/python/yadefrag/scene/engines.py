"""A complete list of engines; what scripts ask of InsertionSortCollider and InteractionLoop, for our classes; bodies sorted
so that neighbours in space are neighbours in memory."""

from __future__ import annotations

import builtins
import functools
import math
import sys
from collections.abc import Collection, Iterable
from typing import Any, TypeVar

import numpy

from yade import utils, wrapper
from yadefrag.arguments import ArrayLike, FESolver, flag, listOf, number, numbersOf, refuse

# Shapes of YADE, besides spheres, that engines(spheres=True) has functors for.
_WITH_FUNCTORS = ('Box', 'Facet', 'Wall')
T = TypeVar('T')
_BITS = 21  # per axis: three axes fit into 64 bits


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
    pull = tuple(fe.gravity) if gravity is None else numbersOf(gravity, 2) or numbersOf(gravity, 3)
    if pull is None:
        refuse('gravity', gravity, 'a pair of numbers (m/s²), or None')
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


def installColliders(colliders: Collection[str]) -> None:
    """dumpBounds of our colliders; utils.typedEngine of YADE's class finds ours in a scene that has none of YADE's."""
    for name in colliders:
        getattr(wrapper, name).dumpBounds = dumpBounds
    ours = {'InsertionSortCollider': colliders, 'InteractionLoop': ['CurveLoop'],
            'NewtonIntegrator': ['CurveIntegrator']}
    former = utils.typedEngine

    @functools.wraps(former)
    def found(name):
        engines = wrapper.Omega().engines
        classes = [type(one).__name__ for one in engines]
        instead = () if name in classes else ours.get(name, ())
        return next((one for one, its in zip(engines, classes) if its in instead), None) or former(name)

    # YADE has copied its functions to the names of scripts, and to yade.mpy, which finds its collider by it.
    for holder in utils, builtins, sys.modules['__main__'], sys.modules.get('yade.mpy'):
        if getattr(holder, 'typedEngine', None) is former:
            holder.typedEngine = found


def inCurveOrder(bodies: Iterable[T]) -> list[T]:
    """The given bodies in the order of their positions along the Lebesgue (Morton) curve.

    bodies  a sequence of Body that are not in O.bodies yet; or of positions, (x, y, z) or (position,
            radius), of spheres to be created. Lengths in any one unit.

    Returns a list; bodies with the same position code keep their order. ValueError for an element
    without a finite position. Memory is allocated in the order of creation, and YADE's loops use
    the order of the bodies' numbers: therefore sort the positions first, then create and append the
    bodies. For bodies created in another order, the interaction loop gains as much time as the
    integrator loses. Paper section 4.2 (Diekmann et al. 2000).
    """
    bodies = listOf('bodies', bodies, 'a sequence of bodies, or of places')
    if not bodies:
        return bodies
    places = numpy.array([_place(body, number) for number, body in enumerate(bodies)])
    order = numpy.argsort(_codes(places), kind='stable')
    return [bodies[k] for k in order]


def _place(body, number):
    """Three finite coordinates of a body, a position, or a position with a radius."""
    state = getattr(body, 'state', None)
    try:
        at = body if state is None else state.pos
        if len(at) == 2:
            at = at[0]
        place = [float(at[k]) for k in range(3)] if len(at) == 3 else None
    except (TypeError, ValueError, IndexError):
        place = None
    if place is None or not numpy.isfinite(place).all():
        refuse('bodies[%d]' % number, body, 'a Body, or a place of three finite coordinates, '
               'alone or with a radius')
    return place


def _codes(places):
    """Position codes of positions (n, 3), in cubes of 2^-21 of the longest side of all: the bits of z, y and x in turn."""
    low = places.min(axis=0)
    longest = (places.max(axis=0) - low).max()
    cells = (places - low) * ((2**_BITS - 1) / longest) if longest > 0 else 0 * places
    cells, codes = cells.astype(numpy.uint64), numpy.zeros(len(places), numpy.uint64)
    for bit in range(_BITS):
        for axis in range(3):
            codes |= (cells[:, axis] >> numpy.uint64(bit) & numpy.uint64(1)) << numpy.uint64(3 * bit + axis)
    return codes
