"""Fragments below FESolver.minFragmentArea: taken out of the scene, and booked."""
import builtins

import numpy as np
import pytest

import yadefrag
from fe_impact import impact, requireBodiesAreEntries, steps
from fe_scene import momentum, throwBall
from yadefrag.plots.axes import fragmentColours
from yade import wrapper as w

O = builtins.O
kArea = 3e-6  # m²: about two triangles


def dropping(finder='LebesgueCollider', **values):
    solver = impact(finder, **values)
    solver.minFragmentArea = kArea
    return solver


def test_offByDefault():
    solver = impact()
    steps(250)
    assert solver.minFragmentArea == 0 and min(p['area'] for p in solver.fragments()) < kArea
    assert solver.dropped == dict(mass=0, momentum=(0, 0), energy=0, count=0)
    assert 'dropped' not in solver.energy and (solver.fragmentOf >= 0).all()


@pytest.mark.parametrize('smooth', [False, True])
def test_whatGoesIsBooked(smooth):
    """No small fragment is left, nor any body of one; mass and energy are all there."""
    solver = dropping(smooth=smooth)
    mass, total = solver.masses.sum(), solver.energy['total']
    for _ in range(25):
        steps(12)
        requireBodiesAreEntries(solver)
        parts = solver.fragments()
        held = [p for p in parts if p['centroid'][1] < .002]
        assert min(p['area'] for p in parts if p not in held) > .9 * kArea
        gone = solver.dropped
        assert sum(p['mass'] for p in parts) + gone['mass'] == pytest.approx(mass, rel=1e-13)
        assert solver.masses.sum() + gone['mass'] == pytest.approx(mass, rel=1e-13)
    assert gone['count'] > 3 and gone['mass'] > 0
    assert solver.energy['dropped'] == gone['energy'] > 0
    assert solver.energy['total'] == pytest.approx(total, rel=.01)
    of = solver.fragmentOf
    assert of.max() + 1 == len(parts) and (of < 0).sum() >= gone['count']
    assert np.bincount(of[of >= 0]).tolist() == [p['triangles'] for p in parts]
    assert sum(map(len, solver.surfaces)) == solver.numSegments
    assert len(solver.triangles) == len(of)  # numbers stay


def test_momentumOfAFreeBlock():
    O.materials.append(w.BrittleFEMat(young=30e9, poisson=.2, density=2500, frictionAngle=0,
                                      tensileStrength=20e6, label='b'))
    solver = w.FESolver(minFragmentArea=kArea)
    for at, speed in (((0, 0), 0), ((.0051, .0203), -40)):
        solver.addPolygon(yadefrag.rectangle(at, (at[0] + .02, at[1] + .02)), size=.002,
                          material='b', velocity=(0, speed))
    O.engines = [solver]
    O.dt = .5 * solver.criticalTimeStep()
    start = momentum(solver)[0]
    steps(250)
    gone = solver.dropped
    assert gone['count'] > 3
    assert np.allclose(momentum(solver)[0] + gone['momentum'], start, rtol=0,
                       atol=1e-11 * np.linalg.norm(start))


def test_energyIsTracked():
    O.trackEnergy = True
    solver = dropping()
    steps(1)
    before = sum(dict(O.energy.items()).values())
    steps(200)
    items = dict(O.energy.items())
    assert items['feDropped'] == solver.dropped['energy'] > 0
    assert sum(items.values()) == pytest.approx(before, rel=.01)


def test_picturesLeaveThemOut(folder):
    meshio = pytest.importorskip('meshio')
    solver = dropping()
    steps(220)
    assert solver.dropped['count'] > 0
    kept = solver.fragmentOf >= 0
    yadefrag.exportVTK(solver, folder + '/out.vtu')
    written = meshio.read(folder + '/out.vtu')
    assert len(written.cells[0].data) == kept.sum()
    assert np.array_equal(written.cell_data['fragment'][0], solver.fragmentOf[kept])
    corners = solver.nodes[solver.triangles[kept]]
    assert np.array_equal(written.points[written.cells[0].data][:, :, :2], corners)
    # As many triangles as are there, in each kind of picture; none of the others' places.
    for field in (None, 'mises', 'speed', 'fragment', np.arange(len(kept))):
        ax = yadefrag.plotMesh(solver, field)
        drawn = len(np.unique(solver.triangles[kept])) if str(field) == 'speed' else kept.sum()
        assert field is None or len(ax.collections[0].get_array()) == drawn
    colours = fragmentColours(solver)
    assert len(colours) == len(kept) and len(set(colours[kept])) > 1
    assert len(yadefrag.fragmentTable(solver)) == len(solver.fragments())
    assert yadefrag.animate(solver, folder + '/film.gif', 6, 3, field='fragment') == 3
    assert solver.minAngle > .1


@pytest.mark.parametrize('young', [5e8, 5e7])
def test_contactsOfASphereWithWhatGoesLeaveWithIt(young):
    """A fragment that a sphere presses on takes along the elastic energy of their contacts, and what is then
    exposed below the sphere begins no contact at once."""
    O.materials.append(w.BrittleFEMat(young=5e8, poisson=.2, density=2000, frictionAngle=.4, tensileStrength=2e5,
                                      weibullModulus=6, seed=5, label='plate'))
    solver = w.FESolver(minFragmentArea=3e-4)
    solver.addPolygon(yadefrag.rectangle((0, 0), (.5, .05)), size=.02, material='plate', thickness=.06,
                      fixed=lambda x, y: x < 1e-9 or x > .4999)
    ball = throwBall((.25, .081), .03, (0, -20), w.FrictMat(young=young, poisson=.2, density=4000, frictionAngle=.4))
    impactEnergy = .5 * ball.state.mass * 20**2
    O.engines = yadefrag.engines(solver, spheres=True)
    O.dt = .3 * solver.criticalTimeStep()
    steps(10)
    start = solver.energy['total']
    while solver.time < .003:
        steps(10)
        assert abs(solver.energy.get('scene', start) - start) < .005 * impactEnergy
    assert solver.dropped['count'] > 10 and not solver.warnings
