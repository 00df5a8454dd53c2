"""Materials of a body's triangles: one, or several by place, and the interfaces between them."""

import math
from typing import Any

import numpy

from yade import wrapper
from yadefrag.arguments import array, atPlaces, isWhole, number, plain, real, refuse, shown
from yadefrag.fe.mesh_values import centroids
from yadefrag.hints import FEMat, Mesh

_RIGHT = 'an FEMat, its label or its number in O.materials'
_SEVERAL = _RIGHT + ('; or a function (x, y) that returns one, a list of one for each triangle, or '
                     'a pair of a list of materials and an array of their numbers in it, one for '
                     'each triangle')
_INTERFACE = {'interfaceStrength': 'Pa', 'interfaceEnergy': 'J/m²'}


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
    right = '0 or a positive number (%s)' % _INTERFACE[name]
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
               'with one by pair of materials' % _INTERFACE[name])
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
    given = [name for name, value in zip(_INTERFACE, (strength, energy)) if value is not None]
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
