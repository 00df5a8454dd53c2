"""Bodies around an axis: a scene of one body, points of an arc about the axis, steel."""
import builtins
import math

import numpy

from yadefrag import FESolver

O = builtins.O

YOUNG, POISSON, DENSITY = 200e9, .3, 7800
STEEL = dict(young=YOUNG, poisson=POISSON, density=DENSITY, frictionAngle=0)
BAR = math.sqrt(YOUNG / DENSITY)  # m/s, speed of waves in a bar


def body(material, outline, size, **settings):
    """The solver of a new scene, with this body."""
    O.reset()
    O.materials.append(material)
    fe = FESolver(axisymmetric=True)
    fe.addPolygon(outline, size=size, material=0, **settings)
    return fe


def untilTime(fe, time, steps=20):
    """Runs so many steps at a time."""
    while fe.time < time:
        O.run(steps, True)


def arc(radius, angles):
    """Points (n, 2) about the origin; angle 0 is the axis, below."""
    points = radius * numpy.stack([numpy.sin(angles), -numpy.cos(angles)], axis=1)
    points[numpy.isclose(angles, 0), 0] = 0
    return points
