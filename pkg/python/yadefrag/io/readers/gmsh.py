"""Meshes of gmsh (.msh), versions 2 and 4, text or binary: with the numbers of elements, elements in
several groups, and groups of one name and several dimensions. Meshes of all other formats that the library meshio
reads."""

from __future__ import annotations

import concurrent.futures
import contextlib
import ctypes
import io
import os
import re
import threading

import numpy

from yadefrag.io.readers import Elements, cornersOf, needed

_KINDS = {
    1: 'line2', 2: 'triangle3', 3: 'quad4', 4: 'tetra4', 5: 'hexahedron8', 6: 'wedge6', 7: 'pyramid5', 8: 'line3',
    9: 'triangle6', 10: 'quad9', 11: 'tetra10', 12: 'hexahedron27', 13: 'wedge18', 14: 'pyramid14', 15: 'vertex1',
    16: 'quad8', 17: 'hexahedron20', 18: 'wedge15', 19: 'pyramid13', 20: 'triangle9', 21: 'triangle10',
    22: 'triangle12', 23: 'triangle15', 24: 'triangle15', 25: 'triangle21', 26: 'line4', 27: 'line5', 28: 'line6',
    29: 'tetra20', 30: 'tetra35', 31: 'tetra56', 36: 'quad16', 37: 'quad25', 38: 'quad36', 39: 'quad12', 40: 'quad16',
    41: 'quad20', 42: 'triangle28', 43: 'triangle36', 47: 'quad49', 48: 'quad64', 62: 'line7', 63: 'line8'}

_HEAD = re.compile(rb'\s*(?:\$Comments.*?\$EndComments\s*)*'
                   rb'\$MeshFormat\s+([\d.]+)\s+(\d)\s+(\d+)[^\n]*\n(....)?', re.DOTALL)
_LONGEST = 30, 3e-5  # s, and s for each byte: some of meshio's readers never end for an incomplete file


class _Numbers:
    """The numbers of one section, in text or binary, one after the other."""

    def __init__(self, data, order):
        self._order = order  # '<' or '>', None for text
        self._place = 0
        self._data = data if order else numpy.array(data.split(), dtype=float)

    def take(self, kind, count):
        """`count` numbers: 'i4', 'u8' or 'f8'."""
        found, = self.rows([kind], count)
        return found if kind == 'f8' else found.astype(numpy.int64)

    def rows(self, kinds, count):
        """[(count) numbers] of a table whose columns have these kinds."""
        row = numpy.dtype([(str(i), (self._order or '') + kind) for i, kind in enumerate(kinds)])
        width = row.itemsize if self._order else len(kinds)
        size = int(count) * width
        data = self._data[self._place:self._place + size]
        self._place += size
        if size < 0 or len(data) != size:
            raise ValueError('a section ends too early')
        if self._order is None:
            return list(data.reshape(-1, width).T)
        found = numpy.frombuffer(data, row)
        return [found[str(i)] for i in range(len(kinds))]


def read(name: str) -> Elements:
    """Elements; a file of another format with this ending is left to meshio."""
    with open(name, 'rb') as file:
        data = file.read().removeprefix(b'\xef\xbb\xbf')
    head = _HEAD.match(data)
    if data.lstrip().startswith(b'$NOD'):
        raise ValueError('its version is 1, versions 2 and 4 can be read')
    if not head:
        return readByMeshio(name)
    version, isBinary = head[1].decode(), head[2] == b'1'
    order = ('<' if head[4][:1] == b'\1' else '>') if isBinary else None
    sections = _sections(data)
    for one in ('Nodes', 'Elements'):
        if one not in sections:
            raise ValueError('it has no section $%s' % one)
    if 'PartitionedEntities' in sections:
        raise ValueError('it is divided in partitions, save it without them')
    names = _names(sections.get('PhysicalNames', b''))
    if version.startswith('2'):
        count, _, rest = sections['Nodes'].partition(b'\n')
        tags, *xyz = _Numbers(rest, order).rows(('i4', 'f8', 'f8', 'f8'), int(count))
        points, tags = numpy.stack(xyz, axis=1), tags.astype(numpy.int64)
        found = _elements2(sections['Elements'], order)
    elif version.startswith('4'):
        isOld = version == '4.0'
        entities = _entities4(sections['Entities'], order, isOld) if 'Entities' in sections else {}
        points, tags = _nodes4(sections['Nodes'], order, isOld)
        found = _elements4(sections['Elements'], order, isOld, entities)
    else:
        raise ValueError('its version is %s, versions 2 and 4 can be read' % version)
    return _together(points, tags, found, names)


