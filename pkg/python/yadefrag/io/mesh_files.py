"""Meshes from files of other programs, for FESolver.addTriangles."""

import dataclasses
import os

import numpy

from yadefrag.arguments import path, positive, shownPath
from yadefrag.hints import File
from yadefrag.io import mesh_checks
from yadefrag.io.readers import abaqus, by_meshio, gmsh, refuseFile
from yadefrag.io.readers.elements import cornersOf, counted
from yadefrag.messages import warn

_READERS = {'.msh': gmsh.read, '.inp': abaqus.read}


@dataclasses.dataclass
class MeshFile:
    """Result of readMesh: `fe.addTriangles(mesh.nodes, mesh.triangles, material=mesh.material)`.

    nodes      (n, 2) in m, those used by triangles
    triangles  (m, 3) numbers of nodes, counter-clockwise
    groups     {name: numbers of triangles}: physical groups of gmsh, sets of elements of other formats
    nodeSets   {name: numbers of nodes}: those of groups of lines, points and triangles, and sets of
               points. In a solver the nodes are `fe.nodesOf(body)[mesh.nodeSets['left']]`. If a line
               or point and a surface of gmsh have one name, the set has the nodes of the line or point
    instances  {name: numbers of triangles}: instances of Abaqus' parts; the set 'left' of the instance
               'P-1' is nodeSets['P-1.left']
    leftOut    list of sentences about what of the file is not in this mesh
    """

    nodes: numpy.ndarray
    triangles: numpy.ndarray
    groups: dict
    nodeSets: dict
    instances: dict = dataclasses.field(default_factory=dict)
    leftOut: list = dataclasses.field(default_factory=list)

    @property
    def material(self) -> tuple[list[str], numpy.ndarray]:
        """(names, (m) numbers among them): addTriangles' `material`, if O.materials has a material
        with the label of each group. ValueError if a triangle is in no group, or in two; groups that
        are no materials can be deleted before: `del mesh.groups['all']`."""
        names = list(self.groups)
        count = numpy.zeros(len(self.triangles), dtype=int)
        of = numpy.zeros(len(self.triangles), dtype=int)
        for number, name in enumerate(names):
            count[self.groups[name]] += 1
            of[self.groups[name]] = number
        if not (count == 1).all():
            bad = int(numpy.argmax(count != 1))
            its = [name for name in names if bad in self.groups[name]]
            raise ValueError('triangle %d is in %d groups of the mesh%s, it must be in one to have a '
                             'material%s.' %
                             (bad, count[bad], ' (%s)' % ', '.join(map(repr, its)) if its else '',
                              '; `del mesh.groups[%r]` removes one that is no material' % its[-1] if its else
                              ': give addTriangles the label of a material instead'))
        return names, of


def readMesh(file: File, scale: float = 1) -> MeshFile:
    """A MeshFile from gmsh (.msh), Abaqus and CalculiX (.inp), and any format that meshio reads: VTK
    (.vtk, .vtu), Medit, Nastran ...

    file   its ending determines the format
    scale  m for one unit of the file
    Points of three columns are accepted if z is the same for all used ones. Of elements with nodes
    between their corners only the corners are used; quads are divided along their shorter diagonal;
    clockwise elements are reversed. Parts of an Abaqus file are read once for each instance, at its
    place. What is left out is listed in `leftOut`; elements which other programs show are also told in
    a warning. ValueError with the file if it cannot be read, for 3D elements, without triangles,
    and with the number of an element that is flat, collapsed, concave, doubled or inverted (that of the
    file for .msh and .inp, counted from 0 for other formats); ImportError if meshio is needed and
    missing; OSError for a file that cannot be read.
    """
    name = path('file', file)
    scale = positive('scale', scale, 'm per unit of the file')
    with open(name, 'rb'):  # OSError, before a library raises another exception
        pass
    read = _READERS.get(os.path.splitext(name)[1].lower(), by_meshio.read)
    try:
        elements = read(name)
    except (ValueError, IndexError, KeyError, OSError, OverflowError, MemoryError) as error:
        refuseFile(name, 'mesh', error)
    mesh_checks.requirePlaneKinds(elements, name)
    used = mesh_checks.usedPoints(elements, name)
    points = scale * _plane(numpy.asarray(elements.points, dtype=float), used, name)
    triangles, source, told = mesh_checks.trianglesOf(elements, points, name)
    told = elements.leftOut + told + _looseLines(elements, triangles)
    if told:
        warn('readMesh: %s: left out are %s.' % (shownPath(name), '; '.join(told)))
    corners, triangles = numpy.unique(triangles, return_inverse=True)
    if len(elements.points) > len(used):
        told.append('%s in no triangle or quad' % counted(len(elements.points) - len(used), 'point'))
    place = numpy.full(len(points), -1)
    place[corners] = numpy.arange(len(corners))
    groups, instances = (_ofTriangles(of, source) for of in (elements.groups, elements.instances))
    sets = {key: numpy.unique(place[nodes][place[nodes] >= 0]) for key, nodes in _nodeSets(elements)}
    return MeshFile(points[corners], triangles.reshape(-1, 3), groups, sets, instances, told)


def _plane(points, used, name):
    """(n, 2)."""
    if points.ndim != 2 or points.shape[1] not in (2, 3) or not numpy.isfinite(points[used]).all():
        raise ValueError('%s has points that are not finite, or none.' % shownPath(name))
    low, high = points[used].min(axis=0), points[used].max(axis=0)
    if points.shape[1] == 3 and high[2] - low[2] > mesh_checks.FLAT * (high - low)[:2].max():
        raise ValueError('%s is no plane mesh: z goes from %g to %g, it must be the same '
                         'everywhere.' % (shownPath(name), low[2], high[2]))
    return points[:, :2]


def _looseLines(elements, triangles):
    """A sentence about lines that are no sides of triangles."""
    sides = numpy.sort(numpy.stack([triangles, numpy.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    known, count = set(map(tuple, sides.tolist())), 0
    for kind, nodes, numbers in elements.blocks:
        if cornersOf(kind) == 2 and len(numbers):
            ends = numpy.sort(numpy.asarray(nodes, dtype=int)[:, :2], axis=1)
            count += sum(pair not in known for pair in map(tuple, ends.tolist()))
    return ['%s beside the sides of triangles' % counted(count, 'line')] if count else []


def _ofTriangles(sets, source):
    """{name: numbers of triangles} of {name: numbers of elements}; sets without triangles are left out."""
    found = {name: numpy.nonzero(numpy.isin(source, numbers))[0] for name, numbers in sets.items()}
    return {name: triangles for name, triangles in found.items() if len(triangles)}


def _nodeSets(elements):
    """Pairs of a name and numbers of points; later ones replace earlier ones."""
    for sets in (elements.groups, elements.markers):
        for name, numbers in sets.items():
            parts = [numpy.asarray(nodes, dtype=int)[numpy.isin(own, numbers)].ravel()
                     for _, nodes, own in elements.blocks if numpy.isin(own, numbers).any()]
            yield name, numpy.concatenate(parts or [numpy.zeros(0, dtype=int)])
    for name, nodes in elements.nodeSets.items():
        yield name, numpy.asarray(nodes, dtype=int)
