"""Bodies that touch, with rounded coordinates; bonds of all neighbours; joints that nearly meet."""
import re
import warnings

import numpy as np
import pytest

import outline_files as touching
import yadefrag
from fe_scene import brittle, engines, heard, O
from outline_files import area
from test_fe_bonds import solverOf


def addAll(outlines, size, **given):
    """(solver, messages)."""
    solver = solverOf()
    with heard() as texts:
        for outline in outlines:
            solver.addPolygon(outline, size=size, material='m', **given)
    return solver, texts


def square(size=.1, **given):
    solver = solverOf()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=size, material='m', **given)
    return solver


# --- outlines that overlap by rounding

@pytest.mark.parametrize('digits', [3, 4, 6, 9, 12])
def test_roundedMasonryIsAdded(digits):
    for seed in range(4):
        angle = np.random.default_rng(seed).uniform(0, 3)
        outlines = touching.rounded(touching.turned(touching.rubbleMasonry(4, seed), angle), digits)
        solver, told = addAll(outlines, .04)
        assert len(solver.surfaces) == len(outlines)
        # The bodies have lost the overlaps only, and elements are not much smaller than in single ones.
        assert solver.masses.sum() == pytest.approx(
            2000 * sum(map(area, outlines)), rel=20 * 10.**-digits)
        step = solver.criticalTimeStep()
        alone = min(addAll([one], .04)[0].criticalTimeStep() for one in outlines)
        assert step > .3 * alone
        if digits >= 6:
            assert not any('moved' in one for one in told)


def test_theMessageStatesHowManyAndHowFar():
    wall = touching.rounded(touching.turned(touching.bricks(3, 3), .7), 3)
    _, told = addAll(wall, .0325)
    moved = [one for one in told if 'vertices were moved' in one]
    assert moved
    for one in moved:
        farthest = float(re.search(r'at most (\S+) m', one)[1])
        assert 3e-5 < farthest < .1 * .0325


@pytest.mark.parametrize('n', [5, 40])
def test_digitisedGrainsAreAdded(n):
    for seed in range(3):
        grains = yadefrag.voronoi(yadefrag.rectangle((0, 0), (1, .7)), n, seed, rounds=2, shortest=.03)
        for error in (1e-8, 1e-5, 5e-4):
            outlines = touching.digitised(grains, error, seed)
            try:
                solver, _ = addAll(outlines, .05)
            except ValueError as refused:  # three bodies with gaps between them: the remedy helps
                assert n > 5 and 'snapOutlines, for all outlines before they are added' in str(refused)
                solver, _ = addAll(yadefrag.snapOutlines(outlines, 4 * error)[0], .05, snap=0)
            assert len(solver.surfaces) == n
            assert solver.masses.sum() == pytest.approx(2000 * .7, rel=.02)


def test_smallOverlapsOfManyShapes():
    """Concave and smooth outlines, holes, moved bodies: each with an overlap of 2 % of the size."""
    low = [(0, 0), (1, 0), (1, 1), (.6, 1), (.6, .4), (.4, .4), (.4, 1), (0, 1)]
    ring = yadefrag.rectangle((0, 0), (1, 1)), [yadefrag.rectangle((.3, .3), (.7, .7))]
    disc = yadefrag.circle((.5, 1.498), .5, 48)
    for first, second in (((low, ()), (yadefrag.rectangle((.398, .398), (.602, 1.2)), ())),
                          ((low, ()), (yadefrag.rectangle((-.2, .998), (1.2, 1.3)), ())),
                          (ring, (yadefrag.rectangle((.298, .299), (.702, .7)), ())),
                          ((yadefrag.rectangle((.3, .3), (.7, .7)), ()),
                           (ring[0], [yadefrag.rectangle((.302, .301), (.698, .7))]))):
        solver = solverOf()
        solver.addPolygon(*first, size=.1, material='m')
        with pytest.warns(UserWarning, match='vertices were moved'):
            solver.addPolygon(*second, size=.1, material='m')
        assert solver.deepestOverlap() < 1e-12
    for smooth in (True, [True] * 48):
        solver = square()
        with pytest.warns(UserWarning, match='vertices were moved'):
            solver.addPolygon(disc, size=.1, material='m', smooth=smooth)
        assert solver.deepestOverlap() < 1e-12


