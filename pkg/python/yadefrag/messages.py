"""Messages to scripts. Warnings of the plugin, at the script's line; one that many bodies or bonds have is given once,
with their number. Calls with wrong arguments: what Python refuses in its own words is refused with one sentence.
Libraries that only some functions need, and that are missing."""

import difflib
import functools
import importlib
import inspect
import os
import re
import sys
import warnings
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

from yadefrag.arguments import shown

_HERE = os.path.dirname(__file__) + os.sep
_SHOWN, _SHOWN_OF_RUNS = 90, 200  # characters of a message that is quoted
_LISTED = 12  # bodies or bonds in a sentence
_NUMBER = re.compile(r'[-+]?[\d.]+(e[-+]?\d+)?')
_repeated = {}  # {message without its numbers: (the first message, 'bodies' or 'bonds', those that have it)}
untold: set[object] = set()  # those that further bodies or bonds have, and functions of _nowhere
_nowhere = {}  # {a function `fixed`: the bodies of which it selects no node; None: it selects some of another one}
_BY_POSITION = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)


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
             (len(known), what, _begin(first, _SHOWN), _inWords(what, known)))


def passOn(what: str, rows: Sequence[Any]) -> None:
    """Warns once of each kind of message that runs gave, with the number of these runs."""
    kinds = {}
    for row in rows:
        for kind, sentence in {_NUMBER.sub('', s): s for s in row.warnings}.items():
            kinds.setdefault(kind, []).append(sentence)
    for sentences in kinds.values():
        first = _begin(sentences[0], _SHOWN_OF_RUNS)
        others = ', some with other numbers' if len(set(sentences)) > 1 else ''
        warn('%s: %d of %d runs gave this message%s: "%s" The others are in `warnings` of the rows.' %
             (what, len(sentences), len(rows), others, first) if len(sentences) > 1 else
             '%s: one of %d runs gave the message: "%s"' % (what, len(rows), first))


def forget() -> None:
    """After O.reset, or before the first body of a solver."""
    _repeated.clear()
    _nowhere.clear()
    untold.clear()


def _begin(sentence, most):
    return sentence if len(sentence) <= most else sentence[:most] + '…'


def _inWords(what, known):
    if what == 'bodies' and known == list(range(known[0], known[-1] + 1)):
        return 'the bodies %d to %d' % (known[0], known[-1])
    return 'the %s %s' % (what, ', '.join(map(str, known[:_LISTED]))) + ' and others' * (len(known) > _LISTED)


def checkedCall(function: Callable, arranged: Callable[..., tuple[tuple, dict[str, Any]]] | None = None) -> Callable:
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
                name, shown(key), ', but %s' % near[0] if near else ': it has %s' % (_listed(parameters) or 'none'))
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


def needed(module: str, package: str, what: str) -> ModuleType:
    """The module of an optional library; ImportError with the name of Debian's package if it is missing.

    what  subject and verb of the sentence: 'voronoi works'
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError('%s only with the Python library %s, which is missing '
                          "(%s): install Debian's package %s." % (what, module, error, package), name=module) from None


def shapely(module: str, what: str) -> ModuleType:
    """A module of shapely, by its name without 'shapely'."""
    return needed('shapely.' + module, 'python3-shapely', what)


def treeOf(shapes: Sequence[Any], search: str, what: str) -> Callable[[Any], Any]:
    """A function of a shape, with the numbers of the `shapes` whose boxes meet its box (search='query'), or that of
    the one at the least distance ('nearest')."""
    with warnings.catch_warnings():  # that it will be another one in 2.0
        warnings.simplefilter('ignore', FutureWarning)
        tree = shapely('strtree', what).STRtree(shapes)
    old = {'query': 'query_items', 'nearest': 'nearest_item'}[search]  # of shapely 1.8
    return getattr(tree, old, None) or getattr(tree, search)
