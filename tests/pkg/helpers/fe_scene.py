"""An elastic disc that hits a block, the engines around an FESolver, momenta; rigid chains made by hand; warnings of a block
of code. Bodies that crack and yield: a brittle block, a plate of steel, a wall; what must hold then."""
import builtins
import contextlib
import warnings

import numpy as np

import yadefrag
from yade import utils
from yade import wrapper as w
from yade.minieigenHP import Vector3

O = builtins.O


def fe(material=None, **settings):
    """A solver, and in the scene the material, or an elastic one 'm'."""
    O.materials.append(material or w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.2, label='m'))
    return w.FESolver(**settings)


def bodyOf(outline, size, material=None, solver=None, **body):
    """A solver, whose attributes are those of `solver`, and one body: of the material, or of the elastic one 'm'. An
    outline with holes is a pair."""
    made = fe(material, **(solver or {}))
    parts = outline if isinstance(outline, tuple) else (outline,)
    made.addPolygon(*parts, size=size, material=len(O.materials) - 1, **body)
    return made


def block(solver, low, high, size, material='m', **body):
    """Adds a rectangle; its number."""
    return solver.addPolygon(yadefrag.rectangle(low, high), size=size, material=material, **body)


def run(solver, collider=None, spheres=False, newton=True, factor=.8):
    """The usual engines around `solver`, and a stable step."""
    engines = [w.ForceResetter()]
    if collider:
        engines.append(collider)
    if spheres:
        engines.append(w.InteractionLoop(
            [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Sphere_SurfaceSegment_ScGeom()],
            [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]))
    engines.append(solver)
    if newton:
        engines.append(w.NewtonIntegrator(damping=0))
    O.engines = engines
    O.dt = factor * solver.criticalTimeStep()


def ready(solver, factor, **settings):
    """The engines of yadefrag.engines, and this part of the critical step."""
    O.engines = yadefrag.engines(solver, **settings)
    O.dt = factor * solver.criticalTimeStep()


def solverOfScene():
    return next((engine for engine in O.engines if isinstance(engine, w.FESolver)), None)


def reloaded(path):
    """The solver of the scene, which is saved there and loaded."""
    O.save(path)
    O.reset()
    O.load(path)
    return solverOfScene()


def finder(name, **attributes):
    return getattr(w, name)([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()], **attributes)


def steps(count):
    for _ in range(count):
        O.step()


def impact(name=None, smooth=False, **settings):
    """A disc that hits a block, ready to run."""
    solver = fe(**settings)
    solver.addPolygon(yadefrag.circle((0, 0), .1, 24), size=.02, material='m', velocity=(2, .3), smooth=smooth, spin=3)
    solver.addPolygon(yadefrag.rectangle((.105, -.1), (.2, .1)), size=.02, material='m')
    run(solver, name and finder(name))
    return solver


def blow():
    """Two blocks of 1 cm that meet at 20 m/s."""
    solver = fe(w.FEMat(young=210e9, poisson=.3, density=7800))
    for k in range(2):
        nodes, triangles = yadefrag.rectangleMesh((.01 * k, -.001 * k), (.01 * k + .01, -.001 * k + .01), 6 + k, 6 + k)
        solver.addTriangles(nodes, triangles, material=0, velocity=(20 * (1 - k), 0))
    run(solver, finder('LebesgueCollider'))
    return solver


def newBall(place, radius, material):
    """A sphere's body at `place` (2,), free to move, which is not in the scene; `material` is an object, but its mass that of
    the last one in the scene."""
    made = utils.sphere((float(place[0]), float(place[1]), 0), radius)
    made.material = material
    return made


def throwBall(place, radius, velocity=(0, 0), material='m', spin=0, blocked='zXY'):
    """A sphere's body, which is in the scene and moves in the plane, unless other directions are blocked."""
    body = utils.sphere((float(place[0]), float(place[1]), 0), radius, material=material)
    body.state.vel, body.state.angVel, body.state.blockedDOFs = (*velocity, 0), (0, 0, spin), blocked
    O.bodies.append(body)
    return body


def chain(points, material, closed=False, **attributes):
    """Bodies, which obey no forces, of the straight segments along `points` (n, 2): a rigid boundary, material on the left."""
    places = [Vector3(*map(float, point), 0) for point in points]
    ends = list(zip(places, places[1:] + places[:1]))[:None if closed else -1]
    travel = [(b - a).normalized() for a, b in ends]
    bodies = []
    for i, (a, b) in enumerate(ends):
        shape = w.SurfaceSegment(start=a, end=b, **attributes)
        if closed or i > 0:
            shape.before = travel[i - 1]
        if closed or i + 1 < len(ends):
            shape.after = travel[(i + 1) % len(ends)]
        bodies.append(rigid(shape, material))
    return bodies


