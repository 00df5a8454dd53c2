"""CurveLoop in the place of YADE's InteractionLoop: the same bits, whatever functors the scene has.
Threads: test_lifecycle.py."""
import os

import numpy as np
import pytest
import yade.config
import yade.wrapper as w
import yadefrag
from yade import utils
from yade.minieigenHP import Matrix3

import scenes
from law_twins import denseHeap, lonelyHeap
from scenes import O, heap, packing, state

NAMES = 'InteractionLoop', 'CurveLoop'


def frictional(law=None, **sphere):
    """Functors with attributes of the law and of the geometry of two spheres."""
    return ([w.Ig2_Sphere_Sphere_ScGeom(**sphere), w.Ig2_Facet_Sphere_ScGeom(), w.Ig2_Box_Sphere_ScGeom(),
             w.Ig2_Wall_Sphere_ScGeom()],
            [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack(**(law or {}))])


kFunctors = dict(
    friction=frictional,
    arms=lambda: frictional(dict(sphericalBodies=False), avoidGranularRatcheting=False),
    distant=lambda: frictional(dict(neverErase=True), interactionDetectionFactor=1.2),
    traced=lambda: frictional(dict(traceEnergy=True)),
    rotations=lambda: ([w.Ig2_Sphere_Sphere_ScGeom6D(), w.Ig2_Facet_Sphere_ScGeom6D(), w.Ig2_Box_Sphere_ScGeom6D()],
                       [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]))
kCohesive = ([w.Ig2_Sphere_Sphere_ScGeom6D, w.Ig2_Facet_Sphere_ScGeom6D, w.Ig2_Box_Sphere_ScGeom6D],
             [w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys], [w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment])


def loopOf(name, functors):
    return getattr(w, name)(*functors)


def run(name, functors, steps, build=heap, collider='LebesgueCollider', newton=None, **settings):
    build(**settings)
    loop = loopOf(name, functors)
    O.engines = [w.ForceResetter(), scenes.makeCollider(collider), loop,
                 newton or w.NewtonIntegrator(damping=.1, gravity=(0, 0, -10))]
    O.run(steps, True)
    return loop, state()


def requireSame(make, steps=700, **settings):
    """The loop's own counts of the last step, after comparing all bits."""
    _, expected = run('InteractionLoop', make(), steps, **settings)
    loop, found = run('CurveLoop', make(), steps, **settings)
    assert O.interactions.countReal() > 40
    assert found == expected
    return loop


@pytest.mark.parametrize('kind', kFunctors)
@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('build', [heap, denseHeap])
def test_bits(kind, collider, build):
    loop = requireSame(kFunctors[kind], collider=collider, build=build, steps=80 if build is denseHeap else 700)
    real = O.interactions.countReal()
    assert build is heap or len(O.interactions) > len(O.bodies)
    assert loop.fastForces == (0 if kind == 'traced' else real)
    # YADE's functors compute the first geometry of a contact.
    assert (loop.fastGeometries == 0) if kind == 'rotations' else 0 <= real - loop.fastGeometries < 8


def test_fewContactsPerBody():
    """With many bodies that touch nothing the loop reads bodies in place: the same bits."""
    loop = requireSame(kFunctors['friction'], build=lonelyHeap)
    assert len(O.interactions) < len(O.bodies) and loop.fastForces == O.interactions.countReal()


def test_otherLaws():
    cohesive = requireSame(
        lambda: [[make() for make in makers] for makers in kCohesive],
        material=w.CohFrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4, isCohesive=True,
                               normalCohesion=1e5, shearCohesion=1e5, momentRotationLaw=True))
    isKnown = yade.config.version < '2025'
    assert cohesive.fastForces == (O.interactions.countReal() if isKnown else 0)
    assert isKnown or 'since the loop knows this law of YADE before 2025.2 only' in cohesive.report()
    linear = requireSame(lambda: [frictional()[0], [w.Ip2_FrictMat_FrictMat_MindlinPhys()],
                                  [w.Law2_ScGeom_MindlinPhys_HertzWithLinearShear()]])
    assert linear.fastForces == 0 and linear.fastGeometries > 20


@pytest.mark.parametrize('homoDeform', [0, 2])
def test_periodicCell(homoDeform):
    def sheared(**settings):
        heap(periodic=True)
        O.cell.homoDeform = homoDeform
        O.cell.velGrad = Matrix3(-.3, .2, 0, 0, -.2, 0, 0, 0, -.3)
    loop = requireSame(kFunctors['friction'], build=sheared)
    # YADE's functor computes the first geometry of a contact.
    assert loop.fastForces == O.interactions.countReal() >= loop.fastGeometries > 40


def mixed():
    geometry, properties, law = frictional()
    return geometry[:3], [*properties, w.Ip2_ViscElMat_ViscElMat_ViscElPhys()], [*law, w.Law2_ScGeom_ViscElPhys_Basic()]


