"""Joins lines to loops; lines that are drawn twice; regions within regions: outlines with holes.

A region is (outline, [holes]) of arrays (n, 2). Points inside an odd number of regions are inside.
"""

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy

from yadefrag.arguments import shown, shownPath
from yadefrag.messages import needed, shapely, treeOf

Region = tuple[numpy.ndarray, list[numpy.ndarray]]
_WORKS = 'reading outlines works'


def withoutCopies(shapes: Sequence[list[numpy.ndarray]], gap: float, leftOut: Counter[str]) -> \
        list[list[numpy.ndarray]]:
    """The shapes, lists of lines (n, 2), without those that repeat another one's lines, in any direction; their number
    is added to leftOut."""
    known = {}
    for shape in shapes:
        known.setdefault(tuple(sorted(_segments(line, gap) for line in shape)), shape)
    if len(known) < len(shapes):
        leftOut['second copies of a line'] += len(shapes) - len(known)
    return list(known.values())


def _segments(line, gap):
    """The line's segments, rounded, in any direction and order, as bytes."""
    points = numpy.round(line / gap) @ (1, 1j) + 0  # complex numbers have an order; no -0
    pairs = numpy.sort([points[:-1], points[1:]], axis=0)
    return pairs[:, numpy.lexsort(pairs)].tobytes()


def joined(lines: Sequence[numpy.ndarray], gap: float) -> list[numpy.ndarray]:
    """[(n, 2)] closed loops, without the first point repeated at the end, from lines whose ends
    meet.

    gap  distance below which successive points of a line, and ends of lines, coincide. ValueError,
    with the position, for an end without partner or more than two ends that meet.
    """
    loops, chains = [], []
    for line in lines:
        line = withoutDoubles(line, gap)
        if len(line) > 3 and math.dist(line[0], line[-1]) <= gap:
            loops.append(line[:-1])
        elif len(line) > 1:
            chains.append(line)
    return loops + _rings(chains, gap) if chains else loops


def _rings(chains, gap):
    """Loops of lines with a partner at each end; the ends of line i are 2i and 2i + 1."""
    places = numpy.array([chain[side] for chain in chains for side in (0, -1)])
    meeting = needed('scipy.spatial', 'python3-scipy', _WORKS).cKDTree(places).query_ball_point(places, gap)
    for place, ends in zip(places.tolist(), meeting):
        if len(ends) != 2:
            words = 'ends at %s where no other one begins' if len(ends) == 1 else \
                'ends at %s together with more than one other'
            raise ValueError('a line %s: an outline is closed.' % (words % shown(tuple(place))))
    rings, free = [], set(range(len(chains)))
    for first in range(len(chains)):
        end, parts = 2 * first, []
        while end // 2 in free:
            free.remove(end // 2)
            parts.append(chains[end // 2][::1 - end % 2 * 2][:-1])
            end = sum(meeting[end ^ 1]) - (end ^ 1)
        if parts:
            rings.append(numpy.concatenate(parts))
    return rings


def withoutDoubles(line: numpy.ndarray, gap: float) -> numpy.ndarray:
    """The line without points within `gap` of the previous one; its last point is kept."""
    points, kept = line.tolist(), [0]
    for i in range(1, len(points)):
        if math.dist(points[i], points[kept[-1]]) > gap:
            kept.append(i)
    if len(kept) == len(points):
        return line
    if len(kept) > 1:
        kept[-1] = len(points) - 1
    return line[kept]


def area(loop: numpy.ndarray) -> float:
    """Signed area, positive for counter-clockwise loops."""
    x, y = (loop - loop[0]).T
    return float(x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1)) / 2


def regionOf(polygon: Any) -> Region:
    """Of shapely's polygon, without heights."""
    outline, *holes = (numpy.array(ring.coords)[:-1, :2] for ring in (polygon.exterior, *polygon.interiors))
    return outline, holes


def closed(loop: numpy.ndarray) -> numpy.ndarray:
    """The loop as a line that ends where it begins."""
    return numpy.concatenate([loop, loop[:1]])


def nested(regions: list[Region], file: str) -> list[Region]:
    """[(outline, [holes])], all counter-clockwise, in the order of the regions whose outlines are
    outlines.

    A region inside another one is a hole of it, and its own holes are outlines. A region in a hole of
    another one is outside that one, even if it fills the hole. ValueError, with the file and a place,
    for some of the regions that cross one another; others are not noticed.
    """
    regions = [(_turned(outline), list(map(_turned, holes))) for outline, holes in regions]
    inside = around(regions)
    if any(len(those) % 2 and regions[i][1] for i, those in enumerate(inside)):
        return nested([one for (outline, holes), those in zip(regions, inside) for one in (
            [(loop, []) for loop in (outline, *holes)] if len(those) % 2 else [(outline, holes)])], file)
    shapes = {i: (regions[i][0], list(regions[i][1])) for i, those in enumerate(inside) if len(those) % 2 == 0}
    for i, those in enumerate(inside):
        if i not in shapes:
            outer = min(those, key=lambda o: area(regions[o][0]))
            if outer not in shapes:
                raise ValueError('%s: an outline crosses another one near (%g, %g): draw one outline around '
                                 'both, or put them on different layers or into different files.' %
                                 (shownPath(file), *regions[i][0][0]))
            shapes[outer][1].append(regions[i][0])
    return list(shapes.values())


def _turned(loop):
    return loop if area(loop) >= 0 else loop[::-1]


def around(regions: list[Region]) -> list[list[int]]:
    """For each region, whose loops are counter-clockwise, the numbers of those that contain it."""
    polygon, prep = shapely('geometry', _WORKS).Polygon, shapely('prepared', _WORKS).prep
    sizes = [area(outline) for outline, _ in regions]
    solids = [polygon(outline, holes) for outline, holes in regions]
    near, prepared = treeOf(solids, 'query', _WORKS), list(map(prep, solids))
    places = [polygon(outline).representative_point() for outline, _ in regions]
    return [sorted(k for k in near(place) if sizes[k] > sizes[i] and prepared[k].contains(place))
            for i, place in enumerate(places)]
