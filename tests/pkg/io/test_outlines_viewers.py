"""What a viewer shows of a map, a table or a picture is what is read; the rest is named with its number. Silhouettes
with holes, specks, edges."""
import json
import math
import os
import pathlib
import struct
import zlib

import numpy as np
from PIL import Image
import pytest

from outline_files import area, corners, kSquare, net, offEllipse, read, written
from yadefrag import readOutline


def ring(side, at=(0, 0)):
    return [(x * side / 4 + at[0], y * side / 4 + at[1]) for x, y in kSquare + kSquare[:1]]


def polygon(*rings):
    return dict(type='Polygon', coordinates=rings)


def places(texts):
    """The set of points of geometries, and of lists of them, that are no points alone."""
    if isinstance(texts, dict):
        return places(list(texts.values())) if texts.get('type') != 'Point' else set()
    if isinstance(texts, (list, tuple)) and len(texts) == 2 and not isinstance(texts[0], (list, tuple, dict, str)):
        return {tuple(texts)}
    return set().union(*map(places, texts)) if isinstance(texts, (list, tuple)) else set()


def feature(geometry):
    return dict(type='Feature', properties={}, geometry=geometry)


def collection(*geometries):
    return dict(type='GeometryCollection', geometries=geometries)


kFrame = polygon(ring(4), ring(2, (1, 1)))
# The filler has one more point on a side: 1.7, 1.
kFiller = polygon([(1, 1), (1.7, 1), (3, 1), (3, 3), (1, 3), (1, 1)])
kMaps = {  # name: (texts, areas of the shapes without holes, words)
    'coverage': ([dict(type='FeatureCollection', features=[feature(kFrame), feature(kFiller)])], [12, 4], ''),
    'coverage, filler first': ([collection(kFiller, kFrame)], [4, 12], ''),
    'coverage, hole filled by two': ([collection(kFrame, polygon([(1, 1), (3, 1), (3, 2), (1, 2), (1, 1)]),
                                                 polygon([(1, 2), (3, 2), (3, 3), (1, 3), (1, 2)]))], [12, 2, 2], ''),
    'neighbours': ([polygon(ring(4)), polygon(ring(4, (4, 0))), polygon([(0, -2), (8, -2), (8, 0), (0, 0), (0, -2)])],
                   [16, 16, 16], ''),
    'one a line': ([feature(polygon(ring(4))), feature(polygon(ring(2, (9, 0))))], [16, 4], ''),
    'list': ([[polygon(ring(4)), polygon(ring(2, (9, 0)))]], [16, 4], ''),
    'nested collections': ([feature(collection(collection(polygon(ring(4))), dict(type='Point', coordinates=(1, 1))))],
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
    wanted = places(texts)
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
    loops = [loop for outline, holes in found for loop in (outline, *holes)]
    assert {point for loop in loops for point in loop} == wanted and all(area(loop) > 0 for loop in loops)
    assert words in told and bool(words) == bool(told)


@pytest.mark.parametrize('text', ['POLYGON((0 0,1 0,1 1,0 0)) and more', 'SRID=4326;POLYGON((0 0,1 0,1 1))', '', '3'])
def test_wktThatIsNone(folder, text):
    with pytest.raises(ValueError, match='a.wkt (is not a readable WKT file|has no lines)'):
        readOutline(written(folder, 'a.wkt', text))
    # With the number of its system and heights.
    assert net(read(written(folder, 'a.wkt', 'SRID=4326;POLYGON Z ((0 0 1,4 0 1,4 4 1,0 0 1))'))[0]) == 8


kRows = ['0 0', '4 0', '4 4', '0 4']
kTables = {  # first rows: (separator, number of loops) or a part of the error
    '': (' ', 1), 'x y': (',', 1), '# 1 2\nx, y (m)': (';', 1), 'x y z': ('\t', 1),
    '0 0 0': 'line 1', '1 2 3': 'line 1', '7': 'line 1', 'x 1': 'line 1', '1,5 3,5': 'line 1', 'x y\nx y': 'line 2',
    '8 8\n9 8 # a corner\n9; 9\n\n': (' ', 2), 'x\n8 8\n9 8\n9 9\n\n\n': (', ', 2),
}


@pytest.mark.parametrize('first', list(kTables))
def test_csvHeadings(folder, first):
    wanted = kTables[first]
    separator = ' ' if isinstance(wanted, str) else wanted[0]
    text = '\n'.join(first.splitlines() + [row.replace(' ', separator) for row in kRows])
    file = written(folder, 'a.csv', text)
    if isinstance(wanted, str):
        with pytest.raises(ValueError, match=wanted + ': .*it must be two finite numbers x, y'):
            readOutline(file)
    else:
        found = readOutline(file)
        assert len(found) == wanted[1] and corners(found[-1][0]) == kSquare


@pytest.mark.parametrize('encoding', ['utf-8', 'utf-8-sig', 'utf-16'])
def test_csvOfSpreadsheets(folder, encoding):
    """Commas are decimal ones."""
    file = pathlib.Path(folder, 'a.csv')
    file.write_text('"Länge";"y"\n"0";"0"\n"4";"0"\n"4";"4"\n"0,5";"4"\n', encoding=encoding)
    (outline, _), = readOutline(file)
    assert corners(outline) == [(0, 0), (4, 0), (4, 4), (.5, 4)]
    (outline, _), = readOutline(written(folder, 'a.csv', 'x;y\n0,5;0\n4,5; 0\n4,5; 4\n0,5;4\n'))
    assert corners(outline) == [(x + .5, y) for x, y in kSquare]


def flag(x, y):
    """An L: of the eight positions of a picture no two are equal."""
    return (x < 8) & (y < 28) & (x > 2) & (y > 2) | (x < 18) & (y < 7) & (x > 2) & (y > 2)


kTurns = {1: lambda a: a, 2: np.fliplr, 3: lambda a: np.rot90(a, 2), 4: np.flipud, 5: np.transpose,
          6: lambda a: np.rot90(a, 1), 7: lambda a: np.rot90(a, 2).T, 8: lambda a: np.rot90(a, -1)}  # how it is stored


@pytest.mark.parametrize('turn, ending, bits', [
    *((turn, *one) for turn in kTurns for one in [('png', 8), ('png', 16), ('tif', 8), ('tif', 16), ('jpg', 8)]),
    (1, 'bmp', 8), (6, 'jpeg', 8), (6, 'tiff', 16)])
def test_picturesAreReadUpright(folder, turn, ending, bits):
    y, x = np.mgrid[31.5:-.5:-1, .5:24]
    kind = np.uint8 if bits == 8 else np.uint16
    upright = (np.where(flag(x, y), .1, .9) * (2**bits - 1)).astype(kind)  # no black, no white
    file = os.path.join(folder, 'a.' + ending)
    orientation = Image.Exif()
    orientation[274] = turn
    more = dict(tiffinfo={274: turn}) if 'tif' in ending else dict(exif=orientation)
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
    def part(name, data):
        return struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))
    rows = b''.join(b'\0' + row.astype('>u2').tobytes() for row in values)
    file = pathlib.Path(folder, 'grey.png')
    file.write_bytes(b'\x89PNG\r\n\x1a\n' + part(b'IHDR', struct.pack('>IIBBBBB', *values.shape[::-1], 16, 0, 0, 0, 0))
                     + part(b'tRNS', struct.pack('>H', transparent)) + part(b'IDAT', zlib.compress(rows))
                     + part(b'IEND', b''))
    return file


