"""Bonds of bodies, whose nodes may differ along their common sides, from Python."""
import math
import os
import warnings

import numpy as np
import pytest

import outline_files as touching
import yadefrag
from fe_impact import engines, O
from fe_scene import momentum
from yade import utils
from yade import wrapper as w


def solverOf(**given):
    O.reset()
    O.materials.append(w.FEMat(**{**dict(young=1e9, poisson=.2, density=2000, frictionAngle=.5, label='m'), **given}))
    return w.FESolver()


def entryBodies():
    return [b for b in O.bodies if isinstance(b.shape, w.SurfaceSegment)]


def pair(sizes, velocity=0., angle=0., gap=0.):
    solver = solverOf(poisson=0, density=1000, planeStress=True)
    c, s = math.cos(angle), math.sin(angle)
    for low, size in zip((0, .05 + gap), sizes):
        outline = [(x * c - y * s, x * s + y * c) for x, y in yadefrag.rectangle((low, 0), (low + .05, .02))]
        solver.addPolygon(outline, size=size, material='m', velocity=lambda x, y: tuple(
            velocity * ((x * c + y * s) / .05 - 1) * np.array([c, s])))
    return solver


# --- two bodies

@pytest.mark.parametrize('sizes, angle', [((.002, .002), 0), ((.002, .003), 0), ((.002, .0013), .7), ((.004, .001), 2.)])
def test_aBondHoldsAndBreaks(sizes, angle):
    solver = pair(sizes, .5, angle)
    sides = solver.bond(0, 1, 5e6, 100)
    assert sides >= max(round(.02 / size) for size in sizes) and (sides == 10 or sizes[0] != sizes[1])
    assert len(entryBodies()) == sum(len(loop) for loop in solver.surfaces)
    engines(solver, factor=.4)
    O.run(1000, True)
    assert len(solver.fragments(held=False)) == 2 and len(solver.fragments()) == 1
    # Below its strength a bond is whole, although rounding opens its faces.
    assert solver.crackCounts == dict(open=0, damaged=0, whole=sides)
    assert abs(solver.energy['fracture']) < 1e-6 * 100 * .02
    solver = pair(sizes, 20, angle)
    assert solver.bond(0, 1, 5e6, 100) == sides
    engines(solver, factor=.4)
    before = momentum(solver)[0]
    O.run(max(1000, int(2e-4 / O.dt)), True)
    assert len(solver.fragments()) == 2 and solver.numCracks == 0
    assert solver.energy['fracture'] == pytest.approx(100 * .02, rel=.02)
    assert solver.crackCounts == dict(open=sides, damaged=0, whole=0)
    assert len(yadefrag.crackTable(solver)) == sides
    assert np.abs(momentum(solver)[0] - before).max() < 1e-12 * solver.masses.sum() * 20


def test_bodiesThatDoNotTouchAreRefused():
    with pytest.raises(ValueError, match='No sides of the bodies 0 and 1'):
        pair((.002, .002), gap=.01).bond(0, 1, 1e6, 100)


def test_aBodyAddedLaterAndASphereTouchDividedSides():
    """A half bond, whose divided sides reach out of it; then a block above it, and a sphere."""
    solver = solverOf()
    solver.addPolygon(yadefrag.rectangle((0, 0), (.1, .03)), size=.01, material='m')
    solver.addPolygon(yadefrag.rectangle((.0045, .03), (.05, .06)), size=.007, material='m')
    solver.bond(0, 1, 1e7, 1e4)
    solver.addPolygon(yadefrag.rectangle((.06, .0301), (.09, .06)), size=.006, material='m', velocity=(0, -1))
    ball = O.bodies.append(utils.sphere((.002, .0316, 0), .0015, material='m', fixed=False))
    O.bodies[ball].state.vel = (0, -1, 0)
    O.bodies[ball].state.blockedDOFs = 'zXYZ'
    engines(solver, factor=.4)
    start = momentum(solver)[0]
    O.run(int(8e-4 / O.dt), True)
    assert O.bodies[ball].state.vel[1] > 0
    assert np.abs(momentum(solver)[0] - start).max() < 1e-9 * solver.masses.sum()
    assert len(solver.fragments()) == 2


# --- a mesh file

def test_aMeshFromAFileIsBondedToAPolygon(folder):
    solver = solverOf()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.13, material='m')
    lines = ['$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$Nodes', '%d' % len(solver.nodes)]
    lines += ['%d %r %r 0' % (i + 1, float(x), float(y)) for i, (x, y) in enumerate(solver.nodes)]
    lines += ['$EndNodes', '$Elements', '%d' % len(solver.triangles)]
    lines += ['%d 2 2 1 1 %d %d %d' % (i + 1, *(int(n) + 1 for n in t)) for i, t in enumerate(solver.triangles)]
    path = os.path.join(folder, 'square.msh')
    with open(path, 'w') as file:
        file.write('\n'.join(lines + ['$EndElements', '']))
    mesh = yadefrag.readMesh(path)
    solver = solverOf()
    solver.addTriangles(mesh.nodes, mesh.triangles, 'm', velocity=lambda x, y: (x - 1, 0))
    solver.addPolygon(yadefrag.rectangle((1, .2), (2, 1.3)), size=.07, material='m', velocity=lambda x, y: (x - 1, 0))
    with warnings.catch_warnings(action='error'):
        assert solver.bond(0, 1, 1e8, 1e7) >= 8
    engines(solver, factor=.5)
    energy = solver.energy['total']
    O.run(50, True)
    assert len(solver.fragments()) == 1
    assert solver.energy['total'] == pytest.approx(energy, rel=1e-4)


