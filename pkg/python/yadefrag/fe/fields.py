"""Results of FESolver's bodies. Fields by name: one table for pictures, ParaView and records. Reactions, contact
forces, principal stresses, cracks, energies; quality of meshes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy

from yadefrag.arguments import FESolver, File, Nodes, array, path, refuse, shown
from yadefrag.fe.contents import betweenSteps, existingBody, isBody, requireSolver
from yadefrag.fe.motions import chosenNodes
from yadefrag.files import writeColumns

# (of the fracture energy) Rounding opens the faces of a loaded crack, such as a bond under its weight,
# without damaging it.
_ROUNDING = 1e-9

_CRACKS = (('component', '', int), ('other', '', int), ('x', 'm', float), ('y', 'm', float), ('nx', '', float),
           ('ny', '', float), ('opening', 'm', float), ('slip', 'm', float), ('damage', '', float), ('held', '', bool),
           ('start', 's', float), ('strength', 'Pa', float), ('energy', 'J/m²', float))


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


FIELDS = {
    'displacement': Field('displacement (m)', True, lambda fe: fe.displacements),
    'velocity': Field('velocity (m/s)', True, lambda fe: fe.velocities),
    'speed': Field('speed (m/s)', True, lambda fe: numpy.linalg.norm(fe.velocities, axis=1)),
    'contactForce': Field('contact force (N)', True, lambda fe: fe.contactForces),
    'reaction': Field('reaction (N)', True, lambda fe: fe.reactions),
    'stress': Field('stress (Pa)', False, lambda fe: fe.stress),
    'xx': Field('stress xx (Pa)', False, lambda fe: fe.stress[:, 0]),
    'yy': Field('stress yy (Pa)', False, lambda fe: fe.stress[:, 1]),
    'xy': Field('stress xy (Pa)', False, lambda fe: fe.stress[:, 2]),
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


def fieldValues(fe: FESolver, field: Any) -> tuple[numpy.ndarray, bool] | tuple[None, None]:
    """(values, True for one per node) of a field by its name in FIELDS, or of an array; both None for no field."""
    if field is None:
        return None, None
    if isinstance(field, str):
        if field not in FIELDS:
            refuse('field', field, 'one of %s, an array or None' % ', '.join(map(repr, FIELDS)))
        own = FIELDS['mises' if field == 'stress' else field]
        values = numpy.asarray(own.values(fe), dtype=float)
        if own.drawn:
            return own.drawn(values), own.ofNodes
        return numpy.linalg.norm(values, axis=1) if values.ndim == 2 else values, own.ofNodes
    given = array(field, float)
    if given is None:
        refuse('field', field, 'a name, an array or None')
    nodes, triangles = len(fe.nodes), len(fe.triangles)
    if given.shape == (triangles,):
        return given, False
    if given.shape == (nodes,):
        return given, True
    raise ValueError('field has the shape %s, it must be one number for each of the %d triangles '
                     'or of the %d nodes.' % (shown(given.shape), triangles, nodes))


def reaction(self: FESolver, nodes: int | Nodes) -> tuple[float, float]:
    """(x, y) in N: the sum of `reactions` over nodes, in the last step.

    nodes  as in `prescribe`, or a body's number or name: the whole body
    """
    with betweenSteps(self):
        chosen = self.nodesOf(nodes) if isBody(nodes) else chosenNodes(self, nodes)
        x, y = self.reactions[chosen].sum(axis=0).tolist()
        return x, y


def contactForce(self: FESolver, a: int | str, b: int | str | None = None) -> tuple[float, float]:
    """(x, y) in N: contact force on body a in the last step, of body b, or of all bodies.

    a, b  numbers or names of bodies of this engine; spheres are not included. 0 after O.load, until
          the next step. ValueError if there is no such body.
    """
    with betweenSteps(self):
        first = existingBody(self, a, 'a')
        if b is None:
            x, y = self.contactForces[self.nodesOf(first)].sum(axis=0).tolist()
            return x, y
        second = existingBody(self, b, 'b')
        return (0., 0.) if first == second else self._pairForce(first, second)


def principalStress(self: FESolver) -> numpy.ndarray:
    """Larger and smaller principal stress in the plane (Pa), and the angle of the direction of the
    larger one from the x axis (rad, above -π/2 and up to π/2), of the triangles, array (m, 3)."""
    xx, yy, xy = self.stress.T
    mean, half = (xx + yy) / 2, (xx - yy) / 2
    radius = numpy.hypot(half, xy)
    return numpy.stack([mean + radius, mean - radius, numpy.arctan2(xy, half) / 2], axis=1)


def crackCounts(self: FESolver) -> dict[str, int]:
    """Numbers of the sides that are cracked at present, a dict: open (without cohesion), damaged (held by
    cohesion; part of their fracture energy is dissipated), whole (held; nothing is dissipated: bonds, and
    cracks that have not opened). They are the rows of crackTable: with bonds and open joints, without
    removed fragments."""
    cracks = self._cracks()
    held, isDamaged = cracks['held'], cracks['damage'] > _ROUNDING
    counts = dict(open=~held, damaged=held & isDamaged, whole=held & ~isDamaged)
    return {name: int(are.sum()) for name, are in counts.items()}


def crackTable(fe: FESolver, file: File | None = None) -> numpy.ndarray:
    """All cracked edges, as a NumPy array with named columns (k); bonds and open joints, too.

    Columns: component, other (the bodies on both sides), x, y (m, present position of its middle),
    nx, ny (normal, from the first side to the other), opening, slip (m, of the middles of both
    sides, across and along; slip is positive if the other side moves along (-ny, nx)), damage
    (dissipated fraction of its fracture energy, 1 without cohesion), held (True if the crack is
    cohesive), start (s of fe.time; nan: cracked from the start), strength (Pa) and energy (J/m²; 0:
    it opened at once), with the factor by rateEffect. Cracks of removed fragments are left out.
    file  path of a .csv to write as well, with the units in its first line
    ValueError for another ending, before anything is written.
    """
    requireSolver(fe)
    name = None if file is None else path('file', file, '.csv')
    columns = fe._cracks()
    table = numpy.empty(len(columns['x']), dtype=[(column, kind) for column, _, kind in _CRACKS])
    for column, _, _ in _CRACKS:
        table[column] = columns[column]
    if name is not None:
        writeColumns(name, _CRACKS, table)
    return table


class Energies(dict):
    """Energies (J) by name; 'external' is an alias: the negative of 'outside'."""

    def __missing__(self, name: str) -> float:
        if name != 'external':
            raise KeyError(name)
        return 0. - self['outside']

    def __contains__(self, name: object) -> bool:
        return name == 'external' or dict.__contains__(self, name)

    def get(self, name: str, default: Any = None) -> Any:
        return self[name] if name in self else default


def energy(self: FESolver) -> Energies:
    """Dict of J: kinetic, strain, contact, friction, fracture, damping, outside (energy that left, also
    with bodies that were removed: negative where work was done on the bodies, or bodies were added
    after the first step); with minFragmentArea, dropped (energy of removed
    fragments); total, their sum, is constant, except for impacts of soft bodies that rotate, which
    reduce it by second order in O.dt: 5e-4 of the work in a drum of rubber, 1.3e-4 with half the step.
    O.energy has the same values, with the same signs, as feKinetic, feStrain ... feOutside, if
    O.trackEnergy.

    After contact with YADE's bodies also scene: total plus the energy that this contact has created
    (work on both sides, elastic energy and friction of the contacts, up to the last step); constant,
    whatever gravity, damping or prescribed motion do, unless the contact law itself dissipates by
    other means. 'external' can be read as well: it is -outside.
    """
    return Energies(self._energies)


def meshQuality(self: FESolver, component: int | str | None = None) -> dict[str, Any]:
    """The shape of the triangles in the stress-free mesh of a body.

    component  the body's number or name; None if there is only one
    A dict:
    minAngle       smallest angle of a triangle (rad)
    size           edges of an even lattice with as many triangles in the area (m)
    timeStepRatio  critical time step, over that of this lattice
    shortestEdge   m
    numTriangles   without those of removed fragments
    ValueError for a component that does not exist.
    """
    requireSolver(self)
    with betweenSteps(self):
        there = numpy.unique(self.components).tolist() if component is None else [existingBody(self, component)]
        if len(there) != 1:
            raise ValueError('component is None, but there are %d bodies; it must be one of %s.' % (len(there), there))
        return dict(self._meshQuality(there[0]))
