"""Elements of a mesh file, before they become triangles: what all readers of meshes return."""

import dataclasses
import re

import numpy

_CORNERS = {'triangle': 3, 'quad': 4, 'line': 2, 'vertex': 1}
# Number of nodes, with or without those in the middle: the degree of the sides.
_ORDERS = {'triangle': {6: 2, 7: 2, 9: 3, 10: 3, 12: 4, 15: 4}, 'quad': {8: 2, 9: 2, 12: 3, 16: 3, 20: 4, 25: 4}}
_LAGRANGE = {'VTK_LAGRANGE_TRIANGLE': 'triangle', 'VTK_LAGRANGE_QUADRILATERAL': 'quad',
             'VTK_LAGRANGE_CURVE': 'line'}


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
    """

    points: numpy.ndarray
    blocks: list
    labels: list
    groups: dict = dataclasses.field(default_factory=dict)
    markers: dict = dataclasses.field(default_factory=dict)
    nodeSets: dict = dataclasses.field(default_factory=dict)
    instances: dict = dataclasses.field(default_factory=dict)
    leftOut: list = dataclasses.field(default_factory=list)


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
