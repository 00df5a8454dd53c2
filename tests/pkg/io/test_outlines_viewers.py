"""What a viewer shows of a DXF file, a map, a table or a picture is what is read; the rest is told with its number."""
import json
import math
import os

import numpy as np
import pytest

from outline_files import area, corners, kSquare, net, read, written
from test_outlines_dxf import dxf
from yadefrag import readOutline

kSeen, kOff, kFrozen = 'seen', 'unseen', 'frozen'
kInvisible = 77  # colour of entities that `hiding` makes invisible: ezdxf 0.18 reads this flag, but does not write it


def hiding(file):
    with open(file) as text:
        contents = text.read()
    return written(os.path.dirname(file), 'b.dxf', contents.replace(' 62\n77\n', ' 62\n77\n 60\n1\n'))


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


@pytest.mark.parametrize('hides', ['invisible', kFrozen, 'nothing'])
def test_dxfTurnedBlockInABlockThatIsNotToScale(folder, hides):
    """The square becomes a parallelogram, the circle an ellipse, the half circle a half ellipse."""
    def draw(document):
        document.layers.add(kFrozen).freeze()
        inner, outer = document.blocks.new('inner'), document.blocks.new('outer')
        square(inner, 2)
        inner.add_circle((9, 0), 1)
        inner.add_lwpolyline([(20, 0, 1), (22, 0, 0)], format='xyb', close=True)
        outer.add_blockref('inner', (0, 0), dxfattribs=dict(
            rotation=30, color=kInvisible if hides == 'invisible' else 7, layer=kFrozen if hides == kFrozen else '0'))
        document.modelspace().add_blockref('outer', (0, 0), dxfattribs=dict(xscale=3, yscale=2))
        square(document.modelspace(), 5, (-50, 0))
    found, words = read(hiding(dxf(folder, draw)), 1e-4)
    if hides == 'nothing':
        assert net(found) == pytest.approx(25 + 6 * (4 + 1.5 * math.pi), rel=1e-4) and not words
    else:
        assert net(found) == pytest.approx(25) and words.endswith('(1).')


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
    with open(file) as text:
        lines = text.read()
    found, _ = read(written(folder, 'b.dxf', lines[:lines.rindex('ENDSEC')]))
    assert net(found) == pytest.approx(9)


def ring(side, at=(0, 0)):
    return [(x * side / 4 + at[0], y * side / 4 + at[1]) for x, y in kSquare + kSquare[:1]]


def polygon(*rings):
    return dict(type='Polygon', coordinates=rings)


def feature(geometry):
    return dict(type='Feature', properties={}, geometry=geometry)


kFrame = polygon(ring(4), ring(2, (1, 1)))
# The filler has one more point on a side: 1.7, 1.
kFiller = polygon([(1, 1), (1.7, 1), (3, 1), (3, 3), (1, 3), (1, 1)])
kMaps = {  # name: (texts, areas of the shapes without holes, words)
    'coverage': ([dict(type='FeatureCollection', features=[feature(kFrame), feature(kFiller)])], [12, 4], ''),
    'coverage, filler first': ([dict(type='GeometryCollection', geometries=[kFiller, kFrame])], [4, 12], ''),
    'coverage, hole filled by two': ([dict(type='GeometryCollection', geometries=[
        kFrame, polygon([(1, 1), (3, 1), (3, 2), (1, 2), (1, 1)]), polygon([(1, 2), (3, 2), (3, 3), (1, 3), (1, 2)])])],
        [12, 2, 2], ''),
    'neighbours': ([polygon(ring(4)), polygon(ring(4, (4, 0)))], [16, 16], ''),
    'one a line': ([feature(polygon(ring(4))), feature(polygon(ring(2, (9, 0))))], [16, 4], ''),
    'list': ([[polygon(ring(4)), polygon(ring(2, (9, 0)))]], [16, 4], ''),
    'nested collections': ([feature(dict(type='GeometryCollection', geometries=[
        dict(type='GeometryCollection', geometries=[polygon(ring(4))]), dict(type='Point', coordinates=(1, 1))]))],
        [16], 'points (1)'),
    'multipolygon': ([dict(type='MultiPolygon', coordinates=[[ring(4), ring(2, (1, 1))], [ring(1, (1.5, 1.5))]])],
                     [12, 1], ''),
    'twice': ([polygon(ring(4)), polygon(ring(4)[1:] + ring(4)[1:2])], [16], 'second copies of a line (1)'),
    'polygon in polygon': ([polygon(ring(4)), polygon(ring(2, (1, 1)))], [12], ''),
    'frame in polygon': ([polygon(ring(12)), polygon(ring(4, (4, 4)), ring(2, (5, 5)))], [128, 4], ''),
    'no geometry': ([feature(polygon(ring(4))), feature(None)], [16], 'features without geometry (1)'),
}


