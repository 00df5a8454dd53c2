"""One run for codes.py, inside yade: prints one line of JSON.

    scripts/yade -n -x -j1 tests/benchmark/codes_yade.py SETTINGS

SETTINGS is JSON with scene, n, warm (steps before those that are measured), steps, seed, friction (angle,
radians), collider, loop, integrator (names of classes), and folder. Into the folder go start.npz and start.json,
from which another code begins, and end.npy, the positions after all steps.

YADE's velocities belong to the middle of a step, those of the other codes to its end: start.npz has the mean
of the velocities before and after the first step, which is that at its begin. The other codes ignore the sliding
at contacts that exist at their start; so does the first step here, which is made without velocities.
"""
import json
import os
import resource
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import numpy as np  # noqa: E402
import yade.wrapper  # noqa: E402
import yadefrag  # noqa: E402
from yade import O, config  # noqa: E402
from yade.minieigenHP import Vector3  # noqa: E402
from yade.wrapper import ForceResetter, Sphere  # noqa: E402

import scenes  # noqa: E402

YOUNG = 1e7  # Pa, of all these scenes
STIFFNESS = YOUNG * scenes.RADIUS  # N/m: that of two equal spheres, 2 E R R / (R + R)
POISSON = .3  # of the stiffness along the contact to that across


def build(settings):
    """The scene without damping, which the other codes do not have, and with one stiffness for all contacts."""
    O.reset()
    scene = settings['scene']
    parts = getattr(scenes, scene)(settings['n'], settings['seed'])
    O.dt = parts['dt']
    O.materials[0].frictionAngle = settings['friction']
    parts['newton']['damping'] = 0
    # Otherwise it depends on the radii; a facet counts as a sphere of twice the radius.
    if scene in ('polydisperse', 'hopper'):
        parts['phys'][0].kn, parts['phys'][0].ks = STIFFNESS, POISSON * STIFFNESS
    return parts


def made(name):
    """The class of this name, of yadefrag or of YADE."""
    return getattr(yadefrag, name, None) or getattr(yade.wrapper, name)


def setEngines(parts, settings):
    """The engines whose times are taken, by name."""
    timed = dict(search=made(settings['collider'])(parts['bound']),
                 forces=made(settings['loop'])(parts['geom'], parts['phys'], parts['law']),
                 integration=made(settings['integrator'])(**parts['newton']))
    moved = [parts['turning']] if 'turning' in parts else []
    O.engines = [ForceResetter(), timed['search'], timed['forces'], *moved, timed['integration']]
    return timed


def bodies():
    """The spheres."""
    return [body for body in O.bodies if isinstance(body.shape, Sphere)]


def column(name):
    """(n, 3) of one attribute of the spheres' states."""
    return np.array([getattr(body.state, name) for body in bodies()])


def firstStep():
    """(positions, velocities, spins) at the begin of the first step, which is made here."""
    states = [body.state for body in bodies()]
    places, velocities = column('pos'), [Vector3(state.vel) for state in states]
    for state in states:
        state.vel = Vector3.Zero
    O.step()
    for state, velocity in zip(states, velocities):
        state.pos += velocity * O.dt
        state.vel += velocity
    # Bodies that forces do not move have the velocity that the bar's engine has given to them.
    return places, (np.array(velocities) + column('vel')) / 2, column('angVel') / 2


def writeStart(settings, parts, places, velocities, spins):
    """What another code needs."""
    spheres, folder = bodies(), settings['folder']
    bar = np.zeros(len(spheres), bool)
    if 'turning' in parts:
        bar[list(parts['turning'].ids)] = True
    np.savez(os.path.join(folder, 'start.npz'), places=places, velocities=velocities, spins=spins, bar=bar,
             radii=[body.shape.radius for body in spheres],
             fixed=np.array([body.state.blockedDOFs == 'xyzXYZ' for body in spheres]))
    material = O.materials[0]
    about = dict(dt=O.dt, kn=STIFFNESS, kt=POISSON * STIFFNESS, law='hooke', young=material.young, poisson=material.poisson, friction=float(np.tan(settings['friction'])),
                 density=scenes.DENSITY, radius=scenes.RADIUS, gravity=-parts['newton'].get('gravity', (0, 0, 0))[2],
                 turn=parts['turning'].angularVelocity if 'turning' in parts else 0)
    if settings['scene'] == 'mindlin':
        # Both codes: F = kn √R δ^1.5, R = R1 R2 / (R1 + R2).
        contact = next(i.phys for i in O.interactions if i.isReal)
        root = np.sqrt(scenes.RADIUS / 2)
        about.update(law='hertz', kn=contact.kno / root, kt=contact.kso / root)
    if settings['scene'] == 'hopper':
        about['walls'] = [part.tolist() for part in scenes.walls()]
        about['facets'] = [[list(body.state.pos + corner) for corner in body.shape.vertices]
                           for body in O.bodies if not isinstance(body.shape, Sphere)]
    with open(os.path.join(folder, 'start.json'), 'w') as out:
        json.dump(about, out)


def main(settings):
    """Build, run, write, print."""
    parts = build(settings)
    timed = setEngines(parts, settings)
    O.timingEnabled = True
    writeStart(settings, parts, *firstStep())
    O.run(settings['warm'] - 1, True)
    begin, steps = {engine: (engine.execTime, engine.execCount) for engine in O.engines}, settings['steps']
    O.run(steps, True)
    took = {engine: (engine.execTime - begin[engine][0]) * 1e-9 / steps for engine in O.engines}
    row = {name: took[engine] for name, engine in timed.items()}
    row.update(step=sum(took.values()), searches=timed['search'].execCount - begin[timed['search']][1],
               contacts=O.interactions.countReal(), yade=config.version,
               memory=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
    np.save(os.path.join(settings['folder'], 'end.npy'), column('pos'))
    print(json.dumps(row), flush=True)


main(json.loads(sys.argv[1]))