@pytest.mark.parametrize('build', [heap, denseHeap])
@pytest.mark.parametrize('laws', ['friction', 'traced', 'viscous', 'mixed'])
def test_forcesOfOthers(laws, build):
    """Forces that engines have added before the loop, those of a script, and those of YADE's laws: for all contacts, or
    for some of a body's contacts."""
    found = []
    for name in NAMES:
        build()
        viscous = w.ViscElMat(kn=1e6, ks=5e5, cn=100, cs=50, density=2000, frictionAngle=.4)
        for body in list(O.bodies)[:144 if laws == 'viscous' else 50 if laws == 'mixed' else 0]:
            body.material = viscous
        loop = loopOf(name, kFunctors[laws]() if laws in kFunctors else mixed())
        ids = [b.id for b in O.bodies if b.dynamic][::3]
        O.engines = [w.ForceResetter(), w.ForceEngine(ids=ids, force=(5, .1, 1 / 3)),
                     w.TorqueEngine(ids=[0, 60], moment=(.1, .7, 0)), scenes.makeCollider('LebesgueCollider'),
                     loop, w.NewtonIntegrator(damping=.1, gravity=(0, 0, -10))]
        O.forces.setPermF(5, (0, 0, 100))
        O.run(60 if build is denseHeap else 500, True)
        found.append(state())
    assert found[0] == found[1]
    kinds = {type(i.phys).__name__ for i in O.interactions}
    computed = loop.fastForces / O.interactions.countReal()
    if laws == 'viscous' and build is heap:  # all its bodies are viscous
        assert kinds == {'ViscElPhys'} and computed == 0
    elif laws in ('mixed', 'viscous'):
        assert kinds == {'FrictPhys', 'ViscElPhys'} and 0 < computed < 1
    else:
        assert kinds == {'FrictPhys'} and computed == (laws == 'friction')


def test_energies():
    def tracked():
        heap()
        O.trackEnergy = True
    found = []
    for name in NAMES:
        run(name, kFunctors['friction'](), 300, build=tracked)
        found.append(dict(O.energy.items()))
        O.trackEnergy = False
    assert found[0] == found[1] and found[0]['plastDissip'] > 0 and found[0]['elastPotential'] > 0
    losses = []
    for name in NAMES:
        loop, _ = run(name, kFunctors['traced'](), 300)
        losses.append(loop.lawDispatcher.functors[0].plasticDissipation())
    assert losses[0] == losses[1] > 0


def fresh(former):
    """Another state at the same place, at rest."""
    state = w.State(mass=1000, inertia=(200, 200, 200))
    state.pos = former.pos
    return state


def test_changesFromPython():
    """Bodies erased, inserted, moved and resized, contacts made, changed and reset between steps."""
    def changed(step):
        if step == 100:
            for number in (3, 17, 60):
                O.bodies.erase(number)
        elif step == 150:
            O.bodies.append(utils.sphere((3, 3, 8), .7))
            O.bodies[20].state.vel = (0, 0, -9)
        elif step == 200:
            for contact in O.interactions:
                contact.phys.kn *= 1.5
                contact.phys.tangensOfFrictionAngle = .1
            O.bodies[30].shape.radius *= .9
        elif step == 250:
            list(O.interactions)[5].geom, list(O.interactions)[7].phys = None, None
        elif step == 300:
            far = [b.id for b in O.bodies if isinstance(b.shape, w.Sphere)][:2]
            if not O.interactions.has(*far) or not O.interactions[far[0], far[1]].isReal:
                utils.createInteraction(*far)
        elif step == 320:
            O.interactions.clear()
        elif step == 350:
            O.bodies[40].shape = w.Sphere(radius=.4)
            O.bodies[41].state = fresh(O.bodies[41].state)

    found = []
    for name in NAMES:
        run(name, kFunctors['friction'](), 50)
        states = []
        for step in range(50, 450, 10):
            changed(step)
            O.run(10, True)
            states.append(state())
        found.append(states)
    assert found[0] == found[1]


def test_savedAndLoaded(folder):
    """Saved in the middle: goes on with the same bits, in both formats, with its functors."""
    _, expected = run('CurveLoop', kFunctors['arms'](), 600)
    for ending in ('xml', 'yade.gz'):
        run('CurveLoop', kFunctors['arms'](), 300)
        path = os.path.join(folder, 'scene.' + ending)
        O.save(path)
        O.reset()
        O.load(path)
        assert type(O.engines[2]) is w.CurveLoop
        law, = O.engines[2].lawDispatcher.functors
        assert not law.sphericalBodies
        O.run(300, True)
        numbers, reference = (np.frombuffer(s[0]) for s in (state(), expected))
        # YADE saves no shear increments, and numbers in XML with 17 digits.
        assert np.abs(numbers - reference).max() < 1e-6


