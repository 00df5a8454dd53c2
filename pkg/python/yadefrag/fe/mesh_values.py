"""Arguments of addPolygon and addMesh as arrays by triangle, joint or node; materials, and the interfaces between
them."""

import math
from typing import Any

import numpy

from yade import wrapper
from yadefrag import _yadefrag
from yadefrag.arguments import FEMat, Mesh, anyNumber, array, atPlaces, isWhole, number, pair, plain, real, refuse, shown

_HELD = {False: 0, None: 0, 'x': 1, 'y': 2, 'xy': 3, 'yx': 3, True: 3}
_UNITS = {'strength': 'Pa', 'fractureEnergy': 'J/m²', 'jointStrength': 'Pa', 'jointEnergy': 'J/m²',
          'interfaceStrength': 'Pa', 'interfaceEnergy': 'J/m²'}
_RIGHT = 'an FEMat, its label or its number in O.materials'
_SEVERAL = _RIGHT + ('; or a function (x, y) that returns one, a list of one for each triangle, or '
                     'a pair of a list of materials and an array of their numbers in it, one for each triangle')


def centroids(mesh: Mesh) -> numpy.ndarray:
    """(m, 2) of the triangles."""
    return mesh.nodes[mesh.triangles].mean(axis=1)


def _ofTriangles(name, value, mesh):
    """(m) floats of the mesh's triangles; a function is evaluated at their centroids; empty for None."""
    if value is None:
        return numpy.empty(0)
    if callable(value):
        return numpy.array(atPlaces(name, value, centroids(mesh), lambda at, one: anyNumber(at, one, _UNITS[name])))
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
    try:
        flags = [plain(value) for value in smooth]
    except TypeError:
        flags = [None]
    if not all(isinstance(one, int) and one in (0, 1) for one in flags):
        refuse('smooth', smooth, 'True, False or a flag for each point of the outline')
    if len(flags) != count:
        raise ValueError('smooth has %d flags, it must have one for each of the %d points of '
                         'the outline.' % (len(flags), count))
    return numpy.array(flags, dtype=bool)


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


def oneMaterial(material: Any, name: str = 'material', right: str = _RIGHT) -> FEMat:
    """The FEMat that `material` refers to: the object, its label or its number in O.materials."""
    found = plain(material)
    if isinstance(found, str) or isWhole(found):
        try:
            found = wrapper.Omega().materials[found]
        except (KeyError, IndexError, RuntimeError, OverflowError, UnicodeError):
            raise ValueError('%s is %s, which is not in O.materials.' % (name, shown(material))) from None
    if not isinstance(found, wrapper.FEMat):
        refuse(name, material, right)
    return found


def isField(material: object) -> bool:
    """True if it is given by place: a function, or a list."""
    if isinstance(material, type) or isinstance(material, (str, bytes, dict, set)):
        return False
    return callable(material) or isinstance(material, (list, tuple)) \
        or isinstance(material, numpy.ndarray) and material.ndim > 0


def mayCrack(material: object) -> bool:
    """True for a material whose edges may open: a brittle one, or one that yields and fails."""
    if isinstance(material, wrapper.BrittleFEMat):
        return True
    if isinstance(material, wrapper.FrictionalFEMat):
        return material.failureStrain < math.inf or material.fractureEnergy > 0
    return isinstance(material, wrapper.PlasticFEMat) and (
        min(material.failureStrain, material.spallStress) < math.inf
        or material.failureD1 != 0 or material.failureD2 != 0)


