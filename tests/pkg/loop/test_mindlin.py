"""CurveLoop with Law2_ScGeom_MindlinPhys_Mindlin: the bits of YADE's loop, with each option. Threads: test_lifecycle.py."""
import numpy as np
import pytest
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Matrix3

import scenes
from scenes import O, heap, packing
from test_curve_loop import NAMES, denseHeap, loopOf

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
    return ([w.Ig2_Sphere_Sphere_ScGeom(**(sphere or {})), w.Ig2_Facet_Sphere_ScGeom(), w.Ig2_Box_Sphere_ScGeom(),
             w.Ig2_Wall_Sphere_ScGeom()],
            [w.Ip2_FrictMat_FrictMat_MindlinPhys(**(properties or {}))],
            [w.Law2_ScGeom_MindlinPhys_Mindlin(**(law or {}))])


def numbers(value):
    return list(value) if hasattr(value, '__len__') else [value]


def state():
    """All numbers of bodies and contacts, and all attributes of the physics, as bytes."""
    rows = [[number for _, value in sorted(i.phys.dict().items()) for number in numbers(value)] for i in O.interactions]
    return scenes.state() + [np.array(rows, float).tobytes()]


def run(name, functors, steps, build=heap, threads=-1, change=None):
    build()
    loop = loopOf(name, functors)
    loop.ompThreads = threads
    O.engines = [w.ForceResetter(), scenes.makeCollider('LebesgueCollider'), loop,
                 w.NewtonIntegrator(damping=.1, gravity=(0, 0, -10))]
    found = []
    for part in range(4):
        O.run(steps // 4, True)
        found.append(state())
        if change:
            change(part)
    return loop, found


def requireSame(make, steps, **settings):
    _, expected = run('InteractionLoop', make(), steps, **settings)
    loop, found = run('CurveLoop', make(), steps, **settings)
    assert O.interactions.countReal() > 40
    assert found == expected
    return loop


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


@pytest.mark.parametrize('kind', ['damped', 'all'])
def test_periodicCell(kind):
    def sheared():
        heap(periodic=True)
        O.cell.homoDeform = 2
        O.cell.velGrad = Matrix3(-.3, .2, 0, 0, -.2, 0, 0, 0, -.3)
    loop = requireSame(lambda: mindlin(*kOptions[kind]), 700, build=sheared)
    assert loop.fastForces == O.interactions.countReal()


def test_clumps():
    """Members count with masses of their own."""
    def pairs():
        scenes.clear()
        O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
        chance = np.random.default_rng(4)
        for place in np.ndindex(4, 5, 5):
            at = np.array(place) * (1.55, .97, .97) + chance.uniform(-.02, .02, 3)
            clump, _ = O.bodies.appendClumped([utils.sphere(at, .5), utils.sphere(at + (.6, 0, 0), .45)])
            O.bodies[clump].state.vel = chance.normal(0, 2, 3)
        O.dt = 1e-4
    loop = requireSame(lambda: mindlin(*kOptions['all']), 160, build=pairs)
    assert loop.fastForces == O.interactions.countReal() > 150


def test_fewContactsPerBody():
    """With many bodies that touch nothing the loop reads bodies in place: the same bits."""
    def lonely():
        heap()
        for number in range(900):
            O.bodies.append(utils.sphere((100 + 3 * (number % 30), 3 * (number // 30), 0), 1, fixed=True))
    loop = requireSame(lambda: mindlin(*kOptions['all']), 700, build=lonely)
    assert len(O.interactions) < len(O.bodies) and loop.fastForces == O.interactions.countReal()


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
    for name in NAMES:
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


def test_movedTogether():
    """From 2,048 contacts on, geometries and physics are moved together: the same bits."""
    requireSame(lambda: mindlin(*kOptions['all']), 160, build=lambda: packing((12, 12, 12), .97, 1e-4, seed=5))
    assert O.interactions.countReal() > 2048


def drawn(chance):
    """Random options; those that exclude each other are not both drawn."""
    def some(**values):
        return {name: value for name, value in values.items() if chance.random() < .5}
    damping = [some(en=chance.uniform(.1, 1), es=chance.uniform(.1, 1)),
               some(betan=chance.uniform(0, .6), betas=chance.uniform(0, .6))][chance.integers(2)]
    turning = some(krot=10**chance.uniform(1, 6), ktwist=10**chance.uniform(1, 6), eta=10**chance.uniform(-3, 1))
    law = some(includeAdhesion=True, includeMoment=True, neverErase=True)
    sphere = some(interactionDetectionFactor=chance.uniform(1, 1.2), avoidGranularRatcheting=False)
    return damping | turning | some(gamma=10**chance.uniform(0, 5), frictAngle=chance.uniform(0, 1)), law, sphere


@pytest.mark.parametrize('seed', range(12))
def test_randomOptions(seed):
    options = drawn(np.random.default_rng(seed))
    build = [heap, denseHeap, lambda: heap(periodic=True)][seed % 3]
    loop = requireSame(lambda: mindlin(*options), 80 if seed % 3 == 1 else 500, build=build)
    assert loop.fastForces == O.interactions.countReal(), options