# --- masonry

WALLS = {
    'masonry': lambda: (touching.rubbleMasonry(3, 2), (.03, .019, .024), .003),
    'snapped masonry': lambda: (yadefrag.snapOutlines(
        touching.rounded(touching.rubbleMasonry(3, 2), 3), .004)[0], (.03,), .004),
    'grains': lambda: (yadefrag.voronoi(yadefrag.rectangle((0, 0), (.04, .04)), 8, 3, shortest=.004), (.003,), 1e-6)}


@pytest.mark.parametrize('kind', WALLS)
def test_bondedBodiesCarryLoadAsOneBodyDoes(kind):
    """Neither all snapped nor of one size; drawn evenly, the stress is that of one body where no wave has come yet."""
    outlines, sizes, tolerance = WALLS[kind]()
    wide, top = np.concatenate(outlines).max(axis=0)
    part = (.012, .012) if kind == 'grains' else (.35, .03)
    solver = solverOf()
    for k, outline in enumerate(outlines):
        solver.addPolygon(outline, size=sizes[k % len(sizes)], material='m', velocity=lambda x, y: (x - wide / 2, 0))
    before = solver.criticalTimeStep()
    with warnings.catch_warnings(action='error'):
        sides = solver.bondAll(tolerance, 1e8, 1e7)
    assert sides > (20 if kind == 'grains' else 40) and solver.criticalTimeStep() > .3 * before
    assert len(solver.fragments()) == 1
    engines(solver, factor=.4)
    started, energy = momentum(solver)[0], solver.energy['total']
    last = min(6e-5, .7 * (top / 2 - part[1]) / 750)  # m/s, of waves; what runs ahead of these is some thousandths
    while O.time + O.dt < last:
        O.step()
    assert len(solver.fragments(held=True)) == 1
    middles = solver.nodes[solver.triangles].mean(axis=1)
    inside = (abs(middles - (wide / 2, top / 2)) < part).all(axis=1)
    wanted = 1e9 * .8 / 1.2 / .6 * O.time
    assert O.time > .8 * last and inside.sum() > 20
    assert solver.stress[inside, 0] == pytest.approx(wanted, rel=.01 if kind == 'grains' else .02)
    assert np.abs(momentum(solver)[0] - started).max() < 1e-9 * solver.masses.sum()
    assert solver.energy['total'] == pytest.approx(energy, rel=1e-4)


@pytest.mark.parametrize('seed', range(3))
def test_bondsOnePairAfterTheOtherAreAsComplete(seed):
    """Nodes at earlier bonds do not move; all others can."""
    wall = touching.turned(touching.rubbleMasonry(3, seed), .5 * seed)
    solver = solverOf()
    for k, outline in enumerate(wall):
        solver.addPolygon(outline, size=(.03, .019, .024)[k % 3], material='m')
    with warnings.catch_warnings(action='ignore'):  # corners that are joined
        for a in range(len(wall)):
            for b in range(a):
                try:
                    solver.bond(a, b, 1e8, 1e6)
                except ValueError as error:
                    assert 'No sides of the bodies' in str(error)
    assert len(solver.fragments()) == 1
    with pytest.raises(ValueError, match='no sides that are not bonded yet'):
        solver.bondAll(1e-6, 1e8, 1e6)


def test_digitisedMasonryIsBondedWithoutSnapping():
    wall = touching.digitised(touching.bricks(3, 3), 5e-4, 1)
    solver = solverOf()
    with warnings.catch_warnings(action='ignore'):  # of vertices that were moved off overlaps
        for k, outline in enumerate(wall):
            solver.addPolygon(outline, size=(.03, .022)[k % 2], material='m')
    mass = solver.masses.sum()
    with warnings.catch_warnings(action='error'):
        assert solver.bondAll(.003, 1e6, 1e4) > 60
    assert solver.masses.sum() == pytest.approx(mass, rel=.02)
    assert len(solver.fragments()) == 1
    solver.prescribe(lambda x, y: y < .01, vx=0, vy=0)
    solver.gravity = (0, -9.81, 0)
    engines(solver, factor=.5)
    O.run(300, True)
    assert len(solver.fragments()) == 1


def test_cornersThatAreJoinedAreReported():
    solver = solverOf()
    for low, high in (((0, 0), (.2, .1)), ((.001, .1), (.2, .2))):
        solver.addPolygon(yadefrag.rectangle(low, high), size=.02, material='m')
    with pytest.warns(UserWarning, match=r'bond: a corner of an outline was moved by up to 0.001 m'):
        assert solver.bond(0, 1, 1e6, 1e4) == 10


def test_sidesThatCannotBeJoinedAreReportedAndNothingChanges():
    solver = solverOf()
    for low, high in (((0, 0), (.2, .1)), ((.001, .1), (.2, .2))):
        solver.addPolygon(yadefrag.rectangle(low, high), size=.02, material='m')
    solver.prescribe(lambda x, y: True, vx=[(0, 0), (1, 1)], vy=0)
    nodes, triangles = solver.nodes, solver.triangles
    with pytest.raises(ValueError, match='sides of the bodies 0 and 1 coincide but have different ends'):
        solver.bond(0, 1, 1e6, 1e4)
    assert np.array_equal(solver.nodes, nodes) and np.array_equal(solver.triangles, triangles)
    assert solver.crackCounts == dict(open=0, damaged=0, whole=0)
    with pytest.raises(ValueError, match='bondAll: 20 sides within 1e-06 m of another body are not bonded'):
        solver.bondAll(1e-6, 1e6, 1e4)
