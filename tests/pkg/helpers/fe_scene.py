"""An elastic disc that hits a block, the engines around an FESolver, momenta; rigid chains made by hand; warnings of a block
of code."""
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


def blow(held=False, **settings):
    """Two blocks of 1 cm that meet at 20 m/s; `held`: all their nodes keep their velocities."""
    O.materials.append(w.FEMat(young=210e9, poisson=.3, density=7800))
    solver = w.FESolver(**settings)
    for k in range(2):
        nodes, triangles = yadefrag.rectangleMesh((.01 * k, -.001 * k), (.01 * k + .01, -.001 * k + .01), 6 + k, 6 + k)
        solver.addTriangles(nodes, triangles, material=0, velocity=(20 * (1 - k), 0), fixed=lambda x, y: held)
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
