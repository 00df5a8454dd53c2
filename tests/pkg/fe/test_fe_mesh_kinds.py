"""addPolygon's meshes: irregular ones for what cracks, sizes by place, and their quality."""
import builtins
import math
import warnings

import numpy as np
import pytest

import yadefrag
from fe_impact import STEEL, brittle
from fe_scene import pixelContour
from yade import wrapper as w

O = builtins.O
kSquare = yadefrag.rectangle((0, 0), (1, 1))


def elastic():
    return w.FEMat(young=30e9, poisson=.2, density=2500)


def added(**wanted):
    """A solver with one body."""
    O.bodies.clear()
    solver = w.FESolver()
    solver.addPolygon(**{**dict(outline=kSquare, size=.02, material=brittle(fractureEnergy=0)),
                         **wanted})
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
    assert same(added(meshSeed=7), added(meshSeed=7))
    assert not same(added(meshSeed=7), added(meshSeed=8))
    assert same(added(mesh='regular', meshSeed=7), added(mesh='regular', meshSeed=8))


def test_qualityOfTheDefaultMesh():
    """As wanted of a square of 100 × 100 edges; here turned by 20°."""
    c, s = math.cos(math.radians(20)), math.sin(math.radians(20))
    outline = [(c * x - s * y, s * x + c * y) for x, y in kSquare]
    quality = added(outline=outline, size=.01).meshQuality()
    assert math.degrees(quality['minAngle']) > 30
    assert quality['timeStepRatio'] > .6
    assert abs(quality['size'] - .01) < .0007


def test_qualityOfARegularMesh():
    nodes, triangles = yadefrag.rectangleMesh((0, 0), (1, 1), 20, 20)
    solver = w.FESolver()
    solver.addTriangles(nodes, triangles, material=elastic())
    quality = solver.meshQuality(0)
    assert quality['numTriangles'] == 800
    assert quality['shortestEdge'] == pytest.approx(.05)
    assert quality['minAngle'] == pytest.approx(math.pi / 4)


def test_qualityIsOfTheStressFreeMesh():
    still = added().meshQuality()
    moved = added(displacement=lambda x, y: (.3 * x, 0)).meshQuality()
    assert still == moved


def test_qualityOfOneOfTwoBodies():
    solver = added()
    solver.addPolygon(yadefrag.rectangle((2, 0), (3, 1)), size=.1, material=elastic())
    assert solver.meshQuality(1)['numTriangles'] < solver.meshQuality(0)['numTriangles']
    solver.removeBody(0)
    assert solver.meshQuality()['numTriangles'] == solver.meshQuality(1)['numTriangles']


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


def test_functionThatIsConstant():
    assert len(added(size=lambda x, y: .05).triangles) == \
        pytest.approx(len(added(size=.05).triangles), rel=.05)


def test_shortEdgeOfTheOutlineIsReported():
    outline = [*kSquare[:2], (1, .5), (.9999, .5005), *kSquare[2:]]
    with pytest.warns(UserWarning, match=r'critical time step is [\d.]+ times shorter .* at \('):
        added(outline=outline)
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        added()
        added(outline=yadefrag.circle((0, 0), .5, 100))


def distanceTo(loop, points):
    """Of the points, the farthest one's from the loop's edges."""
    a = np.array(loop)
    edge = np.roll(a, -1, axis=0) - a
    to = np.asarray(points)[:, None] - a
    t = np.clip((to * edge).sum(axis=2) / (edge**2).sum(axis=1), 0, 1)
    return np.linalg.norm(to - t[..., None] * edge, axis=2).min(axis=1).max()


def test_aContourOfPixelsFromAFileIsSimplified(tmp_path):
    contour = pixelContour(60, 27)
    file = tmp_path / 'pixels.txt'
    file.write_text('\n'.join('%r %r' % p for p in contour))
    outline, holes = yadefrag.readPolygon(str(file))
    wanted = dict(outline=outline, holes=holes, size=9., material=elastic())
    with pytest.warns(UserWarning, match=r'addPolygon: the critical time step .* simplify=2.7 reduces'):
        rough = added(**wanted)
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        simple = added(**wanted, simplify=1.5)
    assert len(simple.surfaces[0]) < len(rough.surfaces[0]) / 6
    assert simple.criticalTimeStep() > 3 * rough.criticalTimeStep()
    assert distanceTo(simple.nodes[simple.surfaces[0]], contour) <= 1.5 * (1 + 1e-12)
    mass = simple.masses.sum() / rough.masses.sum()
    assert abs(mass - 1) < 1.5 * len(contour) / (math.pi * 27**2)


def test_simplifyKeepsStraightCornersOfSmoothOutlines():
    fine = yadefrag.circle((0, 0), 1, 400)
    flags = [True] * 400
    flags[37] = False
    solver = added(outline=fine, size=.3, material=elastic(), simplify=.02, smooth=flags)
    loop = solver.nodes[solver.surfaces[0]]
    assert len(loop) < 60
    assert np.any(np.all(loop == fine[37], axis=1))
