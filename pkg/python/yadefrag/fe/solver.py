"""Methods of FESolver in Python: bodies from outlines and meshes.

All arguments are checked before anything in the scene changes; ValueError states in one sentence what
was given and what is valid.
"""

from __future__ import annotations

import functools
import inspect
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy

from yade import wrapper
from yadefrag.arguments import ArrayLike, ByPlace, FEMat, FESolver, anyNumber, flag, number, real, refuse
from yadefrag.fe.contents import (betweenSteps, bodyNumber, componentOf, newName, nodesOf, requireBetweenSteps,
                                  shownTriangles)
from yadefrag.fe.fields import contactForce, crackCounts, energy, meshQuality, principalStress, reaction
from yadefrag.fe.loads import absorb, getLoads, pressure, relax, setLoads
from yadefrag.fe.mesh import Mesh, MeshFile, Meshing, asMesh, withArguments
from yadefrag.fe.mesh_values import (Materials, brittlePlaces, field, heldNodes, interfaces, isField, oneMaterial,
                                     smoothNodes, stressOfTriangles)
from yadefrag.fe.motions import keepTurning, prescribe, rotate
from yadefrag.fe.neighbours import Overlap, addSnapped, bond, bondAll, snapTolerance, tellCostly, tellJoined
from yadefrag.messages import forget, checkedCall, noteFixed, warn, warnOfOne
from yadefrag.scene import scene_check

_ELEMENTS = ('linear', 'smoothed')


def _requireRound(spin, thickness):
    """Of a body around an axis."""
    if spin:
        refuse('spin', spin, '0 around an axis: a body that turns in the plane is no ring')
    if thickness != 1:
        refuse('thickness', thickness, 'left out around an axis: a body is a full turn')


