"""Files for other programs."""

import numpy

from yadefrag.files import replacing
from yadefrag.shown import betweenSteps, requireSolver, shownMesh
from yadefrag.values import path

_OF_NODES = (('displacement', 'displacements'), ('velocity', 'velocities'),
             ('contact force', 'contactForces'))


def _spatial(values):
    """(n, 2) as (n, 3) with z = 0, which ParaView takes for vectors."""
    values = numpy.asarray(values, dtype=float).reshape(-1, 2)
    return numpy.column_stack([values, numpy.zeros(len(values))])


def exportVTK(fe, file):
    """Writes the bodies of an FESolver to `file` for ParaView, as an unstructured grid (.vtu).

    Points are the nodes where they are now (m); at points: displacement from the stress-free shape
    (m), velocity (m/s), contact force (N); in triangles: stress (xx, yy, xy in Pa), component and
    fragment (int). Dropped fragments are left out. ValueError for another ending than .vtu and for
    a solver without bodies.
    """
    import meshio

    name = path('file', file, '.vtu')
    requireSolver(fe)
    places, corners, points, cells = _state(fe)
    if len(corners) == 0:
        raise ValueError('fe has no bodies to write, add one with fe.addPolygon first.')
    mesh = meshio.Mesh(_spatial(places), [('triangle', corners.astype(numpy.int64))],
                       point_data=points, cell_data=cells)
    with replacing(name) as part:
        mesh.write(part, file_format='vtu')


def _state(fe):
    """(nodes' positions, triangles' corners, values at nodes, values in triangles) of one step."""
    with betweenSteps(fe):
        nodes, triangles, corners = shownMesh(fe)
        points = {name: _spatial(getattr(fe, attribute)[nodes]) for name, attribute in _OF_NODES}
        cells = {'stress': [numpy.asarray(fe.stress, dtype=float)[triangles]],
                 'component': [numpy.asarray(fe.components, dtype=numpy.int32)[triangles]],
                 'fragment': [numpy.asarray(fe.fragmentOf, dtype=numpy.int32)[triangles]]}
        return fe.nodes[nodes], corners, points, cells
