"""Values by place from a script: functions of (x, y), or arrays by triangle."""

import math

import numpy

from yadefrag.values import array, number, real, refuse, requireTakes, shown

# name: (unit, function that checks a value, description of valid values)
_BRITTLE = {
    'strength': ('Pa', lambda v: math.isfinite(v) and v > 0, 'a positive number (Pa)'),
    'fractureEnergy': ('J/m²', lambda v: math.isfinite(v) and v >= 0,
                       '0 or a positive number (J/m²)'),
    'jointStrength': ('Pa', lambda v: math.isfinite(v) and v >= 0, '0 or a positive number (Pa)'),
    'jointEnergy': ('J/m²', lambda v: math.isfinite(v) and v >= 0,
                    '0 or a positive number (J/m²)'),
}


def _ofTriangles(name, value, mesh):
    """(m) floats of the mesh's triangles; a function is evaluated at their centroids; empty for
    None."""
    if value is None:
        return numpy.empty(0)
    unit, isRight, right = _BRITTLE[name]
    nodes, triangles = mesh['nodes'], mesh['triangles']
    if callable(value):
        requireTakes(name, value, 'x', 'y')
        return numpy.array([number('%s(%g, %g)' % (name, x, y), value(x, y), isRight, right)
                            for x, y in nodes[triangles].mean(axis=1)])
    values = array(value)
    if values is None or values.ndim != 1 or values.dtype.kind not in 'iuf':
        refuse(name, value, 'None, a function (x, y) that returns %s, or an array of one for each '
               'triangle' % unit)
    if len(values) != len(triangles):
        raise ValueError('%s has %d values, it must have one for each of the %d triangles.' %
                         (name, len(values), len(triangles)))
    values = values.astype(float)
    for i, one in enumerate(values):
        if not isRight(one):
            raise ValueError('%s[%d] is %s, it must be %s.' % (name, i, shown(float(one)), right))
    return values


def _ofJoints(name, value, mesh, count):
    """Floats of the mesh's sides on joints, from a number or one for each of `count` joints."""
    unit, isRight, right = _BRITTLE[name]
    sides = mesh['joints'][:, 2]
    if real(value) is not None:
        return numpy.full(len(sides), number(name, value, isRight, right))
    values = array(value)
    if values is None or values.ndim != 1 or values.dtype.kind not in 'iuf':
        refuse(name, value, 'a number (%s), or one for each joint' % unit)
    if len(values) != count:
        raise ValueError('%s has %d values, it must have one for each of the %d joints.' %
                         (name, len(values), count))
    for i, one in enumerate(values):
        number('%s[%d]' % (name, i), one, isRight, right)
    return values.astype(float)[sides]


def brittlePlaces(mesh, materials, interfaces, strength, fractureEnergy, joints=(),
                  jointStrength=None, jointEnergy=None):
    """{name: (array, dtype)} for FESolver._addMesh. `interfaces`: result of materials.interfaces;
    values of joints have priority. ValueError for a material that does not crack, and for invalid
    values."""
    areOwn = len(joints) and (jointStrength is not None or jointEnergy is not None)
    given = dict(strength=strength, fractureEnergy=fractureEnergy,
                 joints=joints if areOwn else None)
    for name, value in given.items():
        if value is not None and not materials.crack:
            raise ValueError('%s is given, but the material does not crack; it must be a '
                             'BrittleFEMat.' % name)
    places = {name: (_ofTriangles(name, given[name], mesh), 'float64')
              for name in ('strength', 'fractureEnergy')}
    edges, strengths, energies = interfaces
    if areOwn:
        own = [numpy.full(len(mesh['joints']), math.nan) if value is None else
               _ofJoints(name, value, mesh, len(joints))
               for name, value in (('jointStrength', jointStrength), ('jointEnergy', jointEnergy))]
        edges = numpy.concatenate([edges, mesh['joints'][:, :2]])
        strengths = numpy.concatenate([strengths, own[0]])
        energies = numpy.concatenate([energies, own[1]])
    places.update(jointEdges=(edges, 'uint32'), jointStrength=(strengths, 'float64'),
                  jointEnergy=(energies, 'float64'))
    return places


def stressOfTriangles(stress, mesh):
    """(m, 3) Pa of the mesh's triangles, from a triple, a function (x, y) or an array; empty for
    None."""
    nodes, triangles = mesh['nodes'], mesh['triangles']
    if stress is None:
        return numpy.empty((0, 3))
    if callable(stress):
        requireTakes('stress', stress, 'x', 'y')
        return numpy.array([_triple('stress(%g, %g)' % (x, y), stress(x, y))
                            for x, y in nodes[triangles].mean(axis=1)])
    values = array(stress)
    if values is None or values.ndim != 2 or values.dtype.kind not in 'iuf':
        return numpy.tile(_triple('stress', stress), (len(triangles), 1))
    if values.shape != (len(triangles), 3):
        raise ValueError('stress has the shape %s, it must be (%d, 3): one triple for each '
                         'triangle.' % (shown(values.shape), len(triangles)))
    for i, one in enumerate(values):
        _triple('stress[%d]' % i, one)
    return values.astype(float)


def _triple(name, value):
    """Three finite floats."""
    values = array(value)
    if values is None or values.shape != (3,) or values.dtype.kind not in 'iuf' \
            or not numpy.isfinite(values).all():
        refuse(name, value, 'three finite numbers (Pa): xx, yy, xy')
    return values.astype(float)
