"""Mesh: every form that addMesh accepts, the bits of its bodies, and what a script may do with it; addPolygon's meshes."""
import copy
import math
import pickle
import warnings

import numpy as np
import pytest

import yadefrag
from fe_scene import brittle, O, STEEL
from outline_files import contour
from yadefrag import Mesh, polygonMesh, rectangle, rectangleMesh, ring
from yade import wrapper as w

kSquare = rectangle((0, 0), (1, 1))
kJoints = [((.2, .2), (.8, .7)), ((.1, .9), (.9, .1)), ((.5, -1), (.5, .3))]


def solver():
    O.reset()
    O.materials.append(w.FEMat(young=1e9, poisson=.3, density=1000, label='m'))
    O.materials.append(w.BrittleFEMat(young=5e9, poisson=.2, density=2000, tensileStrength=1e6, fractureEnergy=1e3,
                                      strengthScatter=.1, label='b'))
    return w.FESolver()


def bits(add):
    """All that ten steps make of the body that `add` adds."""
    fe = solver()
    assert add(fe) == 0
    O.engines, O.dt = [fe], .3 * fe.criticalTimeStep()
    O.run(10, True)
    arrays = fe.nodes, fe.velocities, fe.masses, fe.triangles, fe.stress, *fe.surfaces
    return [a.tobytes() for a in arrays], fe.energy, fe.numCracks


@pytest.mark.parametrize('outline, shape, body', [
    (kSquare, {}, dict(velocity=(1, 2), spin=3, thickness=.1)),
    (ring((0, 0), .5, 1), dict(meshSeed=4), dict(material='b', velocity=lambda x, y: (9 * x, 0), fixed=lambda x, y: y < 0)),
    (kSquare, dict(size=lambda x, y: .1 + .1 * x, smooth=[0, 1, 1, 0]), dict(element='smoothed', stress=(1e4, 0, 0))),
    (kSquare[::-1], dict(smooth=[True, False, True, True]), dict(displacement=lambda x, y: (1e-3 * x, 0))),
    (yadefrag.circle((0, 0), 1, 300), dict(simplify=.02, smooth=True), {}),
    (kSquare, dict(joints=kJoints), dict(material='b', jointStrength=[0, 1e5, 1e5], jointEnergy=3.)),
    (kSquare, dict(joints=[((.5, 0), (.5, 1))]), dict(
        material=lambda x, y: 'b' if x < .5 else 'm', jointStrength=None, interfaceStrength=1e4, name='one',
        velocity=lambda x, y: (20 * x, 0))),
])
@pytest.mark.parametrize('mesh', ['regular', 'irregular'])
def test_addPolygonIsAddMeshOfPolygonMesh(outline, shape, body, mesh):
    parts = outline if isinstance(outline, tuple) else (outline,)
    shape, body = dict(dict(size=.15, mesh=mesh), **shape), dict(dict(material='m'), **body)
    whole = bits(lambda fe: fe.addPolygon(*parts, **shape, **body))
    made = polygonMesh(*parts, **shape)
    assert bits(lambda fe: fe.addMesh(made, **body)) == whole
    assert bits(lambda fe: fe.addMesh(pickle.loads(pickle.dumps(made)), **body)) == whole  # in another process


def test_formsOfAMesh(folder):
    """A Mesh, a pair, a MeshFile, addTriangles: the same body."""
    nodes, triangles = rectangleMesh((0, 0), (1, 1), 3, 4)
    file = folder + '/a.inp'
    with open(file, 'w') as out:
        out.write('*NODE\n' + ''.join('%d, %r, %r\n' % (i + 1, *p) for i, p in enumerate(nodes.tolist())) +
                  '*ELEMENT, TYPE=CPS3\n' + ''.join('%d, %d, %d, %d\n' % (i + 1, *t) for i, t in
                                                    enumerate((triangles + 1).tolist())))
    body = dict(material='b', velocity=lambda x, y: (9 * x, 0), strength=np.linspace(1e4, 1e5, 24))
    forms = [Mesh(nodes, triangles), (nodes, triangles), [nodes.tolist(), triangles.tolist()],
             Mesh(np.column_stack([nodes, np.ones(len(nodes))]), triangles), yadefrag.readMesh(file)]
    first = bits(lambda fe: fe.addTriangles(nodes, triangles, **body))
    for form in forms:
        assert bits(lambda fe: fe.addMesh(form, **body)) == first
    assert bits(lambda fe: fe.addTriangles(*forms[0], **body)) == first
    smooth = bits(lambda fe: fe.addMesh(forms[0], 'm', smooth=True))
    assert smooth == bits(lambda fe: fe.addTriangles(nodes, triangles, 'm', smooth=True))


