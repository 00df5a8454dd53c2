"""FESolver in YADE: its values; what addPolygon takes; loads, prescribed motion, and long runs. The same run with
any collider: test_same_bits.py. engines(fe, spheres=True), and engines that a script lists: a sphere is stopped by every shape
that has a functor, and a message names those that it goes through; also shapes that appear later."""

import numpy as np
import pytest

import yadefrag
from fe_scene import bodyOf, fe, finder, impact, momentum, O, ready, reloaded, run, steps, throwBall
from yade import gridpfacet, utils, wrapper as w
from yade.wrapper import *
from yadefrag import *


# --- values

def test_arraysAndLedger():
    solver = impact('LebesgueCollider')
    n, m = len(solver.nodes), len(solver.triangles)
    start = momentum(solver)
    energy = solver.energy['total']
    steps(500)
    assert solver.nodes.shape == solver.velocities.shape == (n, 2)
    assert solver.displacements.shape == solver.contactForces.shape == (n, 2)
    assert solver.triangles.shape == solver.stress.shape == (m, 3)
    assert solver.masses.shape == (n,) and solver.components.shape == (m,)
    assert set(solver.components) == {0, 1}
    assert solver.triangles.max() == n - 1
    nodes = solver.nodes
    nodes[:] = 0
    assert solver.nodes.any()
    corners = solver.nodes[solver.triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0).all()
    assert [len(loop) for loop in solver.surfaces][0] > 20 and len(solver.surfaces) == 2
    values = solver.energy
    assert set(values) == {'kinetic', 'strain', 'contact', 'friction', 'fracture', 'damping', 'outside', 'total'}
    assert abs(values['total'] / energy - 1) < 1e-4
    linear, angular = momentum(solver)
    scale = np.linalg.norm(start[0])
    assert np.abs(linear - start[0]).max() < 1e-12 * scale
    assert abs(angular - start[1]) < 1e-5 * scale * .2


def test_fragmentsAreTheBodies():
    solver = impact()
    parts = solver.fragments()
    assert [p['component'] for p in parts] == [0, 1]
    assert parts[0]['velocity'] == pytest.approx((2, .3))
    assert parts[0]['spin'] == pytest.approx(3)
    assert parts[1]['area'] == pytest.approx(.095 * .2)
    assert parts[1]['centroid'] == pytest.approx((.1525, 0))
    assert sum(p['mass'] for p in parts) == pytest.approx(solver.masses.sum())


def test_pieceBodiesFollow():
    """Shapes lie on the nodes, states move as the pieces do, with any integrator."""
    for newton in (True, False):
        O.reset()
        solver = bodyOf(yadefrag.rectangle((0, 0), (.1, .1)), .05, velocity=(1, 2), spin=5,
                        smooth=[True, False, False, True])
        run(solver, finder('LebesgueCollider'), newton=newton)
        steps(50)
        loop = solver.nodes[solver.surfaces[0]]
        kinds = {}
        for b in O.bodies:
            shape = b.shape
            kinds[shape.kind] = kinds.get(shape.kind, 0) + 1
            follower = O.bodies[(b.id + 1) % len(O.bodies)].shape
            assert tuple(shape.end) == tuple(follower.start)
            assert b.state.blockedDOFs == 'xyzXYZ'
            if shape.kind == 0:
                middle = (np.array(shape.start) + np.array(shape.end)) / 2
                assert np.abs(np.array(b.state.pos) - middle).max() < 1e-14
                at = np.abs(loop - np.array(shape.start)[:2]).sum(1).argmin()
                assert (loop[at] == np.array(shape.start)[:2]).all()
            assert b.state.angVel[2] == pytest.approx(5, rel=.2)
        assert kinds == {0: 5, 1: 1, 2: 1, 3: 3} or kinds[3] > 0


# --- bodies

kSquare = [(0, 0), (1, 0), (1, 1), (0, 1)]