def _centroid(nodes, triangles):
    corners = nodes[triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return (corners.mean(axis=1) * areas[:, None]).sum(axis=0) / areas.sum()


def _add(fe: FESolver, mesh: Mesh, material: Any, *, smooth: Any = None, velocity: ArrayLike | ByPlace = (0, 0),
         spin: float = 0, displacement: ByPlace | None = None, stress: ArrayLike | ByPlace | None = None,
         fixed: ByPlace | None = None, thickness: float = 1, selfContact: bool = True, element: str | None = None,
         strength: ArrayLike | ByPlace | None = None, fractureEnergy: ArrayLike | ByPlace | None = None,
         jointStrength: ArrayLike | None = 0, jointEnergy: ArrayLike | None = None,
         interfaceStrength: float | ByPlace | dict[tuple, float] | None = None,
         interfaceEnergy: float | ByPlace | dict[tuple, float] | None = None, name: str | None = None) -> int:
    """material        an FEMat, its label or its number in O.materials, with its present values: later
                    changes have no effect on the body. Or several: a function (x, y) that returns one,
                    called at the triangles' centroids; a list with one for each triangle; or a pair
                    of a list of materials and an array of numbers in it, one for each triangle.
                    If `joints` has lines along the interfaces, sides of triangles lie on these. An
                    edge between two materials has the fracture properties of the one with the smaller
                    tensileStrength, with the smaller energy and friction; surfaces have the smallest
                    friction of all. With several materials `element` must be 'linear'
    velocity        (x, y) in m/s, or a function (x, y) → pair
    spin            rad/s about the centroid, added to `velocity`
    displacement    None, or a function (x, y) → pair: the start's displacement from the stress-free
                    shape, which is the outline (m)
    stress          None, or the initial stress of the body in its given shape (Pa; xx, yy, xy, and, if
                    it is given, zz across the plane; tension positive, as in fe.stress): three or four
                    numbers, a function (x, y) → these, called at the triangles' centroids, or an array
                    (m, 3) or (m, 4) by triangle; e.g. the state of rock before an excavation. Without
                    zz it is poisson*(xx + yy), and (xx + yy)/2 for materials that yield: even pressure
                    in the plane is even in space. A warning says if it yields. The outline is the
                    stressed shape; the stress-free one is computed from it, triangle by triangle;
                    density is that of the stress-free material. The body is at rest if stresses and loads are in equilibrium: hold its boundary with
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
                    energy in impacts with hundreds of cracks, in energy['fracture']. None: 'linear', but
                    'smoothed' for a material that yields, of which only the volume strain is
                    averaged (Bonet and Burton 1998, Commun. Numer. Meth. Eng. 14, 437), in plane
                    strain: linear triangles lock in plastic flow
    strength        None: the tensileStrength of the BrittleFEMat; or a function (x, y) → Pa, or an
                    array with one value for each triangle, instead. The function is called at the
                    triangles' centroids. An edge has the smaller of its two triangles' strengths,
                    and the material's scatter is about that value. Of a PlasticFEMat that fails:
                    a factor of its failure strain and spallStress
    fractureEnergy  None: that of the material; or a function (x, y) → J/m², or an array,
                    likewise; where it is 0, cracks open at once
    jointStrength   Pa, for all joints or one for each, without scatter; 0: open from the start, an
                    existing crack, not counted by numCracks; None: that of the adjacent triangles;
                    the joint then only shapes the mesh. An FEMat cracks at its joints only
    jointEnergy     J/m², likewise; None: that of the adjacent triangles
    interfaceStrength  Pa, of edges between two materials, without scatter: a number, a function
                    (x, y) called at their middles, or a dict {(material, material): number}; 0:
                    open from the start; None, also in both, and pairs that are not in the dict: that
                    of the weaker material. Materials without fracture can crack there. The strength
                    of a joint has priority
    interfaceEnergy J/m², likewise
    name            None, or a text that may replace the body's number in all functions
    """
    smooth = mesh.smooth if smooth is None else smoothNodes(smooth, mesh)
    materials = Materials(mesh, material)
    between = interfaces(mesh, materials, interfaceStrength, interfaceEnergy)
    places = brittlePlaces(mesh, between, strength, fractureEnergy, jointStrength, jointEnergy)
    requireBetweenSteps()
    name = newName(fe, name)
    if element is None:
        element = 'smoothed' if materials.yields else 'linear'
    if not isinstance(element, str) or element not in _ELEMENTS:
        refuse('element', element, "'linear' or 'smoothed'")
    nodes = mesh.nodes
    spin = number('spin', spin, math.isfinite, 'a finite number (rad/s)')
    selfContact = flag('selfContact', selfContact)
    thickness = anyNumber('thickness', thickness, 'm')
    if fe.axisymmetric:
        _requireRound(spin, thickness)
    moved = field('displacement', displacement, nodes)
    flows = materials.yields and not any(one.planeStress for one in materials.of)
    stressed, across = stressOfTriangles(stress, mesh, flows)
    given = field('velocity', velocity, nodes, isOptional=False)
    present = nodes + moved if len(moved) else nodes
    centroid = _centroid(present, mesh.triangles) if spin else numpy.zeros(2)
    arm = present - centroid
    speed = given + spin * numpy.stack([-arm[:, 1], arm[:, 0]], axis=1) if spin else given
    held = heldNodes(fixed, nodes)
    if not len(fe.masses):
        forget()  # messages of another solver
    added = fe._addMesh(
        mesh=mesh, materials=materials.of, materialOf=materials.numbers, places=places, velocity=speed,
        displacement=moved, stress=stressed, stressAcross=across, held=held, smooth=smooth,
        thickness=thickness, selfContact=selfContact, smoothed=element == 'smoothed', name=name)
    component = added.component
    if component < 0:
        raise Overlap(added.message, added.depth)
    scene_check.solvers.add(fe)
    if fixed is not None:
        noteFixed(fixed, component, bool(held.any()))
    if not fe.axisymmetric:
        keepTurning(fe, component, held, given, spin, present, centroid)
    elif not nodes[:, 0].all():
        warnOfOne('Nodes on the axis, x = 0, move along it only.', 'bodies', component)
    if added.message:
        warnOfOne(added.message, 'bodies', component)
    return component


def _takesBody(*without):
    """Decorator: `**body` of a method stands for the arguments of _add by name, and {body} in its docstring for
    their description."""
    def complete(method):
        whole = inspect.signature(method)
        own = whole.parameters
        more = [one for key, one in inspect.signature(_add).parameters.items()
                if one.kind is one.KEYWORD_ONLY and key not in own and key not in without]
        method.__signature__ = whole.replace(
            parameters=[one for one in own.values() if one.kind is not one.VAR_KEYWORD] + more)
        method.__doc__ = withArguments(method.__doc__).replace('{body}', inspect.cleandoc(_add.__doc__ or ''))
        return method
    return complete


@_takesBody()
def addMesh(self: FESolver, mesh: Mesh | MeshFile | Sequence[ArrayLike],
            material: FEMat | str | int | Sequence | ByPlace, *, smooth: bool | None = None, **body: Any) -> int:
    """Adds a plane body with a given mesh; returns its number (int).

    mesh            a Mesh, of polygonMesh or rectangleMesh; the MeshFile of readMesh, whose joints have
                    the file's strength and energy if none are given, also in an FEMat; or a pair of nodes
                    (n, 2) in m and triangles (m, 3) of node numbers, counter-clockwise
    {body}
    smooth          None: as in polygonMesh; True, False: the whole boundary is C¹-smooth, or straight
    Functions are called at the nodes of the stress-free shape. ValueError before any change, also if the
    body would overlap another one; RuntimeError while O.run is running in the background; a warning if
    the mesh is too coarse for the energy of a BrittleFEMat's cracks, and one if short edges of
    polygonMesh's outline reduce the time step much.
    """
    smooth = None if smooth is None else flag('smooth', smooth)
    file, mesh = mesh, asMesh(mesh)
    if isinstance(file, MeshFile):
        body = {'jointStrength': file.jointStrength, 'jointEnergy': file.jointEnergy, **body}
        if file.axisymmetric not in (None, self.axisymmetric):
            both = ('axisymmetric', 'plane')[::1 if file.axisymmetric else -1]
            sentence = 'the elements of the mesh are %s, but fe is %s (mesh.axisymmetric = None: no check).' % both
            if file.axisymmetric:
                raise ValueError(sentence)
            warn('addMesh: ' + sentence)
    component = _add(self, mesh, material, smooth=smooth, **body)
    meshing = getattr(mesh, '_meshing', None)
    if meshing:
        tellCostly(self, component, mesh, meshing, meshing.outline, 'addMesh')
    return component


@_takesBody()
def addPolygon(self: FESolver, outline: ArrayLike, holes: Iterable[ArrayLike] = (), *, size: float | ByPlace,
               material: FEMat | str | int | Sequence | ByPlace, smooth: bool | Sequence[bool] = False,
               mesh: str | None = None, meshSeed: int = 0, simplify: float | None = None,
               joints: Iterable[Sequence[ArrayLike]] = (), snap: float | None = None, **body: Any) -> int:
    """Adds a plane body, meshed with triangles; returns its number (int).

    {arguments}
    mesh            'regular': rows of nearly equilateral triangles, whose edges have few
                    directions; 'irregular': edges in all directions, for cracks that do not
                    follow the mesh; None: 'irregular' for a material that cracks or fails, or several,
                    otherwise 'regular'
    snap            None: an outline that overlaps the bodies beside it by at most 0.05 of `size`, as by
                    rounded coordinates, is moved off them, by at most 0.1 of it; 0: it is refused.
                    Or m: vertices within this distance of the bodies that are there are moved onto
                    their nearest node, or else onto their nearest side, and the outline gets their
                    nodes on its edges; gaps are closed, too. A warning states how many vertices
                    were moved and how far. For a set of outlines, see also snapOutlines. It is
                    also the tolerance of `joints`: for None, 0.1 of `size`; for 0, rounding only
    {body}
    The body is that of `addMesh(polygonMesh(outline, ...), material, ...)`.
    size and material may also come by position: addPolygon(outline, size, material), or
    addPolygon(outline, holes, size, material). Other functions are called at the nodes of the stress-free
    shape. ValueError before any change, also if the body would overlap another one; TypeError for
    arguments that are missing or unknown; RuntimeError while O.run is running in the background; a
    warning if the mesh is too coarse for the energy of a BrittleFEMat's cracks, and one if short edges
    of the outline reduce the time step much. Of several such warnings the first one is given, and before
    the run the number of bodies that have it.
    """
    material = material if isField(material) else oneMaterial(material)
    displacement = body.get('displacement')
    snap = snapTolerance(snap, displacement)
    meshing = Meshing(outline, holes, size, mesh, meshSeed, smooth, simplify, joints, snap, material)
    used = []

    def add(shape):
        used[:] = shape, meshing.mesh(shape, meshing.jointTolerance)
        return _add(self, used[1], material, **body)

    component = addSnapped(self, meshing.outline, snap, meshing.size, displacement, add)
    shape, made = used
    tellJoined(component, meshing.size, *made.joined)
    tellCostly(self, component, made, meshing, shape, 'addPolygon')
    return component


@_takesBody('jointStrength', 'jointEnergy')
def addTriangles(self: FESolver, nodes: ArrayLike, triangles: ArrayLike,
                 material: FEMat | str | int | Sequence | ByPlace, *, smooth: bool = False, **body: Any) -> int:
    """Adds a body with a given mesh; returns its number (int): `addMesh((nodes, triangles), material, ...)`.

    nodes (n, 2) in m, or (n, 3) of one z, which is ignored, all of them used; triangles (m, 3) node
    numbers, counter-clockwise. `smooth` is True or False; all other arguments, including materials by
    triangle, as in addMesh. ValueError before any change.
    """
    smooth = flag('smooth', smooth)
    return _add(self, Mesh(nodes, triangles), material, smooth=smooth, **body)


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


def _minAngle(self):
    """Smallest angle (rad) of any triangle at present; inf without bodies."""
    with betweenSteps(self):
        corners = self.nodes[self.triangles[shownTriangles(self)]]
    if not len(corners):
        return math.inf
    after, before = (numpy.roll(corners, shift, axis=1) - corners for shift in (-1, 1))
    crosses = after[..., 0] * before[..., 1] - after[..., 1] * before[..., 0]
    return float(numpy.arctan2(abs(crosses), (after * before).sum(axis=2)).min())


def _guardCopy(reduce):
    """For copy and pickle: allowed only for a solver without bodies, since a copy would have none of them."""
    def guarded(self, protocol):
        if len(self.masses) > 0:
            raise TypeError('an FESolver with bodies cannot be copied or pickled, since its '
                            'bodies belong to the scene; O.save keeps them, or create a new one.')
        return reduce(self, protocol)

    return guarded


def _guard():
    """Sentences for wrong arguments of methods that are written in C++."""
    solver = wrapper.FESolver
    remove, fragments = solver.removeBody, solver.fragments

    @functools.wraps(remove)
    def removeBody(self, component):
        requireBetweenSteps()
        return remove(self, bodyNumber(self, component))

    @functools.wraps(fragments)
    def guardedFragments(self, held=True):
        return fragments(self, flag('held', held))

    def alone(method):
        return functools.wraps(method)(lambda self: method(self))

    for method in (removeBody, guardedFragments, alone(solver.deepestOverlap), alone(solver.criticalTimeStep)):
        setattr(solver, method.__name__, checkedCall(method))
    solver.__reduce_ex__ = _guardCopy(solver.__reduce_ex__)


def install() -> None:
    """Adds the methods to FESolver."""
    wrapper.FESolver.addPolygon = checkedCall(addPolygon, _arrangedPolygon)
    for method in (addMesh, addTriangles, bond, bondAll, prescribe, rotate, nodesOf, componentOf, pressure, absorb,
                   relax, reaction, contactForce, meshQuality):
        setattr(wrapper.FESolver, method.__name__, checkedCall(method))
    for name, read in (('principalStress', principalStress), ('crackCounts', crackCounts), ('minAngle', _minAngle),
                       ('energy', energy)):
        setattr(wrapper.FESolver, name, property(read, doc=read.__doc__))
    wrapper.FESolver.loads = property(getLoads, setLoads, doc=getLoads.__doc__)
    _guard()
