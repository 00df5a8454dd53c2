"""Meshes from files: gmsh's versions and groups, names by dimension, elements in several groups or in none; sets of other
formats; what is no plane mesh. The table mesh_formats.md: what is read of each format that meshio writes. Cohesive elements that are no joints."""
import contextlib
import io
import os
import pathlib
import re
import sys
import warnings

import meshio
import numpy as np
import pytest

from fe_scene import fe, O
from outline_files import areas, glued, lists, refusesMesh, written
from yade import wrapper as w
from yadefrag import readMesh
from yadefrag.io.readers import gmsh

# A strip of 2 × 1 squares: one cut in triangles (steel, the second clockwise), one a quad (stone);
# a line at the left, a point in the middle that no triangle uses.
kGmsh = '''$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 7 "left"
2 1 "steel"
2 2 "stone"
$EndPhysicalNames
$Nodes
7
1 0 0 5
2 1 0 5
3 2 0 5
4 0 1 5
5 1 1 5
6 2 1.5 5
9 .5 .5 5
$EndNodes
$Elements
4
1 1 2 7 1 1 4
2 2 2 1 1 1 2 5
3 2 2 1 1 1 4 5
4 3 2 2 2 2 3 6 5
$EndElements
'''
kTable = pathlib.Path(__file__).with_name('mesh_formats.md')
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
# Squares [0, 1] and [1, 2]: surface 1 in two groups, surface 2 in none; the left side in a group without a name,
# whose number is also a surface's; the right side in a group named like the second group of surface 1.
kFour = '''$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 9 "whole"
2 8 "whole"
2 4 "my steel"
$EndPhysicalNames
$Entities
1 2 2 0
1 0 0 0 0
1 0 0 0 0 1 0 1 7 2 1 -1
2 2 0 0 2 1 0 1 9 0
1 0 0 0 1 1 0 3 4 -8 7 1 1
2 1 0 0 2 1 0 0 0
$EndEntities
$Nodes
2 6 1 12
0 1 0 1
1
0 0 0
2 1 0 5
12
3
4
5
6
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
4 7 1 50
1 1 1 1
20 1 4
1 2 1 1
21 3 6
2 1 2 2
30 1 12 5
31 1 5 4
2 2 3 1
50 12 3 6 5
$EndElements
'''


def test_gmshGroups(folder):
    """And a quad that is cut along its shorter diagonal."""
    mesh = readMesh(written(folder, 'a.msh', kGmsh), scale=.1)
    assert len(mesh.nodes) == 6 and mesh.nodes.max(axis=0) == pytest.approx([.2, .15])
    assert sorted(areas(mesh)) == pytest.approx([.005, .005, .005, .0075])
    assert areas(mesh).sum() == pytest.approx((1 + 1.25) * .01) and (areas(mesh) > 0).all()
    assert {name: sorted(of) for name, of in mesh.groups.items()} == dict(steel=[0, 1], stone=[2, 3])
    assert mesh.nodes[mesh.nodeSets['left']].tolist() == [[0, 0], [0, .1]]
    assert sorted(mesh.nodes[mesh.nodeSets['stone']].round(3).tolist()) == [[.1, 0], [.1, .1], [.2, 0], [.2, .15]]
    quad = mesh.nodes[mesh.triangles[mesh.groups['stone']]].round(9)
    shared = set(map(tuple, quad[0].tolist())) & set(map(tuple, quad[1].tolist()))
    assert shared == {(.2, 0), (.1, .1)}  # √2; the other one has √(1 + 1.5²)


def test_meshGoesIntoAddTriangles(folder):
    mesh = readMesh(written(folder, 'a.msh', kGmsh))
    solver = fe()
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=3000, label='stone'))
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=8000, label='steel'))
    solver.addPolygon([(9, 0), (10, 0), (10, 1)], size=1, material='m')
    first = len(solver.masses), solver.masses.sum()
    body = solver.addTriangles(mesh.nodes, mesh.triangles, material=mesh.material)
    assert solver.masses.sum() - first[1] == pytest.approx(8000 + 1.25 * 3000)
    nodes = solver.nodesOf(body)
    assert nodes[0] == first[0]
    assert solver.nodes[nodes[mesh.nodeSets['left']]].tolist() == [[0, 0], [0, 1]]


