"""Strength and fracture energy by place; softening curves of cracks, and rateEffect, by which the strength increases
with the strain rate, from Python."""
import os

import numpy as np
import pytest

import yadefrag
from fe_impact import brittle, cracks, engines
from fe_scene import heard, O, ready, reloaded
from outline_files import area
from yade import wrapper as w

kBarLength, kBarHeight, kWeak, kWeakEnergy, kRate = .1, .02, 5e6, 60., 20.


def inBand(x):
    return abs(x - .7 * kBarLength) < .004


def weakBar(**given):
    """A bar that is drawn at a constant rate of strain; its stress is even."""
    solver = w.FESolver()
    material = brittle(young=1e9, poisson=0, density=1000, planeStress=True, fractureEnergy=1000, tensileStrength=50e6)
    wanted = dict(strength=lambda x, y: kWeak if inBand(x) else 50e6,
                  fractureEnergy=lambda x, y: kWeakEnergy if inBand(x) else 1000)
    solver.addPolygon(yadefrag.rectangle((0, 0), (kBarLength, kBarHeight)), size=.002, material=material,
                      velocity=lambda x, y: (kRate * (x - kBarLength / 2), 0), fixed=lambda x, y: 'x' if x < 1e-9
                      or x > kBarLength - 1e-9 else False, **{**wanted, **given})
    engines(solver, factor=.4)
    return solver


def breakAtItsStrength(solver):
    """The stress when the first edge cracks is the weakest strength, to the node's mean of stresses."""
    while solver.numCracks == 0:
        O.step()
    assert 1e9 * kRate * O.time == pytest.approx(kWeak, rel=.02)
    while len(solver.fragments()) < 2 and O.time < 2e-3:
        O.run(50, True)


def test_aBarBreaksInItsWeakBand():
    solver = weakBar()
    breakAtItsStrength(solver)
    assert len(solver.fragments()) >= 2
    assert all(abs(x - .7 * kBarLength) < .004 + .003 for x, _ in cracks(solver))
    # A path along the edges of an irregular mesh is longer than the section, and some edges beside
    # it open a little.
    spent = solver.energy['fracture'] / (kWeakEnergy * kBarHeight)
    assert .8 < spent < 2.5


def test_arraysAreTheSameAsFunctions(folder):
    first = weakBar()
    middles = (first.nodes[first.triangles]).mean(axis=1)
    O.run(700, True)
    nodes, energy = first.nodes, first.energy
    O.reset()
    again = weakBar(strength=np.array([kWeak if inBand(x) else 50e6 for x, _ in middles]),
                     fractureEnergy=[kWeakEnergy if inBand(x) else 1000 for x, _ in middles])
    O.run(300, True)
    again = reloaded(os.path.join(folder, 'bar.yade'))
    O.run(400, True)
    assert again.numCracks > 0
    assert np.array_equal(again.nodes, nodes) and again.energy == energy


# --- joints

kJoint = [((.03, .01), (.07, .01))]


def plate(**given):
    solver = w.FESolver()
    wanted = dict(size=.004, material=brittle(fractureEnergy=20), joints=kJoint)
    solver.addPolygon(yadefrag.rectangle((0, 0), (.1, .02)), **{**wanted, **given})
    return solver


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


def test_aJointThroughABodyMakesTwo():
    solver = plate(joints=[((.05, -1), (.05, 1))])
    assert len(solver.fragments()) == 2
    assert sum(f['mass'] for f in solver.fragments()) == pytest.approx(2500 * .002)


def test_jointsHoldUpToTheirOwnStrength():
    solver = weakBar(strength=None, fractureEnergy=None, joints=[((.07, 0), (.07, .02))],
                      jointStrength=kWeak, jointEnergy=kWeakEnergy)
    breakAtItsStrength(solver)
    assert np.all(np.abs(cracks(solver)[:, 0] - .07) < 1e-9)
    O.run(400, True)
    # The error goes with how few steps an opening takes (tests/fracture/mode_one_test.cpp).
    assert solver.energy['fracture'] == pytest.approx(kWeakEnergy * kBarHeight, rel=.01)


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


# --- softening

kTable = [(0, 1), (.1, .4), (.5, .3), (1, 0)]
kCurves = ('linear', 'bilinear', 'petersson', 'ceb-fip-2010', 'exponential', 'reinhardt', kTable)
# Of Gc/ft: the critical opening. The table's area is .07 + .14 + .075.
kCritical = dict(zip(map(str, kCurves), (2, 3.6, 3.6, 5, 7, 5.136, 1 / .285)))
kStrength, kEnergy, kLength, kHeight = 2e6, 100., .02, .01


def bar(softening, speed=.5):
    """Two halves of a stiff bar, bonded by a joint; their ends part."""
    O.materials.append(w.BrittleFEMat(young=100e9, poisson=0, density=2500, frictionAngle=0, planeStress=True,
                                      tensileStrength=kStrength, fractureEnergy=kEnergy, softening=softening))
    fe = w.FESolver()
    fe.addPolygon(yadefrag.rectangle((-kLength / 2, 0), (kLength / 2, kHeight)), size=.0025, material=0,
                  joints=[((0, -1), (0, 1))], jointStrength=kStrength, jointEnergy=kEnergy,
                  strength=lambda x, y: 1e3 * kStrength, fractureEnergy=lambda x, y: 0,
                  velocity=lambda x, y: (speed * np.sign(x), 0),
                  fixed=lambda x, y: 'x' if abs(x) > kLength / 2 - 1e-9 else False)
    ready(fe, .5)
    return fe


