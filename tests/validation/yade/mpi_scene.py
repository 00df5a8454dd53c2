"""One scene in one or more processes:
`[mpiexec -n RANKS] yade -n -x mpi_scene.py COLLIDER FOLDER SCENE [ARGUMENTS]`.

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

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from mpi_bodies import assign, clumpedGas, columns, gas, isMerged, kRadius, owners, place, run, state

O = builtins.O
kSteps = 200
kAppended = 2000


class YadeCheckError(Exception):
    """The name that YADE's check scripts raise."""


def columnsRun():
    """The state of each process before the merge, and that of the merged scene."""
    assign(columns())
    run(kSteps, merge=False)
    return merged()


def merged():
    """The state of each process before the merge."""
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


def mergeAndSplit():
    """Three runs with a merged scene after each, bodies erased in all processes together, and a run
    of the master alone. A scene that only the master has changed cannot be split again."""
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
    return dict(moments=moments, gone=gone, message=messageOf(1, None) if mp.numThreads > 1 else '')


def clumps():
    """Clumps of two and three spheres and single spheres that fly through a box. The processes are chosen
    by mpy. Members, whole clumps and single spheres are erased, in a split and in a merged scene."""
    whole = clumpedGas()
    mp.DOMAIN_DECOMPOSITION = True
    mp.REALLOCATE_FREQUENCY = 1
    run(60, merge=False)
    before = owners()
    mp.bodyErase([body for made in whole[::9] for body in made])
    run(60)
    mp.bodyErase([clump[0] for clump in whole[4::9] if len(clump) > 2])
    run(80, merge=False)
    after = owners()
    report = dict(merged(), changed=sum(after[k] != before[k] for k in after))
    return dict(report, divided=sum(b.subdomain != O.bodies[b.clumpId].subdomain
                                    for b in O.bodies if isMerged() and b.isClumpMember),
                materials=sum(b.material is not None for b in O.bodies if b.isClump))


def inserted():
    """Bodies are inserted and erased by engines before the collider and after the integrator, between
    two runs and in a merged scene."""
    assign(columns())
    O.engines = [w.PyRunner(iterPeriod=20, command='dropAll()'), *O.engines,
                 w.PyRunner(iterPeriod=20, command='dropClumps(); dropOwn(); eraseSome()')]
    run(1, merge=False)
    reserve()
    for merge in (False, True, False):
        run(60, merge=merge)
        dropAll()
    run(19, merge=False)
    return merged()


def reserve():
    """Bodies that are appended from now on have the same ids in any number of processes."""
    O.bodies.insertAtId(w.Body(), kAppended - 1)
    O.bodies.erase(kAppended - 1)


def processOf(x, width=24):
    """As assign()."""
    return 1 + min(mp.numThreads - 2, int(x / width * (mp.numThreads - 1))) if mp.numThreads > 1 else 0


def drop(balls, velocity, ids=None):
    """One ball, or several as a clump; with the next ids, or `ids`."""
    ids = [O.bodies.insertAtId(*one) for one in zip(balls, ids)] if ids else O.bodies.append(balls)
    if len(ids) > 1:
        ids.append(O.bodies.clump(ids))
    for k in ids:
        O.bodies[k].subdomain = processOf(O.bodies[ids[-1]].state.pos[0])
    O.bodies[ids[-1]].state.vel = velocity


def dropAll():
    """Spheres that touch those below at once, from all processes; all insert them."""
    for i in range(8):
        drop([utils.sphere((3 * i + .7, 10.35 + O.iter / 20, .1), kRadius)], (0, -9, 0))


def dropClumps():
    for i in range(4):
        drop([utils.sphere((5 * i + 2.2 + .6 * m, 10.8 + O.iter / 20, 0), .4) for m in (0, 1)], (0, -12, 0))


def dropOwn():
    """Only the process to which a body belongs inserts it, by a number that no other body has."""
    for i in range(6):
        x = 4 * i + 1.9
        if mp.rank == processOf(x):
            drop([utils.sphere((x, 10.7 + O.iter / 20, .2), kRadius)], (0, -12, 0), [1000 + 4 * O.iter + i])


