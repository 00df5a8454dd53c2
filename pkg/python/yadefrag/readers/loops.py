"""Joins lines to loops, and loops to outlines with holes."""

import math

import numpy

from yadefrag.values import shown


def joined(lines, gap):
    """[(n, 2)] closed loops, without the first point repeated at the end, from lines whose ends
    meet.

    gap  distance below which successive points of a line, and ends of lines, coincide. ValueError,
    with the position, for an end without partner or more than two ends that meet.
    """
    loops, chains = [], []
    for line in lines:
        line = _withoutDoubles(line, gap)
        if len(line) < 2:
            continue
        isLoop = len(line) > 3 and math.dist(line[0], line[-1]) <= gap
        (loops if isLoop else chains).append(line)
    partner = _partners(chains, gap)
    left = set(range(len(chains)))
    while left:
        loops.append(_walk(chains, partner, left))
    return [line[:-1] for line in loops]


def _withoutDoubles(line, gap):
    """The line without points within `gap` of the previous one; its last point is kept."""
    kept = [0]
    for i in range(1, len(line)):
        if math.dist(line[i], line[kept[-1]]) > gap:
            kept.append(i)
    if len(kept) > 1:
        kept[-1] = len(line) - 1
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
    """One loop of the chains in `left`, which are removed from it; its first point is repeated at
    its end."""
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


def area(loop):
    """Signed area, positive for counter-clockwise loops."""
    x, y = (loop - loop[0]).T
    return float(x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1)) / 2


def nested(loops):
    """[(outline, [holes])], all counter-clockwise: points inside an odd number of loops are inside.

    In the order of those loops that are outlines.
    """
    loops = [loop if area(loop) >= 0 else loop[::-1] for loop in loops]
    areas = [area(loop) for loop in loops]
    places = [_inside(loop) for loop in loops]
    boxes = [(loop.min(axis=0), loop.max(axis=0)) for loop in loops]

    def holds(outer, inner):
        low, high = boxes[outer]
        return areas[outer] > areas[inner] and (low <= places[inner]).all() and \
            (places[inner] <= high).all() and _isIn(places[inner], loops[outer])

    around = [[o for o in range(len(loops)) if holds(o, i)] for i in range(len(loops))]
    holes = {i: [] for i, those in enumerate(around) if len(those) % 2 == 0}
    for i, those in enumerate(around):
        if i not in holes:
            holes[min(those, key=lambda o: areas[o])].append(loops[i])
    return [(loops[i], those) for i, those in holes.items()]


def _inside(loop):
    """A point inside a loop: the middle of the first widest interval on a horizontal line."""
    heights = numpy.unique(loop[:, 1])
    steps = numpy.diff(heights)
    if not len(steps):
        return loop[0]
    widest = int(steps.argmax())
    y = (heights[widest] + heights[widest + 1]) / 2
    x = numpy.sort(_crossings(loop, y))
    gaps = numpy.diff(x)[::2]
    best = 2 * int(gaps.argmax())
    return numpy.array([(x[best] + x[best + 1]) / 2, y])


def _crossings(loop, y):
    """x of the points where the loop crosses the height y."""
    after = numpy.roll(loop, -1, axis=0)
    crosses = (loop[:, 1] > y) != (after[:, 1] > y)
    a, b = loop[crosses], after[crosses]
    return a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])


def _isIn(place, loop):
    return int((_crossings(loop, place[1]) > place[0]).sum()) % 2 == 1
