"""Outlines for FESolver.addPolygon: lists of (x, y) in metres, counter-clockwise; those with far more points than
their shape needs, such as contours of pixels; grains that fill an outline, and their common sides."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag.arguments import ArrayLike, Loop, listOf, number, pair, pointsOf, positive, shown, whole
from yadefrag.messages import shapely, treeOf

CIRCLE_POINTS = 64
MOST_POINTS = 10**7  # a longer list needs gigabytes
MOST_GRAINS = 10**5
_TRIES = 10**4  # random points for a grain: of an outline that fills a thousandth of its box, ten are inside on average
_BITS = 2**64 - 1
_WORKS = 'voronoi works'
_INSIDE, _ON_OUTLINE, _CORNER = range(3)  # a corner of a grain; a higher one does not move to a lower one


def rectangle(low: ArrayLike, high: ArrayLike) -> Loop:
    """The four corners of an axis-parallel rectangle from its lower left and upper right corner
    (m).

    ValueError unless `high` is above and to the right of `low`.
    """
    left, bottom = pair('low', low)
    right, top = pair('high', high)
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
    x, y = pair('centre', centre)
    radius = positive('radius', radius, 'm')
    count = CIRCLE_POINTS if n is None else whole('n', n, 3, 'a whole number of at least 3 points', MOST_POINTS)
    angles = [2 * math.pi * i / count for i in range(count)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def ring(centre: ArrayLike, inner: float, outer: float, n: int | None = None) -> tuple[Loop, list[Loop]]:
    """(outline, holes) of a ring with the radii `inner` < `outer` (m), `n` points on each circle.

    Otherwise as `circle`: `fe.addPolygon(*ring((0, 0), .8, 1), size=.05, ...)`.
    """
    inner, outer = positive('inner', inner, 'm'), positive('outer', outer, 'm')
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
    shape = shapely('geometry', 'simplify works').Polygon(loop)
    most = shape.area / shape.length
    if not tolerance < most:
        raise ValueError("simplify is %.4g m, but %s could vanish; it must be less than that loop's area over its "
                         'length, %.4g m.' % (tolerance, name, most))


def _kept(loops, anchors, tolerance):
    """The numbers of the points that stay, of each loop. `anchors`: at least two of each, which stay; no parts between
    them cross each other afterwards."""
    parts = [numpy.concatenate([loop, loop[:1]])[first:last + 1] for loop, stay in zip(loops, anchors)
             for first, last in zip(stay, stay[1:] + [len(loop)])]
    left = iter(shapely('geometry', 'simplify works').MultiLineString(parts).simplify(tolerance).geoms)
    kept = []
    for loop, stay in zip(loops, anchors):
        numbers = {tuple(point): i for i, point in enumerate(loop.tolist())}
        kept.append([numbers[point] for _ in stay for point in list(next(left).coords)[:-1]])
    return kept


# --- grains

def voronoi(outline: ArrayLike, n: int, seed: int = 0, rounds: int = 0, shortest: float = 0) -> list[Loop]:
    """`n` grains that fill an outline, as a list of outlines: Voronoi cells of random points.

    outline  list of points (x, y) in m
    n        number of grains, at most 10⁵; if the outline is not convex a cell may consist of several
             parts, which gives more grains
    seed     the same seed gives the same grains
    rounds   of Lloyd's iteration (1982, IEEE Trans. Inf. Theory 28, 129), at most 100: each moves the
             points to the centroids of their cells, and makes the grains more even
    shortest (m) shorter sides that are not on the outline are shrunk to points. Otherwise the shortest
             side of a few hundred grains would make the time step a hundred times shorter; 0: none.
             A third of addPolygon's `size` is a good choice
    Corners of neighbours are equal to the last bit. Each grain may become a body, or all of them
    one body with `joints=grainJoints(grains)`. ValueError for an outline that addPolygon would
    refuse, or without room for so many points; and if `shortest` is too long for such grains.
    """
    points = pointsOf('outline', outline, 3)
    n = whole('n', n, most=MOST_GRAINS)
    seed = whole('seed', seed, least=0, right='a whole number, 0 or more', most=2**63 - 1)
    rounds = whole('rounds', rounds, least=0, right='a whole number, 0 or more', most=100)
    shortest = number('shortest', shortest, lambda v: math.isfinite(v) and v >= 0, '0 or a positive number (m)')
    outer = _yadefrag.checkedPolygon(points, [])[0]
    # A power of two, which changes no bits: GEOS squares coordinates.
    scale = 2.**min(-math.frexp(abs(outer).max())[1], 1023)
    cells = _Cells(outer * scale, n, seed)
    for _ in range(rounds):
        cells.even()
    loops = [[(x / scale, y / scale) for x, y in loop] for _, loop in cells.grains()]
    return _withoutShortSides(loops, set(map(tuple, outer.tolist())), shortest) if shortest > 0 else loops


class _Cells:
    """Random points in an outline, and the parts of the outline that are nearest to each."""

    def __init__(self, outline: numpy.ndarray, count: int, seed: int) -> None:
        self._shapes, self._operations = shapely('geometry', _WORKS), shapely('ops', _WORKS)
        self._outline = self._shapes.Polygon(outline)
        self._prepared = shapely('prepared', _WORKS).prep(self._outline)
        low, high = outline.min(axis=0), outline.max(axis=0)
        # Kept: shapely 1.8 does not keep it for as long as GEOS uses it.
        self._around = self._shapes.box(*(2 * low - high), *(2 * high - low))
        numbers, known, tries = _uniform(seed), {}, 0
        while len(known) < count:
            point = tuple((low + (next(numbers), next(numbers)) * (high - low)).tolist())
            tries += 1
            if self._isInside(point) and point not in known:
                known[point], tries = None, 0
            elif tries == _TRIES:
                raise ValueError('The outline has no room for %d grains: it is too thin, or too far from the origin.'
                                 % count)
        self._points = list(known)

    def _isInside(self, point):
        return self._prepared.contains(self._shapes.Point(point))

    def grains(self) -> list[tuple[int, Loop]]:
        """(number of the point, counter-clockwise loop) of each part, sorted."""
        nearest = treeOf([self._shapes.Point(point) for point in self._points], 'nearest', _WORKS)
        parts = []
        for face in self._operations.polygonize(self._edges()):
            inside = face.representative_point()
            if self._prepared.contains(inside):
                loop = list(self._shapes.polygon.orient(face).exterior.coords)[:-1]
                first = loop.index(min(loop))
                parts.append((nearest(inside), loop[first:] + loop[:first]))
        return sorted(parts)

    def _edges(self):
        """The outline and the edges between cells, divided where they meet, so that neighbours have the same bits."""
        ring = self._outline.exterior
        if len(self._points) < 2:
            return [ring]
        diagram = self._operations.voronoi_diagram(self._shapes.MultiPoint(self._points), self._around, edges=True)
        edges = [edge for part in diagram.geoms for edge in getattr(part, 'geoms', [part])]
        inner = [edge for edge in edges if self._prepared.contains_properly(edge)]
        # Division of all edges at once takes GEOS time that grows as the square of their number.
        crossing = [edge for edge in edges
                    if not self._prepared.contains_properly(edge) and self._prepared.intersects(edge)]
        divided = list(self._operations.unary_union([ring, *crossing]).geoms)
        places = {point for line in divided for point in line.coords}
        if all(point in places or not self._isInside(point) for edge in crossing for point in edge.coords):
            return inner + divided
        # GEOS has moved ends, which it does if a crossing is not found otherwise.
        return self._operations.unary_union([ring, *inner, *crossing])

    def even(self) -> None:
        """Moves each point to the centroid of its cell. A centroid outside the outline is not used."""
        for i, group in itertools.groupby(self.grains(), key=lambda part: part[0]):
            middle = self._shapes.MultiPolygon([self._shapes.Polygon(loop) for _, loop in group]).centroid
            if self._prepared.contains(middle):
                self._points[i] = (middle.x, middle.y)


def _uniform(seed: int) -> Iterator[float]:
    """Numbers in [0, 1) of SplitMix64 (Steele, Lea and Flood 2014, OOPSLA, fig. 14), as lib/core/random_bits.hpp."""
    def mixed(x):
        x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9 & _BITS
        x = (x ^ x >> 27) * 0x94d049bb133111eb & _BITS
        return x ^ x >> 31
    stride = 0x9e3779b97f4a7c15
    state = mixed(seed + stride & _BITS)
    while True:
        state = state + stride & _BITS
        yield (mixed(state) >> 11) * 2.**-53


def _withoutShortSides(grains, corners, shortest):
    """The grains without sides below `shortest` that are not on the outline, whose `corners` is a set of points:
    each is shrunk to a point, until there is none left. Grains that become a point or a line are removed."""
    before, merged = len(grains), True
    while merged:  # merged points may come near to others
        grains, merged = _merged(grains, corners, shortest)
    # The outline is unchanged, and every other side has a grain on both sides: grains with a positive
    # area therefore do not overlap.
    if 2 * len(grains) < before or not all(map(_isSound, grains)):
        raise ValueError('shortest is %.4g m, too long for these grains; it must be less, or the grains fewer.' %
                         shortest)
    return grains


def _merged(grains, corners, shortest):
    """(the grains after their short sides were shrunk, whether there was one)."""
    sides = {side for loop in grains for side in _sides(loop)}
    # Of each point: the point that it is merged with; of one that is not: [place, points there, rank].
    target = {point: point for loop in grains for point in loop}
    places = {point: [point, 1, _CORNER if point in corners else _INSIDE] for point in target}
    for a, b in sides:
        if (b, a) not in sides:
            for point in (a, b):
                places[point][2] = max(places[point][2], _ON_OUTLINE)

    def root(point):
        while target[point] != point:
            target[point] = point = target[target[point]]
        return point

    merged = False
    for a, b in sorted(sides):
        if math.dist(a, b) >= shortest or root(a) == root(b):
            continue
        stays, gone = sorted((root(a), root(b)), key=lambda point: places[point][2], reverse=True)
        (at, count, rank), (other, others, otherRank) = places[stays], places[gone]
        if otherRank == _CORNER or (otherRank == _ON_OUTLINE and (b, a) in sides):
            continue  # the outline would change, or be constricted
        if rank == _INSIDE:
            total = count + others
            places[stays] = [tuple((count * p + others * q) / total for p, q in zip(at, other)), total, rank]
        target[gone], merged = stays, True
    loops = [[place for place, _ in itertools.groupby(places[root(point)][0] for point in loop)] for loop in grains]
    loops = [loop[:-1] if loop[0] == loop[-1] else loop for loop in loops]
    return [loop for loop in loops if len(loop) >= 3], merged


def _sides(loop):
    return zip(loop, loop[1:] + loop[:1])


def _isSound(loop):
    """Whether it is simple and counter-clockwise."""
    try:
        return _yadefrag.checkedPolygon(numpy.array(loop), [])[0].tolist() == [list(point) for point in loop]
    except ValueError:
        return False


def grainJoints(grains: Iterable[ArrayLike]) -> list[tuple[tuple, tuple]]:
    """The common sides of two grains, each once, for addPolygon's `joints`.

    grains  list of outlines, as `voronoi` returns them. A side is common if both its ends are the same
    points in both grains. ValueError for anything else than outlines.
    """
    known, joints = set(), []
    for i, grain in enumerate(listOf('grains', grains, 'a list of outlines')):
        corners = [tuple(p) for p in pointsOf('grains[%d]' % i, grain, 3).tolist()]
        for side in _sides(corners):
            if side[::-1] in known:
                joints.append(side)
            known.add(side)
    return joints
