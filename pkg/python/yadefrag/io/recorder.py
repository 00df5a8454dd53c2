"""Files for ParaView, and a record of a run: its pictures and a table, which continue after a restart."""

import math
import os
import sys
from collections.abc import Iterable
from typing import Any
from xml.sax.saxutils import escape

import numpy

from yade import wrapper
from yadefrag.arguments import FESolver, File, path, refuse, shown, shownPath, whole
from yadefrag.fe.contents import betweenSteps, heldCracks, requireSolver, shownMesh, shownTriangles
from yadefrag.fe.fields import FIELDS, nameOf
from yadefrag.files import appendText, replacing, requireWritable, writeText
from yadefrag.messages import warn
from yadefrag.scene.lifecycle import MOST_STEPS

# Written unless others are chosen.
_USUAL = ('displacement', 'velocity', 'contact force', 'reaction', 'stress', 'stress zz', 'strain', 'plastic strain',
          'temperature', 'damage', 'component', 'fragment')
_ENERGIES = ('kinetic', 'strain', 'contact', 'friction', 'fracture', 'damping', 'dropped', 'outside', 'total', 'scene')
_FIRST = ('step', 'time (s)', 'cracks', 'fragments') + tuple('%s (J)' % e for e in _ENERGIES) + \
    ('reaction x (N)', 'reaction y (N)')
_OF_YIELDING = ('plastic (J)', 'largest plastic strain', 'highest temperature (K)')
_OF_FAILING = ('largest damage', 'failed triangles')
_NAMED = 'reaction %s of %s (N)'
_complained = set()  # files for which a message was given


def _spatial(values):
    """(n, 2) as (n, 3) with z = 0: ParaView then recognises vectors. Others unchanged."""
    return numpy.column_stack([values, numpy.zeros(len(values))]) if values.ndim == 2 and values.shape[1] == 2 else \
        values


def exportVTK(fe: FESolver, file: File, fields: Iterable[str] | None = None) -> None:
    """Writes the bodies of an FESolver to `file` for ParaView, as an unstructured grid (.vtu).

    Points are the nodes at their present positions (m); at points: displacement from the stress-free
    shape (m), velocity (m/s), contact force and reaction (N); in triangles: stress (xx, yy, xy in Pa),
    stress zz (Pa), strain (xx, yy, xy), with materials that yield plastic strain and temperature (K),
    with materials that fail damage, component and fragment (int). Removed fragments are left out.
    With an axis of symmetry, triangles have 'axisymmetric', 1: x is the distance from the axis.
    Cohesive cracks are lines along their first side, with the values of the adjacent triangle, but 'damage' is the
    dissipated fraction of their fracture energy there (and 0 in triangles that cannot fail).
    fields  list of the names of fields to write, as above or as in plotMesh ('plasticStrain' is 'plastic
            strain', 'mises', 'speed' ...); None: those above
    ValueError for another ending than .vtu, for a solver without bodies and for unknown fields.
    """
    import meshio

    name = path('file', file, '.vtu')
    requireSolver(fe)
    chosen = fieldNames(fields)
    places, blocks, points, cells = _state(fe, chosen)
    if len(blocks[0][1]) == 0:
        raise ValueError('fe has no bodies to write, add one with fe.addPolygon first.')
    mesh = meshio.Mesh(_spatial(places), blocks, point_data=points, cell_data=cells)
    with replacing(name) as part:
        mesh.write(part, file_format='vtu')


def fieldNames(fields: Iterable[str] | None) -> tuple[str, ...]:
    """A tuple of names from a list of names of fields, or None for those of exportVTK; ValueError for other names."""
    if fields is None:
        return _USUAL
    try:
        chosen = (fields,) if isinstance(fields, str) else tuple(fields)
    except TypeError:
        chosen = ('',)
    if not all(isinstance(one, str) and nameOf(one) in FIELDS for one in chosen):
        refuse('fields', fields, 'some of %s' % ', '.join(FIELDS))
    return chosen


