"""What scripts must not do, each refused with one sentence: attributes of the new classes, also those of YADE's base
classes, with values of a wrong type (numbers of NumPy are accepted); pieces of FESolver's bodies in clumps.
"""

import difflib
import functools
import numbers
import warnings
from typing import Any

import numpy

from yade import wrapper
from yade.minieigenHP import Vector3
from yadefrag.arguments import isWhole, numbersOf, plain, refuse, shown

_OF_NUMPY = (numpy.generic, numpy.ndarray)
_LISTS = (list, tuple, numpy.ndarray)
_RIGHT = {'contactTolerance': "'fine', 'default', 'coarse' or a number",
          'softening': 'a name, or a list of points (opening over critical opening, traction over strength)',
          'rateEffect': 'a name, or a list of points (strain rate in 1/s, factor of the strength)',
          'speedEffect': "'none', or a list of points (speed of the crack in m/s, factor of the energy)",
          'hardeningTable': "'none', or a list of points (plastic strain, yield stress in Pa)"}
_WRONG_KIND = (TypeError, OverflowError, UnicodeError)  # as Boost.Python refuses


def guardAttributes(cls: Any) -> None:
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
        refuse('%s.%s' % (type(self).__name__, name), value, right, TypeError)  # as for YADE's own classes


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
            # YADE would end the process for a functor that is None.
            if not isinstance(args[0], (list, tuple)) \
                    or not all(isinstance(one, wrapper.BoundFunctor) for one in args[0]):
                refuse('the first argument', args[0], 'a list of bound functors')
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
        if isinstance(error, _WRONG_KIND):  # TypeError for the first that is invalid for an object of this class
            scratch = type(self)()
            for name in attributes:
                if name in known:
                    setattr(scratch, name, attributes[name])
        raise


def _findMisspelt(self, known, attributes):
    """AttributeError for a name that is like a known one; YADE refuses others."""
    for name in attributes:
        near = difflib.get_close_matches(str(name), known, 1)
        if near and not hasattr(self, str(name)):
            raise AttributeError('%s has no attribute %s, but %s.' % (type(self).__name__, shown(name), near[0]))


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

# --- bodies

def _guard(name):
    """A method of O.bodies that refuses pieces of a boundary as members of a clump: YADE would end the process for
    clumps without mass, and add forces on the piece to those on the clump."""
    method = getattr(wrapper.BodyContainer, name)

    @functools.wraps(method)
    def guarded(self, ids, *others, **settings):
        ids = list(ids) if hasattr(ids, '__iter__') else ids  # any sequence, once
        for id in ids if isinstance(ids, list) else ():  # no list: YADE raises the exception
            isPlace = isinstance(id, numbers.Integral) and 0 <= int(id) < len(self)
            shape = getattr(self[int(id)], 'shape', None) if isPlace else None
            if isinstance(shape, wrapper.SurfaceSegment) and shape.entry >= 0:
                raise ValueError('body #%d is part of the boundary of body %d of FESolver, it cannot be in a clump.' %
                                 (id, shape.component))
        return method(self, ids, *others, **settings)
    setattr(wrapper.BodyContainer, name, guarded)


def guardBodies() -> None:
    for name in ('clump', 'addToClump'):
        _guard(name)
