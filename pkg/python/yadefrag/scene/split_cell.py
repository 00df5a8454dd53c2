"""A periodic scene that yade.mpy has split.

YADE's box around the bodies of a process is wrong as soon as one is outside of the cell's first period,
and its collider accepts no box of more than half the cell. Each process therefore gets a copy of every
body of the others. The cell is not sent after the split: all processes must change it in the same way.
"""

import functools
from typing import Any

from yade import wrapper


def _isPeriodic(ourCollider):
    return wrapper.Omega().periodic and ourCollider() is not None


def controller() -> Any:
    """An engine that moves the cell by the contacts of this process, or None."""
    omega = wrapper.Omega()
    return next((e for e in omega.engines if omega.periodic and isinstance(e, wrapper.BoundaryController)
                 and not e.dead), None)


def _checkCell(mpy):
    """All processes call this together."""
    cells = mpy.comm.allgather([list(row) for row in wrapper.Omega().cell.hSize])
    if any(cell != cells[0] for cell in cells):
        raise RuntimeError('The periodic cell is not the same in all processes of yade.mpy: change it in '
                           'all of them, and not by what one of them knows, such as its contacts.')


def _noBoxes(mpy, ourCollider, updateDomainBounds):
    """Our colliders ignore a process whose box is empty."""
    @functools.wraps(updateDomainBounds)
    def update(subdomains):
        updateDomainBounds(subdomains)
        if _isPeriodic(ourCollider):
            _checkCell(mpy)
            for shape in (wrapper.Omega().bodies[id].shape for id in subdomains):
                shape.boundsMin, shape.boundsMax = 3 * [float('inf')], 3 * [-float('inf')]
    return update


def _all(mpy, ourCollider, genLocalIntersections):
    """Ids of bodies whose states are sent, by process; in place of this one: the processes to which."""
    @functools.wraps(genLocalIntersections)
    def generate(subdomains):
        if not _isPeriodic(ourCollider):
            return genLocalIntersections(subdomains)
        own = [b.id for b in wrapper.Omega().bodies
               if b.bounded and b.subdomain == mpy.rank and not b.isSubdomain]
        others = [rank for rank in range(1, mpy.numThreads) if rank != mpy.rank]
        lists = [own if rank in others else [] for rank in range(mpy.numThreads)]
        lists[mpy.rank] = others if own or mpy.rank > 0 else []
        return lists
    return generate


def _merge(mpy, ourCollider, mergeScene):
    @functools.wraps(mergeScene)
    def merge():
        if _isPeriodic(ourCollider):
            _checkCell(mpy)
        mergeScene()
    return merge


def complete(mpy: Any, ourCollider: Any) -> None:
    mpy.updateDomainBounds = _noBoxes(mpy, ourCollider, mpy.updateDomainBounds)
    mpy.genLocalIntersections = _all(mpy, ourCollider, mpy.genLocalIntersections)
    mpy.mergeScene = _merge(mpy, ourCollider, mpy.mergeScene)
