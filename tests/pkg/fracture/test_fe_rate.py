"""rateEffect: the strength increases with the strain rate, from Python."""
import builtins
import warnings

import numpy as np
import pytest

import yadefrag
from refused import assertRefused
from yade import wrapper as w

O = builtins.O
kStrength, kEnergy, kYoung, kPoisson, kLength, kHeight = 3e6, 100., 30e9, .2, .06, .03
kTable = [(1, 1), (100, 4)]


def ceb(rate):
    """fib Model Code 2010, 5.1.11.2, in tension."""
    if rate <= 1e-6:
        return 1
    return (rate / 1e-6)**.018 if rate <= 10 else .0062 * (min(rate, 300) / 1e-6)**(1 / 3)


def concrete(**more):
    return w.BrittleFEMat(**dict(dict(young=kYoung, poisson=kPoisson, density=2400, frictionAngle=.6, planeStress=True,
                                      tensileStrength=kStrength, fractureEnergy=kEnergy, label='concrete'), **more))


def bar(rate, start, material=None, **more):
    """A bar whose ends part at a constant strain rate; `start`: stress at the begin over the strength."""
    O.materials.append(material or concrete(**more))
    stretch = kStrength / kYoung
    fe = w.FESolver()
    fe.addPolygon(yadefrag.rectangle((0, 0), (kLength, kHeight)), size=.005, material=0,
                  velocity=lambda x, y: (rate * x, -kPoisson * rate * y),
                  displacement=lambda x, y: (start * stretch * x, -kPoisson * start * stretch * y),
                  fixed=lambda x, y: x < 1e-9 or x > kLength - 1e-9)
    O.engines = yadefrag.engines(fe)
    O.dt = .2 * fe.criticalTimeStep()
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
    (kTable, 10, 2), (kTable, .5, 1)], ids=str)
def test_aBarHasTheStrengthOfItsStrainRate(effect, rate, factor):
    fe = bar(rate, .95, rateEffect=effect)
    # 200 steps from the strength of a slow test on, if the critical step permits.
    O.dt = min(O.dt, max(factor - 1, .2) * kStrength / kYoung / rate / 200)
    assert peak(fe) / kStrength == pytest.approx(factor, rel=.01)
    table = yadefrag.crackTable(fe)
    assert table['strength'] / kStrength == pytest.approx(np.full(len(table), factor), rel=.01)
    assert table['energy'] / kEnergy == pytest.approx(np.full(len(table), factor), rel=.01)


def test_theEnergyFollowsByItsPower():
    for power in (0, .5, 2):
        O.reset()
        fe = bar(50, .95, rateEffect='ceb-fip-2010', rateEnergyPower=power)
        peak(fe)
        table = yadefrag.crackTable(fe)
        assert table['energy'] / kEnergy == pytest.approx((table['strength'] / kStrength)**power, rel=1e-9)


def test_anEffectMultipliesWhatAnEdgeHas():
    """Strength by place, scatter, and that of a joint."""
    O.materials.append(concrete(rateEffect=[(1e-3, 2), (1e3, 2)], strengthScatter=.1))
    fe = w.FESolver()
    fe.addPolygon(yadefrag.rectangle((0, 0), (kLength, kHeight)), size=.005, material=0,
                  strength=lambda x, y: kStrength / 2, joints=[((kLength / 2, -1), (kLength / 2, 1))],
                  jointStrength=kStrength / 4, jointEnergy=kEnergy,
                  velocity=lambda x, y: (50 * x, 0), fixed=lambda x, y: x < 1e-9 or x > kLength - 1e-9)
    O.engines = yadefrag.engines(fe)
    O.dt = .2 * fe.criticalTimeStep()
    while fe.numCracks < 20:
        O.run(10, True)
    table = yadefrag.crackTable(fe)
    isJoint = abs(table['x'] - kLength / 2) < 1e-5
    assert isJoint.any() and table['strength'][isJoint] == pytest.approx(np.full(isJoint.sum(), kStrength / 2))
    others = table['strength'][~isJoint] / kStrength
    assert len(others) and (others > .89).all() and (others < 1.11).all() and np.ptp(others) > 1e-3


def test_aNameOrPointsAreGivenAndReturned():
    material = w.BrittleFEMat()
    assert material.rateEffect == 'none' and material.rateEnergyPower == 1
    for one in ('ceb-fip-2010', kTable, 'none'):
        material.rateEffect = one
        assert material.rateEffect == one and material.dict()['rateEffect'] == one
        assert w.BrittleFEMat(rateEffect=one).rateEffect == one
    material.rateEffect = np.array(kTable)
    assert material.rateEffect == kTable


@pytest.mark.parametrize('given, kind, message', [
    ('ceb', ValueError, "rateEffect is 'ceb'; it must be one of 'none', 'ceb-fip-2010', or points"),
    ('', ValueError, "rateEffect is ''; it must be one of"),
    ([], ValueError, 'rateEffect has no points; it must have at least two'),
    ([(1, 1)], ValueError, 'rateEffect has one point; it must have at least two'),
    ([(1, 1), (.5, 2)], ValueError, 'rateEffect has the strain rate 0.5 1/s after 1 1/s; rates must increase'),
    ([(1, 1), (2, .5)], ValueError, 'rateEffect has the factor 0.5; factors must be from 1'),
    ([(-1, 1), (2, 2)], ValueError, 'rateEffect has the strain rate -1 1/s; rates must be positive'),
    ([(1, 1), (float('nan'), 2)], ValueError, 'rates must be positive and finite'),
    ([(1, 1), (2, float('nan'))], ValueError, 'rateEffect has the factor nan'),
    (3, TypeError, 'rateEffect is 3, it must be a name, or a list of points (strain rate in 1/s, factor'),
    (None, TypeError, 'rateEffect is None, it must be a name'),
    ([1, 2], TypeError, 'it must be a name, or a list of points'),
    ([(1, 1, 1), (2, 2, 2)], TypeError, 'it must be a name, or a list of points')])
def test_othersAreRefusedByOneSentence(given, kind, message):
    assertRefused('rateEffect', given, kind, message)


@pytest.mark.parametrize('power', [-1, 11, float('nan'), float('inf')])
def test_aWrongPowerIsRefusedWithTheBody(power):
    O.materials.append(concrete(rateEnergyPower=power))
    fe = w.FESolver()
    with pytest.raises(ValueError, match='rateEnergyPower is .*; it must be from 0, for an energy'):
        fe.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material=0)
    assert len(fe.nodes) == 0 and len(O.bodies) == 0


def test_messagesAndTheStepCountTheLargestFactor():
    zone = kYoung * kEnergy / kStrength**2  # .33 m
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
