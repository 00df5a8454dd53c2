"""Rigid boundaries that meet at an angle, part, leave the plane of the bodies and come back, or run along themselves."""
import math

import numpy as np
import pytest

import yadefrag
from fe_scene import bodyOf, fe, finder, momentum, O, ready, run, steps
from test_fe_rigid import G, block, facet, smooth, wall
from yade import utils
from yade import wrapper as w
from yade.minieigenHP import Vector3


WAYS = [{'passes': passes} for passes in (1, 2)]


def force(number):
    return np.array(O.forces.f(number))[:2]


def ridge(steep, half=1.):
    """Two facets that meet at the origin, at an angle `steep` (rad) below the horizontal."""
    fall = half * math.tan(steep)
    return O.bodies.append([facet((-half, -fall), (0, 0), fixed=True), facet((0, 0), (half, -fall), fixed=True)])


@pytest.mark.parametrize('way', WAYS)
@pytest.mark.parametrize('steep', [.1, .6])
def test_saddleOnARidgePressesOnBothSides(way, steep):
    """A body with a notch that fits, but for the edge, which it does not touch, and without friction: each
    facet bears half its weight W, and W/2 tan(steep) along the ground outwards; 1e-4 as on a floor."""
    half = [(.01, .005), (.01, -.01 * math.tan(steep)), (.05, -.05 * math.tan(steep)), (.05, .1)]
    smooth = w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=0)
    solver = bodyOf(half + [(-x, y) for x, y in reversed(half)], .02, smooth, dict(gravity=(0, -G), damping=300, **way))
    left, right = ridge(steep)
    run(solver)
    steps(5000)
    weight = G * solver.masses.sum()
    wanted = np.array([weight / 2 * math.tan(steep), -weight / 2])
    assert force(left) == pytest.approx(wanted, rel=1e-4)
    assert force(right) == pytest.approx(wanted * (-1, 1), rel=1e-4)
    assert solver.warnings == []


def onRidge(rigid, steep, smooth, friction, **way):
    solver = fe(gravity=(0, -G), **way)
    O.materials['m'].frictionAngle = friction
    block(solver, (-.047, .001), mesh=.01, velocity=(.2, -1), smooth=smooth)
    critical = solver.criticalTimeStep()
    if rigid:
        O.materials.append(w.FrictMat(density=1000, frictionAngle=friction, young=1e7, poisson=.3, label='r'))
        for number in ridge(steep):
            O.bodies[number].material = O.materials['r']
    else:
        depth = -math.tan(steep)
        solver.addPolygon([(-1, depth), (1, depth), (0, 0)], size=3, material='m', fixed=lambda x, y: True)
    run(solver)
    O.dt = .8 * critical
    path = []
    for _ in range(400):
        O.step()
        path.append(solver.nodes[:len(solver.nodesOf(0))])
    return solver, np.array(path)


@pytest.mark.filterwarnings('ignore:addPolygon')  # the fixed body is as coarse as can be
@pytest.mark.parametrize('soft', [False, True])
@pytest.mark.parametrize('steep, friction', [(.15, 0), (.7, .3)])
def test_bodyThatDropsOnARidgeIsThatOnAFixedBody(soft, steep, friction):
    """To the last bits, for the same rows are solved: 1e-12 m."""
    _, found = onRidge(True, steep, soft, friction)
    O.reset()
    _, wanted = onRidge(False, steep, soft, friction)
    assert np.abs(found - wanted).max() < 1e-12
    assert np.diff(found.mean(axis=1)[:, 1])[-1] > 0  # it came back


def test_edgeOfARidgeStaysOutInTwoPasses():
    """Its kink of 0.3 rad is no sharp corner: a single pass leaves it to the block's points, which sag over
    it by up to half a side times the slope; two passes keep it out, to 1e-4 of a side."""
    deepest = {}
    for passes in (1, 2):
        O.reset()
        solver, path = onRidge(True, .15, False, 0, passes=passes)
        low = np.argsort(path[0, :, 1])[:11]
        low = low[np.argsort(path[0, low, 0])]
        deepest[passes] = max(-np.interp(0, nodes[low, 0], nodes[low, 1]) for nodes in path)
    assert 1e-4 < deepest[1] < .005 * math.tan(.15)
    assert deepest[2] < 1e-6


