"""Scenes for test_lifecycle.py: `yade -jN threads_scene.py COLLIDER SCENE...` prints a line of JSON with the bits of each."""
import hashlib
import json
import os
import sys

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', 'helpers')]

import numpy as np

import scenes
import yadefrag  # noqa: F401  adds CurveLoop
from scenes import O, packing, w
from yade import utils
from yade.minieigenHP import Vector3


def gas(collider, kind):
    """1500 moving spheres in a unit box; `mixed` adds facets, a box and a wall. Bodies come and go."""
    rng = np.random.default_rng(1)
    if kind == 'periodic':
        O.periodic = True
        O.cell.hSize = scenes.matrix(np.eye(3))
    n = 1500
    scenes.addSpheres(rng.uniform(0, 1, (n, 3)), rng.uniform(.015, .03, n), rng.normal(size=(n, 3)) * .002)
    if kind == 'mixed':
        for _ in range(60):
            corner = rng.uniform(0, 1, 3)
            O.bodies.append(utils.facet(
                [Vector3(*(corner + rng.uniform(-.1, .1, 3))) for _ in range(3)]))
        O.bodies.append(utils.box((.5, .5, 0), (1, 1, .02), fixed=True))
        O.bodies.append(utils.wall(1, axis=1))
    O.dt = 1
    scenes.setEngines(collider)
    for number, steps in enumerate((1, 1, 8, 10), 1):
        O.run(steps, True)
        yield moment()
        for k in range(40):
            O.bodies.erase(int(k * 31 + number))
        scenes.addSpheres(np.random.default_rng(number).uniform(0, 1, (40, 3)), [.02] * 40)


def stirred(collider, kind):
    """CurveLoop: contacts go and come, and so do bodies, for which rows are made."""
    materials = dict(viscoelastic=w.ViscElMat(kn=1e7, ks=5e6, cn=3e4, cs=2e4, mR=.1, density=2000),
                     cohesive=w.CohFrictMat(young=1e7, density=2000, normalCohesion=1e5, shearCohesion=1e5,
                                            momentRotationLaw=True))
    packing((12, 12, 8), .97, 1e-4, isTurning=True, material=materials.get(kind))
    spheres = w.Ig2_Sphere_Sphere_ScGeom()
    if kind == 'mindlin':
        functors = [w.Ip2_FrictMat_FrictMat_MindlinPhys(en=.5, gamma=3e3, krot=4e3, ktwist=2e3, eta=.02)], \
            [w.Law2_ScGeom_MindlinPhys_Mindlin(includeAdhesion=True, includeMoment=True)]
    elif kind == 'viscoelastic':
        functors = [w.Ip2_ViscElMat_ViscElMat_ViscElPhys()], [w.Law2_ScGeom_ViscElPhys_Basic()]
    elif kind == 'cohesive':
        spheres = w.Ig2_Sphere_Sphere_ScGeom6D()
        functors = [w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)], \
            [w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]
    else:
        functors = [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack(traceEnergy=True)]
    loop = w.CurveLoop([spheres], *functors)
    scenes.setEngines(collider, interactionLoop=loop)
    for number, steps in enumerate((1, 1, 60, 60), 1):
        O.run(steps, True)
        assert loop.threads == O.numThreads and loop.fastForces == O.interactions.countReal()
        yield moment(hasForces=True) | dict(O.energy.items(), lost=str(getattr(functors[1][0], 'plasticDissipation', str)()))
        O.bodies.erase(5 * steps)
        scenes.addSpheres([(6, 6, 10 + 2 * number)], [.5], dynamic=True)


def falling(_, integrator):
    """Without contacts, with YADE's integrator or ours."""
    packing((12, 12, 16), 1.2, 1e-3, isTurning=True)
    O.engines = [w.ForceResetter(), getattr(w, integrator)(gravity=(0, 0, -9), damping=.2)]
    O.run(100, True)
    yield moment()


def moment(hasForces=False):
    """Forces are summed in the order of threads by YADE's own loop."""
    interactions = [(i.id1, i.id2, i.isReal, *i.cellDist) for i in O.interactions.all()]
    rows = [[*b.state.pos, *b.state.vel, *b.state.angVel, *b.state.ori,
             *(hasForces and [*O.forces.f(b.id), *O.forces.t(b.id)] or [])] for b in O.bodies if b]
    return dict(interactions=len(interactions), contacts=O.interactions.countReal(), bits=hashlib.sha256(
        repr(interactions).encode() + np.array(rows, float).tobytes()).hexdigest())


kScenes = dict(gas=gas, mixed=gas, periodic=gas, stirred=stirred, mindlin=stirred, viscoelastic=stirred, cohesive=stirred,
               NewtonIntegrator=falling, CurveIntegrator=falling)

if __name__ == '__main__':
    for kind in sys.argv[2:]:
        scenes.clear()
        moments = list(kScenes[kind](scenes.makeCollider(sys.argv[1]), kind))
        print('\n@@@ ' + json.dumps(dict(threads=O.numThreads, moments=moments)), flush=True)
