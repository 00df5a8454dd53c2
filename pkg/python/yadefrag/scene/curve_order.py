"""Sorts bodies so that neighbours in space are neighbours in memory."""

from collections.abc import Iterable
from typing import TypeVar

import numpy as np

from yadefrag.arguments import refuse

T = TypeVar('T')
_BITS = 21  # per axis: three axes fit into 64 bits


def inCurveOrder(bodies: Iterable[T]) -> list[T]:
    """The same bodies in the order of their positions along the Lebesgue (Morton) curve.

    bodies  a sequence of Body that are not in O.bodies yet; or of positions, (x, y, z) or (position,
            radius), of spheres to be created. Lengths in any one unit.

    Returns a list; bodies with the same position code keep their order. ValueError for an element
    without a finite position. Memory is allocated in the order of creation, and YADE's loops use
    the order of the bodies' numbers: therefore sort the positions first, then create and append the
    bodies. For bodies created in another order, the interaction loop gains as much time as the
    integrator loses. Paper section 4.2 (Diekmann et al. 2000).
    """
    try:
        bodies = list(bodies)
    except TypeError:
        refuse('bodies', bodies, 'a sequence of bodies, or of places')
    if not bodies:
        return bodies
    places = np.array([_place(body, number) for number, body in enumerate(bodies)])
    order = np.argsort(_codes(places), kind='stable')
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
    if place is None or not np.isfinite(place).all():
        refuse('bodies[%d]' % number, body, 'a Body, or a place of three finite coordinates, '
               'alone or with a radius')
    return place


def _codes(places):
    """Position codes of positions (n, 3), in cubes of 2^-21 of the longest side of all."""
    low = places.min(axis=0)
    longest = (places.max(axis=0) - low).max()
    cells = (places - low) * ((2**_BITS - 1) / longest) if longest > 0 else 0 * places
    x, y, z = (_spread(cells[:, k].astype(np.uint64)) for k in range(3))
    return x | y << np.uint64(1) | z << np.uint64(2)


def _spread(number):
    """The bits of `number` with two empty ones after each."""
    for shift, mask in ((32, 0x1f00000000ffff), (16, 0x1f0000ff0000ff), (8, 0x100f00f00f00f00f),
                        (4, 0x10c30c30c30c30c3), (2, 0x1249249249249249)):
        number = (number | number << np.uint64(shift)) & np.uint64(mask)
    return number
