"""Outlines for FESolver.addPolygon: lists of (x, y) in metres, counter-clockwise."""

from __future__ import annotations

import math

from yadefrag import arguments
from yadefrag.hints import ArrayLike, Loop

CIRCLE_POINTS = 64
MOST_POINTS = 10**7  # a longer list needs gigabytes


def _pair(name, value):
    return arguments.pair(name, value, 'a pair of numbers (x, y)')


def _length(name, value):
    length = arguments.real(value)
    if length is None:
        arguments.refuse(name, value, 'a number of metres')
    if not (math.isfinite(length) and length > 0):
        raise ValueError('%s is %s m, it must be positive and finite.' % (name, arguments.shown(value)))
    return length


def _count(n):
    if n is None:
        return CIRCLE_POINTS
    return arguments.whole('n', n, 3, 'a whole number of at least 3 points', MOST_POINTS)


def rectangle(low: ArrayLike, high: ArrayLike) -> Loop:
    """The four corners of an axis-parallel rectangle from its lower left and upper right corner
    (m).

    ValueError unless `high` is above and to the right of `low`.
    """
    left, bottom = _pair('low', low)
    right, top = _pair('high', high)
    if not (left < right and bottom < top):
        raise ValueError('high is %s, it must be above and to the right of low, which is %s.' %
                         (arguments.shown(high), arguments.shown(low)))
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def circle(centre: ArrayLike, radius: float, n: int | None = None) -> Loop:
    """`n` points (default 64) on a circle of `radius` (m), the first to the right of the centre.

    With `smooth=True`, addPolygon needs only as many points as there will be boundary nodes. A
    straight-sided circle is a polygon of n sides; addPolygon divides long sides into straight parts:
    use n of about 2π·radius/size or more. The polygon's area is less than the circle's, by 0.16 % for
    64 points. Points closer than `size` make smaller triangles.
    ValueError for a radius that is not positive or fewer than 3 points.
    """
    x, y = _pair('centre', centre)
    radius = _length('radius', radius)
    count = _count(n)
    angles = [2 * math.pi * i / count for i in range(count)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def ring(centre: ArrayLike, inner: float, outer: float, n: int | None = None) -> tuple[Loop, list[Loop]]:
    """(outline, holes) of a ring with the radii `inner` < `outer` (m), `n` points on each circle.

    Otherwise as `circle`: `fe.addPolygon(*ring((0, 0), .8, 1), size=.05, ...)`.
    """
    inner = _length('inner', inner)
    outer = _length('outer', outer)
    if not inner < outer:
        raise ValueError('inner is %g m, it must be less than outer, which is %g m.' % (inner, outer))
    return circle(centre, outer, n), [circle(centre, inner, n)]
