"""YADE's MPI engine, yade.mpy: finds our colliders, refuses scenes that it cannot split, and completes what it lacks
for those that it splits: clumps, bodies that scripts insert or erase while it runs, periodic cells.

Functions with an @instead take the place of YADE's, and get YADE's module and function first.

In a periodic scene YADE's box around the bodies of a process is wrong as soon as one is outside of the cell's first
period, and its collider accepts no box of more than half the cell. Each process therefore gets a copy of every body of
the others. The cell is not sent after the split: all processes must change it in the same way.

The name of this file is that of YADE's: mpirun lets its workers run the script of the innermost frame
that is in no file of that name.
"""

import builtins
import contextlib
import functools
import importlib.abc
import importlib.util
import sys
from collections.abc import Callable
from typing import Any

from yade import wrapper

kModule = 'yade.mpy'
kInEachProcess = "O.splitted and sys.modules['yade.mpy'].checkAndCollide()"
_known: set[int] = set()  # bodies of this process at the last search
_completed = {}  # {name of a function of YADE's module: ours, of the module and that function before its arguments}


def instead(function: Callable) -> Callable:
    """Decorator: the function, without the _ of its name, takes the place of YADE's."""
    _completed[function.__name__[1:]] = function
    return function


def ourCollider() -> Any:
    """The first of our colliders in O.engines, or None."""
    ours = wrapper.LebesgueCollider, wrapper.LinearCodeCollider, wrapper.HierarchyCollider
    return next((e for e in wrapper.Omega().engines if isinstance(e, ours)), None)


def _omega() -> Any:
    return getattr(builtins, 'O')  # mpy stores attributes in this object, not in its class


def _exists(id):
    bodies = wrapper.Omega().bodies
    return 0 <= id < len(bodies) and bodies[id] is not None


def keepClumpsWhole() -> None:
    """YADE's decomposition assigns members by their own position. Only the master calls it."""
    from yade import bisectionDecomposition
    decomposition: Any = bisectionDecomposition.decompBodiesSerial
    yades = decomposition.partitionDomain
    if hasattr(yades, '__wrapped__'):
        return

    @functools.wraps(yades)
    def partition(self, *arguments):
        yades(self, *arguments)
        bodies = wrapper.Omega().bodies
        for body in bodies:
            if body.isClumpMember:
                body.subdomain = bodies[body.clumpId].subdomain
    decomposition.partitionDomain = partition


def _enlarge(size):
    """YADE accesses ids that other processes have inserted without a check."""
    bodies = wrapper.Omega().bodies
    if len(bodies) < size:
        bodies.insertAtId(wrapper.Body(), size - 1)
        bodies.erase(size - 1)


def _listOwn(mpy):
    """YADE's method does nothing in the master."""
    subdomain = _omega().subD
    subdomain.updateLocalIds(True)
    if mpy.rank == 0:
        subdomain.ids = [b.id for b in wrapper.Omega().bodies if b.subdomain == 0 and not b.isSubdomain]


def _takeInserted(mpy):
    """All processes call this together. YADE leaves bodies that were inserted out of the box around
    this process's bodies, and out of the merged scene."""
    _listOwn(mpy)
    own = set(_omega().subD.ids)
    new = sorted(own - _known)
    sizes, inserted, unassigned = zip(*mpy.comm.allgather(
        (len(wrapper.Omega().bodies), new, _movedByTheMaster(mpy, new))))
    if any(unassigned):
        raise RuntimeError('Body #%d was inserted without body.subdomain, the process of yade.mpy that '
                           'moves it.' % min(unassigned[0]))
    _enlarge(max(sizes))
    if any(inserted):
        _refuseTwins(mpy, own, inserted)
    _known.clear()
    _known.update(own)


def _movedByTheMaster(mpy, new):
    """The other processes would not know where these are."""
    if mpy.rank > 0 or mpy.MASTER_UPDATE_STATES or not _omega().splitted:
        return []
    return [id for id in new if wrapper.Omega().bodies[id].dynamic]


def _refuseTwins(mpy, own, inserted):
    """YADE would take one for a copy of the other."""
    others = (ids for rank, ids in enumerate(inserted) if rank != mpy.rank)
    twins = [id for found in mpy.comm.allgather([id for ids in others for id in ids if id in own]) for id in found]
    if twins:
        raise RuntimeError('Two processes of yade.mpy have inserted different bodies with the number %d.' % min(twins))


def _releaseCopies():
    """Copies of other processes' bodies are here without their clump, which YADE needs to erase a
    member."""
    bodies = wrapper.Omega().bodies
    for ids in _omega().subD.mirrorIntersections:
        for body in (bodies[id] for id in ids if _exists(id)):
            if body.isClumpMember and not _exists(body.clumpId):
                body.updateAttrs({'clumpId': -1})


