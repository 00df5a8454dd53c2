"""CurveLoop beside YADE's loop in the same scene: the same bits of bodies, contacts and all their attributes."""
import numpy as np
import yade.wrapper as w
from yade.minieigenHP import Matrix3

import scenes
from scenes import O, heap


def geometries(suffix='', others=None, **sphere):
    """Functors for contacts of spheres with spheres, whose arguments are given, and with other shapes; `others`: their
    arguments, by shape."""
    shapes = ('Facet', 'Box') if suffix else ('Facet', 'Box', 'Wall')
    return [getattr(w, 'Ig2_Sphere_Sphere_ScGeom' + suffix)(**sphere),
            *(getattr(w, 'Ig2_%s_Sphere_ScGeom%s' % (shape, suffix))(**(others or {}).get(shape, {})) for shape in shapes)]


def numbers(value):
    return list(value) if hasattr(value, '__len__') else [value]


def state():
    """All numbers of bodies and contacts, and all attributes of geometry and physics, as bytes."""
    rows = [[number for part in (i.geom, i.phys) for _, value in sorted(part.dict().items()) for number in numbers(value)]
            for i in O.interactions]
    return scenes.state() + [np.array(rows, float).tobytes()]


NAMES = 'InteractionLoop', 'CurveLoop'


def place(name, functors, *before, collider='LebesgueCollider'):
    """The loop, in the engines of a heap, behind those of `before`."""
    loop = getattr(w, name)(*functors)
    O.engines = [w.ForceResetter(), *before, scenes.makeCollider(collider), loop,
                 w.NewtonIntegrator(damping=.1, gravity=(0, 0, -10))]
    return loop


def run(name, functors, steps, build=heap, change=None, threads=-1, collider='LebesgueCollider', **settings):
    """(loop, states after each quarter of the steps); then `change(part)` is called."""
    build(**settings)
    place(name, functors, collider=collider).ompThreads = threads
    found = []
    for part in range(4):
        O.run(steps // 4, True)
        found.append(state())
        if change:
            change(part)
    return O.engines[2], found


def requireSame(make, steps, material=None, **settings):
    """`make()`, `material()`: functors and a material, anew for each of the two."""
    found = []
    for name in NAMES:
        if material:
            settings['material'] = material()
        loop, states = run(name, make(), steps, **settings)
        found.append(states)
    assert O.interactions.countReal() > 20
    assert found[0] == found[1]
    return loop


# --- scenes

def denseHeap(**settings):
    """With more contacts than bodies, which the loop then reads in rows."""
    heap(spacing=1.15, **settings)


def shearedHeap(homoDeform=2, **settings):
    heap(periodic=True, **settings)
    O.cell.homoDeform = homoDeform
    O.cell.velGrad = Matrix3(-.3, .2, 0, 0, -.2, 0, 0, 0, -.3)
