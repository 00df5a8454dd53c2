"""Outlines from DXF: lines that meet, arcs, bulges, splines, blocks, layers; what a viewer shows is what is read, the
rest is named with its number."""
import math
import pathlib

import ezdxf
import numpy as np
import pytest

from outline_files import area, net, offEllipse, offLine, read, written
from yadefrag import readOutline

kSeen, kOff, kFrozen = 'seen', 'unseen', 'frozen'
kInvisible = 77  # colour of entities that `hiding` makes invisible: ezdxf 0.18 reads this flag, but does not write it


def dxf(folder, draw, name='a.dxf'):
    document = ezdxf.new('R2010')
    draw(document)
    file = '%s/%s' % (folder, name)
    document.saveas(file)
    return file


def test_dxfLinesAndArcsThatMeet(folder):
    """A slot: two lines and two half circles, in any order and direction."""
    def draw(document):
        space = document.modelspace()
        space.add_line((0, 0), (10, 0))
        space.add_arc((0, 2), 2, 90, 270)
        space.add_line((0, 4), (10, 4))
        space.add_arc((10, 2), 2, 270, 90)
        space.add_circle((5, 2), 1)
        space.add_text('a note')
    (outline, (hole,)), = readOutline(dxf(folder, draw), 1e-3, scale=.1)
    assert area(outline) == pytest.approx(.4 + math.pi * .04, abs=1e-3 * 2 * math.pi * .2)
    assert area(outline) < .4 + math.pi * .04
    assert max(offEllipse(hole, (.5, .2), .1, .1)) <= 1e-3


def test_dxfPolylineWithBulges(folder):
    """tan(90°/4) is a quarter circle, 1 a half one; clockwise ones are negative."""
    quarter = math.tan(math.pi / 8)

    def draw(document):
        document.modelspace().add_lwpolyline(
            [(0, 0, 0), (4, 0, 1), (4, 4, 0), (0, 4, -quarter)], format='xyb', close=True)
    (outline, holes), = readOutline(dxf(folder, draw), 1e-5)
    segment = math.pi * 8 / 4 - 4  # of the quarter circle with the chord 4: r² = 8
    assert area(outline) == pytest.approx(16 + math.pi * 2 - segment, rel=2e-5) and holes == []
    points = np.array(outline)
    right = points[points[:, 0] > 4 + 1e-9]
    assert np.allclose(np.linalg.norm(right - (4, 2), axis=1), 2)
    assert points[:, 0].max() == pytest.approx(6, abs=1e-5) and (points[:, 0] > -1e-12).all()


def test_dxfOldPolylinesEllipsesBlocksAndMirrors(folder):
    def draw(document):
        space = document.modelspace()
        space.add_polyline2d([(0, 0, 0), (4, 0, 1), (4, 4, 0), (0, 4, 0)], format='xyb', close=True)
        space.add_ellipse((20, 0), (0, 6), .5, 11.57230643490451, 17.855491742084098)  # a full turn, but for rounding
        block = document.blocks.new('hole')
        block.add_circle((0, 0), 1)
        space.add_blockref('hole', (20, 1), dxfattribs=dict(xscale=.5, yscale=.5))
        # Seen from below: x is mirrored.
        space.add_lwpolyline([(10, 0, 0), (14, 0, 1), (14, 4, 0), (10, 4, 0)], format='xyb',
                             close=True, dxfattribs=dict(extrusion=(0, 0, -1)))
    old, ellipse, mirrored = readOutline(dxf(folder, draw), 1e-4)
    assert area(old[0]) == pytest.approx(16 + 2 * math.pi, rel=1e-3)
    assert max(offEllipse(ellipse[0], (20, 0), 3, 6)) <= 1e-4
    assert max(offEllipse(ellipse[1][0], (20, 1), .5, .5)) <= 1e-4
    assert area(mirrored[0]) == pytest.approx(area(old[0]))
    assert min(x for x, _ in mirrored[0]) == pytest.approx(-16, abs=1e-3)


@pytest.mark.parametrize('tolerance', [.1, 1e-3])
def test_dxfSpline(folder, tolerance):
    controls = [(0, 0), (10, -4), (14, 8), (2, 6), (6, 14), (-3, 10)]

    def draw(document):
        document.modelspace().add_open_spline(controls + controls[:1], degree=3)
        document.modelspace().add_line((30, 0), (30, 0))
    file = dxf(folder, draw)
    (outline, holes), = readOutline(file, tolerance)
    spline, = ezdxf.readfile(file).modelspace().query('SPLINE')
    curve = np.array([(p.x, p.y) for p in spline.construction_tool().approximate(3000)])
    assert offLine(curve[::7], np.array(outline)) <= tolerance
    assert holes == []


