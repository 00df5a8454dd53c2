"""Values from a script: accepted numbers, and the text of a refused value in messages; names for the types of arguments.

NumPy's numbers are accepted: scalars of any width, and arrays of dimension 0.
"""

import inspect
import itertools
import math
import numbers
import operator
import os
import reprlib
import warnings
from collections.abc import Callable
from typing import Any, NoReturn

import numpy
from numpy.typing import ArrayLike

from yade.wrapper import FEMat, FESolver  # noqa: F401 (hints of other modules)
from yadefrag._yadefrag import Mesh  # noqa: F401

File = str | os.PathLike[str]
Loop = list[tuple[float, float]]  # points (x, y) in m
Shape = tuple[Loop, list[Loop]]  # an outline and its holes
ByPlace = Callable[[float, float], Any]  # a function of (x, y) in m
Nodes = ArrayLike | ByPlace  # numbers or flags, a function that selects nodes, or a body's name
LONGEST = 80  # characters of a value in a sentence
MOST_BYTES = 255  # of a file's name without its folder, on Linux
_NO_LISTS = (str, bytes, dict, set)


class _Short(reprlib.Repr):
    """repr, shortened at every level; arrays by their shape."""

    def __init__(self):
        super().__init__()
        self.maxlevel = 3
        self.maxstring = self.maxother = 40
        self.maxlong = 24

    def repr1(self, value, level):
        # NumPy 2 would write np.float64(1.0).
        return super().repr1(plain(value), level)

    def repr_ndarray(self, array, level):
        if array.ndim == 1 and array.size <= self.maxlist:
            return self.repr(array.tolist())
        return 'an array of shape %r and type %s' % (array.shape, array.dtype)


_SHORT = _Short()


def shown(value: object) -> str:
    """`value` for a message: one line of at most LONGEST characters, for any value."""
    try:
        text = ' '.join(_SHORT.repr(value).split())
    except Exception:  # the repr of any class, or an integer of too many digits for one
        text = '<%s>' % type(value).__name__
    return text if len(text) <= LONGEST else text[:LONGEST - 3] + '...'


def plain(value: Any) -> Any:
    """A NumPy number as Python's; any other value unchanged."""
    if isinstance(value, numpy.generic) or isinstance(value, numpy.ndarray) and value.ndim == 0:
        item = value.item()
        return float(item) if isinstance(item, numpy.floating) else item  # a long double is kept
    return value


def refuse(name: str, value: object, right: str, error: type[Exception] = ValueError) -> NoReturn:
    """Raises `error` with the value of the argument `name` and the valid values."""
    raise error('%s is %s, it must be %s.' % (name, shown(value), right)) from None


def requireTakes(name: str, function: Callable, *arguments: str) -> None:
    """TypeError if a script's function, the argument `name`, cannot be called with these arguments by position."""
    try:
        inspect.signature(function).bind(*arguments)
    except TypeError:
        raise TypeError('%s is a function that cannot be called as %s(%s): it must take %s.' % (
            name, name, ', '.join(arguments), '%d arguments' % len(arguments) if len(arguments) > 1
            else 'one argument')) from None
    except ValueError:
        pass  # a built-in function without a signature


def atPlaces(name: str, function: Callable, places: numpy.ndarray, check: Callable[[str, Any], Any]) -> list:
    """check(name of the value, value) for the values of a script's function of (x, y) at `places` (n, 2)."""
    requireTakes(name, function, 'x', 'y')
    return [check('%s(%g, %g)' % (name, x, y), function(x, y)) for x, y in places]


