"""Meshes of Abaqus and CalculiX (.inp): parts, their instances at their places, and sets of both.

A file without parts is one part with one instance at its place.
"""

from __future__ import annotations

import math
import os
import re
from collections import Counter
from collections.abc import Iterable

import numpy

from yadefrag.io.readers import Elements, counted

_PLANE = re.compile(r'(?:CPS|CPEG?|CG?AX|AC2D|ACAX|DCC?2D|DCC?AX|D?S|STRI|M3D|SFM3D|R3D)([34689])')
_KINDS = {3: 'triangle3', 4: 'quad4', 6: 'triangle6', 8: 'quad8', 9: 'quad9'}
_LINES = re.compile(r'[TB]\d|R2D2|[RMS]AX|PIPE|ELBOW|FRAME|CONN|SPRING|DASHPOT|GAP|IT|JOINT|DCOUP|MASS|'
                    r'ROTARY|HEATCAP|DC{0,2}1D|AC1D|F(2D|AX)2|D$')
_JOINTS = re.compile(r'COH(2D|AX)|GK(2D|P[SE]|AX)')  # cohesive elements and gaskets in the plane: no area of their own
_COHESIVE = re.compile(r'COH(2D|AX)4$')  # those that may be joints here
_ENDLESS = re.compile(r'CIN(P[SE]|AX)|ACIN(2D|AX)')  # they go on from the boundary to infinity
_CHANGES = ('NGEN', 'NFILL', 'NCOPY', 'NMAP', 'ELGEN', 'ELCOPY', 'SYSTEM', 'PARAMETER')


class Part:
    """Nodes, elements and sets of a part, of its instance, of the assembly, or of a file without parts."""

    def __init__(self, name: str, part: Part | None = None) -> None:
        """part: of which this is an instance, which has all it has and can have more."""
        self.name, self.part = name, part or self
        self.nodes: dict = dict(part.nodes) if part else {}  # {number: [x, y, z]}
        self.elements: dict = dict(part.elements) if part else {}  # {number: (type, numbers of nodes)}
        self.sets = {'NSET': {}, 'ELSET': {}}  # {NAME: (name, [(part or instance, number)])}
        self.sections: list = list(part.sections) if part else []  # cohesive: (ELSET, options)
        self.moves = []  # up to two rows: a translation; two points of an axis and an angle (degrees)
        for kind, sets in part.sets.items() if part else ():
            for name, members in sets.values():
                self.addSet(kind, name, [(self if owner is part else owner, number) for owner, number in members])

    def addSet(self, kind: str, name: str, members: Iterable[tuple[Part, int]]) -> None:
        self.sets[kind].setdefault(name.upper(), (name, []))[1].extend(members)

    def origin(self, kind: str, key: str) -> Part:
        """The part or instance in which a set of this one is defined."""
        return self.part if key in self.part.sets[kind] else self


def nodesOf(type: str) -> int:
    """Number of nodes of a plane element; 0 for other types."""
    if type.startswith('STRI65'):
        return 6
    found = _PLANE.match(type)
    return int(found[1]) if found else 0


def placed(instances: list[Part], assembly: Part, materials: dict, leftOut: list[str]) -> Elements:
    """Elements of all instances, and the sets of these and of the assembly."""
    points, labels, corners, types = [], [], [], {}
    where = {'NSET': {}, 'ELSET': {}}  # {(instance, number in the file): number from 0}
    for one in instances:
        points += _moved(list(one.nodes.values()), one.moves)
        for number in one.nodes:
            where['NSET'][one, number] = len(where['NSET'])
    points, new, *joints = _joined(instances, where['NSET'], points, materials, leftOut)
    where['NSET'] = dict(zip(where['NSET'], new.tolist()))
    for one in instances:
        for number, (type, its) in one.elements.items():
            labels.append('%s.%d' % (one.name, number) if one.name else '%d' % number)
            its = its if nodesOf(type) else [node for node in its if node in one.nodes]
            for node in its:
                if node not in one.nodes:
                    raise ValueError('element %s has the node %d, which does not exist' % (labels[-1], node))
            types.setdefault(type, []).append(len(corners))
            where['ELSET'][one, number] = len(corners)
            corners.append([where['NSET'][one, node] for node in its])
    groups, ofElements = (_sets('ELSET', [assembly, *instances], where['ELSET'], isEach) for isEach in (False, True))
    nodeSets = _sets('NSET', [assembly, *instances], where['NSET'], True)
    for name, numbers in ofElements.items():
        nodeSets.setdefault(name, [point for number in numbers for point in corners[number]])
    copies = {one.name: [where['ELSET'][one, number] for number in one.elements] for one in instances if one.name}
    around, plane = ([one for one in types if re.match(kind, one)] for kind in ('(CG?|AC|DCC?|COH)AX', 'CP[SE]|COH2D'))
    if around and plane:
        raise ValueError('it has axisymmetric elements (%s) and plane ones (%s)' % (around[0], plane[0]))
    return Elements(points, _blocks(types, corners, leftOut), labels, groups, nodeSets=nodeSets, instances=copies,
                    leftOut=leftOut, joints=joints, axisymmetric=bool(around) if around or plane else None)


