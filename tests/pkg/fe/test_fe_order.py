"""The order of engines around an FESolver: momentum is kept, or the first step is refused."""
import builtins
import itertools

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, finder, momentum, steps
from yade import utils
from yade import wrapper as w

O = builtins.O
kOrder = 'the order is ForceResetter, collider, InteractionLoop, FESolver, NewtonIntegrator'


def blow(order):
    """A sphere that hits a block, with engines in the order given by letters; the solver."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.25, material='m')
    sphere = utils.sphere((-.104, .5, 0), .1, material=w.FrictMat(young=1e7, density=1000))
    sphere.state.vel = (2, 0, 0)
    O.bodies.append(sphere)
    made = dict(
        R=w.ForceResetter(), C=finder('LebesgueCollider'), F=solver,
        N=w.NewtonIntegrator(damping=0), I=w.InteractionLoop(
            [w.Ig2_Sphere_SurfaceSegment_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
            [w.Law2_ScGeom_FrictPhys_CundallStrack()]))
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


def test_missingResetterIsRefused():
    blow('CIFN')
    with pytest.raises(ValueError, match='no ForceResetter.*' + kOrder):
        O.step()


def test_orderIsCheckedAgain():
    """When engines change in the middle of a run, and when one is disabled or enabled."""
    blow('RCIFN')
    steps(2)
    O.engines = [O.engines[i] for i in (0, 3, 1, 2, 4)]
    with pytest.raises(ValueError, match=kOrder):
        O.step()
    O.engines[3].dead = True
    steps(2)
    O.engines[3].dead = False
    with pytest.raises(ValueError, match=kOrder):
        O.step()
