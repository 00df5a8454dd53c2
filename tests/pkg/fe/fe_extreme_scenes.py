"""Scenes at the limits of FESolver, for test_fe_extremes.py; run by yade, prints what they come to.

Each function of SCENES builds a scene that is ready to run and returns (solver, steps).
"""
import builtins
import hashlib
import json
import math
import os
import sys

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', 'helpers')]

import numpy as np

import fe_chain as chain
import yadefrag
from yade import wrapper as w

O = builtins.O
YOUNG, POISSON, DENSITY = 1e6, .3, 1000
MOST = 60  # steps of each with two threads, which wait for each other on a busy machine
WAVE = math.sqrt(YOUNG * (1 - POISSON) / (1 + POISSON) / (1 - 2 * POISSON) / DENSITY)


def material(kind='FEMat', friction=0, **values):
    given = dict(young=YOUNG, poisson=POISSON, density=DENSITY, frictionAngle=math.atan(friction))
    given.update(values)
    made = getattr(w, kind)(**given)
    O.materials.append(made)
    return made


def engines(solver, part, collider='LebesgueCollider', **attributes):
    """The usual ones around `solver`; `part` of the critical step."""
    bounds = [w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()]
    O.engines = [w.ForceResetter(), getattr(w, collider)(bounds, **attributes), w.InteractionLoop(
        [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Sphere_SurfaceSegment_ScGeom()],
        [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]),
        solver, w.NewtonIntegrator(damping=0)]
    O.dt = part * solver.criticalTimeStep()


def block(solver, low, size, parts, made, **how):
    """A square of parts × parts quads; its nodes have the same numbers wherever it is."""
    nodes, triangles = yadefrag.rectangleMesh((0, 0), (1, 1), parts, parts)
    return solver.addTriangles(size * nodes + low, triangles, material=made, **how)


def blow(speed=1e-3 * WAVE, size=1, at=(0, 0), gap=1e-4, part=.8, ratio=1, until=6, aside=.1317,
         **attributes):
    """One block hits another, `ratio` times as dense, at `speed` (m/s); `gap` of the size between
    them. Runs for `until` times that a wave takes through the left one."""
    solver = w.FESolver(passes=2)
    left, right = material(), material(density=ratio * DENSITY)
    x, y = at
    block(solver, (x - (1 + gap) * size, y), size, 3, left, velocity=(speed, 0))
    block(solver, (x, y + aside * size), size, 4, right)
    engines(solver, part, **attributes)
    return solver, math.ceil(size * (until / WAVE + (gap / speed if speed else 0)) / O.dt)


def needle(degrees=.1):
    """A block comes onto the flank of a needle, near the tip."""
    half = math.tan(math.radians(degrees / 2))
    solver = w.FESolver(passes=2)
    made = material()
    solver.addPolygon([(0, -half), (1, 0), (0, half)], size=2, material=made,
                      fixed=lambda x, y: x < .5)
    block(solver, (.7, .4 * half), .5, 2, made, velocity=(0, -.1 * half * WAVE))
    engines(solver, .8)
    return solver, math.ceil(6 / WAVE / O.dt)


def slider(friction):
    """A flat block slides on the ground at 1 m/s."""
    solver = w.FESolver(gravity=(0, -1000, 0), linearViscosity=.06)
    made = material(friction=friction, young=1e9)
    solver.addTriangles(*yadefrag.rectangleMesh((-.02, -.01), (.06, 0), 16, 2), material=made,
                        fixed=lambda x, y: True)
    solver.addTriangles(*yadefrag.rectangleMesh((0, 0), (.03, .005), 9, 2, True), material=made,
                        velocity=(1, 0))
    engines(solver, .8)
    return solver, math.ceil(5e-4 / O.dt)