@pytest.mark.parametrize('way', WAYS)
def test_facetThatRisesBesideAnotherLiftsItsHalf(way):
    """Facets that met end to end part: nothing falls through the one that moves."""
    solver = fe(gravity=(0, -G), **way)
    block(solver, (-.05, 0))
    O.bodies.append([facet((-1, 0), (0, 0), fixed=True), facet((0, 0), (1, 0), fixed=True)])
    riser = O.bodies[len(O.bodies) - 1]
    run(solver)
    steps(100)
    before = momentum(solver, ())[0][1]
    riser.state.vel = (0, .5, 0)
    given = 0
    for _ in range(300):
        O.step()
        given -= (force(riser.id - 1)[1] + force(riser.id)[1] + G * solver.masses.sum()) * O.dt
        right = solver.nodes[solver.nodes[:, 0] > 0]
        # 4.4e-8 m in one step, which is 2e-6 of a side.
        assert right[:, 1].min() > riser.state.pos[1] - 1e-7
    assert riser.state.pos[1] > .01 and solver.nodes[:, 1].min() > -1e-8
    assert momentum(solver, ())[0][1] - before == pytest.approx(given, rel=1e-9)


@pytest.mark.parametrize('way', WAYS)
def test_facetsThatDrawApartLetABlockFallBetween(way):
    """Each bears half the weight as long as the gap is less than the block; then it falls freely."""
    solver = fe(gravity=(0, -G), damping=300, **way)
    O.materials['m'].frictionAngle = 0
    block(solver, (-.05, 0))
    left, right = O.bodies.append([facet((-1, 0), (0, 0), fixed=True), facet((0, 0), (1, 0), fixed=True)])
    run(solver)
    steps(int(.03 / O.dt))
    weight = G * solver.masses.sum()
    for number, sign in ((left, -1), (right, 1)):
        O.bodies[number].state.vel = (sign * .5, 0, 0)
    started = solver.time
    while solver.time < started + .08:
        O.step()
    assert force(left)[1] == pytest.approx(-weight / 2, rel=.02)  # of vibrations
    assert force(right)[1] == pytest.approx(-weight / 2, rel=.02)
    while solver.time < started + .101:
        O.step()
    solver.damping = 0
    start, begin = momentum(solver, ())[0][1], solver.time
    steps(100)
    assert momentum(solver, ())[0][1] - start == pytest.approx(-weight * (solver.time - begin), rel=1e-9)


def shelf(kind):
    """Something with its upper side at y = 0 and |z| < 0.1, and what moves it."""
    if kind == 'facet':
        number = O.bodies.append(facet((-1, 0), (1, 0), height=.1, fixed=True))
    elif kind == 'box':
        number = O.bodies.append(utils.box((0, -.1, 0), (1, .1, .1), fixed=True))
    else:
        number, _ = O.bodies.appendClumped([utils.box((0, -.1, 0), (1, .1, .1)), utils.box((0, -.3, .4), (1, .1, .3))])
    body = O.bodies[number]
    body.state.blockedDOFs = 'xyzXYZ'
    return body


@pytest.mark.parametrize('kind', ['box', 'facet', 'clump'])
def test_boundaryThatLeavesThePlaneLetsABlockFallAndCatchesItWhenItIsBack(kind):
    solver = fe(gravity=(0, -G))
    block(solver, (-.05, 0))
    body = shelf(kind)
    run(solver)
    steps(100)
    assert solver.nodes[:, 1].min() > -1e-6
    speed = .11 / .05 if kind != 'clump' else .61 / .05
    body.state.vel = (0, 0, speed)
    steps(math.ceil(.05 / O.dt))
    body.state.vel = (0, 0, 0)
    before, begin = momentum(solver, ())[0][1], solver.time
    steps(100)
    fall = -G * solver.masses.sum() * (solver.time - begin)
    assert momentum(solver, ())[0][1] - before == pytest.approx(fall, rel=1e-9)
    # Back in 0.05 s, 0.1 m below.
    floor = solver.nodes[:, 1].min() - .1
    body.state.pos += Vector3(0, floor, 0)
    body.state.vel = (0, 0, -speed)
    steps(math.ceil(.05 / O.dt))
    body.state.vel = (0, 0, 0)
    lows = []
    while solver.time < begin + .3:
        O.step()
        lows.append(solver.nodes[:, 1].min())
    # It was there, and is not below; free fall would be twice as deep.
    assert floor - 1e-6 < min(lows) < floor + 1e-6
    assert -.5 * G * .3**2 < 2 * floor


