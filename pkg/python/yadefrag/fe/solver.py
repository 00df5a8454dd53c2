"""Methods of FESolver in Python: outlines, meshes, materials, functions of (x, y).

All arguments are checked before anything in the scene changes; ValueError states in one sentence what
was given and what is valid.
"""

import functools
import math

import numpy

from yade import wrapper
from yadefrag import _yadefrag
from yadefrag.arguments import array, flag, number, pair, pointsOf, positive, real, refuse, shown, whole
from yadefrag.calls import inWords
from yadefrag.fe import guards
from yadefrag.fe.between_steps import betweenSteps, requireBetweenSteps
from yadefrag.fe.bonds import bond, bondAll
from yadefrag.fe.contents import shownTriangles
from yadefrag.fe.loads import absorb, getLoads, pressure, relax, setLoads
from yadefrag.fe.materials import Materials, interfaces, isField, oneMaterial
from yadefrag.fe.mesh_values import (brittlePlaces, field, heldNodes, smoothFlags, smoothNodes,
                                     stressOfTriangles)
from yadefrag.fe.meshing import isIrregular, jointLines, leastSize, meshOfPolygon, sizeOf
from yadefrag.fe.motions import keepTurning, prescribe, rotate
from yadefrag.fe.names import componentOf, newName, nodesOf
from yadefrag.fe.quality import meshQuality
from yadefrag.fe.results import contactForce, crackCounts, energy, principalStress, reaction
from yadefrag.fe.snapping import (Outline, Overlap, addSnapped, costAdvice, jointToleranceOf, snapTolerance,
                                  tellJoined, tooLarge)
from yadefrag.io.mesh_checks import requireApart
from yadefrag.messages import forget, noteFixed, warnOfOne
from yadefrag.scene.scene_check import addSolver

_ELEMENTS = ('linear', 'smoothed')


