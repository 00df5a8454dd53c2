"""A scene of spheres on finite-element bodies goes on from a saved file with the same bits."""
import builtins
import os

import pytest
import yadefrag  # noqa: F401: its classes are in yade.wrapper from then on
from yade.utils import PWaveTimeStep, sphere
from yade.wrapper import (Bo1_Sphere_Aabb, Bo1_SurfaceSegment_Aabb, BrittleFEMat, FEMat, FESolver,
                          ForceResetter, FrictMat, Ig2_Sphere_Sphere_ScGeom,
                          Ig2_Sphere_SurfaceSegment_ScGeom, InteractionLoop,
                          Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack,
                          LebesgueCollider, NewtonIntegrator, Sphere)

from yadefrag import rectangle

O = builtins.O


def build(isBrittle):
    common = dict(young=1e9, poisson=.3, density=2000, frictionAngle=.3)
    O.materials.append(BrittleFEMat(tensileStrength=2e5, **common) if isBrittle else
                       FEMat(**common))
    O.materials.append(FrictMat(young=1e8, poisson=.3, density=2000, frictionAngle=.4))
    solver = FESolver()
    solver.addPolygon(rectangle((0, 0), (.2, .02)), size=.01, material=0,
                      fixed=lambda x, y: y < 1e-9)
    solver.addPolygon([(.09, .0205), (.115, .0205), (.115, .0355), (.09, .0355)], size=.01, material=0,
                      smooth=not isBrittle, velocity=(1, -3))
    for i in (0, 1, 2, 3, 4, 8, 9, 10, 11):     # beside the block
        O.bodies.append(sphere((.012 + .015 * i, .026 + .0003 * i, 0), .0035, material=1))
        O.bodies[-1].state.blockedDOFs = 'zXY'
        O.bodies[-1].state.vel = (.5 - .1 * i, -2, 0)
    O.engines = [
        ForceResetter(),
        LebesgueCollider([Bo1_Sphere_Aabb(), Bo1_SurfaceSegment_Aabb()], verletDist=.001),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Sphere_SurfaceSegment_ScGeom()],
                        [Ip2_FrictMat_FrictMat_FrictPhys()],
                        [Law2_ScGeom_FrictPhys_CundallStrack()]),
        solver, NewtonIntegrator(gravity=(0, -9.81, 0))]
    O.dt = .5 * min(solver.criticalTimeStep(), PWaveTimeStep())


def solverOfScene():
    return next(engine for engine in O.engines if isinstance(engine, FESolver))


def state():
    """All that the next steps depend on; geometry of contacts is not saved by YADE, but made."""
    solver = solverOfScene()
    spheres = [(b.id, tuple(b.state.pos), tuple(b.state.vel), tuple(b.state.angVel))
               for b in O.bodies if b and isinstance(b.shape, Sphere)]
    contacts = sorted((i.id1, i.id2, tuple(i.phys.normalForce), tuple(i.phys.shearForce),
                       i.geom.penetrationDepth, tuple(i.geom.contactPoint))
                      for i in O.interactions if i.isReal)
    return dict(nodes=solver.nodes.tobytes(), velocities=solver.velocities.tobytes(),
                forces=solver.contactForces.tobytes(), reactions=solver.reactions.tobytes(),
                energy=repr(solver.energy), warnings=solver.warnings, cracks=solver.numCracks,
                spheres=repr(spheres), contacts=repr(contacts))


@pytest.mark.parametrize('ending', ['.yade', '.yade.gz', '.xml', '.xml.bz2'])
@pytest.mark.parametrize('isBrittle', [False, True])
def test_goesOnWithTheSameBits(folder, isBrittle, ending):
    path = os.path.join(folder, 'scene' + ending)
    seen = 0
    for saved in (300, 600, 900):
        O.reset()
        build(isBrittle)
        O.run(saved, True)
        O.save(path)
        expected = [state()]
        for _ in range(6):
            O.run(50, True)
            expected.append(state())
        O.load(path)
        for number, one in enumerate(expected):
            if number:
                O.run(50, True)
            here = state()
            # YADE makes the geometry of contacts in the first step after loading.
            assert [name for name in one if one[name] != here[name] and (number or name != 'contacts')] == []
            seen += len(here['contacts']) > 2
    assert seen > 2     # spheres touched the bodies
    assert (solverOfScene().numCracks > 0) == isBrittle
