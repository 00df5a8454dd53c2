"""Outlines from SVG, GeoJSON, WKT and CSV: places, curves within the tolerance, holes; wrong files of all kinds."""
import json
import math
import sys

import numpy as np
import pytest

from fe_scene import fe
from outline_files import area, corners, kSquare, offEllipse, offLine, svg, written
from yadefrag import readOutline
from yadefrag.io.readers import nesting


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
    assert [len(holes) for _, holes in nesting.nested([(loop, []) for loop in (left, right, low)], '')] == [0, 0, 0]


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
