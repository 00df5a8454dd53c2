"""rateEffect: the strength increases with the strain rate, from Python."""
import builtins
import warnings

import numpy as np
import pytest

import yadefrag
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
