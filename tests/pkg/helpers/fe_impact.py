"""Bodies that are hit, ready to run, for the tests of cracks: a brittle block, a plate of steel, a wall; what
must hold then."""
import builtins

import numpy as np

import fe_scene
import yadefrag
from fe_scene import newBall, steps  # noqa: F401  for tests
from yade import wrapper as w

O = builtins.O


def brittle(**values):
    given = dict(young=30e9, poisson=.2, density=2500, frictionAngle=0, tensileStrength=20e6)
    given.update(values)
    return w.BrittleFEMat(**given)


def engines(solver, finder='LebesgueCollider', factor=.5):
    fe_scene.run(solver, finder and fe_scene.finder(finder), spheres=True, factor=factor)


def impact(finder='LebesgueCollider', threads=1, speed=20, smooth=True, **values):
    """A disc that hits a block and cracks it, ready to run."""
    O.materials.append(w.FEMat(young=50e9, poisson=.25, density=7800, frictionAngle=0, label='m'))
    O.materials.append(brittle(label='b', **values))
    solver = w.FESolver(ompThreads=threads)
    solver.addPolygon(yadefrag.rectangle((0, 0), (.04, .03)), size=.002, material='b',
                      smooth=smooth, fixed=lambda x, y: y < 1e-9)
    solver.addPolygon(yadefrag.circle((.0213, .0352), .005, 32), size=.002, material='m',
                      smooth=True, velocity=(0, -speed))
    engines(solver, finder)
    return solver


STEEL = dict(young=200e9, poisson=.29, density=7830, yieldStress=792e6, hardening=510e6, hardeningExponent=.26,
             rateFactor=.014, thermalExponent=1.03, meltTemperature=1793, heatCapacity=477)
FAILS = dict(failureD1=.05, failureD2=3.44, failureD3=-2.12, failureD4=.002, failureD5=.61, fractureEnergy=2e4)


def plate(**material):
    """A plate of steel, 2 mm thick and held at both ends, that a harder bar plugs."""
    O.materials.append(w.PlasticFEMat(**{**STEEL, **material}))
    O.materials.append(w.FEMat(young=600e9, poisson=.22, density=15000))
    solver = w.FESolver(passes=2)
    solver.addPolygon(yadefrag.rectangle((-.012, 0), (.012, .002)), size=5e-4, material=0,
                      fixed=lambda x, y: abs(x) > .0119)
    solver.addPolygon(yadefrag.rectangle((-.003, .002), (.003, .006)), size=1e-3, material=1, velocity=(0, -500))
    O.engines = yadefrag.engines(solver)
    O.dt = .7 * solver.criticalTimeStep()
    return solver


def wallAndClump(young=2e9, fixed=lambda x, y: abs(y) > .5 - 1e-9):
    """A brittle wall, and a clump of three spheres that hits it at 40 m/s."""
    O.materials.append(w.BrittleFEMat(young=30e9, poisson=.2, density=2400, frictionAngle=.3,
                                      tensileStrength=3e6, strengthScatter=.1, label='wall'))
    O.materials.append(w.FrictMat(young=young, poisson=.3, density=2400, frictionAngle=.3, label='s'))
    solver = w.FESolver()
    solver.addPolygon(yadefrag.rectangle((0, -.5), (.1, .5)), size=.02, material='wall', fixed=fixed)
    number, _ = O.bodies.appendClumped([newBall(at, .05, O.materials['s'])
                                        for at in ((-.051, .01), (-.09, .07), (-.09, -.05))])
    clump = O.bodies[number]
    clump.state.vel, clump.state.blockedDOFs = (40, 0, 0), 'zXY'
    engines(solver, factor=.2)
    return solver, clump


def heapSpheres():
    """Six spheres that fall on the block, beside the disc; they take half the time step."""
    for i in range(6):
        ball = newBall((.003 + .0045 * i + .01 * (i > 3), .0319), .002, O.materials['m'])
        ball.state.blockedDOFs = 'zXY'
        ball.state.vel = (0, -5, 0)
        O.bodies.append(ball)
    O.dt *= .5


def state(solver):
    return (solver.nodes, solver.velocities, solver.masses, solver.triangles,
            np.concatenate(solver.surfaces), solver.fragmentOf)


def areSame(a, b):
    return all(np.array_equal(x, y) for x, y in zip(a, b))


def requireBodiesAreEntries(solver):
    """One body for each piece, of the right kind, in closed chains on the nodes' places."""
    pieces = sorted((b.shape for b in O.bodies if isinstance(b.shape, w.SurfaceSegment)),
                    key=lambda shape: shape.entry)
    entries = [shape.entry for shape in pieces]
    assert entries == (list(range(len(pieces))) if solver.dropped['count'] == 0 else sorted(set(entries)))
    starts, ends = {}, {}
    for shape in pieces:
        starts[tuple(shape.start)] = starts.get(tuple(shape.start), 0) + 1
        ends[tuple(shape.end)] = ends.get(tuple(shape.end), 0) + 1
    assert starts == ends
    places = {tuple(x) for x in solver.nodes[np.concatenate(solver.surfaces)]}
    for shape in pieces:
        if shape.kind in (0, 1):
            assert tuple(shape.start)[:2] in places
        if shape.kind in (0, 2):
            assert tuple(shape.end)[:2] in places
        if shape.kind == 3:
            assert tuple(shape.middle)[:2] in places
    # In half segments: an arc takes one half of each of two segments.
    share = {0: 2, 1: 1, 2: 1, 3: 2}
    assert sum(share[shape.kind] for shape in pieces) == 2 * solver.numSegments


def cracks(solver):
    """Nodes that are at one place without stress, each once."""
    places = np.round(solver.nodes - solver.displacements, 9)
    unique, count = np.unique(places, axis=0, return_counts=True)
    return unique[count > 1]