def _joined(instances, where, places, materials, leftOut):
    """Cohesive elements as joints, the nodes of both sides as one point in their middle: (points, the number of each
    given one among them, [(both points, number of the law)], [(strength, energy)] of the laws)."""
    points, sides, left, laws = numpy.array(places, dtype=float).reshape(-1, 3), [], Counter(), {}
    for one in instances:
        sections = {number: options for name, options in one.sections
                    for owner, number in one.sets['ELSET'].get(name, ('', ()))[1] if owner is one}
        cohesive = {number: of for number, of in one.elements.items() if _COHESIVE.match(of[0])}
        corners = [its[:3 if nodesOf(type) in (3, 6) else 4] for type, its in one.elements.values()
                   if cohesive and nodesOf(type)]
        plane = {frozenset(side) for its in corners for side in zip(its, its[1:] + its[:1])}
        for number, (type, its) in cohesive.items():
            nodes = next((nodes for nodes in (its, its[1:] + its[:1])
                          if len({frozenset(nodes[:2]), frozenset(nodes[2:])} & plane) == 2), ())
            law = _lawOf(sections.get(number, {}), materials) if nodes else 'without a triangle or quad on each side'
            if isinstance(law, str):
                left['', '%s %s, which connect parts that are separate here' % (type, law)] += 1
                continue
            a, b, c, d = (where[one, node] for node in nodes)
            if (points[b] - points[a]) @ (points[c] - points[d]) <= 0:
                raise ValueError('element %d (%s) has its nodes in a wrong order: its sides cross' % (number, type))
            left['stiffness, thickness, softening and ratios in shear of ', type + ', which are joints by addMesh'] += 1
            sides.append((a, d, b, c, laws.setdefault(law, len(laws))))
    leftOut += ['%s%s of the type %s' % (head, counted(count, 'element'), what) for (head, what), count in left.items()]
    both, label = numpy.reshape([side[:4] for side in sides], (-1, 2)).astype(int), numpy.arange(len(points))
    while (label[both[:, 0]] != label[both[:, 1]]).any():
        numpy.minimum.at(label, both, label[both].min(axis=1, keepdims=True))
    kept, new = numpy.unique(label, return_inverse=True)
    moves = [numpy.bincount(new, way) / numpy.bincount(new) for way in (points - points[label]).T]
    return points[kept] + numpy.transpose(moves), new, [(new[a], new[b], law) for a, _, b, _, law in sides], [*laws]


def _lawOf(options, materials):
    """(strength, energy), or the reason for which elements of this section are no joints."""
    name = options.get('MATERIAL', '')
    (start, strengths), (end, energies) = (materials.get((name.upper(), word), ({}, ()))
                                           for word in ('DAMAGE INITIATION', 'DAMAGE EVOLUTION'))
    if options.get('RESPONSE', '').upper().split() != ['TRACTION', 'SEPARATION']:
        return 'in no *COHESIVE SECTION of the response TRACTION SEPARATION'
    values = tuple(float(row[0] or 0) for row in (*strengths, *energies))
    isOne = start.get('CRITERION', '').upper() in ('MAXS', 'QUADS') and end.get('TYPE', '').upper() == 'ENERGY' \
        and len(strengths) == len(energies) == 1 and all(0 < one < math.inf for one in values)
    return values if isOne else "of the material '%s' without one strength (MAXS, QUADS) and one energy above 0" % name


