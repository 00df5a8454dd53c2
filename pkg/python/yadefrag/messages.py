"""Warnings of the plugin, at the script's line; one that many bodies have is given once, with their number."""

import os
import re
import sys
import warnings

_HERE = os.path.dirname(__file__) + os.sep
_SHOWN = 90  # characters of a message that is quoted
_LISTED = 12  # bodies in a sentence
_NUMBER = re.compile(r'[-+]?[\d.]+(e[-+]?\d+)?')
_repeated = {}  # {message without its numbers: (the first message, bodies that have it)}
_untold = set()  # those of which more bodies have been added than have been told


def warn(sentence):
    """A warning at the line of the script, outside of this package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and frame.f_code.co_filename.startswith(_HERE):
        frame, level = frame.f_back, level + 1
    warnings.warn(sentence, stacklevel=level)


def warnOfBody(sentence, body):
    """The first of several messages that differ in numbers only; tellNumbers gives the number of the others."""
    kind = _NUMBER.sub('', sentence)
    if body == 0:
        forget(kind)  # of another solver
    first, bodies = _repeated.setdefault(kind, (sentence, []))
    bodies.append(body)
    if len(bodies) == 1:
        warn(sentence)
    else:
        _untold.add(kind)


def tellNumbers():
    """Before a run: how many bodies have a message that was given for the first of them."""
    for kind in list(_untold):
        _untold.discard(kind)
        first, bodies = _repeated[kind]
        warn('%d bodies have this message, which was given for the first of them only: "%s"; they are %s.' %
             (len(bodies), first if len(first) <= _SHOWN else first[:_SHOWN] + '…', _inWords(bodies)))


def forget(kind=None):
    """After O.reset, for all kinds, or for one."""
    for one in list(_repeated) if kind is None else [kind]:
        _repeated.pop(one, None)
        _untold.discard(one)


def _inWords(bodies):
    if bodies == list(range(bodies[0], bodies[-1] + 1)):
        return 'the bodies %d to %d' % (bodies[0], bodies[-1])
    text = ', '.join(map(str, bodies[:_LISTED]))
    return 'the bodies ' + text + (' and others' if len(bodies) > _LISTED else '')
