"""What scripts ask of InsertionSortCollider and InteractionLoop besides their attributes, for our classes."""

import builtins
import functools
import math
import sys
from collections.abc import Collection

import numpy

from yade import utils, wrapper


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


def install(names: Collection[str]) -> None:
    """`names`: those of the colliders."""
    for name in names:
        getattr(wrapper, name).dumpBounds = dumpBounds
    former = utils.typedEngine
    found = _findingOurs(former, {'InsertionSortCollider': names, 'InteractionLoop': ['CurveLoop'],
                                'NewtonIntegrator': ['CurveIntegrator']})
    # YADE has copied its functions to the names of scripts.
    for holder in utils, builtins, sys.modules['__main__']:
        if getattr(holder, 'typedEngine', None) is former:
            holder.typedEngine = found