@pytest.mark.parametrize('softening', kCurves, ids=str)
def test_aJointOpensWithItsEnergyUpToTheCriticalOpening(softening):
    fe = bar(softening)
    # The ends go on: each point of the curve is passed.
    ends = np.nonzero(abs(abs(fe.nodes[:, 0]) - kLength / 2) < 1e-9)[0]
    fe.prescribe(ends[fe.nodes[ends, 0] > 0], vx=[(0, .5)])
    fe.prescribe(ends[fe.nodes[ends, 0] < 0], vx=[(0, -.5)])
    begin = fe.energy['total']
    critical = kCritical[str(softening)] * kEnergy / kStrength
    for _ in range(100):
        O.run(max(1, int(critical / 60 / O.dt)), True)
        cracks = yadefrag.crackTable(fe)
        if len(cracks) and not cracks['held'].any():
            break
    assert len(cracks) == 4 and not cracks['held'].any()
    assert cracks['opening'].min() >= .999 * critical
    assert cracks['opening'].max() < 1.1 * critical
    # The mesh has no other edges that may open: Gc times the section.
    assert fe.energy['fracture'] == pytest.approx(kEnergy * kHeight, rel=2e-3)
    assert fe.energy['total'] == pytest.approx(begin, abs=1e-3 * kEnergy * kHeight)
    assert not fe.warnings


# --- the strain rate

kConcreteStrength, kConcreteEnergy, kYoung, kPoisson, kConcreteLength, kConcreteHeight = 3e6, 100., 30e9, .2, .06, .03
kFactors = [(1, 1), (100, 4)]


def ceb(rate):
    """fib Model Code 2010, 5.1.11.2, in tension."""
    if rate <= 1e-6:
        return 1
    return (rate / 1e-6)**.018 if rate <= 10 else .0062 * (min(rate, 300) / 1e-6)**(1 / 3)


def concrete(**more):
    return w.BrittleFEMat(**dict(dict(young=kYoung, poisson=kPoisson, density=2400, frictionAngle=.6, planeStress=True,
                                      tensileStrength=kConcreteStrength, fractureEnergy=kConcreteEnergy,
                                      label='concrete'), **more))


def drawnBar(rate, start, material=None, **more):
    """A bar whose ends part at a constant strain rate; `start`: stress at the begin over the strength."""
    O.materials.append(material or concrete(**more))
    stretch = kConcreteStrength / kYoung
    fe = w.FESolver()
    fe.addPolygon(yadefrag.rectangle((0, 0), (kConcreteLength, kConcreteHeight)), size=.005, material=0,
                  velocity=lambda x, y: (rate * x, -kPoisson * rate * y),
                  displacement=lambda x, y: (start * stretch * x, -kPoisson * start * stretch * y),
                  fixed=lambda x, y: x < 1e-9 or x > kConcreteLength - 1e-9)
    ready(fe, .2)
    return fe


def peak(fe, steps=5000):
    """(Pa) Mean stress along x before the first crack."""
    a, b, c = np.moveaxis(fe.nodes[fe.triangles], 1, 0)
    areas = np.cross(b - a, c - a)
    for _ in range(steps):
        last = np.average(fe.stress[:, 0], weights=areas)
        O.step()
        if fe.numCracks:
            return last
    pytest.fail('it did not crack')


@pytest.mark.parametrize('effect, rate, factor', [
    ('none', 30, 1), ('ceb-fip-2010', 5, ceb(5)), ('ceb-fip-2010', 50, ceb(50)), ('ceb-fip-2010', 1000, ceb(300)),
    (kFactors, 10, 2), (kFactors, .5, 1)], ids=str)
def test_aBarHasTheStrengthOfItsStrainRate(effect, rate, factor):
    fe = drawnBar(rate, .95, rateEffect=effect)
    # 200 steps from the strength of a slow test on, if the critical step permits.
    O.dt = min(O.dt, max(factor - 1, .2) * kConcreteStrength / kYoung / rate / 200)
    assert peak(fe) / kConcreteStrength == pytest.approx(factor, rel=.01)
    table = yadefrag.crackTable(fe)
    assert table['strength'] / kConcreteStrength == pytest.approx(np.full(len(table), factor), rel=.01)
    assert table['energy'] / kConcreteEnergy == pytest.approx(np.full(len(table), factor), rel=.01)


def test_theEnergyFollowsByItsPower():
    for power in (0, .5, 2):
        O.reset()
        fe = drawnBar(50, .95, rateEffect='ceb-fip-2010', rateEnergyPower=power)
        peak(fe)
        table = yadefrag.crackTable(fe)
        assert table['energy'] / kConcreteEnergy == pytest.approx((table['strength'] / kConcreteStrength)**power, rel=1e-9)


def test_anEffectMultipliesWhatAnEdgeHas():
    """Strength by place, scatter, and that of a joint."""
    O.materials.append(concrete(rateEffect=[(1e-3, 2), (1e3, 2)], strengthScatter=.1))
    fe = w.FESolver()
    fe.addPolygon(yadefrag.rectangle((0, 0), (kConcreteLength, kConcreteHeight)), size=.005, material=0,
                  strength=lambda x, y: kConcreteStrength / 2, joints=[((kConcreteLength / 2, -1), (kConcreteLength / 2, 1))],
                  jointStrength=kConcreteStrength / 4, jointEnergy=kConcreteEnergy,
                  velocity=lambda x, y: (50 * x, 0), fixed=lambda x, y: x < 1e-9 or x > kConcreteLength - 1e-9)
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
        O.materials.append(concrete(rateEffect=effect))
        fe = w.FESolver()
        with heard() as said[effect]:
            fe.addPolygon(yadefrag.rectangle((0, 0), (.8, .7)), size=zone / 10, material=0)
    assert said['none'] == []
    assert len(said['ceb-fip-2010']) == 1
    assert ', with the factor 4.15 of rateEffect: the cohesive zone is 0.08031 m long' in said['ceb-fip-2010'][0]