@pytest.mark.parametrize('name, text, sentence', [
    ('a.msh', kGmsh.replace('6 2 1.5 5', '6 2 1.5 6'), 'a.msh is no plane mesh: z goes from 5 to 6'),
    ('a.msh', kGmsh.replace('4 3 2 2 2 2 3 6 5', '4 4 2 2 2 2 3 6 5'), "a.msh has elements of the kind 'tetra'"),
    ('a.msh', 'nothing', 'a.msh is not a readable mesh'),
    ('a.abc', '', 'a.abc is not a readable mesh'),
    ('a.inp', '*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n', 'a.inp has no triangles'),
    ('a.msh', '$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n0\n$ENDELM\n', 'its version is 1, versions 2 and 4 can be read'),
    ('a.msh', kFour.replace('2 2 3 1\n', '2 2 34 1\n'), "element 50 has gmsh's type 34, which is unknown"),
    ('a.msh', kFour.replace('50 12 3 6 5', '50 12 3 6 77'), 'element 50 has the node 77, which does not exist'),
    ('a.msh', kFour.replace('50 12 3 6 5\n', ''), 'a section ends too early'),
    ('a.msh', kFour.replace('$EndElements\n', ''), 'section [$]Elements has no end'),
    ('a.msh', kFour.replace('$Nodes', '$Nodos'), 'section [$]Nodos has no end'),
    ('a.msh', kFour.replace('4.1 0 8', '5.0 0 8'), 'its version is 5.0, versions 2 and 4 can be read'),
    ('a.msh', kFour.replace('$Nodes', '$PartitionedEntities\n0\n$EndPartitionedEntities\n$Nodes'), 'it is divided in partitions'),
    ('a.msh', kFour.replace('2 0 0\n0 1 0\n1 1 0', '2 nan 0\n0 1 0\n1 1 0'), 'a.msh has points that are not finite'),
    *[('a.inp', glued(order=(0, 1, 3, 2), gap=gap), r'element 47 \(COH2D4\) has its nodes in a wrong order: its sides cross')
      for gap in (0, 1e-3)],
    ('a.inp', glued(cohesive='COHAX4'), r'it has axisymmetric elements \(COHAX4\) and plane ones \(CPE4\)'),
    ('a.inp', glued(plane='CAX4'), r'it has axisymmetric elements \(CAX4\) and plane ones \(COH2D4\)'),
])
def test_wrongFilesAreRefusedInOneSentence(folder, name, text, sentence):
    refusesMesh(folder, name, text, sentence)


def test_missingLibrary(folder, monkeypatch):
    monkeypatch.setitem(sys.modules, 'meshio', None)
    with pytest.raises(ImportError, match="install Debian's package python3-meshio[.]"):
        readMesh(written(folder, 'a.vtk', 'nothing'))


def rows():
    table = kTable.read_text(encoding='utf-8').split('\n\n')[2]
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
            mesh = readMesh(file)
        assert said.getvalue() == ''
    except ValueError as error:
        assert re.match(r'.*[.]$', str(error)), error
        return next(word for word, part in kRefused.items() if part in str(error))
    points, _, whole, ofTriangles = kMeshes[column]
    assert {*map(tuple, mesh.nodes.round(9).tolist())} <= {*points} and mesh.nodeSets == {}
    found = areas(mesh)
    assert (found > 0).all()
    return {ofTriangles: 'triangles', whole: 'read'}[round(found.sum(), 9)]


@pytest.mark.parametrize('row', rows()[1], ids=lambda row: row[0])
def test_formatIsAsInTheTable(folder, monkeypatch, row):
    monkeypatch.setattr(gmsh, '_LONGEST', (3, 0))
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


