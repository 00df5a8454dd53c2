"""YADE's MPI engine, yade.mpy: finds our colliders, and refuses scenes that it cannot split. Scenes that
are split are in split_scene.py.

The name of this file is that of YADE's: mpirun lets its workers run the script of the innermost frame
that is in no file of that name.
"""

import builtins
import importlib.abc
import importlib.util
import sys
from typing import Any

from yade import wrapper
from yadefrag.scene import split_scene
from yadefrag.scene.split_scene import complete, instead, ourCollider

kModule = 'yade.mpy'


def _isPiece(body):
    return body is not None and isinstance(body.shape, wrapper.SurfaceSegment)


def reasonNotToSplit() -> str | None:
    """One sentence, or None if this process's scene can be split."""
    omega = wrapper.Omega()
    if any(isinstance(e, wrapper.FESolver) for e in omega.engines) or any(map(_isPiece, omega.bodies)):
        return ('FESolver and its bodies work in one process only: yade.mpy cannot split this '
                'scene; run it with O.run.')
    return _reasonOf(ourCollider(), omega)


def _reasonOf(collider, omega):
    """YADE's own collider fails in these scenes, too: that is left to it."""
    if collider is None:
        return None
    name = type(collider).__name__
    if collider.label != 'collider':
        return ("yade.mpy finds its collider by the label 'collider', but this one has %s: write "
                "%s([...], label='collider')."
                % ("the label '%s'" % collider.label if collider.label else 'no label', name))
    controller = split_scene.controller()
    if controller is not None:
        return ('%s would move the cell by the contacts of one process of yade.mpy only: run this scene with '
                'O.run.' % type(controller).__name__)
    factory = next((e for e in omega.engines if isinstance(e, wrapper.SpheresFactory) and not e.dead), None)
    if factory is not None:
        return ('%s would insert other bodies in each process of yade.mpy: insert them by a PyRunner that '
                'does the same in all.' % type(factory).__name__)
    return None


def _reasonOfClumps(mpy):
    """The master's decomposition makes clumps whole."""
    divided = None if mpy.DOMAIN_DECOMPOSITION or ourCollider() is None else split_scene.dividedClump()
    if divided is None:
        return None
    return ('Clump #%d and its members belong to different processes of yade.mpy: give them the same '
            'body.subdomain.' % divided)


def _smallestRadius():
    radii = (b.shape.radius for b in wrapper.Omega().bodies if isinstance(b.shape, wrapper.Sphere))
    return min(radii, default=float('inf'))


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
    omega: Any = getattr(builtins, 'O')  # splittedOnce is an attribute of this object, not of the class
    if omega.splittedOnce:
        split_scene.checkMerged(mpy)
        yades()
        mpy.checkAndCollide()
        return
    reports = mpy.comm.allgather((reasonNotToSplit() or _reasonOfClumps(mpy), _smallestRadius()))
    _refuseTogether(reason for reason, _ in reports)
    _shareVerletDist(reports)
    if mpy.DOMAIN_DECOMPOSITION and mpy.rank == 0:
        split_scene.keepClumpsWhole()
    yades()
    if ourCollider() is not None:
        split_scene.searchBeforeTheCollider(mpy, ourCollider())


@instead
def _mpirun(mpy, yades, nSteps, np=None, withMerge=False):
    """Refuses before mpirun starts processes, or sends them a command to run."""
    wanted = mpy.numThreads if np is None else np
    isAlone = mpy.comm is None or mpy.numThreads == 1 or mpy.waitingCommands
    if mpy.rank == 0 and isAlone and wanted != 1:
        _refuseTogether([reasonNotToSplit() or _reasonOfClumps(mpy)])
    if getattr(builtins, 'O').splitted and wanted == mpy.numThreads != 1:
        split_scene.searchTogether(mpy)
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
