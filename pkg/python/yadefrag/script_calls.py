"""Functions of a script that FESolver calls within its step, and what they must not do."""

import functools
import threading

from yadefrag import _yadefrag

_calls = threading.local()


def calledInStep(function):
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


def requireBetweenSteps():
    """RuntimeError in a function that a step calls, and while another thread runs the scene."""
    if getattr(_calls, 'now', False):
        raise RuntimeError('bodies, bonds, motions and loads of FESolver change between steps only, not in a '
                           'function that was given to prescribe or pressure; do it in a PyRunner.')
    _yadefrag.requirePaused()
