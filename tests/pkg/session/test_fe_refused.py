"""A step that FESolver refuses has not been; what cannot be copied whole is not copied at all."""
import builtins
import copy
import math
import pickle

import numpy as np
import pytest

import yadefrag
from fe_scene import finder, impact, run, steps
from yade import wrapper as w

O = builtins.O


def forced(force):
    """A step with a force on a piece of the boundary."""
    O.forces.setPermF(0, force)
    with pytest.raises(RuntimeError, match='Step .*(not finite|range of numbers|a node moves)'):
        O.step()
    O.forces.setPermF(0, (0, 0, 0))


def tooLong(factor):
    dt = O.dt
    O.dt *= factor
    with pytest.raises(ValueError, match='must be above 0 and at most'):
        O.step()
    O.dt = dt


REFUSALS = {
    'infinite': lambda: forced((math.inf, 0, 0)),
    'no number': lambda: forced((0, math.nan, 0)),
    'beyond all numbers': lambda: forced((1e300, -1e300, 0)),
    'far too strong': lambda: forced((1e12, 0, 0)),
    'too long': lambda: tooLong(50),
}


def state(solver):
    return (solver.numSearches, solver.nodes, solver.velocities, solver.contactForces, solver.stress,
            list(solver.energy.items()), list(solver.warnings), solver.numActives,
            solver.maxPenetration, [b.shape.halo for b in O.bodies if b],
            [tuple(b.state.pos) for b in O.bodies if b])


def areSame(a, b):
    return all(np.array_equal(x, y) if isinstance(x, np.ndarray) else x == y
               for x, y in zip(a, b))


def scene(kind, finderName):
    solver = impact(finderName, smooth=kind == 'smooth')
    if kind == 'cracking':
        O.materials.append(w.BrittleFEMat(young=1e7, poisson=.3, density=1000, tensileStrength=2e4,
                                          label='brittle'))
        solver.addPolygon(yadefrag.rectangle((-.3, -.1), (-.105, .1)), size=.03,
                          material='brittle', velocity=(9, 0))
        run(solver, finderName and finder(finderName), factor=.5)
    return solver


def course(kind, finderName, refuse):
    O.reset()
    solver = scene(kind, finderName)
    states = []
    for moment in range(6):
        if refuse and moment:
            before = state(solver)
            refuse()
            assert areSame(before, state(solver))
        steps(30)
        states.append(state(solver))
    assert solver.energy['contact'] != 0
    assert (solver.numCracks > 0) == (kind == 'cracking')
    return states


@pytest.mark.parametrize('kind', ['straight', 'smooth', 'cracking'])
@pytest.mark.parametrize('finderName', ['LebesgueCollider', None])
def test_aRefusedStepChangesNothing(kind, finderName):
    wanted = course(kind, finderName, None)
    for name, refuse in REFUSALS.items():
        for moment, (a, b) in enumerate(zip(wanted, course(kind, finderName, refuse))):
            assert areSame(a, b), (name, moment)


COPIES = [copy.copy, copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))]


@pytest.mark.parametrize('make', COPIES)
def test_aSolverWithBodiesIsNotCopied(make):
    solver = impact()
    with pytest.raises(TypeError, match='cannot be copied or pickled.*O.save keeps them'):
        make(solver)
    steps(3)


@pytest.mark.parametrize('make', COPIES)
@pytest.mark.parametrize('thing', [
    lambda: w.FESolver(damping=3, passes=2), lambda: w.FEMat(young=3e7, poisson=.1),
    lambda: w.BrittleFEMat(young=3e7, tensileStrength=5, seed=7), lambda: w.SurfaceSegment(halo=.2),
    lambda: w.LebesgueCollider([w.Bo1_Sphere_Aabb()], verletDist=.3),
    lambda: w.Ig2_Sphere_SurfaceSegment_ScGeom(label='a'), lambda: w.Bo1_SurfaceSegment_Aabb()])
def test_allElseIsCopiedWhole(make, thing):
    one = thing()
    other = make(one)
    assert type(other) is type(one) and other is not one
    values, copied = one.dict(), other.dict()
    values.pop('boundDispatcher', None), copied.pop('boundDispatcher', None)
    assert values == copied
