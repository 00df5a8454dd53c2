"""CurveLoop with Law2_ScGeom_ViscElPhys_Basic: the bits of YADE's loop, for each way to give the material's constants."""
import os

import numpy as np
import pytest
import yade.wrapper as w

import law_twins
from law_twins import denseHeap, geometries, requireSame, some
from scenes import O, heap

kElastic = dict(kn=1e7, ks=5e6, cn=0, cs=0)
kDamped = dict(kn=1e7, ks=5e6, cn=3e4, cs=2e4)
kMaterials = dict(
    elastic=kElastic,
    damped=kDamped,
    times=dict(tc=.04, en=.3, et=.4),
    restitution=dict(young=1e7, poisson=.3, en=.4),
    smooth=dict(kDamped, frictionAngle=.02),
    rolling=dict(kDamped, mR=.2),
    rollingFaster=dict(kDamped, mR=1e-3, mRtype=2),
    all=dict(kDamped, frictionAngle=.1, mR=.1))


def material(frictionAngle=.4, **values):
    return w.ViscElMat(density=2000, frictionAngle=frictionAngle, **values)


def viscous(**sphere):
    return geometries(**sphere), [w.Ip2_ViscElMat_ViscElMat_ViscElPhys()], [w.Law2_ScGeom_ViscElPhys_Basic()]


@pytest.mark.parametrize('kind', kMaterials)
@pytest.mark.parametrize('build', [heap, denseHeap])
def test_bits(kind, build):
    values = kMaterials[kind]
    loop = requireSame(viscous, 80 if build is denseHeap else 700, lambda: material(**values), build=build)
    contacts = [i.phys for i in O.interactions]
    assert build is heap or len(O.interactions) > len(O.bodies)
    assert loop.fastForces == len(contacts) >= loop.fastGeometries > .5 * len(contacts)
    # The constants do something; some contacts would attract.
    assert any(p.Fv != 0 for p in contacts) == (kind != 'elastic')
    assert any(p.Fn + p.Fv < 0 == p.normalForce.norm() for p in contacts) or kind != 'damped'
    assert any(p.mR > 0 for p in contacts) == ('mR' in values)
    limits = [p.normalForce.norm() * p.tangensOfFrictionAngle - p.shearForce.norm() for p in contacts]
    assert min(limits) < 1e-9 and (max(limits) > 1 or kind == 'smooth')


@pytest.mark.parametrize('build', law_twins.kScenes)
def test_scenes(build):
    law_twins.requireSameIn(build, viscous, material=lambda: material(**kMaterials['all']))


@pytest.mark.parametrize('ending', [None, 'xml', 'yade.gz'])
def test_changesBetweenSteps(ending, folder):
    """Constants that a script changes, contacts that it ends or switches off; a scene that it saves and loads."""
    def change(part):
        for number, contact in enumerate(O.interactions):
            contact.phys.cn, contact.phys.kn = 1e4 * part, 1.1 * contact.phys.kn
            contact.phys.mR, contact.phys.mRtype = 1e-3 * (number % 3), number % 4
            contact.isActive = number % 7 > 0
        list(O.interactions)[part].phys = None
        O.bodies.erase(70 + part)
        if ending:
            law_twins.saveAndLoad(os.path.join(folder, 'scene.' + ending))
    loop = requireSame(viscous, 160, lambda: material(**kDamped), build=denseHeap, change=change)
    assert loop.fastForces >= O.interactions.countReal() > 200 or ending


def test_mixedWithFriction():
    """Two laws in one loop: that whose properties it has is computed, else the first one."""
    def make(*properties):
        return geometries(), list(properties), [w.Law2_ScGeom_ViscElPhys_Basic(), w.Law2_ScGeom_FrictPhys_CundallStrack()]
    loop = requireSame(lambda: make(w.Ip2_ViscElMat_ViscElMat_ViscElPhys()), 80, lambda: material(**kDamped), build=denseHeap)
    assert loop.fastForces == O.interactions.countReal()
    loop = requireSame(lambda: make(w.Ip2_ViscElMat_ViscElMat_ViscElPhys(), w.Ip2_FrictMat_FrictMat_FrictPhys()), 80,
                       lambda: material(**kDamped), build=denseHeap)
    assert loop.fastForces == 0
    assert 'YADE\'s Law2_ScGeom_ViscElPhys_Basic, since the loop computes one law of a scene.' in loop.report()


def drawn(chance):
    """A material of random constants, and attributes of the geometry."""
    def size(low, high):
        return 10**chance.uniform(low, high)
    ways = [dict(kn=size(6, 7.5), ks=size(5, 7), cn=size(1, 5), cs=size(1, 5)),
            dict(tc=size(-1.7, -1.2), en=chance.uniform(.1, 1), et=chance.uniform(.1, 1)),
            dict(young=size(6, 7.5), poisson=chance.uniform(0, .5), cn=size(1, 5), cs=size(1, 5)),
            dict(young=size(6, 7.5), poisson=chance.uniform(0, .5), en=chance.uniform(.2, .9))]
    values = ways[chance.integers(4)] | some(chance, mR=size(-3, 0), mRtype=2, frictionAngle=chance.uniform(0, 1))
    return values, some(chance, interactionDetectionFactor=chance.uniform(1, 1.2), avoidGranularRatcheting=False)


@pytest.mark.parametrize('seed', range(12))
def test_randomConstants(seed):
    values, sphere = drawn(np.random.default_rng(seed))
    build = [heap, denseHeap, law_twins.shearedHeap][seed % 3]
    loop = requireSame(lambda: viscous(**sphere), 80 if seed % 3 == 1 else 500, lambda: material(**values), build=build)
    assert loop.fastForces == O.interactions.countReal(), values
