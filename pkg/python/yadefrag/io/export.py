"""Files for other programs."""

from collections.abc import Iterable

import numpy

from yadefrag.arguments import path, refuse
from yadefrag.fe.between_steps import betweenSteps
from yadefrag.fe.contents import heldCracks, requireSolver, shownMesh
from yadefrag.fe.fields import FIELDS, nameOf
from yadefrag.hints import FESolver, File
from yadefrag.io.files import replacing

# Written unless others are chosen.
_USUAL = ('displacement', 'velocity', 'contact force', 'reaction', 'stress', 'stress zz', 'strain', 'plastic strain',
          'temperature', 'damage', 'component', 'fragment')


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
        if len(beside):
            ofTriangles = cells['damage'][0] if 'damage' in cells else numpy.zeros(len(triangles))
            cells['damage'] = [ofTriangles, damage]
        return fe.nodes[nodes], blocks, points, cells
