"""A block of rock is compressed until it breaks: the largest load relative to the Mohr–Coulomb law.

20 × 40 mm, between platens on which the ends slide without friction: the stress is uniform until the
first crack, and the load is 2c cos φ/(1 − sin φ). ../compression has pictures of it.
"""
import math

from yade import O
from yadefrag import rectangle

WIDE, HIGH = 20e-3, 40e-3  # m
YOUNG, POISSON, DENSITY = 20e9, .2, 2500  # Pa, 1, kg/m³
STRENGTH, ENERGY, SHEAR, FRICTION = 5e6, 10, 3, .6  # Pa, J/m², cohesion over strength, rad
LOAD = 2 * SHEAR * STRENGTH * math.cos(FRICTION) / (1 - math.sin(FRICTION))  # Pa
STRAIN = LOAD * (1 - POISSON**2) / YOUNG  # of the elastic block at failure
WAVE = math.sqrt(YOUNG / DENSITY)  # m/s
RATE = STRAIN / (60 * HIGH / WAVE)  # 1/s, slow against waves
DURATION = 1.15 * STRAIN / RATE
EVERY = HIGH / WAVE / 4  # s between two evaluations of the work


def scene(choices):
    """The block, whose initial motion is that of uniform shortening: no wave is excited."""
    fe = choices.solver(damping=.2 * WAVE / HIGH)
    material = choices.material(
        young=YOUNG, poisson=POISSON, density=DENSITY, frictionAngle=FRICTION,
        tensileStrength=STRENGTH, fractureEnergy=ENERGY, shearFactor=SHEAR)
    aside = POISSON / (1 - POISSON) * RATE
    fe.addPolygon(rectangle((0, 0), (WIDE, HIGH)), size=choices.size(1.25e-3), material=material,
                  mesh=choices.get('mesh', 'irregular'), meshSeed=choices.get('meshSeed', 1),
                  element=choices.get('element', 'linear'),
                  velocity=lambda x, y: (aside * (x - WIDE / 2), -RATE * (y - HIGH / 2)))
    for end, side in ((0, 1), (HIGH, -1)):
        fe.prescribe(lambda x, y: abs(y - end) < 1e-9, vy=side * RATE * HIGH / 2)
    choices.engines(fe)
    return fe


def watch(fe):
    """Time (s) and the platens' work (J)."""
    return O.time, fe.energy['external']


def measure(_, watched):
    """The largest load relative to the Mohr–Coulomb law."""
    pairs = zip([(0, 0), *watched], watched)
    return max((work - before) / (time - since) for (since, before), (time, work) in pairs) \
        / (RATE * HIGH * WIDE * LOAD)


VARY = [{},
        {'fracture': ['instant']},
        {'mesh': ['regular']},
        {'element': ['smoothed']},
        {'fracture': ['instant'], 'mesh': ['regular']},
        {'fracture': ['instant'], 'element': ['smoothed']},
        {'size': [2.5e-3, 8e-4]},
        {'fracture': ['instant'], 'size': [2.5e-3, 8e-4]},
        {'meshSeed': [2, 3]},
        {'timeStep': [.95, .4]},
        {'collider': ['none', 'InsertionSortCollider']},
        {'threads': [2]}]
ARGUMENTS = dict(duration=DURATION, reference=1., watch=watch, every=EVERY,
                 title='Compressed rock: error of the largest load')
