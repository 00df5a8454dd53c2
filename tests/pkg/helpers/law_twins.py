"""A law of CurveLoop beside YADE's loop: the same bits of bodies, contacts and all their attributes."""
import numpy as np
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Matrix3

import scenes
from scenes import O, heap, packing


def geometries(suffix='', **sphere):
    """Functors for contacts of spheres with spheres, whose arguments are given, and with other shapes."""
    shapes = ('Facet', 'Box') if suffix else ('Facet', 'Box', 'Wall')
    return [getattr(w, 'Ig2_Sphere_Sphere_ScGeom' + suffix)(**sphere),
            *(getattr(w, 'Ig2_%s_Sphere_ScGeom%s' % (shape, suffix))() for shape in shapes)]


def numbers(value):
    return list(value) if hasattr(value, '__len__') else [value]


def state():
    """All numbers of bodies and contacts, and all attributes of geometry and physics, as bytes."""
    rows = [[number for part in (i.geom, i.phys) for _, value in sorted(part.dict().items()) for number in numbers(value)]
            for i in O.interactions]
    return scenes.state() + [np.array(rows, float).tobytes()]


def run(name, functors, steps, build=heap, threads=-1, change=None, **settings):
    """`change(part)` is called after each quarter of the steps."""
    build(**settings)
    loop = getattr(w, name)(*functors)
    loop.ompThreads = threads
    O.engines = [w.ForceResetter(), scenes.makeCollider('LebesgueCollider'), loop,
                 w.NewtonIntegrator(damping=.1, gravity=(0, 0, -10))]
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
    for name in ('InteractionLoop', 'CurveLoop'):
        if material:
            settings['material'] = material()
        loop, states = run(name, make(), steps, **settings)
        found.append(states)
    assert O.interactions.countReal() > 20
    assert found[0] == found[1]
    return loop


def denseHeap(**settings):
    """With more contacts than bodies, which the loop then reads in rows."""
    heap(spacing=1.15, **settings)


def shearedHeap(**settings):
    heap(periodic=True, **settings)
    O.cell.homoDeform = 2
    O.cell.velGrad = Matrix3(-.3, .2, 0, 0, -.2, 0, 0, 0, -.3)


def clumps(material=None):
    """Members count with masses of their own."""
    scenes.clear()
    O.materials.append(material or w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    chance = np.random.default_rng(4)
    for place in np.ndindex(4, 5, 5):
        at = np.array(place) * (1.55, .97, .97) + chance.uniform(-.02, .02, 3)
        clump, _ = O.bodies.appendClumped([utils.sphere(at, .5), utils.sphere(at + (.6, 0, 0), .45)])
        O.bodies[clump].state.vel = chance.normal(0, 2, 3)
    O.dt = 1e-4


def lonelyHeap(**settings):
    """With many bodies that touch nothing the loop reads bodies in place."""
    heap(**settings)
    for number in range(900):
        O.bodies.append(utils.sphere((100 + 3 * (number % 30), 3 * (number // 30), 0), 1, fixed=True))


def manyContacts(**settings):
    """From 2,048 contacts on, geometries and physics are moved together."""
    packing((12, 12, 12), .97, 1e-4, seed=5, **settings)


# Steps and least number of contacts.
kScenes = {shearedHeap: (700, 40), clumps: (160, 150), lonelyHeap: (700, 20), manyContacts: (160, 2048)}


def requireSameIn(build, make, **settings):
    steps, contacts = kScenes[build]
    loop = requireSame(make, steps, build=build, **settings)
    assert loop.fastForces == O.interactions.countReal() > contacts
    assert build is not lonelyHeap or len(O.interactions) < len(O.bodies)


def saveAndLoad(path):
    O.save(path)
    O.reset()
    O.load(path)


def some(chance, **values):
    """Each of these with a probability of one half."""
    return {name: value for name, value in values.items() if chance.random() < .5}
