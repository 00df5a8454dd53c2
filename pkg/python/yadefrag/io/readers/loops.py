"""Joins lines to loops; lines that are drawn twice."""

import math
from collections.abc import Sequence

import numpy

from yadefrag.arguments import shown


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
