"""Loads, prescribed motion, and long runs."""

import math

import numpy
import pytest

from fe_scene import run, steps
from yade import O
from yadefrag import *
from yade.wrapper import *


def clampedBlock(top):
    """A block of 1 m held at its bottom, at rest under `top` (a function of the solver)."""
    O.materials.append(FEMat(young=1e7, poisson=0, density=1000, frictionAngle=0, label='rubber'))
    fe = FESolver(damping=60)
    fe.addPolygon(rectangle((0, 0), (1, 1)), size=.1, material='rubber')
    O.engines = [ForceResetter(), LebesgueCollider([Bo1_SurfaceSegment_Aabb()]),
                 InteractionLoop([], [], []), fe]
    O.dt = .8 * fe.criticalTimeStep()
    fe.prescribe(lambda x, y: y < 1e-9, vy=0)
    top(fe)
    return fe


def isTop(fe):
    return fe.nodes[:, 1] > 1 - 1e-9


def test_loadsStretchABlock():
    def pull(fe):
        loads = fe.loads
        top = isTop(fe)
        # Uniform traction: half as much at the two corners.
        share = numpy.where(numpy.isclose(fe.nodes[top][:, 0] % 1, 0), .5, 1)
        loads[top, 1] = 1e4 * share / share.sum()
        fe.loads = loads

    fe = clampedBlock(pull)
    runSteps(6000)
    # ν = 0: σ = 10⁴ Pa everywhere, but for the change of area (none) and of length (10⁻³ of it).
    assert numpy.allclose(fe.stress[:, 1], 1e4, rtol=2e-3)
    assert numpy.allclose(fe.displacements[isTop(fe)][:, 1], 1e-3, rtol=2e-3)
    energy = fe.energy
    assert abs(energy['total']) < 1e-4 * energy['external']
    fe.loads = None
    assert not fe.loads.any()


def test_prescribedMotionDoesItsWork():
    fe = clampedBlock(lambda fe: fe.prescribe(isTop(fe), vx=0, vy=.1))
    before = fe.nodes[isTop(fe)][0, 1]
    steps = int(.02 / O.dt)
    runSteps(steps)
    moving = numpy.argmax(fe.nodes[:, 1])
    assert fe.nodes[moving, 1] == pytest.approx(before + .1 * steps * O.dt, rel=1e-12)
    energy = fe.energy
    assert energy['external'] > 0
    assert abs(energy['total']) < 1e-4 * energy['external']
    fe.prescribe([int(moving)])
    speed = fe.velocities[moving, 1]
    runSteps(5)
    assert fe.velocities[moving, 1] != speed


def test_runCallsInBetween():
    clampedBlock(lambda fe: None)
    called = []
    assert runSteps(25, every=10, call=lambda: called.append(O.iter)) == 25
    assert called == [10, 20] and O.iter == 25


def test_minimalAngle():
    O.materials.append(FEMat(young=1e7, density=1000, label='m'))
    fe = FESolver()
    assert fe.minAngle == numpy.inf
    fe.addTriangles([(0, 0), (1, 0), (1, 1)], [(0, 1, 2)], material='m')
    assert fe.minAngle == pytest.approx(numpy.pi / 4)
    fe.addPolygon(rectangle((2, 0), (3, 1)), size=.1, material='m')
    assert numpy.pi / 6 < fe.minAngle <= numpy.pi / 4 + 1e-12


def drift(factor):
    """(of the work) What the books lose in one turn of a drum with stones of rubber."""
    O.reset()
    O.materials.append(FEMat(young=3e5, poisson=.3, density=1000, frictionAngle=.5, label='rubber'))
    solver = FESolver(gravity=(0, -9.81))
    solver.addPolygon(*ring((0, 0), .1, .11, 48), size=.02, material='rubber', name='drum')
    for k in range(8):
        x, y = .036 * (k % 4 - 1.5), .03 * (k // 4) - .045
        solver.addPolygon(rectangle((x - .013, y - .013), (x + .013, y + .013)), size=.01, material='rubber')
    solver.rotate('drum', 6., (0, 0))
    run(solver, factor=factor)
    started = solver.energy['total']
    steps(int(2 * math.pi / 6 / O.dt))
    return (solver.energy['total'] - started) / solver.energy['external']


def test_energyOfADrumDecreasesBySecondOrderInTheStep():
    """A quarter of the step, a sixteenth of the loss; stones take other ways, so that a sixth is required, or what
    the forces' tolerance leaves: 1e-4."""
    coarse, fine = abs(drift(.8)), abs(drift(.2))
    assert coarse < 2e-3 and fine < max(coarse / 6, 1e-4)
