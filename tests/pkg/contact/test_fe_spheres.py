"""FESolver's bodies and YADE's spheres: momentum, energy, forces on single pieces."""
import builtins
import math

import numpy as np
import pytest

import yadefrag
from fe_scene import (bodyOf, finder, kineticEnergy, momentum, newBall, O, run, solverOfScene, steps, throwBall,
                      wallAndClump)
from yade import wrapper as w


def elastic(friction):
    return w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=friction, label='m')


@pytest.mark.parametrize('smooth, friction, varying', [
    (False, 0, False), (False, .5, False), (True, 0, False), (True, .5, True), (False, 0, True)])
def test_sphereOnABodyKeepsMomentum(smooth, friction, varying):
    """Also where O.dt changes in every step."""
    solver = bodyOf(yadefrag.rectangle((-.1, -.1), (.1, 0)), .02, elastic(friction), smooth=smooth)
    ball = throwBall((.033, .052), .05, (.5, -1), spin=20)
    run(solver, finder('LebesgueCollider'), spheres=True, factor=.3)
    linear, angular = momentum(solver)
    energy = solver.energy['total'] + .5 * ball.state.mass * ball.state.vel.squaredNorm()
    touched = 0
    dt = O.dt
    for i in range(4000):
        if varying:
            O.dt = dt * (.3 + .7 * (7 * i % 11) / 11)
        O.step()
        touched += len(list(O.interactions)) > 0
        if touched and not len(list(O.interactions)):
            break
    assert touched > 20 and ball.state.vel[1] > 0
    after, afterAngular = momentum(solver)
    scale = ball.state.mass
    assert np.abs(after - linear).max() < 1e-12 * scale
    assert abs(afterAngular - angular) < 1e-9 * scale * .1
    assert not solver.numActives
    if not friction:
        ledger = solver.energy
        work = .5 * ball.state.mass * ball.state.vel.squaredNorm()
        assert ledger['kinetic'] + ledger['strain'] + work == pytest.approx(energy, rel=.01)
    assert solver.energy['external'] > 0  # the sum of all: test_fe_scene_check.py


def test_forceOnAPieceGoesToItsNodes():
    """Force and torque on an entry's body: sum and moment of the nodes' forces are the same."""
    solver = bodyOf(yadefrag.rectangle((0, 0), (.1, .1)), .05, smooth=[True, False, False, True])
    run(solver, newton=False)
    for b in O.bodies:
        O.forces.setPermF(b.id, (3, -2, 0))
        O.forces.setPermT(b.id, (0, 0, .25))
    arms = [b.state.pos for b in O.bodies]
    n = len(arms)
    O.step()
    linear, angular = momentum(solver)
    assert linear == pytest.approx(np.array([3, -2]) * n * O.dt)
    # the momentum is that about the origin with the positions where the forces acted
    x = solver.nodes - O.dt * solver.velocities
    v, m = solver.velocities, solver.masses
    angular = (m * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0])).sum()
    wanted = sum(p[0] * -2 - p[1] * 3 + .25 for p in arms) * O.dt
    assert angular == pytest.approx(wanted)


def allEnergy(solver, clump):
    """Of the bodies, the clump and the springs between them, with what has been spent."""
    springs = 0
    for contact in O.interactions:
        if contact.isReal:
            springs += contact.phys.normalForce.squaredNorm() / contact.phys.kn / 2
            springs += contact.phys.shearForce.squaredNorm() / contact.phys.ks / 2
    known = solver.energy
    return springs + kineticEnergy(clump) \
        + builtins.sum(known[name] for name in ('kinetic', 'strain', 'contact', 'friction',
                                                'fracture', 'damping'))


@pytest.mark.parametrize('young, engines', [
    (1e9, None), (2e9, None), (2e11, None), (2e9, ('InteractionLoop', 'NewtonIntegrator')),
    (2e9, ('CurveLoop', 'CurveIntegrator'))])
def test_aCrackUnderASphereGivesNoEnergy(young, engines):
    """Contacts keep their force and energy; the overlap with the new corner gets no force. With `engines` spheres move
    before FESolver."""
    solver, clump = wallAndClump(young)
    if engines:
        swapEngines(*engines)
        *others, last, integrator = O.engines
        assert last is solver and isinstance(integrator, w.NewtonIntegrator)
        O.engines = [*others, integrator, last]
    before = allEnergy(solver, clump)
    O.run(int(6e-4 / O.dt), True)
    assert solver.numCracks > 30
    # Leapfrog's energies are accurate to some thousandths; springs' friction is not counted.
    assert abs(allEnergy(solver, clump) / before - 1) < .01
    assert not any('created' in sentence for sentence in solver.warnings)


