"""What FESolver takes from a script: outlines, meshes, materials, functions of (x, y).

Everything is checked before anything in the scene changes; ValueError says in one sentence what was
given and what would be right.
"""

import math
import numbers
import warnings

import numpy

from yade import wrapper
from yadefrag import _yadefrag
from yadefrag.guards import guardClump, guardErase, guardRemove, requirePaused
from yadefrag.shown import shownTriangles

_HELD = {False: 0, None: 0, 'x': 1, 'y': 2, 'xy': 3, 'yx': 3, True: 3}


def _number(name, value, isRight, right):
    if isinstance(value, bool) or not isinstance(value, numbers.Real) or not isRight(value):
        raise ValueError('%s is %r, it must be %s.' % (name, value, right))
    return float(value)


def _positive(name, value, unit):
    return _number(name, value, lambda v: math.isfinite(v) and v > 0,
                   'a positive number (%s)' % unit)


def _points(name, value, least):
    """(n, 2) floats, finite, of at least `least` points."""
    try:
        points = numpy.array([(float(x), float(y)) for x, y in value], dtype=float)
    except (TypeError, ValueError):
        raise ValueError('%s must be a list of points (x, y) in m.' % name) from None
    if len(points) < least:
        raise ValueError('%s has %d points, it must have at least %d.' %
                         (name, len(points), least))
    if not numpy.isfinite(points).all():
        bad = int(numpy.nonzero(~numpy.isfinite(points).all(axis=1))[0][0])
        raise ValueError('%s has a point %d at %r, which is not finite.' %
                         (name, bad, tuple(points[bad])))
    return points


def _pair(name, value):
    try:
        x, y = value
        pair = (float(x), float(y))
    except (TypeError, ValueError):
        raise ValueError('%s is %r, it must be a pair of numbers.' % (name, value)) from None
    if not all(map(math.isfinite, pair)):
        raise ValueError('%s is %r, both numbers must be finite.' % (name, value))
    return pair


def _material(material):
    """The FEMat that `material` names: the object, its label or its number in O.materials."""
    found = material
    if isinstance(material, (str, numbers.Integral)) and not isinstance(material, bool):
        try:
            found = wrapper.Omega().materials[material]
        except (KeyError, IndexError, RuntimeError):
            raise ValueError('material is %r, which is not in O.materials.' % (material,)) from None
    if not isinstance(found, wrapper.FEMat):
        raise ValueError('material is %r, it must be an FEMat, its label or its number in '
                         'O.materials.' % (material,))
    _positive("the material's young", found.young, 'Pa')
    _positive("the material's density", found.density, 'kg/m³')
    _number("the material's poisson", found.poisson, lambda v: -1 < v < .5,
            'above -1 and below 0.5')
    _number("the material's frictionAngle", found.frictionAngle, lambda v: 0 <= v < math.pi / 2,
            'at least 0 and below π/2 (rad)')
    return found


def _field(name, value, nodes, isOptional=True):
    """(n, 2) from a pair or a function (x, y) → pair; empty for None."""
    if value is None and isOptional:
        return numpy.empty((0, 2))
    if not callable(value):
        return numpy.tile(_pair(name, value), (len(nodes), 1))
    return numpy.array([_pair('%s(%g, %g)' % (name, x, y), value(x, y)) for x, y in nodes])


def _heldNodes(fixed, nodes):
    """(n) of 0 free, 1 held in x, 2 in y, 3 in both."""
    if fixed is None:
        return numpy.empty(0, dtype=numpy.uint8)
    if not callable(fixed):
        raise ValueError("fixed is %r, it must be a function (x, y) that returns False, True, 'x' "
                         "or 'y'." % (fixed,))
    held = numpy.zeros(len(nodes), dtype=numpy.uint8)
    for i, (x, y) in enumerate(nodes):
        value = fixed(x, y)
        if isinstance(value, numpy.bool_):
            value = bool(value)
        if not isinstance(value, (bool, str, type(None))) or value not in _HELD:
            raise ValueError("fixed(%g, %g) is %r, it must be False, True, 'x' or 'y'." %
                             (x, y, value))
        held[i] = _HELD[value]
    return held


