"""Setting attributes of the new classes from scripts: numbers of NumPy are accepted, and a value of a
wrong type is refused with one sentence; also for attributes of YADE's base classes.
"""

import difflib
import functools
import warnings
from typing import Any

import numpy

from yade import wrapper
from yade.minieigenHP import Vector3
from yadefrag.arguments import isWhole, numbersOf, plain, refuse, shown

_OF_NUMPY = (numpy.generic, numpy.ndarray)
_LISTS = (list, tuple, numpy.ndarray)
_RIGHT = {'contactTolerance': "'fine', 'default', 'coarse' or a number",
          'softening': 'a name, or a list of points (opening over critical opening, traction over '
                       'strength)',
          'rateEffect': 'a name, or a list of points (strain rate in 1/s, factor of the strength)',
          'hardeningTable': "'none', or a list of points (plastic strain, yield stress in Pa)"}
_WRONG_KIND = (TypeError, OverflowError, UnicodeError)  # as Boost.Python refuses


def install(cls: Any) -> None:
    """Checks every way to set attributes of `cls`: assignment, the constructor and updateAttrs."""
    cls.__setattr__ = __setattr__
    cls.__init__ = _guardConstructor(cls.__init__)
    cls.updateAttrs = updateAttrs


def __setattr__(self: Any, name: str, value: Any) -> None:
    if not hasattr(type(self), name) and not name.startswith('_'):
        _warnOfUnknown(self, name)
    value = _inSpace(self, name, value)
    present = None if isinstance(value, _LISTS) else getattr(self, name, None)
    try:
        object.__setattr__(self, name, _fitting(present, value))
        if _isGravity(self, name):
            object.__setattr__(self, 'takesGravity', False)
    except _WRONG_KIND:
        right = 'two or three numbers' if _isGravity(self, name) else \
            _RIGHT.get(name) or _right(getattr(self, name), value)
        refuse('%s.%s' % (type(self).__name__, name), value, right,
               TypeError)  # as for YADE's own classes


def _warnOfUnknown(self, name):
    """Python objects accept any name: a misspelt attribute would be set without effect."""
    kind = type(self)
    known = [one for one in dir(kind) if not one.startswith('_') and not callable(getattr(kind, one))]
    near = difflib.get_close_matches(name, known, 1)
    warnings.warn("%s has no attribute '%s'%s: it is stored, but has no effect." %
                  (kind.__name__, name[:40], ', but %s' % near[0] if near else ''), stacklevel=3)


def _isGravity(self, name):
    return name == 'gravity' and isinstance(self, wrapper.FESolver)


def _inSpace(self, name, value):
    """FESolver's gravity: two numbers are extended to three."""
    if not _isGravity(self, name):
        return value
    pair = numbersOf(value, 2)
    return value if pair is None else (*pair, 0.)


def _guardConstructor(make):
    @functools.wraps(make)
    def __init__(self, *args, **settings):
        if args and isinstance(self, wrapper.Collider):
            _requireFunctors(args[0])
        elif args and isinstance(self, (wrapper.Material, wrapper.FESolver)):
            kind = type(self).__name__
            raise TypeError('%s takes no arguments by position: write the names of its attributes, as %s(%s=...).' %
                            (kind, kind, 'young' if isinstance(self, wrapper.Material) else 'passes'))
        make(self, *args)
        if settings:
            updateAttrs(self, settings)

    return __init__


def updateAttrs(self: Any, attributes: dict[str, Any]) -> None:
    """Sets all attributes of a dict, or none if one of them is refused."""
    if not isinstance(attributes, dict):
        refuse('attributes', attributes, 'a dict {name: value}')
    attributes = {name: _inSpace(self, name, value) for name, value in attributes.items()}
    if any(_isGravity(self, name) for name in attributes):
        attributes.setdefault('takesGravity', False)
    change, known = wrapper.Serializable.updateAttrs, self.dict()
    _findMisspelt(self, known, attributes)
    before = {name: value for name, value in known.items() if name in attributes}
    try:
        change(self, {name: _fitting(known.get(name), value) for name, value in attributes.items()})
    except Exception as error:
        change(self, before)
        if isinstance(error, _WRONG_KIND):
            _findWrong(type(self)(), attributes)
        raise


def _findMisspelt(self, known, attributes):
    """AttributeError for a name that is like a known one; YADE refuses others."""
    for name in attributes:
        near = difflib.get_close_matches(str(name), known, 1)
        if near and not hasattr(self, str(name)):
            raise AttributeError('%s has no attribute %s, but %s.' % (type(self).__name__, shown(name), near[0]))


def _findWrong(scratch, settings):
    """Raises TypeError for the first of the settings that is invalid for an object of this class."""
    known = scratch.dict()
    for name, value in settings.items():
        if name in known:
            setattr(scratch, name, value)


def _requireFunctors(functors):
    """YADE would end the process for a functor that is None."""
    if not isinstance(functors, (list, tuple)) \
            or not all(isinstance(one, wrapper.BoundFunctor) for one in functors):
        refuse('the first argument', functors, 'a list of bound functors')


def _fitting(present, value):
    """`value` for an attribute with the value `present`: NumPy's numbers become Python's. TypeError
    for values that Boost.Python would accept, too: 7 for a flag, bytes for a text, no dispatcher."""
    value = plain(value)
    if isinstance(value, numpy.ndarray) and value.ndim in (1, 2):
        return tuple(value.tolist())
    if isinstance(value, (list, tuple)) and any(isinstance(v, _OF_NUMPY) for v in value):
        return tuple(map(plain, value))
    isWrong = (isinstance(present, str) and not isinstance(value, (str, *_LISTS))
               or isinstance(present, bool) and not (isinstance(value, int) and value in (0, 1))
               or isinstance(present, wrapper.Dispatcher) and value is None)
    if isWrong:
        raise TypeError
    return value


def _right(present, wrong):
    """The valid kind of values for an attribute with the value `present`, for messages."""
    if isinstance(present, bool):
        return 'True or False'
    if isinstance(present, int):
        return 'closer to 0' if isWhole(wrong) else 'a whole number'
    rest = ((float, 'a number'), (str, 'a text'), (Vector3, 'three numbers'))
    return next((right for kind, right in rest if isinstance(present, kind)), 'of another class')