def _state(fe, fields):
    """(positions of nodes, blocks of cells, values at nodes, values in cells) of one step."""
    with betweenSteps(fe):
        nodes, triangles, corners = shownMesh(fe)
        sides, beside, damage = heldCracks(fe)
        blocks, of = [('triangle', corners.astype(numpy.int64))], [triangles]
        if len(beside):
            blocks.append(('line', numpy.searchsorted(nodes, sides[:, :2]).astype(numpy.int64)))
            of.append(beside)
        points, cells = {}, {}
        for name in fields:
            field = FIELDS[nameOf(name)]
            if field.needs and not getattr(fe, field.needs, False):
                continue
            values = numpy.asarray(field.values(fe))
            if field.ofNodes:
                points[name] = _spatial(values[nodes])
            else:
                cells[name] = [values[numbers] for numbers in of]
        if fe.axisymmetric:
            cells['axisymmetric'] = [numpy.ones(len(numbers), numpy.int8) for numbers in of]
        if len(beside):
            ofTriangles = cells['damage'][0] if 'damage' in cells else numpy.zeros(len(triangles))
            cells['damage'] = [ofTriangles, damage]
        return fe.nodes[nodes], blocks, points, cells


def FERecorder(iterPeriod: int = 0, file: File = 'run', fields: Iterable[str] | None = None, **settings: Any) -> Any:
    """An engine, a PyRunner for the end of O.engines, that records the scene's FESolver.

    iterPeriod  steps between two records; or virtPeriod (s), realPeriod (s) and all other settings
                of a PyRunner, as further arguments
    file        path without an ending: file.csv has a line for each record, with the step, fe.time
                (s), the numbers of cracks and fragments, the energies (J), and the reactions (N) of
                all held nodes and of each body with a name, nan while there is no such body; with
                materials that yield also the plastic work, the largest plastic strain and the highest
                temperature, with materials that fail the largest damage and the number of failed
                triangles; file.pvd,
                for ParaView, is the series of the pictures file_000000.vtu, …, which have the format
                of exportVTK
    fields      fields of exportVTK in the pictures; None: all; (): no pictures
    O.save keeps it. Existing files are continued: records of the present fe.time and later, which
    belong to a run that is now repeated from an earlier save, are removed. If a file cannot be
    written, e.g. on a full disk, a message is written to stderr, once for each file, and the run
    continues; earlier records are unchanged. OSError if file.csv cannot be written now, ValueError
    for unknown fields.
    """
    name = path('file', file)
    chosen = fieldNames(fields)
    every = whole('iterPeriod', iterPeriod, 0, 'a whole number of steps', MOST_STEPS)
    requireWritable(name + '.csv')
    if not every and not any(settings.get(one) for one in ('virtPeriod', 'realPeriod')):
        warn('FERecorder: none of iterPeriod, virtPeriod and realPeriod is given; there will be one record, '
             'of the first step.')
    command = '__import__("yadefrag.io").io.recorder.record(%r, %r)' % (os.path.abspath(name), chosen)
    try:
        return wrapper.PyRunner(command=command, **{'initRun': True, 'iterPeriod': every, **settings})
    except OverflowError:
        raise ValueError('A setting of FERecorder is too large: %s.' % shown(settings)) from None


def record(name: str, fields: tuple[str, ...]) -> None:
    """The action of the engine."""
    solvers = [one for one in wrapper.Omega().engines if isinstance(one, wrapper.FESolver)]
    if not solvers:
        return
    with betweenSteps(solvers[0]):
        for file, write in ((name + '.csv', _appendLine), (name + '.pvd', _appendPicture)):
            try:
                write(solvers[0], name, fields)
                _complained.discard(file)
            except OSError as error:
                if file not in _complained:
                    _complained.add(file)
                    print('WARN  FERecorder: %s cannot be written (%s); the run continues without it.' %
                          (shownPath(file), error.strerror or error), file=sys.stderr)