@pytest.mark.parametrize('name', list(kMaps))
@pytest.mark.parametrize('ending, between', [('geojson', '\n'), ('json', '\n\x1e'), ('wkt', '\n'), ('wkt', ';\r\n\n')])
def test_maps(folder, name, ending, between):
    texts, areas, words = kMaps[name]
    if ending == 'wkt':
        from shapely.geometry import shape
        members = [one for text in texts for one in (text if isinstance(text, list) else text.get('features', [text]))]
        geometries = [one.get('geometry', one) for one in members]
        texts = ['POLYGON EMPTY' if one is None else shape(one).wkt for one in geometries]
        words = words.replace('features without geometry', 'empty geometries')
    else:
        texts = list(map(json.dumps, texts))
    found, told = read(written(folder, 'a.' + ending, between.join(texts)))
    assert [net([one]) for one in found] == pytest.approx(areas)
    assert words in told and bool(words) == bool(told)


@pytest.mark.parametrize('text', ['POLYGON((0 0,1 0,1 1,0 0)) and more', 'SRID=4326;POLYGON((0 0,1 0,1 1))', '', '3'])
def test_wktThatIsNone(folder, text):
    with pytest.raises(ValueError, match='a.wkt (is not a readable WKT file|has no lines)'):
        readOutline(written(folder, 'a.wkt', text))


def test_wktWithANumberOfItsSystem(folder):
    assert net(read(written(folder, 'a.wkt', 'SRID=4326;POLYGON Z ((0 0 1,4 0 1,4 4 1,0 0 1))'))[0]) == 8


kRows = ['0 0', '4 0', '4 4', '0 4']
kTables = {  # first rows: (separator, number of loops) or a part of the error
    '': (' ', 1), 'x y': (',', 1), '# 1 2\nx, y (m)': (';', 1), 'x y z': ('\t', 1),
    '0 0 0': 'line 1', '1 2 3': 'line 1', '7': 'line 1', 'x 1': 'line 1', '1,5 3,5': 'line 1', 'x y\nx y': 'line 2',
    '8 8\n9 8\n9 9\n\n': (' ', 2), 'x\n8 8\n9 8\n9 9\n\n\n': (', ', 2),
}


@pytest.mark.parametrize('first', list(kTables))
def test_csvHeadings(folder, first):
    wanted = kTables[first]
    separator = ' ' if isinstance(wanted, str) else wanted[0]
    text = '\n'.join(first.splitlines() + [row.replace(' ', separator) for row in kRows])
    file = written(folder, 'a.csv', text)
    if isinstance(wanted, str):
        with pytest.raises(ValueError, match=wanted + ': .*it must be two numbers x, y'):
            readOutline(file)
    else:
        found = readOutline(file)
        assert len(found) == wanted[1] and corners(found[-1][0]) == kSquare


def test_csvDecimalComma(folder):
    (outline, _), = readOutline(written(folder, 'a.csv', 'x;y\n0,5;0\n4,5; 0\n4,5; 4\n0,5;4\n'))
    assert corners(outline) == [(x + .5, y) for x, y in kSquare]


@pytest.mark.parametrize('encoding', ['utf-8', 'utf-8-sig', 'utf-16'])
def test_csvOfSpreadsheets(folder, encoding):
    file = os.path.join(folder, 'a.csv')
    with open(file, 'w', encoding=encoding) as out:
        out.write('"Länge";"y"\n"0";"0"\n"4";"0"\n"4";"4"\n"0,5";"4"\n')
    (outline, _), = readOutline(file)
    assert corners(outline) == [(0, 0), (4, 0), (4, 4), (.5, 4)]


def flag(x, y):
    """An L: of the eight positions of a picture no two are equal."""
    return (x < 8) & (y < 28) & (x > 2) & (y > 2) | (x < 18) & (y < 7) & (x > 2) & (y > 2)


kTurns = {1: lambda a: a, 2: np.fliplr, 3: lambda a: np.rot90(a, 2), 4: np.flipud, 5: np.transpose,
          6: lambda a: np.rot90(a, 1), 7: lambda a: np.rot90(a, 2).T, 8: lambda a: np.rot90(a, -1)}  # how it is stored


@pytest.mark.parametrize('turn', list(kTurns))
@pytest.mark.parametrize('ending, bits', [('png', 8), ('png', 16), ('tif', 8), ('tif', 16), ('jpg', 8)])
def test_picturesAreReadUpright(folder, turn, ending, bits):
    from PIL import Image
    y, x = np.mgrid[31.5:-.5:-1, .5:24]
    kind = np.uint8 if bits == 8 else np.uint16
    upright = np.where(flag(x, y), 0, 2**bits - 1).astype(kind)
    file = os.path.join(folder, 'a.' + ending)
    orientation = Image.Exif()
    orientation[274] = turn
    more = dict(tiffinfo={274: turn}) if ending == 'tif' else dict(exif=orientation)
    Image.fromarray(np.ascontiguousarray(kTurns[turn](upright))).save(file, **more)
    (outline, _), = readOutline(file, .1)
    points = np.array(outline)
    assert area(outline) == pytest.approx(6 * 26 + 10 * 5, rel=.01)
    assert [*points.min(axis=0), *points.max(axis=0)] == pytest.approx([2, 2, 18, 28], abs=.2)
    assert not ((points[:, 0] > 9) & (points[:, 1] > 8)).any()


