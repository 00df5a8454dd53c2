"""Contacts and forces that FE bodies will not have are reported once; gravity is that of the scene. The order of engines
around an FESolver: momentum is kept, or the first step is refused."""
import itertools
import os

import numpy as np
import pytest

import yadefrag
from fe_scene import bodyOf, finder, momentum, O, reloaded, run, solverOfScene, steps
from yade import utils
from yade import wrapper as w

SPHERE = 'Ig2_Sphere_SurfaceSegment_ScGeom'


def scene(spheres=True, **settings):
    solver = bodyOf(yadefrag.rectangle((0, 0), (1, 1)), .5, solver=settings)
    run(solver, finder('LebesgueCollider'), spheres=spheres)
    return solver


def ball(place=(.5, 3, 0), blocked='zXY'):
    body = utils.sphere(place, .1, material='m')
    body.state.blockedDOFs = blocked
    O.bodies.append(body)
    return body


def messages(solver, capfd):
    """The messages; each once on stderr."""
    lines = [line for line in capfd.readouterr().err.splitlines() if line.startswith('WARN  FESolver: ')]
    assert lines == ['WARN  FESolver: ' + sentence for sentence in solver.warnings]
    return solver.warnings


def test_completeSceneGivesNoMessage(capfd):
    """Forces of FESolver alone do not add up: it takes back those of the last step, if no ForceResetter has."""
    solver = scene()
    ball()
    steps(5)
    assert messages(solver, capfd) == []
    O.reset()
    solver = scene(spheres=False)
    O.bodies.append(utils.wall(-1, axis=1))
    O.engines = [solver]
    steps(2)
    assert messages(solver, capfd) == []


@pytest.mark.parametrize('make, shape', [
    (lambda: utils.wall(-1, axis=1), 'Wall'), (lambda: utils.box((0, -1, 0), (1, .1, 1)), 'Box'),
    (lambda: utils.facet([(0, -1, 0), (1, -1, 0), (0, -1, 1)]), 'Facet'),
    (lambda: utils.tetra([(0, -1, 0), (0, -2, 0), (1, -1, 0), (0, -1, 1)], material='m'), 'Tetra')])
def test_shapesThatBodiesGoThroughAreReported(make, shape, capfd, folder):
    """What has been reported is part of the state, and not repeated."""
    solver = scene(rigidBodies=False)
    steps(2)
    O.bodies.append(make())
    number = O.bodies[-1].id
    steps(2)
    O.bodies.append(make())  # the same kind again
    steps(2)
    [sentence] = messages(solver, capfd)
    assert sentence.startswith('FE bodies go through bodies of the shape %s, such as #%d: %s' % (
        shape, number, 'they touch each other, spheres, walls, boxes and facets only' * (shape == 'Tetra')))
    for name in ('/x.yade', '/x.xml'):
        assert reloaded(folder + name).warnings == [sentence]
        steps(2)
        assert solverOfScene().warnings == [sentence] and 'WARN  FESolver' not in capfd.readouterr().err


def test_masksThatExcludeContactOfBodiesAreReported(capfd):
    solver = scene()
    solver.addPolygon(yadefrag.rectangle((0, 1.2), (1, 2)), size=.5, material='m')
    for body in O.bodies:
        body.mask = 1 + body.shape.component
    steps(2)
    [sentence] = messages(solver, capfd)
    assert sentence.startswith('Masks of FE bodies exclude interactions between them, but have no effect ')
    for body in O.bodies:
        body.mask = 3
    assert len(solver.warnings) == 1


def without(solver, name):
    """The engines without a functor."""
    loop = O.engines[2]
    loop.geomDispatcher.functors = [f for f in loop.geomDispatcher.functors if type(f).__name__ != name]


@pytest.mark.parametrize('spoil, sentence', [
    (lambda solver: without(solver, SPHERE), 'no InteractionLoop has an ' + SPHERE),
    (lambda solver: setattr(O, 'engines', [w.ForceResetter(), w.LebesgueCollider([w.Bo1_Sphere_Aabb()]),
                                           *O.engines[2:]]), 'the collider has no Bo1_SurfaceSegment_Aabb'),
    (lambda solver: setattr(O, 'engines', [w.ForceEngine(ids=[0]), solver]), 'no ForceResetter: the forces of'
                                                                            ' ForceEngine'),
])
def test_missingPartsAreReported(spoil, sentence, capfd):
    solver = scene()
    if 'ForceEngine' not in sentence:
        ball()
    spoil(solver)
    steps(3)
    [one] = messages(solver, capfd)
    assert sentence in one


@pytest.mark.parametrize('place, blocked, speed, gravity, sentence', [
    ((.5, 3, .2), 'zXY', 0, 0, 'is beside the plane'), ((.5, 3, .01), 'XY', 0, 0, 'leaves the plane'),
    ((.5, 3, 0), '', .1, 0, 'leaves the plane'), ((.5, 3, 0), '', 0, -9.81, 'Gravity along z moves sphere #'),
    ((.5, 3, 0), 'zXY', 0, -9.81, 'NewtonIntegrator along z does not act'), ((.5, 3, 0), '', 0, 0, None)])
def test_spheresBesideThePlaneAreReported(place, blocked, speed, gravity, sentence, capfd):
    solver = scene()
    ball(place, blocked).state.vel = (0, 0, speed)
    O.engines[-1].gravity = (0, 0, gravity)
    steps(3)
    found = messages(solver, capfd)
    assert len(found) == (sentence is not None) and all(sentence in one for one in found)


def fall(solver, duration=.02):
    while solver.time < duration:
        O.step()
    return solver.velocities.mean(axis=0) / solver.time


