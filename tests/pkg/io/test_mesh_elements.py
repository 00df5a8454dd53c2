"""Elements of mesh files that are no proper ones: each is named by its number in the file and the cause. Parts of
one mesh without common nodes: they may touch, but not overlap."""
import builtins
import math
import random
import warnings

import numpy as np
import pytest

from fe_scene import fe
from outline_files import written
from test_mesh_files import areas
from yadefrag import readMesh, rectangleMesh

kPlaces = {1: (0, 0), 2: (1, 0), 3: (2, 0), 4: (0, 1), 5: (1, 1), 6: (2, 1), 7: (1, .6), 8: (1, 0), 9: (.3, .2),
           10: (.5, 0)}
kKinds = {2: '1', 3: '2', 4: '3', 6: '9', 8: '16'}  # gmsh's, by the number of nodes
kAbaqus = {3: 'CPS3', 4: 'CPE4', 6: 'CPS6', 8: 'CPS8'}
O = builtins.O
kSentence = 'two parts of the mesh, without common nodes, overlap at'


def gmsh(elements):
    """A file with elements {number: nodes}."""
    lines = ['$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$Nodes', '%d' % len(kPlaces)]
    lines += ['%d %r %r 0' % (number, *place) for number, place in kPlaces.items()]
    lines += ['$EndNodes', '$Elements', '%d' % len(elements)]
    lines += ['%d %s 2 0 1 %s' % (number, kKinds[len(nodes)], ' '.join(map(str, nodes)))
              for number, nodes in elements.items()]
    return '\n'.join([*lines, '$EndElements', ''])


def abaqus(elements):
    lines = ['*Node', *('%d, %r, %r' % (number, *place) for number, place in kPlaces.items())]
    for number, nodes in elements.items():
        lines += ['*Element, type=%s' % kAbaqus[len(nodes)], ', '.join(map(str, [number, *nodes]))]
    return '\n'.join([*lines, ''])


@pytest.fixture(params=[('a.msh', gmsh), ('a.inp', abaqus)], ids=['gmsh', 'abaqus'])
def read(request, folder):
    name, text = request.param
    return lambda elements: readMesh(written(folder, name, text(elements)))


@pytest.mark.parametrize('elements, sentence', [
    ({11: (1, 2, 5), 14: (1, 2, 3)}, r'element 14 is flat: its corners \(0, 0\), \(1, 0\), \(2, 0\) are on a line'),
    ({11: (1, 2, 5), 14: (4, 5, 5)}, r'element 14 is flat: its corners'),
    ({11: (1, 2, 5), 14: (2, 8, 6)}, r'element 14 is flat: its corners \(1, 0\), \(1, 0\)'),
    ({11: (1, 2, 5), 12: (2, 3, 5), 14: (5, 1, 2)}, 'element 14 is doubled: it has the corners of element 11'),
    ({11: (1, 2, 5, 4), 14: (5, 4, 1, 2)}, 'element 14 is doubled: it has the corners of element 11'),
    ({11: (1, 2, 5, 4), 14: (1, 2, 5)}, 'element 14 (is doubled|overlaps)'),
    ({11: (1, 3, 6, 4), 14: (4, 6, 7, 1)}, r'element 14 is a concave quad: .* inwards at \(1, 0.6\)'),
    ({11: (1, 2, 5, 4), 14: (2, 6, 3, 5)}, r'element 14 is a quad whose sides cross, near \(1, 0\)'),
    ({11: (1, 2, 5, 4), 14: (2, 8, 6, 5)}, 'element 14 is a collapsed quad'),
    ({11: (1, 2, 5, 4), 14: (1, 10, 2, 3)}, 'element 14 is a collapsed quad'),
    ({11: (1, 2, 4), 12: (2, 5, 4), 14: (2, 9, 4)}, r'element 14 .*element 1[12], on the same side'),
    ({11: (1, 2, 9), 12: (2, 5, 9), 13: (5, 4, 9), 14: (1, 4, 9), 15: (1, 2, 4)}, 'element 15 overlaps element'),
])
def test_wrongElementsAreNamed(read, elements, sentence):
    with pytest.raises(ValueError, match=sentence) as error:
        read(elements)
    assert str(error.value).count('\n') == 0 and str(error.value).endswith('that wrote the file.')


def test_invertedElementIsNamed(read):
    """Its inner node 7 lies beyond the opposite side, so that its corners are clockwise."""
    kPlaces[7] = (1.2, 1.3)
    try:
        with pytest.raises(ValueError, match='element 13 is inverted: .* overlaps element 1[24]'):
            read({11: (1, 3, 7), 12: (3, 6, 7), 13: (6, 4, 7), 14: (4, 1, 7)})
    finally:
        kPlaces[7] = (1, .6)


def test_oneSentenceCountsAllOfAKind(read):
    with pytest.raises(ValueError, match='element 12 is flat: .*; so are 2 others. Correct'):
        read({11: (1, 2, 5), 12: (1, 2, 3), 13: (4, 5, 6), 14: (1, 2, 10)})


