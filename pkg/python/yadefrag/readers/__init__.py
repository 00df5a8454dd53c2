"""Lines from files of other programs, for readOutline: one module for each kind of file.

Each has `lines(name, tolerance)`, which returns a list of arrays (n, 2) in the units of the file: points
of an unbroken line, closed where the last point is the first one. `tolerance` is in these units,
None where the caller gave none.
"""

import importlib

from yadefrag.values import shownPath


def needed(module, package, file):
    """The module of an optional library; ImportError with Debian's name for it where it is missing."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError('%s can be read only with the Python library %s, which is missing here '
                          "(%s): install Debian's package %s." %
                          (shownPath(file), module, error, package), name=module) from None


def refuseFile(file, kind, error):
    """ValueError: `file` is not what its ending says; `error` is what the library found."""
    words = ' '.join(str(error).split()).rstrip('.')[:120]
    raise ValueError('%s is no %s that can be read: %s.' %
                     (shownPath(file), kind, words or type(error).__name__)) from None


def requireTolerance(tolerance, file, what):
    """`tolerance`; ValueError where it is None."""
    if tolerance is None:
        raise ValueError('tolerance is None, but %s %s: give the distance (m) by which the outline '
                         'may be off.' % (shownPath(file), what))
    return tolerance