def test_oneMeshGivesSeveralBodies():
    fe, mesh = solver(), rectangleMesh((0, 0), (1, 1), 3, 3)
    for k in range(3):
        assert fe.addMesh(mesh, 'm') == k
        mesh.nodes += (2, 0)
    assert fe.nodes[:, 0].max() == 5 and len(fe.nodes) == 48 and len(fe.surfaces) == 3
    with pytest.raises(ValueError, match='overlap'):
        mesh.nodes -= (2, 0)
        fe.addMesh(mesh, 'm')


def test_arraysOfAMesh():
    mesh = polygonMesh(*ring((0, 0), .5, 1), size=.2, joints=[((-.9, 0), (-.6, 0))])
    nodes, triangles = mesh
    assert len(mesh) == 2 and (mesh[0] == nodes).all() and (mesh[-1] == triangles).all()
    assert nodes.dtype == float and nodes.shape[1] == 2 and triangles.dtype == np.uint32 and triangles.shape[1] == 3
    assert len(mesh.loops) == 2 and mesh.joints.shape == (len(mesh.joints), 3) and len(mesh.joints) >= 1
    assert mesh.joined == (0, 0) and len(mesh.smooth) == 0
    assert repr(mesh) == 'Mesh of %d nodes and %d triangles, boundary loops of %d, %d nodes, %d sides on joints' % (
        len(nodes), len(triangles), *map(len, mesh.loops), len(mesh.joints))
    with pytest.raises(IndexError):
        mesh[2]
    nodes += 1
    assert (mesh.nodes == nodes).all()  # in place
    triangles[:] = 0
    assert mesh.triangles.max() > 0  # a copy
    other = copy.copy(mesh)
    other.nodes[:] = 0
    assert mesh.nodes.any()
    del mesh
    assert np.isfinite(nodes).all()  # the memory stays


def test_movedNodesAreChecked():
    fe, mesh = solver(), rectangleMesh((0, 0), (1, 1), 2, 2)
    with pytest.raises(ValueError, match='nodes has 3 points, it must have 9'):
        mesh.nodes = mesh.nodes[:3]
    mesh.nodes[4] = np.nan
    with pytest.raises(ValueError, match="the mesh's nodes has a point 4 at"):
        fe.addMesh(mesh, 'm')
    mesh.nodes[4] = 5, 5
    with pytest.raises(ValueError, match='riangle'):
        fe.addMesh(mesh, 'm')
    assert len(fe.masses) == 0


def test_messagesOfAPolygonsMesh():
    """polygonMesh warns of joined joints, addMesh of a short time step."""
    fe = solver()
    near = [((.1, .5), (.9, .5)), ((.5, .505), (.5, .9))]
    with pytest.warns(UserWarning, match=r'polygonMesh: of the joints, \d+ ends'):
        assert polygonMesh(kSquare, size=.2, joints=near).joined[0] > 0
    step = [(0, 0), (.5, 0), (.501, 0), (1, 0), (1, 1), (0, 1)]
    with warnings.catch_warnings(action='error'):
        mesh = polygonMesh(step, size=.1)
    with pytest.warns(UserWarning, match=r'addMesh: .*simplify=0.03 reduces that to'):
        fe.addMesh(mesh, 'm')


def test_helpHasAllArguments():
    for method in (w.FESolver.addPolygon, w.FESolver.addMesh):
        for word in ('velocity  ', 'interfaceEnergy', 'jointStrength', "'smoothed'", 'an FEMat, its label', 'name  '):
            assert word in method.__doc__
    assert 'simplify  ' in w.FESolver.addPolygon.__doc__ and 'simplify  ' in polygonMesh.__doc__
    assert '{' not in w.FESolver.addPolygon.__doc__.replace('{(material', '')


# --- meshes of addPolygon: irregular ones for what cracks, sizes by place, and their quality

def elastic():
    return w.FEMat(young=30e9, poisson=.2, density=2500)


def added(**wanted):
    """A solver with one body."""
    O.bodies.clear()
    solver = w.FESolver()
    solver.addPolygon(**{**dict(outline=kSquare, size=.02, material=brittle(fractureEnergy=0)), **wanted})
    return solver


