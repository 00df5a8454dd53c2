"""What is done between two steps only: reads of one state, changes, runs.

Functions of a script that FESolver calls within its step must not do any of these.
"""

import contextlib
import functools
import threading
from collections.abc import Callable, Iterator

from yadefrag import _yadefrag
from yadefrag.hints import FESolver

_calls = threading.local()


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


def requireNoStep(what: str) -> None:
    """A run within a step would wait for the end of that step, which waits for the run: RuntimeError."""
    if _yadefrag.isInStep():
        raise RuntimeError('%s runs the scene: it cannot be called within a step, as from a PyRunner.' % what)
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