def brittle(strength, energy=0, speed=20):
    """Two blocks that meet and may crack; strength None: of a material that does not."""
    solver = w.FESolver(passes=2)
    kind = 'FEMat' if strength is None else 'BrittleFEMat'
    values = {} if strength is None else dict(tensileStrength=strength, fractureEnergy=energy)
    made = material(kind, young=1e9, poisson=.2, **values)
    block(solver, (0, 0), .01, 4, made, velocity=(speed, 0))
    block(solver, (.0101, .002), .01, 5, made, velocity=(-speed, 0))
    engines(solver, .5)
    return solver, 200


def sphereOn(radius, at=(0, 0), size=1, collider='LebesgueCollider'):
    """A sphere of this many times the segments' length comes down on a block, as deep as it is
    wide; the step is the smaller of the two's own."""
    solver = w.FESolver()
    x, y = at
    block(solver, (x - .5 * size, y - size), size, 4, material(), thickness=size)
    length = .25 * size
    # The contact's stiffness goes with the radius, and the nodes must be able to follow it.
    soft = w.FrictMat(young=YOUNG / max(1, radius), poisson=.3, density=DENSITY, frictionAngle=.3)
    O.materials.append(soft)
    ball = chain.ball((x + .07 * size, y + radius * length * (1 + 1e-6)), radius * length, soft)
    # A contact takes some ten steps, or more.
    dt = min(.5 * solver.criticalTimeStep(), .3 * radius * length / WAVE)
    ball.state.vel = (0, -1e-4 * min(1, radius) * length / dt, 0)
    ball.state.blockedDOFs = 'zXY'
    O.bodies.append(ball)
    engines(solver, 1, collider)
    O.dt = dt
    return solver, 150


def crowd():
    """Enough triangles for two threads, far from the origin."""
    solver = w.FESolver(passes=2)
    made = material()
    block(solver, (1e6, -1e6), 1, 48, made, velocity=(.5, 0))
    block(solver, (1e6 + 1.0001, -1e6 + .1), 1, 50, made)
    engines(solver, .8)
    return solver, 60


SCENES = {
    'a hundredth of the critical step': lambda: blow(part=.01),
    'nearly the critical step': lambda: blow(part=.9999),
    'a nanometre a second': lambda: blow(1e-9, gap=1e-11),
    'half the wave speed': lambda: blow(.5 * WAVE, gap=1e-3),
    'size 1e-9': lambda: blow(size=1e-9),
    'size 1e6': lambda: blow(size=1e6),
    '1e6 off the origin': lambda: blow(at=(1e6, -1e6), gap=1e-3),
    'mass ratio 1e8': lambda: blow(ratio=1e8, gap=1e-6),
    'sliver': needle,
    'touching': lambda: blow(gap=0),
    'touching, off the origin': lambda: blow(gap=0, at=(1e6, -1e6)),
    'friction 0': lambda: slider(0),
    'friction 1': lambda: slider(1),
    'friction 100': lambda: slider(100),
    'strength 1e-300': lambda: brittle(1e-300),
    'strength 1e300': lambda: brittle(1e300),
    'tiny sphere': lambda: sphereOn(1e-6),
    'huge sphere': lambda: sphereOn(1e4),
    'sphere on 1e-9 m': lambda: sphereOn(.5, size=1e-9),
    'sphere on 1e6 m': lambda: sphereOn(.5, size=1e6),
    'two threads': crowd,
}


def digest(solver):
    """Of all that moves, and of what has been in contact."""
    data = solver.nodes.tobytes() + solver.velocities.tobytes() + repr(solver.energy).encode()
    for body in O.bodies:
        if body and isinstance(body.shape, w.Sphere):
            data += np.array([*body.state.pos, *body.state.vel]).tobytes()
    return hashlib.sha1(data).hexdigest()


if __name__ == '__main__' and sys.argv[-1] == 'print':
    results = {}
    for name, build in SCENES.items():
        O.reset()
        solver, steps = build()
        O.run(min(steps, MOST), True)
        results[name] = digest(solver)
    print('\n@@@ ' + json.dumps(dict(threads=O.numThreads, results=results)), flush=True)