def real(value: Any) -> float | None:
    """A float, or None if it is not a real number; an integer above all floats is infinite."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf  # type: ignore[operator]


def number(name: str, value: object, isRight: Callable[[float], Any], right: str) -> float:
    """A float for which isRight is true; ValueError with `right`, a description of valid values,
    otherwise."""
    result = real(value)
    if result is None or not isRight(result):
        refuse(name, value, right)
    return result


def anyNumber(name: str, value: object, unit: str) -> float:
    """A float, whose range the C++ that takes it checks."""
    return number(name, value, lambda v: True, 'a number (%s)' % unit)


def positive(name: str, value: object, unit: str) -> float:
    return number(name, value, lambda v: math.isfinite(v) and v > 0, 'a positive number (%s)' % unit)


def isWhole(value: object) -> bool:
    value = plain(value)
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)


def whole(name: str, value: object, least: int = 1, right: str = 'a positive whole number',
          most: int = 2**31 - 1) -> int:
    """An int from `least` to `most`, by default those of a C int."""
    if not isWhole(value) or plain(value) < least:
        refuse(name, value, right)
    result = operator.index(plain(value))
    if result > most:
        refuse(name, value, 'at most %d' % most)
    return result


def flag(name: str, value: object) -> bool:
    value = plain(value)
    if not isinstance(value, bool):
        refuse(name, value, 'True or False')
    return value


def numbersOf(value: Any, count: int) -> tuple[float, ...] | None:
    """A tuple of `count` floats, finite or not; None for other values."""
    if isinstance(value, _NO_LISTS):
        return None
    try:
        found = [real(one) for one in itertools.islice(value, count + 1)]
    except TypeError:
        return None
    result = tuple(one for one in found if one is not None)
    return result if len(result) == len(found) == count else None


def pair(name: str, value: object, right: str = 'a pair of numbers (x, y)') -> tuple[float, float]:
    """Two finite floats."""
    result = numbersOf(value, 2)
    if result is None:
        refuse(name, value, right)
    if not all(map(math.isfinite, result)):
        raise ValueError('%s is %s, both numbers must be finite.' % (name, shown(value)))
    return result[0], result[1]


def pointsOf(name: str, value: object, least: int) -> numpy.ndarray:
    """(n, 2) finite floats, for at least `least` points."""
    found = _pairs(value)
    if found is None:
        raise ValueError('%s must be a list of points (x, y) in m.' % name)
    if len(found) < least:
        raise ValueError('%s has %d points, it must have at least %d.' % (name, len(found), least))
    if not numpy.isfinite(found).all():
        bad = int(numpy.nonzero(~numpy.isfinite(found).all(axis=1))[0][0])
        raise ValueError('%s has a point %d at %s, which is not finite.' %
                         (name, bad, shown(tuple(found[bad].tolist()))))
    return found


def listOf(name: str, value: Any, right: str) -> list[Any]:
    """A list, of the elements of anything but a text or what has no order."""
    try:
        if not isinstance(value, _NO_LISTS):
            return list(value)
    except TypeError:
        pass
    refuse(name, value, right)


def array(value: Any, dtype: Any = None) -> numpy.ndarray | None:
    """A NumPy array; None if that is impossible, e.g. for rows of different lengths."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter('error')  # NumPy's warning about rows of different lengths
            return numpy.asarray(value, dtype=dtype)
    except (TypeError, ValueError, OverflowError, Warning):
        return None


def _pairs(value):
    """(n, 2) floats; None if it is not a list of pairs of numbers."""
    if isinstance(value, numpy.ndarray) and value.dtype.kind in 'iuf':
        return value.astype(float) if value.ndim == 2 and value.shape[1] == 2 else None
    if isinstance(value, _NO_LISTS):
        return None
    try:
        pairs = [numbersOf(one, 2) for one in value]
    except TypeError:
        return None
    return None if None in pairs else numpy.array(pairs, dtype=float).reshape(-1, 2)


def text(name: str, value: Any) -> str:
    """A text that can be saved in UTF-8."""
    value = plain(value)
    try:
        value.encode()
    except (AttributeError, UnicodeError):
        refuse(name, value, 'a text')
    return value


def shownPath(name: str) -> str:
    """A file's name for a message: the end of a long one."""
    return name if len(name) <= LONGEST else '...' + name[3 - LONGEST:]


def path(name: str, value: Any, ending: str = '') -> str:
    """A file's name as text; ValueError for other values, or for another ending."""
    try:
        file = os.fspath(value)
        base = os.path.basename(os.fsencode(file))
    except (TypeError, UnicodeError):
        file = base = b''
    if not isinstance(file, str) or '\0' in file or not base:
        refuse(name, value, 'a path')
    if len(base) > MOST_BYTES:
        refuse(name, value, 'a path with a name of at most %d bytes' % MOST_BYTES)
    if not file.endswith(ending):
        raise ValueError("%s is %s, its name must end with '%s'." % (name, shown(file), ending))
    return file