def test_groupsOfVersionFour(folder):
    mesh = readMesh(written(folder, 'a.msh', kFour))
    assert areas(mesh).tolist() == [.5] * 4 and mesh.leftOut == []
    assert lists(mesh.groups) == {'my steel': [0, 1], 'whole': [0, 1], '7': [0, 1]}
    assert mesh.nodes[mesh.nodeSets['whole']].tolist() == [[2, 0], [2, 1]]
    assert mesh.nodes[mesh.nodeSets['7']].tolist() == [[0, 0], [0, 1]]


def test_everyTriangleNeedsOneMaterial(folder):
    """Of a triangle in several groups: the message's advice helps."""
    mesh = readMesh(written(folder, 'a.msh', kGmsh.replace('3 2 2 1 1 1 4 5', '3 2 2 0 1 1 4 5')))
    with pytest.raises(ValueError, match='triangle 1 is in 0 groups of the mesh'):
        mesh.material
    mesh = readMesh(written(folder, 'a.msh', kFour.replace('2 1 0 0 2 1 0 0 0\n', '2 1 0 0 2 1 0 1 4 0\n')))
    for _ in range(2):
        with pytest.raises(ValueError, match=r"triangle 0 is in [32] groups of the mesh \('.*'\), it must be in one "
                           r'to have a material; `del mesh.groups\[(.*)\]` removes one') as error:
            mesh.material
        del mesh.groups[str(error.value).split('groups[')[1].split(']')[0].strip("'")]
    assert mesh.material[0] == ['my steel'] and mesh.material[1].tolist() == [0] * 4


def test_elementOfTwoGroupsOfVersionTwo(folder):
    """This version has such an element twice, with two numbers."""
    lines = ['1 2 2 7 1 1 2 3', '2 2 2 7 1 1 3 4', '3 2 2 8 1 1 2 3', '4 1 2 7 1 1 2']
    mesh = readMesh(written(folder, 'a.msh', two(lines)))
    assert areas(mesh).tolist() == [.5, .5]
    assert lists(mesh.groups) == {'7': [0, 1], '8': [0]}
    assert mesh.nodes[mesh.nodeSets['7']].tolist() == [[0, 0], [1, 0]]
    with pytest.raises(ValueError, match='element 3 is doubled: it has the corners of element 1'):
        readMesh(written(folder, 'a.msh', two([lines[0], lines[1], lines[2].replace('8', '7')])))


def two(lines):
    return ('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n'
            '$Elements\n%d\n%s\n$EndElements\n' % (len(lines), '\n'.join(lines)))


def test_elementsWithoutTagsAndWithPartitions(folder):
    mesh = readMesh(written(folder, 'a.msh', two(['1 2 0 1 2 3', '2 2 5 4 1 2 1 -2 1 3 4'])))
    assert areas(mesh).tolist() == [.5, .5] and lists(mesh.groups) == {'4': [1]}


@pytest.mark.parametrize('version', ['2.2', '4.0', '4.1'])
@pytest.mark.parametrize('isBinary', [False, True])
def test_versionsInTextAndBinary(folder, version, isBinary):
    """Written by meshio, which writes no groups in version 4.0."""
    file = os.path.join(folder, 'a.msh')
    points = np.array([[0., 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]])
    cells = [('line', [[0, 3]]), ('triangle', [[0, 1, 2], [0, 2, 3]]), ('quad', [[1, 4, 5, 2]])]
    tags = {'gmsh:physical': [np.array([3]), np.array([1, 1]), np.array([2])],
            'gmsh:geometrical': [np.array([1]), np.array([1, 1]), np.array([2])]}
    entities = {'gmsh:dim_tags': np.array([[1, 1], [2, 1], [2, 1], [1, 1], [2, 2], [2, 2]])}
    names = {'left': np.array([3, 1]), 'steel': np.array([1, 2]), 'stone': np.array([2, 2])}
    mesh = meshio.Mesh(points, cells, cell_data={} if version == '4.0' else tags, field_data=names,
                       point_data=entities if version == '4.1' else {})
    with warnings.catch_warnings(action='ignore'):
        meshio.gmsh.write(file, mesh, fmt_version=version, binary=isBinary)
    mesh = readMesh(file)
    assert areas(mesh).tolist() == [.5] * 4
    if version != '4.0':
        assert lists(mesh.groups) == dict(steel=[0, 1], stone=[2, 3])
        assert sorted(mesh.nodes[mesh.nodeSets['left']].tolist()) == [[0, 0], [0, 1]]


