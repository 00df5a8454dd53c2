"""Two equal steel bars collide head on: the contact stress is ρcv/2 for 2L/c, then zero.

With ν = 0 and the long faces held sideways, waves propagate along x at c = √(E/ρ) without
dispersion.
"""
import numpy as np

from yade import O
from yadefrag import rectangle, rectangleMesh

LENGTH, HEIGHT, SPEED = .1, .004, 1.  # m, m, m/s closing
YOUNG, DENSITY = 210e9, 7800  # Pa, kg/m³
WAVE = (YOUNG / DENSITY)**.5  # m/s
DURATION = 2.5 * LENGTH / WAVE  # s
EDGES = np.linspace(0, .98 * DURATION, 99)  # s, of the intervals in which stress is averaged


def scene(choices):
    """The bars, both at half the closing speed."""
    fe = choices.solver()
    material = choices.material(young=YOUNG, poisson=0, density=DENSITY, frictionAngle=0)
    size, kind = choices.size(1e-3), choices.get('mesh', 'crossed')
    cells = round(LENGTH / size), max(1, round(HEIGHT / size))
    for begin, speed in ((-LENGTH, SPEED / 2), (0, -SPEED / 2)):
        corners = (begin, 0), (begin + LENGTH, HEIGHT)
        of = dict(material=material, velocity=(speed, 0), smooth=choices.smooth(),
                  element=choices.get('element', 'linear'),
                  fixed=lambda x, y: 'y' if y < 1e-9 or y > HEIGHT - 1e-9 else False)
        if kind == 'crossed':
            fe.addTriangles(*rectangleMesh(*corners, *cells, crossed=True), **of)
        else:
            fe.addPolygon(rectangle(*corners), size=size, mesh=kind, **of)
    choices.engines(fe)
    nodes = np.unique(fe.triangles[fe.components == 1])
    return fe, nodes


def watch(built):
    """Time (s) and force (N per m of thickness) on the second bar."""
    fe, nodes = built
    return O.time, fe.contactForces[nodes, 0].sum()


def measure(_, watched):
    """(98) Stress (Pa), means over equal intervals."""
    times, forces = np.array([(0, 0), *watched]).T
    impulse = np.concatenate([[0], np.cumsum(forces[1:] * np.diff(times))])
    return np.diff(np.interp(EDGES, times, impulse)) / np.diff(EDGES) / HEIGHT


def right():
    """(98) The correct result of `measure`."""
    touching = np.clip(EDGES, 0, 2 * LENGTH / WAVE)
    return DENSITY * WAVE * SPEED / 2 * np.diff(touching) / np.diff(EDGES)


VARY = [{},
        {'size': [2e-3, 5e-4, 2.5e-4]},
        {'passes': [2]},
        {'smooth': [True]},
        {'bulkViscosity': [1.]},
        {'size': [5e-4], 'bulkViscosity': [1.]},
        {'timeStep': [1.02, .98, .4, .1]},
        {'halo': [.05, .5]},
        {'collider': ['none', 'InsertionSortCollider']},
        {'plane': ['stress']},
        {'threads': [2]},
        {'mesh': ['regular', 'irregular']},
        {'element': ['smoothed']}]
ARGUMENTS = dict(duration=DURATION, reference=right(), watch=watch,
                 title='Two bars: error of the contact stress, rms')
