"""Attributes of the new classes, as a script sets them: NumPy's numbers are taken, and a value of a
wrong kind is refused in a sentence; both for the attributes that come from YADE, too.
"""

import functools

import numpy

from yade import wrapper
from yade.minieigenHP import Vector3
from yadefrag.values import isWhole, plain, refuse

_KINDS = ((bool, 'True or False'), (int, 'a whole number'), (float, 'a number'), (str, 'a text'))
_OF_NUMPY = (numpy.generic, numpy.ndarray)
_WRONG_KIND = (TypeError, OverflowError, UnicodeError)  # as Boost.Python refuses


def install(cls):
    """Guards all that sets attributes of `cls`: assignment, the constructor and updateAttrs."""
    cls.__setattr__ = _assign
    cls.__init__ = _guardConstructor(cls.__init__)
    cls.updateAttrs = _update


def _assign(self, name, value):
    try:
        object.__setattr__(self, name, _simple(value))
    except _WRONG_KIND:
        refuse('%s.%s' % (type(self).__name__, name), value, _right(getattr(self, name), value))


def _guardConstructor(make):
    @functools.wraps(make)
    def __init__(self, *args, **settings):
        if args and isinstance(self, wrapper.Collider):
            _requireFunctors(args[0])
        try:
            make(self, *args, **{name: _simple(value) for name, value in settings.items()})
        except _WRONG_KIND:
            _findWrong(type(self)(), settings)
            raise

    return __init__


def _update(self, attributes):
    """Sets all attributes of a dict, or none of them where one is refused."""
    if not isinstance(attributes, dict):
        refuse('attributes', attributes, 'a dict {name: value}')
    change = wrapper.Serializable.updateAttrs
    before = {name: value for name, value in self.dict().items() if name in attributes}
    try:
        change(self, {name: _simple(value) for name, value in attributes.items()})
    except Exception as error:
        change(self, before)
        if isinstance(error, _WRONG_KIND):
            _findWrong(type(self)(), attributes)
        raise


def _findWrong(scratch, settings):
    """ValueError for the first of the settings that an object of this kind cannot have."""
    known = scratch.dict()
    for name, value in settings.items():
        if name in known:
            setattr(scratch, name, value)


def _requireFunctors(functors):
    """YADE ends the process for a functor that is None."""
    if not isinstance(functors, (list, tuple)) \
            or not all(isinstance(one, wrapper.BoundFunctor) for one in functors):
        refuse('the first argument', functors, 'a list of bound functors')


def _simple(value):
    """NumPy's numbers as Python's, also those in a vector."""
    value = plain(value)
    if isinstance(value, numpy.ndarray) and value.ndim == 1:
        return tuple(value.tolist())
    if isinstance(value, (list, tuple)) and any(isinstance(v, _OF_NUMPY) for v in value):
        return tuple(map(plain, value))
    return value


def _right(present, wrong):
    """What an attribute that has the value `present` must be."""
    for kind, right in _KINDS:
        if isinstance(present, kind):
            return 'nearer to 0' if kind is int and isWhole(wrong) else right
    return 'three numbers' if isinstance(present, Vector3) else 'of another class'
