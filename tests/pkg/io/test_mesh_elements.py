"""Elements of mesh files that are no proper ones: each is named by its number in the file and the cause. Parts of one mesh
without common nodes: they may touch, but not overlap. Abaqus' parts, instances and sets, and what its files have that
meshio loses; joints of cohesive elements, pulled."""
import math
import random
import re

import numpy as np
import pytest

import yadefrag
from fe_scene import brittle, fe, heard, O, ready
from outline_files import areas, glued, isOneSentence, lists, refusesMesh, written
from yadefrag import readMesh, rectangleMesh
from yade import wrapper as w

kPlaces = {1: (0, 0), 2: (1, 0), 3: (2, 0), 4: (0, 1), 5: (1, 1), 6: (2, 1), 7: (1, .6), 8: (1, 0), 9: (.3, .2),
           10: (.5, 0), 11: (1.2, 1.3)}
kKinds = {2: '1', 3: '2', 4: '3', 6: '9', 8: '16'}  # gmsh's, by the number of nodes
kAbaqus = {3: 'CPS3', 4: 'CPE4', 6: 'CPS6', 8: 'CPS8'}
# A unit square of two triangles.
kUnitSquare = '''*Node
1, 0., 0.
2, 1., 0.
** a comment between the nodes
3, 1., 1.
4, 0., 1.
*Element, type=CPS3, elset=low
1, 1, 2, 3
*Element, type=cps3, elset=high
2, 1, 3, 4
*Nset, nset=left, generate
1, 4, 3
*Elset, elset=all
low, high
'''


def gmsh(elements):
    """A file with elements {number: nodes}."""
    places = ['%d %r %r 0' % (number, *place) for number, place in kPlaces.items()]
    lines = ['%d %s 2 0 1 %s' % (number, kKinds[len(nodes)], ' '.join(map(str, nodes)))
             for number, nodes in elements.items()]
    return '\n'.join(['$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$Nodes', str(len(places)), *places, '$EndNodes',
                      '$Elements', str(len(lines)), *lines, '$EndElements', ''])


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
    # The inner node lies beyond the opposite side, so that the corners are clockwise.
    ({11: (1, 3, 11), 12: (3, 6, 11), 13: (6, 4, 11), 14: (4, 1, 11)},
     'element 13 is inverted: .* overlaps element 1[24]'),
    ({11: (1, 2, 5), 12: (1, 2, 3), 13: (4, 5, 6), 14: (1, 2, 10)}, 'element 12 is flat: .*; so are 2 others. Correct'),
])
def test_wrongElementsAreNamed(read, elements, sentence):
    with pytest.raises(ValueError, match=sentence) as error:
        read(elements)
    assert str(error.value).count('\n') == 0 and str(error.value).endswith('that wrote the file.')


@pytest.mark.parametrize('elements, wanted, words', [
    ({11: (1, 5, 2), 12: (2, 5, 6, 3)}, [.5, .5, .5], None),  # clockwise ones are reversed
    ({11: (1, 10, 2, 4)}, [.25, .25], None),                  # a quad with three corners on a line is divided there
    ({12: (1, 2, 5, 4), 13: (2, 3, 3, 5)}, [.5, .5, .5],
     'left out are the fourth corner of 1 quad, the first with the number 13'),
    ({11: (1, 3, 6, 7, 8, 9)}, [1], 'the curves of 1 element, whose sides are straight here .up to 1 m')])
def test_whatIsReadOfElements(read, elements, wanted, words):
    with heard() as said:
        mesh = read(elements)
    assert areas(mesh).tolist() == wanted and len(said) == (words is not None)
    assert words is None or re.search(words, said[0]) and mesh.leftOut


def test_linesBesideTrianglesAreTold(folder):
    for more, words in (({13: (3, 6), 14: (2, 3)}, ['left out are 2 lines beside the sides of triangles']), ({13: (5, 2)}, [])):
        with heard() as said:
            readMesh(written(folder, 'a.msh', gmsh({11: (1, 2, 5), 12: (1, 2), **more})))
        assert len(said) == len(words) and all(one in text for one, text in zip(words, said))


