"""The outlines that yadefrag.geometry makes and reads; outlines with fewer points, within a distance. Grains: they fill
their outline, and neighbours share their sides to the last bit."""
import math
import pathlib
import random
import sys

import numpy as np
import pytest

import yadefrag
from outline_files import area, contour, offLine, written
from yadefrag import _yadefrag
from yadefrag.fe import geometry
from yadefrag.fe.geometry import grainJoints, simplified, voronoi
from yadefrag.io import outlines

kAngle = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
kPlate = geometry.rectangle((0, 0), (2, 2))
kDisc = geometry.circle((1, 1), 1, 40)


def test_rectangleCircleAndRing():
    """Counter-clockwise; a circle has its points on it, a ring is two of them."""
    assert geometry.rectangle((0, 1), (2, 4)) == [(0, 1), (2, 1), (2, 4), (0, 4)]
    loop = geometry.circle((1, 2), 3)
    assert len(loop) == 64 and loop[0] == (4, 2)
    assert all(math.isclose(math.dist(p, (1, 2)), 3, rel_tol=1e-15) for p in loop)
    assert area(loop) == pytest.approx(math.pi * 9 * (1 - .0016), rel=2e-5)
    assert len(geometry.circle((0, 0), 1, 5)) == 5
    outline, holes = geometry.ring((0, 0), .8, 1, 12)
    assert outline == geometry.circle((0, 0), 1, 12)
    assert holes == [geometry.circle((0, 0), .8, 12)]


def test_polygonFileIsRead(folder):
    text = '# a plate\n\n0 0  # corner\n4 0\n# half way\n4 3\n\n\n1 1\n1 2\n2e0 1\n\n'
    outline, holes = outlines.readPolygon(written(folder, 'plate.txt', text))
    assert outline == [(0, 0), (4, 0), (4, 3)]
    assert holes == [[(1, 1), (1, 2), (2, 1)]]


@pytest.mark.parametrize('text, line', [
    ('0 0\n1\n', 'line 2'), ('0 0\n1 0\nx 1\n', 'line 3'), ('0 0 0\n', 'line 1'),
    ('# nothing\n', 'line 1'), ('', 'line 1'), ('0 0\n\n1 nan\n', 'line 3'),
    ('0 0\n1e999 0\n', 'line 2'), ('0 0\n1 0x\n', 'line 2'), ('\udcff\udc80\n', 'line 1'),
])
def test_badPolygonFileNamesTheLine(folder, text, line):
    path = pathlib.Path(folder, 'bad.txt')
    path.write_text(text, encoding='utf-8', errors='surrogateescape')
    with pytest.raises(ValueError) as error:
        outlines.readPolygon(path)
    assert str(path) in str(error.value) and line in str(error.value) and str(error.value).endswith('.')


def square(x, y, angle, side):
    c, s = math.cos(angle), math.sin(angle)
    return max(abs(c * x + s * y), abs(c * y - s * x)) < side


# A disc with a turned square hole and a round one; a turned square with a square hole along the pixels.
kPixelDisc = contour(200, lambda x, y: math.hypot(x - 100, y - 100) < 90 and not square(x - 70, y - 100, .35, 20) and
                     math.hypot(x - 145, y - 105) > 15)
kPixelSquare = contour(220, lambda x, y: square(x - 110, y - 110, math.pi / 6, 70) and
                       not square(x - 110, y - 110, 0, 10))


def fewer(loops, tolerance, flags=None):
    outline, holes, _ = simplified(loops[0], loops[1:], tolerance, flags)
    return [outline, *holes]


def shareKept(loops, tolerance):
    """Of the points, after a check of the result."""
    simple = fewer(loops, tolerance)
    _yadefrag.checkedPolygon(simple[0], simple[1:])  # no crossings, holes inside
    farthest = max(map(offLine, loops, simple))
    assert farthest <= tolerance * (1 + 1e-12) and len(simple) == len(loops)
    assert all(np.array_equal(one, other) for one, other in zip(simple, fewer(loops, tolerance)))
    return sum(map(len, simple)) / sum(map(len, loops))


def test_contoursOfPixels():
    # A chord of a circle of 90 may be √(8·90) = 27 long for a sagitta of 1; the pixels' own corners take half of
    # that. Measured: a thirteenth and a twenty-eighth of the points.
    assert len(kPixelDisc) == 3 and len(kPixelSquare) == 2
    assert shareKept(kPixelDisc, 1) < .1 and shareKept(kPixelDisc, 2) < .05 and shareKept(kPixelDisc, .3) < 1
    assert shareKept(kPixelSquare, 1.5) < .02
    assert [len(loop) for loop in fewer(kPixelSquare, 1.5)] == [4, 4] and len(fewer(kPixelSquare, 1e-9)[1]) == 4
    rough, even = (yadefrag.polygonMesh(kPixelDisc[0], kPixelDisc[1:], size=8, simplify=one) for one in (None, 1))
    assert len(even.triangles) < len(rough.triangles) / 4


def test_anyScale():
    small = contour(60, lambda x, y: math.hypot(x - 30, y - 30) < 27)
    for loops, tolerance, scales in ((kPixelDisc, .8, (2.**-300, 2.**300)), (small, 1.5, (1e-3, .0254, 7))):
        wanted = fewer(loops, tolerance)
        for scale in scales:
            found = fewer([loop * scale for loop in loops], tolerance * scale)
            assert all(np.array_equal(one, other * scale) for one, other in zip(found, wanted))