@instead
def _parallelCollide(mpy, yades):
    if not _omega().splitted:
        _known.clear()
    _takeInserted(mpy)
    yades()
    _releaseCopies()


@instead
def _bodyErase(mpy, yades, ids):
    if not mpy.numThreads or mpy.numThreads == 1:
        return yades(ids)
    _enlarge(1 + (max(ids, default=-1) if isinstance(ids, list) else ids))
    _listOwn(mpy)
    erased = yades(ids)
    _listOwn(mpy)  # a clump is erased with its last member
    return erased


@instead
def _migrateBodies(mpy, yades, ids, origin, destination):
    """Clumps remain in their process: the filter chooses single members."""
    if mpy.rank == origin:
        bodies = wrapper.Omega().bodies
        ids = [id for id in ids if bodies[id].isStandalone]
    yades(ids, origin, destination)


@contextlib.contextmanager
def _clumpsWithMaterial(mpy):
    """YADE replaces the material of each body that the master receives, but a clump has none."""
    bodies = wrapper.Omega().bodies
    lent = [b.id for b in bodies if b.isClump and b.subdomain == mpy.rank and b.material is None]
    for id in lent:
        bodies[id].material = bodies[min(bodies[id].shape.members)].material
    allLent = mpy.comm.allgather(lent)
    try:
        yield
    finally:
        for id in (id for ids in allLent for id in ids if _exists(id)):
            bodies[id].material = None


@instead
def _mergeScene(mpy, yades):
    if mpy.rank == 0 and mpy.waitingCommands:
        mpy.sendCommand('slaves', 'mergeScene()', False)
    if not _omega().splitted:
        return
    _takeInserted(mpy)
    waiting, mpy.waitingCommands = mpy.waitingCommands, False  # the master has sent its command already
    try:
        with _clumpsWithMaterial(mpy):
            if _isPeriodic():
                _checkCell(mpy)
            yades()
    finally:
        mpy.waitingCommands = waiting


def _isPeriodic():
    return wrapper.Omega().periodic and ourCollider() is not None


def _checkCell(mpy):
    """All processes call this together."""
    cells = mpy.comm.allgather([list(row) for row in wrapper.Omega().cell.hSize])
    if any(cell != cells[0] for cell in cells):
        raise RuntimeError('The periodic cell is not the same in all processes of yade.mpy: change it in '
                           'all of them, and not by what one of them knows, such as its contacts.')


@instead
def _updateDomainBounds(mpy, yades, subdomains):
    """Our colliders ignore a process whose box is empty."""
    yades(subdomains)
    if _isPeriodic():
        _checkCell(mpy)
        for shape in (wrapper.Omega().bodies[id].shape for id in subdomains):
            shape.boundsMin, shape.boundsMax = 3 * [float('inf')], 3 * [-float('inf')]


@instead
def _genLocalIntersections(mpy, yades, subdomains):
    """Ids of bodies whose states are sent, by process; in place of this one: the processes to which."""
    if not _isPeriodic():
        return yades(subdomains)
    own = [b.id for b in wrapper.Omega().bodies if b.bounded and b.subdomain == mpy.rank and not b.isSubdomain]
    others = [rank for rank in range(1, mpy.numThreads) if rank != mpy.rank]
    lists = [own if rank in others else [] for rank in range(mpy.numThreads)]
    lists[mpy.rank] = others if own or mpy.rank > 0 else []
    return lists


def searchTogether(mpy: Any) -> None:
    """Before a run of a scene that is split: a body may have been inserted by one process, whose
    collider would search alone. A worker that executes the master's command was asked before."""
    if mpy.waitingCommands:
        if mpy.rank > 0:
            return
        mpy.sendCommand('slaves', 'checkAndCollide()', False)
    mpy.checkAndCollide()


def searchBeforeTheCollider(mpy: Any, collider: Any) -> None:
    """mpy asks all processes for a search at the end of a step only: after the engines that insert
    bodies, unless they stand before the collider, which would then search alone."""
    omega = _omega()
    engines = omega.engines
    at = engines.index(collider)
    mayInsert = any(isinstance(e, wrapper.PyRunner) for e in engines[:at])
    if mpy.comm.allreduce(mayInsert, op=mpy.MPI.LOR):
        asks = wrapper.PyRunner(iterPeriod=1, initRun=True, command=kInEachProcess)
        omega.engines = omega.splittedEngines = [*engines[:at], asks, *engines[at:]]


def checkMerged(mpy: Any) -> None:
    """Before a merged scene is split again: YADE drops bodies that only the master has inserted. All
    processes call this together."""
    if mpy.DOMAIN_DECOMPOSITION and mpy.RESET_SUBDOMAINS_WHEN_COLLIDE:
        return  # YADE distributes all bodies anew
    owners = {b.id: b.subdomain for b in wrapper.Omega().bodies
              if not b.isSubdomain and b.subdomain != 0 and mpy.rank in (0, b.subdomain)}
    inMaster, *others = mpy.comm.allgather(owners)
    inOthers = {id: rank for one in others for id, rank in one.items()}
    different = inMaster.items() ^ inOthers.items()
    if different:
        raise RuntimeError('Body #%d is not the same in the merged scene and in the process that owns it: '
                           'insert bodies in all processes, erase them by yade.mpy.bodyErase, and keep '
                           'their subdomain.' % min(different)[0])


