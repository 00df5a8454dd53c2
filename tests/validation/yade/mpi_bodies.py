"""Bodies and engines of mpi_scene.py, and what a process reports of them."""
import builtins
import random

from yade import mpy as mp
from yade import utils
from yade import wrapper as w

O = builtins.O      # mpy keeps attributes of its own in this object
kRadius = .5


def place(collider, **settings):
    """`settings` of the collider; its label is the name by which mpy finds it."""
    O.engines = [
        w.ForceResetter(), getattr(w, collider)([w.Bo1_Sphere_Aabb(), w.Bo1_Box_Aabb(), w.Bo1_Facet_Aabb()],
                                                label='collider', **settings),
        w.InteractionLoop([w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Box_Sphere_ScGeom(), w.Ig2_Facet_Sphere_ScGeom()],
                          [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]),
        w.NewtonIntegrator(gravity=(0, -10, 0), damping=0, label='newton')]
    O.materials.append(w.FrictMat(young=1e6, poisson=.3, density=1000, frictionAngle=.5))


def assign(width, workers=None):
    """Slices along x, one for each worker; in one process all bodies remain in the master, since
    NewtonIntegrator moves only those."""
    workers = mp.numThreads - 1 if workers is None else workers
    for body in O.bodies:
        if workers > 0 and isinstance(body.shape, w.Sphere):
            body.subdomain = 1 + min(workers - 1, max(0, int(body.state.pos[0] / width * workers)))


def columns():
    """Leaning columns of equal spheres that fall on a plate and push each other aside."""
    for i in range(24):
        for j in range(10):
            O.bodies.append(utils.sphere((i * .999 + j / 30, j * 1.01, 0), kRadius))
    O.bodies.append(utils.box((12, -.5, 0), (24, 0, 2), fixed=True))
    O.dt = 1e-3
    return 24


def gas():
    """Spheres of different sizes that fly through a box, on a floor of two facets."""
    chance = random.Random(1)
    for i in range(8):
        for j in range(6):
            for k in range(6):
                at = [1.3 * n + chance.uniform(-.05, .05) for n in (i, j, k)]
                ball = utils.sphere(at, kRadius * chance.uniform(.4, 1))
                ball.state.vel = [chance.uniform(-12, 12) for _ in range(3)]
                O.bodies.append(ball)
    low, high = (-.7, -.7, -.7), (9.8, 7.2, 7.2)
    O.bodies.append(utils.aabbWalls([low, high], thickness=.1))
    corners = [(-.7, -.6, -.7), (9.8, -.6, -.7), (9.8, -.6, 7.2), (-.7, -.6, 7.2)]
    O.bodies.append([utils.facet([corners[n] for n in one]) for one in ((0, 1, 2), (0, 2, 3))])
    O.dt = 1e-3
    return 9.1


def clumpedGas():
    """[[member, ..., clump], ...], by id; one id for a sphere that is no member."""
    chance = random.Random(2)
    made = []
    for i in range(9):
        for j in range(4):
            for k in range(4):
                at = [1.9 * n + chance.uniform(-.05, .05) for n in (i, j, k)]
                radius = .4 if (i + j + k) % 3 else .5
                balls = [utils.sphere((at[0] + .45 * m, at[1] + .2 * m * (m - 1), at[2]), radius)
                         for m in range((i + j + k) % 3 + 1)]
                made.append(O.bodies.append(balls))
                if len(balls) > 1:
                    made[-1].append(O.bodies.clump(made[-1]))
                state = O.bodies[made[-1][-1]].state
                state.vel = [chance.uniform(-12, 12) for _ in range(3)]
                state.angVel = [chance.uniform(-5, 5) for _ in range(3)]
    O.bodies.append(utils.aabbWalls([(-1, -1, -1), (17.1, 7.6, 7.6)], thickness=.1))
    O.dt = 1e-3
    return made


def run(steps, merge=True):
    if mp.numThreads > 1:
        mp.mpirun(steps, mp.numThreads, merge)
    else:
        O.run(steps, True)


def contactsHere():
    """[id1, id2, overlap] of real contacts with a body of this process; all in a merged scene."""
    return sorted([min(i.id1, i.id2), max(i.id1, i.id2), overlap(i)] for i in O.interactions if i.isReal
                  and (isMerged() or mp.rank in (O.bodies[i.id1].subdomain, O.bodies[i.id2].subdomain)))


def overlap(contact):
    """Of two spheres; 1 m for others. (YADE does not send penetrationDepth to other processes.)"""
    one, two = O.bodies[contact.id1], O.bodies[contact.id2]
    if not (isinstance(one.shape, w.Sphere) and isinstance(two.shape, w.Sphere)):
        return 1.
    apart = two.state.pos - one.state.pos
    if O.periodic:
        apart += O.cell.hSize * contact.cellDist
    return one.shape.radius + two.shape.radius - apart.norm()


def isMerged():
    return mp.rank == 0 and not O.splitted


def bodiesHere():
    return {b.id: [*b.state.pos, *b.state.vel, *b.state.angVel] for b in O.bodies
            if b and not b.isSubdomain and (isMerged() or b.subdomain == mp.rank)}


def state():
    return dict(bodies=bodiesHere(), contacts=contactsHere())


def owners():
    """{id: process} of all bodies, in each process."""
    mine = {b.id: mp.rank for b in O.bodies if b and b.subdomain == mp.rank and not b.isSubdomain}
    return {k: r for one in mp.comm.allgather(mine) for k, r in one.items()}
