"""Regions within regions: outlines with holes.

A region is (outline, [holes]) of arrays (n, 2). Points inside an odd number of regions are inside.
"""

import numpy

from yadefrag.arguments import shownPath
from yadefrag.io.readers.loops import areas

Region = tuple[numpy.ndarray, list[numpy.ndarray]]
_CHUNK = 2 * 10**6  # pairs of an edge and a place per block


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
        return nested([one for i, region in enumerate(regions)
                       for one in _parts(*region, len(inside[i]) % 2)], file)
    sizes = areas([outline for outline, _ in regions])
    shapes = {i: (regions[i][0], list(regions[i][1])) for i, those in enumerate(inside)
              if len(those) % 2 == 0}
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
