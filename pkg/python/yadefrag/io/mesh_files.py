"""Meshes from files of other programs, for FESolver.addTriangles; elements that are no proper ones are named."""

import os

import numpy

from yadefrag.arguments import File, path, positive, shownPath
from yadefrag.fe.mesh import MeshFile, cross
from yadefrag.io.readers import abaqus, cornersOf, counted, gmsh, orderOf, readable
from yadefrag.messages import warn

_READERS = {'.msh': gmsh.read, '.inp': abaqus.read}
_FLAT = 1e-9  # of the longest distance of two corners: points nearer to a line or plane are on it
_REMEDY = 'Correct it in the program that wrote the file.'


def readMesh(file: File, scale: float = 1) -> MeshFile:
    """A MeshFile from gmsh (.msh), Abaqus and CalculiX (.inp), and any format that meshio reads: VTK
    (.vtk, .vtu), Medit, Nastran ...

    file   its ending determines the format
    scale  m for one unit of the file
    Cohesive elements of Abaqus (COH2D4, COHAX4) between two others are joints with their strength and
    energy. Points of three columns are accepted if z is the same for all used ones. Of elements with nodes
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
    read = _READERS.get(os.path.splitext(name)[1].lower(), gmsh.readByMeshio)
    with readable(name, 'mesh'):
        elements = read(name)
    used = _usedPoints(elements, name)
    points = scale * _plane(numpy.asarray(elements.points, dtype=float), used, name)
    triangles, source, told = _trianglesOf(elements, points, name)
    told = elements.leftOut + told + _looseLines(elements, triangles)
    joints, laws = numpy.array(elements.joints[0], dtype=int).reshape(-1, 3), numpy.reshape(elements.joints[1], (-1, 2))
    if len(laws) and scale != 1:
        told.append('the units of strength and energy (N and mm: mesh.jointStrength *= 1e6; mesh.jointEnergy *= 1e3)')
    if told:
        warn('readMesh: %s: left out are %s.' % (shownPath(name), '; '.join(told)))
    corners, triangles = numpy.unique(triangles, return_inverse=True)
    if len(elements.points) > len(used):
        told.append('%s in no triangle or quad' % counted(len(elements.points) - len(used), 'point'))
    place = numpy.full(len(points), -1)
    place[corners] = numpy.arange(len(corners))
    groups, instances = (_ofTriangles(of, source) for of in (elements.groups, elements.instances))
    sets = {key: numpy.unique(place[nodes][place[nodes] >= 0]) for key, nodes in _nodeSets(elements)}
    joints[:, :2] = place[joints[:, :2]]
    return MeshFile(points[corners], triangles.reshape(-1, 3), groups, sets, instances, told, joints,
                    laws[:, 0], laws[:, 1], elements.axisymmetric)


def _plane(points, used, name):
    """(n, 2)."""
    if points.ndim != 2 or points.shape[1] not in (2, 3) or not numpy.isfinite(points[used]).all():
        raise ValueError('%s has points that are not finite, or none.' % shownPath(name))
    low, high = points[used].min(axis=0), points[used].max(axis=0)
    if points.shape[1] == 3 and high[2] - low[2] > _FLAT * (high - low)[:2].max():
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


def _usedPoints(elements, name):
    """Numbers of the points of triangles and quads, also those between corners. ValueError for solids and for kinds
    that are not known."""
    for kind, _, numbers in elements.blocks:
        if len(numbers) and not cornersOf(kind):
            shown = kind.rstrip('0123456789') if kind[0].islower() else kind
            raise ValueError("%s has elements of the kind '%s', %d of them, the first with the number %s; those of "
                             'a plane mesh are triangles and quads.' %
                             (shownPath(name), shown, len(numbers), elements.labels[numbers[0]]))
    parts = [numpy.zeros(0, dtype=int)]
    for kind, nodes, numbers in elements.blocks:
        if cornersOf(kind) < 3 or not len(numbers):
            continue
        nodes = numpy.asarray(nodes, dtype=int)
        isWrong = ((nodes < 0) | (nodes >= len(elements.points))).any(axis=1)
        if isWrong.any():
            raise ValueError('%s: element %s has a node that does not exist.' %
                             (shownPath(name), elements.labels[numbers[int(isWrong.argmax())]]))
        parts.append(nodes.ravel())
    used = numpy.unique(numpy.concatenate(parts))
    if not len(used):
        raise ValueError('%s has no triangles%s.' %
                         (shownPath(name), ''.join(', only ' + one for one in elements.leftOut[:1])))
    return used


def _trianglesOf(elements, points, name):
    """(triangles (m, 3) numbers of points, counter-clockwise; (m) number of the element of each; sentences
    about what is not as in the file). `points` (n, 2) in m. ValueError with the number of an element
    that is flat, collapsed, concave, doubled or inverted."""
    mesh = _Mesh(elements, points, name)
    found, source = [], []
    for kind, nodes, numbers in elements.blocks:
        count = cornersOf(kind)
        if count < 3 or not len(numbers):
            continue
        nodes, numbers = numpy.asarray(nodes, dtype=int), numpy.asarray(numbers)
        mesh.measureCurves(nodes, count, orderOf(kind))
        corners = nodes[:, :count]
        mesh.requireSingle(corners, numbers)
        if count == 4:
            corners, numbers = mesh.fromQuads(corners, numbers)
        found.append(corners)
        source.append(numbers)
    triangles, source = numpy.concatenate(found), numpy.concatenate(source)
    order = numpy.argsort(source, kind='stable')
    triangles, source = triangles[order], source[order]
    mesh.requireAreas(triangles, source)
    mesh.requireSingle(triangles, source)
    mesh.orient(triangles, source)
    return triangles, source, mesh.told


class _Mesh:
    def __init__(self, elements, points, name):
        self._labels, self._points, self._name = elements.labels, points, name
        self._places = numpy.asarray(elements.points, dtype=float)[:, :2]  # in units of the file, for messages
        self.told = []

    def _refuse(self, numbers, what):
        """ValueError for the first one of the elements `numbers`."""
        more = len(set(numpy.asarray(numbers).tolist())) - 1
        others = '; so is another one' if more == 1 else '; so are %d others' % more if more else ''
        raise ValueError('%s: element %s %s%s. %s' %
                         (shownPath(self._name), self._labels[numbers[0]], what, others, _REMEDY))

    def _at(self, node):
        return '(%g, %g)' % tuple(self._places[node])

    def measureCurves(self, nodes, count, order):
        """The distance of nodes between two corners from the straight line."""
        between = order - 1
        if not between or nodes.shape[1] < count * order:
            return
        places, most = self._points[nodes], numpy.zeros(len(nodes))
        for side in range(count):
            a, b = places[:, side], places[:, (side + 1) % count]
            length = numpy.maximum(numpy.linalg.norm(b - a, axis=1), 1e-300)
            for k in range(between):
                arm = places[:, count + side * between + k] - a
                most = numpy.maximum(most, numpy.abs(cross(arm, b - a)) / length)
        size = numpy.linalg.norm(places[:, 0] - places[:, 1], axis=1).max()
        isCurved = most > 1e-6 * size
        if isCurved.any():
            self.told.append('the curves of %s, whose sides are straight here (up to %.3g m beside the curve)' %
                             (counted(isCurved.sum(), 'element'), most.max()))

    def requireSingle(self, corners, numbers):
        """No two elements have the same corners."""
        _, first, which = numpy.unique(numpy.sort(corners, axis=1), axis=0, return_index=True, return_inverse=True)
        doubled = numpy.nonzero(first[which.ravel()] != numpy.arange(len(corners)))[0]
        if len(doubled):
            twin = numbers[first[which.ravel()[doubled[0]]]]
            self._refuse(numbers[doubled], 'is doubled: it has the corners of element %s' % self._labels[twin])

    def fromQuads(self, quads, numbers):
        """(triangles, numbers of their elements): each quad is divided along its shorter diagonal."""
        isEqual = quads == numpy.roll(quads, -1, axis=1)
        isTriangle = isEqual.sum(axis=1) == 1
        if isTriangle.any():
            self.told.append('the fourth corner of %s, the first with the number %s, which %s one corner twice' %
                             (counted(isTriangle.sum(), 'quad'), self._labels[numbers[isTriangle.argmax()]],
                              'has' if isTriangle.sum() == 1 else 'have'))
        triangles = quads[isTriangle][~isEqual[isTriangle]].reshape(-1, 3)
        order = self._diagonals(quads[~isTriangle], numbers[~isTriangle])
        cut = numpy.take_along_axis(quads[~isTriangle], order, axis=1).reshape(-1, 3)
        return (numpy.concatenate([triangles, cut]),
                numpy.concatenate([numbers[isTriangle], numpy.repeat(numbers[~isTriangle], 2)]))

    def _diagonals(self, quads, numbers):
        """(k, 6): corners of both triangles of each quad."""
        p = self._points[quads]
        first = numpy.linalg.norm(p[:, 2] - p[:, 0], axis=1)
        second = numpy.linalg.norm(p[:, 3] - p[:, 1], axis=1)
        sides = numpy.roll(p, -1, axis=1) - p
        turns = numpy.stack([cross(sides[:, i - 1], sides[:, i]) for i in range(4)], axis=1)
        lengths = numpy.linalg.norm(sides, axis=2)
        longest = numpy.maximum(numpy.maximum(first, second), lengths.max(axis=1))
        isShort = (lengths <= _FLAT * longest[:, None]).any(axis=1)
        isStraight = numpy.abs(turns) <= _FLAT * longest[:, None]**2
        signs = numpy.where(isStraight, 0, numpy.sign(turns))
        isFlat = (signs == 0).sum(axis=1) > 1
        if (isShort | isFlat).any():
            self._refuse(numbers[isShort | isFlat], 'is a collapsed quad: its corners are on a line, or two of them '
                         'at one place, near %s' % self._at(quads[(isShort | isFlat).argmax(), 0]))
        isCrossed = (signs > 0).sum(axis=1) == (signs < 0).sum(axis=1)
        if isCrossed.any():
            self._refuse(numbers[isCrossed], 'is a quad whose sides cross, near %s: its corners are in a wrong '
                         'order' % self._at(quads[isCrossed.argmax(), 0]))
        isInner = signs == -numpy.sign(signs.sum(axis=1))[:, None]
        if isInner.any():
            bad = isInner.any(axis=1)
            one = int(bad.argmax())
            self._refuse(numbers[bad], 'is a concave quad: it has a corner that points inwards at %s' %
                         self._at(quads[one, isInner[one].argmax()]))
        along = numpy.array([[0, 1, 2, 0, 2, 3]]), numpy.array([[0, 1, 3, 1, 2, 3]])
        isFirst = numpy.where(isStraight.any(axis=1), isStraight.argmax(axis=1) % 2 == 0, first <= second)
        return numpy.where(isFirst[:, None], *along)

    def requireAreas(self, triangles, source):
        a, b, c = self._points[triangles].transpose(1, 0, 2)
        longest = numpy.max([numpy.linalg.norm(side, axis=1) for side in (b - a, c - b, a - c)], axis=0)
        bad = numpy.nonzero(numpy.abs(cross(b - a, c - a)) <= _FLAT * longest**2)[0]
        if len(bad):
            places = ', '.join(self._at(node) for node in triangles[bad[0]])
            self._refuse(source[bad], 'is flat: its corners %s are on a line' % places)

    def orient(self, triangles, source):
        """Makes all counter-clockwise. Two such triangles with the same side in the same direction are on one
        side of it, and overlap."""
        a, b, c = self._points[triangles].transpose(1, 0, 2)
        isClockwise = cross(b - a, c - a) < 0
        triangles[isClockwise] = triangles[isClockwise][:, ::-1]
        starts, ends = triangles.ravel(), numpy.roll(triangles, -1, axis=1).ravel()
        _, first, which = numpy.unique(starts * len(self._points) + ends, return_index=True, return_inverse=True)
        twice = numpy.nonzero(first[which] != numpy.arange(len(starts)))[0]
        if not len(twice):
            return
        one, other = first[which[twice[0]]] // 3, twice[0] // 3
        isRare = isClockwise if isClockwise.mean() < .5 else ~isClockwise
        cause = 'overlaps'
        if isRare[one] != isRare[other]:
            cause = 'is inverted: its corners are in the other direction, and it overlaps'
            other, one = (other, one) if isRare[other] else (one, other)
        self._refuse([source[other]], '%s element %s, on the same side of their common side from %s to %s' %
                     (cause, self._labels[source[one]], self._at(starts[twice[0]]), self._at(ends[twice[0]])))
