"""Brittle bodies in YADE: faces of cracks as bodies, spheres on them, fragments, records."""
import os

import numpy as np
import pytest

import yadefrag
from fe_impact import brittle, engines, heapSpheres, impact, O, requireBodiesAreEntries, steps
from fe_scene import newBall
from yadefrag.plots import pictures
from yadefrag.plots.axes import fragmentColours
from yade import wrapper as w


def test_maxCracks():
    solver = impact()
    solver.maxCracks = 7
    steps(200)
    assert solver.numCracks == 7
    solver.maxCracks = -1
    steps(5)
    assert solver.numCracks > 7


@pytest.mark.parametrize('smooth', [False, True])
def test_facesOfCracksAreBodies(smooth):
    solver = impact(smooth=smooth)
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
    of = solver.fragmentOf
    assert np.array_equal(np.bincount(of), [p['triangles'] for p in parts])
    assert all(len(set(of[(solver.triangles == n).any(1)])) == 1 for n in range(0, len(solver.masses), 7))


def test_newFacesTouchEachOther():
    """No piece of a block that is crushed ends up inside another."""
    solver = impact()
    deepest = 0
    for _ in range(300):
        O.step()
        deepest = max(deepest, solver.maxPenetration)
    assert solver.numCracks > 30 and solver.numActives > 10
    assert deepest < 1e-6


@pytest.mark.parametrize('finder', ['LebesgueCollider', 'InsertionSortCollider'])
def test_spheresTouchNewFaces(finder):
    """A bar is torn apart; a sphere that then falls into the gap touches the crack's faces."""
    O.materials.append(brittle(label='b'))
    solver = w.FESolver()
    nodes, triangles = yadefrag.rectangleMesh((-.02, 0), (.02, .01), 16, 4)
    solver.addTriangles(nodes, triangles, material='b', velocity=lambda x, y: (40 * x / .02, 0),
                        fixed=lambda x, y: 'x' if abs(x) > .0199 else False)
    engines(solver, finder)
    old = len(O.bodies)
    cracked = 0
    while O.iter < 4000 and len(solver.fragments()) < 2:
        O.step()
        cracked = solver.numCracks
    assert cracked >= 4
    steps(1500)
    faces = [b for b in O.bodies if b.id >= old and abs(b.shape.start[0] - b.shape.end[0]) < 1e-3]
    widest = max(faces, key=lambda b: abs(b.state.vel[0]))
    middle = np.array(widest.state.pos)[:2]
    travel = np.array(widest.shape.end - widest.shape.start)[:2]
    outward = np.array([travel[1], -travel[0]]) / np.linalg.norm(travel)
    ball = newBall(middle + outward * .9e-4, 1e-4, O.materials['b'])
    ball.state.blockedDOFs = 'xyzXYZ'
    O.bodies.append(ball)
    O.step()
    assert widest.id in [i.id1 for i in O.interactions] + [i.id2 for i in O.interactions]
    assert np.linalg.norm(O.forces.f(ball.id)) > 0


@pytest.mark.parametrize('finder', ['LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('area', [0, 3e-6])
def test_spheresOnABodyThatCracks(finder, area):
    """A heap of spheres on the block: pieces that change their kind keep carrying them; interactions of fragments below
    `area` (m²), which are dropped, go with these."""
    solver = impact(finder)
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
    solver = impact()
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
    solver = impact()
    collider = O.engines[1]
    steps(250)
    assert solver.numCracks > 30
    assert collider.numAction <= solver.numSearches + 1


# --- fragments and records

def test_fragmentTableAndSizes(folder):
    solver = impact()
    with pytest.raises(ValueError, match='no broken body'):
        yadefrag.plotFragmentSizes(solver)
    steps(300)
    with pytest.raises(ValueError, match=r"its name must end with '\.csv'"):
        yadefrag.fragmentTable(solver, folder + '/table.txt')
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
    solver = impact()
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
    solver = impact()
    __main__.recordOfTest = yadefrag.recordFracture(solver, folder + '/run.csv')
    O.engines = O.engines + [w.PyRunner(command='recordOfTest()', iterPeriod=10)]
    O.run(31, True)
    del __main__.recordOfTest
    assert len(open(folder + '/run.csv').readlines()) >= 5


def test_neighboursHaveDifferentColours(folder):
    solver = impact()
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