@pytest.mark.parametrize('wayToMove', ['velocity', 'place'])
@pytest.mark.parametrize('way', WAYS)
def test_wallThatRunsAlongItselfIsABelt(way, wayToMove):
    """It drags a block with friction times weight, until that is as fast; 2 % for the block's vibrations."""
    solver = fe(gravity=(0, -G), damping=200, **way)
    O.materials['m'].frictionAngle = .3
    block(solver)
    belt = O.bodies[O.bodies.append(wall(0, material=smooth(.3, 'belt')))]
    run(solver)
    steps(int(.03 / O.dt))
    solver.damping = 0
    if wayToMove == 'velocity':
        belt.state.vel = (.5, 0, 0)

    def go(time):
        begin, start = solver.time, solver.velocities[:, 0].mean()
        dragged = 0
        while solver.time < begin + time:
            if wayToMove == 'place':
                belt.state.pos += Vector3(.5 * O.dt, 0, 0)
            O.step()
            dragged -= force(belt.id)[0] * O.dt
        return dragged, (solver.masses * solver.velocities[:, 0]).sum()

    dragged, gained = go(.08)
    weight = G * solver.masses.sum()
    assert dragged == pytest.approx(math.tan(.3) * weight * .08, rel=.02)
    assert gained == pytest.approx(dragged, rel=1e-6)
    go(.2)
    assert solver.velocities[:, 0].mean() == pytest.approx(.5, rel=.02)
    assert solver.warnings == []


def test_velocityThatNothingIntegratesIsReported():
    solver = fe()
    block(solver, (.001, 0))
    box = O.bodies[O.bodies.append(utils.box((-.1, .05, 0), (.1, .03, 1), fixed=True))]
    ready(solver, .8)
    steps(3)
    assert solver.warnings == []
    box.state.vel = (.5, 0, 0)
    steps(3)
    assert solver.warnings == ['Box #%d has a velocity, but no NewtonIntegrator behind FESolver moves it: '
                               'engines(fe, moving=True) has one.' % box.id]
    O.engines = yadefrag.engines(solver, moving=True)
    O.step()
    place = box.state.pos[0]
    O.step()
    assert box.state.pos[0] - place == pytest.approx(.5 * O.dt) and len(solver.warnings) == 1


# --- O.forces of walls, boxes and facets are those of the last step, with every set of engines

def loop():
    return w.InteractionLoop([w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Sphere_SurfaceSegment_ScGeom()],
                             [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()])


SETS = {
    'F': 'the solver alone', 'RF': 'engines(fe)', 'RFN': 'engines(fe, moving=True)',
    'FN': 'no resetter', 'FP': 'no resetter, a PyRunner', 'PF': 'the same before', 'NF': 'integrator first',
    'RNF': 'the same with a resetter', 'RCIFN': 'engines(fe, spheres=True)', 'NRCIF': 'integrator first',
    'RCIFNP': 'a PyRunner at the end',
}


def scene(order):
    """Two blocks at rest, one on a wall, one on a box that is higher; the solver, and {id: weight}."""
    solver = bodyOf(yadefrag.rectangle((0, 0), (1, 1)), .5, solver=dict(gravity=(0, -G), damping=300))
    solver.addPolygon(yadefrag.rectangle((3, 1), (4, 2)), size=.5, material='m')
    ground = O.bodies.append(utils.wall(0, axis=1, material='m'))
    table = O.bodies.append(utils.box((3.5, .75, 0), (1, .25, .5), fixed=True, material='m'))
    made = dict(R=w.ForceResetter, C=lambda: finder('LebesgueCollider'), I=loop,
                F=lambda: solver, N=w.NewtonIntegrator, P=lambda: w.PyRunner(command='0', iterPeriod=1))
    O.engines = [made[letter]() for letter in order]
    O.dt = .8 * solver.criticalTimeStep()
    weight = G * solver.masses.sum() / 2
    return solver, {ground: weight, table: weight}


def assertWeights(found, tolerance=1e-3):
    for surface, weight in found.items():
        assert O.forces.f(surface)[1] == pytest.approx(-weight, rel=tolerance)
        assert O.forces.f(surface, sync=True)[1] == pytest.approx(-weight, rel=tolerance)