@pytest.mark.parametrize('isSorted', [False, True])
def test_callbacksAndSortedLists(isSorted):
    """Each real contact, once in each step: YADE's sum of forces on contacts. A sorted list is left to YADE's own loop."""
    found = []
    for name in NAMES:
        loop, _ = run(name, kFunctors['friction'](), 10)
        if isSorted:
            loop.loopOnSortedInteractions = True
        else:
            loop.callbacks = [w.SumIntrForcesCb()]
        O.run(200, True)
        found.append(state())
    assert found[0] == found[1] and O.interactions.countReal() > 10
    assert not isSorted or loop.fastForces == 0


def test_isALoop():
    """YADE's functions find it; wrong arguments are refused as by YADE."""
    loop, _ = run('CurveLoop', kFunctors['friction'](), 1)
    assert isinstance(loop, w.InteractionLoop) and utils.typedEngine('InteractionLoop') is not None
    assert utils.typedEngine('InteractionLoop') == loop
    with pytest.raises(Exception, match='Exactly 3 lists of functors'):
        w.CurveLoop([])
    with pytest.raises(AttributeError):
        w.CurveLoop(pairs=3)


def step(*functors):
    """The message of a step of two spheres that touch."""
    scenes.clear()
    O.materials.append(w.FrictMat())
    O.bodies.append([utils.sphere((0, 0, 0), 1), utils.sphere((1.9, 0, 0), 1)])
    O.engines = [w.ForceResetter(), scenes.makeCollider('LebesgueCollider'), w.CurveLoop(*functors)]
    with pytest.raises(RuntimeError) as error:
        O.step()
    return str(error.value)


def test_missingFunctorsAreReported():
    """YADE's loop ends the process if there is no law."""
    geometry, properties = [w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()]
    assert step(geometry, [], []) == \
        'CurveLoop has no Ip2 functor for the materials FrictMat and FrictMat of the bodies 0 and 1.'
    assert step(geometry, properties, []) == \
        'CurveLoop has no Law2 functor for the contact of the bodies 0 and 1, with ScGeom and FrictPhys.'
    scenes.clear()
    O.bodies.append([utils.sphere((0, 0, 0), 1), utils.sphere((1.9, 0, 0), 1)])
    O.engines = [w.ForceResetter(), scenes.makeCollider('LebesgueCollider'), w.CurveLoop([], properties, [])]
    O.run(3, True)  # no geometry, no contact: as in YADE
    assert O.interactions.countReal() == 0


def test_spheresOnABeam():
    """Contacts with the boundary of a finite-element body, whose shapes the step before has changed."""
    found = []
    for name in NAMES:
        scenes.clear()
        O.materials.append(w.FEMat(young=1e8, poisson=.3, density=2000, frictionAngle=.4, label='beam'))
        solver = w.FESolver()
        solver.addPolygon([(0, 0), (2, 0), (2, .3), (0, .3)], size=.1, material='beam')
        for number in range(12):
            ball = utils.sphere((.2 + .14 * number, .4 + .01 * number, 0), .08, material='beam')
            ball.state.vel, ball.state.angVel = (1, -8, 0), (0, 0, 20)
            O.bodies.append(ball)
        O.engines = yadefrag.engines(solver, spheres=True)
        former = next(e for e in O.engines if isinstance(e, w.InteractionLoop))
        parts = [former.geomDispatcher.functors, former.physDispatcher.functors, former.lawDispatcher.functors]
        loop = loopOf(name, parts)
        O.engines = [loop if e == former else e for e in O.engines]
        O.dt = .3 * solver.criticalTimeStep()
        most = 0
        for _ in range(30):
            O.run(10, True)
            assert name != 'CurveLoop' or loop.fastForces == O.interactions.countReal()
            most = max(most, O.interactions.countReal())
        found.append([most, np.array(solver.nodes).tobytes(),
                      np.array([[*b.state.pos, *b.state.vel, *b.state.angVel] for b in O.bodies]).tobytes()])
    assert found[0] == found[1]
    assert found[0][0] > 5


def test_movedTogether(folder):
    """From 2,048 contacts on, geometries and physics are moved together: the same bits, with objects that Python
    holds, contacts and bodies that end, a reset and a saved scene in between."""
    found = []
    for name in NAMES:
        run(name, kFunctors['friction'](), 20, build=lambda: packing((12, 12, 12), .97, 1e-4, seed=5))
        held = [(i.geom, i.phys) for i in list(O.interactions)[:50]]
        assert O.interactions.countReal() > 2048
        states = []
        for step in range(4):
            O.run(45, True)
            states.append(state())
            O.bodies.erase(7 + step)
            first = next(iter(O.interactions))
            O.interactions.erase(first.id1, first.id2)
            # Objects of contacts that went on are the same as before.
        assert sum(1 for i in O.interactions for g, p in held[:5] if i.geom == g and i.phys == p) > 2
        former = [(g.penetrationDepth, p.kn) for g, p in held]
        O.save(os.path.join(folder, name + '.yade.gz'))
        O.reset()
        # They end with their last owner.
        assert [(g.penetrationDepth, p.kn) for g, p in held] == former
        del held
        found.append(states)
    assert found[0] == found[1]
