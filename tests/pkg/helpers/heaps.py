"""A heap of spheres with a clump on fixed bodies, a packing, and all bits of a scene, for tests of loop and integrator."""
import numpy as np
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Vector3

import scenes
from scenes import O


def heap(material=None, periodic=False, spacing=1.45):
    """Spheres of three sizes, a clump among them, that fall on a facet floor, a box and a wall."""
    scenes.clear()
    chance = np.random.default_rng(3)
    O.materials.append(material or w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    if periodic:
        O.periodic = True
        O.cell.setBox(9, 9, 9)
    for place in np.ndindex(6, 6, 4):
        at = np.array(place) * spacing + chance.uniform(-.2, .2, 3) + (1, 1, 1.6)
        ball = utils.sphere(Vector3(*at), chance.choice([.5, .7, .75]))
        ball.state.vel = Vector3(*chance.normal(0, 3, 3))
        ball.state.angVel = Vector3(*chance.normal(0, 5, 3))
        O.bodies.append(ball)
    O.bodies.appendClumped([utils.sphere((4, 4, 9), .6), utils.sphere((4.8, 4, 9), .6)])
    if not periodic:
        O.bodies.append([utils.facet([(-30, -30, 0), (30, -30, 0), (0, 40, 0)]),
                         utils.box((0, 4, 1), (.8, 6, 1), fixed=True), utils.wall(9.5, axis=1)])
    O.dt = 2e-4


def packing(shape, spacing, dt, isTurning=False, seed=2):
    """Spheres with friction in random motion, in an order that is not that of their places."""
    scenes.clear()
    chance = np.random.default_rng(seed)
    places = np.array(list(np.ndindex(shape))) * spacing
    chance.shuffle(places)
    O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    scenes.addSpheres(places, [.5] * len(places), chance.normal(0, 2, (len(places), 3)), dynamic=True)
    for body in O.bodies if isTurning else ():
        body.state.angVel = chance.normal(0, 3, 3)
    O.dt = dt


def state():
    """All numbers of bodies and real contacts, as bytes."""
    numbers = [[*b.state.pos, *b.state.vel, *b.state.angVel, *b.state.ori] for b in O.bodies if b]
    contacts = [[i.id1, i.id2, i.iterMadeReal, *i.geom.normal, *i.geom.contactPoint, i.geom.penetrationDepth,
                 i.geom.refR1, i.geom.refR2, *i.geom.shearInc, i.phys.kn, i.phys.ks, *i.phys.normalForce,
                 *i.phys.shearForce] for i in O.interactions]
    forces = [[*O.forces.f(b.id), *O.forces.t(b.id)] for b in O.bodies if b]
    return [np.array(rows, float).tobytes() for rows in (numbers, contacts, forces)]