def _centroid(nodes, triangles):
    corners = nodes[triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return (corners.mean(axis=1) * areas[:, None]).sum(axis=0) / areas.sum()


def _add(fe, mesh, smooth, materials, velocity, spin, displacement, stress, fixed, thickness,
         selfContact, element, places, name):
    requireBetweenSteps()
    name = newName(fe, name)
    if not isinstance(element, str) or element not in _ELEMENTS:
        refuse('element', element, "'linear' or 'smoothed'")
    nodes, triangles = mesh['nodes'], mesh['triangles']
    spin = number('spin', spin, math.isfinite, 'a finite number (rad/s)')
    selfContact = flag('selfContact', selfContact)
    thickness = positive('thickness', thickness, 'm')
    moved = field('displacement', displacement, nodes)
    stressed = stressOfTriangles(stress, mesh)
    given = field('velocity', velocity, nodes, isOptional=False)
    present = nodes + moved if len(moved) else nodes
    centroid = _centroid(present, triangles) if spin else numpy.zeros(2)
    arm = present - centroid
    speed = given + spin * numpy.stack([-arm[:, 1], arm[:, 0]], axis=1) if spin else given
    held = heldNodes(fixed, nodes)

    def raw(values, dtype):
        return numpy.ascontiguousarray(values, dtype=dtype).tobytes()

    if not len(fe.masses):
        forget()  # messages of another solver
    component, overlap, depth = fe._addMesh(
        dict(nodes=raw(nodes, 'float64'), triangles=raw(triangles, 'uint32'),
             loops=[raw(loop, 'uint32') for loop in mesh['loops']],
             velocity=raw(speed, 'float64'), displacement=raw(moved, 'float64'),
             stress=raw(stressed, 'float64'), held=raw(held, 'uint8'), smooth=raw(smooth, 'uint8'),
             thickness=thickness, selfContact=selfContact, smoothed=element == 'smoothed',
             name=name, materials=materials.of, materialOf=raw(materials.numbers, 'uint32'),
             **{name: raw(values, kind) for name, (values, kind) in places.items()}))
    if overlap:
        raise Overlap(overlap, depth)
    addSolver(fe)
    if fixed is not None:
        noteFixed(fixed, component, held.any())
    keepTurning(fe, component, held, given, spin, present, centroid)
    problem = fe._zoneWarning(component)
    if problem:
        warnOfOne(problem, 'bodies', component)
    return component


def addPolygon(self, outline, holes=(), *, size, material, smooth=False, velocity=(0, 0), spin=0,
               displacement=None, stress=None, fixed=None, thickness=1, selfContact=True,
               element='linear', mesh=None, meshSeed=0, simplify=None, strength=None, fractureEnergy=None,
               joints=(), jointStrength=0, jointEnergy=None, interfaceStrength=None,
               interfaceEnergy=None, name=None, snap=None):
    """Adds a plane body, meshed with triangles; returns its number (int).

    outline, holes  list of points (x, y) in m, and a list of such lists
    size            length of the triangles' edges (m), or a function (x, y) → m. The function is
                    sampled on a grid of at least 128 and at most 1024 cells along the longer side.
                    Where it grows by more than 0.25 m per metre, it is lowered to that.
    material        an FEMat, its label or its number in O.materials, with its present values: later
                    changes have no effect on the body. Or several: a function (x, y) that returns one,
                    called at the triangles' centroids; a list with one for each triangle; or a pair
                    of a list of materials and an array of numbers in it, one for each triangle.
                    If `joints` has lines along the interfaces, sides of triangles lie on these. An
                    edge between two materials has the fracture properties of the one with the smaller
                    tensileStrength, with the smaller energy and friction; surfaces have the smallest
                    friction of all. With several materials `element` must be 'linear'
    smooth          False: straight boundary; True: C¹-smooth everywhere, inside the outline; or
                    one flag per point of the outline (the holes are then straight): True: the corner
                    there is smoothed
    velocity        (x, y) in m/s, or a function (x, y) → pair
    spin            rad/s about the centroid, added to `velocity`
    displacement    None, or a function (x, y) → pair: the start's displacement from the stress-free
                    shape, which is the outline (m)
    stress          None, or the initial stress of the body in its given shape (Pa; xx, yy, xy; tension
                    positive, as in fe.stress): one triple, a function (x, y) → triple, called at the
                    triangles' centroids, or an array (m, 3) by triangle; e.g. the state of rock before
                    an excavation. The outline is the stressed shape; the stress-free one is computed
                    from it, triangle by triangle; density is that of the stress-free material. The
                    body is at rest if stresses and loads are in equilibrium: hold its boundary with
                    `fixed`, or load it with `pressure` or `loads`. Not together with displacement
    fixed           None, or a function (x, y) that returns False, True, 'x' or 'y': the directions
                    in which a node there keeps its velocity, independently of forces. If the nodes
                    held in both directions start with the velocities of a rotating rigid body, by
                    `spin` or a function, they continue to rotate, exactly as with `rotate`: about the
                    centroid, which moves at `velocity`, or about the point where the function is 0
    thickness       m
    selfContact     True: the body's surfaces may touch each other. A BrittleFEMat needs this for its
                    fragments: False is refused
    element         'linear': triangles of constant strain, too stiff in bending and for a poisson
                    near 0.5 if there are few of them; 'smoothed': the same triangles and nodes,
                    with the volume strain and 0.4 of the shear strains averaged at the nodes
                    (after Dohrmann et al. 2000, Int. J. Numer. Meth. Eng. 47, 1549, and Liu et al.
                    2008, Comput. Methods Appl. Mech. Eng. 197, 3883), for bodies that bend. A crack
                    separates averages, and the strain energy increases by the difference: 1 % of the
                    energy in impacts with hundreds of cracks, in energy['fracture']
    mesh            'regular': rows of nearly equilateral triangles, whose edges have few
                    directions; 'irregular': edges in all directions, for cracks that do not
                    follow the mesh; None: 'irregular' for a BrittleFEMat or several materials,
                    otherwise 'regular'
    meshSeed        seed of an irregular mesh: the same outline, size and seed give the same mesh
    simplify        None: the outline as given; or the permitted distance (m) of its points, and those
                    of the holes, from the meshed outline: redundant points are removed before meshing,
                    e.g. those of a contour of pixels. No edges cross by it; corners between edges much
                    longer than the distance are kept, and so are straight corners that are next to
                    smooth ones in `smooth`. It must be less than the area over the length of the
                    outline and of each hole. By squared distances (Dyken, Dæhlen and Sevaldrud 2009,
                    J. Geogr. Syst. 11, 273)
    strength        None: the tensileStrength of the BrittleFEMat; or a function (x, y) → Pa, or an
                    array with one value for each triangle, instead. The function is called at the
                    triangles' centroids. An edge has the smaller of its two triangles' strengths,
                    and the material's scatter is about that value
    fractureEnergy  None: that of the BrittleFEMat; or a function (x, y) → J/m², or an array,
                    likewise; where it is 0, cracks open at once
    joints          list of pairs of points ((x, y), (x, y)) in m: sides of triangles lie on these
                    lines. Lines may cross each other and the outline; parts outside are ignored.
                    Ends and crossings nearer than `snap` to each other, to another line or to the
                    outline are joined; a warning states how many and how far
    jointStrength   Pa, for all joints or one for each, of a BrittleFEMat, without scatter; 0: open
                    from the start, an existing crack, not counted by numCracks; None: that of the
                    adjacent triangles; the joint then only shapes the mesh
    jointEnergy     J/m², likewise; None: that of the adjacent triangles
    interfaceStrength  Pa, of edges between two materials, without scatter: a number, a function
                    (x, y) called at their middles, or a dict {(material, material): number}; 0:
                    open from the start; None, and pairs that are not in the dict: that of the weaker
                    material. Materials without fracture can crack there. The strength of a joint
                    has priority
    interfaceEnergy J/m², likewise
    name            None, or a text that may replace the body's number in all functions
    snap            None: an outline that overlaps the bodies beside it by at most 0.05 of `size`, as by
                    rounded coordinates, is moved off them, by at most 0.1 of it; 0: it is refused.
                    Or m: vertices within this distance of the bodies that are there are moved onto
                    their nearest node, or else onto their nearest side, and the outline gets their
                    nodes on its edges; gaps are closed, too. A warning states how many vertices
                    were moved and how far. For a set of outlines, see also snapOutlines. It is
                    also the tolerance of `joints`: for None, 0.1 of `size`; for 0, rounding only
    size and material may also come by position: addPolygon(outline, size, material), or
    addPolygon(outline, holes, size, material). Other functions are called at the nodes of the stress-free
    shape. ValueError before any change, also if the body would overlap another one; TypeError for
    arguments that are missing or unknown; RuntimeError while O.run is running in the background; a
    warning if the mesh is too coarse for the energy of a BrittleFEMat's cracks, and one if short edges
    of the outline reduce the time step much. Of several such warnings the first one is given, and before
    the run the number of bodies that have it.
    """
    points = pointsOf('outline', outline, 3)
    try:
        loops = None if isinstance(holes, (str, bytes, dict, set)) else list(holes)
    except TypeError:
        loops = None
    if loops is None:
        refuse('holes', holes, 'a list of loops of points (x, y) in m')
    holePoints = [pointsOf('holes[%d]' % i, loop, 3) for i, loop in enumerate(loops)]
    smooth = smoothFlags(smooth, len(points))
    material = material if isField(material) else oneMaterial(material)
    outline = Outline(points, holePoints, smooth)
    if simplify is not None:
        outline = outline.simplified(simplify)
    lines = jointLines(joints)
    irregular = isIrregular(mesh, material)
    wanted = sizeOf(size, outline.points)
    snap = snapTolerance(snap, displacement)
    smallest = leastSize(wanted)
    jointTolerance = jointToleranceOf(snap, smallest)
    used = []

    def meshOf(shape, tolerance):
        return meshOfPolygon(shape.points, shape.holes, wanted, irregular, meshSeed, lines, tolerance)

    def add(shape):
        made = meshOf(shape, jointTolerance)
        used[:] = shape, made
        smoothed = smoothNodes(shape.smooth, made, shape.points)
        materials = Materials(made, material)
        between = interfaces(made, materials, interfaceStrength, interfaceEnergy)
        places = brittlePlaces(made, materials, between, strength, fractureEnergy, lines,
                               jointStrength, jointEnergy)
        return _add(self, made, smoothed, materials, velocity, spin, displacement, stress, fixed,
                    thickness, selfContact, element, places, name)

    body = addSnapped(self, outline, snap, smallest, displacement, add)
    tellJoined(body, *used[1]['joined'], smallest)
    costly = self._costlyStepWarning(body, smallest)
    if costly:
        sentence = tooLarge(smallest, used[0].points) or '%s %s' % (costly, costAdvice(
            self, body, smallest, used[0], len(lines) > 0, jointTolerance, meshOf))
        warnOfOne('addPolygon: ' + sentence, 'bodies', body)
    return body


def addTriangles(self, nodes, triangles, material, *, smooth=False, velocity=(0, 0), spin=0,
                 displacement=None, stress=None, fixed=None, thickness=1, selfContact=True,
                 element='linear', strength=None, fractureEnergy=None, interfaceStrength=None,
                 interfaceEnergy=None, name=None):
    """Adds a body with a given mesh; returns its number (int).

    nodes (n, 2) in m, or (n, 3) of one z, which is ignored, all of them used; triangles (m, 3) node
    numbers, counter-clockwise. `smooth` is True or False; all other arguments, including materials by
    triangle, as in addPolygon. ValueError before any change.
    """
    points = pointsOf('nodes', _withoutHeight(nodes), 3)
    corners = array(triangles)
    if corners is None or corners.ndim != 2 or corners.shape[1] != 3 or len(corners) == 0 \
            or not numpy.issubdtype(corners.dtype, numpy.integer):
        raise ValueError('triangles must be an array (m, 3) of node numbers.')
    if corners.min() < 0 or corners.max() >= len(points):
        raise ValueError('triangles has node numbers from %d to %d, but there are %d nodes.' %
                         (corners.min(), corners.max(), len(points)))
    smooth = flag('smooth', smooth)
    mesh = dict(nodes=points, triangles=corners, loops=_boundaryLoops(points, corners))
    requireApart(points, corners, mesh['loops'])
    materials = Materials(mesh, material)
    between = interfaces(mesh, materials, interfaceStrength, interfaceEnergy)
    places = brittlePlaces(mesh, materials, between, strength, fractureEnergy)
    return _add(self, mesh, smoothNodes(smooth, mesh), materials, velocity, spin, displacement,
                stress, fixed, thickness, selfContact, element, places, name)


def _withoutHeight(nodes):
    """Points of three columns, as other programs have them, without z if it is the same for all."""
    found = array(nodes, float)
    isFlat = found is not None and found.ndim == 2 and found.shape[1] == 3 and len(found) > 0 \
        and (found[:, 2] == found[0, 2]).all()
    return found[:, :2] if isFlat else nodes


def _boundaryLoops(points, triangles):
    """The closed loops of edges that belong to one triangle only, material on the left."""
    used = numpy.zeros(len(points), dtype=bool)
    used[triangles] = True
    if not used.all():
        raise ValueError('node %d belongs to no triangle.' % int(numpy.argmin(used)))
    edges = [(int(t[i]), int(t[(i + 1) % 3])) for t in triangles for i in range(3)]
    known = set(edges)
    if len(known) != len(edges):
        raise ValueError('two triangles have the same edge in the same direction: all must be '
                         'counter-clockwise, and no edge can have three.')
    after = {}
    for a, b in edges:
        if (b, a) in known:
            continue
        if a in after:
            raise ValueError('the boundary passes twice through node %d at (%g, %g): give each part that '
                             'touches the others there only a node of its own.' % (a, *points[a]))
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


def _arrangedPolygon(self, outline=None, *others):
    """(outline, size, material) or (outline, holes, size, material): a size is a number or a function."""
    isSize = bool(others) and (callable(others[0]) or real(others[0]) is not None)
    names = ('size', 'material') if isSize else ('holes', 'size', 'material')
    first = (self,) if outline is None else (self, outline)
    if len(others) > len(names):
        raise TypeError('addPolygon takes outline, size and material, or outline, holes, size and material, '
                        'by position, but %d are given: write the others with their names, smooth=...' %
                        (1 + len(others)))
    return first, dict(zip(names, others))


def _guardFragments(fragments):
    @functools.wraps(fragments)
    def guarded(self, held=True):
        return fragments(self, flag('held', held))

    guarded.__qualname__ = 'FESolver.fragments'
    return guarded


def _minAngle(self):
    """Smallest angle (rad) of any triangle at present; inf without bodies."""
    with betweenSteps(self):
        corners = self.nodes[self.triangles[shownTriangles(self)]]
    if not len(corners):
        return math.inf
    edges = numpy.roll(corners, -1, axis=1) - corners
    lengths = numpy.linalg.norm(edges, axis=2)
    a, b, c = lengths.T
    # The smallest angle is opposite to the shortest edge; by the law of cosines.
    short, middle, long = numpy.sort(numpy.stack([a, b, c]), axis=0)
    cosine = (middle**2 + long**2 - short**2) / (2 * middle * long)
    return float(numpy.arccos(numpy.clip(cosine, -1, 1)).min())


def rectangleMesh(low, high, nx, ny, crossed=False):
    """A regular mesh for addTriangles: (nodes (n, 2), triangles (m, 3)) of nx × ny quads.

    Each quad is divided in two triangles, with diagonals of neighbours mirrored, or in four
    (`crossed`).
    """
    low, high = pair('low', low), pair('high', high)
    nx, ny, crossed = whole('nx', nx), whole('ny', ny), flag('crossed', crossed)
    if not (low[0] < high[0] and low[1] < high[1]):
        raise ValueError('high is %s, it must be right of and above low, %s.' %
                         (shown(high), shown(low)))
    mesh = _yadefrag.meshOfRectangle(*low, *high, nx, ny, crossed)
    return mesh['nodes'], mesh['triangles']


def install():
    """Adds the methods to FESolver, and prevents O.bodies.erase and clumps from using its
    bodies."""
    wrapper.FESolver.addPolygon = inWords(addPolygon, _arrangedPolygon)
    for method in (addTriangles, bond, bondAll, prescribe, rotate, nodesOf, componentOf, pressure, absorb,
                   relax, reaction, contactForce, meshQuality):
        setattr(wrapper.FESolver, method.__name__, inWords(method))
    for name, read in (('principalStress', principalStress), ('crackCounts', crackCounts), ('minAngle', _minAngle),
                       ('energy', energy)):
        setattr(wrapper.FESolver, name, property(read, doc=read.__doc__))
    wrapper.FESolver.loads = property(getLoads, setLoads, doc=getLoads.__doc__)
    wrapper.FESolver.fragments = inWords(_guardFragments(wrapper.FESolver.fragments))
    guards.install()
