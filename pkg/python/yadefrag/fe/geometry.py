"""Outlines for FESolver.addPolygon: lists of (x, y) in metres, counter-clockwise."""

from __future__ import annotations

import math
from collections.abc import Iterable

from yadefrag import _yadefrag, arguments
from yadefrag.hints import ArrayLike, Loop

CIRCLE_POINTS = 64
MOST_GRAINS = 10**5
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
    points = arguments.pointsOf('outline', outline, 3)
    n = arguments.whole('n', n, most=MOST_GRAINS)
    seed = arguments.whole('seed', seed, least=0, right='a whole number, 0 or more', most=2**63 - 1)
    rounds = arguments.whole('rounds', rounds, least=0, right='a whole number, 0 or more', most=100)
    shortest = arguments.number('shortest', shortest, lambda v: math.isfinite(v) and v >= 0,
                             '0 or a positive number (m)')
    return _yadefrag.voronoiOf(points, n, seed, rounds, shortest)


def grainJoints(grains: Iterable[ArrayLike]) -> list[tuple[tuple, tuple]]:
    """The common sides of two grains, each once, for addPolygon's `joints`.

    grains  list of outlines, as `voronoi` returns them. A side is common if both its ends are the same
    points in both grains. ValueError for anything else than outlines.
    """
    if isinstance(grains, (str, bytes, dict, set, type)) or not hasattr(grains, '__iter__'):
        arguments.refuse('grains', grains, 'a list of outlines')
    known, joints = set(), []
    for i, grain in enumerate(grains):
        corners = [tuple(p) for p in arguments.pointsOf('grains[%d]' % i, grain, 3).tolist()]
        for side in zip(corners, corners[1:] + corners[:1]):
            if side[::-1] in known:
                joints.append(side)
            known.add(side)
    return joints