def complete(mpy: Any) -> None:
    for name, function in _completed.items():
        yades = getattr(mpy, name)
        setattr(mpy, name, functools.wraps(yades)(functools.partial(function, mpy, yades)))


# --- the split itself

def reasonNotToSplit() -> str | None:
    """One sentence, or None if this process's scene can be split."""
    omega = wrapper.Omega()
    if any(isinstance(e, wrapper.FESolver) for e in omega.engines) or \
            any(body is not None and isinstance(body.shape, wrapper.SurfaceSegment) for body in omega.bodies):
        return ('FESolver and its bodies work in one process only: yade.mpy cannot split this '
                'scene; run it with O.run.')
    collider = ourCollider()
    if collider is None:
        return None  # YADE's own collider fails in the scenes below, too: that is left to it
    name = type(collider).__name__
    if collider.label != 'collider':
        return ("yade.mpy finds its collider by the label 'collider', but this one has %s: write "
                "%s([...], label='collider')."
                % ("the label '%s'" % collider.label if collider.label else 'no label', name))
    for one in (one for one in omega.engines if not one.dead):
        if omega.periodic and isinstance(one, wrapper.BoundaryController):
            return ('%s would move the cell by the contacts of one process of yade.mpy only: run this scene with '
                    'O.run.' % type(one).__name__)
        if isinstance(one, wrapper.SpheresFactory):
            return ('%s would insert other bodies in each process of yade.mpy: insert them by a PyRunner that '
                    'does the same in all.' % type(one).__name__)
    return None


def _reasonOfClumps(mpy):
    """The master's decomposition makes clumps whole."""
    if mpy.DOMAIN_DECOMPOSITION or ourCollider() is None:
        return None
    bodies = wrapper.Omega().bodies
    for body in bodies:
        if body.isClumpMember and (not _exists(body.clumpId) or bodies[body.clumpId].subdomain != body.subdomain):
            return ('Clump #%d and its members belong to different processes of yade.mpy: give them the same '
                    'body.subdomain.' % body.clumpId)
    return None


def _shareVerletDist(reports):
    """A negative verletDist is a multiple of the smallest radius: that of all processes, since each
    alone would get another length, and bounds of one body must be the same in all."""
    collider, least = ourCollider(), min(radius for _, radius in reports)
    if collider is not None and collider.verletDist < 0 and least < float('inf'):
        collider.verletDist *= -least


def _refuseTogether(reasons):
    for reason in reasons:
        if reason:
            raise RuntimeError(reason)


@instead
def _splitScene(mpy, yades):
    """All processes split together: all refuse, or none."""
    if _omega().splittedOnce:
        checkMerged(mpy)
        yades()
        mpy.checkAndCollide()
        return
    radii = (b.shape.radius for b in wrapper.Omega().bodies if isinstance(b.shape, wrapper.Sphere))
    reports = mpy.comm.allgather((reasonNotToSplit() or _reasonOfClumps(mpy), min(radii, default=float('inf'))))
    _refuseTogether(reason for reason, _ in reports)
    _shareVerletDist(reports)
    if mpy.DOMAIN_DECOMPOSITION and mpy.rank == 0:
        keepClumpsWhole()
    yades()
    if ourCollider() is not None:
        searchBeforeTheCollider(mpy, ourCollider())


@instead
def _mpirun(mpy, yades, nSteps, np=None, withMerge=False):
    """Refuses before mpirun starts processes, or sends them a command to run."""
    wanted = mpy.numThreads if np is None else np
    isAlone = mpy.comm is None or mpy.numThreads == 1 or mpy.waitingCommands
    if mpy.rank == 0 and isAlone and wanted != 1:
        _refuseTogether([reasonNotToSplit() or _reasonOfClumps(mpy)])
    if _omega().splitted and wanted == mpy.numThreads != 1:
        searchTogether(mpy)
    return yades(nSteps, np, withMerge)


class _WhenImported(importlib.abc.MetaPathFinder):
    """Adapts yade.mpy after its import; we do not import it, since that starts MPI."""

    def find_spec(self, name, path=None, target=None):
        if name != kModule:
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        if spec is not None:
            loader: Any = spec.loader
            execute = loader.exec_module

            def executeAndAdapt(module):
                execute(module)
                complete(module)
            loader.exec_module = executeAndAdapt
        return spec


def install() -> None:
    if kModule in sys.modules:
        complete(sys.modules[kModule])
    else:
        sys.meta_path.insert(0, _WhenImported())
