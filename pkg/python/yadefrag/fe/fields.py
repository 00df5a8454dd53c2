"""Fields of the bodies by name: one table for pictures, ParaView and records."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy

from yadefrag.arguments import FESolver, refuse, shown


class Field(NamedTuple):
    """label    for an axis, with the unit; without it a second name of the field
    ofNodes  True: values of nodes; False: of triangles
    values   function of the solver → (n) numbers, (n, 2) vectors, or (n, 3) tensors xx, yy, xy
    needs    attribute of FESolver that is False if no material has the field
    drawn    function of the values → (n) numbers for a picture; None: the values, or lengths of vectors"""

    label: str
    ofNodes: bool
    values: Callable[[FESolver], Any]
    needs: str = ''
    drawn: Callable[[numpy.ndarray], numpy.ndarray] | None = None


def _mises(fe):
    xx, yy, xy = numpy.asarray(fe.stress, dtype=float).reshape(-1, 3).T
    zz = numpy.asarray(fe.stressZ, dtype=float)
    return numpy.sqrt(((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) / 2 + 3 * xy**2)


def _component(number):
    return lambda fe: numpy.asarray(fe.stress, dtype=float)[:, number]


FIELDS = {
    'displacement': Field('displacement (m)', True, lambda fe: fe.displacements),
    'velocity': Field('velocity (m/s)', True, lambda fe: fe.velocities),
    'speed': Field('speed (m/s)', True, lambda fe: numpy.linalg.norm(fe.velocities, axis=1)),
    'contactForce': Field('contact force (N)', True, lambda fe: fe.contactForces),
    'reaction': Field('reaction (N)', True, lambda fe: fe.reactions),
    'stress': Field('stress (Pa)', False, lambda fe: fe.stress),
    'xx': Field('stress xx (Pa)', False, _component(0)),
    'yy': Field('stress yy (Pa)', False, _component(1)),
    'xy': Field('stress xy (Pa)', False, _component(2)),
    'zz': Field('stress zz (Pa)', False, lambda fe: fe.stressZ),
    'mises': Field('von Mises stress (Pa)', False, _mises),
    'sigma1': Field('larger principal stress (Pa)', False, lambda fe: fe.principalStress[:, 0]),
    'sigma2': Field('smaller principal stress (Pa)', False, lambda fe: fe.principalStress[:, 1]),
    'strain': Field('strain', False, lambda fe: fe.strain,
                    drawn=lambda values: numpy.sqrt(values**2 @ (1, 1, 2))),
    'plasticStrain': Field('plastic strain', False, lambda fe: fe.plasticStrain, '_yields'),
    # Elastic bodies have no temperature, the array 0.
    'temperature': Field('temperature (K)', False, lambda fe: fe.temperature, '_yields',
                         lambda values: numpy.where(values > 0, values, numpy.nan)),
    'damage': Field('damage', False, lambda fe: fe.damage, '_fails'),
    'component': Field('component', False, lambda fe: numpy.asarray(fe.components, numpy.int32)),
    'fragment': Field('fragment', False, lambda fe: numpy.asarray(fe.fragmentOf, numpy.int32))}
_NAMES = {**{field.label.partition(' (')[0]: name for name, field in FIELDS.items()},
          **{name: name for name in FIELDS}, 'principal1': 'sigma1', 'principal2': 'sigma2'}


def nameOf(field: Any) -> Any:
    """The name in FIELDS of a field with several names; other values unchanged."""
    return _NAMES.get(field, field) if isinstance(field, str) else field


def drawnValues(fe: FESolver, name: str) -> numpy.ndarray:
    """One number for each node or triangle, of a field of FIELDS."""
    field = FIELDS['mises' if name == 'stress' else name]
    values = numpy.asarray(field.values(fe), dtype=float)
    if field.drawn:
        return field.drawn(values)
    return numpy.linalg.norm(values, axis=1) if values.ndim == 2 else values


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
