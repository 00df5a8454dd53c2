"""CurveLoop in the place of YADE's InteractionLoop: the same bits, whatever functors the scene has. Each law:
test_laws.py; threads: test_lifecycle.py."""
import numpy as np
import pytest
import yade.wrapper as w
import yadefrag
from yade import utils

import scenes
from loop_twins import denseHeap, geometries, NAMES, place, requireSame, run
from scenes import O, heap, state
from test_laws import friction, functors


def frictional(kind='plain'):
    return functors(friction, friction.options[kind])


kFunctors = dict(friction=frictional, traced=lambda: frictional('traced'))


@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
def test_otherGeometryAndLaw(collider):
    """Contacts that have rotations, with a law that does not need them, and a law that the loop does not know."""
    loop = requireSame(lambda: (geometries('6D'), *frictional()[1:]), 700, collider=collider)
    assert loop.fastForces == O.interactions.countReal() and loop.fastGeometries == 0
    linear = requireSame(lambda: [geometries(), [w.Ip2_FrictMat_FrictMat_MindlinPhys()],
                                  [w.Law2_ScGeom_MindlinPhys_HertzWithLinearShear()]], 700, collider=collider)
    assert linear.fastForces == 0 and linear.fastGeometries > 20


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
        ids = [b.id for b in O.bodies if b.dynamic][::3]
        loop = place(name, kFunctors[laws]() if laws in kFunctors else mixed(), w.ForceEngine(ids=ids, force=(5, .1, 1 / 3)),
                     w.TorqueEngine(ids=[0, 60], moment=(.1, .7, 0)))
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
        assert kinds == {'FrictPhys'} and computed == 1


@pytest.mark.parametrize('build', [heap, denseHeap])
@pytest.mark.parametrize('way', ['traceEnergy', 'O.trackEnergy'])
def test_energies(way, build):
    """The bits of YADE with one thread; several: threads_scene.py. A script may clear the sums."""
    found = []
    for name in NAMES:
        build()
        O.trackEnergy = way[0] == 'O'
        loop = place(name, kFunctors['friction' if O.trackEnergy else 'traced']())
        sums = []
        for steps in (100, 200):
            O.run(steps, True)
            sums.append((loop.lawDispatcher.functors[0].plasticDissipation(), O.energy.items(), O.energy.total(),
                         [getattr(i.phys, 'frictDissip', 0) for i in O.interactions]))
        O.trackEnergy = False
        found.append(sums)
    assert found[0] == found[1] and loop.fastForces == O.interactions.countReal()
    traced, energies = sums[-1][0], dict(sums[-1][1])
    assert energies['elastPotential'] > 0 < (energies['plastDissip'] if way[0] == 'O' else traced)
    O.energy.clear()
    O.step()
    assert ('elastPotential' in O.energy.keys()) == (way == 'traceEnergy')


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
    loop, _ = run('CurveLoop', kFunctors['friction'](), 4)
    assert isinstance(loop, w.InteractionLoop) and utils.typedEngine('InteractionLoop') == loop
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
        loop = getattr(w, name)(*parts)
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