def test_functionsOfPlace():
    solver = bodyOf(kSquare, .25, velocity=lambda x, y: (y, 0), displacement=lambda x, y: (.01 * x, 0),
                    fixed=lambda x, y: 'x' if y < 1e-9 else x > 1 - 1e-9 and y > .5)
    moved = solver.displacements
    rest = solver.nodes - moved
    assert moved == pytest.approx(np.stack([.01 * rest[:, 0], 0 * rest[:, 0]], axis=1))
    assert solver.velocities[:, 0] == pytest.approx(rest[:, 1])
    run(solver)
    speed = solver.velocities
    steps(30)
    held = (rest[:, 0] > 1 - 1e-9) & (rest[:, 1] > .5)
    assert np.array_equal(solver.velocities[held], speed[held])
    bottom = rest[:, 1] < 1e-9
    assert np.array_equal(solver.velocities[bottom, 0], speed[bottom, 0])
    assert (solver.velocities[bottom, 1] != 0).any()


def test_clockwiseOutlineKeepsItsFlags():
    kinds = []
    for order in (1, -1):
        O.reset()
        bodyOf(kSquare[::order], .5, smooth=[True, False, False, True][::order])
        kinds.append({tuple(np.round(b.shape.middle, 6)[:2]) for b in O.bodies if b.shape.kind == 3})
    assert kinds[0] == kinds[1] == {(0, 0), (0, .5), (0, 1)}


def test_runCallsInBetween():
    impact()
    called = []
    assert runSteps(25, every=10, call=lambda: called.append(O.iter)) == 25
    assert called == [10, 20] and O.iter == 25


# --- engines(fe, spheres=True), and engines that a script lists

RADIUS = .05


def clump():
    number, _ = O.bodies.appendClumped([utils.sphere((x, -.1, 0), .1, material='m') for x in (-.03, .03)])
    O.bodies[number].state.blockedDOFs = 'xyzXYZ'
    return number


def connection():
    O.materials.append(w.CohFrictMat(label='node'))
    ends = [O.bodies.append(gridpfacet.gridNode((x, -.03, 0), .03, fixed=True, material='node')) for x in (-.3, .3)]
    return O.bodies.append(gridpfacet.gridConnection(*ends, .03, material='m'))


HELD = dict(fixed=True, material='m')
CORNERS = [(-.3, 0, -.3), (.3, 0, -.3), (0, 0, .4)]
STOPPING = dict(Wall=lambda: O.bodies.append(utils.wall(0, axis=1, material='m')),
                Box=lambda: O.bodies.append(utils.box((0, -.1, 0), (.2, .1, .2), **HELD)),
                Facet=lambda: O.bodies.append(utils.facet(CORNERS, **HELD)),
                Sphere=lambda: O.bodies.append(utils.sphere((0, -.1, 0), .1, **HELD)), Clump=clump)
OTHERS = dict(Tetra=lambda: O.bodies.append(utils.tetra(CORNERS + [(0, -.2, 0)], **HELD)), GridConnection=connection)
IG = {'Wall': 'Ig2_Wall_Sphere_ScGeom', 'Box': 'Ig2_Box_Sphere_ScGeom', 'Facet': 'Ig2_Facet_Sphere_ScGeom',
      'Sphere': 'Ig2_Sphere_Sphere_ScGeom'}
CHOICES = {
    'usual': {}, "YADE's": dict(collider=w.InsertionSortCollider, loop=w.InteractionLoop, integrator=w.NewtonIntegrator),
    'mixed': dict(collider=w.HierarchyCollider, integrator=w.NewtonIntegrator)}


def scene(**choices):
    """A sphere above y = 0, beside a body of finite elements on which another one falls."""
    solver = bodyOf(yadefrag.rectangle((1, -.2), (1.4, 0)), .1, thickness=.1, fixed=lambda x, y: y < -.199)
    for x in (0, 1.2):
        throwBall((x, RADIUS + 1e-4), RADIUS, (0, -1))
    ready(solver, .2, spheres=True, **choices)
    return solver


def lowest(solver, duration=.02):
    """The least heights of both spheres above their floors."""
    least = [1., 1.]
    while solver.time < duration:
        O.run(20, True)
        for i, ball in enumerate(body for body in O.bodies if body.dynamic and body.isStandalone
                                 and isinstance(body.shape, w.Sphere)):
            least[i] = min(least[i], ball.state.pos[1])
    return least


