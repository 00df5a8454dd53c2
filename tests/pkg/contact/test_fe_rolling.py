"""A sphere that goes from one piece of a boundary to the next keeps its tangential force."""
import builtins

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, finder, momentum, run, steps, throwBall
from yade import wrapper as w

O = builtins.O
R, DEEP, FRICTION = .05, 1e-4, .8  # m, m, rad


def sphereOn(outline, start, velocity, blocked='xyzXYZ', fixed=lambda x, y: True):
    """A sphere (m) that moves over a body whose boundary has pieces of 20 mm, not yet touching in depth."""
    solver = fe()
    O.materials['m'].frictionAngle = FRICTION
    solver.addPolygon(outline, size=.02, material='m', fixed=fixed)
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
    _, ball = sphereOn(yadefrag.rectangle((-.1, -.02), (.1, 0)), (begin, R - DEEP), (way * .01, 0))
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
    _, ball = sphereOn(yadefrag.rectangle((-.1, -.02), (.5, 0)), (-.07, R - 1e-7), (.5, 0), blocked='zXY')
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
    _, ball = sphereOn([(-.1, -.04), (.1, -.04), (.1, up), (0, 0), (-.1, up)], (-.0012, R - 12 * DEEP), (.05, 0))
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


def test_slidingIsNoMoreThanFrictionAtJoints():
    _, ball = sphereOn(yadefrag.rectangle((-.1, -.02), (.1, 0)), (-.005, R - DEEP), (5., 0))
    O.materials['m'].frictionAngle = .2
    pieces = set()
    while ball.state.pos[0] < .05:
        steps(1)
        (piece, normal, shear, _), = contacts()
        assert abs(shear) <= np.tan(.2) * normal * (1 + 1e-12)
        pieces.add(piece)
    assert len(pieces) >= 3


def test_momentumIsKeptOverJoints():
    solver, ball = sphereOn(yadefrag.rectangle((-.1, -.1), (.1, 0)), (-.0005, R + 1e-5), (3, -.3), 'zXY', None)
    ball.state.angVel = (0, 0, 30)
    linear, angular = momentum(solver)
    pieces = set()
    for _ in range(3000):
        steps(1)
        pieces |= {one[0] for one in contacts()}
    after, afterAngular = momentum(solver)
    assert len(pieces) > 1
    assert np.abs(after - linear).max() < 1e-12 * ball.state.mass
    assert abs(afterAngular - angular) < 1e-9 * ball.state.mass * .1


@pytest.mark.parametrize('ending', ['.yade', '.xml'])
def test_savedJustBeforeAJoint(folder, ending):
    """What the next step needs of the last one is saved: the same bits."""
    def loaded():
        return next(b for b in O.bodies if isinstance(b.shape, w.Sphere))

    _, ball = sphereOn(yadefrag.rectangle((-.1, -.02), (.1, 0)), (-.0001, R - DEEP), (.01, 0))
    steps(1)
    first, number = contacts()[0][0], 0
    while contacts()[0][0] == first:
        O.save('%s/%d%s' % (folder, number % 2, ending))
        number += 1
        steps(1)
    wanted = contacts(), ball.state.pos
    O.load('%s/%d%s' % (folder, (number - 1) % 2, ending))
    assert contacts()[0][0] == first
    steps(1)
    assert (contacts(), loaded().state.pos) == wanted
