"""One scene in one or more processes: `[mpiexec -n RANKS] yade -n -x mpi_scene.py COLLIDER FOLDER SCENE [ARGUMENTS]`.

SCENE is a function here, or the path of one of YADE's scripts, in which COLLIDER takes the place of
YADE's. Each process writes FOLDER/RANK.json: its bodies, the contacts of these, and what the scene
itself reports.
"""
import builtins
import contextlib
import json
import os
import random
import sys
import traceback

from yade import mpy as mp
from yade import utils
from yade import wrapper as w

import yadefrag

O = builtins.O      # mpy keeps attributes of its own in this object
kRadius = .5
kSteps = 200


class YadeCheckError(Exception):
    """The name that YADE's check scripts raise."""


def place(collider, **settings):
    """`settings` of the collider; its label is the name by which mpy finds it."""
    O.engines = [
        w.ForceResetter(),
        getattr(w, collider)([w.Bo1_Sphere_Aabb(), w.Bo1_Box_Aabb(), w.Bo1_Facet_Aabb()],
                             label='collider', **settings),
        w.InteractionLoop(
            [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Box_Sphere_ScGeom(), w.Ig2_Facet_Sphere_ScGeom()],
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


def run(steps, merge=True):
    if mp.numThreads > 1:
        mp.mpirun(steps, mp.numThreads, merge)
    else:
        O.run(steps, True)


def contactsHere():
    """[id1, id2, overlap] of real contacts with a body of this process; all in a merged scene."""
    return sorted([min(i.id1, i.id2), max(i.id1, i.id2), overlap(i)]
                  for i in O.interactions if i.isReal and (isMerged() or mp.rank in (
                      O.bodies[i.id1].subdomain, O.bodies[i.id2].subdomain)))


def overlap(contact):
    """Of two spheres; 1 m for others. (YADE does not send penetrationDepth to other processes.)"""
    one, two = O.bodies[contact.id1], O.bodies[contact.id2]
    if not (isinstance(one.shape, w.Sphere) and isinstance(two.shape, w.Sphere)):
        return 1.
    return one.shape.radius + two.shape.radius - (one.state.pos - two.state.pos).norm()


def isMerged():
    return mp.rank == 0 and not O.splitted


def bodiesHere():
    return {b.id: [*b.state.pos, *b.state.vel, *b.state.angVel] for b in O.bodies
            if b and not b.isSubdomain and (isMerged() or b.subdomain == mp.rank)}


def state():
    return dict(bodies=bodiesHere(), contacts=contactsHere())


def columnsRun():
    """The state of each process before the merge, and that of the merged scene."""
    assign(columns())
    run(kSteps, merge=False)
    apart = state()
    if mp.numThreads > 1:
        mp.mergeScene()
    return dict(apart=apart)


def gasRun():
    """With verletDist at its default, a multiple of the smallest radius."""
    assign(gas())
    run(kSteps)
    return dict(verletDist=O.engines[1].verletDist)


def spawned():
    """A script that is started in one process; mpirun starts two more, which run it, too."""
    assign(columns(), workers=2)
    mp.mpirun(kSteps, 3, True)
    return {}


def emptyRank():
    assign(columns(), workers=mp.numThreads - 2)
    run(kSteps)
    return {}


def changing():
    """Bodies change their process after each search; messages only about bodies in contact."""
    gas()
    mp.DOMAIN_DECOMPOSITION = mp.MINIMAL_INTERSECTIONS = True
    mp.REALLOCATE_FREQUENCY = 1
    run(1, merge=False)
    before = owners()
    run(kSteps - 1, merge=False)
    after = owners()
    changed = sum(after[k] != before[k] for k in after)
    if mp.numThreads > 1:
        mp.mergeScene()
    return dict(changed=changed)


def owners():
    """{id: process} of all bodies, in each process."""
    mine = {b.id: mp.rank for b in O.bodies if b and b.subdomain == mp.rank and not b.isSubdomain}
    return {k: r for one in mp.comm.allgather(mine) for k, r in one.items()}


def mergeAndSplit():
    """Three runs with a merged scene after each, bodies erased in all processes together, and a run
    of the master alone."""
    assign(columns())
    run(kSteps // 4)
    moments = [state()]
    run(kSteps // 4, merge=False)
    gone = list(range(100, 130, 3))
    mp.bodyErase(gone)
    run(kSteps // 4)
    moments.append(state())
    if mp.rank == 0:
        for body in O.bodies:
            body.subdomain = 0
        O.run(20, True)
    return dict(moments=moments, gone=gone)


def refused():
    """Scenes that mpy cannot split: `tried` for a collider without a label, and for an FESolver."""
    assign(columns())
    O.engines[1].label = ''
    report = dict(unlabelled=tried(10, None if mp.numThreads > 1 else 3))
    O.reset()
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=1000, label='m'))
    solver = w.FESolver()
    solver.addPolygon([(0, 0), (1, 0), (1, 1), (0, 1)], size=.5, material='m')
    O.engines = yadefrag.engines(solver, spheres=True)
    O.engines[1].label = 'collider'
    O.dt = .1 * solver.criticalTimeStep()
    return dict(report, elements=tried(10, None if mp.numThreads > 1 else 3))


def tried(steps, ranks):
    """Message of mpirun in this process, the scene compared with that before, a run without mpy."""
    before = sceneNow()
    message = ''
    try:
        mp.mpirun(steps, ranks, True)
    except RuntimeError as error:
        message = str(error)
    report = dict(message=message, isUnchanged=sceneNow() == before, ranks=mp.numThreads)
    O.run(2, True)
    return dict(report, steps=O.iter)


def sceneNow():
    return [len(O.bodies), O.iter, O.splitted, [type(e).__name__ for e in O.engines],
            [list(b.state.pos) for b in O.bodies], O._sceneObj.subdomain]


def yadesOwn(collider, script, arguments):
    """One of YADE's scripts, with YADE's default engines."""
    scope = dict(sys.modules['__main__'].__dict__, YadeCheckError=YadeCheckError,
                 InsertionSortCollider=getattr(w, collider))
    O.engines = [getattr(w, collider)(list(e.boundDispatcher.functors), label='collider')
                 if isinstance(e, w.InsertionSortCollider) else e for e in kDefault]
    sys.argv = [script, *arguments]
    with contextlib.suppress(SystemExit), open(script, encoding='utf-8') as file:
        exec(compile(file.read(), script, 'exec'), scope)
    return dict(isIn=[type(e).__name__ for e in O.engines if isinstance(e, w.Collider)])


def main():
    collider, folder, scene, *arguments = sys.argv[1:]
    error, more = None, {}
    try:
        if scene.endswith('.py'):
            more = yadesOwn(collider, scene, arguments)
        else:
            place(collider, verletDist=-.5 if scene in ('gasRun', 'changing') else .1)
            more = globals()[scene]()
    except BaseException:
        error = traceback.format_exc()
    result = dict(rank=mp.rank, error=error, searches=searches(), **state(), **more)
    with open(os.path.join(folder, '%d.json' % mp.rank), 'w') as out:
        json.dump(result, out)
    sys.stdout.flush()
    if error:
        mp.comm.Abort(1)    # others may wait for a message of this process
    if mp.MPI.Is_finalized():
        os._exit(0)     # yade would do so again; otherwise it ends the processes together


def searches():
    return next((e.numAction for e in O.engines if isinstance(e, w.Collider)), 0)


kDefault = list(O.engines)
main()
