"""Softening curves of cracks, and rateEffect, by which the strength increases with the strain rate, from Python."""
import builtins
import warnings

import numpy as np
import pytest

from fe_scene import ready
import yadefrag
from yade import wrapper as w

O = builtins.O
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
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter('always')
            fe.addPolygon(yadefrag.rectangle((0, 0), (.8, .7)), size=zone / 10, material=0)
        said[effect] = [str(one.message) for one in caught]
    assert said['none'] == []
    assert len(said['ceb-fip-2010']) == 1
    assert ', with the factor 4.15 of rateEffect: the cohesive zone is 0.08031 m long' in said['ceb-fip-2010'][0]