def test_aCrackUnderASphereKeepsTheMomentum():
    solver, clump = wallAndClump(2e9, fixed=None)

    before, turning = momentum(solver, [clump])
    O.run(int(6e-4 / O.dt), True)
    assert solver.numCracks > 30
    after, turned = momentum(solver, [clump])
    assert np.abs(after - before).max() < 1e-9 * before[0]
    # Positions and velocities are half a step apart.
    assert abs(turned - turning) < 1e-3 * before[0]


def swapEngines(loop, integrator):
    """Replaces loop and integrator of O.engines by those of the given classes."""
    def swapped(engine):
        if isinstance(engine, w.NewtonIntegrator):
            return getattr(w, integrator)(damping=engine.damping, gravity=engine.gravity)
        if isinstance(engine, w.InteractionLoop):
            parts = engine.geomDispatcher, engine.physDispatcher, engine.lawDispatcher
            return getattr(w, loop)(*[part.functors for part in parts])
        return engine
    O.engines = [swapped(engine) for engine in O.engines]


def bodiesNow():
    """All numbers of the motion of bodies and nodes, as bytes."""
    rows = [[*b.state.pos, *b.state.vel, *b.state.angVel, *b.state.ori] for b in O.bodies if b]
    return [np.array(rows).tobytes(), solverOfScene().nodes.tobytes()]


def test_curveIntegratorLeavesOutPieces():
    """Pieces of a wall that cracks move as by NewtonIntegrator, to the last bit, though FESolver moves them; also
    where O.trackEnergy, or the order of the engines, changes in between."""
    found = []
    for integrator in ('NewtonIntegrator', 'CurveIntegrator'):
        O.reset()
        solver, clump = wallAndClump(2e9)
        for number in range(4):
            O.bodies.append(newBall((3 + number, 3, 0), .1, clump.material or O.materials[0]))
            O.bodies[-1].state.vel, O.bodies[-1].state.angVel = (0, -1, 0), (0, 0, 3)
        swapEngines('InteractionLoop', integrator)
        newton = O.engines[-1]
        assert type(newton) is getattr(w, integrator)
        one = []
        for part in range(6):
            O.trackEnergy = part == 3
            if part in (4, 5):  # FESolver moves to the end, and back
                order = [e for e in O.engines if e != newton] + [newton]
                O.engines = order[:-2] + [newton, solver] if part == 4 else order
            O.run(int(1e-4 / O.dt), True)
            one.append(bodiesNow())
            pieces = [b for b in O.bodies if b and isinstance(b.shape, w.SurfaceSegment)]
            assert any(abs(b.state.angVel[2]) > 0 and b.state.ori[2] != 0 for b in pieces)
            if integrator == 'CurveIntegrator' and part != 3:
                # Four spheres and the clump.
                assert newton.fastBodies == 5 + (len(pieces) if part == 4 else 0)
        assert solver.numCracks > 30
        found.append(one)
    assert found[0] == found[1]


YOUNG, POISSON, DENSITY = 1e6, .3, 1000
WAVE = math.sqrt(YOUNG * (1 - POISSON) / (1 + POISSON) / (1 - 2 * POISSON) / DENSITY)


def sphereOn(radius, at, size):
    """A sphere of this many times the segments' length comes down on a block, as deep as it is wide."""
    solver = w.FESolver()
    made = w.FEMat(young=YOUNG, poisson=POISSON, density=DENSITY, frictionAngle=0)
    nodes, triangles = yadefrag.rectangleMesh((0, 0), (1, 1), 4, 4)
    x, y = at
    solver.addTriangles(size * nodes + (x - .5 * size, y - size), triangles, material=made, thickness=size)
    length = .25 * size
    # The contact's stiffness goes with the radius, and the nodes must be able to follow it.
    soft = w.FrictMat(young=YOUNG / max(1, radius), poisson=.3, density=DENSITY, frictionAngle=.3)
    ball = newBall((x + .07 * size, y + radius * length * (1 + 1e-6)), radius * length, soft)
    # A contact takes some ten steps, or more.
    dt = min(.5 * solver.criticalTimeStep(), .3 * radius * length / WAVE)
    ball.state.vel = (0, -1e-4 * min(1, radius) * length / dt, 0)
    ball.state.blockedDOFs = 'zXY'
    O.bodies.append(ball)
    run(solver, finder('LebesgueCollider'), spheres=True)
    O.dt = dt
    return solver, 150