def eraseSome():
    """Bodies of all processes, some of which are not there any more."""
    mp.bodyErase([*range(O.iter // 20, 240, 29), kAppended + O.iter // 40])


def periodic():
    """Spheres and clumps that leave a cell through all of its sides while it is sheared and compressed;
    bodies are inserted and erased, change their process, are merged and split."""
    chance = random.Random(3)
    O.periodic = True
    O.cell.setBox(10, 5, 5)
    for i in range(10):
        for j in range(5):
            for k in range(5):
                at = [n + .5 + chance.uniform(-.03, .03) for n in (i, j, k)]
                O.bodies.append(utils.sphere(at, .45 * chance.uniform(.8, 1.1)))
                O.bodies[-1].state.vel = [chance.uniform(-9, 9) for _ in range(3)]
    for clump in ([i * 25, i * 25 + 5] for i in range(10)):
        O.bodies[O.bodies.clump(clump)].state.vel = (-7, 5, 3)
    O.cell.velGrad = ((-.2, .5, 0), (0, -.2, 0), (0, 0, 0))
    O.dt = 1e-3
    for body in O.bodies:
        lead = O.bodies[body.clumpId] if body.isClumpMember else body
        body.subdomain = processOf(lead.state.pos[0], 10)
    mp.REALLOCATE_FREQUENCY = 1
    O.engines = [*O.engines, w.PyRunner(iterPeriod=20, command='dropInCell(); eraseSome()')]
    run(1, merge=False)
    reserve()
    for merge in (False, True, False):
        run(40, merge=merge)
    return dict(merged(), cell=[list(row) for row in O.cell.hSize])


def dropInCell():
    for i in range(4):
        drop([utils.sphere((3 * i + .2, 5.1 + O.iter / 20, 12), .3)], (3, -9, 5))


def contradicting():
    """All processes insert a body without a subdomain, two insert different bodies with one number, and one
    changes the cell."""
    O.periodic = True
    O.cell.setBox(100, 100, 100)
    assign(columns())
    O.bodies.erase(240)  # the plate
    run(2, merge=False)
    O.bodies.append(utils.sphere((50, 50, 50), kRadius))
    report = dict(unassigned=messageOf(2, None))
    O.bodies.erase(len(O.bodies) - 1)
    if mp.rank > 0:
        ball = utils.sphere((mp.rank, 50, 50), kRadius)
        ball.subdomain = mp.rank
        O.bodies.insertAtId(ball, 500)
    report['twins'] = messageOf(2, None)
    mp.bodyErase(500)
    if mp.rank == 1:
        O.cell.velGrad = ((.1, 0, 0), (0, 0, 0), (0, 0, 0))
    return dict(report, cell=messageOf(100, None))


def refused():
    """Scenes that mpy cannot split: what `tried` reports, by the name of the case."""
    ranks = None if mp.numThreads > 1 else 3
    cases = dict(unlabelled=unlabelled, elements=elements, divided=divided, factory=factory, controller=controller)
    report = {}
    for name, make in cases.items():
        O.reset()
        place('LebesgueCollider', verletDist=.1)
        make()
        report[name] = tried(10, ranks)
    return report


def unlabelled():
    assign(columns())
    O.engines[1].label = ''


def elements():
    O.reset()
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=1000, label='m'))
    solver = w.FESolver()
    solver.addPolygon([(0, 0), (1, 0), (1, 1), (0, 1)], size=.5, material='m')
    O.engines = yadefrag.engines(solver, spheres=True)
    O.engines[1].label = 'collider'
    O.dt = .1 * solver.criticalTimeStep()


def divided():
    assign(columns(), workers=2)
    O.bodies.clump([0, 239])


def factory():
    assign(columns())
    O.engines = [*O.engines, w.BoxFactory(maxParticles=1, extents=(8, .4, .4), center=(12, 14, 0), vMin=5, vMax=5,
                                          rMin=.3, rMax=.3, normal=(0, -1, 0), massFlowRate=1, materialId=0)]


def controller():
    O.periodic = True
    O.cell.setBox(200, 200, 200)
    assign(columns())
    O.engines = [*O.engines, w.PeriTriaxController(goal=(-1e3, -1e3, -1e3), stressMask=7)]


def tried(steps, ranks):
    """Message of mpirun in this process, the scene compared with that before, a run without mpy."""
    before = sceneNow()
    message = messageOf(steps, ranks)
    report = dict(message=message, isUnchanged=sceneNow() == before, ranks=mp.numThreads)
    O.run(2, True)
    return dict(report, steps=O.iter)


def messageOf(steps, ranks):
    try:
        mp.mpirun(steps, ranks, True)
    except RuntimeError as error:
        return str(error)
    return ''


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
