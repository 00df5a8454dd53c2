"""Fields of plotMesh by name: values of triangles or nodes."""

from typing import Any

import numpy

from yadefrag.arguments import refuse, shown
from yadefrag.hints import FESolver

UNITS = {'xx': 'stress xx (Pa)', 'yy': 'stress yy (Pa)', 'xy': 'stress xy (Pa)',
         'mises': 'von Mises stress (Pa)', 'sigma1': 'larger principal stress (Pa)',
         'sigma2': 'smaller principal stress (Pa)', 'speed': 'speed (m/s)',
         'displacement': 'displacement (m)', 'plasticStrain': 'plastic strain', 'temperature': 'temperature (K)',
         'damage': 'damage',
         'component': 'component', 'fragment': 'fragment'}
_OTHER_NAMES = {'principal1': 'sigma1', 'principal2': 'sigma2'}


def nameOf(field: Any) -> Any:
    """The name in UNITS of a field with several names; other values unchanged."""
    return _OTHER_NAMES.get(field, field) if isinstance(field, str) else field


def fieldValues(fe: FESolver, field: Any) -> tuple[numpy.ndarray, bool] | tuple[None, None]:
    """(values, True for one per node) of a field except 'fragment', both None for no field."""
    if field is None:
        return None, None
    if isinstance(field, str):
        if field in ('speed', 'displacement'):
            vectors = fe.velocities if field == 'speed' else fe.displacements
            return numpy.linalg.norm(numpy.asarray(vectors, dtype=float), axis=1), True
        if field == 'component':
            return numpy.asarray(fe.components, dtype=float), False
        if field in ('plasticStrain', 'temperature', 'damage'):
            return getattr(fe, field), False
        if field in UNITS:
            return _stress(fe, field), False
        refuse('field', field, 'one of %s, an array or None' % ', '.join(map(repr, [*UNITS, *_OTHER_NAMES])))
    try:
        values = numpy.asarray(field, dtype=float)
    except (TypeError, ValueError, OverflowError):
        refuse('field', field, 'a name, an array or None')
    nodes, triangles = len(fe.nodes), len(fe.triangles)
    if values.shape == (triangles,):
        return values, False
    if values.shape == (nodes,):
        return values, True
    raise ValueError('field has the shape %s, it must be one number for each of the %d triangles '
                     'or of the %d nodes.' % (shown(values.shape), triangles, nodes))


def _stress(fe, field):
    if field in ('sigma1', 'sigma2'):
        return fe.principalStress[:, ('sigma1', 'sigma2').index(field)]
    xx, yy, xy = numpy.asarray(fe.stress, dtype=float).reshape(-1, 3).T
    if field == 'mises':
        return numpy.sqrt(xx**2 - xx * yy + yy**2 + 3 * xy**2)
    return {'xx': xx, 'yy': yy, 'xy': xy}[field]
