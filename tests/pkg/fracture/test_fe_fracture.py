"""Brittle bodies in YADE: faces of cracks as bodies, spheres on them, fragments, records. Fragments below
FESolver.minFragmentArea: taken out of the scene, and booked. Spheres that hit what cracks: energy and momenta of both worlds,
computed apart from the engine."""
import os

import meshio
import numpy as np
import pytest

import yadefrag
from fe_scene import (bodyOf, brittle, brittleImpact, heapSpheres, kineticEnergy, momentum, O, ready,
                      requireBodiesAreEntries, steps, throwBall)
from yade import utils, wrapper as w
from yadefrag.plots import pictures
from yadefrag.plots.axes import fragmentColours


def test_maxCracks():
    solver = brittleImpact()
    solver.maxCracks = 7
    steps(200)
    assert solver.numCracks == 7
    solver.maxCracks = -1
    steps(5)
    assert solver.numCracks > 7


@pytest.mark.parametrize('smooth', [False, True])
def test_facesOfCracksAreBodies(smooth):
    solver = brittleImpact(smooth=smooth)
    for b in O.bodies:
        b.mask = 5 if b.shape.component == 0 else 1
    before = len(O.bodies)
    masses, total = solver.masses.sum(), solver.energy['total']
    cracked = 0
    for _ in range(25):
        steps(12)
        assert solver.numCracks >= cracked
        cracked = solver.numCracks
        requireBodiesAreEntries(solver)
    assert cracked > 30 and len(O.bodies) > before + 30
    for b in O.bodies:
        assert b.mask == (5 if b.shape.component == 0 else 1)
        assert b.material.label == ('b' if b.shape.component == 0 else 'm')
        assert b.state.blockedDOFs == 'xyzXYZ' and b.shape.selfContact
    parts = solver.fragments()
    assert len(parts) > 2
    assert sum(p['mass'] for p in parts) == pytest.approx(masses, rel=1e-13)
    assert sum(p['triangles'] for p in parts) == len(solver.triangles)
    assert solver.energy['total'] == pytest.approx(total, rel=.01)
    assert solver.minFragmentArea == 0 and solver.dropped == dict(mass=0, momentum=(0, 0), energy=0, count=0)
    assert 'dropped' not in solver.energy
    of = solver.fragmentOf
    assert np.array_equal(np.bincount(of), [p['triangles'] for p in parts])
    assert all(len(set(of[(solver.triangles == n).any(1)])) == 1 for n in range(0, len(solver.masses), 7))


