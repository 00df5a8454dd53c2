"""Mesh: the mesh of a body that is not added yet, held in C++; the forms in which a script may give one."""

from __future__ import annotations

from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag._yadefrag import Mesh
from yadefrag.arguments import array, flag, pair, pointsOf, refuse, shown, whole
from yadefrag.calls import inWords
from yadefrag.hints import ArrayLike
from yadefrag.io.mesh_checks import requireApart
from yadefrag.io.mesh_files import MeshFile

_fill = Mesh.__init__  # from checked arrays


def _init(self, nodes, triangles):
    points = pointsOf('nodes', _withoutHeight(nodes), 3)
    corners = array(triangles)
    if corners is None or corners.ndim != 2 or corners.shape[1] != 3 or len(corners) == 0 \
            or not numpy.issubdtype(corners.dtype, numpy.integer):
        raise ValueError('triangles must be an array (m, 3) of node numbers.')
    if corners.min() < 0 or corners.max() >= len(points):
        raise ValueError('triangles has node numbers from %d to %d, but there are %d nodes.' %
                         (corners.min(), corners.max(), len(points)))
    loops = _boundaryLoops(points, corners)
    requireApart(points, corners, loops)
    _fill(self, points, corners, loops)


def _withoutHeight(nodes):
    """Points of three columns, as other programs have them, without z if it is the same for all."""
    found = array(nodes, float)
    if found is None or found.ndim != 2 or found.shape[1] != 3 or not len(found) \
            or not (found[:, 2] == found[0, 2]).all():
        return nodes
    return found[:, :2]


def _boundaryLoops(points, triangles):
    """The closed loops of edges that belong to one triangle only, material on the left."""
    used = numpy.zeros(len(points), dtype=bool)
    used[triangles] = True
    if not used.all():
        raise ValueError('node %d belongs to no triangle.' % int(numpy.argmin(used)))
    triangles = triangles.astype(numpy.int64)
    starts, ends = triangles.ravel(), numpy.roll(triangles, -1, axis=1).ravel()
    sides = starts * len(points) + ends
    if len(numpy.unique(sides)) != len(sides):
        raise ValueError('two triangles have the same edge in the same direction: all must be '
                         'counter-clockwise, and no edge can have three.')
    isOuter = ~numpy.isin(ends * len(points) + starts, sides)
    starts, ends = starts[isOuter], ends[isOuter]
    again = numpy.setdiff1d(numpy.arange(len(starts)), numpy.unique(starts, return_index=True)[1])
    if len(again):
        node = starts[again[0]]
        raise ValueError('the boundary passes twice through node %d at (%g, %g): give each part that '
                         'touches the others there only a node of its own.' % (node, *points[node]))
    after, loops = dict(zip(starts.tolist(), ends.tolist())), []
    for node in sorted(after):
        loop = []
        while node in after:
            loop.append(node)
            node = after.pop(node)
        if loop:
            loops.append(numpy.array(loop))
    return loops


def _pair(self):
    return self.nodes, self.triangles


def _repr(self):
    return 'Mesh of %d nodes and %d triangles, boundary loops of %s nodes%s' % (
        len(self.nodes), len(self.triangles), ', '.join(str(len(loop)) for loop in self.loops),
        ', %d sides on joints' % len(self.joints) if len(self.joints) else '')


def _restored(*parts):
    mesh = Mesh.__new__(Mesh)
    _fill(mesh, *parts)
    return mesh


def _reduce(self):
    return _restored, (*_pair(self), self.loops, self._loopVertices, self.joints, self.joined, self._numJoints,
                       self.smooth), self.__dict__


_init.__name__ = 'Mesh'
Mesh.__init__ = inWords(_init)
Mesh.__iter__ = lambda self: iter(_pair(self))
Mesh.__getitem__ = lambda self, index: _pair(self)[index]
Mesh.__len__ = lambda self: 2
Mesh.__repr__ = _repr
Mesh.__reduce__ = _reduce
Mesh.__doc__ = """The mesh of a body that is not added yet: `fe.addMesh(mesh, material)`.

`polygonMesh` and `rectangleMesh` return one; `Mesh(nodes, triangles)` makes one from arrays: nodes (n, 2) in
m, or (n, 3) of one z, which is ignored, all of them used; triangles (m, 3) node numbers, counter-clockwise.
ValueError for others, and for parts that overlap.

It is also the pair of both: `nodes, triangles = mesh`. It can be pickled.
"""


def asMesh(mesh: Any) -> Mesh:
    """A Mesh from addMesh's `mesh`; of a given one the nodes, which may have been moved, are checked."""
    if isinstance(mesh, Mesh):
        requireApart(pointsOf("the mesh's nodes", mesh.nodes, 3), mesh.triangles, mesh.loops)
        return mesh
    parts = (mesh.nodes, mesh.triangles) if isinstance(mesh, MeshFile) else mesh
    try:
        nodes, triangles = parts
    except (TypeError, ValueError):
        refuse('mesh', mesh, 'a Mesh, the MeshFile of readMesh, or a pair (nodes, triangles)')
    return Mesh(nodes, triangles)


def rectangleMesh(low: ArrayLike, high: ArrayLike, nx: int, ny: int, crossed: bool = False) -> Mesh:
    """A regular Mesh of nx × ny quads, which is also the pair (nodes (n, 2), triangles (m, 3)).

    Each quad is divided in two triangles, with diagonals of neighbours mirrored, or in four
    (`crossed`).
    """
    low, high = pair('low', low), pair('high', high)
    nx, ny, crossed = whole('nx', nx), whole('ny', ny), flag('crossed', crossed)
    if not (low[0] < high[0] and low[1] < high[1]):
        raise ValueError('high is %s, it must be right of and above low, %s.' % (shown(high), shown(low)))
    return _yadefrag.meshOfRectangle(*low, *high, nx, ny, crossed)
