"""Mesh: the mesh of a body that is not added yet, held in C++. A script gives its arrays, or an outline with holes
(polygonMesh)."""

from __future__ import annotations

import dataclasses
import inspect
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag._yadefrag import Mesh
from yadefrag.arguments import (ArrayLike, ByPlace, FESolver, array, flag, listOf, number, pair, pointsOf, positive,
                                refuse, requireTakes, whole)
from yadefrag.fe.geometry import holesOf, rectangle, simplified
from yadefrag.fe.mesh_values import isClockwise, isField, mayCrack, smoothFlags, smoothNodes
from yadefrag.messages import checkedCall, warn

_fill = Mesh.__init__  # from checked arrays
_SPACING = .2  # of the size: nearer vertices of the neighbours give one vertex
_JOINTS = .1   # of the size: default tolerance of joints
_BESIDE = 1e-3  # of an element's height: where points beside its side are examined
_LEAST_SAMPLES, _MOST_SAMPLES = 128, 1024  # of a size function, along the outline's longer side

# Arguments of polygonMesh and addPolygon.
ARGUMENTS = inspect.cleandoc("""outline, holes  list of points (x, y) in m, and a list of such lists
    size            length of the triangles' edges (m), or a function (x, y) → m. The function is
                    sampled on a grid of at least 128 and at most 1024 cells along the longer side.
                    Where it grows by more than 0.25 m per metre, it is lowered to that.
    smooth          False: straight boundary; True: C¹-smooth everywhere, inside the outline; or
                    one flag per point of the outline (the holes are then straight): True: the corner
                    there is smoothed
    meshSeed        seed of an irregular mesh: the same outline, size and seed give the same mesh
    simplify        None: the outline as given; or the permitted distance (m) of its points, and those
                    of the holes, from the meshed outline: redundant points are removed before meshing,
                    e.g. those of a contour of pixels. No edges cross by it; corners between edges much
                    longer than the distance are kept, and so are straight corners that are next to
                    smooth ones in `smooth`. It must be less than the area over the length of the
                    outline and of each hole. By the rule of Douglas and Peucker (1973, Cartographica
                    10, 112)
    joints          list of pairs of points ((x, y), (x, y)) in m: sides of triangles lie on these
                    lines. Lines may cross each other and the outline; parts outside are ignored.
                    Ends and crossings nearer than a tolerance to each other, to another line or to the
                    outline are joined; a warning states how many and how far
""")


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
    _requireApart(points, corners, loops)
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