def test_gravityOfTheSceneIsTakenOver():
    solver = scene(spheres=False)
    O.engines[-1].gravity = (1, -9.81, 0)
    assert fall(solver) == pytest.approx([1, -9.81], rel=1e-9)
    assert solver.energy['external'] > 0 and abs(solver.energy['total']) < 1e-9 * solver.energy['external']
    assert tuple(solver.gravity) == (1, -9.81, 0) and solver.takesGravity
    O.engines[-1].dead = True
    before = solver.velocities.mean(axis=0)
    steps(5)
    assert solver.velocities.mean(axis=0) == pytest.approx(before, rel=1e-12)


@pytest.mark.parametrize('how', ['constructor', 'attribute', 'updateAttrs', 'none'])
def test_gravityThatIsSetCounts(how, folder):
    pull = (0, -2.)
    solver = scene(spheres=False, **(dict(gravity=pull) if how == 'constructor' else {}))
    if how == 'attribute':
        solver.gravity = pull
    if how == 'updateAttrs':
        solver.updateAttrs(dict(gravity=pull))
    if how == 'none':
        pull = solver.gravity = (0, 0)
    assert not solver.takesGravity and tuple(solver.gravity) == (*pull, 0)
    O.engines[-1].gravity = (0, -9.81, 0)
    solver = reloaded(os.path.join(folder, 'scene.xml'))
    assert fall(solver) == pytest.approx(pull, rel=1e-9, abs=1e-12)
    solver.updateAttrs(dict(takesGravity=True, gravity=(0, 0, 0)))
    before, begin = solver.velocities.mean(axis=0), solver.time
    steps(10)
    gained = (solver.velocities.mean(axis=0) - before) / (solver.time - begin)
    assert gained == pytest.approx([0, -9.81], rel=1e-9)


def test_energiesOfTheSceneHaveTheSolversSigns():
    solver = scene(spheres=False, gravity=(0, -9.81), damping=3)
    O.trackEnergy = True
    steps(40)
    own, scenes = solver.energy, O.energy
    assert own['outside'] == -own['external'] < 0
    assert own.get('external') == own['external'] and own.get('nothing', 3) == 3
    assert 'external' in own and 'external' not in list(own)  # an alias
    with pytest.raises(KeyError):
        own['nothing']
    for name in ('kinetic', 'strain', 'contact', 'friction', 'fracture', 'damping', 'outside'):
        assert scenes['fe' + name.capitalize()] == own[name]
    parts = sum(value for name, value in own.items() if name != 'total')
    assert parts == pytest.approx(own['total'], abs=1e-12 * own['external'])
    assert sum(value for name, value in scenes.items()) == pytest.approx(own['total'], abs=1e-12 * own['external'])


# --- the order of engines

kOrder = 'the order is ForceResetter, collider, InteractionLoop, FESolver, NewtonIntegrator'


def blow(order, loop=w.InteractionLoop, integrator=w.NewtonIntegrator):
    """A sphere that hits a block, with engines in the order given by letters; the solver."""
    solver = bodyOf(yadefrag.rectangle((0, 0), (1, 1)), .25)
    sphere = utils.sphere((-.104, .5, 0), .1, material=w.FrictMat(young=1e7, density=1000))
    sphere.state.vel = (2, 0, 0)
    O.bodies.append(sphere)
    made = dict(
        R=w.ForceResetter(), C=finder('LebesgueCollider'), F=solver, N=integrator(damping=0),
        I=loop([w.Ig2_Sphere_SurfaceSegment_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]))
    O.engines = [made[letter] for letter in order]
    O.dt = .05 * solver.criticalTimeStep()
    return solver


def isRight(order):
    """From InteractionLoop on, in a circle, all that use its forces come before they are reset."""
    start = order.index('I')
    turned = order[start:] + order[:start]
    return turned.index('R') > max(turned.index('F'), turned.index('N'))


@pytest.mark.parametrize('order', sorted(map(''.join, itertools.permutations('RCIFN'))))
def test_momentumIsKeptOrTheOrderRefused(order):
    solver = blow(order)
    if not isRight(order):
        with pytest.raises(ValueError, match=kOrder):
            O.step()
        assert O.iter == 0 and np.abs(solver.velocities).max() == 0
        return
    before = momentum(solver)[0]
    steps(400)
    after = momentum(solver)[0]
    body = (solver.masses[:, None] * solver.velocities).sum(0)
    assert body[0] > .5 * before[0]
    # Where forces are used one step apart, what is on its way counts for neither.
    way = np.abs(O.forces.f(len(O.bodies) - 1)).max() * O.dt
    assert np.abs(after - before).max() < 1e-9 * before[0] + 2 * way


@pytest.mark.parametrize('kinds', [(), (w.CurveLoop, w.CurveIntegrator)])
def test_orderIsCheckedAgain(kinds):
    """As engines change in the middle of a run, and as one is disabled or enabled; a missing resetter is refused."""
    blow('CIFN', *kinds)
    with pytest.raises(ValueError, match='has an InteractionLoop and no ForceResetter.*' + kOrder):
        O.step()
    O.reset()
    blow('RCIFN', *kinds)
    steps(2)
    O.engines = [O.engines[i] for i in (1, 2, 0, 3, 4)]
    with pytest.raises(ValueError, match='ForceResetter deletes the forces of %s .*%s' % (type(O.engines[1]).__name__, kOrder)):
        O.step()
    O.engines = [O.engines[i] for i in (2, 3, 0, 1, 4)]
    with pytest.raises(ValueError, match=kOrder):
        O.step()
    O.engines[3].dead = True
    steps(2)
    O.engines[3].dead = False
    with pytest.raises(ValueError, match=kOrder):
        O.step()
