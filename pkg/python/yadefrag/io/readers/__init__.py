"""Lines, regions and elements from files of other programs, for readOutline and readMesh: one module for each kind of
file.

Modules for readOutline have `read(name, tolerance)`, which returns a Found, in the units of the file. `tolerance` is in
these units, None if none was given. What is read is what the usual viewer shows. Those for readMesh have `read(name)`,
which returns Elements.
"""

from __future__ import annotations

import collections
import contextlib
import dataclasses
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import ModuleType

import numpy
from numpy.typing import ArrayLike

from yadefrag import messages
from yadefrag.arguments import shownPath

_CORNERS = {'triangle': 3, 'quad': 4, 'line': 2, 'vertex': 1}
# Number of nodes, with or without those in the middle: the degree of the sides.
_ORDERS = {'triangle': {6: 2, 7: 2, 9: 3, 10: 3, 12: 4, 15: 4}, 'quad': {8: 2, 9: 2, 12: 3, 16: 3, 20: 4, 25: 4}}
_LAGRANGE = {'VTK_LAGRANGE_TRIANGLE': 'triangle', 'VTK_LAGRANGE_QUADRILATERAL': 'quad', 'VTK_LAGRANGE_CURVE': 'line'}
MOST_POINTS = 10**6  # on one curve: a tolerance that needs more is a mistake


class Found:
    """Contents of a file, or of one of its layers.

    lines    arrays (n, 2), the points of an unbroken line, closed if the last equals the first one
    regions  (outline, [holes]) of arrays (n, 2) without the first point repeated at the end
    leftOut  {what, in the plural: number}: what a viewer shows and the reader does not read, and what
             the file contains and a viewer does not show; numbers of 0 end in `add`
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
    return messages.needed(module, package, shownPath(file) + ' can be read')


@contextlib.contextmanager
def readable(file: str, kind: str) -> Iterator[None]:
    """For `with`: an exception of the library, of Python's parsers, or for missing members of `file` becomes a
    ValueError: its contents do not match its ending."""
    try:
        yield
    except ImportError:
        raise
    except Exception as error:
        words = ' '.join(str(error).split()).rstrip('.')[:120] or type(error).__name__
        raise ValueError('%s is not a readable %s: %s.' % (shownPath(file), kind, words)) from None


def requireTolerance(tolerance: float | None, file: str, what: str) -> float:
    """`tolerance`; ValueError if it is None."""
    if tolerance is None:
        raise ValueError('tolerance is None, but %s %s: give the permitted deviation (m) of '
                         'the outline.' % (shownPath(file), what))
    return tolerance


@dataclasses.dataclass
class Elements:
    """points     (n, 2 or 3) in units of the file
    blocks     [(kind, numbers of points (k, c), the places (k) of these elements)]; kind: 'triangle6'
    labels     name of each element in the file, by its place
    groups     {name: places of elements}
    markers    {name: places of elements that mark nodes only}: the node set of that name is theirs
    nodeSets   {name: numbers of points}
    instances  {name: places of elements}
    leftOut    sentences about what was left out
    joints     as in MeshFile, numbers of points, and [(strength, energy)] in units of the file
    """

    points: numpy.ndarray
    blocks: list
    labels: list
    groups: dict = dataclasses.field(default_factory=dict)
    markers: dict = dataclasses.field(default_factory=dict)
    nodeSets: dict = dataclasses.field(default_factory=dict)
    instances: dict = dataclasses.field(default_factory=dict)
    leftOut: list = dataclasses.field(default_factory=list)
    joints: Sequence = ((), ())
    axisymmetric: bool | None = None


def cornersOf(kind: str) -> int:
    """Number of corners, which are the first nodes of an element; 0 if it is not plane."""
    return _CORNERS.get(_LAGRANGE.get(kind) or re.sub(r'\d+$', '', kind), 0)


def orderOf(kind: str) -> int:
    """Degree of the sides; 1 for those that are straight, and for kinds that are not known."""
    found = re.fullmatch(r'(triangle|quad)(\d+)', kind)
    return _ORDERS[found[1]].get(int(found[2]), 1) if found else 1


def counted(number: int, word: str) -> str:
    """'1 line', '2 lines'."""
    return '%d %s%s' % (number, word, '' if number == 1 else 's')


def piecesOf(bend: float, tolerance: float, least: int = 1) -> int:
    """Number of pieces of a polyline within a tolerance of a curve r(t), 0 ≤ t ≤ 1, whose second derivative is at most
    `bend`: the deviation for n uniform parameters is at most max|r''|/(8n²). ValueError for too many."""
    wanted = math.sqrt(bend / (8 * tolerance))
    if not wanted < MOST_POINTS:
        raise ValueError('tolerance needs more than %d points on one curve.' % MOST_POINTS)
    return max(least, math.ceil(wanted))


def ellipticArc(centre: ArrayLike, axes: ArrayLike, start: float, sweep: float, tolerance: float) -> numpy.ndarray:
    """(n + 1, 2) points from the angle `start` over `sweep` (rad) on centre + a·cos + b·sin; `axes`
    are the vectors (a, b). At least eight pieces per turn."""
    a, b = numpy.asarray(axes, dtype=float)
    reach = math.hypot(numpy.linalg.norm(a), numpy.linalg.norm(b))
    if abs(a @ b) <= 1e-12 * (a @ a + b @ b):  # perpendicular, e.g. for circles: exact
        reach = float(max(numpy.linalg.norm(a), numpy.linalg.norm(b)))
    pieces = piecesOf(reach * sweep**2, tolerance, math.ceil(abs(sweep) / (math.pi / 4)))
    angles = start + sweep * numpy.arange(pieces + 1)[:, None] / max(pieces, 1)
    return numpy.asarray(centre, dtype=float) + a * numpy.cos(angles) + b * numpy.sin(angles)
