"""A rubber cylinder rolls over a flat block: the force on it should always be its weight.

E 200 MPa, radius 10 mm, pressed by gravity (2000 m/s²), rolling at 0.25 m/s; details in ../rolling.
A polygon falls onto its sides and is lifted over its corners; with a smooth surface the effect is smaller.
"""
import math

import numpy as np

from yadefrag import circle, rectangle

RADIUS, SPEED, GRAVITY = 10e-3, .25, 2000.  # m, m/s, m/s²
DAMPING = 3000.  # 1/s
SEGMENTS, BLOCK = 48, .25  # around the cylinder; the block's segments in those
SETTLING, ROLLED = 3e-3, 2  # s before the measurement; its length in segments
SEGMENT = 2 * math.pi * RADIUS / SEGMENTS  # m
DURATION = SETTLING + ROLLED * SEGMENT / SPEED
EVERY = 1e-5  # s between two evaluations of the force


def scene(choices):
    """Block (body 0) and cylinder (body 1); the size is that of the cylinder's segments."""
    size = choices.size(SEGMENT)
    # Damping reduces the translation by α·m·v, and by α·m·v/2 through the spin.
    fe = choices.solver(passes=2, damping=DAMPING,
                        gravity=(1.5 * DAMPING * SPEED, -GRAVITY, 0))
    material = choices.material(young=200e6, poisson=.3, density=1000,
                                frictionAngle=math.atan(.6))
    far = SPEED * DURATION
    segments = round(2 * math.pi * RADIUS / size)
    of = dict(material=material, selfContact=False, mesh=choices.get('mesh', 'regular'),
              element=choices.get('element', 'linear'))
    fe.addPolygon(rectangle((-4e-3, -5e-3), (far + 5e-3, 0)), size=BLOCK * size,
                  fixed=lambda x, y: y < -4.999e-3, **of)
    fe.addPolygon(circle((0, RADIUS), RADIUS, segments), size=1.01 * size,
                  smooth=choices.smooth(True), velocity=(SPEED, 0), spin=-SPEED / RADIUS, **of)
    choices.engines(fe)
    nodes = np.unique(fe.triangles[fe.components == 1])
    return fe, nodes, fe.masses[nodes].sum() * GRAVITY


def watch(built):
    """Vertical force over weight."""
    fe, nodes, weight = built
    return fe.contactForces[nodes, 1].sum() / weight


def measure(_, watched):
    """rms of the force's deviation from the weight, relative to it."""
    rolling = np.array(watched[round(SETTLING / EVERY):])
    return float(np.sqrt(np.mean((rolling - 1)**2)))


VARY = [{},
        {'smooth': [False], 'passes': [2, 1]},
        {'smooth': [True], 'passes': [1]},
        {'size': [1.5 * SEGMENT, SEGMENT / 1.5]},
        {'timeStep': [.95, .4]},
        {'halo': [.05, .5]},
        {'collider': ['none', 'InsertionSortCollider']},
        {'verletDist': [-.1]},
        {'threads': [2]},
        {'mesh': ['irregular']},
        {'element': ['smoothed']}]
ARGUMENTS = dict(duration=DURATION, watch=watch, every=EVERY,
                 title='Rolling cylinder: error of the force, rms')
