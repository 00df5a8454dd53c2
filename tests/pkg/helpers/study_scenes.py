"""Scenes of test_tradeoff.py and test_ensemble.py, cheap enough for many runs; each run loads this file."""
import math
import os
import random
import time
import warnings

from yade import O, utils, wrapper as w
from yadefrag import rectangleMesh


SIDE, SPEED = 1., 3.  # m, m/s


def body(choices, mesh, **more):
    """The solver with one body, ready to run."""
    fe = choices.solver()
    material = choices.material(young=1e6, poisson=.2, density=1000, frictionAngle=0)
    fe.addTriangles(*mesh, material=material, **more)
    choices.engines(fe)
    return fe


def block(choices):
    """Two triangles (or more, with a smaller size) that fly freely."""
    cells = round(SIDE / choices.size(SIDE))
    return body(choices, rectangleMesh((0, 0), (SIDE, SIDE), cells, cells), velocity=(SPEED, 0))


def rest(choices):
    """A block that rounding alone shakes."""
    return body(choices, rectangleMesh((.3, .3), (1, 1), 7, 7))


def place0(fe):
    """(m) How far the farthest node went."""
    return float(abs(fe.displacements).max())


def way(fe):
    """(m) That the block went; error from the number of steps only."""
    return float(fe.displacements[:, 0].mean())


def seen(_, ways):
    """How often it was watched, and the last way that was seen."""
    return [len(ways), ways[-1]]


def whole(fe):
    """Numbers that depend on the choices."""
    return [fe.passes, fe.contactTolerance, fe.halo, fe.linearViscosity, fe.quadraticViscosity,
            O.materials[0].planeStress, O.numThreads, len(O.engines), len(fe.triangles)]


def spheres(choices):
    """A sphere bounces between two others; a stiffer one blows up with a step this long."""
    O.materials.append(w.FrictMat(young=choices.get('young', 1e6), density=1000, poisson=.3))
    O.bodies.append([utils.sphere((0, 0, 0), .5, fixed=True), utils.sphere((1.95, 0, 0), .5, fixed=True)])
    O.bodies.append(utils.sphere((.97, 0, 0), .5))
    O.engines = [w.ForceResetter(), choices.collider([w.Bo1_Sphere_Aabb()]),
                 w.InteractionLoop([w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                                   [w.Law2_ScGeom_FrictPhys_CundallStrack()]), w.NewtonIntegrator(damping=0)]
    O.dt = 1e-3
    return O.bodies[2]


def place(body):
    return body.state.pos[0]


def faulty(choices, fault):
    """A block, with a fault."""
    fe = block(choices)
    if fault == 'sentence':
        raise ValueError('this choice makes no sense.')
    if fault == 'bug':
        return nowhere  # noqa: F821
    if fault == 'crash':
        os.abort()
    if fault == 'sleep':
        time.sleep(60)
    if fault == 'step':
        O.dt = 0
    return fault if fault == 'nan' else fe


def odd(choices):
    """The fault that the setting names."""
    return faulty(choices, choices['fault'])


def oddWay(built):
    return math.nan if built == 'nan' else way(built)


def brittle(choices):
    """A body of a material that may crack."""
    fe = choices.solver()
    material = choices.material(young=1e9, poisson=.2, density=1000, frictionAngle=0,
                                tensileStrength=1e6, fractureEnergy=choices.get('energy', 1e6))
    fe.addTriangles(*rectangleMesh((0, 0), (1, 1), 1, 1), material=material, smooth=choices.smooth())
    choices.engines(fe)
    return material


def kind(material):
    """0: does not crack; 1: at once; 2: cohesively."""
    energy = getattr(material, 'fractureEnergy', 0)
    return float(isinstance(material, w.BrittleFEMat)) + (energy > 0)


DURATION = .02  # s


def flight(choices):
    """A block; its value is drawn from the seed, about the strength."""
    choices.size(1.)
    fe = block(choices)
    return fe, choices['seed'], choices.get('strength', 5.)


def draw(built):
    """As many positive numbers as the seed."""
    _, seed, strength = built
    random.seed(seed)
    return [random.lognormvariate(0, .3) * strength for _ in range(3 + seed % 3)]


def oddSeed(choices):
    """Seed 1 crashes, 2 is refused, 3 takes too long, 4 measures nothing."""
    seed = choices['seed']
    faulty(choices, {1: 'crash', 2: 'sentence', 3: 'sleep'}.get(seed))
    return seed


def seedValue(seed):
    return float('nan') if seed == 4 else seed


def warned(choices):
    """All but seed 2 warn of a number; all of the same thing."""
    seed = choices['seed']
    block(choices)
    if seed != 2:
        warnings.warn('no such size, %d' % seed)
    for _ in range(2):
        warnings.warn('bodies lie')
    warnings.warn('old', DeprecationWarning)
    return seed


def counted(choices):
    """Leaves a line in a file for each run that is really done."""
    block(choices)
    with open(os.environ['YADEFRAG_COUNT'], 'a') as out:
        out.write('%d\n' % choices['seed'])
    return choices['seed']


def same(seed):
    return seed + O.time
