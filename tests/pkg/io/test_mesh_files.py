"""Meshes from files: gmsh's groups, sets of other formats, what is no plane mesh."""
import builtins
import os
import sys

import numpy as np
import pytest

from fe_scene import fe
from yade import wrapper as w
from yadefrag import readMesh, rectangleMesh

O = builtins.O
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


def written(folder, name, text):
    file = os.path.join(folder, name)
    with open(file, 'w', encoding='utf-8') as out:
        out.write(text)
    return file


def areas(mesh):
    a, b, c = mesh.nodes[mesh.triangles].transpose(1, 0, 2)
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


def test_gmshGroups(folder):
    mesh = readMesh(written(folder, 'a.msh', kGmsh), scale=.1)
    assert len(mesh.nodes) == 6 and mesh.nodes.max(axis=0) == pytest.approx([.2, .15])
    assert sorted(areas(mesh)) == pytest.approx([.005, .005, .005, .0075])
    assert areas(mesh).sum() == pytest.approx((1 + 1.25) * .01) and (areas(mesh) > 0).all()
    assert {name: sorted(of) for name, of in mesh.groups.items()} == dict(steel=[0, 1], stone=[2, 3])
    assert mesh.nodes[mesh.nodeSets['left']].tolist() == [[0, 0], [0, .1]]
    assert sorted(map(tuple, mesh.nodes[mesh.nodeSets['stone']].round(3).tolist())) == \
        [(.1, 0), (.1, .1), (.2, 0), (.2, .15)]


def test_quadIsCutAlongItsShorterDiagonal(folder):
    mesh = readMesh(written(folder, 'a.msh', kGmsh))
    quad = mesh.nodes[mesh.triangles[mesh.groups['stone']]]
    shared = set(map(tuple, quad[0].tolist())) & set(map(tuple, quad[1].tolist()))
    assert shared == {(2, 0), (1, 1)}  # √2; the other one has √(1 + 1.5²)


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


def test_everyTriangleNeedsOneMaterial(folder):
    mesh = readMesh(written(folder, 'a.msh', kGmsh.replace('3 2 2 1 1 1 4 5', '3 2 2 0 1 1 4 5')))
    with pytest.raises(ValueError, match='triangle 1 is in 0 groups of the mesh'):
        mesh.material


@pytest.mark.parametrize('ending', ['vtu', 'vtk', 'inp', 'mesh'])
def test_otherFormats(folder, ending):
    import meshio
    points = [[0., 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    file = os.path.join(folder, 'a.' + ending)
    meshio.Mesh(points, [('triangle', [[0, 1, 2], [0, 2, 3]])]).write(file)
    mesh = readMesh(file)
    assert mesh.nodes.tolist() == [p[:2] for p in points] and areas(mesh).tolist() == [.5, .5]
    assert mesh.groups == {} and mesh.nodeSets == {}


def test_setsOfAbaqus(folder):
    file = written(folder, 'a.inp', '*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n'
                   '*ELEMENT, TYPE=CPS3, ELSET=low\n1, 1, 2, 3\n'
                   '*ELEMENT, TYPE=CPS3, ELSET=high\n2, 1, 3, 4\n*NSET, NSET=base\n1, 2\n')
    mesh = readMesh(file)
    assert mesh.nodes[mesh.nodeSets['base']].tolist() == [[0, 0], [1, 0]]
    assert mesh.material[0] == ['low', 'high'] and mesh.material[1].tolist() == [0, 1]


def test_trianglesOfSecondOrderCountByTheirCorners(folder):
    import meshio
    points = [[0, 0], [2, 0], [0, 2], [1, 0], [1, 1], [0, 1]]
    file = os.path.join(folder, 'a.msh')
    meshio.Mesh([p + [0] for p in points], [('triangle6', [[0, 1, 2, 3, 4, 5]])]).write(
        file, file_format='gmsh22')
    mesh = readMesh(file)
    assert mesh.nodes.tolist() == [[0, 0], [2, 0], [0, 2]] and areas(mesh).tolist() == [2]


@pytest.mark.parametrize('name, text, sentence', [
    ('a.msh', kGmsh.replace('6 2 1.5 5', '6 2 1.5 6'), 'a.msh is no plane mesh: z goes from 5 to 6'),
    ('a.msh', kGmsh.replace('4 3 2 2 2 2 3 6 5', '4 4 2 2 2 2 3 6 5'),
     "a.msh has elements of the kind 'tetra'"),
    ('a.msh', 'nothing', 'a.msh is not a readable mesh'),
    ('a.abc', '', 'a.abc is not a readable mesh'),
    ('a.inp', '*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n', 'a.inp has no triangles'),
])
def test_wrongFilesAreRefusedInOneSentence(folder, name, text, sentence):
    with pytest.raises(ValueError, match=sentence) as error:
        readMesh(written(folder, name, text))
    assert str(error.value).endswith('.') and '\n' not in str(error.value)


def test_missingLibraryAndFile(folder, monkeypatch):
    with pytest.raises(FileNotFoundError, match='nowhere.msh'):
        readMesh(folder + '/nowhere.msh')
    monkeypatch.setitem(sys.modules, 'meshio', None)
    with pytest.raises(ImportError, match="install Debian's package python3-meshio[.]"):
        readMesh(written(folder, 'a.vtk', 'nothing'))


def test_pointsOfThreeColumnsGoIntoAddTriangles():
    nodes, triangles = rectangleMesh((0, 0), (1, 2), 3, 5)
    solver = fe()
    solver.addTriangles(np.column_stack([nodes, np.full(len(nodes), 7.)]), triangles, material='m')
    assert (solver.nodes == nodes).all()
    with pytest.raises(ValueError, match=r'^nodes must be a list of points \(x, y\) in m'):
        solver.addTriangles(np.column_stack([nodes, np.arange(len(nodes))]), triangles, material='m')