def joined(*parts):
    nodes, triangles = [], []
    for own, of in parts:
        triangles.append(np.asarray(of, dtype=np.int64) + sum(map(len, nodes)))
        nodes.append(own)
    return np.concatenate(nodes), np.concatenate(triangles)


def moved(part, shift, angle=0.):
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    return part[0] @ turn + shift, part[1]


def overlap(*parts):
    """Is a mesh of them refused?"""
    O.reset()
    solver = fe()
    try:
        solver.addTriangles(*joined(*parts), material='m')
    except ValueError as error:
        assert 'two parts of the mesh, without common nodes, overlap at' in str(error) and len(O.bodies) == 0
        return True
    assert len(solver.surfaces) == len(parts) + (parts[0] is kFrame or parts[1] is kFrame)
    return False


kBar = rectangleMesh((0, 0), (4, 1), 8, 2)
kThin = rectangleMesh((0, 0), (4, .2), 4, 1)


kPlate = rectangleMesh((0, 0), (3, 3), 3, 3)
kFrame = kPlate.nodes, kPlate.triangles[(abs(kPlate.nodes[kPlate.triangles].mean(axis=1) - 1.5) > .5).any(axis=1)]


@pytest.mark.parametrize('parts, isOverlap', [
    *(((kBar, other), True) for other in (
        moved(kBar, (0, 0)), moved(kBar, (1, 0)), moved(kBar, (.3, .2)), moved(kBar, (3.9, 0)), moved(kBar, (0, .95)),
        moved(kThin, (0, .4)), moved(kThin, (1, -2), 1.5), rectangleMesh((1.1, .3), (1.2, .4), 1, 1),
        rectangleMesh((-1, -1), (5, 2), 1, 1), moved(kBar, (2, .5), .7))),
    *(((kBar, other), False) for other in (
        moved(kBar, (4, 0)), moved(kBar, (0, 1)), moved(kBar, (.25, 1)), moved(kBar, (4, 1)), moved(kThin, (0, -.2)),
        moved(kBar, (9, 9), .3), moved(rectangleMesh((0, 0), (3, 3), 1, 1), (4, -1)))),
    ((kFrame, rectangleMesh((1.1, 1.1), (1.9, 1.9), 2, 2)), False)])
def test_partsMayTouchButNotOverlap(parts, isOverlap):
    assert overlap(*parts) == overlap(*parts[::-1]) == isOverlap


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
        found = overlap(kBar, other)
        assert found == (depth > 0), (shift, angle, size, depth)
        count += found
    assert 10 < count < 50


def assembled(parts, instances, sets=''):
    """Text of parts {name: text} and instances [(name, part, lines of its place)]."""
    text = '*Heading\n title, with a comma\n'
    for name, lines in parts.items():
        text += '*Part, name=%s\n%s*End Part\n' % (name, lines)
    text += '*Assembly, name=Assembly\n'
    for name, part, place in instances:
        text += '*Instance, name=%s, part=%s\n%s*End Instance\n' % (name, part, place)
    return text + sets + '*End Assembly\n*Step\n*Static\n*End Step\n'


def points(mesh, name):
    return sorted(map(tuple, mesh.nodes[mesh.nodeSets[name]].round(9).tolist()))


def test_partOnceForEachInstance(folder):
    mesh = readMesh(written(folder, 'a.inp', assembled(
        {'P': kUnitSquare}, [('P-1', 'P', ''), ('P-2', 'p', '5., 0., 0.\n'),
                         ('P-3', 'P', '0., 10., 0.\n0., 10., 0., 0., 10., 1., 90.\n')])))
    assert len(mesh.nodes) == 12 and areas(mesh).tolist() == [.5] * 6
    assert points(mesh, 'P-1.left') == [(0, 0), (0, 1)]
    assert points(mesh, 'P-2.left') == [(5, 0), (5, 1)]
    assert points(mesh, 'P-3.left') == [(-1, 10), (0, 10)]  # turned by 90° about (0, 10) after the move
    assert len(points(mesh, 'left')) == 6
    assert lists(mesh.instances) == {'P-1': [0, 1], 'P-2': [2, 3], 'P-3': [4, 5]}
    assert lists(mesh.groups) == dict(low=[0, 2, 4], high=[1, 3, 5], all=[0, 1, 2, 3, 4, 5])