def test_aBodyThatHasMovedIsWhereItIs():
    solver = square(velocity=(3, 0), spin=2)
    engines(solver)
    for _ in range(30):
        O.step()
    corner = solver.nodes[np.argmax(solver.nodes[:, 0])]
    beside = yadefrag.rectangle((corner[0] - .002, -1), (2, 2))
    with pytest.warns(UserWarning, match='vertices were moved'):
        solver.addPolygon(beside, size=.1, material='m')
    assert solver.deepestOverlap() < 1e-12
    # A refused body must not leave places of bodies that then move.
    with pytest.raises(ValueError, match='overlaps body 0'):
        solver.addPolygon(yadefrag.rectangle((.3, .3), (.6, .6)), size=.1, material='m')
    for _ in range(30):
        O.step()
    corner = solver.nodes[np.argmin(solver.nodes[:, 0])]
    with pytest.raises(ValueError, match='overlaps body 0'):
        solver.addPolygon(yadefrag.rectangle((-1, -1), (corner[0] + .05, 2)), size=.1, material='m')


def test_theRefusalStatesTheOverlapAndARemedyThatHelps():
    solver = square()
    beside = yadefrag.rectangle((.98, .1), (2, .8))
    with pytest.raises(ValueError, match=r'^The new body overlaps body 0 at \(.*\) m by 0\.02 m; it may touch others at the '
                       r'start, but not overlap them.* snap=0\.044 moves') as error:
        solver.addPolygon(beside, size=.1, material='m')
    snap = float(re.search(r'snap=(\S+) ', str(error.value))[1])
    with pytest.warns(UserWarning, match='vertices were moved'):
        body = solver.addPolygon(beside, size=.1, material='m', snap=snap)
    assert solver.nodes[solver.nodesOf(body), 0].min() == 1
    with pytest.raises(ValueError, match=r'by 0\.\d+ m; .* Move it by that'):
        solver.addPolygon(yadefrag.rectangle((-1, .1), (.3, .7)), size=.1, material='m')
    tiny = yadefrag.rectangle((-1, .1), (1e-5, .7))
    with pytest.raises(ValueError, match=r'by 1e-05 m; .* snap=2.2e-05 moves'):
        solver.addPolygon(tiny, size=.1, material='m', snap=0)
    # A copy has no side in the other one, and overlaps nevertheless.
    with pytest.raises(ValueError, match='overlaps body 0 .* Move it'):
        solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.1, material='m')


# --- outlines that are given the same points; bonds

def test_gapsAreClosedOnRequest():
    solver = square()
    before = len(solver.nodes)
    with pytest.warns(UserWarning, match='2 vertices were moved'):
        solver.addPolygon([(1.003, .002), (2, 0), (2, 1), (1.002, .999)], size=.1, material='m', snap=.01)
    nodes = {tuple(p) for p in solver.nodes[:before]}
    assert sum(tuple(p) in nodes for p in solver.nodes[before:]) == 11
    assert solver.bond(0, 1, 1e6, 100) == 10


@pytest.mark.parametrize('seed', range(4))
def test_allNeighboursAreBonded(seed):
    outlines = touching.turned(touching.rubbleMasonry(4, seed), .4 + seed)
    exact = sum(map(area, outlines))
    shapes, report = yadefrag.snapOutlines(touching.rounded(outlines, 3), .004)
    assert report['moved'] > 0 and report['inserted'] > 10 and 0 < report['farthest'] < .004
    solver, _ = addAll(shapes, .04, snap=0)
    assert solver.masses.sum() == pytest.approx(2000 * exact, rel=.01)
    with warnings.catch_warnings(action='error'):
        sides = solver.bondAll(.004, 1e7, 5e4)
    assert sides > 40 and len(solver.fragments(held=True)) == 1


def test_grainsAndHolesAreGivenTheSamePoints():
    grains = yadefrag.voronoi(yadefrag.rectangle((0, 0), (1, 1)), 30, 5, rounds=3, shortest=.04)
    shapes, _ = yadefrag.snapOutlines(touching.digitised(grains, 1e-4, 5), 1e-3)
    points = {p for shape in shapes for p in shape}
    assert len(points) == len({p for grain in grains for p in grain})
    # An inclusion in a hole, digitised apart, in the other direction.
    disc = yadefrag.circle((.5, .5), .2, 30)
    plate = yadefrag.rectangle((0, 0), (1, 1)), [touching.digitised([disc], 1e-3, 1)[0][::-1]]
    shapes, report = yadefrag.snapOutlines([plate, (disc, [])], .01)
    assert set(shapes[0][1][0]) == set(shapes[1][0]) and report['moved'] == 30
    assert np.sign(area(shapes[0][1][0])) == np.sign(area(plate[1][0]))
    solver = solverOf()
    for shape in shapes:
        solver.addPolygon(*shape, size=.05, material='m')
    assert solver.bondAll(.01, 1e6, 1e4) == 30