@pytest.mark.parametrize('mode', ['LA', 'PA', 'RGBA', '1', 'P', 'CMYK', 'grey 16 with a transparent value',
                                  'white is zero', 'white is zero, 16 bits'])
def test_picturesOfOtherKinds(folder, mode):
    """A dark square of 20 pixels; where the mode has alpha, the paper is black, but transparent."""
    from PIL import Image
    isDark = np.zeros((40, 40), dtype=bool)
    isDark[10:30, 5:25] = True
    grey = np.where(isDark, 0, 255).astype(np.uint8)
    file, more = os.path.join(folder, 'a.tif' if 'white' in mode or mode == 'CMYK' else 'a.png'), {}
    if mode in ('LA', 'RGBA', 'PA'):
        picture = Image.fromarray(np.dstack([0 * grey] * 3 + [255 - grey]), 'RGBA').convert(mode.replace('PA', 'LA'))
        if mode == 'PA':
            picture = Image.fromarray(np.where(isDark, 1, 0).astype(np.uint8), 'P')
            picture.putpalette([0, 0, 0] * 256)
            more = dict(transparency=0)
    elif mode.startswith('grey'):
        file, picture = greyPng(folder, np.where(isDark, 0, 9000), 9000), None
    elif 'white' in mode:  # PIL itself turns 8 bits over when it writes them
        picture = Image.fromarray(65535 - 257 * grey.astype(np.uint16) if '16' in mode else grey)
        more = dict(tiffinfo={262: 0})
    else:
        picture = Image.fromarray(grey).convert(mode)
    if picture is not None:
        picture.save(file, **more)
    (outline, holes), = readOutline(file, .1)
    assert area(outline) == pytest.approx(400, rel=.01) and not holes
    assert np.mean(outline, axis=0) == pytest.approx((15, 20), abs=1)


def greyPng(folder, values, transparent):
    """A PNG of 16 bits, of which one value is transparent; PIL does not write it."""
    import struct
    import zlib

    def part(name, data):
        return struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))
    rows = b''.join(b'\0' + row.astype('>u2').tobytes() for row in values)
    file = os.path.join(folder, 'grey.png')
    with open(file, 'wb') as out:
        out.write(b'\x89PNG\r\n\x1a\n' + part(b'IHDR', struct.pack('>IIBBBBB', *values.shape[::-1], 16, 0, 0, 0, 0)) +
                  part(b'tRNS', struct.pack('>H', transparent)) + part(b'IDAT', zlib.compress(rows)) +
                  part(b'IEND', b''))
    return file


def test_furtherPicturesOfAFile(folder):
    from PIL import Image
    file = os.path.join(folder, 'a.tif')
    grey = np.full((40, 40), 255, dtype=np.uint8)
    grey[10:30, 10:30] = 0
    Image.fromarray(grey).save(file, save_all=True, append_images=[Image.fromarray(255 - grey)] * 2)
    found, words = read(file, .1)
    assert net(found) == pytest.approx(400, rel=.01) and 'further pictures of the file (2)' in words


def test_greysOf32BitsAreRefused(folder):
    from PIL import Image
    file = os.path.join(folder, 'a.tif')
    Image.fromarray(np.eye(9, dtype=np.int32)).save(file)
    with pytest.raises(ValueError, match='its grey values do not have 8 or 16 bits'):
        readOutline(file, 1)


@pytest.mark.parametrize('seed', range(8))
def test_regionsWithinRegions(folder, seed):
    """Rings around random centres, drawn in any order as closed lines or as polygons with holes: the area is that of
    the points inside an odd number of loops."""
    random = np.random.default_rng(seed)
    parts, wanted = [], 0.
    for i in range(30):
        radii = np.sort(random.choice(np.arange(1, 40), random.integers(1, 9), replace=False))[::-1] / 100
        at = np.array([i % 6, i // 6], dtype=float) + random.uniform(-.05, .05, 2)
        loops = [[tuple(at + r * np.array([math.cos(a), math.sin(a)])) for a in np.arange(12) * math.pi / 6]
                 for r in radii]
        wanted += sum((-1)**k * 3 * r * r for k, r in enumerate(radii))
        while loops:
            count = min(len(loops), int(random.integers(1, 3)))
            parts.append(polygon(*(loop + loop[:1] for loop in loops[:count])))
            loops = loops[count:]
    random.shuffle(parts)
    found, words = read(written(folder, 'a.json', json.dumps(dict(type='GeometryCollection', geometries=parts))))
    assert net(found) == pytest.approx(wanted, rel=1e-9) and not words
