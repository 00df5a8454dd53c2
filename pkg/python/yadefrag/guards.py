"""What must not happen to the bodies of an FESolver, and when: refused in one sentence."""

import sys
import threading

from yade import wrapper
from yadefrag.values import whole


def requirePaused():
    """The step of another thread must not meet a scene that changes. PyRunners are in its own."""
    if wrapper.Omega().running and threading.current_thread() is threading.main_thread():
        raise RuntimeError('The simulation is running: call O.pause() and O.wait() first, or do '
                           'this from a PyRunner.')


def requireNoStep(what):
    """A run within a step would wait for the end of that step, which waits for the run."""
    omega = wrapper.Omega()
    # After a step that an exception ended, subStep is as within one; only there a PyRunner's
    # command is on the stack.
    if omega.subStep >= 0 and '<string>' in _filesOfStack():
        raise RuntimeError('%s runs the scene: it cannot be called within a step, as from a '
                           'PyRunner.' % what)
    requirePaused()


def _filesOfStack():
    frame = sys._getframe()
    while frame:
        yield frame.f_code.co_filename
        frame = frame.f_back


def _pieceOf(body):
    """The shape of a body that is part of a boundary; None for any other."""
    shape = body.shape if body else None
    return shape if isinstance(shape, wrapper.SurfaceSegment) and shape.entry >= 0 else None


def guardErase(erase):
    """O.bodies.erase that leaves single pieces of a boundary alone."""
    def guarded(self, id, eraseClumpMembers=False):
        piece = _pieceOf(self[id]) if 0 <= id < len(self) else None
        if piece:
            raise ValueError(
                'body #%d is part of the boundary of body %d of FESolver, it cannot be erased '
                'alone; FESolver.removeBody(%d) takes the whole away.' %
                (id, piece.component, piece.component))
        return erase(self, id, eraseClumpMembers)

    guarded.__doc__ = erase.__doc__
    return guarded


def guardClump(clump):
    """O.bodies.clump and addToClump without pieces of a boundary: YADE would end the process."""
    def guarded(self, ids, *others, **settings):
        for id in ids if isinstance(ids, (list, tuple)) else [ids]:
            piece = _pieceOf(self[id]) if isinstance(id, int) and 0 <= id < len(self) else None
            if piece:
                raise ValueError('body #%d is part of the boundary of body %d of FESolver, it '
                                 'cannot be in a clump.' % (id, piece.component))
        return clump(self, ids, *others, **settings)

    guarded.__doc__ = clump.__doc__
    return guarded


def guardRemove(remove):
    """FESolver.removeBody that says what is wrong with a number."""
    def guarded(self, component):
        requirePaused()
        return remove(self, whole('component', component, -2**31, 'the number of a body'))

    guarded.__doc__ = remove.__doc__
    return guarded