def _requireApart(points, triangles, loops):
    """ValueError if parts of a mesh without common nodes overlap. Contact would not see that."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    if sum((points[loop] * _rightOf(points[numpy.roll(loop, -1)])).sum() > 0 for loop in loops) < 2:
        return  # loops around material are counter-clockwise
    starts = numpy.concatenate(loops)
    ends = numpy.concatenate([numpy.roll(loop, -1) for loop in loops])
    along = points[ends] - points[starts]
    sides = (triangles * len(points) + numpy.roll(triangles, -1, axis=1)).astype(numpy.int64).T.ravel()
    known = numpy.argsort(sides)
    own = known[numpy.searchsorted(sides, starts * len(points) + ends, sorter=known)] % len(triangles)
    squares = numpy.maximum((along**2).sum(axis=1), 1e-300)
    heights = cross(b - a, c - a)[own] / squares  # of the triangles, in lengths of their sides
    low, high = numpy.minimum(numpy.minimum(a, b), c), numpy.maximum(numpy.maximum(a, b), c)
    order = numpy.argsort(low[:, 0])
    left, widest = low[order, 0], (high - low)[:, 0].max()
    for part in (.02, .5, .98):
        inside = points[starts] + part * along - _BESIDE * heights[:, None] * _rightOf(along)
        first = numpy.searchsorted(left, inside[:, 0] - widest)
        last = numpy.searchsorted(left, inside[:, 0], side='right')
        for place, mine, i, j in zip(inside, own, first, last):
            near = order[i:j]
            near = near[((low[near] <= place) & (place <= high[near])).all(axis=1) & (near != mine)]
            arms = [place - corner[near] for corner in (a, b, c)]
            isIn = [cross(to[near] - at[near], arm) >= 0 for at, to, arm in zip((a, b, c), (b, c, a), arms)]
            if numpy.all(isIn, axis=0).any():
                raise ValueError('two parts of the mesh, without common nodes, overlap at (%g, %g) m; they may '
                                 'touch, but not overlap.' % tuple(place))


def _rightOf(vectors):
    return numpy.stack([vectors[:, 1], -vectors[:, 0]], axis=1)


def cross(a: numpy.ndarray, b: numpy.ndarray) -> numpy.ndarray:
    """(n) z of the products of vectors (n, 2)."""
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _repr(self):
    return 'Mesh of %d nodes and %d triangles, boundary loops of %s nodes%s' % (
        len(self.nodes), len(self.triangles), ', '.join(str(len(loop)) for loop in self.loops),
        ', %d sides on joints' % len(self.joints) if len(self.joints) else '')


def _restored(*parts):
    mesh = Mesh.__new__(Mesh)
    _fill(mesh, *parts)
    return mesh


def _reduce(self):
    return _restored, (self.nodes, self.triangles, self.loops, self._loopVertices, self.joints, self.joined,
                       self._numJoints, self.smooth), self.__dict__


_init.__name__ = 'Mesh'
Mesh.__init__ = checkedCall(_init)
Mesh.__iter__ = lambda self: iter((self.nodes, self.triangles))
Mesh.__getitem__ = lambda self, index: (self.nodes, self.triangles)[index]
Mesh.__len__ = lambda self: 2
Mesh.__repr__ = _repr
Mesh.__reduce__ = _reduce
Mesh.__doc__ = """The mesh of a body that is not added yet: `fe.addMesh(mesh, material)`.

`polygonMesh` and `rectangleMesh` return one; `Mesh(nodes, triangles)` makes one from arrays: nodes (n, 2) in
m, or (n, 3) of one z, which is ignored, all of them used; triangles (m, 3) node numbers, counter-clockwise.
ValueError for others, and for parts that overlap.

It is also the pair of both: `nodes, triangles = mesh`. It can be pickled.
"""


@dataclasses.dataclass
class MeshFile:
    """Result of readMesh: `fe.addMesh(mesh, material=mesh.material)`.

    nodes      (n, 2) in m, those used by triangles
    triangles  (m, 3) numbers of nodes, counter-clockwise
    groups     {name: numbers of triangles}: physical groups of gmsh, sets of elements of other formats
    nodeSets   {name: numbers of nodes}: those of groups of lines, points and triangles, and sets of
               points. In a solver the nodes are `fe.nodesOf(body)[mesh.nodeSets['left']]`. If a line
               or point and a surface of gmsh have one name, the set has the nodes of the line or point
    instances  {name: numbers of triangles}: instances of Abaqus' parts; the set 'left' of the instance
               'P-1' is nodeSets['P-1.left']
    leftOut    list of sentences about what of the file is not in this mesh
    joints     (k, 3): both nodes of each side with a cohesive element, and the number of its values in the arrays
               jointStrength (Pa) and jointEnergy (J/m²)
    axisymmetric  True: elements around an axis; False: plane stress or strain; None: unknown
    """

    nodes: numpy.ndarray
    triangles: numpy.ndarray
    groups: dict
    nodeSets: dict
    instances: dict = dataclasses.field(default_factory=dict)
    leftOut: list = dataclasses.field(default_factory=list)
    joints: ArrayLike = ()
    jointStrength: ArrayLike = ()
    jointEnergy: ArrayLike = ()
    axisymmetric: bool | None = None

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


def asMesh(mesh: Any) -> Mesh:
    """A Mesh from addMesh's `mesh`; of a given one the nodes, which may have been moved, are checked."""
    if isinstance(mesh, Mesh):
        _requireApart(pointsOf("the mesh's nodes", mesh.nodes, 3), mesh.triangles, mesh.loops)
        return mesh
    parts = (mesh.nodes, mesh.triangles) if isinstance(mesh, MeshFile) else mesh
    try:
        nodes, triangles = parts
    except (TypeError, ValueError):
        refuse('mesh', mesh, 'a Mesh, the MeshFile of readMesh, or a pair (nodes, triangles)')
    made = Mesh(nodes, triangles)
    if isinstance(mesh, MeshFile):
        joints = numpy.array(mesh.joints, dtype=int).reshape(-1, 3)
        made = _restored(made.nodes, made.triangles, made.loops, [], joints.astype(numpy.uint32), (0, 0.),
                         int(joints[:, 2].max(initial=-1)) + 1)
    return made


