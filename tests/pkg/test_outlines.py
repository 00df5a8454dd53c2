"""Outlines from SVG, DXF, GeoJSON, WKT, CSV and PNG: places, curves within the tolerance, holes."""
import builtins
import json
import math
import os
import sys

import numpy as np
import pytest

from fe_scene import fe
from yadefrag import readOutline
from yadefrag.readers import loops

O = builtins.O
kSquare = [(0, 0), (4, 0), (4, 4), (0, 4)]


def written(folder, name, text):
    file = os.path.join(folder, name)
    with open(file, 'w', encoding='utf-8') as out:
        out.write(text)
    return file


def svg(folder, body, page='viewBox="0 0 100 50"'):
    return written(folder, 'a.svg', '<svg xmlns="http://www.w3.org/2000/svg" %s>%s</svg>' %
                   (page, body))


def area(loop):
    return loops.area(np.array(loop))


def corners(loop):
    """The loop's points, rounded, from the lowest one on."""
    points = [(round(x, 9) + 0., round(y, 9) + 0.) for x, y in loop]
    first = points.index(min(points))
    return points[first:] + points[:first]


def offLine(places, line):
    """Largest distance (m) of places from a closed polyline."""
    starts, sides = line, np.roll(line, -1, axis=0) - line
    squares = (sides**2).sum(1)

    def off(place):
        along = np.clip(((place - starts) * sides).sum(1) / squares, 0, 1)
        return np.linalg.norm(starts + along[:, None] * sides - place, axis=1).min()
    return max(map(off, places))


def offEllipse(loop, centre, a, b):
    """(largest distance of points, of middles of sides) from an ellipse of upright axes, which
    is itself replaced by a polyline, to 10⁻⁸ of a radius."""
    t = np.linspace(0, 2 * np.pi, 20000, endpoint=False)
    curve = np.stack([centre[0] + a * np.cos(t), centre[1] + b * np.sin(t)], axis=1)
    points = np.array(loop)
    return offLine(points, curve), offLine((points + np.roll(points, -1, axis=0)) / 2, curve)


def test_svgPolygonsAndTransforms(folder):
    file = svg(folder, '<g transform="translate(10 20)"><rect x="1" y="2" width="4" height="3"/>'
               '<path transform="rotate(90)" d="M20 0 h4 v-3 h-4 z"/></g>')
    first, second = readOutline(file, scale=.5)
    # (11, 22) to (15, 25), halved, with y upwards.
    assert corners(first[0]) == [(5.5, -12.5), (7.5, -12.5), (7.5, -11), (5.5, -11)]
    # (x, y) turned to (-y, x): 0 to 3 and 20 to 24, moved to 10 to 13 and 40 to 44.
    assert corners(second[0]) == [(5, -22), (6.5, -22), (6.5, -20), (5, -20)]
    assert first[1] == second[1] == []


def test_svgIsInUnitsOfItsViewBox(folder):
    body = '<rect width="4" height="3"/>'
    for page in ('viewBox="0 0 8 6"', 'viewBox="0 0 8 6" width="80mm" height="60mm"',
                 'width="80" height="60"'):
        (outline, _), = readOutline(svg(folder, body, page))
        assert corners(outline) == [(0, -3), (4, -3), (4, 0), (0, 0)], page


@pytest.mark.parametrize('tolerance', [.3, .01, 1e-4])
def test_svgCurvesAreWithinTheTolerance(folder, tolerance):
    file = svg(folder, '<circle cx="10" cy="10" r="5"/><g transform="scale(2 1)">'
               '<ellipse cx="20" cy="25" rx="3" ry="8"/></g>')
    for (outline, _), centre, a, b in zip(readOutline(file, tolerance),
                                          ((10, -10), (40, -25)), (5, 6), (5, 8)):
        points, middles = offEllipse(outline, centre, a, b)
        assert points < 2e-8 * b
        assert middles <= tolerance
        assert middles > tolerance / 9 or len(outline) <= 8  # not far more points than it takes