def _sets(kind, owners, where, isEach):
    """{name: numbers} of all owners, of which the first one is the assembly, together; with `isEach` also those of each
    instance. The name of a set that several parts have begins with the part's, since these sets have nothing in common.
    Members that do not exist are none."""
    found = {}
    for owner in owners:
        for key, (name, members) in owner.sets[kind].items():
            origin = owner.origin(kind, key)
            isOwn = owner is not owners[0] and origin.name and any(
                key in one.sets[kind] and one.origin(kind, key) is not origin for one in owners)
            names = ['%s.%s' % (origin.name, name) if isOwn else name]
            if isEach and owner is not owners[0] and owner.name:
                names.append('%s.%s' % (owner.name, name))
            for one in dict.fromkeys(names):
                found.setdefault((origin, one), set()).update(where[member] for member in members if member in where)
    return {name: sorted(numbers) for (_, name), numbers in found.items()}


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
    for type, numbers in ((type, of) for type, of in types.items() if not _COHESIVE.match(type)):
        isJoint = _JOINTS.match(type)
        if isJoint or not nodesOf(type) and (_LINES.match(type) or _ENDLESS.match(type)):
            leftOut.append('%s of the type %s%s' % (counted(len(numbers), 'element'), type, isJoint and
                                                    ', which connect parts that are separate here' or ''))
            continue
        kind = _KINDS.get(nodesOf(type), type)
        blocks.append((kind, numpy.array([corners[n] for n in numbers]) if kind != type else (), numbers))
    return blocks


def read(name: str) -> Elements:
    """Elements; ValueError for a file that is not understood."""
    reader = _Reader()
    for keyword, options, rows in _keywords(name, 0):
        reader.take(keyword, options, rows)
    return reader.result()


def _keywords(name, depth):
    """(keyword, {OPTION: value}, lines of fields); comments are left out, other files included."""
    if depth > 20:
        raise ValueError('files include each other')
    with open(name, encoding='utf-8-sig', errors='replace') as file:
        lines = [line.strip() for line in file if line.strip() and not line.lstrip().startswith('**')]
    place = next((i for i, line in enumerate(lines) if line.startswith('*')), None)
    if place is None:
        raise ValueError('it has no keyword')
    while place < len(lines):
        head = lines[place]
        place += 1
        while head.endswith(',') and place < len(lines):
            head += lines[place]
            place += 1
        begin = place
        while place < len(lines) and not lines[place].startswith('*'):
            place += 1
        words = _fields(head[1:])
        options = dict(one.partition('=')[::2] for one in words[1:])
        options = {key.strip().upper(): value.strip().strip('"') for key, value in options.items()}
        keyword = ' '.join(words[0].upper().split())
        other = options.get('INPUT')
        folder = os.path.dirname(name)
        if keyword == 'INCLUDE':
            yield from _keywords(os.path.join(folder, other or ''), depth + 1)
            continue
        rows = [_fields(line) for line in lines[begin:place]]
        if other and keyword in ('NODE', 'ELEMENT', 'NSET', 'ELSET'):
            with open(os.path.join(folder, other), encoding='utf-8', errors='replace') as file:
                rows += [_fields(line) for line in file if line.strip() and not line.startswith('*')]
        yield keyword, options, rows


def _fields(line):
    return [one.strip().strip('"') for one in line.split(',')]