def _smoothNodes(smooth, mesh, outline=()):
    """(n) of 0 or 1: is the node on a smooth part of the boundary; empty for none at all."""
    if isinstance(smooth, (bool, numpy.bool_)):
        if not smooth:
            return numpy.empty(0, dtype=numpy.uint8)
        chosen = [(loop, numpy.ones(len(loop), dtype=bool)) for loop in mesh['loops']]
    else:
        try:
            flags = numpy.array([bool(s) for s in smooth])
        except TypeError:
            raise ValueError('smooth is %r, it must be True, False or a flag for each point of the '
                             'outline.' % (smooth,)) from None
        count = len(outline)
        if len(flags) != count:
            raise ValueError('smooth has %d flags, it must have one for each of the %d points of '
                             'the outline.' % (len(flags), count))
        if _isClockwise(outline):  # the mesh has it the other way round, with the same first point
            flags = flags[-numpy.arange(count) % count]
        loop, vertices = mesh['loops'][0], mesh['loopVertices'][0]
        # A node within an edge is smooth where the edge's two ends are.
        isVertex = vertices != numpy.roll(vertices, 1)
        ends = flags[vertices] & flags[(vertices.astype(int) + 1) % count]
        chosen = [(loop, numpy.where(isVertex, flags[vertices], ends))]
    marks = numpy.zeros(len(mesh['nodes']), dtype=numpy.uint8)
    for loop, flags in chosen:
        marks[loop] = flags
    return marks


def _isClockwise(points):
    x, y = (points - points[0]).T
    return float((x * numpy.roll(y, -1) - y * numpy.roll(x, -1)).sum()) < 0