class Materials:
    """Materials of a body: `of`, the FEMats in the order of their first triangles, and `numbers`,
    (m) the index of each triangle's material in it; empty for a body of one material."""

    def __init__(self, mesh: Mesh, material: Any) -> None:
        self.of, self._places = [], {}
        self.numbers = numpy.empty(0, dtype=numpy.uint32)
        if not isField(material):
            self._number(material, 'material', _SEVERAL)
            return
        numbers = numpy.array(self._ofTriangles(mesh, material), dtype=numpy.uint32)
        if len(self.of) > 1:
            self.numbers = numbers

    @property
    def crack(self) -> bool:
        """True if any of them can crack."""
        return any(isinstance(one, wrapper.BrittleFEMat) for one in self.of)

    @property
    def fails(self) -> bool:
        """True if the body has one material, which yields and fails."""
        return self.yields and mayCrack(self.of[0])

    @property
    def yields(self) -> bool:
        """True if the body has one material, which yields."""
        return len(self.of) == 1 and isinstance(self.of[0], (wrapper.PlasticFEMat, wrapper.FrictionalFEMat))

    def find(self, material: Any, name: str) -> int | None:
        """Its number; None if no triangle has it."""
        return self._places.get(_key(oneMaterial(material, name)))

    def _number(self, material, name, right=_RIGHT):
        found = oneMaterial(material, name, right)
        key = _key(found)
        if key not in self._places:
            self._places[key] = len(self.of)
            self.of.append(found)
        return self._places[key]

    def _ofTriangles(self, mesh, material):
        count = len(mesh.triangles)
        if callable(material):
            return atPlaces('material', material, centroids(mesh), lambda at, one: self._number(one, at))
        values = list(material)
        if len(values) == 2 and isinstance(values[0], (list, tuple)):
            listed, chosen = list(values[0]), array(values[1])
            if chosen is None or chosen.ndim != 1 or chosen.dtype.kind not in 'iu' \
                    or not listed or chosen.size and not 0 <= chosen.min() <= chosen.max() < \
                    len(listed):
                raise ValueError('material[1] must be an array of whole numbers from 0 to %d, one '
                                 'for each triangle.' % (len(listed) - 1))
            values = [listed[i] for i in chosen]
        if len(values) != count:
            raise ValueError('material has %d values, it must have one for each of the %d '
                             'triangles.' % (len(values), count))
        return [self._number(one, 'material[%d]' % i) for i, one in enumerate(values)]


def _key(material):
    """Equal keys for the same material: objects from O.materials are created anew at each access."""
    return ('number', material.id) if material.id >= 0 else ('object', id(material))


def sidesBetween(triangles: numpy.ndarray, numbers: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """(k, 2) nodes of the sides between triangles with different numbers, and (k, 2) these numbers."""
    sides = numpy.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    sides = numpy.sort(sides.astype(numpy.int64), axis=1)
    owner = numpy.tile(numbers, 3)
    order = numpy.lexsort((sides[:, 1], sides[:, 0]))
    sides, owner = sides[order], owner[order]
    inner = numpy.nonzero((sides[1:] == sides[:-1]).all(axis=1) & (owner[1:] != owner[:-1]))[0]
    return sides[inner], numpy.stack([owner[inner], owner[inner + 1]], axis=1)


def _isValue(value):
    return math.isfinite(value) and value >= 0


def _values(name, value, mesh, sides, both, materials):
    """(k) floats for the sides; NaN where the materials determine the value."""
    right = '0 or a positive number (%s)' % _UNITS[name]
    if value is None:
        return numpy.full(len(sides), math.nan)
    if real(value) is not None:
        return numpy.full(len(sides), number(name, value, _isValue, right))

    def checked(at, one):
        return math.nan if one is None else number(at, one, _isValue, right + ', or None')

    if callable(value):
        return numpy.array(atPlaces(name, value, mesh.nodes[sides].mean(axis=1), checked), dtype=float)
    if not isinstance(value, dict):
        refuse(name, value, 'None, a number (%s), a function (x, y) that returns one, or a dict '
               'with one by pair of materials' % _UNITS[name])
    result = numpy.full(len(sides), math.nan)
    for key, one in value.items():
        if not isinstance(key, tuple) or len(key) != 2:
            refuse("a key of %s" % name, key, 'a pair of materials')
        a, b = (materials.find(m, 'a material in %s' % name) for m in key)
        chosen = checked('%s[%s]' % (name, shown(key)), one)
        result[((both == (a, b)) | (both == (b, a))).all(axis=1)] = chosen
    return result


def interfaces(mesh: Mesh, materials: Materials, strength: Any,
               energy: Any) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """(k, 2) nodes of the sides with an individual strength (Pa) or energy (J/m²), and (k) of both,
    NaN where the materials determine the value: addPolygon's interfaceStrength and -Energy."""
    nothing = numpy.empty((0, 2), dtype=numpy.uint32), numpy.empty(0), numpy.empty(0)
    given = [name for name, value in zip(('interfaceStrength', 'interfaceEnergy'), (strength, energy)) if value is not None]
    if not given:
        return nothing
    if not len(materials.numbers):
        raise ValueError('%s is given, but the body has one material; it must have several.' % given[0])
    if strength is None and not materials.crack:
        raise ValueError('interfaceEnergy is given, but no material can crack; it needs an '
                         'interfaceStrength or a BrittleFEMat.')
    sides, both = sidesBetween(mesh.triangles, materials.numbers)
    strengths = _values('interfaceStrength', strength, mesh, sides, both, materials)
    energies = _values('interfaceEnergy', energy, mesh, sides, both, materials)
    own = ~(numpy.isnan(strengths) & numpy.isnan(energies))
    return sides[own].astype(numpy.uint32), strengths[own], energies[own]
