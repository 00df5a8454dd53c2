"""Meshing options of addPolygon: kind of mesh, seed, size of the triangles by place."""

import math

import numpy

from yade import wrapper
from yadefrag import _yadefrag
from yadefrag.arguments import number, pair, positive, refuse, requireTakes, whole
from yadefrag.fe.materials import isField

_LEAST_SAMPLES, _MOST_SAMPLES = 128, 1024  # of a size function, along the outline's longer side


def _sampledSize(function, points):
    """(left, bottom, cell, columns, values): the size at the points of a square grid."""
    low, high = points.min(axis=0), points.max(axis=0)
    samples = _LEAST_SAMPLES
    while True:
        cell = float((high - low).max()) / samples
        columns, rows = (max(2, int(math.ceil(side / cell - 1e-9)) + 1) for side in high - low)
        places = [(float(low[0] + i * cell), float(low[1] + j * cell)) for j in range(rows)
                  for i in range(columns)]
        values = numpy.array([positive('size(%g, %g)' % (x, y), function(x, y), 'm')
                              for x, y in places])
        if values.min() >= cell or samples >= _MOST_SAMPLES:
            return float(low[0]), float(low[1]), cell, columns, values.tobytes()
        samples *= 2


def simplified(points, holes, tolerance, flags):
    """Outline, holes and the outline's flags (None or an array) without the points that a
    simplification within `tolerance` (m) removes: addPolygon's `simplify`."""
    tolerance = positive('simplify', tolerance, 'm')
    pinned = numpy.zeros(0, dtype=bool)
    if flags is not None:  # a straight corner in a smooth part is intentional
        pinned = ~flags & (numpy.roll(flags, 1) | numpy.roll(flags, -1))
    kept = _yadefrag.keptVertices(points.tobytes(), [h.tobytes() for h in holes], tolerance,
                                  pinned.astype(numpy.uint8).tobytes())
    return (points[kept[0]], [hole[stay] for hole, stay in zip(holes, kept[1:])],
            None if flags is None else flags[kept[0]])


def isIrregular(mesh, material):
    """True for an irregular mesh, by the argument `mesh`; None: irregular for a body that can
    crack, or whose materials are known only after meshing."""
    if mesh is None:
        return isField(material) or isinstance(material, wrapper.BrittleFEMat)
    if not isinstance(mesh, str) or mesh not in ('regular', 'irregular'):
        refuse('mesh', mesh, "'regular', 'irregular' or None")
    return mesh == 'irregular'


def jointLines(joints):
    """(k, 4) floats, the ends of each joint: addPolygon's `joints`."""
    lines = _listOf(joints)
    if lines is None:
        refuse('joints', joints, 'a list of pairs of points ((x, y), (x, y)) in m')
    ends = numpy.zeros((len(lines), 4))
    for i, line in enumerate(lines):
        both = _listOf(line)
        if both is None or len(both) != 2:
            refuse('joints[%d]' % i, line, 'a pair of points ((x, y), (x, y)) in m')
        ends[i] = [*pair('joints[%d][0]' % i, both[0]), *pair('joints[%d][1]' % i, both[1])]
    return ends


def _listOf(value):
    """A list; None for other types, and for unordered ones."""
    try:
        return None if isinstance(value, (str, bytes, dict, set)) else list(value)
    except TypeError:
        return None


def sizeOf(size, points):
    """addPolygon's `size`, as _yadefrag.meshOfPolygon takes it: (m,), or a sampled function."""
    if callable(size):
        requireTakes('size', size, 'x', 'y')
        return _sampledSize(size, points)
    return (number('size', size, lambda v: math.isfinite(v) and v > 0,
                   'a positive number (m) or a function (x, y) that returns one'),)


def leastSize(wanted):
    """(m) The smallest size of a result of sizeOf."""
    return wanted[0] if len(wanted) == 1 else float(numpy.frombuffer(wanted[4]).min())


def meshOfPolygon(points, holes, wanted, irregular, seed, joints, jointTolerance):
    """The dict of arrays that _add takes, with `loopVertices`, `joints`, and `joined`, the number of
    joined places of joints and their largest displacement (m); `wanted`: sizeOf."""
    seed = whole('meshSeed', seed, least=0, right='a whole number, 0 or more', most=2**63 - 1)
    return _yadefrag.meshOfPolygon(points.tobytes(), [h.tobytes() for h in holes], wanted,
                                   irregular, seed, joints.tobytes(), jointTolerance)