def _before(time, now):
    """True if `time` is before `now`; times of one step may differ by rounding."""
    return time < now * (1 - 1e-12)


# --- the table

def _appendLine(fe, name, _):
    """Columns of bodies that have come are added, those of bodies that have gone stay; nan: no body."""
    file = name + '.csv'
    lines = _lines(file)
    names = [one for one in fe._names if one]
    columns = [*_FIRST, *(_OF_YIELDING if fe._yields else ()), *(_OF_FAILING if fe._fails else ()),
               *(_NAMED % (axis, one.replace(',', ' ')) for one in names for axis in 'xy')]
    row, old = _row(fe, names), lines[0].split(',') if lines else []
    isOurs = old[:len(_FIRST)] == list(_FIRST)
    kept = [line for line in lines[1:] if _isEarlier(line, fe.time)] if isOurs else []
    if kept and old != columns:
        values = dict(zip(columns, row))
        columns = old + [one for one in columns if one not in old]
        row = [values.get(one, 'nan') for one in columns]
        kept = [line + ',nan' * (len(columns) - len(old)) for line in kept]
    if isOurs and columns == old and len(kept) == len(lines) - 1:
        appendText(file, ','.join(row) + '\n')
    else:
        writeText(file, '\n'.join([','.join(columns), *kept, ','.join(row), '']))


def _lines(file):
    try:
        with open(file, encoding='utf-8', errors='replace') as old:
            return old.read().splitlines()
    except FileNotFoundError:
        return []


def _isEarlier(line, now):
    try:
        return _before(float(line.split(',')[1]), now)
    except (IndexError, ValueError):
        return False


def _row(fe, names):
    energy = fe.energy
    numbers = [wrapper.Omega().iter, fe.time, fe.numCracks, len(fe.fragments())]
    numbers += [energy.get(one, 0.) for one in _ENERGIES[:-1]] + [energy.get('scene', energy['total'])]
    forces = fe.reactions
    ofYielding = [energy['plastic'], fe.plasticStrain.max(), fe.temperature.max()] if fe._yields else []
    if fe._fails:
        damage = fe.damage
        ofYielding += [damage.max(), int((damage >= 1).sum())]
    sums = [forces.sum(axis=0)] + [forces[fe.nodesOf(one)].sum(axis=0) if not fe._isGone(
        fe._names.index(one)) else (math.nan, math.nan) for one in names]
    ends = [float(value) for force in sums for value in force]
    numbers += ends[:2] + [one if isinstance(one, int) else float(one) for one in ofYielding] + ends[2:]
    return list(map(repr, numbers))


# --- the pictures

_HEAD = ('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
         '<Collection>\n')
_ENTRY = '<DataSet timestep="%r" part="0" file="%s"/>'
_END = '</Collection>\n</VTKFile>\n'


def _appendPicture(fe, name, fields):
    if not fields or not len(shownTriangles(fe)):
        return
    kept = [entry for entry in _entries(name + '.pvd') if _before(entry[0], fe.time)]
    last = max([_number(picture) for _, picture in kept], default=-1)
    picture = '%s_%06d.vtu' % (name, last + 1)
    exportVTK(fe, picture, fields)
    kept.append((fe.time, os.path.basename(picture)))
    lines = '\n'.join(_ENTRY % (time, escape(one, {'"': '&quot;'})) for time, one in kept)
    writeText(name + '.pvd', _HEAD + lines + '\n' + _END)


def _number(picture):
    try:
        return int(picture.rsplit('_', 1)[1].split('.')[0])
    except (IndexError, ValueError):
        return -1


def _entries(file):
    """List of (time, name of a picture) in a file of this recorder; none if it is another file."""
    import xml.etree.ElementTree as tree
    try:
        root = tree.parse(file).getroot()
        return [(float(one.attrib['timestep']), one.attrib['file']) for one in root.iter('DataSet')]
    except (FileNotFoundError, tree.ParseError, KeyError, ValueError):
        return []