def rectangleMesh(low: ArrayLike, high: ArrayLike, nx: int, ny: int, crossed: bool = False) -> Mesh:
    """A regular Mesh of nx × ny quads, which is also the pair (nodes (n, 2), triangles (m, 3)).

    Each quad is divided in two triangles, with diagonals of neighbours mirrored, or in four
    (`crossed`).
    """
    low, _, high, _ = rectangle(low, high)
    return _yadefrag.meshOfRectangle(*low, *high, whole('nx', nx), whole('ny', ny), flag('crossed', crossed))


def withArguments(text: str | None) -> str:
    """A docstring with ARGUMENTS for its {arguments}. Both without indentation: Python removes that of docstrings
    since 3.13."""
    return inspect.cleandoc(text or '').replace('{arguments}', ARGUMENTS)


def _jointLines(joints):
    """(k, 4) floats, the ends of each joint: addPolygon's `joints`."""
    ends, right = [], 'a pair of points ((x, y), (x, y)) in m'
    for i, line in enumerate(listOf('joints', joints, 'a list of pairs of points ((x, y), (x, y)) in m')):
        both = listOf('joints[%d]' % i, line, right)
        if len(both) != 2:
            refuse('joints[%d]' % i, line, right)
        ends.append([*pair('joints[%d][0]' % i, both[0]), *pair('joints[%d][1]' % i, both[1])])
    return numpy.array(ends, dtype=float).reshape(-1, 4)


def _sizeOf(size, points):
    """addPolygon's `size`, as _yadefrag.meshOfPolygon takes it: (m,), or, of a function, (left, bottom, cell, columns,
    values) at the points of a square grid."""
    if not callable(size):
        return (number('size', size, lambda v: math.isfinite(v) and v > 0,
                       'a positive number (m) or a function (x, y) that returns one'),)
    requireTakes('size', size, 'x', 'y')
    low, high = points.min(axis=0), points.max(axis=0)
    samples = _LEAST_SAMPLES
    while True:
        cell = float((high - low).max()) / samples
        columns, rows = (max(2, int(math.ceil(side / cell - 1e-9)) + 1) for side in high - low)
        places = [(float(low[0] + i * cell), float(low[1] + j * cell)) for j in range(rows) for i in range(columns)]
        values = numpy.array([positive('size(%g, %g)' % (x, y), size(x, y), 'm') for x, y in places])
        if values.min() >= cell or samples >= _MOST_SAMPLES:
            return float(low[0]), float(low[1]), cell, columns, values
        samples *= 2