@pytest.mark.parametrize('radius, size, at', [
    (1e-6, 1, (0, 0)), (1e-3, 1, (0, 0)), (100, 1, (0, 0)), (1e4, 1, (0, 0)), (.5, 1e-9, (0, 0)),
    (.5, 1e6, (0, 0)), (.5, 1, (1e6, -1e6))])
def test_spheresOfAnySizeComeBack(radius, size, at):
    solver, steps = sphereOn(radius, at, size)
    ball = O.bodies[-1].state
    speed = ball.vel[1]
    momentum = ball.mass * speed
    touched = 0
    for _ in range(steps):
        O.step()
        touched += any(i.isReal for i in O.interactions)
    given = (solver.masses[:, None] * solver.velocities).sum(0)[1]
    assert touched > 5
    assert ball.mass * ball.vel[1] + given == pytest.approx(momentum, rel=1e-9)
    if radius <= 1:
        assert .3 < ball.vel[1] / -speed < 1.1
    else:  # it weighs much more than what it falls on
        assert given / solver.masses.sum() < speed


# --- a sphere that goes from one piece of a boundary to the next keeps its tangential force

R, DEEP, FRICTION = .05, 1e-4, .8  # m, m, rad


def ballOn(outline, start, velocity, blocked='xyzXYZ'):
    """A sphere (m) that moves over a body whose boundary has pieces of 20 mm, not yet touching in depth."""
    solver = bodyOf(outline, .02, elastic(FRICTION), fixed=lambda x, y: True)
    ball = throwBall(start, R, velocity, blocked=blocked)
    run(solver, finder('LebesgueCollider'), spheres=True, factor=.3)
    return solver, ball


def contacts():
    """[(id of the piece, pressure (N), tangential force (N) along x)]"""
    return [(i.id2, i.phys.normalForce.norm(), i.phys.shearForce[0], i.phys.ks) for i in O.interactions if i.isReal]


@pytest.mark.parametrize('way', [1, -1])
def test_tangentialForceGoesOnAtAJoint(way):
    """It is stiffness × way, to rounding, and the sphere is pulled back by it, about the same point."""
    begin = -way * .0001
    _, ball = ballOn(yadefrag.rectangle((-.1, -.02), (.1, 0)), (begin, R - DEEP), (way * .01, 0))
    pieces = set()
    for _ in range(500):
        steps(1)
        (piece, _, shear, ks), = contacts()
        moved = ball.state.pos[0] - begin
        assert shear == pytest.approx(ks * moved, rel=1e-9)
        assert O.forces.f(ball.id)[0] == pytest.approx(-shear, rel=1e-9)
        assert O.forces.t(ball.id)[2] == pytest.approx(-shear * (R - DEEP / 2), rel=1e-9)
        pieces.add(piece)
    assert len(pieces) == 2 and moved * way > .00015


def test_ballThatIsThrownRollsAsInTheory():
    """It slides first, then rolls: 5/7 of its speed is left, whatever friction is. 2·10⁻³: normal
    springs swing, and where the ball begins to roll its tangential spring does."""
    _, ball = ballOn(yadefrag.rectangle((-.1, -.02), (.5, 0)), (-.07, R - 1e-7), (.5, 0), blocked='zXY')
    O.engines[-1].gravity = (0, -9.81, 0)
    pieces = set()
    while ball.state.pos[0] < .2:
        steps(50)
        pieces |= {one[0] for one in contacts()}
    assert len(pieces) > 5
    assert ball.state.vel[0] == pytest.approx(5 / 7 * .5, rel=2e-3)
    assert -ball.state.angVel[2] * R == pytest.approx(ball.state.vel[0], rel=2e-3)


def test_forceIsSharedWhereTheBoundaryIsBentInwards():
    """A joint of 2°: both pieces push for 1.7 mm, one less and less, each with a tangential spring of
    its own. All the force goes over to the second one: 1 %, since it turns by 2° on the way."""
    up = .1 * np.tan(np.radians(1))
    _, ball = ballOn([(-.1, -.04), (.1, -.04), (.1, up), (0, 0), (-.1, up)], (-.0012, R - 12 * DEEP), (.05, 0))
    both, wanted = 0, 0
    while ball.state.pos[0] < .0012:
        steps(1)
        found = contacts()
        both += len(found) == 2
        wanted += found[0][3] * .05 * O.dt * len(found)
        shear = builtins.sum(one[2] for one in found)
        assert shear == pytest.approx(wanted, rel=.01)
        assert all(abs(one[2]) <= np.tan(FRICTION) * one[1] for one in found)
    assert both > 500 and len(found) == 1
