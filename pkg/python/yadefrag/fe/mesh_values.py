"""Arguments of addPolygon and addMesh as arrays by triangle, joint or node."""

import math
from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag.arguments import array, atPlaces, number, pair, plain, real, refuse, shown
from yadefrag.hints import Mesh

_HELD = {False: 0, None: 0, 'x': 1, 'y': 2, 'xy': 3, 'yx': 3, True: 3}
_UNITS = {'strength': 'Pa', 'fractureEnergy': 'J/m²', 'jointStrength': 'Pa', 'jointEnergy': 'J/m²'}


def centroids(mesh: Mesh) -> numpy.ndarray:
    """(m, 2) of the triangles."""
    return mesh.nodes[mesh.triangles].mean(axis=1)


def _real(name, value):
    return number(name, value, lambda v: True, 'a number')


def _ofTriangles(name, value, mesh):
    """(m) floats of the mesh's triangles; a function is evaluated at their centroids; empty for None."""
    if value is None:
        return numpy.empty(0)
    if callable(value):
        return numpy.array(atPlaces(name, value, centroids(mesh), _real))
    values = array(value)
    if values is None or values.ndim != 1 or values.dtype.kind not in 'iuf':
        refuse(name, value, 'None, a function (x, y) that returns a number (%s), or an array of one for each '
               'triangle' % _UNITS[name])
    return values.astype(float)


def _ofJoints(name, value, sides, count):
    """Floats of sides on joints, from a number, or None, or one of these for each of `count` joints; NaN for None.

    sides  number of the joint of each
    """
    if value is None:
        return numpy.full(len(sides), math.nan)
    if real(value) is not None:
        return numpy.full(len(sides), number(name, value, math.isfinite, 'a finite number'))
    if not (isinstance(value, (list, tuple)) or isinstance(value, numpy.ndarray) and value.ndim == 1):
        refuse(name, value, 'a number (%s), None, or one of these for each joint' % _UNITS[name])
    if len(value) != count:
        raise ValueError('%s has %d values, it must have one for each of the %d joints.' % (name, len(value), count))
    values = [math.nan if one is None else number('%s[%d]' % (name, i), one, math.isfinite, 'a finite number, or None')
              for i, one in enumerate(value)]
    return numpy.array(values, dtype=float)[sides]


def brittlePlaces(mesh: Mesh, interfaces: tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray],
                  strength: Any, fractureEnergy: Any, jointStrength: Any, jointEnergy: Any) -> Any:
    """_yadefrag.BrittlePlaces, for FESolver._addMesh. `interfaces`: result of materials.interfaces;
    values of joints have priority."""
    areOwn = mesh._numJoints > 0 and (jointStrength is not None or jointEnergy is not None)
    ofTriangles = [_ofTriangles('strength', strength, mesh), _ofTriangles('fractureEnergy', fractureEnergy, mesh)]
    edges, *values = interfaces
    if areOwn:
        joints = mesh.joints
        edges = numpy.concatenate([edges, joints[:, :2]])
        values = [numpy.concatenate([before, _ofJoints(name, value, joints[:, 2], mesh._numJoints)])
                  for before, name, value in zip(values, ('jointStrength', 'jointEnergy'),
                                                 (jointStrength, jointEnergy))]
    return _yadefrag.brittlePlaces(*ofTriangles, edges, *values)


def stressOfTriangles(stress: Any, mesh: Mesh, flows: bool) -> tuple[numpy.ndarray, numpy.ndarray]:
    """(m, 3) and (m) Pa of the mesh's triangles, xx, yy, xy and zz (nan: not given), from three or four
    numbers, a function (x, y) or an array; both empty for None. flows: zz is (xx + yy)/2 where it is not given."""
    if stress is None:
        return numpy.empty((0, 3)), numpy.empty(0)
    count, values = len(mesh.triangles), array(stress)
    if callable(stress):
        rows = atPlaces('stress', stress, centroids(mesh), _stress)
    elif values is None or values.ndim != 2 or values.dtype.kind not in 'iuf':
        rows = [_stress('stress', stress)] * count
    elif values.shape not in ((count, 3), (count, 4)):
        raise ValueError('stress has the shape %s, it must be (%d, 3) or (%d, 4): three or four numbers for '
                         'each triangle.' % (shown(values.shape), count, count))
    else:
        rows = [_stress('stress[%d]' % i, one) for i, one in enumerate(values)]
    both = numpy.array(rows).reshape(-1, 4)
    if flows:
        both[:, 3] = numpy.where(numpy.isnan(both[:, 3]), both[:, :2].mean(axis=1), both[:, 3])
    return both[:, :3].copy(), both[:, 3].copy() if numpy.isfinite(both[:, 3]).any() else numpy.empty(0)


def _stress(name, value):
    """Four floats, the last nan if it is not given."""
    values = array(value)
    if values is None or values.shape not in ((3,), (4,)) or values.dtype.kind not in 'iuf' \
            or not numpy.isfinite(values).all():
        refuse(name, value, 'three or four finite numbers (Pa): xx, yy, xy, or also zz')
    return numpy.append(values.astype(float), [math.nan] * (4 - len(values)))


def field(name: str, value: Any, nodes: numpy.ndarray, isOptional: bool = True) -> numpy.ndarray:
    """(n, 2) from a pair or a function (x, y) → pair; empty for None."""
    if value is None and isOptional:
        return numpy.empty((0, 2))
    if not callable(value):
        return numpy.tile(pair(name, value), (len(nodes), 1))
    return numpy.array(atPlaces(name, value, nodes, pair))


def heldNodes(fixed: Any, nodes: numpy.ndarray) -> numpy.ndarray:
    """(n) of 0 free, 1 held in x, 2 in y, 3 in both."""
    if fixed is None:
        return numpy.empty(0, dtype=numpy.uint8)
    if not callable(fixed):
        refuse('fixed', fixed, "a function (x, y) that returns False, True, 'x' or 'y'")
    return numpy.array(atPlaces('fixed', fixed, nodes, _held), dtype=numpy.uint8)


def _held(name, value):
    value = plain(value)
    if not isinstance(value, (bool, str, type(None))) or value not in _HELD:
        refuse(name, value, "False, True, 'x' or 'y'")
    return _HELD[value]


def isClockwise(points: numpy.ndarray) -> bool:
    x, y = (points - points[0]).T
    return float((x * numpy.roll(y, -1) - y * numpy.roll(x, -1)).sum()) < 0


def smoothFlags(smooth: Any, count: int) -> bool | numpy.ndarray:
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


def smoothNodes(smooth: bool | numpy.ndarray, mesh: Mesh, outline: Any = ()) -> numpy.ndarray:
    """(n) of 0 or 1: 1 for a node on a smooth part of the boundary; empty if there are none."""
    if isinstance(smooth, bool):
        if not smooth:
            return numpy.empty(0, dtype=numpy.uint8)
        chosen = [(loop, numpy.ones(len(loop), dtype=bool)) for loop in mesh.loops]
    else:
        flags, count = smooth, len(outline)
        if isClockwise(outline):  # the mesh has it reversed, with the same first point
            flags = flags[-numpy.arange(count) % count]
        loop, vertices = mesh.loops[0], mesh._loopVertices[0]
        # A node within an edge is smooth if both ends of the edge are.
        isVertex = vertices != numpy.roll(vertices, 1)
        ends = flags[vertices] & flags[(vertices.astype(int) + 1) % count]
        chosen = [(loop, numpy.where(isVertex, flags[vertices], ends))]
    marks = numpy.zeros(len(mesh.nodes), dtype=numpy.uint8)
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
