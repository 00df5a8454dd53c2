"""Bonds of bodies, whose nodes may differ along their common sides; strength and fracture energy by place, joints, grains;
rateEffect, by which the strength increases with the strain rate. Bars of each curve and rate: tests/fracture."""
import math
import warnings

import numpy as np
import pytest

import outline_files as touching
import yadefrag
from fe_scene import bodyOf, brittle, cracks, engines, heard, momentum, O, ready
from outline_files import area
from yade import utils, wrapper as w


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


def shifted():
    """A block on another one, 1 mm beside its corner."""
    solver = solverOf()
    for low, high in (((0, 0), (.2, .1)), ((.001, .1), (.2, .2))):
        solver.addPolygon(yadefrag.rectangle(low, high), size=.02, material='m')
    return solver


def test_cornersThatAreJoinedAreReported():
    with pytest.warns(UserWarning, match=r'bond: a corner of an outline was moved by up to 0.001 m'):
        assert shifted().bond(0, 1, 1e6, 1e4) == 10


def test_sidesThatCannotBeJoinedAreReported():
    """That nothing changes: Conform.ARefusedBondLeavesTheWorldUnchanged of tests/fracture."""
    solver = shifted()
    solver.prescribe(lambda x, y: True, vx=[(0, 0), (1, 1)], vy=0)
    with pytest.raises(ValueError, match='sides of the bodies 0 and 1 coincide but have different ends'):
        solver.bond(0, 1, 1e6, 1e4)
    with pytest.raises(ValueError, match='bondAll: 20 sides within 1e-06 m of another body are not bonded'):
        solver.bondAll(1e-6, 1e6, 1e4)


# --- joints

kJoint = [((.03, .01), (.07, .01))]


def plate(joints=kJoint, **given):
    return bodyOf(yadefrag.rectangle((0, 0), (.1, .02)), .004, brittle(fractureEnergy=20), joints=joints, **given)


def test_anOpenJointIsTwoFacesFromTheStart():
    cut = plate()
    assert cut.numCracks == 0 and len(cut.fragments()) == 1
    places = cracks(cut)
    assert len(places) >= 8 and np.all(np.abs(places[:, 1] - .01) < 1e-12)
    assert places[:, 0].min() > .03 and places[:, 0].max() < .07  # its ends are the crack's tips
    faces = [loop for loop in cut.surfaces if len(loop) == 2 * (len(places) + 1)]
    assert len(faces) == 1 and len(cut.surfaces) == 2
    assert len(O.bodies) == sum(map(len, cut.surfaces))
    engines(cut)
    O.run(20, True)
    assert abs(cut.energy['total']) < 1e-20  # rounding


# --- grains

def test_grainsAsJointsOfOneBody():
    outline = yadefrag.rectangle((0, 0), (.1, .02))
    whole = plate(joints=()).criticalTimeStep()
    O.reset()
    grains = yadefrag.voronoi(outline, 30, seed=2, rounds=3, shortest=.0015)
    joints = yadefrag.grainJoints(grains)
    open_ = plate(joints=joints)
    assert len(open_.fragments()) == 30
    assert sorted(f['area'] for f in open_.fragments()) == pytest.approx(sorted(map(area, grains)), rel=1e-9)
    O.reset()
    weak = plate(joints=joints, jointStrength=1e6)
    assert weak.criticalTimeStep() > whole / 8  # with sides of any length: a 200th
    assert len(weak.fragments()) == 1
    engines(weak)
    O.run(20, True)
    assert weak.numCracks == 0


def test_grainsAsBodies():
    solver = w.FESolver()
    for grain in yadefrag.voronoi(yadefrag.rectangle((0, 0), (.1, .02)), 12, seed=2, rounds=3):
        solver.addPolygon(grain, size=.004, material=brittle())
    engines(solver)
    O.run(50, True)
    assert solver.maxPenetration < 1e-12 and solver.energy['kinetic'] < 1e-15


# --- the strain rate

kConcreteStrength, kConcreteEnergy, kYoung, kPoisson, kConcreteLength, kConcreteHeight = 3e6, 100., 30e9, .2, .06, .03


def concrete(**more):
    return w.BrittleFEMat(**dict(dict(young=kYoung, poisson=kPoisson, density=2400, frictionAngle=.6, planeStress=True,
                                      tensileStrength=kConcreteStrength, fractureEnergy=kConcreteEnergy,
                                      label='concrete'), **more))


def test_anEffectMultipliesWhatAnEdgeHas():
    """Strength by place, scatter, and that of a joint."""
    fe = bodyOf(yadefrag.rectangle((0, 0), (kConcreteLength, kConcreteHeight)), .005,
                concrete(rateEffect=[(1e-3, 2), (1e3, 2)], strengthScatter=.1),
                strength=lambda x, y: kConcreteStrength / 2,
                joints=[((kConcreteLength / 2, -1), (kConcreteLength / 2, 1))], jointStrength=kConcreteStrength / 4,
                jointEnergy=kConcreteEnergy, velocity=lambda x, y: (50 * x, 0),
                fixed=lambda x, y: x < 1e-9 or x > kConcreteLength - 1e-9)
    ready(fe, .2)
    while fe.numCracks < 20:
        O.run(10, True)
    table = yadefrag.crackTable(fe)
    isJoint = abs(table['x'] - kConcreteLength / 2) < 1e-5
    assert isJoint.any() and table['strength'][isJoint] == pytest.approx(np.full(isJoint.sum(), kConcreteStrength / 2))
    others = table['strength'][~isJoint] / kConcreteStrength
    assert len(others) and (others > .89).all() and (others < 1.11).all() and np.ptp(others) > 1e-3


def test_messagesAndTheStepCountTheLargestFactor():
    zone = kYoung * kConcreteEnergy / kConcreteStrength**2  # .33 m
    said = {}
    for effect in ('none', 'ceb-fip-2010'):
        O.reset()
        with heard() as said[effect]:
            bodyOf(yadefrag.rectangle((0, 0), (.8, .7)), zone / 10, concrete(rateEffect=effect))
    assert said['none'] == []
    assert len(said['ceb-fip-2010']) == 1
    assert ', with the factor 4.15 of rateEffect: the cohesive zone is 0.08031 m long' in said['ceb-fip-2010'][0]
