"""Meshes from files of other programs, for FESolver.addTriangles."""

import dataclasses

import numpy

from yadefrag.readers import needed, refuseFile
from yadefrag.values import path, positive, shownPath

_PACKAGE = 'python3-meshio'
_FLAT = 1e-9  # of the longer side: permitted distance of points from a plane
_MIDDLE = {'triangle6': 'triangle', 'triangle7': 'triangle', 'quad8': 'quad', 'quad9': 'quad'}
_OTHER = ('vertex', 'line', 'line3', 'line4')  # in a plane mesh: they mark its boundary


@dataclasses.dataclass
class MeshFile:
    """Result of readMesh: `fe.addTriangles(mesh.nodes, mesh.triangles, material=mesh.material)`.

    nodes      (n, 2) in m, those used by triangles
    triangles  (m, 3) numbers of nodes, counter-clockwise
    groups     {name: numbers of triangles}: physical groups of gmsh, sets of cells of other formats
    nodeSets   {name: numbers of nodes}: those of groups of lines, points and triangles, and sets of
               points. In a solver the nodes are `fe.nodesOf(body)[mesh.nodeSets['left']]`
    """

    nodes: numpy.ndarray
    triangles: numpy.ndarray
    groups: dict
    nodeSets: dict

    @property
    def material(self):
        """(names, (m) numbers among them): addTriangles' `material`, if O.materials has a material
        with the label of each group. ValueError if a triangle is in no group, or in two."""
        names = list(self.groups)
        count = numpy.zeros(len(self.triangles), dtype=int)
        of = numpy.zeros(len(self.triangles), dtype=int)
        for number, name in enumerate(names):
            count[self.groups[name]] += 1
            of[self.groups[name]] = number
        if not (count == 1).all():
            bad = int(numpy.argmax(count != 1))
            raise ValueError('triangle %d is in %d groups of the mesh, it must be in one to have a '
                             'material.' % (bad, count[bad]))
        return names, of


def readMesh(file, scale=1):
    """A MeshFile from any format that meshio reads: gmsh (.msh), Abaqus (.inp), VTK (.vtk, .vtu),
    Medit ...

    file   its ending determines the format
    scale  m for one unit of the file
    Points of three columns are accepted if z is the same for all. Of elements with nodes at the
    middles of their sides only the corners are used; quads are divided along their shorter
    diagonal; clockwise elements are reversed, and unused points are left out. ValueError with the
    file if meshio cannot read it, for 3D elements, or without triangles; ImportError if meshio is
    missing; OSError for a file that cannot be read.
    """
    name = path('file', file)
    scale = positive('scale', scale, 'm per unit of the file')
    with open(name, 'rb'):  # OSError, before a library raises another exception
        pass
    meshio = needed('meshio', _PACKAGE, name)
    try:
        mesh = meshio.read(name)
    except (Exception, SystemExit) as error:  # meshio ends the process for an unknown ending
        refuseFile(name, 'mesh', error)
    points = scale * _plane(numpy.asarray(mesh.points, dtype=float), name)
    triangles, source = _triangles(mesh, points, name)
    used, corners = numpy.unique(triangles, return_inverse=True)
    groups, sets = _groups(mesh, triangles, source)
    place = numpy.full(len(points), -1)
    place[used] = numpy.arange(len(used))
    sets = {key: numpy.unique(place[nodes][place[nodes] >= 0]) for key, nodes in sets.items()}
    return MeshFile(points[used], corners.reshape(-1, 3), groups, sets)


def _plane(points, name):
    """(n, 2)."""
    if points.ndim != 2 or points.shape[1] not in (2, 3) or not len(points) \
            or not numpy.isfinite(points).all():
        raise ValueError('%s has points that are not finite, or none.' % shownPath(name))
    low, high = points.min(axis=0), points.max(axis=0)
    if points.shape[1] == 3 and high[2] - low[2] > _FLAT * (high - low)[:2].max():
        raise ValueError('%s is no plane mesh: z goes from %g to %g, it must be the same '
                         'everywhere.' % (shownPath(name), low[2], high[2]))
    return points[:, :2]


def _triangles(mesh, points, name):
    """(m, 3) numbers of points, and (m, 2): number of the block of cells and of the cell in it."""
    found, source = [], []
    for block, cells in enumerate(mesh.cells):
        kind = _MIDDLE.get(cells.type, cells.type)
        if kind not in ('triangle', 'quad'):
            if cells.type not in _OTHER:
                raise ValueError("%s has elements of the kind '%s', those of a plane mesh are "
                                 'triangles and quads.' % (shownPath(name), cells.type))
            continue
        corners = numpy.asarray(cells.data, dtype=int)[:, :3 if kind == 'triangle' else 4]
        number = numpy.arange(len(corners))
        if kind == 'quad':
            corners, number = _cut(points, corners), numpy.repeat(number, 2)
        found.append(corners)
        source.append(numpy.stack([numpy.full(len(number), block), number], axis=1))
    if not found or not sum(map(len, found)):
        raise ValueError('%s has no triangles.' % shownPath(name))
    triangles = numpy.concatenate(found)
    a, b, c = points[triangles].transpose(1, 0, 2)
    isClockwise = _cross(b - a, c - a) < 0
    triangles[isClockwise] = triangles[isClockwise][:, ::-1]
    return triangles, numpy.concatenate(source)


def _cross(a, b):
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _cut(points, quads):
    """(2m, 3): each quad divided along its shorter diagonal."""
    corners = points[quads]
    first = numpy.linalg.norm(corners[:, 2] - corners[:, 0], axis=1)
    second = numpy.linalg.norm(corners[:, 3] - corners[:, 1], axis=1)
    along = numpy.array([[0, 1, 2, 0, 2, 3]]), numpy.array([[0, 1, 3, 1, 2, 3]])
    order = numpy.where((first <= second)[:, None], *along)
    return numpy.take_along_axis(quads, order, axis=1).reshape(-1, 3)


def _groups(mesh, triangles, source):
    """({name: triangles}, {name: points}) of a meshio mesh."""
    groups, sets = {}, {}
    for name, blocks in _cellsOf(mesh).items():
        mine = [numpy.nonzero(source[:, 0] == b)[0][numpy.isin(source[source[:, 0] == b, 1], cells)]
                for b, cells in blocks]
        mine = numpy.concatenate(mine)
        nodes = [numpy.asarray(mesh.cells[b].data, dtype=int)[cells].ravel() for b, cells in blocks]
        sets[name] = numpy.concatenate(nodes)
        if len(mine):
            groups[name] = mine
    for name, nodes in mesh.point_sets.items():
        sets[name] = numpy.asarray(nodes, dtype=int).ravel()
    return groups, sets


def _cellsOf(mesh):
    """{name: [(block, numbers of its cells)]}."""
    found = {}
    names = {(int(tag), int(dimension)): name for name, (tag, dimension) in mesh.field_data.items()}
    for block, tags in enumerate(mesh.cell_data.get('gmsh:physical', ())):
        for tag in numpy.unique(tags):
            name = names.get((int(tag), mesh.cells[block].dim), '%d' % tag)
            if tag != 0:  # 0: in no group
                found.setdefault(name, []).append((block, numpy.nonzero(tags == tag)[0]))
    for name, blocks in mesh.cell_sets.items():
        if name.startswith('gmsh:') or name in found:
            continue
        numbers = [(b, numpy.asarray(cells, dtype=int)) for b, cells in enumerate(blocks)
                   if cells is not None and len(cells)]
        if numbers:
            found[name] = numbers
    return found