def test_clockwiseElementsAreReversed(read):
    assert areas(read({11: (1, 5, 2), 12: (2, 5, 6, 3)})).tolist() == [.5, .5, .5]


def test_quadWithOneCornerTwiceIsATriangle(read):
    with pytest.warns(UserWarning, match='left out are the fourth corner of 1 quad, the first with the number 13'):
        mesh = read({12: (1, 2, 5, 4), 13: (2, 3, 3, 5)})
    assert areas(mesh).tolist() == [.5, .5, .5] and len(mesh.leftOut) == 2


def test_quadWithThreeCornersOnALineIsDividedThere(read):
    assert sorted(areas(read({11: (1, 10, 2, 4)}))) == [.25, .25]


def test_curvedSidesAreTold(read):
    with pytest.warns(UserWarning, match='the curves of 1 element, whose sides are straight here .up to 1 m'):
        mesh = read({11: (1, 3, 6, 7, 8, 9)})
    assert areas(mesh).tolist() == [1]


def test_linesBesideTrianglesAreTold(folder):
    with pytest.warns(UserWarning, match='left out are 2 lines beside the sides of triangles'):
        readMesh(written(folder, 'a.msh', gmsh({11: (1, 2, 5), 12: (1, 2), 13: (3, 6), 14: (2, 3)})))
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        readMesh(written(folder, 'a.msh', gmsh({11: (1, 2, 5), 12: (1, 2), 13: (5, 2)})))


def test_elementWithAMissingNodeIsNamed(read):
    with pytest.raises(ValueError, match='element 12 has the node 99, which does not exist'):
        read({11: (1, 2, 5), 12: (2, 3, 99)})


def joined(*parts):
    nodes, triangles = [], []
    for own, of in parts:
        triangles.append(np.asarray(of, dtype=np.int64) + sum(map(len, nodes)))
        nodes.append(own)
    return np.concatenate(nodes), np.concatenate(triangles)


def moved(part, shift, angle=0.):
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    return part[0] @ turn + shift, part[1]


kBar = rectangleMesh((0, 0), (4, 1), 8, 2)
kThin = rectangleMesh((0, 0), (4, .2), 4, 1)


@pytest.mark.parametrize('other', [
    moved(kBar, (0, 0)), moved(kBar, (1, 0)), moved(kBar, (.3, .2)), moved(kBar, (3.9, 0)), moved(kBar, (0, .95)),
    moved(kThin, (0, .4)), moved(kThin, (1, -2), 1.5), rectangleMesh((1.1, .3), (1.2, .4), 1, 1),
    rectangleMesh((-1, -1), (5, 2), 1, 1), moved(kBar, (2, .5), .7)])
def test_overlapIsRefused(other):
    for parts in ((kBar, other), (other, kBar)):
        with pytest.raises(ValueError, match=kSentence):
            fe().addTriangles(*joined(*parts), material='m')
    assert len(O.bodies) == 0


@pytest.mark.parametrize('other', [
    moved(kBar, (4, 0)), moved(kBar, (0, 1)), moved(kBar, (.25, 1)), moved(kBar, (4, 1)), moved(kThin, (0, -.2)),
    moved(kBar, (9, 9), .3), moved(rectangleMesh((0, 0), (3, 3), 1, 1), (4, -1))])
def test_partsMayTouch(other):
    solver = fe()
    solver.addTriangles(*joined(kBar, other), material='m')
    assert len(solver.surfaces) == 2


def test_aPartInAHoleIsApart():
    nodes, triangles = rectangleMesh((0, 0), (3, 3), 3, 3)
    middle = nodes[triangles].mean(axis=1)
    ring = triangles[~((abs(middle - 1.5) < .5).all(axis=1))]
    fe().addTriangles(*joined((nodes, ring), rectangleMesh((1.1, 1.1), (1.9, 1.9), 2, 2)), material='m')


def test_randomPlacesAgainstSamples():
    """Overlap by a fine grid of points in both."""
    draw, count = random.Random(3), 0
    for _ in range(60):
        shift, angle = (draw.uniform(-1, 5), draw.uniform(-1, 2)), draw.uniform(0, 2 * math.pi)
        size = draw.choice([.2, 1, 2.5])
        other = moved(rectangleMesh((0, 0), (size, size), 2, 2), shift, angle)
        u = np.stack(np.meshgrid(*[np.linspace(0, size, 81)[1:-1]] * 2), axis=-1).reshape(-1, 2)
        places = moved((u, None), shift, angle)[0]
        depth = np.min([places[:, 0], 4 - places[:, 0], places[:, 1], 1 - places[:, 1]], axis=0).max()
        if abs(depth) < .02:
            continue
        try:
            fe().addTriangles(*joined(kBar, other), material='m')
            found = False
        except ValueError:
            found = True
        O.reset()
        assert found == (depth > 0), (shift, angle, size, depth)
        count += found
    assert 10 < count < 50
