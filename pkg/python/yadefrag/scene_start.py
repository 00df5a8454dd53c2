"""A message about FE bodies in a scene whose engines do not include their FESolver: it has no step of
its own in which it could give one."""

import weakref

from yade import wrapper
from yadefrag.messages import warn

_SENTENCE = ('O.engines has no FESolver, so that nothing moves its bodies: O.engines = engines(fe) sets the '
             'engines.')

solvers = weakref.WeakSet()  # with bodies
_looked = None  # scene and number of its bodies when they were last searched


def addSolver(solver):
    """Must be called for every solver to which a body is added."""
    solvers.add(solver)


def _isWithoutSolver():
    """True, once for each scene and number of bodies, if there are FE bodies and no engine moves them."""
    global _looked
    if not solvers:
        return False
    omega = wrapper.Omega()
    if any(isinstance(one, (wrapper.FESolver, wrapper.ParallelEngine)) for one in omega.engines):
        return False
    present = omega.tags['id'], len(omega.bodies)
    if present == _looked:
        return False
    _looked = present
    return any(isinstance(body.shape, wrapper.SurfaceSegment) and body.shape.component >= 0
               for body in omega.bodies)


def tell():
    """Before a run: a warning, which is also in the `warnings` of all solvers with bodies."""
    if not _isWithoutSolver():
        return
    for solver in solvers:
        solver._note(_SENTENCE)
    warn(_SENTENCE)
