"""Warnings of the plugin, at the script's line; one that many bodies or bonds have is given once, with their
number."""

import os
import re
import sys
import warnings
from collections.abc import Callable

_HERE = os.path.dirname(__file__) + os.sep
_SHOWN = 90  # characters of a message that is quoted
_LISTED = 12  # bodies or bonds in a sentence
_NUMBER = re.compile(r'[-+]?[\d.]+(e[-+]?\d+)?')
_repeated = {}  # {message without its numbers: (the first message, 'bodies' or 'bonds', those that have it)}
untold: set[object] = set()  # those that further bodies or bonds have, and functions of _nowhere
_nowhere = {}  # {a function `fixed`: the bodies of which it selects no node; None: it selects some of another one}


def warn(sentence: str) -> None:
    """A warning at the line of the script, outside of this package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and frame.f_code.co_filename.startswith(_HERE):
        frame, level = frame.f_back, level + 1
    warnings.warn(sentence, stacklevel=level)


def warnOfOne(sentence: str, what: str, one: int | str) -> None:
    """The first of several messages that differ in numbers only; tellNumbers gives the number of the others.

    what, one  'bodies' and the number of one, or 'bonds' and the numbers of two bodies, 'a-b'
    """
    kind = _NUMBER.sub('', sentence)
    _, _, known = _repeated.setdefault(kind, (sentence, what, []))
    known.append(one)
    if len(known) == 1:
        warn(sentence)
    else:
        untold.add(kind)


def noteFixed(fixed: Callable, body: int, isAny: bool) -> None:
    """Warns only before the run if a function selects no node: it may select nodes of a later body."""
    function = getattr(fixed, '__code__', None) or id(fixed)
    bodies = _nowhere.setdefault(function, [])
    if isAny:
        _nowhere[function] = None
        untold.discard(function)
    elif bodies is not None:
        bodies.append(body)
        untold.add(function)


def tellNumbers() -> None:
    """Before a run: how many bodies or bonds have a message that was given for the first of them."""
    for kind in list(untold):
        untold.discard(kind)
        if kind in _nowhere:
            bodies = _nowhere.pop(kind)
            warn('fixed selects none of the nodes of %s.' % (
                'body %d' % bodies[0] if len(bodies) == 1 else _inWords('bodies', bodies)))
            continue
        first, what, known = _repeated[kind]
        warn('%d %s have this message, which was given for the first of them only: "%s"; they are %s.' %
             (len(known), what, first if len(first) <= _SHOWN else first[:_SHOWN] + '…', _inWords(what, known)))


def forget() -> None:
    """After O.reset, or before the first body of a solver."""
    _repeated.clear()
    _nowhere.clear()
    untold.clear()


def _inWords(what, known):
    if what == 'bodies' and known == list(range(known[0], known[-1] + 1)):
        return 'the bodies %d to %d' % (known[0], known[-1])
    return 'the %s %s' % (what, ', '.join(map(str, known[:_LISTED]))) + ' and others' * (len(known) > _LISTED)
