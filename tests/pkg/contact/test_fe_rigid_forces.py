"""O.forces of walls, boxes and facets are those of the last step, with every set of engines."""
import builtins

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, finder, steps
from yade import utils
from yade import wrapper as w

O = builtins.O
G = 9.81


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
    solver = fe(gravity=(0, -G), damping=300)
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m')
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
    solver = fe(gravity=(0, -G))
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.25, material='m', fixed=lambda x, y: y < 1e-9)
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
    O.materials.append(w.BrittleFEMat(young=1e10, poisson=.2, density=2500, tensileStrength=4e6, label='rock'))
    solver = w.FESolver()
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