def test_svgSkewedArc(folder):
    """An arc of 90° and its chords to the centre, sheared: (x + y/2, y)."""
    file = svg(folder, '<path transform="matrix(1 0 .5 1 0 0)" d="M0 0 L4 0 A4 4 0 0 1 0 4 Z"/>')
    (outline, _), = readOutline(file, 1e-4)
    points = np.array(outline) * (1, -1)
    back = points - np.outer(points[:, 1] / 2, (1, 0))
    onArc = back[np.linalg.norm(back, axis=1) > 1e-9]
    assert len(onArc) > 50 and abs(np.linalg.norm(onArc, axis=1) - 4).max() < 1e-9
    assert abs(area(outline)) == pytest.approx(4 * np.pi, rel=1e-4)


@pytest.mark.parametrize('path, controls', [
    ('M0 0 C 10 0 0 10 10 10 L 0 20 Z', [(0, 0), (10, 0), (0, 10), (10, 10)]),
    ('M0 0 Q 20 5 10 10 L 0 20 Z', [(0, 0), (20, 5), (10, 10)]),
])
@pytest.mark.parametrize('tolerance', [.1, 1e-3])
def test_svgBezierCurves(folder, path, controls, tolerance):
    (outline, _), = readOutline(svg(folder, '<path d="%s"/>' % path), tolerance)
    t = np.linspace(0, 1, 1001)[:, None]
    points = [np.array(c, dtype=float) for c in controls]
    while len(points) > 1:
        points = [(1 - t) * a + t * b for a, b in zip(points, points[1:])]
    assert offLine(points[0], np.array(outline) * (1, -1)) <= tolerance
    assert len(outline) < 4 / math.sqrt(tolerance) * 3


def test_svgHiddenShapesAndThoseOfDefinitions(folder):
    file = svg(folder, '<defs><rect id="r" width="3" height="3"/></defs><use href="#r" x="40"/>'
               '<circle r="3" display="none"/><circle r="3" visibility="hidden"/><text>ab</text>')
    (outline, holes), = readOutline(file)
    assert corners(outline) == [(40, -3), (43, -3), (43, 0), (40, 0)] and holes == []


def test_holesAndIslands(folder):
    frames = ''.join('<rect x="%d" y="%d" width="%d" height="%d"/>' % (i, i, 40 - 2 * i, 40 - 2 * i)
                     for i in (10, 0, 5, 15))
    first, second = readOutline(svg(folder, frames + '<rect x="60" y="1" width="5" height="5"/>'
                                    '<rect x="61" y="2" width="1" height="1"/>'))[:2]
    found = readOutline(svg(folder, frames))
    assert sorted((area(o), [area(h) for h in holes]) for o, holes in found) == \
        [(400, [100]), (1600, [900])]
    assert len(first[1]) == len(second[1]) == 1


def test_lettersTouchingNeighboursAreNotNested():
    left, right = np.array(kSquare, dtype=float), np.array(kSquare) + (4., 0)
    low = np.array([(0, -2), (8, -2), (8, 0), (0, 0)], dtype=float)
    assert [len(holes) for _, holes in loops.nested([left, right, low])] == [0, 0, 0]


def dxf(folder, draw, name='a.dxf'):
    import ezdxf
    document = ezdxf.new('R2010')
    draw(document)
    document.saveas(os.path.join(folder, name))
    return os.path.join(folder, name)


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
        space.add_ellipse((20, 0), (0, 6), .5)
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
    import ezdxf
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


