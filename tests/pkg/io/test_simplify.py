"""Outlines with fewer points, within a distance."""

import math
import sys

import numpy as np
import pytest

import yadefrag
from yadefrag import _yadefrag
from yadefrag.fe.simplify import simplified


def contour(count, isInside):
    """Loops around the pixels whose middle is inside, the longest first, with a point at each corner of a pixel."""
    def isIn(i, j):
        return 0 <= i < count and 0 <= j < count and isInside(i + .5, j + .5)
    after = {}
    for i, j in np.ndindex(count, count):
        if isIn(i, j):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            beside = [(i, j - 1), (i + 1, j), (i, j + 1), (i - 1, j)]
            after.update((corners[k], corners[(k + 1) % 4]) for k in range(4) if not isIn(*beside[k]))
    loops = []
    while after:
        at, loop = min(after), []
        while at in after:
            loop.append(at)
            at = after.pop(at)
        loops.append(np.array(loop, dtype=float))
    return sorted(loops, key=len, reverse=True)


def square(x, y, angle, side):
    c, s = math.cos(angle), math.sin(angle)
    return max(abs(c * x + s * y), abs(c * y - s * x)) < side


# A disc with a turned square hole and a round one; a turned square with a square hole along the pixels.
kDisc = contour(200, lambda x, y: math.hypot(x - 100, y - 100) < 90 and not square(x - 70, y - 100, .35, 20) and
                math.hypot(x - 145, y - 105) > 15)
kSquare = contour(220, lambda x, y: square(x - 110, y - 110, math.pi / 6, 70) and not square(x - 110, y - 110, 0, 10))


def fewer(loops, tolerance, flags=None):
    outline, holes, _ = simplified(loops[0], loops[1:], tolerance, flags)
    return [outline, *holes]


def toLoop(point, loop):
    """(m) Distance of a point from a loop."""
    sides = np.roll(loop, -1, axis=0) - loop
    along = np.clip(((point - loop) * sides).sum(1) / (sides**2).sum(1), 0, 1)
    return np.hypot(*(point - loop - along[:, None] * sides).T).min()


def shareKept(loops, tolerance):
    """Of the points, after a check of the result."""
    simple = fewer(loops, tolerance)
    _yadefrag.checkedPolygon(simple[0], simple[1:])  # no crossings, holes inside
    farthest = max(toLoop(point, now) for loop, now in zip(loops, simple) for point in loop)
    assert farthest <= tolerance * (1 + 1e-12) and len(simple) == len(loops)
    assert all(np.array_equal(one, other) for one, other in zip(simple, fewer(loops, tolerance)))
    return sum(map(len, simple)) / sum(map(len, loops))


def test_contoursOfPixels():
    # A chord of a circle of 90 may be √(8·90) = 27 long for a sagitta of 1; the pixels' own corners take half of
    # that. Measured: a thirteenth and a twenty-eighth of the points.
    assert len(kDisc) == 3 and len(kSquare) == 2
    assert shareKept(kDisc, 1) < .1 and shareKept(kDisc, 2) < .05 and shareKept(kDisc, .3) < 1
    assert shareKept(kSquare, 1.5) < .02
    assert [len(loop) for loop in fewer(kSquare, 1.5)] == [4, 4] and len(fewer(kSquare, 1e-9)[1]) == 4


def test_anyScale():
    wanted = fewer(kDisc, .8)
    for scale in 2.**-300, 2.**300:
        found = fewer([loop * scale for loop in kDisc], .8 * scale)
        assert all(np.array_equal(one, other * scale) for one, other in zip(found, wanted))


def test_holesStayInside():
    """A thin wall between a wavy outline and a hole: with the tolerance alone they would cross."""
    outline = [(i, 0 if i % 2 == 0 else -.8) for i in range(40)] + [(39, 20), (0, 20)]
    hole = [(i - .01, .1 if i % 2 == 0 else -.7) for i in range(39, 0, -1)] + [(.3, 10), (38, 10)]
    shareKept([np.array(outline, dtype=float), np.array(hole[::-1])], 1)


def test_stonesInMortar():
    """Walls of one pixel between round holes, of which the simplified ones would cross."""
    places = [(x, y) for x in range(12, 120, 21) for y in range(12, 120, 21)]
    loops = contour(130, lambda x, y: all(math.hypot(x - a, y - b) > 10.1 for a, b in places))
    assert len(loops) == 37 and shareKept(loops, 2.4) < .25


def test_straightCornersBesideSmoothOnesStay():
    circle = np.array(yadefrag.circle((0, 0), 1, 400))
    flags = np.ones(400, dtype=bool)
    flags[[13, 14]] = False
    outline, _, stay = simplified(circle, [], .01, flags)
    assert len(outline) < 40 and len(stay) == len(outline)
    assert {tuple(circle[i]) for i in (0, 13, 14)} <= set(map(tuple, outline)) and (~stay).sum() == 2


def test_cornersBetweenLongEdgesStay():
    outline = np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], dtype=float)
    assert np.array_equal(fewer([outline], .2)[0], outline)


def test_simplifiedContourMeshesAtItsSize():
    rough, even = (yadefrag.polygonMesh(kDisc[0], kDisc[1:], size=8, simplify=one) for one in (None, 1))
    assert len(even.triangles) < len(rough.triangles) / 4


def test_impossibleTolerances(monkeypatch):
    plate = [np.array(yadefrag.rectangle(*corners), dtype=float)
             for corners in (((0, 0), (4, 2)), ((1, 1), (1.2, 1.2)))]
    for loops, tolerance, words in (
            (plate, 0, 'simplify is 0, it must be a positive number'), (plate, math.nan, 'simplify is nan'),
            (plate, .7, 'the outline could vanish; it must be less than'), (plate, .05, 'hole 0 could vanish'),
            ([np.array([(0, 0), (1, 1), (1, 0), (0, 1)], dtype=float)], .01, 'vertex')):
        with pytest.raises(ValueError, match=words):
            fewer(loops, tolerance)
    assert len(fewer(plate, .049)[1]) == 4
    monkeypatch.setitem(sys.modules, 'shapely.geometry', None)
    with pytest.raises(ImportError, match="simplify works only .* install Debian's package python3-shapely[.]$"):
        fewer(plate, .01)