def test_turnedAboutAnyAxis(folder):
    """Against the rotation matrix of 30° about an axis in the plane's normal through (2, 1), and the axis of
    the other direction. One that is turned over is counter-clockwise."""
    for up, sign in ((1, 1), (-3, -1)):
        mesh = readMesh(written(folder, 'a.inp', assembled(
            {'P': kUnitSquare}, [('P-1', 'P', '.5, -1.\n2., 1., 7., 2., 1., %d, 30.\n' % (7 + up))])))
        c, s = math.cos(math.pi / 6), sign * math.sin(math.pi / 6)
        arms = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) + (.5, -1) - (2, 1)
        assert mesh.nodes == pytest.approx(arms @ np.array([[c, s], [-s, c]]) + (2, 1), abs=1e-12)
    mesh = readMesh(written(folder, 'a.inp', assembled(
        {'P': kUnitSquare}, [('P-1', 'P', '0., 0., 0.\n0., 0., 0., 1., 0., 0., 180.\n')])))
    assert mesh.nodes.min(axis=0) == pytest.approx([0, -1]) and areas(mesh) == pytest.approx([.5, .5])


def test_severalPartsWithSetsOfOneName(folder):
    other = kUnitSquare.replace('low', 'low2').replace('high', 'high2').replace('nset=left', 'nset=LEFT')
    mesh = readMesh(written(folder, 'a.inp', assembled(
        {'P': kUnitSquare, 'Q': other}, [('P-1', 'P', ''), ('Q-1', 'Q', '2, 0, 0\n')])))
    assert 'left' not in mesh.nodeSets and 'all' not in mesh.groups
    assert points(mesh, 'P.left') == points(mesh, 'P-1.left') == [(0, 0), (0, 1)]
    assert points(mesh, 'Q.LEFT') == [(2, 0), (2, 1)]
    assert list(mesh.groups['low2']) == [2] and list(mesh.groups['Q.all']) == [2, 3]


def test_setsOfTheAssembly(folder):
    sets = ('*Nset, nset=left, instance=P-1\n2, 3\n*Nset, nset=left, instance=P-2\n1\n'
            '*Nset, nset=both\nP-1.left, P-2.4\n*Elset, elset=one, instance=P-2\n1\n'
            '*Nset, nset=ofOne, elset=P-2.low\n')
    mesh = readMesh(written(folder, 'a.inp', assembled(
        {'P': kUnitSquare}, [('P-1', 'P', ''), ('P-2', 'P', '5., 0., 0.\n')], sets)))
    assert points(mesh, 'left') == [(1, 0), (1, 1), (5, 0)]
    assert points(mesh, 'both') == [(0, 0), (0, 1), (5, 1)]
    assert list(mesh.groups['one']) == [2] and points(mesh, 'one') == [(5, 0), (6, 0), (6, 1)]
    assert points(mesh, 'ofOne') == points(mesh, 'one')


def test_partsWithoutAnInstanceAreTold(folder):
    text = assembled({'P': kUnitSquare, 'Q': kUnitSquare}, [('P-1', 'P', '')])
    with pytest.warns(UserWarning, match="left out are the part 'Q' with 2 elements, of which there is no instance"):
        assert len(readMesh(written(folder, 'a.inp', text)).triangles) == 2


@pytest.mark.parametrize('text', [
    '*Part, name=P\n%s*End Part\n' % kUnitSquare, assembled({'P': ''}, [('P-1', 'P', kUnitSquare)])])
def test_partWithoutAssemblyAndInstanceWithNodesAreReadOnce(folder, text):
    mesh = readMesh(written(folder, 'a.inp', text))
    assert areas(mesh).tolist() == [.5, .5] and points(mesh, 'left') == [(0, 0), (0, 1)]