@pytest.mark.parametrize('finder', ['LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('area', [0, 3e-6])
def test_spheresOnABodyThatCracks(finder, area):
    """A heap of spheres on the block: pieces that change their kind keep carrying them; interactions of fragments below
    `area` (m²), which are dropped, go with these."""
    solver = brittleImpact(finder)
    solver.minFragmentArea = area
    heapSpheres()
    touched = 0
    for _ in range(30):
        steps(20)
        touched += sum(i.isReal for i in O.interactions)
        assert all(O.bodies[n] is not None for i in O.interactions for n in (i.id1, i.id2))
    requireBodiesAreEntries(solver)
    assert touched > 20 and solver.numCracks > (10 if area else 20) and (solver.dropped['count'] > 2) == (area > 0)
    if not area:
        assert all(b.state.pos[1] > .02 for b in O.bodies if isinstance(b.shape, w.Sphere))
    # A body that is made later gets a number of its own.
    assert solver.addPolygon(yadefrag.rectangle((.1, 0), (.11, .01)), size=.005, material='m') == 2
    steps(5)
    requireBodiesAreEntries(solver)


@pytest.mark.parametrize('area', [0, 3e-6])
def test_brittleBodyIsRemoved(area):
    """Also one of which fragments below `area` (m²) have been dropped."""
    solver = brittleImpact()
    solver.minFragmentArea = area
    steps(200)
    before = solver.dropped
    assert solver.numCracks > 10 and (before['count'] > 0) == (area > 0)
    solver.removeBody(0)
    assert {b.shape.component for b in O.bodies if b} == {1}
    steps(20)
    assert len(solver.fragments()) == 1 and solver.dropped == before
    requireBodiesAreEntries(solver)


def test_facesOfCracksStartNoSearch():
    """Where there is nothing but FE bodies, the collider need not look when an edge cracks."""
    solver = brittleImpact()
    collider = O.engines[1]
    steps(250)
    assert solver.numCracks > 30
    assert collider.numAction <= solver.numSearches + 1


# --- fragments and records

def test_fragmentTableAndSizes(folder):
    solver = brittleImpact()
    with pytest.raises(ValueError, match='no broken body'):
        yadefrag.plotFragmentSizes(solver)
    steps(300)
    table = yadefrag.fragmentTable(solver, folder + '/table.csv')
    parts = solver.fragments()
    assert len(table) == len(parts) and (np.diff(table['area']) <= 0).all()
    for row in table:
        part = parts[row['fragment']]
        assert row['mass'] == part['mass'] and (row['x'], row['y']) == part['centroid']
        assert row['size']**2 == pytest.approx(part['area'])
    read = np.genfromtxt(folder + '/table.csv', delimiter=',', names=True)
    assert np.array_equal(read['mass_kg'], table['mass'])
    ax = yadefrag.plotFragmentSizes(solver, folder + '/sizes.png')
    sizes, counts = ax.lines[0].get_data()
    assert counts[0] == (table['component'] == 0).sum() and counts[-1] == 1
    assert (np.diff(sizes) >= 0).all()
    assert ax.get_xscale() == ax.get_yscale() == 'log' and '(m)' in ax.get_xlabel()


@pytest.mark.filterwarnings('ignore:fractureEnergy')
def test_heldPartsCountAsOne():
    """A bar in tension: two parts as soon as nodes split, but one until the crack has lost its cohesion."""
    solver = w.FESolver()
    nodes, triangles = yadefrag.rectangleMesh((-.01, 0), (.01, .01), 2, 1)
    solver.addTriangles(nodes, triangles, material=brittle(fractureEnergy=500), velocity=lambda x, y: (2 * x / .01, 0),
                        fixed=lambda x, y: 'x' if abs(x) > .009 else False)
    O.engines = [solver]
    O.dt = .5 * solver.criticalTimeStep()
    seen = []
    while O.iter < 1000 and len(solver.fragments()) == 1:
        assert not solver.fragmentOf.any() and len(yadefrag.fragmentTable(solver)) == 1
        assert solver.crackCounts['open'] == 0
        assert solver.crackCounts['damaged'] + solver.crackCounts['whole'] == solver.numCracks
        seen.append(len(solver.fragments(held=False)))
        O.step()
    assert seen[0] == 1 and seen[-1] > 1 and seen.count(seen[-1]) > 5
    apart = solver.fragments()
    assert apart == solver.fragments(held=True)
    assert 2 <= len(apart) <= len(solver.fragments(held=False)) == seen[-1]
    assert sum(p['mass'] for p in apart) == pytest.approx(solver.masses.sum())
    assert solver.fragmentOf.max() == len(apart) - 1 and solver.crackCounts['open'] > 0
    assert sum(solver.crackCounts.values()) == len(yadefrag.crackTable(solver)) == solver.numCracks


def test_recordOfARun(folder):
    solver = brittleImpact()
    file = folder + '/run.csv'
    record = yadefrag.recordFracture(solver, file)
    yadefrag.runSteps(200, every=50, call=record)
    data = np.genfromtxt(file, delimiter=',', names=True)
    assert list(data['step']) == [0, 50, 100, 150, 200]
    assert data['time_s'][-1] == pytest.approx(O.time)
    assert data['cracks'][-1] == solver.numCracks > data['cracks'][0] == 0
    assert data['segments'][-1] == sum(map(len, solver.surfaces))
    assert data['fragments'][-1] == len(solver.fragments())
    counts = solver.crackCounts
    assert {name: data[name + '_cracks'][-1] for name in counts} == counts and counts['open'] > 0
    assert data['total_J'][-1] == solver.energy['total']
    again = yadefrag.recordFracture(solver, file, append=True)
    again()
    assert len(open(file).readlines()) == 8
    with open(folder + '/other.csv', 'w') as other:
        other.write('a,b\n')
    with pytest.raises(ValueError, match='other columns'):
        yadefrag.recordFracture(solver, folder + '/other.csv', append=True)
    upper, lower = yadefrag.plotFracture(file, folder + '/run.png')
    assert '(J)' in lower.get_ylabel() and os.path.getsize(folder + '/run.png') > 1000


def test_recordByPyRunner(folder):
    import __main__
    solver = brittleImpact()
    __main__.recordOfTest = yadefrag.recordFracture(solver, folder + '/run.csv')
    O.engines = O.engines + [w.PyRunner(command='recordOfTest()', iterPeriod=10)]
    O.run(31, True)
    del __main__.recordOfTest
    assert len(open(folder + '/run.csv').readlines()) >= 5


def test_neighboursHaveDifferentColours(folder):
    solver = brittleImpact()
    steps(250)
    of, colours = solver.fragmentOf, fragmentColours(solver)
    assert colours.max() < 20 and of.max() > 3
    for number in range(of.max() + 1):
        assert len(set(colours[of == number])) == 1
    reference = np.round(solver.nodes - solver.displacements, 9)
    at = {}
    for t, corners in enumerate(solver.triangles):
        for n in corners:
            at.setdefault(tuple(reference[n]), set()).add((of[t], colours[t]))
    for here in at.values():
        assert len({c for _, c in here}) == len(here)
    steps(3)
    later = fragmentColours(solver, colours)
    assert (later == colours).mean() > .9
    pictures.plotMesh(solver, 'fragment', folder + '/fragments.png')
    assert os.path.getsize(folder + '/fragments.png') > 1000
    assert yadefrag.animate(solver, folder + '/film.gif', 6, 3, field='fragment') == 3


@pytest.mark.parametrize('shift', [0, .013, .05])
def test_bodiesBesideEachOtherHaveDifferentColours(shift):
    """Bricks with gaps of 1 mm and no point in common, of different meshes: whatever grid is laid over them,
    and also a coarse one beside fine ones."""
    O.materials.append(w.FEMat(young=1e9, poisson=.2, density=1000, label='m'))
    solver, boxes = w.FESolver(), []
    for row in range(3):
        for column in range(4):
            x, y = shift + column + .31 * row, shift + row
            boxes.append((x, y, x + .999, y + .999))
            solver.addPolygon(yadefrag.rectangle(boxes[-1][:2], boxes[-1][2:]), (.9, .11, .2)[(row + column) % 3], 'm')
    colours = fragmentColours(solver)
    of = [set(colours[solver.components == body]) for body in range(len(boxes))]
    assert all(len(one) == 1 for one in of) and colours.max() < 10
    beside = [(a, b) for a in range(len(boxes)) for b in range(a)
              if min(boxes[a][2], boxes[b][2]) - max(boxes[a][0], boxes[b][0]) >= -.0011
              and min(boxes[a][3], boxes[b][3]) - max(boxes[a][1], boxes[b][1]) >= -.0011]
    assert len(beside) > 20 and all(of[a] != of[b] for a, b in beside)


# --- Fragments below FESolver.minFragmentArea

kArea = 3e-6  # m²: about two triangles


def dropping(finder='LebesgueCollider', **values):
    solver = brittleImpact(finder, **values)
    solver.minFragmentArea = kArea
    return solver


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
    solver = bodyOf(yadefrag.rectangle((0, 0), (.5, .05)), .02,
                    w.BrittleFEMat(young=5e8, poisson=.2, density=2000, frictionAngle=.4, tensileStrength=2e5,
                                   weibullModulus=6, seed=5), dict(minFragmentArea=3e-4), thickness=.06,
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


def bricks(solver, size):
    rows = [[solver.addPolygon(yadefrag.rectangle((.4 * k, .15 * r), (.4 * k + .4, .15 * r + .15)), size=size,
                               material='brick', mesh='regular') for k in range(2)] for r in range(4)]
    pairs = [(row[0], row[1]) for row in rows]
    pairs += [(below[k], above[k]) for below, above in zip(rows, rows[1:]) for k in range(2)]
    for one, other in pairs:
        solver.bond(one, other, strength=1e6, energy=20)


kBodies = {
    'rows': lambda solver, size: solver.addPolygon(yadefrag.rectangle((0, 0), (.8, .6)), size, 'brick', mesh='regular'),
    'scattered': lambda solver, size: solver.addPolygon(yadefrag.rectangle((0, 0), (.8, .6)), size, 'brick'),
    'smooth': lambda solver, size: solver.addPolygon(yadefrag.circle((.4, .3), .4), size, 'brick', smooth=True),
    'bricks': bricks,
}


def sphereImpact(kind, size, height, clump=False, friction=0., young=5e10, part=.5):
    """The solver, and the body that hits it at 20 m/s."""
    O.materials.append(w.BrittleFEMat(young=1e10, poisson=.2, density=1800, frictionAngle=friction, tensileStrength=3e6,
                                      fractureEnergy=50, label='brick'))
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


# Smooth ones: the sphere touches without a force, or only just not: an arc that cracks is a corner, farther out.
@pytest.mark.parametrize('kind, size, height, settings', [
    ('smooth', .05, .35, dict(part=.25)), ('smooth', .05, .3, dict(part=.1)), ('rows', .025, .35, {}),
    ('rows', .05, .35, dict(young=1e9, part=.8)), ('rows', .05, .35, dict(young=1e9, part=.1)),
    ('rows', .05, .35, dict(young=2e11, part=.8)), ('rows', .05, .35, dict(young=2e11, part=.1)),
    ('rows', .05, .35, dict(clump=True, friction=.5))])
def test_noStepSizeOrStiffnessCreatesEnergy(kind, size, height, settings):
    """Friction takes some."""
    solver, body = sphereImpact(kind, size, height, **settings)
    before = kineticEnergy(body)
    O.run(int(.002 / O.dt), True)
    gain = (kineticEnergy(body) - before - solver.energy['outside']) / before
    assert gain < 1e-3
    assert 'friction' in settings or gain > -5e-3 and not any('spheres has created' in one for one in solver.warnings)
