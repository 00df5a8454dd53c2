"""Outlines for FESolver.addPolygon: lists of (x, y) in metres, counter-clockwise; those with far more points than
their shape needs, such as contours of pixels."""

from __future__ import annotations

import math
from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag.arguments import ArrayLike, Loop, listOf, pair, pointsOf, positive, real, refuse, shown, whole
from yadefrag.messages import shapely, treeOf

CIRCLE_POINTS = 64
MOST_POINTS = 10**7  # a longer list needs gigabytes
_LEAST = 2.**-40  # of the tolerance: with less all points of a loop stay


def _pair(name, value):
    return pair(name, value, 'a pair of numbers (x, y)')


def _length(name, value):
    length = real(value)
    if length is None:
        refuse(name, value, 'a number of metres')
    if not (math.isfinite(length) and length > 0):
        raise ValueError('%s is %s m, it must be positive and finite.' % (name, shown(value)))
    return length


def rectangle(low: ArrayLike, high: ArrayLike) -> Loop:
    """The four corners of an axis-parallel rectangle from its lower left and upper right corner
    (m).

    ValueError unless `high` is above and to the right of `low`.
    """
    left, bottom = _pair('low', low)
    right, top = _pair('high', high)
    if not (left < right and bottom < top):
        raise ValueError('high is %s, it must be above and to the right of low, which is %s.' %
                         (shown(high), shown(low)))
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
    count = CIRCLE_POINTS if n is None else whole('n', n, 3, 'a whole number of at least 3 points', MOST_POINTS)
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


def holesOf(holes: Any) -> list[numpy.ndarray]:
    """Loops of points from addPolygon's `holes`."""
    return [pointsOf('holes[%d]' % i, loop, 3) for i, loop in enumerate(
        listOf('holes', holes, 'a list of loops of points (x, y) in m'))]


def simplified(points: numpy.ndarray, holes: list[numpy.ndarray], tolerance: float,
               flags: numpy.ndarray | None) -> tuple[numpy.ndarray, list[numpy.ndarray], numpy.ndarray | None]:
    """Outline, holes and the outline's flags (None or an array) without the points that a
    simplification within `tolerance` (m) removes: addPolygon's `simplify`."""
    tolerance = positive('simplify', tolerance, 'm')
    loops = [points, *holes]
    _yadefrag.checkedPolygon(points, holes)
    for i, loop in enumerate(loops):
        _check('hole %d' % (i - 1) if i else 'the outline', loop, tolerance)
    anchors = [{0, int(numpy.hypot(*(loop - loop[0]).T).argmax())} for loop in loops]
    if flags is not None:  # a straight corner in a smooth part is intentional
        anchors[0].update(numpy.nonzero(~flags & (numpy.roll(flags, 1) | numpy.roll(flags, -1)))[0].tolist())
    # A power of two, which changes no bits: GEOS squares coordinates.
    scale = 2.**min(-math.frexp(max(abs(loop).max() for loop in loops))[1], 1023)
    kept = _kept([loop * scale for loop in loops], [sorted(those) for those in anchors], tolerance * scale)
    return (points[kept[0]], [hole[stay] for hole, stay in zip(holes, kept[1:])],
            None if flags is None else flags[kept[0]])


def _check(name, loop, tolerance):
    ends = numpy.roll(loop, -1, axis=0)
    (x, y), (nextX, nextY) = (loop - loop[0]).T, (ends - loop[0]).T
    most = abs((x * nextY - y * nextX).sum()) / 2 / numpy.hypot(*(ends - loop).T).sum()
    if not tolerance < most:
        raise ValueError("simplify is %.4g m, but %s could vanish; it must be less than that loop's area over its "
                         'length, %.4g m.' % (tolerance, name, most))


def _kept(loops, anchors, tolerance):
    """The numbers of the points that stay, of each loop. `anchors`: at least two of each, which stay."""
    shapes = shapely('geometry', 'simplify works')
    tolerances = dict.fromkeys(range(len(loops)), tolerance)
    kept, rings, wrong = list(loops), list(loops), set(tolerances)
    while wrong:
        for i in wrong:
            kept[i] = _within(shapes, loops[i], anchors[i], tolerances[i]) if tolerances[i] > _LEAST * tolerance else \
                list(range(len(loops[i])))
            rings[i] = shapes.LinearRing(loops[i][kept[i]])
        near = treeOf(rings, 'query', 'simplify works')
        wrong = {i for i, ring in enumerate(rings) if len(kept[i]) < len(loops[i]) and
                 (not ring.is_simple or any(i != k and ring.intersects(rings[k]) for k in near(ring)))}
        for i in wrong:
            tolerances[i] /= 2
    return kept


def _within(shapes, loop, anchors, tolerance):
    numbers = {tuple(point): i for i, point in enumerate(loop.tolist())}
    kept = []
    for first, last in zip(anchors, anchors[1:] + [len(loop)]):
        part = shapes.LineString(numpy.concatenate([loop, loop[:1]])[first:last + 1])
        kept += [numbers[point] for point in part.simplify(tolerance).coords[:-1]]
    return kept