def test_keywordsSplitOverTheFileAreOneMesh(folder):
    """Several blocks of nodes, elements over two lines, keywords over two lines, an included file."""
    written(folder, 'more.inp', '*NODE, NSET=top\n8, 0., 2.\n7, 2., 2.\n')
    file = written(folder, 'a.inp', '''*NODE
1, 0., 0.
2, 2., 0.
*include, input=more.inp
*NODE
5, 1., 0.
6, 2., 1.
3, 1., 2.
4, 0., 1.
*Element, type=CPE8R,
 elset="My set"
10, 1, 2, 7, 8, 5, 6,
3, 4
*Element, type=T2D2, elset=bar
11, 1, 2
''')
    with pytest.warns(UserWarning, match='left out are 1 element of the type T2D2'):
        mesh = readMesh(file)
    assert areas(mesh).tolist() == [2, 2] and list(mesh.groups) == ['My set']
    assert points(mesh, 'top') == [(0, 2), (2, 2)] and points(mesh, 'bar') == [(0, 0), (2, 0)]


@pytest.mark.parametrize('type, size, area', [
    ('CPS3', 3, 2), ('CPE3T', 3, 2), ('STRI3', 3, 2), ('S3R', 3, 2), ('M3D3', 3, 2), ('CPS4R', 4, 4), ('CPE4RH', 4, 4),
    ('CPS4I', 4, 4), ('S4R5', 4, 4), ('R3D4', 4, 4), ('CPEG4', 4, 4), ('CPS6M', 6, 2), ('STRI65', 6, 2),
    ('CPE6MH', 6, 2), ('CPS8R', 8, 4), ('S8R5', 8, 4), ('S9R5', 9, 4), ('M3D9', 9, 4), ('CAX3', 3, 2), ('CAX4R', 4, 4),
    ('CGAX4', 4, 4), ('CAX8R', 8, 4)])
def test_typesOfPlaneElements(folder, type, size, area):
    corners = [(0, 0), (2, 0), (2, 2), (0, 2)][:3 if size in (3, 6) else 4]
    sides = [tuple(np.mean([a, b], axis=0)) for a, b in zip(corners, corners[1:] + corners[:1])]
    places = (corners + sides + [(1, 1)])[:size]
    nodes = ''.join('%d, %g, %g\n' % (i + 1, *place) for i, place in enumerate(places))
    mesh = readMesh(written(folder, 'a.inp', '*NODE\n%s*ELEMENT, TYPE=%s\n7, %s\n' %
                            (nodes, type, ', '.join(str(i + 1) for i in range(size)))))
    assert areas(mesh).sum() == pytest.approx(area) and mesh.leftOut == []
    assert mesh.axisymmetric is {'CP': False, 'CA': True, 'CG': True}.get(type[:2])


@pytest.mark.parametrize('type, size, words', [
    ('COH2D4', 4, ' in no *COHESIVE SECTION of the response TRACTION SEPARATION, which connect parts that'),
    ('COH2D4P', 6, ', which connect'),
    ('GKPE4', 4, ', which connect'), ('CINPE4', 4, ''), ('SPRING2', 2, ''), ('DC1D2', 2, ''), ('CONN2D2', 2, '')])
def test_elementsWithoutAreaAreLeftOut(folder, type, size, words):
    """Two parts with a joint without thickness between them, as cracks are made there."""
    nodes = [(0, 0), (1, 0), (1, 1), (0, 1), (1, 1), (0, 1), (1, 2), (0, 2)]
    text = '*Node\n%s*Element, type=CPE3, elset=below\n1, 1, 2, 3\n2, 1, 3, 4\n' \
        '*Element, type=CPE3, elset=above\n3, 6, 5, 7\n4, 6, 7, 8\n*Element, type=%s, elset=joint\n5, %s\n' % (
            ''.join('%d, %g, %g\n' % (i + 1, *place) for i, place in enumerate(nodes)), type, ', '.join('435643'[:size]))
    with pytest.warns(UserWarning, match='left out are 1 element of the type %s' % type):
        mesh = readMesh(written(folder, 'a.inp', assembled({'Plate': text}, [('P-1', 'Plate', '')])))
    assert areas(mesh).tolist() == [.5] * 4 and len(mesh.nodes) == 8 and list(mesh.groups) == ['below', 'above']
    assert mesh.leftOut[0].endswith(type + words) or words and words in mesh.leftOut[0]
    assert points(mesh, 'joint') == ([(0, 1)] * 2 + [(1, 1)] * 2 if size > 2 else [(0, 1), (1, 1)])