def rigid(shape, material):
    """A body with `shape` and a material (an object) that does not obey forces."""
    made = w.Body()
    made.shape, made.material, made.state.blockedDOFs = shape, material, 'xyzXYZ'
    return made


def sphereEngines(collider=None, newton=True):
    """The usual loop for spheres and surface segments without a solver; returns the collider."""
    collider = collider or w.InsertionSortCollider([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb(), w.Bo1_Wall_Aabb()])
    loop = w.InteractionLoop(
        [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Sphere_SurfaceSegment_ScGeom(), w.Ig2_Wall_Sphere_ScGeom()],
        [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()])
    O.engines = [w.ForceResetter(), collider, loop, *([w.NewtonIntegrator(damping=0)] if newton else [])]
    return collider


def momentum(solver, bodies=None):
    """(linear (2,), angular about the origin) of the nodes, and of the spheres or other bodies."""
    m, x, v = solver.masses, solver.nodes, solver.velocities
    linear = (m[:, None] * v).sum(0)
    angular = (m * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0])).sum()
    for b in [b for b in O.bodies if b and isinstance(b.shape, w.Sphere)] if bodies is None else bodies:
        s = b.state
        linear = linear + s.mass * np.array(s.vel)[:2]
        angular += s.mass * (s.pos[0] * s.vel[1] - s.pos[1] * s.vel[0])
        angular += s.inertia[2] * s.angVel[2]
    return linear, angular


def kineticEnergy(*bodies):
    """(J) Of rigid bodies."""
    return builtins.sum(.5 * b.state.mass * b.state.vel.squaredNorm() + .5 * b.state.inertia[2] * b.state.angVel[2]**2
                        for b in bodies)


@contextlib.contextmanager
def heard():
    """A list of the texts of all warnings of the block, after its end."""
    texts = []
    with warnings.catch_warnings(record=True, action='always') as caught:
        yield texts
    texts += [str(one.message) for one in caught]


# --- bodies that crack and yield

def brittle(**values):
    given = dict(young=30e9, poisson=.2, density=2500, frictionAngle=0, tensileStrength=20e6)
    given.update(values)
    return w.BrittleFEMat(**given)


def engines(solver, name='LebesgueCollider', factor=.5):
    run(solver, name and finder(name), spheres=True, factor=factor)


def brittleImpact(name='LebesgueCollider', threads=1, speed=20, smooth=True, **values):
    """A disc that hits a block and cracks it, ready to run."""
    O.materials.append(w.FEMat(young=50e9, poisson=.25, density=7800, frictionAngle=0, label='m'))
    O.materials.append(brittle(label='b', **values))
    solver = w.FESolver(ompThreads=threads)
    solver.addPolygon(yadefrag.rectangle((0, 0), (.04, .03)), size=.002, material='b',
                      smooth=smooth, fixed=lambda x, y: y < 1e-9)
    solver.addPolygon(yadefrag.circle((.0213, .0352), .005, 32), size=.002, material='m',
                      smooth=True, velocity=(0, -speed))
    engines(solver, name)
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


def splitting(intoCracks=True):
    """A bar with a weak joint in its middle, that is drawn apart; pressure on its lower side."""
    solver = fe(w.BrittleFEMat(young=1e7, density=1000, tensileStrength=1e4, label='b'))
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, .4)), size=.1, material='b', joints=[((.5, 0), (.5, .4))],
                      jointStrength=1e3, jointEnergy=0, velocity=lambda x, y: (.5 if x > .5 else -.5 if x < .5 else 0, 0))
    run(solver, factor=.5)
    solver.pressure(lambda x, y: y < 1e-9, 50., intoCracks=intoCracks)
    return solver


def heapSpheres():
    """Six spheres that fall on the block, beside the disc; they take half the time step."""
    for i in range(6):
        ball = newBall((.003 + .0045 * i + .01 * (i > 3), .0319), .002, O.materials['m'])
        ball.state.blockedDOFs = 'zXY'
        ball.state.vel = (0, -5, 0)
        O.bodies.append(ball)
    O.dt *= .5


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
