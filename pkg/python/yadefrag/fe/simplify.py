"""Outlines with far more points than their shape needs, such as contours of pixels."""

from __future__ import annotations

import math

import numpy

from yadefrag import _yadefrag
from yadefrag.arguments import positive
from yadefrag.libraries import shapely, treeOf

_LEAST = 2.**-40  # of the tolerance: with less all points of a loop stay


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
