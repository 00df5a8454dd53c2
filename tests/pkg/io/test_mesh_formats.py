"""The table mesh_formats.md: what is read of each format that meshio writes."""
import contextlib
import io
import os
import re

import meshio
import numpy as np
import pytest

from test_mesh_files import areas
from yadefrag import readMesh
from yadefrag.io.readers import by_meshio

kTable = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'mesh_formats.md')
kPoints = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)]
kTriangle6 = [(0, 0), (2, 0), (0, 2), (1, 0), (1, 1), (0, 1)]
kQuad8 = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
kMeshes = {  # {column: (points, cells, area, area of the triangles)}
    'triangles': (kPoints, [('triangle', [[0, 1, 4], [0, 4, 3]])], 1, 1),
    'quads': (kPoints, [('quad', [[0, 1, 4, 3], [1, 2, 5, 4]])], 2, 0),
    'mixed': (kPoints, [('triangle', [[0, 1, 4], [0, 4, 3]]), ('quad', [[1, 2, 5, 4]]),
                        ('line', [[0, 1], [1, 2]])], 2, 1),
    'six nodes': (kTriangle6, [('triangle6', [[0, 1, 2, 3, 4, 5]])], 2, 0),
    'eight nodes': (kQuad8, [('quad8', [[0, 1, 2, 3, 4, 5, 6, 7]])], 4, 0),
    'solid': ([(0, 0), (1, 0), (0, 1)], [('tetra', [[0, 1, 2, 3]])], 0, 0),
}
kRefused = {'none': 'has no triangles', 'solid': 'has elements of the kind', 'flat': 'is flat',
            'time': 'reading did not end', 'library': 'is not a readable mesh'}


def rows():
    with open(kTable, encoding='utf-8') as text:
        table = text.read().split('\n\n')[2]
    lines = [[cell.strip() for cell in line.strip('|').split('|')] for line in table.splitlines()]
    return lines[0][2:], lines[2:]


def writtenBy(folder, format, ending, column):
    """The file's name; None if meshio does not write it."""
    points, cells, _, _ = kMeshes[column]
    spatial = [(*place, 0) for place in points] + ([(0, 0, 1)] if column == 'solid' else [])
    isPlane = format in ('su2', 'xdmf') and column != 'solid'
    file = os.path.join(folder, column.replace(' ', '_') + ending)
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            meshio.Mesh(np.array(points if isPlane else spatial, dtype=float), cells).write(file, file_format=format)
    except Exception:
        return None
    return file


def outcome(file, column):
    try:
        with contextlib.redirect_stdout(io.StringIO()) as said:
            found = areas(readMesh(file))
        assert said.getvalue() == ''
    except ValueError as error:
        assert re.match(r'.*[.]$', str(error)), error
        return next(word for word, part in kRefused.items() if part in str(error))
    assert (found > 0).all()
    _, _, whole, ofTriangles = kMeshes[column]
    return {ofTriangles: 'triangles', whole: 'read'}[round(found.sum(), 9)]


@pytest.mark.parametrize('row', rows()[1], ids=lambda row: row[0])
def test_formatIsAsInTheTable(folder, monkeypatch, row):
    monkeypatch.setattr(by_meshio, '_LONGEST', (3, 0))
    format, ending, *expected = row
    found = []
    for column in rows()[0]:
        file = writtenBy(folder, format, ending, column)
        found.append('-' if file is None else outcome(file, column))
    if found == ['-'] * len(found) and expected != found:
        pytest.skip('a library of this format is missing here')
    assert all(one in cell.split(' or ') for one, cell in zip(found, expected, strict=True)), (found, expected)


def test_tableHasAllFormats():
    from meshio._helpers import _writer_map
    assert sorted(row[0] for row in rows()[1]) == sorted({*_writer_map, 'dgf'})     # dgf: later ones than Debian 12's
