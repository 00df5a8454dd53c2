"""CurveLoop with Law2_ScGeom6D_CohFrictPhys_CohesionMoment: the bits of YADE's loop, with each option."""
import os

import numpy as np
import pytest
import yade.config
import yade.wrapper as w

import law_twins
from law_twins import denseHeap, geometries, requireSame, some
from scenes import O, heap

pytestmark = pytest.mark.skipif(yade.config.version > '2025', reason='this law of later versions is left to YADE')

# Arguments of the material, of the functors for properties and law, and of that for two spheres.
kTurning = dict(momentRotationLaw=True)
kBonds = dict(setCohesionOnNewContacts=True)
kOptions = dict(
    friction=({}, {}, {}, {}),
    brittle=({}, kBonds, {}, {}),
    strong=(dict(kTurning, normalCohesion=1e7, shearCohesion=1e7), kBonds, {}, {}),
    ductile=(dict(fragile=False), kBonds, {}, {}),
    now=(kTurning, dict(setCohesionNow=True), {}, {}),
    turning=(kTurning, kBonds, {}, {}),
    always=(kTurning, kBonds, dict(always_use_moment_law=True), {}),
    incremental=(kTurning, kBonds, dict(useIncrementalForm=True), {}),
    limited=(dict(kTurning, etaRoll=.05, etaTwist=.02), kBonds, dict(useIncrementalForm=True, always_use_moment_law=True), {}),
    stiff=(dict(kTurning, alphaKr=.5, alphaKtw=3), kBonds, {}, {}),
    creep=(kTurning, kBonds, dict(shear_creep=True, creep_viscosity=2e4), dict(creep=True)),
    still=(kTurning, kBonds, {}, dict(updateRotations=False)),
    distant=(kTurning, kBonds, dict(neverErase=True), dict(interactionDetectionFactor=1.1)),
    ratcheting=(kTurning, kBonds, {}, dict(avoidGranularRatcheting=False)))
kMost = dict(kTurning, etaRoll=.05, etaTwist=.02), kBonds, dict(useIncrementalForm=True, shear_creep=True, creep_viscosity=2e4), {}


def material(**values):
    return w.CohFrictMat(**dict(dict(young=1e7, poisson=.3, density=2000, frictionAngle=.4, normalCohesion=1e5,
                                     shearCohesion=1e5), **values))


def cohesive(properties=None, law=None, sphere=None):
    return (geometries('6D', **(sphere or {})), [w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(**(properties or {}))],
            [w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment(**(law or {}))])


def requireSameWith(options, steps, **settings):
    return requireSame(lambda: cohesive(*options[1:]), steps, lambda: material(**options[0]), **settings)


@pytest.mark.parametrize('kind', kOptions)
@pytest.mark.parametrize('build', [heap, denseHeap])
def test_bits(kind, build):
    loop = requireSameWith(kOptions[kind], 80 if build is denseHeap else 700, build=build)
    contacts = [i.phys for i in O.interactions]
    assert loop.fastForces == len(contacts)
    assert build is heap or len(O.interactions) > len(O.bodies) and loop.fastGeometries > .5 * len(contacts)
    bonds = sum(not p.cohesionBroken for p in contacts)
    assert bonds == 0 if kind == 'friction' else bonds > 0 or kind == 'now'
    turning = any(p.moment_twist.norm() > 0 and p.moment_bending.norm() > 0 for p in contacts)
    assert turning == ('momentRotationLaw' in kOptions[kind][0]) or kind == 'now'


@pytest.mark.parametrize('build', law_twins.kScenes)
@pytest.mark.parametrize('kind', ['turning', 'most'])
def test_scenes(build, kind):
    values, *functors = kMost if kind == 'most' else kOptions[kind]
    law_twins.requireSameIn(build, lambda: cohesive(*functors), material=lambda: material(**values))


@pytest.mark.parametrize('ending', [None, 'xml', 'yade.gz'])
def test_changesBetweenSteps(ending, folder):
    """Bonds that a script makes, weakens and ends, options that it changes; a scene that it saves and loads."""
    def change(part):
        properties, = O.engines[2].physDispatcher.functors
        law, = O.engines[2].lawDispatcher.functors
        for number, contact in enumerate(O.interactions):
            phys = contact.phys
            phys.initCohesion = number % 5 == part
            phys.fragile, phys.cohesionDisablesFriction = number % 3 > 0, number % 2 == 0
            phys.unpMax = (-1, 0, 1e-3)[number % 3]
            phys.shearAdhesion *= .5 * part
        list(O.interactions)[part].phys = None
        O.bodies.erase(70 + part)
        properties.setCohesionNow = part == 2
        law.useIncrementalForm, law.always_use_moment_law = part % 2 == 0, part > 0
        if ending:
            law_twins.saveAndLoad(os.path.join(folder, 'scene.' + ending))
    loop = requireSameWith(kOptions['turning'], 160, build=denseHeap, change=change)
    assert loop.fastForces >= O.interactions.countReal() > 200 or ending


@pytest.mark.parametrize('reason', ['traceEnergy', 'O.trackEnergy', 'twist_creep'])
def test_leftToYade(reason):
    law = {} if reason[0] == 'O' else {reason: True}

    def build(**settings):
        denseHeap(**settings)
        O.trackEnergy = reason == 'O.trackEnergy'
    try:
        loop = requireSameWith((kTurning, kBonds, law, {}), 80, build=build)
        assert loop.fastForces == 0
        assert 'CohesionMoment, since %s is set.' % reason in loop.report()
    finally:
        O.trackEnergy = False


def test_warnedOf():
    """YADE's law warns of limits in the form that does not depend on the way: it is called for these contacts."""
    options = dict(kTurning, etaRoll=.05), kBonds, {}, {}
    loop = requireSameWith(options, 12, build=denseHeap)
    assert loop.fastForces == 0 and 'since YADE warns of limits of moments without useIncrementalForm.' in loop.report()
    loop.lawDispatcher.functors[0].useIncrementalForm = True
    O.step()
    assert loop.fastForces == O.interactions.countReal() and 'force by YADE' not in loop.report()


def drawn(chance):
    values = some(chance, fragile=False, normalCohesion=10**chance.uniform(3, 7), shearCohesion=10**chance.uniform(3, 7),
                  alphaKr=chance.uniform(0, 5), alphaKtw=chance.uniform(0, 5), frictionAngle=chance.uniform(0, 1),
                  poisson=chance.uniform(0, .5), momentRotationLaw=True)
    law = some(chance, always_use_moment_law=True, shear_creep=True, useIncrementalForm=True, neverErase=True,
               creep_viscosity=10**chance.uniform(3, 7))
    if 'useIncrementalForm' in law:
        values |= some(chance, etaRoll=chance.uniform(0, .5), etaTwist=chance.uniform(0, .5))
    sphere = some(chance, interactionDetectionFactor=chance.uniform(1, 1.2), avoidGranularRatcheting=False,
                  updateRotations=False, creep=True)
    return values, some(chance, setCohesionOnNewContacts=True, setCohesionNow=True), law, sphere


@pytest.mark.parametrize('seed', range(16))
def test_randomOptions(seed):
    options = drawn(np.random.default_rng(seed))
    build = [heap, denseHeap, law_twins.shearedHeap][seed % 3]
    loop = requireSameWith(options, 80 if seed % 3 == 1 else 500, build=build)
    assert loop.fastForces == O.interactions.countReal(), options
