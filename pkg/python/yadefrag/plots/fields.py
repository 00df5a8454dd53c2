"""Values of the fields that plotMesh draws."""

from typing import Any

import numpy

from yadefrag.arguments import refuse, shown
from yadefrag.fe.fields import FIELDS, drawnValues
from yadefrag.hints import FESolver


def fieldValues(fe: FESolver, field: Any) -> tuple[numpy.ndarray, bool] | tuple[None, None]:
    """(values, True for one per node) of a field by its name in FIELDS, or of an array; both None for no field."""
    if field is None:
        return None, None
    if isinstance(field, str):
        if field not in FIELDS:
            refuse('field', field, 'one of %s, an array or None' % ', '.join(map(repr, FIELDS)))
        return drawnValues(fe, field), FIELDS[field].ofNodes
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