class Outline:
    """An outline, its holes, and the flags of `smooth`: True, False, or an array by point."""

    def __init__(self, points: numpy.ndarray, holes: list[numpy.ndarray], smooth: Any) -> None:
        self.points, self.holes, self.smooth = points, holes, smooth

    def simplified(self, tolerance: float) -> Outline:
        """The Outline without redundant points, as by addPolygon's `simplify`."""
        isOne = isinstance(self.smooth, bool)
        points, holes, flags = simplified(self.points, self.holes, tolerance, None if isOne else self.smooth)
        return Outline(points, holes, self.smooth if isOne else flags)

    def snapped(self, fe: FESolver, tolerance: float, size: float, matches: bool) -> tuple[Outline, Any]:
        """(Outline on the present bodies of `fe`, an object with moved, inserted and farthest)."""
        done = fe._snap(self.points, self.holes, tolerance, _SPACING * size, matches)
        outer, *holes = done.loops
        vertex, smooth = outer.vertex, self.smooth
        if not isinstance(smooth, bool):
            if isClockwise(self.points):  # the result has it reversed, with the same first point
                smooth = smooth[-numpy.arange(len(smooth)) % len(smooth)]
            within = smooth[vertex] & numpy.roll(smooth, -1)[vertex]
            smooth = numpy.where(outer.isInserted == 1, within, smooth[vertex])
        return Outline(outer.points, [hole.points for hole in holes], smooth), done


class Meshing:
    """The checked arguments of polygonMesh.

    outline         an Outline
    size            the smallest size (m)
    lines           (k, 4) joints
    jointTolerance  m
    """

    def __init__(self, outline: Any, holes: Any, size: Any, mesh: str | None, meshSeed: int, smooth: Any,
                 simplify: float | None, joints: Any, jointTolerance: float | None, material: Any = None) -> None:
        points = pointsOf('outline', outline, 3)
        loops = holesOf(holes)
        self.outline = Outline(points, loops, smoothFlags(smooth, len(points)))
        if simplify is not None:
            self.outline = self.outline.simplified(simplify)
        self.lines = _jointLines(joints)
        if mesh is not None and (not isinstance(mesh, str) or mesh not in ('regular', 'irregular')):
            refuse('mesh', mesh, "'regular', 'irregular' or None")
        # None: irregular for a body that can crack, or whose materials are known only after meshing.
        self._irregular = mesh == 'irregular' if mesh else isField(material) or mayCrack(material)
        self._sizes = _sizeOf(size, self.outline.points)
        self.size = float(numpy.min(self._sizes[-1]))
        self.jointTolerance = _JOINTS * self.size if jointTolerance is None else jointTolerance
        self._seed = whole('meshSeed', meshSeed, least=0, right='a whole number, 0 or more', most=2**63 - 1)

    def mesh(self, outline: Outline, jointTolerance: float) -> Mesh:
        made = _yadefrag.meshOfPolygon(outline.points, outline.holes, self._sizes, self._irregular, self._seed,
                                       self.lines, jointTolerance)
        made.smooth = smoothNodes(outline.smooth, made, outline.points)
        return made


def polygonMesh(outline: ArrayLike, holes: Iterable[ArrayLike] = (), *, size: float | ByPlace,
                mesh: str | None = 'irregular', meshSeed: int = 0, smooth: bool | Sequence[bool] = False,
                simplify: float | None = None, joints: Iterable[Sequence[ArrayLike]] = (),
                jointTolerance: float | None = None) -> Mesh:
    """The Mesh of a polygon, for one or several bodies: `fe.addMesh(polygonMesh(outline, size=.1), material)`.

    {arguments}
    mesh            'irregular': edges in all directions, for cracks that do not follow the mesh;
                    'regular', None: rows of nearly equilateral triangles, whose edges have few directions
    jointTolerance  m, of `joints`; None: 0.1 of the smallest size; 0: rounding only
    ValueError for an outline that addPolygon would refuse.
    """
    if jointTolerance is not None:
        jointTolerance = number('jointTolerance', jointTolerance, lambda v: 0 <= v < float('inf'),
                                '0, a positive number (m), or None')
    meshing = Meshing(outline, holes, size, mesh, meshSeed, smooth, simplify, joints, jointTolerance)
    made = meshing.mesh(meshing.outline, meshing.jointTolerance)
    made._meshing = meshing
    count, farthest = made.joined
    if count:
        warn('polygonMesh: of the joints, %d ends, crossings and bends near another line were joined with it, and '
             'moved by at most %.3g m, %.2g of the size (jointTolerance=).' %
             (count, farthest, farthest / meshing.size))
    return made


polygonMesh.__doc__ = withArguments(polygonMesh.__doc__)