def test_furtherPicturesOfAFile(folder):
    file = os.path.join(folder, 'a.tif')
    grey = np.full((40, 40), 255, dtype=np.uint8)
    grey[10:30, 10:30] = 0
    Image.fromarray(grey).save(file, save_all=True, append_images=[Image.fromarray(255 - grey)] * 2)
    found, words = read(file, .1)
    assert net(found) == pytest.approx(400, rel=.01) and 'further pictures of the file (2)' in words


@pytest.mark.parametrize('kind', [np.int32, np.float32])
def test_greysOf32BitsAreRefused(folder, kind):
    file = os.path.join(folder, 'a.tif')
    Image.fromarray(np.eye(9, dtype=kind)).save(file)
    with pytest.raises(ValueError, match='a.tif is not a readable picture: its grey values do not have 8 or 16 bits'):
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
    found, words = read(written(folder, 'a.json', json.dumps(collection(*parts))))
    assert net(found) == pytest.approx(wanted, rel=1e-9) and not words


def silhouette(folder, inside, size=(120, 100)):
    y, x = np.mgrid[size[1] - .5:-.5:-1, .5:size[0]]
    file = os.path.join(folder, 'L.png')
    Image.fromarray(np.where(inside(x, y), 0, 255).astype(np.uint8)).save(file)
    return file


def test_silhouetteWithAHole(folder):
    def inside(x, y):
        return (np.hypot(x - 60, y - 40) < 35) & (np.hypot(x - 70, y - 45) > 10)
    (outline, (hole,)), = readOutline(silhouette(folder, inside), 1e-3, scale=1e-3)
    # A pixel's half from the grid, and the tolerance of one pixel.
    for loop, centre, radius in ((outline, (.06, .04), .035), (hole, (.07, .045), .01)):
        radii = np.hypot(*(np.array(loop) - centre).T)
        assert abs(radii - radius).max() < 1e-3
        assert max(offEllipse(loop, centre, radius, radius)) < 1.75e-3
        assert area(loop) == pytest.approx(math.pi * radius**2, rel=.03 if radius > .02 else .1)
    assert len(outline) < 40 < len(readOutline(silhouette(folder, inside), 1e-4, scale=1e-3)[0][0])


def test_specksAreOmittedIfRequested(folder):
    def inside(x, y):
        return (abs(x - 60) < 30) & (abs(y - 50) < 20) | (np.hypot(x - 10, y - 10) < 2)
    file = silhouette(folder, inside)
    (outline, _), = readOutline(file, .1, leastArea=50)
    # The contour cuts a corner at half a pixel.
    assert area(outline) == pytest.approx(60 * 40, rel=1e-3)
    with pytest.raises(ValueError, match='L.png, tolerance: simplify is 1 m, .*could vanish'):
        readOutline(file, 1)
    # At the edge of the picture.
    (outline, _), = readOutline(silhouette(folder, lambda x, y: x < 60), .1)
    assert area(outline) == pytest.approx(60 * 100, rel=1e-3)
