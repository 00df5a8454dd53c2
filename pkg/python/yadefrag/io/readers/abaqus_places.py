"""Parts of an Abaqus file, and their instances at their places."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import Any

import numpy

from yadefrag.io.readers.elements import Elements, counted

_PLANE = re.compile(r'(?:CPS|CPEG?|CG?AX|AC2D|ACAX|DCC?2D|DCC?AX|D?S|STRI|M3D|SFM3D|R3D)([34689])')
_KINDS = {3: 'triangle3', 4: 'quad4', 6: 'triangle6', 8: 'quad8', 9: 'quad9'}
_LINES = re.compile(r'[TB]\d|R2D2|[RMS]AX|PIPE|ELBOW|FRAME|CONN|SPRING|DASHPOT|GAP|IT|JOINT|DCOUP|MASS|'
                    r'ROTARY|HEATCAP|DC{0,2}1D|AC1D|F(2D|AX)2|D$')
_JOINTS = re.compile(r'COH(2D|AX)|GK(2D|P[SE]|AX)')  # cohesive elements and gaskets in the plane: no area of their own
_ENDLESS = re.compile(r'CIN(P[SE]|AX)|ACIN(2D|AX)')  # they go on from the boundary to infinity


class Part:
    """Nodes, elements and sets of a part, of the assembly, or of a file without parts."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.nodes = {}  # {number: [x, y, z]}
        self.elements = {}  # {number: (type, numbers of nodes)}
        self.sets = {'NSET': {}, 'ELSET': {}}  # {NAME: (name, [(part or instance, number)])}

    def addSet(self, kind: str, name: str, members: Iterable[tuple[Part, int]]) -> None:
        self.sets[kind].setdefault(name.upper(), (name, []))[1].extend(members)

    def all(self, what: str) -> dict[int, Any]:
        return getattr(self, what)


class Instance(Part):
    """A moved copy of a part, which can have further nodes, elements and sets."""

    def __init__(self, name: str, part: Part) -> None:
        super().__init__(name)
        self.part = part
        self.moves = []  # up to two rows: a translation; two points of an axis and an angle (degrees)

    def all(self, what: str) -> dict[int, Any]:
        return {**getattr(self.part, what), **getattr(self, what)}


def nodesOf(type: str) -> int:
    """Number of nodes of a plane element; 0 for other types."""
    if type.startswith('STRI65'):
        return 6
    found = _PLANE.match(type)
    return int(found[1]) if found else 0


def placed(instances: list[Instance], assembly: Part | None, leftOut: list[str]) -> Elements:
    """Elements of all instances; `assembly` is a Part with its sets, or None."""
    points, labels, corners, types = [], [], [], {}
    places = {'NSET': {}, 'ELSET': {}}  # {(instance, number in the file): number from 0}
    for one in instances:
        nodes, where = one.all('nodes'), places['NSET']
        points += _moved(list(nodes.values()), one.moves)
        for number in nodes:
            where[one, number] = len(where)
        for number, (type, its) in one.all('elements').items():
            labels.append('%s.%d' % (one.name, number) if one.name else '%d' % number)
            its = its if nodesOf(type) else [node for node in its if (one, node) in where]
            for node in its:
                if (one, node) not in where:
                    raise ValueError('element %s has the node %d, which does not exist' % (labels[-1], node))
            types.setdefault(type, []).append(len(corners))
            places['ELSET'][one, number] = len(corners)
            corners.append([where[one, node] for node in its])
    sets = _Sets(instances, assembly, places, corners)
    return Elements(numpy.array(points, dtype=float).reshape(-1, 3), _blocks(types, corners, leftOut), labels,
                    sets.named('ELSET'), nodeSets=sets.ofNodes(), instances=sets.instances(), leftOut=leftOut)


def _moved(points, moves):
    """Points after the translation and then the rotation of an instance."""
    found = numpy.array(points, dtype=float).reshape(-1, 3)
    if moves:
        found = found + (moves[0] + [0., 0., 0.])[:3]
    if len(moves) > 1:
        start, end, degrees = numpy.array(moves[1][:3]), numpy.array(moves[1][3:6]), moves[1][6]
        axis = (end - start) / numpy.linalg.norm(end - start)
        arms = found - start
        along = numpy.outer(arms @ axis, axis)
        across, angle = arms - along, math.radians(degrees)
        found = start + along + math.cos(angle) * across + math.sin(angle) * numpy.cross(axis, across)
    return found.tolist()


def _blocks(types, corners, leftOut):
    blocks = []
    for type, numbers in types.items():
        isJoint = _JOINTS.match(type)
        if isJoint or not nodesOf(type) and (_LINES.match(type) or _ENDLESS.match(type)):
            leftOut.append('%s of the type %s%s' % (counted(len(numbers), 'element'), type, isJoint and
                                                    ', which connect parts that are separate here' or ''))
            continue
        if 'AX' in type[:5]:
            leftOut.append('the axis of revolution of %s of the type %s' % (counted(len(numbers), 'element'), type))
        kind = _KINDS.get(nodesOf(type), type)
        blocks.append((kind, numpy.array([corners[n] for n in numbers]) if kind != type else (), numbers))
    return blocks


class _Sets:
    def __init__(self, instances, assembly, places, corners):
        self._placed, self._assembly = instances, assembly
        self._places, self._corners = places, corners
        self._copies = {assembly: []}
        for one in instances:
            self._copies.setdefault(one.part, []).append(one)

    def named(self, kind):
        """{name: numbers} of all instances together. The name of a set that several parts have begins
        with the part's, since these sets have nothing in common."""
        found = {}
        parts = list(dict.fromkeys(one.part for one in self._placed))
        owners = [*filter(None, [self._assembly]), *parts, *self._placed]
        for owner in owners:
            for key, (name, members) in owner.sets[kind].items():
                others = [one for one in owners if one is not owner and key in one.sets[kind]]
                isOwn = owner.name and others and owner is not self._assembly
                found['%s.%s' % (owner.name, name) if isOwn else name] = self._numbers(kind, members)
        return found

    def ofNodes(self):
        """{name: numbers of points}: all sets of nodes and of elements, and those of each instance."""
        found = {}
        for kind in ('NSET', 'ELSET'):
            sets = self.named(kind)
            for one in self._placed:
                for name, members in [*one.part.sets[kind].values(), *one.sets[kind].values()]:
                    if one.name:
                        sets['%s.%s' % (one.name, name)] = self._numbers(kind, members, one)
            for name, numbers in sets.items():
                found.setdefault(name, numbers if kind == 'NSET' else
                                 [point for number in numbers for point in self._corners[number]])
        return found

    def instances(self):
        found = {one.name: [] for one in self._placed if one.name}
        for (one, _), number in self._places['ELSET'].items():
            if one.name:
                found[one.name].append(number)
        return found

    def _numbers(self, kind, members, only=None):
        """Those of the members in the instance `only`, or in all; members that do not exist are none."""
        where, found = self._places[kind], []
        for owner, number in members:
            for one in [owner] if isinstance(owner, Instance) else self._copies[owner]:
                if only in (None, one) and (one, number) in where:
                    found.append(where[one, number])
        return sorted(set(found))