@pytest.mark.parametrize('choice', CHOICES)
@pytest.mark.parametrize('shape', STOPPING)
@pytest.mark.parametrize('late', [False, True])
def test_spheresAreStopped(shape, choice, late):
    solver = scene(**CHOICES[choice])
    if late:
        steps(2)
    STOPPING[shape]()
    assert min(lowest(solver)) > .5 * RADIUS
    assert solver.warnings == []


@pytest.mark.parametrize('choice', CHOICES)
@pytest.mark.parametrize('shape', OTHERS)
def test_otherShapesAreNamed(shape, choice):
    solver = scene(**CHOICES[choice])
    steps(2)
    number = OTHERS[shape]()
    steps(2)
    assert any('bodies of the shape %s, such as #%d' % (shape, number) in one for one in solver.warnings)


@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('loop', ['InteractionLoop', 'CurveLoop'])
@pytest.mark.parametrize('shape', IG)
@pytest.mark.parametrize('lacking', ['geometry', 'bound'])
def test_missingFunctorsOfListedEnginesAreNamed(lacking, shape, loop, collider):
    solver = scene(loop=getattr(w, loop), collider=getattr(w, collider))
    _, finder, contacts, *_ = O.engines
    name = IG[shape] if lacking == 'geometry' else 'Bo1_%s_Aabb' % shape
    for one in (contacts.geomDispatcher, finder.boundDispatcher):
        one.functors = [functor for functor in one.functors if type(functor).__name__ != name]
    number = STOPPING[shape]() if shape != 'Sphere' else None
    steps(2)
    [sentence] = solver.warnings
    assert sentence.startswith('Spheres go through bodies of the shape %s' % shape) and name in sentence
    assert 'engines(fe, spheres=True) has it' in sentence and (number is None or '#%d:' % number in sentence)


def test_clumpsOfSpheresTouchEverything():
    """A clump falls on a wall and on a body of finite elements at once."""
    solver = bodyOf(yadefrag.rectangle((0, -.2), (.4, 0)), .1, solver=dict(linearViscosity=.1), thickness=.1,
                    fixed=lambda x, y: y < -.199)
    O.bodies.append(utils.box((-.3, -.1, 0), (.3, .1, .2), fixed=True, material='m'))
    number, _ = O.bodies.appendClumped([utils.sphere((x, .051, 0), .05, material='m') for x in (-.08, 0, .08)])
    O.bodies[number].state.blockedDOFs = 'zXY'
    ready(solver, .2, spheres=True, gravity=(0, -9.81), damping=.3)
    O.run(int(.1 / O.dt), True)
    assert O.bodies[number].state.pos[1] == pytest.approx(.05, abs=2e-3) and solver.warnings == []