def test_aCoarserBodyIsGivenTheNodesOfAFinerOne():
    """Its mesh then is even, other than where bond divides its sides."""
    solver = square(.05)
    solver.addPolygon(yadefrag.rectangle((1, 0), (2, 1)), size=.08, material='m', snap=1e-6)
    triangles = len(solver.triangles)
    assert solver.bond(0, 1, 1e6, 1e4) == 20 and len(solver.triangles) == triangles


# --- joints

def plateOf(joints, size=.05, **given):
    solver = solverOf()
    with heard() as texts:
        solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=size, material=brittle(fractureEnergy=50), joints=joints, **given)
    return solver, texts


@pytest.mark.parametrize('count', [10, 60, 150])
def test_tracesThatNearlyMeetAreJoined(count):
    whole = plateOf(())[0].criticalTimeStep()
    for seed in range(3):
        joints = touching.traces(count, seed)
        solver, told = plateOf(joints)
        joined = [one for one in told if 'were joined' in one]
        assert len(joined) == 1
        assert float(re.search(r'at most (\S+) m', joined[0])[1]) < .2 * .05
        assert solver.criticalTimeStep() > whole / 40
        for one in told:  # advice is what has been measured
            advice = re.search(r'snap=(\S+) reduces that to (\S+)\.$', one)
            if advice:
                wider, again = plateOf(joints, snap=float(advice[1]))
                assert wider.criticalTimeStep() > 1.9 * solver.criticalTimeStep()
        # The traces are where they were: each joint's sides are near their line.
        ends = np.array(solver.nodes)
        assert solver.masses.sum() == pytest.approx(2500)
        assert ends.min() > -1e-15 and ends.max() < 1 + 1e-15


def test_jointsWithoutToleranceAreAsGiven():
    joints = [((0, .5), (1, .52)), ((.3, 0), (.3, .50601))]
    exact, told = plateOf(joints, snap=0)
    assert not any('joined' in one for one in told)
    assert any('snap=0.015 reduces that' in one for one in told)
    joined, told = plateOf(joints)
    assert any('joined' in one for one in told)
    assert joined.criticalTimeStep() > 100 * exact.criticalTimeStep()


def test_theAdviceForAnOutlineIsMeasured():
    """Nothing helps against a thin web; simplify= against vertices too many: test_mesh_object.py."""
    web = yadefrag.rectangle((0, 0), (1, 1)), [yadefrag.rectangle((.4, .4), (.9985, .6))]
    solver = solverOf()
    with pytest.warns(UserWarning, match='Neither simplify= nor snap= reduces that'):
        solver.addPolygon(*web, size=.1, material='m')


# --- units of length

def meshOf(outline, holes, size, scale, shift, irregular, joints=()):
    def scaled(points):
        return np.ascontiguousarray(scale * np.array(points, float) + shift)
    lines = scaled(np.array(joints, float).reshape(-1, 2)).reshape(-1, 4)
    return yadefrag._yadefrag.meshOfPolygon(
        scaled(outline), [scaled(hole) for hole in holes], (scale * size,), irregular, 3, lines, 0.)


@pytest.mark.parametrize('irregular', [False, True])
def test_meshesDoNotDependOnTheUnit(irregular):
    random = np.random.default_rng(4)
    blob = [(r * np.cos(a), r * np.sin(a)) for a, r in zip(np.linspace(0, 2 * np.pi, 24)[:-1],
                                                            np.round(random.uniform(.06, .1, 23), 4))]
    plate = yadefrag.rectangle((0, 0), (.04, .02))
    hole = yadefrag.circle((.02, .01), .004, 20)
    for outline, holes, size, joints in ((plate, [], .001, ()), (plate, [hole], .0007, ()),
                                         (yadefrag.circle((.3, .2), .05), [], .003, ()), (blob, [], .007, ()),
                                         (plate, [], .001, [((.003, .004), (.031, .0171))])):
        first = meshOf(outline, holes, size, 1, 0, irregular, joints)
        for scale, shift in ((1000, 0), (1e-3, 0), (100, 0), (1 / .0254, 0), (2.**-40, 0), (1000, 250)):
            again = meshOf(outline, holes, size, scale, shift, irregular, joints)
            assert np.array_equal(again.triangles, first.triangles), (scale, shift)
            assert again.nodes == pytest.approx(scale * first.nodes + shift, rel=1e-9, abs=1e-9 * scale * size)