def _sections(data):
    """{name: bytes}. Binary data are skipped as a whole, up to the section's own end."""
    found, place = {}, 0
    while True:
        begin = re.compile(rb'^\$(\w+)[^\S\n]*\r?\n', re.MULTILINE).search(data, place)
        if not begin:
            return found
        end = data.find(b'$End' + begin[1], begin.end())
        if end < 0:
            raise ValueError('section $%s has no end' % begin[1].decode())
        found.setdefault(begin[1].decode(), data[begin.end():end])
        place = end + 4 + len(begin[1])


def _names(section):
    """{(dimension, tag): name}"""
    lines = re.findall(r'^\s*(\d+)\s+(-?\d+)\s+"([^"\n]*)"', section.decode('utf-8', 'replace'), re.MULTILINE)
    return {(int(dimension), int(tag)): name for dimension, tag, name in lines}


def _kind(type, label):
    if type not in _KINDS:
        raise ValueError("element %d has gmsh's type %d, which is unknown" % (label, type))
    kind = _KINDS[type]
    return kind, int(re.sub(r'^\D+', '', kind))


# --- version 2: each element has its tags, the first one is its group

def _elements2(section, order):
    """[(kind, label, groups, tags of nodes)]; elements that differ by their group only are one."""
    count, _, rest = section.partition(b'\n')
    rows = _textRows2(rest) if order is None else _binaryRows2(rest, order, int(count))
    found, same = [], {}
    for label, type, tags, nodes in rows:
        kind, size = _kind(type, label)
        if len(nodes) != size:
            raise ValueError('element %d has %d nodes instead of %d' % (label, len(nodes), size))
        group = abs(tags[0]) if len(tags) else 0
        groups = [group] if group else []
        key = (kind, tuple(sorted(nodes)))
        if groups and key in same and not set(groups) & set(same[key]):
            same[key] += groups
            continue
        same[key] = groups
        found.append((kind, label, groups, nodes))
    if order is None and len(rows) != int(count):
        raise ValueError('it has %d elements instead of %d' % (len(rows), int(count)))
    return found


def _textRows2(text):
    rows = []
    for line in text.splitlines():
        words = list(map(int, line.split()))
        if not words:
            continue
        if len(words) < 3 or not 0 <= words[2] <= len(words) - 3:
            raise ValueError('a line of $Elements is incomplete')
        rows.append((words[0], words[1], words[3:3 + words[2]], words[3 + words[2]:]))
    return rows


def _binaryRows2(data, order, count):
    numbers, rows = _Numbers(data, order), []
    while len(rows) < count:
        type, many, tags = map(int, numbers.take('i4', 3))
        size = 1 + tags + _kind(type, len(rows) + 1)[1]
        for row in numbers.take('i4', many * size).reshape(many, size).tolist():
            rows.append((row[0], type, row[1:1 + tags], row[1 + tags:]))
    return rows


# --- version 4: elements belong to entities of the geometry, which have any number of groups

def _entities4(section, order, isOld):
    """{(dimension, tag): groups}"""
    numbers, groups = _Numbers(section, order), {}
    for dimension, count in enumerate(numbers.take('u8', 4)):
        for _ in range(count):
            tag = int(numbers.take('i4', 1)[0])
            numbers.take('f8', 3 if dimension == 0 and not isOld else 6)  # its box
            own = numbers.take('i4', numbers.take('u8', 1)[0])
            groups[dimension, tag] = sorted({abs(group) for group in own.tolist()})
            if dimension > 0:
                numbers.take('i4', numbers.take('u8', 1)[0])  # its boundary
    return groups


def _nodes4(section, order, isOld):
    numbers = _Numbers(section, order)
    blocks = int(numbers.take('u8', 2 if isOld else 4)[0])
    points, tags = [numpy.zeros((0, 3))], [numpy.zeros(0, dtype=numpy.int64)]
    for _ in range(blocks):
        first, second, hasParameters = map(int, numbers.take('i4', 3))
        count = int(numbers.take('u8', 1)[0])
        width = 3 + hasParameters * (second if isOld else first)
        if isOld:
            tag, *xyz = numbers.rows(('i4', *['f8'] * width), count)
            tags.append(tag.astype(numpy.int64))
            points.append(numpy.stack(xyz[:3], axis=1))
        else:
            tags.append(numbers.take('u8', count))
            points.append(numbers.take('f8', width * count).reshape(count, width)[:, :3])
    return numpy.concatenate(points), numpy.concatenate(tags)