def test_loopWithOtherFunctorsIsUsed():
    solver = fe()
    own = w.CurveLoop([w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                      [w.Law2_ScGeom_FrictPhys_CundallStrack()])
    kinds = [type(one).__name__ for one in yadefrag.engines(solver, spheres=True, loop=own)]
    assert kinds == ['ForceResetter', 'LebesgueCollider', 'CurveLoop', 'FESolver', 'CurveIntegrator']
    assert yadefrag.engines(solver, spheres=True, loop=own)[2] is own


# --- gravity

def accelerations(solver, ball, count=20):
    before, speed, begin = solver.velocities.mean(axis=0), np.array(ball.state.vel), solver.time
    steps(count)
    duration = solver.time - begin
    return (solver.velocities.mean(axis=0) - before) / duration, ((np.array(ball.state.vel) - speed) / duration)[:2]


@pytest.mark.parametrize('integrator', [w.CurveIntegrator, w.NewtonIntegrator])
@pytest.mark.parametrize('how', ['gravity=', 'fe.gravity', 'none', 'listed'])
@pytest.mark.parametrize('isSaved', [False, True])
def test_changedGravityReachesAllBodies(how, integrator, isSaved, folder):
    solver = bodyOf(yadefrag.rectangle((0, 0), (.1, .1)), .05, thickness=.1,
                    solver=dict(gravity=(0, -9.81)) if how == 'fe.gravity' else {})
    ball = throwBall((.5, .3), .05)
    O.engines = yadefrag.engines(solver, spheres=True, integrator=integrator,
                                 **(dict(gravity=(0, -9.81)) if how == 'gravity=' else {}))
    if how == 'listed':
        O.engines = O.engines[:-1] + [integrator(damping=0, gravity=(0, -9.81, 0))]
    O.dt = .5 * solver.criticalTimeStep()
    first = (0, 0) if how == 'none' else (0, -9.81)
    for found in accelerations(solver, ball):
        assert tuple(found) == pytest.approx(first, abs=1e-6)
    if isSaved:
        solver = reloaded(folder + '/scene.yade')
        ball = next(body for body in O.bodies if isinstance(body.shape, w.Sphere))
    O.engines[-1].gravity = (3, 4, 0)
    for found in accelerations(solver, ball):
        assert tuple(found) == pytest.approx((3, 4), abs=1e-6)
    assert tuple(solver.gravity) == (3, 4, 0) and solver.warnings == []
    solver.gravity = (0, -1)
    own, theirs = accelerations(solver, ball)
    assert tuple(own) == pytest.approx((0, -1), abs=1e-6) and tuple(theirs) == pytest.approx((3, 4), abs=1e-6)
    [sentence] = solver.warnings
    assert sentence.startswith("The gravity of FE bodies is (0, -1) m/s², that of YADE's bodies, such as #%d, (3, 4)"
                               % ball.id)
    solver.takesGravity = True
    for found in accelerations(solver, ball):
        assert tuple(found) == pytest.approx((3, 4), abs=1e-6)


def test_gravityStaysWithoutIntegrator():
    solver = bodyOf(yadefrag.rectangle((0, 0), (.1, .1)), .05)
    ready(solver, .5, moving=True, gravity=(0, -2))
    steps(5)
    O.engines = yadefrag.engines(solver)
    before, begin = solver.velocities[:, 1].mean(), solver.time
    steps(5)
    assert (solver.velocities[:, 1].mean() - before) / (solver.time - begin) == pytest.approx(-2, rel=1e-6)


def test_gravityOfOtherEnginesIsReported():
    solver = scene()
    O.engines = O.engines[:1] + [w.GravityEngine(gravity=(0, -1, 0))] + O.engines[1:]
    steps(2)
    assert solver.warnings == ['GravityEngine does not act on FE bodies; the gravity of NewtonIntegrator does.']


# --- time step, rest

def test_timeStepperOfYadeIsNamed():
    solver = scene()
    O.engines = O.engines[:3] + [w.GlobalStiffnessTimeStepper(timestepSafetyCoefficient=.8)] + O.engines[3:]
    with pytest.raises(RuntimeError, match=r'O\.dt: .*GlobalStiffnessTimeStepper sets O\.dt without FE bodies; give '
                                           r'it maxDt = \.8 \* fe\.criticalTimeStep\(\)'):
        O.run(400, True)
    O.engines[3].maxDt = .8 * solver.criticalTimeStep()
    O.run(400, True)


@pytest.mark.parametrize('place', [(.2, .08), (.2, .0499)])
def test_relaxWaitsForSpheres(place):
    """A sphere falls from 30 mm; the other one begins at rest with its contact, nearly without force."""
    solver = bodyOf(yadefrag.rectangle((0, -.1), (.4, 0)), .1, thickness=.1, fixed=lambda x, y: y < -.0999)
    ball = throwBall(place, .05)
    ready(solver, .5, spheres=True, gravity=(0, -9.81))
    solver.relax()
    assert abs(ball.state.pos[1] - .05) < 2e-3 and ball.state.vel.norm() < 1e-3
    weight = ball.state.mass * 9.81
    assert O.forces.f(ball.id)[1] == pytest.approx(weight, rel=.02)
    assert O.engines[-1].damping == 0 and solver.damping == 0
