"""Lines from files of other programs, for readOutline: one module for each kind of file.

Each has `lines(name, tolerance)`, which returns a list of arrays (n, 2) in the units of the file: the
points of an unbroken line, closed if the last point equals the first one. `tolerance` is in these
units, None if none was given.
"""

import importlib

from yadefrag.values import shownPath


def needed(module, package, file):
    """The module of an optional library; ImportError with the name of Debian's package if it is
    missing."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError('%s can be read only with the Python library %s, which is missing '
                          "(%s): install Debian's package %s." %
                          (shownPath(file), module, error, package), name=module) from None


def refuseFile(file, kind, error):
    """ValueError: the contents of `file` do not match its ending; `error` is the library's
    exception."""
    words = ' '.join(str(error).split()).rstrip('.')[:120]
    raise ValueError('%s is not a readable %s: %s.' %
                     (shownPath(file), kind, words or type(error).__name__)) from None


def requireTolerance(tolerance, file, what):
    """`tolerance`; ValueError if it is None."""
    if tolerance is None:
        raise ValueError('tolerance is None, but %s %s: give the permitted deviation (m) of '
                         'the outline.' % (shownPath(file), what))
    return tolerance
