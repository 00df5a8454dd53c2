"""Joins lines to loops; lines that are drawn twice; regions within regions: outlines with holes.

A region is (outline, [holes]) of arrays (n, 2). Points inside an odd number of regions are inside.
"""

import math
from collections.abc import Sequence

import numpy

from yadefrag.arguments import shown, shownPath
from yadefrag.messages import needed, shapely, treeOf

Region = tuple[numpy.ndarray, list[numpy.ndarray]]
_WORKS = 'reading outlines works'


def withoutCopies(shapes: Sequence[list[numpy.ndarray]], gap: float) -> tuple[list[list[numpy.ndarray]], int]:
    """(shapes, number of omitted ones): without those that repeat another one's lines, in any
    direction. A shape is a list of lines (n, 2)."""
    lines = [line for shape in shapes for line in shape]
    if not lines:
        return [], 0
    boxes = iter(map(tuple, numpy.round(numpy.hstack(_boxes(lines)) / gap).tolist()))
    candidates = {}
    for i, shape in enumerate(shapes):
        candidates.setdefault(tuple(sorted(next(boxes) for _ in shape)), []).append(i)
    kept = []
    for those in candidates.values():
        found: dict = {} if len(those) > 1 else {None: those[0]}
        for i in those if not found else ():
            found.setdefault(tuple(sorted(_segments(line, gap) for line in shapes[i])), i)
        kept += found.values()
    return [shapes[i] for i in sorted(kept)], len(shapes) - len(kept)


def _starts(lines):
    return numpy.cumsum([0] + [len(line) for line in lines[:-1]])


def _segments(line, gap):
    """The line's segments, rounded, in any direction and order, as bytes."""
    points = numpy.round(line / gap) + 0.  # no -0
    starts, ends = points[:-1], points[1:]
    isTurned = (starts[:, 0] > ends[:, 0]) | (starts[:, 0] == ends[:, 0]) & (starts[:, 1] > ends[:, 1])
    pairs = numpy.where(isTurned[:, None], numpy.hstack([ends, starts]), numpy.hstack([starts, ends]))
    return pairs[numpy.lexsort(pairs.T)].tobytes()


def joined(lines: Sequence[numpy.ndarray], gap: float) -> list[numpy.ndarray]:
    """[(n, 2)] closed loops, without the first point repeated at the end, from lines whose ends
    meet.

    gap  distance below which successive points of a line, and ends of lines, coincide. ValueError,
    with the position, for an end without partner or more than two ends that meet.
    """
    loops, chains = [], []
    for line in lines:
        line = withoutDoubles(line, gap)
        if len(line) < 2:
            continue
        isLoop = len(line) > 3 and math.dist(line[0], line[-1]) <= gap
        (loops if isLoop else chains).append(line)
    partner = _partners(chains, gap)
    known: set[int] = set()
    for first in range(len(chains)):
        if first not in known:
            loops.append(_walk(chains, partner, first, known))
    return [line[:-1] for line in loops]


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


def _partners(chains, gap):
    """{(chain, 0 or -1): (chain, 0 or -1)}: pairs of ends that meet."""
    ends = [(i, side) for i in range(len(chains)) for side in (0, -1)]
    if not ends:
        return {}
    places = numpy.array([chains[i][side] for i, side in ends])
    found = {}
    tree = needed('scipy.spatial', 'python3-scipy', _WORKS).cKDTree(places)
    for number, near in enumerate(tree.query_ball_point(places, gap)):
        if len(near) != 2:
            words = 'ends at %s where no other one begins' if len(near) == 1 else \
                'ends at %s together with more than one other'
            raise ValueError('a line %s: an outline is closed.' % (words % shown(tuple(places[number].tolist()))))
        found[ends[number]] = ends[sum(near) - number]
    return found


def _walk(chains, partner, first, known):
    """One loop, from the chain `first` on, whose chains become `known`; its first point is repeated at its end."""
    end, parts = (first, 0), []
    while end[0] not in known:
        chain, side = end
        known.add(chain)
        parts.append((chains[chain] if side == 0 else chains[chain][::-1])[:-1])
        end = partner[chain, -1 - side]
    return numpy.concatenate(parts + [parts[0][:1]])


def area(loop: numpy.ndarray) -> float:
    """Signed area, positive for counter-clockwise loops."""
    return float(areas([loop])[0])


def areas(loops: Sequence[numpy.ndarray]) -> numpy.ndarray:
    """Signed areas of a list of loops (n, 2)."""
    if not loops:
        return numpy.zeros(0)
    starts, lengths = _starts(loops), [len(loop) for loop in loops]
    points = numpy.concatenate(loops)
    points = points - numpy.repeat(points[starts], lengths, axis=0)
    after = numpy.arange(1, len(points) + 1)
    after[numpy.append(starts[1:], len(points)) - 1] = starts
    (x, y), (nextX, nextY) = points.T, points[after].T
    return numpy.add.reduceat(x * nextY - y * nextX, starts) / 2


def extents(loops: Sequence[numpy.ndarray]) -> numpy.ndarray:
    """The longer side of the box around each of a list of loops."""
    if not loops:
        return numpy.zeros(0)
    low, high = _boxes(loops)
    return (high - low).max(axis=1)


def _boxes(lines):
    points, starts = numpy.concatenate(lines), _starts(lines)
    return numpy.minimum.reduceat(points, starts), numpy.maximum.reduceat(points, starts)


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
    signed = iter(areas([loop for outline, holes in regions for loop in (outline, *holes)]) >= 0)
    regions = [(_turned(outline, next(signed)), [_turned(hole, next(signed)) for hole in holes])
               for outline, holes in regions]
    inside = around(regions)
    if any(len(those) % 2 and regions[i][1] for i, those in enumerate(inside)):
        return nested([one for i, region in enumerate(regions) for one in _parts(*region, len(inside[i]) % 2)], file)
    sizes = areas([outline for outline, _ in regions])
    shapes = {i: (regions[i][0], list(regions[i][1])) for i, those in enumerate(inside) if len(those) % 2 == 0}
    for i, those in enumerate(inside):
        if i not in shapes:
            outer = min(those, key=lambda o: sizes[o])
            if outer not in shapes:
                raise ValueError('%s: an outline crosses another one near (%g, %g): draw one outline around '
                                 'both, or put them on different layers or into different files.' %
                                 (shownPath(file), *regions[i][0][0]))
            shapes[outer][1].append(regions[i][0])
    return list(shapes.values())


def _turned(loop, isRight):
    return loop if isRight else loop[::-1]


def _parts(outline, holes, isSplit):
    """The region itself, or its outline and its holes as regions without holes."""
    return [(loop, []) for loop in (outline, *holes)] if isSplit else [(outline, holes)]


def around(regions: list[Region]) -> list[list[int]]:
    """For each region, whose loops are counter-clockwise, the numbers of those that contain it."""
    polygon, prep = shapely('geometry', _WORKS).Polygon, shapely('prepared', _WORKS).prep
    sizes = areas([outline for outline, _ in regions])
    solids = [polygon(outline, holes) for outline, holes in regions]
    near, prepared = treeOf(solids, 'query', _WORKS), list(map(prep, solids))
    places = [polygon(outline).representative_point() for outline, _ in regions]
    return [sorted(k for k in near(place) if sizes[k] > sizes[i] and prepared[k].contains(place))
            for i, place in enumerate(places)]
