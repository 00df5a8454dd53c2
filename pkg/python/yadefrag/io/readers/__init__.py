"""Lines and regions from files of other programs, for readOutline: one module for each kind of file.

Each has `read(name, tolerance)`, which returns a Found, in the units of the file. `tolerance` is in
these units, None if none was given. What is read is what the usual viewer shows.
"""

from __future__ import annotations

import collections
from collections.abc import Iterable, Mapping
from types import ModuleType
from typing import NoReturn

from yadefrag import libraries
from yadefrag.arguments import shownPath


class Found:
    """Contents of a file, or of one of its layers.

    lines    arrays (n, 2), the points of an unbroken line, closed if the last equals the first one
    regions  (outline, [holes]) of arrays (n, 2) without the first point repeated at the end
    leftOut  {what, in the plural: number}: what a viewer shows and the reader does not read, and what
             the file contains and a viewer does not show
    """

    def __init__(self, lines: Iterable = (), regions: Iterable = ()) -> None:
        self.lines, self.regions = list(lines), list(regions)
        self.leftOut = collections.Counter()

    def add(self, other: Found) -> None:
        self.lines += other.lines
        self.regions += other.regions
        self.leftOut += other.leftOut


def leftOutWords(leftOut: Mapping[str, int]) -> str:
    """'texts (3), masks (1)'."""
    return ', '.join('%s (%d)' % pair for pair in leftOut.items())


def needed(module: str, package: str, file: str) -> ModuleType:
    """The module of an optional library that reads `file`."""
    return libraries.needed(module, package, shownPath(file) + ' can be read')


def refuseFile(file: str, kind: str, error: BaseException) -> NoReturn:
    """ValueError: the contents of `file` do not match its ending; `error` is the library's exception."""
    words = ' '.join(str(error).split()).rstrip('.')[:120]
    raise ValueError('%s is not a readable %s: %s.' %
                     (shownPath(file), kind, words or type(error).__name__)) from None


def requireTolerance(tolerance: float | None, file: str, what: str) -> float:
    """`tolerance`; ValueError if it is None."""
    if tolerance is None:
        raise ValueError('tolerance is None, but %s %s: give the permitted deviation (m) of '
                         'the outline.' % (shownPath(file), what))
    return tolerance
