"""Arguments of addPolygon and addTriangles as arrays by node."""

import numpy

from yadefrag.snapping import isClockwise
from yadefrag.values import pair, plain, refuse, requireTakes

_HELD = {False: 0, None: 0, 'x': 1, 'y': 2, 'xy': 3, 'yx': 3, True: 3}


def field(name, value, nodes, isOptional=True):
    """(n, 2) from a pair or a function (x, y) → pair; empty for None."""
    if value is None and isOptional:
        return numpy.empty((0, 2))
    if not callable(value):
        return numpy.tile(pair(name, value), (len(nodes), 1))
    requireTakes(name, value, 'x', 'y')
    return numpy.array([pair('%s(%g, %g)' % (name, x, y), value(x, y)) for x, y in nodes])


def heldNodes(fixed, nodes):
    """(n) of 0 free, 1 held in x, 2 in y, 3 in both."""
    if fixed is None:
        return numpy.empty(0, dtype=numpy.uint8)
    if not callable(fixed):
        refuse('fixed', fixed, "a function (x, y) that returns False, True, 'x' or 'y'")
    requireTakes('fixed', fixed, 'x', 'y')
    held = numpy.zeros(len(nodes), dtype=numpy.uint8)
    for i, (x, y) in enumerate(nodes):
        value = plain(fixed(x, y))
        if not isinstance(value, (bool, str, type(None))) or value not in _HELD:
            refuse('fixed(%g, %g)' % (x, y), value, "False, True, 'x' or 'y'")
        held[i] = _HELD[value]
    return held


def smoothFlags(smooth, count):
    """True, False, or an array with a flag for each of the outline's `count` points."""
    smooth = plain(smooth)
    if isinstance(smooth, bool):
        return smooth
    flags = _flags(smooth)
    if flags is None:
        refuse('smooth', smooth, 'True, False or a flag for each point of the outline')
    if len(flags) != count:
        raise ValueError('smooth has %d flags, it must have one for each of the %d points of '
                         'the outline.' % (len(flags), count))
    return flags


def smoothNodes(smooth, mesh, outline=()):
    """(n) of 0 or 1: 1 for a node on a smooth part of the boundary; empty if there are none."""
    if isinstance(smooth, bool):
        if not smooth:
            return numpy.empty(0, dtype=numpy.uint8)
        chosen = [(loop, numpy.ones(len(loop), dtype=bool)) for loop in mesh['loops']]
    else:
        flags, count = smooth, len(outline)
        if isClockwise(outline):  # the mesh has it reversed, with the same first point
            flags = flags[-numpy.arange(count) % count]
        loop, vertices = mesh['loops'][0], mesh['loopVertices'][0]
        # A node within an edge is smooth if both ends of the edge are.
        isVertex = vertices != numpy.roll(vertices, 1)
        ends = flags[vertices] & flags[(vertices.astype(int) + 1) % count]
        chosen = [(loop, numpy.where(isVertex, flags[vertices], ends))]
    marks = numpy.zeros(len(mesh['nodes']), dtype=numpy.uint8)
    for loop, flags in chosen:
        marks[loop] = flags
    return marks


def _flags(values):
    """(n) of bool; None if it is not a list of True and False, or of 1 and 0."""
    try:
        flags = [plain(value) for value in values]
    except TypeError:
        return None
    isRight = all(isinstance(f, int) and f in (0, 1) for f in flags)
    return numpy.array(flags, dtype=bool) if isRight else None
