"""Outlines from SVG and WKT: places, curves within the tolerance, holes; wrong files of all kinds. What
the finest feature of an outline costs, before a mesh is made, beside the mesh's own step."""
import math
import sys
import warnings

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, O
from outline_files import area, corners, offEllipse, offLine, svg, written
from yadefrag import outlineReport, readOutline

kUnit = yadefrag.rectangle((0, 0), (1, 1))
kShort = [(0, 0), (.5, 0), (.505, 0), (1, 0), (1, 1), (0, 1)]
kNotch = [(0, 0), (1, 0), (1, 1), (.504, 1), (.504, .5), (.5, .5), (.5, 1), (0, 1)]
kNeck = [(0, 0), (1, 0), (1, 1), (.51, .5), (1, 2), (0, 2), (.5, .5), (0, 1)]


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
    for page in ('viewBox="0 0 8 6"', 'viewBox="0 0 8 6" width="80mm" height="60mm"', 'width="80" height="60"'):
        (outline, _), = readOutline(svg(folder, body, page))
        assert corners(outline) == [(0, -3), (4, -3), (4, 0), (0, 0)], page


@pytest.mark.parametrize('tolerance', [.3, .01, 1e-4])
def test_svgCurvesAreWithinTheTolerance(folder, tolerance):
    file = svg(folder, '<circle cx="10" cy="10" r="5"/><g transform="scale(2 1)">'
               '<ellipse cx="20" cy="25" rx="3" ry="8"/></g>')
    for (outline, _), centre, a, b in zip(readOutline(file, tolerance), ((10, -10), (40, -25)), (5, 6), (5, 8)):
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


def test_wktAndLinesThatClose(folder):
    text = ('GEOMETRYCOLLECTION(LINESTRING(0 0, 4 0, 4 4), POLYGON((1 1, 2 1, 2 2, 1 2, 1 1)),'
            'LINESTRING(0 0, 0 4, 4 4), POINT(7 7))')
    (outline, (hole,)), = readOutline(written(folder, 'a.wkt', text), scale=2)
    assert corners(outline) == [(0, 0), (8, 0), (8, 8), (0, 8)]
    assert corners(hole) == [(2, 2), (4, 2), (4, 4), (2, 4)]


def test_whatIsReadGoesIntoAddPolygon(folder):
    file = svg(folder, '<path d="M0 0 H 40 V 30 H 0 Z "/><circle cx="20" cy="15" r="5"/>')
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
    ('a.csv', '0 0\n1 0\n1 one\n', {}, r"a.csv, line 3: '1 one', it must be two finite numbers"),
    ('a.csv', '0 0\n1 nan\n1 1\n', {}, r"a.csv, line 2: '1 nan', it must be two finite numbers"),
    ('a.png', 'no picture', {}, 'tolerance is None, but .*a.png is a picture'),
    ('a.png', 'no picture', dict(tolerance=1), 'a.png is not a readable picture'),
])
def test_wrongFilesAreRefusedInOneSentence(folder, name, text, more, sentence):
    with pytest.raises(ValueError, match=sentence) as error:
        readOutline(written(folder, name, text), **more)
    words = str(error.value)
    assert words.endswith('.') and '\n' not in words and len(words) < 400


@pytest.mark.parametrize('reader', [readOutline, yadefrag.readPolygon, yadefrag.readMesh])
def test_missingFileIsNamed(folder, reader):
    with pytest.raises(FileNotFoundError, match='nowhere.dxf'):
        reader(folder + '/nowhere.dxf')


@pytest.mark.parametrize('name, module, package', [
    ('a.svg', 'svgelements', 'python3-svgelements'), ('a.svg', 'cssselect2', 'python3-cssselect2'),
    ('a.dxf', 'ezdxf', 'python3-ezdxf'),
    ('a.wkt', 'shapely.wkt', 'python3-shapely'), ('a.json', 'shapely.geometry', 'python3-shapely'),
    ('a.png', 'skimage.measure', 'python3-skimage'), ('a.png', 'PIL.Image', 'python3-pil')])
def test_missingLibraryIsNamed(folder, monkeypatch, name, module, package):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match="only with the Python library %s, which is missing "
                       ".*install Debian's package %s[.]" % (module, package)):
        readOutline(written(folder, name, ''), 1)


def test_importNeedsNoneOfTheLibraries(folder, monkeypatch):
    for module in ('svgelements', 'cssselect2', 'ezdxf', 'shapely', 'skimage', 'PIL'):
        monkeypatch.setitem(sys.modules, module, None)
    assert readOutline(written(folder, 'a.csv', '0 0\n1 0\n1 1\n'))


def stepOf(outline, holes=(), **more):
    solver = fe()
    with warnings.catch_warnings(action='ignore'):  # of short edges
        solver.addPolygon(outline, holes, size=.05, material='m', **more)
    return solver.criticalTimeStep()


def report(outline, holes=(), **more):
    return outlineReport(outline, holes, **{**dict(size=.05, material='m'), **more})