def test_dxfLayersAreChosenByName(folder):
    file = dxf(folder, layered)
    assert [len(holes) for _, holes in readOutline(file, .01)] == [2, 0]  # the plate, the pin in its bore
    [(plate, holes)] = readOutline(file, .01, layers='plate')  # capitals do not count
    assert area(plate) == pytest.approx(100) and holes == []
    [(plate, [bore])] = readOutline(file, .01, layers=['bore', 'Plate'])
    assert abs(area(bore)) == pytest.approx(math.pi * 4, rel=.01)
    pins = readOutline(file, .01, layers='pins')
    assert sorted(area(pin) for pin, _ in pins) == [pytest.approx(math.pi * r**2, rel=.03) for r in (.5, 1)]
    with pytest.raises(ValueError, match="^layers has 'bores', but the layers with lines of .* are "
                                         "'Plate', 'bore', 'pins'.$"):
        readOutline(file, .01, layers=['bores'])
    for wrong in (3, [], [1], b'Plate'):
        with pytest.raises(ValueError, match='^layers is .*the name of a layer, or a list of names'):
            readOutline(file, .01, layers=wrong)
    with pytest.raises(ValueError, match='^layers or byLayer is given, but .*a.csv.* has no layers'):
        readOutline(written(folder, 'a.csv', '0,0\n1,0\n0,1\n'), byLayer=True)


def test_dxfByLayer(folder):
    """A circle on a layer of its own is no hole of what is around it on another one."""
    found = readOutline(dxf(folder, layered), .01, byLayer=True)
    assert list(found) == ['Plate', 'bore', 'pins']
    assert [len(shapes) for shapes in found.values()] == [1, 1, 2]
    assert all(holes == [] for shapes in found.values() for _, holes in shapes)
    few = readOutline(dxf(folder, layered), .01, layers='bore', byLayer=True)
    assert few == {'bore': found['bore']}


def test_geoJson(folder):
    ring = kSquare + kSquare[:1]
    hole = [(1, 1), (1, 2), (2, 2), (2, 1), (1, 1)]
    far = [(x + 10, y) for x, y in ring]
    shapes = [dict(type='Polygon', coordinates=[ring, hole]),
              dict(type='MultiPolygon', coordinates=[[far], [[(x + 10, y + 10) for x, y in ring]]]),
              dict(type='Point', coordinates=(1, 1))]
    features = [dict(type='Feature', properties={}, geometry=one) for one in shapes + [None]]
    data = dict(type='FeatureCollection', features=features)
    found = readOutline(written(folder, 'a.geojson', json.dumps(data)))
    assert [corners(o) for o, _ in found] == [[(x + a, y + b) for x, y in kSquare]
                                              for a, b in ((0, 0), (10, 0), (10, 10))]
    assert [[corners(h) for h in holes] for _, holes in found] == \
        [[[(1, 1), (2, 1), (2, 2), (1, 2)]], [], []]
    alone = readOutline(written(folder, 'a.json', json.dumps(shapes[0])))
    assert alone == found[:1]


def test_wktAndLinesThatClose(folder):
    text = ('GEOMETRYCOLLECTION(LINESTRING(0 0, 4 0, 4 4), POLYGON((1 1, 2 1, 2 2, 1 2, 1 1)),'
            'LINESTRING(0 0, 0 4, 4 4), POINT(7 7))')
    (outline, (hole,)), = readOutline(written(folder, 'a.wkt', text), scale=2)
    assert corners(outline) == [(0, 0), (8, 0), (8, 8), (0, 8)]
    assert corners(hole) == [(2, 2), (4, 2), (4, 4), (2, 4)]


def test_csv(folder):
    text = 'x (mm); y (mm)\n# a square\n0; 0\n4; 0\n4; 4\n0; 4\n\n1 1\n1,2 # a corner\n2,2\n2,1\n1,1\n'
    (outline, (hole,)), = readOutline(written(folder, 'a.csv', text))
    assert corners(outline) == kSquare and corners(hole) == [(1, 1), (2, 1), (2, 2), (1, 2)]


def silhouette(folder, inside, size=(120, 100), mode='L'):
    from PIL import Image
    y, x = np.mgrid[size[1] - .5:-.5:-1, .5:size[0]]
    isDark = inside(x, y)
    if mode == 'L':
        picture = Image.fromarray(np.where(isDark, 0, 255).astype(np.uint8))
    else:  # black everywhere, and transparent outside
        pixels = np.zeros(isDark.shape + (4,), dtype=np.uint8)
        pixels[isDark, 3] = 255
        picture = Image.fromarray(pixels, 'RGBA')
    file = os.path.join(folder, mode + '.png')
    picture.save(file)
    return file


