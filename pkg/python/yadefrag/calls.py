"""Calls with wrong arguments: what Python refuses in its own words is refused with one sentence."""

import difflib
import functools
import inspect
from collections.abc import Callable
from typing import Any

from yadefrag.arguments import shown

_BY_POSITION = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)


def inWords(function: Callable,
            arranged: Callable[..., tuple[tuple, dict[str, Any]]] | None = None) -> Callable:
    """`function`, with a sentence as TypeError for arguments that are missing, unknown or too many.

    arranged  None, or a function of the arguments by position → (arguments by position, dict of others)
    """
    # The wrapped function may be one of Boost.Python, which has no signature.
    signature = inspect.signature(function, follow_wrapped=False)

    @functools.wraps(function)
    def called(*given, **settings):
        if arranged is not None:
            given, more = arranged(*given)
            twice = sorted(set(more) & set(settings))
            if twice:
                raise TypeError('%s has %s twice, by position and by name.' % (function.__name__, twice[0]))
            settings.update(more)
        try:
            signature.bind(*given, **settings)
        except TypeError:
            raise TypeError(_sentence(function.__name__, signature, given, settings)) from None
        return function(*given, **settings)

    setattr(called, '__signature__', signature)
    return called


def _sentence(name, signature, given, settings):
    parameters = {key: one for key, one in signature.parameters.items() if key != 'self'}
    given = given[len(signature.parameters) - len(parameters):]
    open_ = any(one.kind == inspect.Parameter.VAR_KEYWORD for one in parameters.values())
    for key in () if open_ else settings:
        if key not in parameters:
            near = difflib.get_close_matches(key, parameters, 1)
            return '%s has no argument %s%s.' % (
                name, shown(key), ', but %s' % near[0] if near else
                ': it has %s' % (_listed(parameters) or 'none'))
    places = [key for key, one in parameters.items() if one.kind in _BY_POSITION]
    if len(given) > len(places):
        if len(places) == len(parameters):
            return '%s takes %s, but %d are given: %s(%s).' % (
                name, _listed(places) or 'no arguments', len(given), name, ', '.join(places))
        return '%s takes %s by position, but %d are given: write the others with their names, %s=...' % (
            name, _listed(places), len(given), next(key for key in parameters if key not in places))
    twice = [key for key in places[:len(given)] if key in settings]
    if twice:
        return '%s has %s twice, by position and by name.' % (name, twice[0])
    needed = [key for key, one in parameters.items()
              if one.default is one.empty and one.kind not in (one.VAR_POSITIONAL, one.VAR_KEYWORD)]
    missing = [key for key in needed if key not in places[:len(given)] and key not in settings]
    return '%s needs %s: %s(%s).' % (name, _listed(missing), name, ', '.join(
        key if key in places else key + '=...' for key in needed))


def _listed(names):
    names = list(names)
    return ', '.join(names[:-1]) + ' and ' + names[-1] if len(names) > 1 else ''.join(names)