def layered(document):
    """A plate, its bore and the pins, each on its layer; one pin in a block, whose lines are on layer 0."""
    space = document.modelspace()
    for name in ('Plate', 'bore', 'pins'):
        document.layers.add(name)
    square = [(0, 0), (10, 0), (10, 10), (0, 10)]
    space.add_lwpolyline(square, close=True, dxfattribs={'layer': 'Plate'})
    space.add_circle((5, 5), 2, dxfattribs={'layer': 'bore'})
    space.add_circle((5, 5), 1, dxfattribs={'layer': 'pins'})
    block = document.blocks.new('pin')
    block.add_circle((0, 0), .5)
    space.add_blockref('pin', (2, 2), dxfattribs={'layer': 'pins'})


def test_dxfLayers(folder):
    file = dxf(folder, layered)
    assert [len(holes) for _, holes in readOutline(file, .01)] == [2, 0]  # the plate, the pin in its bore
    [(plate, holes)] = readOutline(file, .01, layers='plate')  # capitals do not count
    assert area(plate) == pytest.approx(100) and holes == []
    [(plate, [bore])] = readOutline(file, .01, layers=['bore', 'Plate'])
    assert abs(area(bore)) == pytest.approx(math.pi * 4, rel=.01)
    pins = readOutline(file, .01, layers='pins')
    assert sorted(area(pin) for pin, _ in pins) == [pytest.approx(math.pi * r**2, rel=.03) for r in (.5, 1)]
    found = readOutline(file, .01, byLayer=True)  # a circle is no hole of what is around it on another layer
    assert {name: [holes for _, holes in shapes] for name, shapes in found.items()} == dict(Plate=[[]], bore=[[]], pins=[[], []])
    assert readOutline(file, .01, layers='bore', byLayer=True) == {'bore': found['bore']}
    with pytest.raises(ValueError, match="^layers has 'bores', but the layers with lines of .* are "
                                         "'Plate', 'bore', 'pins'.$"):
        readOutline(file, .01, layers=['bores'])
    for wrong in (3, [], [1], b'Plate'):
        with pytest.raises(ValueError, match='^layers is .*the name of a layer, or a list of names'):
            readOutline(file, .01, layers=wrong)
    with pytest.raises(ValueError, match='^layers or byLayer is given, but .*a.csv.* has no layers'):
        readOutline(written(folder, 'a.csv', '0,0\n1,0\n0,1\n'), byLayer=True)


def hiding(file):
    file = pathlib.Path(file)
    return written(file.parent, 'b.dxf', file.read_text().replace(' 62\n77\n', ' 62\n77\n 60\n1\n'))


def square(layout, side, at=(0, 0), **attributes):
    x, y = at
    layout.add_lwpolyline([(x, y), (x + side, y), (x + side, y + side), (x, y + side)], close=True,
                          dxfattribs=attributes)


def drawing(draw, seed):
    """Nested blocks of squares, at random, in rows and columns, on layers that are shown or not; returns the area
    that is shown and the number of entities that are not."""
    random = np.random.default_rng(seed)
    layers = ['0', kSeen, kOff, kFrozen]
    draw.layers.add(kSeen)
    draw.layers.add(kOff).off()
    draw.layers.add(kFrozen).freeze()
    contents = {}  # block: [(kind, layer, is invisible, value)]

    def filled(layout, below):
        """Three squares of side 1, and three inserts of the blocks below, each in a place of its own."""
        found = []
        for i in range(3):
            layer, hidden = str(random.choice(layers)), bool(random.random() < .2)
            square(layout, 1, (2 * i - 300, -300), layer=layer, color=kInvisible if hidden else 7)
            found.append(('square', layer, hidden, 1))
        for i in range(3 * bool(below)):
            block, layer, hidden = str(random.choice(below)), str(random.choice(layers)), bool(random.random() < .2)
            rows, columns = (int(n) for n in random.integers(1, 4, 2))
            layout.add_blockref(block, (400. * i, 0), dxfattribs=dict(
                layer=layer, color=kInvisible if hidden else 7, row_count=rows, column_count=columns, row_spacing=60,
                column_spacing=60, xscale=.05, yscale=.05, rotation=90 * int(random.integers(4))))
            found.append(('insert', layer, hidden, (block, rows * columns)))
        return found

    def shown(those, around):
        """(area, hidden) of the contents of a block that is inserted on a layer."""
        total, lost = 0., 0
        for kind, layer, hidden, value in those:
            layer = around if layer == '0' else layer
            if hidden or layer == kFrozen or kind == 'square' and layer == kOff:
                lost += 1
            elif kind == 'square':
                total += 1
            else:
                inner, innerLost = shown(contents[value[0]], layer)
                total, lost = total + value[1] * inner * .05**2, lost + value[1] * innerLost
        return total, lost
    for name, below in (('a', []), ('b', ['a']), ('c', ['a', 'b'])):
        contents[name] = filled(draw.blocks.new(name), below)
    top = filled(draw.modelspace(), ['a', 'b', 'c'])
    square(draw.modelspace(), 50, (-900, -900))
    paper = draw.layout('Layout1')
    square(paper, 9)
    square(paper, 9, (20, 0))
    total, lost = shown(top, '0')
    return total + 2500, lost