@pytest.mark.parametrize('outline, finest, place, word', [
    (kShort, .005, (.5025, 0), 'an edge of 0.005 m'),
    (kNotch, .004, (.502, .5), 'an edge of 0.004 m'),
    (kNeck, .01, (.51, .5), 'a width of 0.01 m'),
])
def test_finestFeatureAndItsCost(outline, finest, place, word):
    step, found = stepOf(outline), report(outline)
    assert found['finest'] == pytest.approx(finest) and found['points'] == len(outline)
    at = 'shortestEdgeAt' if 'edge' in word else 'narrowestAt'
    assert found[at] == pytest.approx(place)
    assert found['ratio'] == pytest.approx(.05 / finest)
    assert word in found['words'] and found['words'].endswith('.')
    # According to the docstring; the shapes of triangles differ.
    assert .5 < step / found['timeStep'] < 3


def test_noFeatureFinerThanTheSize():
    step, found = stepOf(kUnit), report(kUnit)
    assert found['ratio'] == 1 and found['finest'] == .05 and found['shortestEdge'] == 1
    assert found['timeStep'] == pytest.approx(step, rel=.4)
    assert 'no edge and no gap finer than the size' in found['words']


def test_holesAndWallsBetweenThem():
    hole = yadefrag.rectangle((.2, .01), (.4, .2))
    other = yadefrag.rectangle((.403, .05), (.6, .2))
    assert stepOf(kUnit, [hole, other]) > 0
    found = report(kUnit, [hole, other])
    assert found['narrowest'] == pytest.approx(.003) and found['narrowestAt'][0] in (.4, .403)
    assert report(kUnit, [hole])['narrowest'] == pytest.approx(.01)


def test_simplifyTakesTheCostAway():
    """And nothing is added to the scene."""
    fe()
    bumps = np.linspace(0, 1, 401)
    outline = [(x, 1e-4 * (i % 2)) for i, x in enumerate(bumps)] + [(1, 1), (0, 1)]
    assert report(outline)['ratio'] == pytest.approx(20, rel=.01)
    assert report(outline, simplify=1e-3)['ratio'] == 1 and len(O.bodies) == 0


def byAllPairs(loops):
    """(least distance of a corner to a side that does not end there, the corner)."""
    starts = np.concatenate(loops)
    ends = np.concatenate([np.roll(loop, -1, axis=0) for loop in loops])
    sides = ends - starts
    best = (np.inf, None)
    for corner in starts:
        arms = corner - starts
        along = np.clip((arms * sides).sum(1) / (sides**2).sum(1), 0, 1)
        distance = np.linalg.norm(arms - along[:, None] * sides, axis=1)
        distance[(starts == corner).all(axis=1) | (ends == corner).all(axis=1)] = np.inf
        best = min(best, (float(distance.min()), tuple(corner)), key=lambda one: one[0])
    return best


@pytest.mark.parametrize('seed', range(6))
def test_narrowestPlaceAsByAllPairs(seed):
    """A coast with bays, and islands; also where the finest part is a small one of the whole."""
    fe()
    random = np.random.default_rng(seed)
    angles = np.sort(np.concatenate([np.linspace(0, 6.2, 300), 1 + 10.**-random.integers(2, 6) * np.arange(100)]))
    radii = 5 + random.random(len(angles))
    coast = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    holes = []
    for i, k in enumerate(random.integers(3, 20, 4)):
        a = np.arange(k) * 2 * np.pi / k
        star = np.stack([np.cos(a), np.sin(a)], axis=1) * random.uniform(.3, .9, (k, 1))
        holes.append(star + (2 * (i % 2) - 1, 2 * (i // 2) - 1))
    found = report(coast, holes)
    distance, corner = byAllPairs([coast, *holes])
    assert found['narrowest'] == pytest.approx(distance, rel=1e-9)
    assert found['narrowestAt'] == corner


def test_reportOfAFile(folder):
    fe()
    file = svg(folder, '<rect width="1" height="1"/><path d="M2 0h1v1h-.4v-.5h-.003v.5h-.597z"/><text>a</text>'
               '<rect width="1" height="9" fill="none"/>')
    found = report(file, tolerance=1e-3)
    assert found['outlines'] == 2 and found['points'] == 12 and found['finest'] == pytest.approx(.003)
    assert found['leftOut'] == {'texts': 1, 'shapes that are not painted': 1}
    assert 'an edge of 0.003 m' in found['words']
    assert found['words'].endswith('The file is read without: texts (1), shapes that are not painted (1).')
    assert report(file, scale=2)['finest'] == pytest.approx(.006)
    assert report(svg(folder, '<rect width="1" height="1"/>'))['leftOut'] == {}
    with pytest.raises(TypeError, match='^scale is given, but outline is not the path of a file.$'):
        report(kUnit, scale=2)
    with pytest.raises(TypeError, match='^byLayer is given, but outlineReport reports on all layers'):
        report(file, byLayer=True)
    with pytest.raises(TypeError, match="unexpected keyword argument 'scales'"):
        report(file, scales=2)
