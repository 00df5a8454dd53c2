"""Fragments below FESolver.minFragmentArea: taken out of the scene, and booked. Spheres that hit what cracks:
energy and momenta of both worlds, computed apart from the engine."""
import meshio
import numpy as np
import pytest
import yadefrag
from yade import utils, wrapper as w
from yadefrag.plots.axes import fragmentColours
from fe_impact import impact, O, requireBodiesAreEntries, steps
from fe_scene import fe, kineticEnergy, momentum, ready, throwBall

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
    solver = fe(w.BrittleFEMat(young=30e9, poisson=.2, density=2500, frictionAngle=0,
                               tensileStrength=20e6, label='b'), minFragmentArea=kArea)
    for at, speed in (((0, 0), 0), ((.0051, .0203), -40)):
        solver.addPolygon(yadefrag.rectangle(at, (at[0] + .02, at[1] + .02)), size=.002,
                          material='b', velocity=(0, speed))
    O.engines = [solver]
    O.dt = .5 * solver.criticalTimeStep()
    start = momentum(solver)[0]
    steps(250)
    gone = solver.dropped
    assert gone['count'] > 3
    assert np.allclose(momentum(solver)[0] + gone['momentum'], start, rtol=0, atol=1e-11 * np.linalg.norm(start))


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
    solver = fe(w.BrittleFEMat(young=5e8, poisson=.2, density=2000, frictionAngle=.4, tensileStrength=2e5,
                               weibullModulus=6, seed=5, label='plate'), minFragmentArea=3e-4)
    solver.addPolygon(yadefrag.rectangle((0, 0), (.5, .05)), size=.02, material='plate', thickness=.06,
                      fixed=lambda x, y: x < 1e-9 or x > .4999)
    ball = throwBall((.25, .081), .03, (0, -20), w.FrictMat(young=young, poisson=.2, density=4000, frictionAngle=.4))
    impactEnergy = .5 * ball.state.mass * 20**2
    ready(solver, .3, spheres=True)
    steps(10)
    start = solver.energy['total']
    while solver.time < .003:
        steps(10)
        assert abs(solver.energy.get('scene', start) - start) < .005 * impactEnergy
    assert solver.dropped['count'] > 10 and not solver.warnings


def material(name, friction):
    return w.BrittleFEMat(young=1e10, poisson=.2, density=1800, frictionAngle=friction, tensileStrength=3e6,
                          fractureEnergy=50, label=name)


def bricks(solver, size):
    rows = [[solver.addPolygon(yadefrag.rectangle((.4 * k, .15 * r), (.4 * k + .4, .15 * r + .15)), size=size,
                               material='brick', mesh='regular') for k in range(2)] for r in range(4)]
    pairs = [(row[0], row[1]) for row in rows]
    pairs += [(below[k], above[k]) for below, above in zip(rows, rows[1:]) for k in range(2)]
    for one, other in pairs:
        solver.bond(one, other, strength=1e6, energy=20)


kBodies = {
    'rows': lambda solver, size: solver.addPolygon(yadefrag.rectangle((0, 0), (.8, .6)), size=size,
                                                   material='brick', mesh='regular'),
    'scattered': lambda solver, size: solver.addPolygon(yadefrag.rectangle((0, 0), (.8, .6)), size=size,
                                                        material='brick'),
    'smooth': lambda solver, size: solver.addPolygon(yadefrag.circle((.4, .3), .4), size=size,
                                                     material='brick', smooth=True),
    'bricks': bricks,
}


def sphereImpact(kind, size, height, clump, friction=0., young=5e10, part=.5):
    """The solver, and the body that hits it at 20 m/s."""
    O.materials.append(material('brick', friction))
    O.materials.append(w.FrictMat(young=young, poisson=.3, density=7800, frictionAngle=friction, label='steel'))
    solver = w.FESolver()
    kBodies[kind](solver, size)
    balls = [utils.sphere((.881, height, 0), .07, material='steel')]
    if clump:
        balls.append(utils.sphere((.96, height + .06, 0), .07, material='steel'))
        body = O.bodies[O.bodies.appendClumped(balls)[0]]
    else:
        body = O.bodies[O.bodies.append(balls[0])]
    body.state.vel, body.state.blockedDOFs = (-20, 0, 0), 'zXY'
    ready(solver, part, spheres=True)
    return solver, body


@pytest.mark.parametrize('clump', [False, True])
@pytest.mark.parametrize('height', [.31, *(pytest.param(h, marks=pytest.mark.long) for h in (.3, .35))])
@pytest.mark.parametrize('kind', list(kBodies))
def test_neitherEnergyNorMomentumIsCreated(kind, height, clump):
    """What the sphere loses is what the body gets: to .5 % with the friction of cohesive faces, and
    never more than .1 % too much."""
    solver, body = sphereImpact(kind, .05, height, clump, part=.25)
    before, sums = kineticEnergy(body), momentum(solver, [body])[0]
    O.run(int(.003 / O.dt), True)
    assert solver.numCracks > 30
    assert not any(contact.isReal for contact in O.interactions)
    gain = (kineticEnergy(body) - before - solver.energy['outside']) / before
    assert -5e-3 < gain < 1e-3
    after = momentum(solver, [body])[0]
    assert np.abs(after - sums).max() < 1e-10 * abs(sums[0])


@pytest.mark.parametrize('height, part', [(.35, .25), (.3, .1)])
def test_facesThatAppearBesideAnUnloadedSphereGetNoForce(height, part):
    """The sphere touches without a force, or only just not: an arc that cracks is a corner, farther out."""
    solver, body = sphereImpact('smooth', .05, height, False, part=part)
    before = kineticEnergy(body)
    O.run(int(.002 / O.dt), True)
    assert -5e-3 < (kineticEnergy(body) - before - solver.energy['outside']) / before < 1e-3
    assert not any('spheres has created' in sentence for sentence in solver.warnings)


@pytest.mark.parametrize('size, young, part', [(.05, 1e9, .8), (.05, 1e9, .1), (.05, 2e11, .8), (.05, 2e11, .1),
                                               (.025, 5e10, .5)])
def test_noStepSizeOrStiffnessCreatesEnergy(size, young, part):
    solver, body = sphereImpact('rows', size, .35, False, young=young, part=part)
    before = kineticEnergy(body)
    O.run(int(.002 / O.dt), True)
    assert -5e-3 < (kineticEnergy(body) - before - solver.energy['outside']) / before < 1e-3


def test_frictionOnlyTakesEnergy():
    solver, body = sphereImpact('rows', .05, .35, True, friction=.5)
    before = kineticEnergy(body)
    O.run(int(.002 / O.dt), True)
    assert kineticEnergy(body) - before - solver.energy['outside'] < 1e-3 * before