def _elements4(section, order, isOld, entities):
    numbers, found = _Numbers(section, order), []
    blocks = int(numbers.take('u8', 2 if isOld else 4)[0])
    for _ in range(blocks):
        first, second, type = map(int, numbers.take('i4', 3))
        count = int(numbers.take('u8', 1)[0])
        entity = (second, first) if isOld else (first, second)
        if not count:
            continue
        whole = 'i4' if isOld else 'u8'
        label = int(numbers.take(whole, 1)[0])
        kind, size = _kind(type, label)
        rest = numbers.take(whole, count * (1 + size) - 1)
        rows = numpy.concatenate([[label], rest]).reshape(count, 1 + size)
        groups = entities.get(entity, [])
        found += [(kind, row[0], groups, row[1:]) for row in rows.tolist()]
    return found


# --- both

def _together(points, tags, found, names):
    place = dict(zip(tags.tolist(), range(len(tags))))
    blocks, groups, markers = {}, {}, {}
    for number, (kind, label, own, nodes) in enumerate(found):
        for one in nodes:
            if one not in place:
                raise ValueError('element %d has the node %d, which does not exist' % (label, one))
        rows, numbers = blocks.setdefault(kind, ([], []))
        rows.append([place[one] for one in nodes])
        numbers.append(number)
        dimension = {1: 0, 2: 1, 3: 2, 4: 2}.get(cornersOf(kind), 3)
        for tag in own:
            name = names.get((dimension, tag), '%d' % tag)
            (markers if dimension < 2 else groups).setdefault(name, []).append(number)
    return Elements(points, [(kind, numpy.array(rows), numpy.array(numbers))
                             for kind, (rows, numbers) in blocks.items()],
                    [label for _, label, _, _ in found], groups, markers)


# --- other formats

def readByMeshio(name: str) -> Elements:
    """Elements of any format that the library meshio reads; ImportError without the library, ValueError for a file that
    it cannot read."""
    meshio = needed('meshio', 'python3-meshio', name)
    told = io.StringIO()
    try:
        # meshio prints why it cannot read a file, and ends the process.
        with contextlib.redirect_stdout(told), contextlib.redirect_stderr(told):
            mesh = _inTime(lambda: meshio.read(name), _LONGEST[0] + _LONGEST[1] * os.path.getsize(name))
    except KeyError as error:
        raise ValueError(_cause(told) or 'it has %s, which meshio does not know' % error) from None
    except SystemExit:
        raise ValueError(_cause(told) or 'its contents do not match its ending') from None
    except Exception as error:
        raise ValueError(_cause(told) or str(error) or type(error).__name__) from None
    blocks, count = [], 0
    for cells in mesh.cells:
        kind = cells.type + str(len(cells.data[0])) if cells.type == 'polygon' else cells.type
        blocks.append((kind, cells.data, numpy.arange(count, count + len(cells.data))))
        count += len(cells.data)
    starts = numpy.cumsum([0] + [len(cells.data) for cells in mesh.cells])
    groups = {}
    for group, parts in mesh.cell_sets.items():
        groups[group] = numpy.concatenate([start + numpy.asarray(part, dtype=int) for start, part in
                                           zip(starts, parts) if part is not None] or [[]]).astype(int)
    sets = {key: numpy.asarray(nodes, dtype=int).ravel() for key, nodes in mesh.point_sets.items()}
    return Elements(mesh.points, blocks, list(range(count)), groups, nodeSets=sets, leftOut=_told(told))


def _inTime(function, seconds):
    """What `function()` returns or raises; TimeoutError if it takes longer, and then it is ended."""
    future: concurrent.futures.Future = concurrent.futures.Future()

    def work():
        try:
            future.set_result(function())
        except BaseException as error:
            future.set_exception(error)

    thread = threading.Thread(target=work, daemon=True)  # an executor would wait for it at the end of Python
    thread.start()
    try:
        return future.result(seconds)
    except TimeoutError:
        raise TimeoutError('reading did not end within %.0f s, the file may be incomplete' % seconds) from None
    finally:
        if not future.done():
            ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident or 0), ctypes.py_object(SystemExit))


def _told(text):
    """What meshio printed, without colours and marks; one line for each message."""
    plain = re.sub(r'\x1b\[[\d;]*m', '', text.getvalue())
    parts = re.split(r'^(?:Warning|Info|Error):', plain, flags=re.MULTILINE)
    return [' '.join(part.split()).rstrip('.') for part in parts if part.strip()]


def _cause(text):
    told = [one for one in _told(text) if not one.startswith("Couldn't read file")]
    return told[0].split(" Couldn't read file")[0] if told else ''
