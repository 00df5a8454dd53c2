"""Contents of an FESolver: its bodies, by number or by name, and for pictures and files everything except removed
fragments; what is done between two steps only: reads of one state, and changes.

Functions of a script that FESolver calls within its step must not do any of these.
"""

import contextlib
import functools
import threading
from collections.abc import Callable, Iterator
from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag.arguments import FESolver, isWhole, refuse, shown, text, whole

_calls = threading.local()
_LONGEST = 80  # characters of a name


def calledInStep(function: Callable) -> Callable:
    """`function`, during which bodies, bonds, motions and loads cannot be changed: the step has begun with
    them."""
    @functools.wraps(function)
    def called(*arguments):
        _calls.now = True
        try:
            return function(*arguments)
        finally:
            _calls.now = False
    return called


def requireBetweenSteps() -> None:
    """RuntimeError in a function that a step calls, and while another thread runs the scene."""
    if getattr(_calls, 'now', False):
        raise RuntimeError('bodies, bonds, motions and loads of FESolver change between steps only, not in a '
                           'function that was given to prescribe or pressure; do it in a PyRunner.')
    _yadefrag.requirePaused()


@contextlib.contextmanager
def betweenSteps(fe: FESolver) -> Iterator[None]:
    """Prevents steps of another thread: all reads in the block are of one state.

    Blocks of one thread may be nested. The block must not wait for the run.
    """
    fe._lock()
    try:
        yield
    finally:
        fe._unlock()


def requireSolver(fe: FESolver) -> None:
    """ValueError unless `fe` is an FESolver."""
    if not hasattr(fe, 'triangles'):
        refuse('fe', fe, 'an FESolver')


def shownTriangles(fe: FESolver) -> numpy.ndarray:
    """Numbers (k) of the triangles that were not removed. Must be called between two steps."""
    if fe.dropped['count'] == 0:
        return numpy.arange(len(fe.triangles))
    return numpy.nonzero(fe.fragmentOf >= 0)[0]


def heldCracks(fe: FESolver) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """(nodes (k, 4), triangles (k), damage (k)) of the cohesive cracks: the two nodes of the first
    side, then the opposite ones; the adjacent triangle. Must be called between two steps."""
    cracks = fe._cracks()
    held = cracks['held']
    return cracks['nodes'][held], cracks['triangle'][held], cracks['damage'][held]


def shownMesh(fe: FESolver) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """(nodes (n), triangles (k), corners (k, 3)): numbers of the existing nodes and triangles, and the
    triangles' corners as indices of these nodes. Must be called between two steps."""
    triangles = shownTriangles(fe)
    nodes, places = numpy.unique(fe.triangles[triangles], return_inverse=True)
    return nodes, triangles, places.reshape(-1, 3)


def isBody(value: object) -> bool:
    """True for a number or a name of one body, also for an invalid one."""
    return isinstance(value, str) or isWhole(value)


def newName(fe: FESolver, name: str | None) -> str:
    """The name of a body to be added: '' for None; ValueError for a name in use."""
    if name is None:
        return ''
    name = text('name', name)
    if not name or '\n' in name or len(name) > _LONGEST:
        refuse('name', name, 'a text of 1 to %d characters in one line' % _LONGEST)
    if name in fe._names:
        raise ValueError("name is %s, which body %d has already." % (shown(name), fe._names.index(name)))
    return name


def bodyNumber(fe: FESolver, value: Any, argument: str = 'component', least: int = -2**31) -> int:
    """The number of the body that `value`, a number or a name, refers to; ValueError for none."""
    names = fe._names
    if isinstance(value, str):
        known = [name for name in names if name]
        if not value or value not in names:
            refuse(argument, value, 'the number or the name of a body' +
                   (', one of %s' % shown(known) if known else '; no body has a name'))
        return names.index(value)
    return whole(argument, value, least, 'the number or the name of a body')


def existingBody(fe: FESolver, value: Any, argument: str = 'component') -> int:
    """The number of the existing body that `value` refers to; ValueError for none."""
    number = bodyNumber(fe, value, argument)
    if not 0 <= number < len(fe._names) or fe._isGone(number):
        raise ValueError('%s is %s, which is no body of this FESolver.' % (argument, shown(value)))
    return number


def nodesOf(self: FESolver, component: int | str) -> numpy.ndarray:
    """Numbers of a body's nodes, array (k), without those of removed fragments.

    component  the body's number, or its name. ValueError if there is no such body.
    """
    return self._nodesOf(existingBody(self, component))


def componentOf(self: FESolver, name: str) -> int:
    """The number of the body with this name; ValueError if there is none."""
    return existingBody(self, text('name', name), 'name')
