"""CurveLoop with Law2_ScGeom_MindlinPhys_Mindlin: the bits of YADE's loop, with each option. Threads: test_lifecycle.py."""
import numpy as np
import pytest
import yade.wrapper as w

import law_twins
import scenes
from law_twins import denseHeap, requireSame, run, some
from scenes import O, heap

# Arguments of the functors for properties and law, and of that for two spheres.
kDamped = dict(en=.4, es=.7)
kAdhesive = dict(gamma=3e3)
kTurning = dict(krot=4e3, ktwist=2e3, eta=.02)
kOptions = dict(
    plain=({}, {}, {}),
    damped=(kDamped, {}, {}),
    normal=(dict(betan=.3, betas=0), {}, {}),
    shear=(dict(betan=0, betas=.4), {}, {}),
    friction=(dict(frictAngle=.05), {}, {}),
    adhesive=(kAdhesive, dict(includeAdhesion=True), {}),
    adhesiveDamped=(kAdhesive | kDamped, dict(includeAdhesion=True), {}),
    notAdhesive=(kAdhesive | kDamped, {}, {}),
    turning=(kTurning, dict(includeMoment=True), {}),
    elasticTurning=(kTurning | dict(eta=0), dict(includeMoment=True), {}),
    distant=(kDamped, dict(neverErase=True), dict(interactionDetectionFactor=1.2)),
    ratcheting=(kDamped, {}, dict(avoidGranularRatcheting=False)),
    all=(kAdhesive | kDamped | kTurning, dict(includeAdhesion=True, includeMoment=True, neverErase=True), {}))


def mindlin(properties=None, law=None, sphere=None):
    return (law_twins.geometries(**(sphere or {})), [w.Ip2_FrictMat_FrictMat_MindlinPhys(**(properties or {}))],
            [w.Law2_ScGeom_MindlinPhys_Mindlin(**(law or {}))])


@pytest.mark.parametrize('kind', kOptions)
@pytest.mark.parametrize('build', [heap, denseHeap])
def test_bits(kind, build):
    loop = requireSame(lambda: mindlin(*kOptions[kind]), 80 if build is denseHeap else 700, build=build)
    contacts = [i.phys for i in O.interactions]
    assert build is heap or len(O.interactions) > len(O.bodies)
    assert loop.fastForces == len(contacts) >= loop.fastGeometries > .5 * len(contacts)
    # The options do something.
    properties, law, _ = kOptions[kind]
    assert any(p.isSliding for p in contacts) and any(not p.isSliding for p in contacts)
    assert any(p.isAdhesive for p in contacts) == ('includeAdhesion' in law)
    assert any(p.normalViscous.norm() > 0 for p in contacts) == (kind == 'normal' or 'en' in properties)
    assert any(p.shearViscous.norm() > 0 for p in contacts) == (kind == 'shear' or 'en' in properties)
    assert any(p.momentBend.norm() > 0 and p.momentTwist.norm() > 0 for p in contacts) == ('includeMoment' in law)
    assert kind != 'distant' or any(p.kn == 0 for p in contacts)


@pytest.mark.parametrize('build', law_twins.kScenes)
def test_scenes(build):
    law_twins.requireSameIn(build, lambda: mindlin(*kOptions['all']))


def test_changesBetweenSteps():
    """Masses, blocked motions, options, properties and bodies that a script changes; contacts that it ends."""
    def change(part):
        law, = O.engines[2].lawDispatcher.functors
        for body in list(O.bodies)[part:60:4]:
            body.state.mass *= 1.5
            body.state.blockedDOFs = 'xyzXYZ' if part % 2 else ''
        for contact in list(O.interactions)[::3]:
            contact.phys.betan, contact.phys.kso = .2 * part, 1.1 * contact.phys.kso
        list(O.interactions)[part].phys = None
        O.bodies.erase(70 + part)
        law.includeMoment, law.includeAdhesion = part % 2 == 0, part > 0
    loop = requireSame(lambda: mindlin(*kOptions['all']), 160, build=denseHeap, change=change)
    assert loop.fastForces >= O.interactions.countReal() > 250  # of the step before the last change


def test_energies():
    """The law counts energies with calcEnergy: then YADE computes it, and the loop says so."""
    def make():
        return mindlin(kDamped, dict(calcEnergy=True))
    sums = []
    for name in ('InteractionLoop', 'CurveLoop'):
        loop, found = run(name, make(), 300)
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
    ratio = law.ratioSlidingContacts()
    assert ratio == sum(i.phys.isSliding for i in O.interactions) / O.interactions.countReal()


def test_report():
    loop = w.CurveLoop(*mindlin())
    scenes.clear()
    assert loop.report() == 'No contact has been computed yet.'
    loop, _ = run('CurveLoop', mindlin(), 700)
    lines = loop.report().splitlines()
    assert sum(int(line.split()[0]) for line in lines) == O.interactions.countReal()
    assert any(line.endswith('of Sphere and Sphere: geometry by the loop, force by the loop, as '
                             'Law2_ScGeom_MindlinPhys_Mindlin.') for line in lines)
    assert any('Facet and Sphere: geometry by YADE\'s Ig2_Facet_Sphere_ScGeom, force by the loop' in line for line in lines)
    loop, _ = run('CurveLoop', [mindlin()[0], mindlin()[1], [w.Law2_ScGeom_MindlinPhys_HertzWithLinearShear()]], 100)
    assert 'HertzWithLinearShear, which the loop does not know.' in loop.report()
    loop.loopOnSortedInteractions = True
    assert loop.report() == 'All contacts: by YADE\'s InteractionLoop, since loopOnSortedInteractions is set.'


def test_bothLaws():
    """Laws of both kinds in one loop: that whose properties it has is computed."""
    def make():
        geometry, properties, law = mindlin(kDamped)
        return geometry, properties, [w.Law2_ScGeom_FrictPhys_CundallStrack(), *law]
    loop = requireSame(make, 80, build=denseHeap)
    assert loop.fastForces == O.interactions.countReal()


def drawn(chance):
    """Random options; those that exclude each other are not both drawn."""
    damping = [some(chance, en=chance.uniform(.1, 1), es=chance.uniform(.1, 1)),
               some(chance, betan=chance.uniform(0, .6), betas=chance.uniform(0, .6))][chance.integers(2)]
    turning = some(chance, krot=10**chance.uniform(1, 6), ktwist=10**chance.uniform(1, 6), eta=10**chance.uniform(-3, 1))
    law = some(chance, includeAdhesion=True, includeMoment=True, neverErase=True)
    sphere = some(chance, interactionDetectionFactor=chance.uniform(1, 1.2), avoidGranularRatcheting=False)
    return damping | turning | some(chance, gamma=10**chance.uniform(0, 5), frictAngle=chance.uniform(0, 1)), law, sphere


@pytest.mark.parametrize('seed', range(12))
def test_randomOptions(seed):
    options = drawn(np.random.default_rng(seed))
    build = [heap, denseHeap, lambda: heap(periodic=True)][seed % 3]
    loop = requireSame(lambda: mindlin(*options), 80 if seed % 3 == 1 else 500, build=build)
    assert loop.fastForces == O.interactions.countReal(), options