@pytest.mark.parametrize('mode', ['L', 'RGBA'])
def test_silhouetteWithAHole(folder, mode):
    def inside(x, y):
        return (np.hypot(x - 60, y - 40) < 35) & (np.hypot(x - 70, y - 45) > 10)
    (outline, (hole,)), = readOutline(silhouette(folder, inside, mode=mode), 1e-3, scale=1e-3)
    # A pixel's half from the grid, and the tolerance of one pixel.
    for loop, centre, radius in ((outline, (.06, .04), .035), (hole, (.07, .045), .01)):
        radii = np.hypot(*(np.array(loop) - centre).T)
        assert abs(radii - radius).max() < 1e-3
        assert max(offEllipse(loop, centre, radius, radius)) < 1.75e-3
        assert area(loop) == pytest.approx(math.pi * radius**2, rel=.03 if radius > .02 else .1)
    assert len(outline) < 40 < len(readOutline(silhouette(folder, inside), 1e-4, scale=1e-3)[0][0])


@pytest.mark.parametrize('ending', ['jpg', 'jpeg', 'bmp', 'tif', 'tiff', 'png'])
@pytest.mark.parametrize('bits', [8, 16])
def test_silhouetteInOtherFormats(folder, ending, bits):
    """A disc of 40 pixels on paper that is not quite white; 0.5 %: JPEG blurs the edge."""
    from PIL import Image
    if bits == 16 and ending in ('jpg', 'jpeg', 'bmp'):
        pytest.skip('the format has 8 bits')
    y, x = np.mgrid[99.5:-.5:-1, .5:120]
    grey = np.where(np.hypot(x - 60, y - 50) < 40, .1, .9)
    file = os.path.join(folder, 'disc.' + ending)
    Image.fromarray((grey * (2**bits - 1)).astype(np.uint8 if bits == 8 else np.uint16)).save(file)
    [(outline, holes)] = readOutline(file, .25)
    assert area(outline) == pytest.approx(math.pi * 40**2, rel=.005) and holes == []
    assert np.mean(outline, axis=0) == pytest.approx((60, 50), abs=1)


def test_greysWithoutARangeAreRefused(folder):
    from PIL import Image
    file = os.path.join(folder, 'float.tif')
    Image.fromarray(np.ones((9, 9), dtype=np.float32)).save(file)
    with pytest.raises(ValueError, match='float.tif is not a readable picture: its grey values do not have 8 or 16'):
        readOutline(file, 1)


def test_specksAreLeftOutWhereAskedFor(folder):
    def inside(x, y):
        return (abs(x - 60) < 30) & (abs(y - 50) < 20) | (np.hypot(x - 10, y - 10) < 2)
    file = silhouette(folder, inside)
    (outline, _), = readOutline(file, .1, leastArea=50)
    # The contour cuts a corner at half a pixel.
    assert area(outline) == pytest.approx(60 * 40, rel=1e-3)
    with pytest.raises(ValueError, match='L.png, tolerance: simplify is 1 m, .*could vanish'):
        readOutline(file, 1)


def test_silhouetteAtTheEdgeOfThePicture(folder):
    (outline, _), = readOutline(silhouette(folder, lambda x, y: x < 60), .1)
    assert area(outline) == pytest.approx(60 * 100, rel=1e-3)


def test_whatIsReadGoesIntoAddPolygon(folder):
    file = svg(folder, '<path d="M0 0 H 40 V 30 H 0 Z "/>'
               '<circle cx="20" cy="15" r="5"/>')
    solver = fe()
    for shape in readOutline(file, 1e-4, scale=1e-3):
        solver.addPolygon(*shape, size=2e-3, material='m')
    mass = 1000 * (.04 * .03 - math.pi * .005**2)
    assert solver.masses.sum() == pytest.approx(mass, rel=2e-3)
    simple, = readOutline(file, 1e-6, scale=1e-3, simplify=3e-4)
    assert len(simple[1][0]) < 20