@pytest.mark.parametrize('order', SETS, ids=SETS.values())
def test_forcesAreThoseOfTheLastStep(order):
    solver, weights = scene(order)
    steps(1500)
    assertWeights(weights)
    [ground, table] = weights
    # The weight acts in the middles of the blocks; the place of the wall is the origin.
    assert O.forces.t(ground)[2] == pytest.approx(-.5 * weights[ground], rel=1e-3)
    assert abs(O.forces.t(table)[2]) < 1e-3 * weights[table]
    if 'R' not in order:  # nothing remains when contact ends
        solver.gravity = (0, 10 * G)
        solver.takesGravity = False
        steps(400)
        assert np.all(np.array([O.forces.f(one) for one in weights]) == 0)


@pytest.mark.parametrize('order', ['FR', 'RFR', 'CIFNR'])
def test_resetterBehindIsRefused(order):
    solver, _ = scene(order)
    with pytest.raises(ValueError, match='ForceResetter behind FESolver deletes'):
        O.step()
    assert O.iter == 0


def test_forcesOfOtherEnginesRemain():
    """Without a resetter FESolver takes back its own forces only; a reset by the script counts."""
    solver, weights = scene('RF')
    [ground, table] = weights
    steps(1500)
    O.engines = [O.engines[1]]
    O.forces.addF(table, (7, 0, 0))
    steps(20)
    assertWeights(weights)
    assert O.forces.f(table)[0] == pytest.approx(7, abs=1e-6)
    O.forces.reset()
    steps(20)
    assertWeights(weights)
    assert O.forces.f(table)[0] == pytest.approx(0, abs=1e-6)
    O.engines = [w.ForceResetter(), O.engines[0]]
    steps(2)
    assertWeights(weights)
    O.engines[0].dead = True
    steps(5)
    assertWeights(weights)


def test_clumpNeedsAResetter():
    """NewtonIntegrator itself adds the forces of a clump's members to those of the clump."""
    solver = bodyOf(yadefrag.rectangle((0, 0), (1, 1)), .25, solver=dict(gravity=(0, -G)), fixed=lambda x, y: y < 1e-9)
    halves = [utils.box((x, 1.3, 0), (.1, .1, .1), fixed=False, material='m') for x in (.45, .55)]
    for one in halves:
        one.state.mass, one.state.inertia = 400, (1, 1, 3)
    clump, _ = O.bodies.appendClumped(halves)
    O.bodies[clump].state.blockedDOFs = 'zXY'
    integrator = w.NewtonIntegrator(gravity=(0, -G, 0))
    O.engines = [solver, integrator]
    O.dt = .5 * solver.criticalTimeStep()
    with pytest.raises(ValueError, match='a NewtonIntegrator and no ForceResetter'):
        O.step()
    O.engines = [w.ForceResetter(), solver, integrator]
    steps(3000)
    assert 1.05 < O.bodies[clump].state.pos[1] < 1.15


@pytest.mark.parametrize('order', ['RF', 'F', 'RFN'])
def test_forcesOfAStepThatOpensCracks(order):
    """A crack adds bodies to the scene after the forces of the step are known."""
    solver = fe(w.BrittleFEMat(young=1e10, poisson=.2, density=2500, tensileStrength=4e6, label='rock'))
    ground = O.bodies.append(utils.wall(0, axis=1))
    solver.addPolygon(yadefrag.rectangle((-.1, 0), (.1, .15)), size=.02, material='rock', thickness=.05, name='block')
    solver.addPolygon([(0, .1505), (.02, .2), (-.02, .2)], size=.02, material='rock', thickness=.05, velocity=(0, -20))
    O.engines = [dict(R=w.ForceResetter, F=lambda: solver, N=w.NewtonIntegrator)[letter]() for letter in order]
    O.dt = .4 * solver.criticalTimeStep()
    touched = 0
    for _ in range(600):
        cracks = solver.numCracks
        O.step()
        onBlock = solver.contactForces[:, 1].sum()
        assert O.forces.f(ground)[1] == pytest.approx(-onBlock, rel=1e-9, abs=1e-9)
        touched += onBlock > 1 and solver.numCracks > cracks
    assert touched > 5