def test_elementsOfRevolutionNeedAnAxis(folder):
    plane, around = readMesh(written(folder, 'a.inp', kUnitSquare)), readMesh(written(
        folder, 'b.inp', kUnitSquare.replace('type=CPS3', 'type=CAX3').replace('cps3', 'CAX3')))
    with pytest.raises(ValueError, match='the elements of the mesh are axisymmetric, but fe is plane') as error:
        fe().addMesh(around, 'm')
    assert isOneSentence(error) and len(O.bodies) == 0
    with pytest.warns(UserWarning, match='addMesh: the elements of the mesh are plane, but fe is axisymmetric'):
        fe(axisymmetric=True).addMesh(plane, 'm')
    plane.axisymmetric = around.axisymmetric = None
    for mesh, isRound in ((plane, True), (around, False)):
        O.reset()
        with heard() as said:
            fe(axisymmetric=isRound).addMesh(mesh, 'm')
        assert not any('elements' in one for one in said)


# Elastic blocks beside the joint, and brittle ones ten times as strong; refined; half of the step.
@pytest.mark.parametrize('n, factor, gap, order', [
    (4, .8, 0, (0, 1, 2, 3)), (8, .8, 1e-4, (0, 1, 2, 3)), (4, .4, 0, (1, 0, 3, 2)), (4, .5, 0, (1, 2, 3, 0))])
@pytest.mark.parametrize('isRound', [False, True], ids=['plane', 'round'])
@pytest.mark.parametrize('isBrittle', [False, True], ids=['elastic', 'brittle'])
def test_cohesiveElementsBreakByTheirStrengthAndEnergy(folder, n, factor, gap, order, isRound, isBrittle):
    """The peak of the force is strength times area, the work energy times area. Waves of the lateral motion, which
    begins with the pull, add up to half of ρcv to the stress: .023 of the strength at this speed."""
    text = glued(*(('CAX4R', 'COHAX4') if isRound else ('CPE4', 'COH2D4')), n=n, gap=gap, order=order)
    with pytest.warns(UserWarning, match='left out are stiffness, thickness, .* of %d elements' % n):
        mesh = readMesh(written(folder, 'a.inp', text))
    assert len(mesh.nodes) == (n + 1)**2 and len(mesh.joints) == n and not mesh.jointStrength - 3e6
    assert mesh.nodes[mesh.joints[:, :2], 1] == pytest.approx(.01 + gap / 2, rel=1e-12)
    given = dict(young=30e9, poisson=.2, density=2500)
    solver = fe(brittle(**given, tensileStrength=30e6) if isBrittle else w.FEMat(**given), axisymmetric=isRound)
    top, speed, area = .02 + gap, .015, math.pi * .02**2 if isRound else .02
    solver.addMesh(mesh, 0, velocity=lambda x, y: (0, speed * y / top),
                   fixed=lambda x, y: 'y' if y < 1e-9 or y > top - 1e-9 else False)
    ready(solver, factor)
    pulled, peak, work = np.flatnonzero(solver.nodes[:, 1] > top - 1e-9), 0, 0
    while solver.time * speed < 1.2 * 2 * 30 / 3e6:
        O.step()
        force = solver.reaction(pulled)[1]
        peak, work = max(peak, force), work + force * speed * O.dt
    assert peak == pytest.approx(3e6 * area, rel=.025)
    assert [work, solver.energy['fracture']] == pytest.approx([30 * area] * 2, rel=.002)
    assert solver.crackCounts == dict(open=n, damaged=0, whole=0) and len(solver.fragments()) == 2


