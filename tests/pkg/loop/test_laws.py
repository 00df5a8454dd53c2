"""CurveLoop with each law that it knows beside YADE's loop: the same bits of bodies, contacts and all their attributes,
with each option of the law, in several scenes, with what a script changes and saves between steps. Threads:
test_lifecycle.py; functors, forces of others, and what is left to YADE in general: test_curve_loop.py."""
import os
import types

import numpy as np
import pytest
import yade.config
import yade.wrapper as w
from yade import utils

import scenes
from loop_twins import denseHeap, geometries, requireSame, run, shearedHeap
from scenes import O, heap, packing


# --- scenes

def clumps(material=None):
    """Members count with masses of their own."""
    scenes.clear()
    O.materials.append(material or w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    chance = np.random.default_rng(4)
    for place in np.ndindex(4, 5, 5):
        at = np.array(place) * (1.55, .97, .97) + chance.uniform(-.02, .02, 3)
        clump, _ = O.bodies.appendClumped([utils.sphere(at, .5), utils.sphere(at + (.6, 0, 0), .45)])
        O.bodies[clump].state.vel = chance.normal(0, 2, 3)
    O.dt = 1e-4


def lonelyHeap(**settings):
    """With many bodies that touch nothing the loop reads bodies in place."""
    heap(**settings)
    for number in range(900):
        O.bodies.append(utils.sphere((100 + 3 * (number % 30), 3 * (number // 30), 0), 1, fixed=True))


def manyContacts(**settings):
    """From 2,048 contacts on, geometries and physics are moved together."""
    packing((12, 12, 12), .97, 1e-4, seed=5, **settings)


def shearedAlone(**settings):
    """Bodies are not moved by the shear of the cell."""
    shearedHeap(homoDeform=0, **settings)


# Steps and least number of contacts.
kScenes = {shearedHeap: (700, 40), shearedAlone: (700, 40), clumps: (160, 150), lonelyHeap: (700, 20),
           manyContacts: (160, 2048)}


# --- laws: {option: arguments of the material, of the functors for properties and law, and of that for two spheres}

def some(chance, **values):
    """Each of these with a probability of one half."""
    return {name: value for name, value in values.items() if chance.random() < .5}


def size(chance, low, high):
    return 10**chance.uniform(low, high)


def drawnSphere(chance, **more):
    return some(chance, interactionDetectionFactor=chance.uniform(1, 1.2), avoidGranularRatcheting=False, **more)


def frictMat(**values):
    return w.FrictMat(**dict(young=1e7, poisson=.3, density=2000, frictionAngle=.4) | values)


friction = types.SimpleNamespace(
    physics='Ip2_FrictMat_FrictMat_FrictPhys', law='Law2_ScGeom_FrictPhys_CundallStrack', suffix='', material=frictMat,
    options=dict(
        plain=({}, {}, {}, {}), distant=({}, {}, dict(neverErase=True), dict(interactionDetectionFactor=1.2)),
        traced=({}, {}, dict(traceEnergy=True), {}),
        most=({}, {}, dict(sphericalBodies=False), dict(avoidGranularRatcheting=False))),
    check=lambda contacts, values, properties, law: True,
    alter=lambda phys, number, part: setattr(phys, 'kn', 1.1 * phys.kn),
    toggle=lambda properties, law, part: setattr(law, 'neverErase', part == 1),
    draw=lambda chance: (some(chance, frictionAngle=chance.uniform(0, 1)), {},
                         some(chance, sphericalBodies=False, neverErase=True), drawnSphere(chance)))

# Mindlin's law, with damping, adhesion and moments.
kDamped, kAdhesive, kTurning = dict(en=.4, es=.7), dict(gamma=3e3), dict(krot=4e3, ktwist=2e3, eta=.02)


def checkMindlin(contacts, values, properties, law):
    assert any(p.isSliding for p in contacts) and any(not p.isSliding for p in contacts)
    assert any(p.isAdhesive for p in contacts) == ('includeAdhesion' in law)
    for name, viscous in (('n', 'normalViscous'), ('s', 'shearViscous')):
        assert any(getattr(p, viscous).norm() > 0 for p in contacts) == ('en' in properties or properties.get('beta' + name, 0) > 0)
    assert any(p.momentBend.norm() > 0 and p.momentTwist.norm() > 0 for p in contacts) == ('includeMoment' in law)
    assert 'interactionDetectionFactor' not in values or any(p.kn == 0 for p in contacts)


def alterMindlin(phys, number, part):
    if number % 3 == 0:
        phys.betan, phys.kso = .2 * part, 1.1 * phys.kso


def toggleMindlin(properties, law, part):
    law.includeMoment, law.includeAdhesion = part % 2 == 0, part > 0


def drawMindlin(chance):
    """Options that exclude each other are not both drawn."""
    damping = [some(chance, en=chance.uniform(.1, 1), es=chance.uniform(.1, 1)),
               some(chance, betan=chance.uniform(0, .6), betas=chance.uniform(0, .6))][chance.integers(2)]
    properties = damping | some(chance, krot=size(chance, 1, 6), ktwist=size(chance, 1, 6), eta=size(chance, -3, 1),
                                gamma=size(chance, 0, 5), frictAngle=chance.uniform(0, 1))
    return {}, properties, some(chance, includeAdhesion=True, includeMoment=True, neverErase=True), drawnSphere(chance)


mindlin = types.SimpleNamespace(
    physics='Ip2_FrictMat_FrictMat_MindlinPhys', law='Law2_ScGeom_MindlinPhys_Mindlin', suffix='', material=frictMat,
    options=dict(
        plain=({}, {}, {}, {}), damped=({}, kDamped, {}, {}), normal=({}, dict(betan=.3, betas=0), {}, {}),
        shear=({}, dict(betan=0, betas=.4), {}, {}), friction=({}, dict(frictAngle=.05), {}, {}),
        adhesive=({}, kAdhesive, dict(includeAdhesion=True), {}),
        adhesiveDamped=({}, kAdhesive | kDamped, dict(includeAdhesion=True), {}), notAdhesive=({}, kAdhesive | kDamped, {}, {}),
        turning=({}, kTurning, dict(includeMoment=True), {}),
        elasticTurning=({}, kTurning | dict(eta=0), dict(includeMoment=True), {}),
        distant=({}, kDamped, dict(neverErase=True), dict(interactionDetectionFactor=1.2)),
        ratcheting=({}, kDamped, {}, dict(avoidGranularRatcheting=False)),
        most=({}, kAdhesive | kDamped | kTurning, dict(includeAdhesion=True, includeMoment=True, neverErase=True), {})),
    check=checkMindlin, alter=alterMindlin, toggle=toggleMindlin, draw=drawMindlin)

# The viscoelastic law: its options are ways to give the material's constants.
kViscous = dict(kn=1e7, ks=5e6, cn=3e4, cs=2e4)


def checkViscous(contacts, values, properties, law):
    """Some contacts would attract."""
    assert any(p.Fv != 0 for p in contacts) == (values.get('cn') != 0)
    assert any(p.Fn + p.Fv < 0 == p.normalForce.norm() for p in contacts) or values != kViscous
    assert any(p.mR > 0 for p in contacts) == ('mR' in values)
    limits = [p.normalForce.norm() * p.tangensOfFrictionAngle - p.shearForce.norm() for p in contacts]
    assert min(limits) < 1e-9 and (max(limits) > 1 or values.get('frictionAngle', 1) < .1)


def alterViscous(phys, number, part):
    phys.cn, phys.kn, phys.mR, phys.mRtype = 1e4 * part, 1.1 * phys.kn, 1e-3 * (number % 3), number % 4


def drawViscous(chance):
    ways = [dict(kn=size(chance, 6, 7.5), ks=size(chance, 5, 7), cn=size(chance, 1, 5), cs=size(chance, 1, 5)),
            dict(tc=size(chance, -1.7, -1.2), en=chance.uniform(.1, 1), et=chance.uniform(.1, 1)),
            dict(young=size(chance, 6, 7.5), poisson=chance.uniform(0, .5), cn=size(chance, 1, 5), cs=size(chance, 1, 5)),
            dict(young=size(chance, 6, 7.5), poisson=chance.uniform(0, .5), en=chance.uniform(.2, .9))]
    values = ways[chance.integers(4)] | some(chance, mR=size(chance, -3, 0), mRtype=2, frictionAngle=chance.uniform(0, 1))
    return values, {}, {}, drawnSphere(chance)


viscoelastic = types.SimpleNamespace(
    physics='Ip2_ViscElMat_ViscElMat_ViscElPhys', law='Law2_ScGeom_ViscElPhys_Basic', suffix='',
    material=lambda **values: w.ViscElMat(**dict(density=2000, frictionAngle=.4) | values),
    options={name: (values, {}, {}, {}) for name, values in dict(
        elastic=kViscous | dict(cn=0, cs=0), damped=kViscous, times=dict(tc=.04, en=.3, et=.4),
        restitution=dict(young=1e7, poisson=.3, en=.4), smooth=kViscous | dict(frictionAngle=.02), rolling=kViscous | dict(mR=.2),
        rollingFaster=kViscous | dict(mR=1e-3, mRtype=2), most=kViscous | dict(frictionAngle=.1, mR=.1)).items()},
    check=checkViscous, alter=alterViscous, toggle=lambda properties, law, part: None, draw=drawViscous)

# The cohesive law of bonds that bend and twist.
kIsOld = yade.config.version < '2025'  # moments do not break bonds
kTurns = dict(momentRotationLaw=True) | ({} if kIsOld else dict(normalCohesion=2e6, shearCohesion=2e6))
kBonds = dict(setCohesionOnNewContacts=True)
kLimits = dict(kTurns, etaRoll=.05, etaTwist=.02)


def checkCohesive(contacts, values, properties, law):
    bonds = sum(not p.cohesionBroken for p in contacts)
    assert bonds == 0 if not properties else bonds > 0 or 'setCohesionNow' in properties
    turning = any(p.moment_twist.norm() > 0 and p.moment_bending.norm() > 0 for p in contacts)
    assert turning == ('momentRotationLaw' in values) or 'setCohesionNow' in properties \
        or not kIsOld and 'updateRotations' in values


def alterCohesive(phys, number, part):
    """Bonds that a script makes, weakens and ends."""
    phys.initCohesion = number % 5 == part
    phys.fragile, phys.cohesionDisablesFriction = number % 3 > 0, number % 2 == 0
    phys.unpMax = (-1, 0, 1e-3)[number % 3]
    phys.shearAdhesion *= .5 * part
    if hasattr(phys, 'rollingAdhesion'):  # from 2025.2 on
        phys.rollingAdhesion, phys.twistingAdhesion = .2 * part * phys.rollingAdhesion, .1 * part * phys.twistingAdhesion


def toggleCohesive(properties, law, part):
    properties.setCohesionNow = part == 2
    law.useIncrementalForm, law.always_use_moment_law = part % 2 == 0, part > 0


def drawCohesive(chance):
    values = some(chance, fragile=False, normalCohesion=size(chance, 3, 7), shearCohesion=size(chance, 3, 7),
                  alphaKr=chance.uniform(0, 5), alphaKtw=chance.uniform(0, 5), frictionAngle=chance.uniform(0, 1),
                  poisson=chance.uniform(0, .5), momentRotationLaw=True)
    law = some(chance, always_use_moment_law=True, shear_creep=True, useIncrementalForm=True, neverErase=True,
               creep_viscosity=size(chance, 3, 7))
    if 'useIncrementalForm' in law:
        values |= some(chance, etaRoll=chance.uniform(0, .5), etaTwist=chance.uniform(0, .5))
    return (values, some(chance, setCohesionOnNewContacts=True, setCohesionNow=True), law,
            drawnSphere(chance, updateRotations=False, creep=True))


cohesive = types.SimpleNamespace(
    physics='Ip2_CohFrictMat_CohFrictMat_CohFrictPhys', law='Law2_ScGeom6D_CohFrictPhys_CohesionMoment', suffix='6D',
    material=lambda **values: w.CohFrictMat(**dict(young=1e7, poisson=.3, density=2000, frictionAngle=.4, normalCohesion=1e5,
                                                   shearCohesion=1e5) | values),
    options=dict(
        friction=({}, {}, {}, {}), brittle=({}, kBonds, {}, {}),
        strong=(dict(kTurns, normalCohesion=1e7, shearCohesion=1e7), kBonds, {}, {}), ductile=(dict(fragile=False), kBonds, {}, {}),
        now=(kTurns, dict(setCohesionNow=True), {}, {}), turning=(kTurns, kBonds, {}, {}),
        always=(kTurns, kBonds, dict(always_use_moment_law=True), {}),
        incremental=(kTurns, kBonds, dict(useIncrementalForm=True), {}),
        limited=(kLimits, kBonds, dict(useIncrementalForm=True, always_use_moment_law=True), {}),
        stiff=(dict(kTurns, alphaKr=.5, alphaKtw=3), kBonds, {}, {}),
        creep=(kTurns, kBonds, dict(shear_creep=True, creep_viscosity=2e4), dict(creep=True)),
        still=(kTurns, kBonds, {}, dict(updateRotations=False)),
        distant=(kTurns, kBonds, dict(neverErase=True), dict(interactionDetectionFactor=1.1)),
        ratcheting=(kTurns, kBonds, {}, dict(avoidGranularRatcheting=False)),
        most=(kLimits, kBonds, dict(useIncrementalForm=True, shear_creep=True, creep_viscosity=2e4), {})),
    check=checkCohesive, alter=alterCohesive, toggle=toggleCohesive, draw=drawCohesive)

kLaws = dict(friction=friction, mindlin=mindlin, viscoelastic=viscoelastic, cohesive=cohesive)
byLaw = pytest.mark.parametrize('name', kLaws)
byOption = pytest.mark.parametrize('name, kind', [(name, kind) for name, law in kLaws.items() for kind in law.options])


def functors(one, options):
    _, properties, law, sphere = options
    return geometries(one.suffix, **sphere), [getattr(w, one.physics)(**properties)], [getattr(w, one.law)(**law)]


def requireSameWith(one, options, steps, **settings):
    return requireSame(lambda: functors(one, options), steps, lambda: one.material(**options[0]), **settings)


@byOption
@pytest.mark.parametrize('build', [heap, denseHeap])
def test_bits(name, kind, build):
    one, options = kLaws[name], kLaws[name].options[kind]
    loop = requireSameWith(one, options, 80 if build is denseHeap else 700, build=build)
    contacts = [i.phys for i in O.interactions]
    assert build is heap or len(O.interactions) > len(O.bodies)
    assert name == 'cohesive' and build is heap or loop.fastGeometries > .5 * len(contacts)
    # A contact may end after its geometry.
    assert len(contacts) == loop.fastForces >= loop.fastGeometries - 3
    # The options do something.
    values, properties, law, sphere = options
    one.check(contacts, dict(values, **(sphere if name == 'cohesive' or 'neverErase' in law else {})), properties, law)


@byLaw
@pytest.mark.parametrize('build', kScenes)
def test_scenes(name, build):
    steps, contacts = kScenes[build]
    loop = requireSameWith(kLaws[name], kLaws[name].options['most'], steps, build=build)
    assert loop.fastForces == O.interactions.countReal() > contacts >= 0 <= loop.fastGeometries
    assert build is not lonelyHeap or len(O.interactions) < len(O.bodies)


@byLaw
@pytest.mark.parametrize('ending', [None, 'xml', 'yade.gz'])
def test_changesBetweenSteps(name, ending, folder):
    """Masses, blocked motions, options, properties and bodies that a script changes; contacts that it ends or switches off; a
    scene that it saves and loads."""
    one = kLaws[name]

    def change(part):
        properties, = O.engines[2].physDispatcher.functors
        law, = O.engines[2].lawDispatcher.functors
        for body in list(O.bodies)[part:60:4]:
            body.state.mass *= 1.5
            body.state.blockedDOFs = 'xyzXYZ' if part % 2 else ''
        for number, contact in enumerate(O.interactions):
            one.alter(contact.phys, number, part)
            contact.isActive = number % 7 > 0
        list(O.interactions)[part].phys = None
        O.bodies.erase(70 + part)
        one.toggle(properties, law, part)
        if ending:
            O.save(os.path.join(folder, 'scene.' + ending))
            O.reset()
            O.load(os.path.join(folder, 'scene.' + ending))
    loop = requireSameWith(one, one.options['most'], 160, build=denseHeap, change=change)
    assert loop.fastForces >= O.interactions.countReal() > 190 or ending


@byLaw
@pytest.mark.parametrize('seed', range(12))
def test_randomOptions(name, seed):
    options = kLaws[name].draw(np.random.default_rng(seed))
    build = [heap, denseHeap, shearedHeap][seed % 3]
    loop = requireSameWith(kLaws[name], options, 80 if seed % 3 == 1 else 500, build=build)
    assert loop.fastForces == O.interactions.countReal(), options


# --- several laws, and what is left to YADE

@pytest.mark.parametrize('name', ['mindlin', 'viscoelastic'])
def test_severalLaws(name):
    """In one loop: that whose properties it has is computed."""
    one = kLaws[name]
    options = one.options['damped']

    def make():
        geometry, properties, law = functors(one, options)
        return geometry, properties, [*law, w.Law2_ScGeom_FrictPhys_CundallStrack()][::1 if name == 'viscoelastic' else -1]
    loop = requireSame(make, 80, lambda: one.material(**options[0]), build=denseHeap)
    assert loop.fastForces == O.interactions.countReal()


def test_severalProperties():
    """Else the first law is computed."""
    loop = requireSame(lambda: (geometries(), [w.Ip2_ViscElMat_ViscElMat_ViscElPhys(), w.Ip2_FrictMat_FrictMat_FrictPhys()],
                                [w.Law2_ScGeom_ViscElPhys_Basic(), w.Law2_ScGeom_FrictPhys_CundallStrack()]),
                       80, lambda: viscoelastic.material(**kViscous), build=denseHeap)
    assert loop.fastForces == 0
    assert 'YADE\'s Law2_ScGeom_ViscElPhys_Basic, since the loop computes one law of a scene.' in loop.report()


@pytest.mark.parametrize('reason', ['traceEnergy', 'O.trackEnergy', 'twist_creep'])
def test_cohesiveIsLeftToYade(reason):
    law = {} if reason[0] == 'O' else {reason: True}

    def build(**settings):
        denseHeap(**settings)
        O.trackEnergy = reason == 'O.trackEnergy'
    try:
        loop = requireSameWith(cohesive, (kTurns, kBonds, law, {}), 80, build=build)
        assert loop.fastForces == 0
        assert 'CohesionMoment, since %s is set.' % reason in loop.report()
    finally:
        O.trackEnergy = False


def test_cohesiveIsWarnedOf():
    """YADE's law before 2025.2 warns of limits in the form that does not depend on the way: it is called for these contacts."""
    loop = requireSameWith(cohesive, (dict(kTurns, etaRoll=.05), kBonds, {}, {}), 12, build=denseHeap)
    if not kIsOld:
        assert loop.fastForces == O.interactions.countReal()
        return
    assert loop.fastForces == 0 and 'since YADE warns of limits of moments without useIncrementalForm.' in loop.report()
    loop.lawDispatcher.functors[0].useIncrementalForm = True
    O.step()
    assert loop.fastForces == O.interactions.countReal() and 'force by YADE' not in loop.report()


def test_energiesOfMindlin():
    """The law counts energies with calcEnergy: then YADE computes it, and the loop says so."""
    sums = []
    for name in ('InteractionLoop', 'CurveLoop'):
        loop, found = run(name, functors(mindlin, ({}, kDamped, dict(calcEnergy=True), {})), 300)
        law, = loop.lawDispatcher.functors
        sums.append([found, law.frictionDissipation, law.shearEnergy, law.normDampDissip, law.shearDampDissip,
                     law.normElastEnergy()])
    assert sums[0] == sums[1] and min(sums[0][1:]) > 0
    assert loop.fastForces == 0 < loop.fastGeometries
    assert 'Mindlin, since calcEnergy is set' in loop.report()
    law.calcEnergy = False
    O.step()
    assert loop.fastForces == O.interactions.countReal()
    # Ratios that YADE's functor counts from the physics.
    assert law.ratioSlidingContacts() == sum(i.phys.isSliding for i in O.interactions) / O.interactions.countReal()


def test_report():
    plain = mindlin.options['plain']
    assert w.CurveLoop(*functors(mindlin, plain)).report() == 'No contact has been computed yet.'
    loop, _ = run('CurveLoop', functors(mindlin, plain), 700)
    lines = loop.report().splitlines()
    assert sum(int(line.split()[0]) for line in lines) == O.interactions.countReal()
    assert any(line.endswith('of Sphere and Sphere: geometry by the loop, force by the loop, as '
                             'Law2_ScGeom_MindlinPhys_Mindlin.') for line in lines)
    assert any('Facet and Sphere: geometry by the loop, force by the loop' in line for line in lines)
    loop, _ = run('CurveLoop', [*functors(mindlin, plain)[:2], [w.Law2_ScGeom_MindlinPhys_HertzWithLinearShear()]], 100)
    assert 'HertzWithLinearShear, which the loop does not know.' in loop.report()
    loop.loopOnSortedInteractions = True
    assert loop.report() == 'All contacts: by YADE\'s InteractionLoop, since loopOnSortedInteractions is set.'