def same(a, b):
    return np.array_equal(a.nodes, b.nodes) and np.array_equal(a.triangles, b.triangles)


def test_whatCracksGetsAnIrregularMesh():
    for material in (brittle(fractureEnergy=0), w.PlasticFEMat(**STEEL, failureStrain=.3)):
        default, regular = added(material=material), added(material=material, mesh='regular')
        assert same(default, added(material=material, mesh='irregular')) and not same(default, regular)
    assert same(added(material=elastic()), regular)
    assert same(added(material=elastic(), mesh='irregular'), default)


def test_seedChoosesTheMesh():
    assert same(added(meshSeed=7), added(meshSeed=7)) and not same(added(meshSeed=7), added(meshSeed=8))
    assert same(added(mesh='regular', meshSeed=7), added(mesh='regular', meshSeed=8))


def test_quality():
    """Of the default mesh as wanted of a square of 100 × 100 edges, here turned by 20°; of a regular one; of the
    stress-free mesh; of one of two bodies."""
    c, s = math.cos(math.radians(20)), math.sin(math.radians(20))
    quality = added(outline=[(c * x - s * y, s * x + c * y) for x, y in kSquare], size=.01).meshQuality()
    assert math.degrees(quality['minAngle']) > 30
    assert quality['timeStepRatio'] > .6
    assert abs(quality['size'] - .01) < .0007
    O.bodies.clear()
    regular = w.FESolver()
    regular.addMesh(yadefrag.rectangleMesh((0, 0), (1, 1), 20, 20), elastic())
    quality = regular.meshQuality(0)
    assert quality['numTriangles'] == 800 and quality['shortestEdge'] == pytest.approx(.05)
    assert quality['minAngle'] == pytest.approx(math.pi / 4)
    assert regular.minAngle == pytest.approx(math.pi / 4)
    assert added().meshQuality() == added(displacement=lambda x, y: (.3 * x, 0)).meshQuality()
    both = added()
    both.addPolygon(yadefrag.rectangle((2, 0), (3, 1)), size=.1, material=elastic())
    assert both.meshQuality(1)['numTriangles'] < both.meshQuality(0)['numTriangles']
    both.removeBody(0)
    assert both.meshQuality()['numTriangles'] == both.meshQuality(1)['numTriangles']


def test_sizeByPlace():
    """Twenty times finer at the bottom than at the top; edges are as long as is wanted there."""
    def size(x, y):
        return .005 + .1 * y
    solver = added(size=size)
    corners = solver.nodes[solver.triangles]
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    middle = (np.roll(corners, -1, axis=1) + corners) / 2
    ratio = sides / (.005 + .1 * middle[:, :, 1])
    assert .5 < ratio.min() and ratio.max() < 2 and abs(ratio.mean() - 1) < .1
    assert math.degrees(solver.minAngle) > 28
    assert same(solver, added(size=size))
    constant = len(added(size=lambda x, y: .05).triangles)
    assert constant == pytest.approx(len(added(size=.05).triangles), rel=.05)


def test_shortEdgeOfTheOutlineIsReported():
    outline = [*kSquare[:2], (1, .5), (.9999, .5005), *kSquare[2:]]
    with pytest.warns(UserWarning, match=r'critical time step is [\d.]+ times shorter .* at \('):
        added(outline=outline)
    with warnings.catch_warnings(action='error'):
        added()
        added(outline=yadefrag.circle((0, 0), .5, 100))


def test_aContourOfPixelsIsSimplified():
    """How far it may be from the pixels: tests/pkg/io/test_geometry.py."""
    wanted = dict(outline=contour(60, lambda x, y: math.hypot(x - 30, y - 30) < 27)[0], size=9., material=elastic())
    with pytest.warns(UserWarning, match=r'addPolygon: the critical time step .* simplify=2.7 reduces'):
        rough = added(**wanted)
    with warnings.catch_warnings(action='error'):
        simple = added(**wanted, simplify=1.5)
    assert simple.criticalTimeStep() > 3 * rough.criticalTimeStep()


def test_simplifyKeepsStraightCornersOfSmoothOutlines():
    fine = yadefrag.circle((0, 0), 1, 400)
    flags = [True] * 400
    flags[37] = False
    solver = added(outline=fine, size=.3, material=elastic(), simplify=.02, smooth=flags)
    loop = solver.nodes[solver.surfaces[0]]
    assert len(loop) < 60
    assert np.any(np.all(loop == fine[37], axis=1))