def _centroid(nodes, triangles):
    corners = nodes[triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return (corners.mean(axis=1) * areas[:, None]).sum(axis=0) / areas.sum()


def _add(fe, mesh, smooth, material, velocity, spin, displacement, fixed, thickness, selfContact):
    requirePaused()
    nodes, triangles = mesh['nodes'], mesh['triangles']
    spin = _number('spin', spin, math.isfinite, 'a finite number (rad/s)')
    if not isinstance(selfContact, (bool, numpy.bool_)):
        raise ValueError('selfContact is %r, it must be True or False.' % (selfContact,))
    moved = _field('displacement', displacement, nodes)
    speed = _field('velocity', velocity, nodes, isOptional=False)
    if spin:
        present = nodes + moved if len(moved) else nodes
        arm = present - _centroid(present, triangles)
        speed = speed + spin * numpy.stack([-arm[:, 1], arm[:, 0]], axis=1)

    def raw(values, dtype):
        return numpy.ascontiguousarray(values, dtype=dtype).tobytes()

    number = fe._addMesh(
        dict(nodes=raw(nodes, 'float64'), triangles=raw(triangles, 'uint32'),
             loops=[raw(loop, 'uint32') for loop in mesh['loops']],
             velocity=raw(speed, 'float64'), displacement=raw(moved, 'float64'),
             held=raw(_heldNodes(fixed, nodes), 'uint8'), smooth=raw(smooth, 'uint8'),
             thickness=_positive('thickness', thickness, 'm'), selfContact=bool(selfContact),
             material=material))
    problem = fe._zoneWarning(number)
    if problem:
        warnings.warn(problem, stacklevel=3)
    return number


def addPolygon(self, outline, holes=(), *, size, material, smooth=False, velocity=(0, 0), spin=0,
               displacement=None, fixed=None, thickness=1, selfContact=True):
    """Adds a plane body, meshed with triangles; returns its number (int).

    outline, holes  list of points (x, y) in m, and a list of such lists
    size            length of the triangles' edges (m)
    material        an FEMat, its label or its number in O.materials; as it is now: later changes of
                    it have no effect on the body
    smooth          False: straight boundary; True: C¹-smooth everywhere; or one flag per point of
                    the outline (then the holes are straight): is the corner there smoothed
    velocity        (x, y) in m/s, or a function (x, y) → pair
    spin            rad/s about the centroid, added to `velocity`
    displacement    None, or a function (x, y) → pair: the start's displacement from the stress-free
                    shape, which is the outline (m)
    fixed           None, or a function (x, y) that returns False, True, 'x' or 'y': the directions
                    in which a node there keeps its velocity whatever forces act
    thickness       m
    selfContact     may the body's surfaces touch each other; those of a BrittleFEMat, whose
                    fragments have to, always do: False is refused
    Functions are called at the nodes of the stress-free shape. ValueError before anything changes,
    also where the body would overlap another one; RuntimeError while O.run goes on in the
    background; a warning where the mesh is too coarse for the energy of a BrittleFEMat's cracks.
    """
    points = _points('outline', outline, 3)
    try:
        holes = list(holes)
    except TypeError:
        raise ValueError('holes is %r, it must be a list of loops of points (x, y) in m.' %
                         (holes,)) from None
    holePoints = [_points('holes[%d]' % i, hole, 3) for i, hole in enumerate(holes)]
    size = _positive('size', size, 'm')
    material = _material(material)
    mesh = _yadefrag.meshOfPolygon(points.tobytes(), [h.tobytes() for h in holePoints], size)
    smoothed = _smoothNodes(smooth, mesh, points)
    return _add(self, mesh, smoothed, material, velocity, spin, displacement, fixed, thickness,
                selfContact)


def addTriangles(self, nodes, triangles, *, material, smooth=False, velocity=(0, 0), spin=0,
                 displacement=None, fixed=None, thickness=1, selfContact=True):
    """Adds a body of triangles of one's own; returns its number (int).

    nodes (n, 2) in m, all of them used; triangles (m, 3) node numbers, counter-clockwise. `smooth`
    is True or False; the rest is as in addPolygon. ValueError before anything changes.
    """
    points = _points('nodes', nodes, 3)
    corners = numpy.asarray(triangles)
    if corners.ndim != 2 or corners.shape[1] != 3 or len(corners) == 0 \
            or not numpy.issubdtype(corners.dtype, numpy.integer):
        raise ValueError('triangles must be an array (m, 3) of node numbers.')
    if corners.min() < 0 or corners.max() >= len(points):
        raise ValueError('triangles has node numbers from %d to %d, but there are %d nodes.' %
                         (corners.min(), corners.max(), len(points)))
    if not isinstance(smooth, (bool, numpy.bool_)):
        raise ValueError('smooth is %r, it must be True or False.' % (smooth,))
    material = _material(material)
    mesh = dict(nodes=points, triangles=corners, loops=_boundaryLoops(len(points), corners))
    return _add(self, mesh, _smoothNodes(smooth, mesh), material, velocity, spin, displacement,
                fixed, thickness, selfContact)


def _boundaryLoops(count, triangles):
    """The closed loops of edges that belong to one triangle, material on the left."""
    used = numpy.zeros(count, dtype=bool)
    used[triangles] = True
    if not used.all():
        raise ValueError('node %d belongs to no triangle.' % int(numpy.argmin(used)))
    edges = [(int(t[i]), int(t[(i + 1) % 3])) for t in triangles for i in range(3)]
    known = set(edges)
    if len(known) != len(edges):
        raise ValueError('two triangles run along the same edge in the same direction: all must be '
                         'counter-clockwise, and no edge can have three.')
    after = {}
    for a, b in edges:
        if (b, a) in known:
            continue
        if a in after:
            raise ValueError('the boundary passes twice through node %d.' % a)
        after[a] = b
    loops = []
    while after:
        first = min(after)
        loop, node = [], first
        while node in after:
            loop.append(node)
            node = after.pop(node)
        loops.append(numpy.array(loop))
    return loops


def _getLoads(self):
    """Constant outer forces on the nodes (N), array (n, 2); to be set as a whole, or None for none.

    A copy: `loads = fe.loads; loads[top] = (0, -1); fe.loads = loads`. ValueError unless there is
    one finite pair for each node.
    """
    return self._loads


def _setLoads(self, loads):
    requirePaused()
    try:
        values = numpy.zeros((0, 2)) if loads is None else numpy.asarray(loads, dtype=float)
    except (TypeError, ValueError):
        raise ValueError('loads is %r, it must be an array (n, 2) of N, or None.' %
                         (loads,)) from None
    if values.ndim != 2 or values.shape[1] != 2:
        raise ValueError('loads has the shape %r, it must be (n, 2).' % (values.shape,))
    self._setLoads(numpy.ascontiguousarray(values).tobytes())


def prescribe(self, nodes, vx=None, vy=None):
    """From now on the nodes move at vx, vy (m/s); None: free in that direction.

    nodes  node numbers, a flag for each node, or a function (x, y) → bool of the present positions.
    Call it again to change the motion, from a PyRunner for one that varies in time; the forces that
    it takes are in `energy['external']`. ValueError before anything changes.
    """
    requirePaused()
    places = self.nodes
    if callable(nodes):
        chosen = numpy.array([bool(nodes(x, y)) for x, y in places], dtype=bool)
    else:
        chosen = numpy.asarray(nodes)
    if chosen.dtype == bool:
        if chosen.shape != (len(places),):
            raise ValueError('nodes has %d flags, it must have one for each of the %d nodes.' %
                             (chosen.size, len(places)))
        chosen = numpy.nonzero(chosen)[0]
    if chosen.ndim != 1 or (chosen.size and not numpy.issubdtype(chosen.dtype, numpy.integer)):
        raise ValueError('nodes must be node numbers, a flag for each node, or a function (x, y).')
    if chosen.size and (chosen.min() < 0 or chosen.max() >= len(places)):
        raise ValueError('nodes has numbers from %d to %d, but there are %d nodes.' %
                         (chosen.min(), chosen.max(), len(places)))
    speeds = [0. if v is None else _number(name, v, math.isfinite, 'a finite number (m/s) or None')
              for name, v in (('vx', vx), ('vy', vy))]
    held = (0 if vx is None else 1) | (0 if vy is None else 2)
    self._prescribe(chosen.astype(numpy.uint32).tobytes(), held, *speeds)


def _minAngle(self):
    """Smallest angle (rad) of any triangle now; inf without bodies."""
    corners = self.nodes[self.triangles[shownTriangles(self)]]
    if not len(corners):
        return math.inf
    edges = numpy.roll(corners, -1, axis=1) - corners
    lengths = numpy.linalg.norm(edges, axis=2)
    a, b, c = lengths.T
    # Opposite the shortest edge; by the law of cosines.
    short, middle, long = numpy.sort(numpy.stack([a, b, c]), axis=0)
    cosine = (middle**2 + long**2 - short**2) / (2 * middle * long)
    return float(numpy.arccos(numpy.clip(cosine, -1, 1)).min())


def rectangleMesh(low, high, nx, ny, crossed=False):
    """A regular mesh for addTriangles: (nodes (n, 2), triangles (m, 3)) of nx × ny quads.

    Each is cut in two, the diagonals of neighbours mirrored, or in four (`crossed`).
    """
    low, high = _pair('low', low), _pair('high', high)
    for name, n in (('nx', nx), ('ny', ny)):
        if not isinstance(n, numbers.Integral) or isinstance(n, bool) or n < 1:
            raise ValueError('%s is %r, it must be a positive whole number.' % (name, n))
    if not (low[0] < high[0] and low[1] < high[1]):
        raise ValueError('high is %r, it must be right of and above low, %r.' % (high, low))
    mesh = _yadefrag.meshOfRectangle(*low, *high, int(nx), int(ny), bool(crossed))
    return mesh['nodes'], mesh['triangles']


def install():
    """Gives FESolver its methods, and keeps O.bodies.erase and clumps off its bodies."""
    wrapper.FESolver.addPolygon = addPolygon
    wrapper.FESolver.addTriangles = addTriangles
    wrapper.FESolver.prescribe = prescribe
    wrapper.FESolver.minAngle = property(_minAngle, doc=_minAngle.__doc__)
    wrapper.FESolver.loads = property(_getLoads, _setLoads, doc=_getLoads.__doc__)
    wrapper.FESolver.removeBody = guardRemove(wrapper.FESolver.removeBody)
    container = wrapper.BodyContainer
    container.erase = guardErase(container.erase)
    container.clump = guardClump(container.clump)
    container.addToClump = guardClump(container.addToClump)