def test_thinWallsDoNotCross():
    """Between a wavy outline and a hole; walls of one pixel between round holes: with the tolerance alone they would."""
    outline = [(i, 0 if i % 2 == 0 else -.8) for i in range(40)] + [(39, 20), (0, 20)]
    hole = [(i - .01, .1 if i % 2 == 0 else -.7) for i in range(39, 0, -1)] + [(.3, 10), (38, 10)]
    shareKept([np.array(outline, dtype=float), np.array(hole[::-1])], 1)
    places = [(x, y) for x in range(12, 120, 21) for y in range(12, 120, 21)]
    loops = contour(130, lambda x, y: all(math.hypot(x - a, y - b) > 10.1 for a, b in places))
    assert len(loops) == 37 and shareKept(loops, 2.4) < .25


def test_intendedCornersStay():
    """Straight ones beside smooth ones."""
    circle = np.array(yadefrag.circle((0, 0), 1, 400))
    flags = np.ones(400, dtype=bool)
    flags[[13, 14]] = False
    outline, _, stay = simplified(circle, [], .01, flags)
    assert len(outline) < 40 and len(stay) == len(outline)
    assert {tuple(circle[i]) for i in (0, 13, 14)} <= set(map(tuple, outline)) and (~stay).sum() == 2
    # So do those between long edges.
    assert np.array_equal(fewer([np.array(kAngle, dtype=float)], .2)[0], kAngle)


def test_impossibleTolerances(monkeypatch):
    plate = [np.array(yadefrag.rectangle(*corners), dtype=float)
             for corners in (((0, 0), (4, 2)), ((1, 1), (1.2, 1.2)))]
    for loops, tolerance, words in (
            (plate, .05, 'hole 0 could vanish'),
            ([np.array([(0, 0), (1, 1), (1, 0), (0, 1)], dtype=float)], .01, 'vertex')):
        with pytest.raises(ValueError, match=words):
            fewer(loops, tolerance)
    assert len(fewer(plate, .049)[1]) == 4
    monkeypatch.setitem(sys.modules, 'shapely.geometry', None)
    with pytest.raises(ImportError, match="simplify works only .* install Debian's package python3-shapely[.]$"):
        fewer(plate, .01)


def sidesOf(loop):
    return list(zip(loop, loop[1:] + loop[:1]))


def star(seed):
    draw = random.Random(seed)
    return [(r * x, r * y) for (x, y), r in ((p, draw.uniform(.3, 1)) for p in geometry.circle((0, 0), 1, 30))]


def checkGrains(outline, grains):
    """They are simple, and fill the outline; each side is that of a neighbour, or on the outline."""
    for grain in grains:
        _yadefrag.checkedPolygon(grain, [])
        assert area(grain) > 0
    whole = abs(area(outline))
    assert sum(map(area, grains)) == pytest.approx(whole, rel=1e-12)
    every = [side for grain in grains for side in sidesOf(grain)]
    sides = set(every)
    assert len(sides) == len(every)
    alone = sum(math.dist(a, b) for a, b in sides if (b, a) not in sides)
    assert alone == pytest.approx(sum(math.dist(*side) for side in sidesOf(outline)), rel=1e-12)
    joints = grainJoints(grains)
    assert len(joints) == (len(sides) - sum((b, a) not in sides for a, b in sides)) / 2 and set(joints) <= sides


def spread(grains):
    areas = list(map(area, grains))
    mean = sum(areas) / len(areas)
    return math.sqrt(sum(one * one for one in areas) / len(areas) / mean**2 - 1)


@pytest.mark.parametrize('outline', [geometry.rectangle((0, 0), (2, 1)), kAngle, kDisc, star(1), star(2), kAngle[::-1],
                                     [(1e6 + x, y - 1e5) for x, y in kAngle]])
def test_grainsFillTheirOutline(outline):
    for n in 1, 2, 3, 10, 200:
        grains = voronoi(outline, n, seed=3)
        checkGrains(outline, grains)
        assert voronoi(outline, n, seed=3) == grains and len(grains) >= n
    assert voronoi(outline, 50, 9) != voronoi(outline, 50, 10)
    assert voronoi(outline, 50, 9, 2) == voronoi(outline, 50, 9, 2)
    checkGrains(outline, voronoi(outline, 100, 4, rounds=3))


def test_roundsMakeGrainsEven():
    # Areas of random cells differ by 0.53 of their mean (Gilbert 1962: 0.529).
    assert spread(voronoi(kPlate, 400, 2)) == pytest.approx(.53, abs=.06)
    assert spread(voronoi(kPlate, 400, 2, 5)) < .3
    assert spread(voronoi(kAngle, 100, 2, 20)) < .15


@pytest.mark.parametrize('outline', [kPlate, kAngle, kDisc])
def test_shortSidesShrinkToPoints(outline):
    def least(grains):
        return min(math.dist(*side) for grain in grains for side in sidesOf(grain))
    given, grains = voronoi(outline, 150, 6), voronoi(outline, 150, 6, shortest=.02)  # .16 across
    checkGrains(outline, grains)
    assert least(grains) >= .02 and least(given) < .002 and len(grains) + 5 >= len(given)
    assert voronoi(outline, 30, 1, shortest=1e-12) == voronoi(outline, 30, 1)


def test_grainsOfAnySizeAndWithoutShapely(monkeypatch):
    for size in (1e-100, 1e150):
        assert len(voronoi([(0, 0), (size, 0), (size, size)], 10)) == 10
    monkeypatch.setitem(sys.modules, 'shapely.ops', None)
    with pytest.raises(ImportError, match="voronoi works only with .* install Debian's package python3-shapely[.]$"):
        voronoi(kPlate, 3)