@pytest.mark.parametrize('name, text, more, sentence', [
    ('a.pdf', '', {}, "file ends with '.pdf', an outline can be read from one of .svg, .dxf"),
    ('a.svg', '<svg xmlns="http://www.w3.org/2000/svg"><circle r="3"/></svg>', {},
     'tolerance is None, but .*a.svg has curves: give the permitted deviation'),
    ('a.svg', '<svg xmlns="http://www.w3.org/2000/svg"><circle r="3"/></svg>',
     dict(tolerance=1e-18), 'tolerance needs more than 1000000 points on one curve'),
    ('a.svg', '<svg', {}, 'a.svg is not a readable SVG file'),
    ('a.svg', '<svg xmlns="http://www.w3.org/2000/svg"/>', {}, 'a.svg has no lines that could'),
    ('a.dxf', 'nothing', {}, 'a.dxf is not a readable DXF file'),
    ('a.json', '{"type": "Polygon"}', {}, 'a.json is not a readable GeoJSON file'),
    ('a.wkt', 'POLYGON((0 0', {}, 'a.wkt is not a readable WKT file'),
    ('a.wkt', 'LINESTRING(0 0, 4 0, 4 4)', {}, r'a.wkt: a line ends at \(0.0, 0.0\) where no other'),
    ('a.wkt', 'MULTILINESTRING((0 0, 4 0, 4 4, 0 0.1), (0 0, 0 0.1), (0 0, 1 1))', {},
     r'a line ends at \(0.0, 0.0\) together with more than one other'),
    ('a.wkt', 'LINESTRING(0 0, 4 0, 2 0, 0 0)', {}, r'a.wkt has a loop without area at \(0, 0\)'),
    ('a.wkt', 'POLYGON((0 0, 1 0, 1 1, 0 0))', dict(leastArea=2), 'no closed line around leastArea'),
    ('a.csv', '0 0\n1 0\n1 one\n', {}, r"a.csv, line 3: '1 one', it must be two numbers"),
    ('a.csv', '0 0\n1 nan\n1 1\n', {}, 'a.csv has points that are not finite'),
    ('a.csv', '0 0\n1 0\n1 1\n', dict(scale=0), 'scale is 0, it must be a positive number'),
    ('a.csv', '0 0\n1 0\n1 1\n', dict(gap=-1), 'gap is -1, it must be a positive number'),
    ('a.csv', '0 0\n1 0\n1 1\n', dict(leastArea=-1), 'leastArea is -1, it must be 0 or a positive'),
    ('a.png', 'no picture', {}, 'tolerance is None, but .*a.png is a picture'),
    ('a.png', 'no picture', dict(tolerance=1), 'a.png is not a readable picture'),
])
def test_wrongFilesAreRefusedInOneSentence(folder, name, text, more, sentence):
    with pytest.raises(ValueError, match=sentence) as error:
        readOutline(written(folder, name, text), **more)
    words = str(error.value)
    assert words.endswith('.') and '\n' not in words and len(words) < 400


def test_missingFile(folder):
    with pytest.raises(FileNotFoundError, match='nowhere.dxf'):
        readOutline(folder + '/nowhere.dxf')


@pytest.mark.parametrize('name, module, package', [
    ('a.svg', 'svgelements', 'python3-svgelements'), ('a.dxf', 'ezdxf', 'python3-ezdxf'),
    ('a.wkt', 'shapely.wkt', 'python3-shapely'),
    ('a.json', 'shapely.geometry', 'python3-shapely'),
    ('a.png', 'skimage.measure', 'python3-skimage'), ('a.png', 'PIL.Image', 'python3-pil')])
def test_missingLibraryIsNamed(folder, monkeypatch, name, module, package):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match="only with the Python library %s, which is missing "
                       ".*install Debian's package %s[.]" % (module, package)):
        readOutline(written(folder, name, ''), 1)


def test_importNeedsNoneOfTheLibraries(folder, monkeypatch):
    for module in ('svgelements', 'ezdxf', 'shapely', 'skimage', 'PIL'):
        monkeypatch.setitem(sys.modules, module, None)
    assert readOutline(written(folder, 'a.csv', '0 0\n1 0\n1 1\n'))
