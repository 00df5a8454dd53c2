"""Meshes of Abaqus and CalculiX (.inp): parts, their instances, and sets of both.

A file without parts is one part with one instance at its place.
"""

import os
import re

from yadefrag.io.readers.abaqus_places import Instance, Part, nodesOf, placed
from yadefrag.io.readers.elements import Elements, counted

_CHANGES = ('NGEN', 'NFILL', 'NCOPY', 'NMAP', 'ELGEN', 'ELCOPY', 'SYSTEM', 'PARAMETER')


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
        self.parts, self.instances, self.assembly = {}, {}, None
        self.scope = self.flat
        self.leftOut = []

    def take(self, keyword, options, rows):
        if keyword == 'PART':
            self.scope = self.parts.setdefault(_needed(options, 'NAME').upper(), Part(options['NAME']))
        elif keyword == 'ASSEMBLY':
            self.scope = self.assembly = Part(options.get('NAME', ''))
        elif keyword == 'INSTANCE':
            self._begin(options, rows)
        elif keyword == 'END INSTANCE':
            self.scope = self.assembly or self.flat
        elif keyword in ('END PART', 'END ASSEMBLY'):
            self.scope = self.flat
        elif keyword == 'NODE':
            self._addNodes(options, rows)
        elif keyword == 'ELEMENT':
            self._addElements(options, rows)
        elif keyword in ('NSET', 'ELSET'):
            self._addSet(keyword, options, rows)
        elif keyword in _CHANGES and (rows or keyword != 'SYSTEM'):
            raise ValueError('the keyword *%s, which makes or moves nodes or elements, is not known here: '
                             'write the file without it' % keyword)

    def _begin(self, options, rows):
        name, part = _needed(options, 'NAME'), options.get('PART', '')
        if part.upper() not in self.parts:
            raise ValueError("the instance '%s' is of the part '%s', which is not in the file" % (name, part))
        if name.upper() in self.instances:
            raise ValueError("there are two instances '%s'" % name)
        self.scope = self.instances[name.upper()] = Instance(name, self.parts[part.upper()])
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
            members = [(one, node) for one, number in elements for node in one.all('elements')[number][1]]
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
        for scope in (owner, getattr(owner, 'part', owner)):
            if word.upper() in scope.sets[kind]:
                return [(owner if one is scope else one, n) for one, n in scope.sets[kind][word.upper()][1]]
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
            used = [Instance(part.name, part) for part in self.parts.values()]
        return placed([Instance('', self.flat), *used], self.assembly, self.leftOut)


def _needed(options, name):
    if not options.get(name):
        raise ValueError('a keyword is without the parameter %s' % name)
    return options[name]
