"""Joins lines to loops; lines that are drawn twice; regions within regions: outlines with holes.

A region is (outline, [holes]) of arrays (n, 2). Points inside an odd number of regions are inside.
"""

import math
from collections.abc import Sequence

import numpy

from yadefrag.arguments import shown, shownPath

Region = tuple[numpy.ndarray, list[numpy.ndarray]]
_CHUNK = 2 * 10**6  # pairs of an edge and a place per block


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
    left = set(range(len(chains)))
    while left:
        loops.append(_walk(chains, partner, left))
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
    cells = {}
    for end in ends:
        cells.setdefault(_cell(chains, end, gap), []).append(end)
    found = {}
    for end in ends:
        x, y = _cell(chains, end, gap)
        place = chains[end[0]][end[1]]
        near = [other for i in (-1, 0, 1) for j in (-1, 0, 1)
                for other in cells.get((x + i, y + j), ())
                if other != end and math.dist(place, chains[other[0]][other[1]]) <= gap]
        if len(near) != 1:
            words = 'ends at %s where no other one begins' if not near else \
                'ends at %s together with more than one other'
            raise ValueError('a line %s: an outline is closed.' % (words % shown(tuple(place))))
        found[end] = near[0]
    return found


def _cell(chains, end, gap):
    x, y = chains[end[0]][end[1]]
    return math.floor(x / gap), math.floor(y / gap)


def _walk(chains, partner, left):
    """One loop of the chains in `left`, which are removed from it; its first point is repeated at its end."""
    first = end = (min(left), 0)
    parts = []
    while True:
        chain, side = end
        left.remove(chain)
        line = chains[chain]
        parts.append((line if side == 0 else line[::-1])[:-1])
        end = partner[chain, -1 - side]
        if end == first:
            break
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
    loops, owners, isHole = [], [], []
    for i, (outline, holes) in enumerate(regions):
        loops += [outline, *holes]
        owners += [i] * (1 + len(holes))
        isHole += [False] + [True] * len(holes)
    sizes = areas([outline for outline, _ in regions])
    inner, loop = _containing(numpy.array([_inside(outline) for outline, _ in regions]), loops)
    outer = numpy.array(owners)[loop]
    isHole = numpy.array(isHole)[loop]
    inHole = set(zip(inner[isHole].tolist(), outer[isHole].tolist()))
    isWithin = ~isHole & (sizes[outer] > sizes[inner])
    found = [[] for _ in regions]
    for pair in zip(inner[isWithin].tolist(), outer[isWithin].tolist()):
        if pair not in inHole:
            found[pair[0]].append(pair[1])
    return found


def _containing(places, loops):
    """(numbers of places, numbers of loops): all pairs of a place inside a loop.

    The edges of all loops meet the places on their heights: a place with an odd number of a loop's
    edges to its right is inside.
    """
    starts = numpy.concatenate(loops)
    ends = numpy.concatenate([part for loop in loops for part in (loop[1:], loop[:1])])
    owner = numpy.repeat(numpy.arange(len(loops)), [len(loop) for loop in loops])
    left = numpy.array([loop[:, 0].min() for loop in loops])[owner]
    order = numpy.argsort(places[:, 1], kind='stable')
    heights = places[order, 1]
    first = numpy.searchsorted(heights, numpy.minimum(starts[:, 1], ends[:, 1]))
    count = numpy.searchsorted(heights, numpy.maximum(starts[:, 1], ends[:, 1])) - first
    before = numpy.concatenate([[0], numpy.cumsum(count)])
    crossed = []
    for low in range(0, int(before[-1]), _CHUNK):
        pairs = numpy.arange(low, min(low + _CHUNK, int(before[-1])))
        edge = numpy.searchsorted(before, pairs, side='right') - 1
        place = order[first[edge] + pairs - before[edge]]
        x, y = places[place].T
        a, b = starts[edge], ends[edge]
        isRight = (x >= left[edge]) & \
            (a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1]) > x)
        crossed.append(place[isRight] * len(loops) + owner[edge[isRight]])
    crossed, times = numpy.unique(numpy.concatenate(crossed or [order[:0]]), return_counts=True)
    return numpy.divmod(crossed[times % 2 == 1], len(loops))


def _inside(loop):
    """A point inside a loop: the middle of the first widest interval on a horizontal line."""
    points = loop.tolist()
    heights = sorted({y for _, y in points})
    if len(heights) < 2:
        return points[0]
    step, low = max((above - y, -y) for y, above in zip(heights, heights[1:]))
    y = step / 2 - low
    x = sorted(a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
               for a, b in zip(points, points[1:] + points[:1]) if (a[1] > y) != (b[1] > y))
    width, left = max((right - one, -one) for one, right in zip(x[::2], x[1::2]))
    return width / 2 - left, y
