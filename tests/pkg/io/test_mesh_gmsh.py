"""gmsh's versions and groups: names by dimension, elements in several groups or in none."""
import os
import warnings

import meshio
import numpy as np
import pytest

from outline_files import written
from test_mesh_files import areas
from yadefrag import readMesh

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


def test_groupsOfVersionFour(folder):
    mesh = readMesh(written(folder, 'a.msh', kFour))
    assert areas(mesh).tolist() == [.5] * 4 and mesh.leftOut == []
    assert {name: list(of) for name, of in mesh.groups.items()} == {'my steel': [0, 1], 'whole': [0, 1], '7': [0, 1]}
    assert mesh.nodes[mesh.nodeSets['whole']].tolist() == [[2, 0], [2, 1]]
    assert mesh.nodes[mesh.nodeSets['7']].tolist() == [[0, 0], [0, 1]]


def test_materialsOfSeveralGroups(folder):
    """The message's advice helps."""
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
    assert {name: list(of) for name, of in mesh.groups.items()} == {'7': [0, 1], '8': [0]}
    assert mesh.nodes[mesh.nodeSets['7']].tolist() == [[0, 0], [1, 0]]
    with pytest.raises(ValueError, match='element 3 is doubled: it has the corners of element 1'):
        readMesh(written(folder, 'a.msh', two([lines[0], lines[1], lines[2].replace('8', '7')])))


def two(lines):
    return ('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n'
            '$Elements\n%d\n%s\n$EndElements\n' % (len(lines), '\n'.join(lines)))


def test_elementsWithoutTagsAndWithPartitions(folder):
    mesh = readMesh(written(folder, 'a.msh', two(['1 2 0 1 2 3', '2 2 5 4 1 2 1 -2 1 3 4'])))
    assert areas(mesh).tolist() == [.5, .5] and {n: list(g) for n, g in mesh.groups.items()} == {'4': [1]}


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
    with warnings.catch_warnings():
        warnings.simplefilter('ignore')
        meshio.gmsh.write(file, mesh, fmt_version=version, binary=isBinary)
    mesh = readMesh(file)
    assert areas(mesh).tolist() == [.5] * 4
    if version != '4.0':
        assert {name: list(of) for name, of in mesh.groups.items()} == dict(steel=[0, 1], stone=[2, 3])
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
    assert areas(mesh).tolist() == [.5] and {n: list(g) for n, g in mesh.groups.items()} == {'6': [0], '7': [0]}
    assert mesh.nodes[mesh.nodeSets['6']].tolist() == [[0, 0], [1, 0]]


def test_byteOrderMarkAndWindowsLines(folder):
    file = os.path.join(folder, 'a.msh')
    with open(file, 'w', encoding='utf-8-sig', newline='\r\n') as out:
        out.write(kFour.replace('my steel', 'Stähl A'))
    mesh = readMesh(file)
    assert areas(mesh).tolist() == [.5] * 4 and set(mesh.groups) == {'Stähl A', 'whole', '7'}


def test_versionOneIsNamed(folder):
    with pytest.raises(ValueError, match='its version is 1, versions 2 and 4 can be read'):
        readMesh(written(folder, 'a.msh', '$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n0\n$ENDELM\n'))


@pytest.mark.parametrize('old, new, sentence', [
    ('2 2 3 1\n', '2 2 34 1\n', "element 50 has gmsh's type 34, which is unknown"),
    ('50 12 3 6 5', '50 12 3 6 77', 'element 50 has the node 77, which does not exist'),
    ('50 12 3 6 5\n', '', 'a section ends too early'),
    ('$EndElements\n', '', 'section [$]Elements has no end'),
    ('$Nodes', '$Nodos', 'section [$]Nodos has no end'),
    ('4.1 0 8', '5.0 0 8', 'its version is 5.0, versions 2 and 4 can be read'),
    ('$Nodes', '$PartitionedEntities\n0\n$EndPartitionedEntities\n$Nodes', 'it is divided in partitions'),
    ('2 0 0\n0 1 0\n1 1 0', '2 nan 0\n0 1 0\n1 1 0', 'a.msh has points that are not finite'),
])
def test_damagedFilesAreRefused(folder, old, new, sentence):
    assert kFour.count(old) >= 1
    with pytest.raises(ValueError, match=sentence) as error:
        readMesh(written(folder, 'a.msh', kFour.replace(old, new)))
    assert str(error.value).endswith('.') and '\n' not in str(error.value)


@pytest.mark.parametrize('isBinary', [False, True])
def test_everyCutOfAFileIsRefused(folder, isBinary):
    file = os.path.join(folder, 'a.msh')
    meshio.gmsh.write(file, meshio.Mesh([[0., 0, 0], [1, 0, 0], [1, 1, 0]], [('triangle', [[0, 1, 2]])]),
                      fmt_version='4.1', binary=isBinary)
    with open(file, 'rb') as whole:
        data = whole.read()
    end = data.index(b'$EndElements')
    for length in range(25, end, max(1, end // 60)):
        with open(file, 'wb') as cut:
            cut.write(data[:length])
        with pytest.raises(ValueError, match='a.msh is not a readable mesh'):
            readMesh(file)