class _Reader:
    def __init__(self):
        self.flat = Part('')
        self.parts, self.instances, self.assembly = {}, {}, Part('')
        self.scope = self.around = self.flat
        self.leftOut, self.material, self.materials = [], '', {}  # {(NAME, keyword): (options, rows)}

    def take(self, keyword, options, rows):
        if keyword == 'PART':
            self.scope = self.parts.setdefault(_needed(options, 'NAME').upper(), Part(options['NAME']))
        elif keyword == 'ASSEMBLY':
            self.scope = self.assembly
        elif keyword == 'INSTANCE':
            self._begin(options, rows)
        elif keyword == 'END INSTANCE':
            self.scope = self.around
        elif keyword in ('END PART', 'END ASSEMBLY'):
            self.scope = self.flat
        elif keyword == 'NODE':
            self._addNodes(options, rows)
        elif keyword == 'ELEMENT':
            self._addElements(options, rows)
        elif keyword in ('NSET', 'ELSET'):
            self._addSet(keyword, options, rows)
        elif keyword == 'COHESIVE SECTION':
            self.scope.sections.append((_needed(options, 'ELSET').upper(), options))
        elif keyword in ('MATERIAL', 'SURFACE INTERACTION'):
            self.material = _needed(options, 'NAME').upper() if keyword == 'MATERIAL' else ''
        elif keyword in ('DAMAGE INITIATION', 'DAMAGE EVOLUTION'):
            self.materials[self.material, keyword] = options, rows
        elif keyword in _CHANGES and (rows or keyword != 'SYSTEM'):
            raise ValueError('the keyword *%s, which makes or moves nodes or elements, is not known here: '
                             'write the file without it' % keyword)

    def _begin(self, options, rows):
        name, part = _needed(options, 'NAME'), options.get('PART', '')
        if part.upper() not in self.parts:
            raise ValueError("the instance '%s' is of the part '%s', which is not in the file" % (name, part))
        if name.upper() in self.instances:
            raise ValueError("there are two instances '%s'" % name)
        self.around = self.scope
        self.scope = self.instances[name.upper()] = Part(name, self.parts[part.upper()])
        moves = [[float(one or 0) for one in row] for row in rows if any(row)]
        if len(moves) > 2 or moves[1:] and len(moves[1]) < 7:
            raise ValueError("the place of the instance '%s' is not understood" % name)
        self.scope.moves = moves

    def _addNodes(self, options, rows):
        system = options.get('SYSTEM', 'R').upper()
        if system not in ('R', ''):
            raise ValueError('it has nodes in the system %s, only R is known here' % system)
        for row in rows:
            xyz = [float(one or 0) for one in row[1:4]]
            self.scope.nodes[int(row[0])] = tuple(xyz + [0.] * (3 - len(xyz)))
        if 'NSET' in options:
            self.scope.addSet('NSET', options['NSET'], [(self.scope, int(row[0])) for row in rows])

    def _addElements(self, options, rows):
        type = _needed(options, 'TYPE').upper()
        size = nodesOf(type)
        record, numbers = [], []
        if self.scope is self.assembly:
            self.leftOut.append('the elements of the type %s of the assembly' % type)
            return
        for row in [*rows, None]:
            record += [one for one in row or () if one]
            if row and (len(record) <= size or not size and row[-1] == ''):
                continue  # it goes on in the next line
            if not record:
                break
            number, *nodes = map(int, record)
            if number in self.scope.elements:
                raise ValueError('element %d is there twice' % number)
            if size and len(nodes) != size:
                raise ValueError('element %d of the type %s has %d nodes instead of %d' %
                                 (number, type, len(nodes), size))
            self.scope.elements[number] = type, nodes
            numbers.append((self.scope, number))
            record = []
        if 'ELSET' in options:
            self.scope.addSet('ELSET', options['ELSET'], numbers)

    def _addSet(self, kind, options, rows):
        name, scope = _needed(options, kind), self.scope
        owner = self._instance(options['INSTANCE']) if 'INSTANCE' in options else scope
        members = []
        if kind == 'NSET' and 'ELSET' in options:
            elements = self._members(owner, 'ELSET', options['ELSET'])
            members = [(one, node) for one, number in elements for node in one.elements[number][1]]
        for row in rows:
            row = [one for one in row if one]
            if 'GENERATE' in options:
                first, last, step = map(int, [*row, 1][:3])
                members += [(owner, number) for number in range(first, last + 1, step)]
            else:
                for one in row:
                    members += self._members(owner, kind, one)
        scope.addSet(kind, name, members)

    def _members(self, owner, kind, word):
        """[(part or instance, number)] of a number, a set's name, or both with an instance's."""
        if re.fullmatch(r'\d+', word):
            return [(owner, int(word))]
        if word.upper() in owner.sets[kind]:
            return owner.sets[kind][word.upper()][1]
        head, _, tail = word.partition('.')
        if tail and head.upper() in self.instances:
            return self._members(self._instance(head), kind, tail)
        raise ValueError("a set has the member '%s', which is not in the file before it" % word)

    def _instance(self, name):
        if name.upper() not in self.instances:
            raise ValueError("a set names the instance '%s', which is not in the file before it" % name)
        return self.instances[name.upper()]

    def result(self):
        """Elements of all instances at their places."""
        used = list(self.instances.values())
        for part in self.parts.values():
            if used and part.elements and not any(one.part is part for one in used):
                self.leftOut.append("the part '%s' with %s, of which there is no instance" %
                                    (part.name, counted(len(part.elements), 'element')))
        if not used:
            used = [Part(part.name, part) for part in self.parts.values()]
        return placed([Part('', self.flat), *used], self.assembly, self.materials, self.leftOut)


def _needed(options, name):
    if not options.get(name):
        raise ValueError('a keyword is without the parameter %s' % name)
    return options[name]