def test_groupsOfVersionFourDotZero(folder):
    mesh = readMesh(written(folder, 'a.msh', '''$MeshFormat
4.0 0 8
$EndMeshFormat
$Entities
1 1 1 0
3 0 0 0 0 0 0 0
4 0 0 0 1 0 0 1 6 2 3 -3
5 0 0 0 1 1 0 2 6 7 1 4
$EndEntities
$Nodes
2 3
3 0 0 1
8 0 0 0
5 2 0 2
9 1 0 0
4 1 1 0
$EndNodes
$Elements
2 2
4 1 1 1
1 8 9
5 2 2 1
2 8 9 4
$EndElements
'''))
    assert areas(mesh).tolist() == [.5] and lists(mesh.groups) == {'6': [0], '7': [0]}
    assert mesh.nodes[mesh.nodeSets['6']].tolist() == [[0, 0], [1, 0]]


def test_byteOrderMarkAndWindowsLines(folder):
    file = pathlib.Path(folder, 'a.msh')
    file.write_text(kFour.replace('my steel', 'Stähl A'), encoding='utf-8-sig', newline='\r\n')
    mesh = readMesh(file)
    assert areas(mesh).tolist() == [.5] * 4 and set(mesh.groups) == {'Stähl A', 'whole', '7'}


@pytest.mark.parametrize('isBinary', [False, True])
def test_everyCutOfAFileIsRefused(folder, isBinary):
    file = os.path.join(folder, 'a.msh')
    meshio.gmsh.write(file, meshio.Mesh([[0., 0, 0], [1, 0, 0], [1, 1, 0]], [('triangle', [[0, 1, 2]])]),
                      fmt_version='4.1', binary=isBinary)
    data = pathlib.Path(file).read_bytes()
    end = data.index(b'$EndElements')
    for length in range(25, end, max(1, end // 60)):
        pathlib.Path(file).write_bytes(data[:length])
        with pytest.raises(ValueError, match='a.msh is not a readable mesh'):
            readMesh(file)


@pytest.mark.parametrize('old, new, order, words', [
    ('TRACTION SEPARATION', 'CONTINUUM', (0, 1, 2, 3), 'in no [*]COHESIVE SECTION of the response TRACTION SEPARATION'),
    ('joint, mat', 'other, mat', (0, 1, 2, 3), 'in no [*]COHESIVE SECTION of the response TRACTION SEPARATION'),
    *[('', '', order, 'without a triangle or quad on each side') for order in ((0, 1, 1, 0), (0, 3, 1, 2))],
    *[(*both, (0, 1, 2, 3), "of the material 'Glue' without one strength .MAXS, QUADS. and one energy above 0")
      for both in (('=QUADS', '=QUADE'), ('=ENERGY', '=DISPLACEMENT'), ('30.,', '0.'), ('3e6, 3e6, 3e6', '-1'))]])
def test_cohesiveElementsThatAreNoJointsAreTold(folder, old, new, order, words):
    with pytest.warns(UserWarning, match='left out are 4 elements of the type COH2D4 %s, which connect parts' % words):
        mesh = readMesh(written(folder, 'a.inp', glued(order=order).replace(old, new)))
    assert len(mesh.nodes) == 30 and len(mesh.joints) == len(mesh.jointStrength) == 0