def test_jointsHaveValuesOfTheirSections(folder):
    """Two materials of joints in a file of N and mm, and a point at which four of its elements meet."""
    text = '*Node\n' + ''.join('%d, %d, %d\n' % (4 * q + k + 1, q % 2 + x, q // 2 + y) for q in range(4)
                               for k, (x, y) in enumerate([(0, 0), (1, 0), (1, 1), (0, 1)]))
    text += '*Element, type=CPS4\n1, 1, 2, 3, 4\n2, 5, 6, 7, 8\n3, 9, 10, 11, 12\n4, 13, 14, 15, 16\n' \
        '*Element, type=COH2D4, elset=weak\n11, 2, 3, 8, 5\n12, 10, 11, 16, 13\n' \
        '*Element, type=COH2D4, elset=strong\n13, 4, 3, 10, 9\n14, 8, 7, 14, 13\n'
    for name, strength in (('weak', 2), ('strong', 5)):
        text += '*Cohesive Section, elset=%s, material=%s, response=Traction Separation\n' \
            '*Material, name=%s\n*Damage Initiation, criterion=MAXS\n%d., 9., 9.\n' \
            '*Damage Evolution, type=ENERGY, mixed mode behavior=BK, power=2\n.%d, .3, .3\n' % (
                *3 * [name], strength, strength)
    with pytest.warns(UserWarning, match='which are joints by addMesh; the units of strength and energy .N and mm'):
        mesh = readMesh(written(folder, 'a.inp', text), scale=1e-3)
    assert len(mesh.nodes) == 9 and mesh.joints[:, 2].tolist() == [0, 0, 1, 1]
    assert mesh.jointStrength.tolist() == [2, 5] and mesh.jointEnergy.tolist() == [.2, .5]
    mesh.jointStrength *= 1e6
    mesh.jointEnergy *= 1e3
    solver = fe(w.FEMat(young=1e9, poisson=0, density=1000, label='m'))
    solver.addMesh(mesh, 'm', velocity=lambda x, y: (1e4 * x, 0))
    ready(solver, .5)
    O.run(40, True)
    assert yadefrag.crackTable(solver)['strength'].tolist() == [2e6, 2e6]
    O.reset()
    solver = fe()
    solver.addMesh(mesh, 'm', jointStrength=[0, None])
    assert solver.crackCounts['open'] == 2
    mesh.jointStrength = [1.]
    with pytest.raises(ValueError, match='jointStrength has 1 values, it must have one for each of the 2 joints'):
        solver.addMesh(mesh, 'm')


@pytest.mark.parametrize('text, sentence', [
    *((kUnitSquare.replace(old, new, 1), sentence) for old, new, sentence in (
        ('type=CPS3', 'type=C3D8R', "a.inp has elements of the kind 'C3D8R', 1 of them, the first with the number 1"),
        ('type=CPS3', 'type=U7', "a.inp has elements of the kind 'U7'"),
        ('1, 1, 2, 3\n', '1, 1, 2, 3, 4\n', 'element 1 of the type CPS3 has 4 nodes instead of 3'),
        ('2, 1, 3, 4\n', '2, 1, 3\n', 'element 2 of the type CPS3 has 2 nodes instead of 3'),
        ('2, 1, 3, 4\n', '1, 1, 3, 4\n', 'element 1 is there twice'),
        ('2, 1, 3, 4\n', '2, 1, 3, 9\n', 'element 2 has the node 9, which does not exist'),
        ('low, high', 'low, hihg', "a set has the member 'hihg', which is not in the file before it"),
        ('*Nset', '*Ngen\n1, 4\n*Nset', 'the keyword [*]NGEN, which makes or moves nodes or elements, is not known'),
        ('*Node\n', '*Node, system=C\n', 'it has nodes in the system C'), ('1., 1.', '1., x', 'not a readable mesh'),
        ('*Node\n', '*Include, input=nothing.inp\n*Node\n', 'a.inp is not a readable mesh: .*nothing.inp'))),
    *((assembled({'P': kUnitSquare}, instances), sentence) for instances, sentence in (
        ([('P-1', 'R', '')], "the instance 'P-1' is of the part 'R', which is not in the file"),
        ([('P-1', 'P', ''), ('P-1', 'P', '')], "there are two instances 'P-1'"),
        ([('P-1', 'P', '0, 0, 0\n0, 0, 1\n')], "the place of the instance 'P-1' is not understood"),
        ([('P-1', 'P', '0, 0, 0\n0, 0, 0, 1, 0, 0, 90\n')], 'is no plane mesh: z goes from 0 to 1')))])
def test_whatIsNotUnderstoodIsRefused(folder, text, sentence):
    refusesMesh(folder, 'a.inp', text, sentence)