def test_dxfTurnedBlockInABlockThatIsNotToScale(folder):
    """The square becomes a parallelogram, the circle an ellipse, the half circle a half ellipse; two more are hidden."""
    def draw(document):
        document.layers.add(kFrozen).freeze()
        inner, outer = document.blocks.new('inner'), document.blocks.new('outer')
        square(inner, 2)
        inner.add_circle((9, 0), 1)
        inner.add_lwpolyline([(20, 0, 1), (22, 0, 0)], format='xyb', close=True)
        for more in ({}, dict(color=kInvisible), dict(layer=kFrozen)):
            outer.add_blockref('inner', (0, 0), dxfattribs=dict(rotation=30, **more))
        document.modelspace().add_blockref('outer', (0, 0), dxfattribs=dict(xscale=3, yscale=2))
    found, words = read(hiding(dxf(folder, draw)), 1e-4)
    assert net(found) == pytest.approx(6 * (4 + 1.5 * math.pi), rel=1e-4) and words.count('(1)') == 2


@pytest.mark.parametrize('seed', range(12))
def test_dxfBlocksRowsAndLayers(folder, seed):
    wanted = []
    file = hiding(dxf(folder, lambda document: wanted.extend(drawing(document, seed))))
    found, words = read(file, gap=1e-9)
    assert net(found) == pytest.approx(wanted[0], rel=1e-9)
    told = [int(part.split('(')[1].split(')')[0]) for part in words.split(', ') if '(' in part]
    assert 'entities in paper space (2)' in words and sum(told) == wanted[1] + 2


def withEntities(document):
    space = document.modelspace()
    square(space, 10)
    space.add_text('a')
    space.add_mtext('b')
    space.add_point((1, 1))
    space.add_hatch().paths.add_polyline_path([(0, 0), (1, 0), (1, 1)])
    space.add_lwpolyline([(20, 0), (30, 0), (30, 9)], close=True, dxfattribs=dict(const_width=.5))
    space.add_blockref('missing', (0, 0))
    space.add_3dface([(0, 0), (1, 0), (1, 1), (0, 1)])
    block = document.blocks.new('named')
    square(block, 2)
    block.add_attdef('NAME', (0, 0))
    space.add_blockref('named', (50, 0)).add_attrib('NAME', 'c', (50, 0))


def test_dxfEntitiesThatAreNoOutlines(folder):
    found, words = read(dxf(folder, withEntities))
    assert net(found) == pytest.approx(100 + 45 + 4)
    for what in ('entities of type TEXT', 'entities of type MTEXT', 'entities of type POINT',
                 'entities of type HATCH', 'entities of type 3DFACE', 'widths of polylines',
                 'blocks that the file does not contain', 'attributes of blocks'):
        assert what + ' (1)' in words


def test_dxfLayersThatAreOffAreReadByName(folder):
    def draw(document):
        document.layers.add('Off').off()
        square(document.modelspace(), 3, layer='off')
        square(document.modelspace(), 2, (9, 9))
    file = dxf(folder, draw)
    found, words = read(file)
    assert net(found) == pytest.approx(4) and 'entities on layers that are off (1)' in words
    assert net(read(file, layers='OFF')[0]) == pytest.approx(9) and not read(file, layers='OFF')[1]
    assert list(read(file, byLayer=True)[0]) == ['0']


def test_dxfNothingIsShown(folder):
    def draw(document):
        square(document.layout('Layout1'), 3)
    with pytest.raises(ValueError, match=r'has no lines that could be an outline; it is read without: entities in '
                                         r'paper space \(1\)[.]$'):
        readOutline(dxf(folder, draw))


def test_dxfCurveThatIsFittedToAFrame(folder):
    """A viewer shows the points of the curve (flag 8), not those of its frame (flag 16)."""
    def draw(document):
        line = document.modelspace().add_polyline2d([(0, 0), (9, 9)], close=True)
        line.append_vertices([(0, 0), (4, 0), (4, 4)], dxfattribs=dict(flags=8))
        for vertex in line.vertices[:2]:
            vertex.dxf.flags = 16
    assert net(read(dxf(folder, draw))[0]) == pytest.approx(8)


def test_dxfDamagedFile(folder):
    file = dxf(folder, lambda document: square(document.modelspace(), 3))
    lines = pathlib.Path(file).read_text()
    found, _ = read(written(folder, 'b.dxf', lines[:lines.rindex('ENDSEC')]))
    assert net(found) == pytest.approx(9)
