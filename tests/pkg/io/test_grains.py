"""Grains: they fill their outline, and neighbours share their sides to the last bit."""

import math
import random
import sys

import pytest

from yadefrag import _yadefrag
from yadefrag.fe import geometry
from yadefrag.fe.grains import grainJoints, voronoi

kAngle = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
kPlate = geometry.rectangle((0, 0), (2, 2))
kDisc = geometry.circle((1, 1), 1, 40)


def area(loop):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in sidesOf(loop)) / 2


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


def test_grainsOfAnySize():
    assert len(voronoi([(0, 0), (1e-100, 0), (1e-100, 1e-100)], 10)) == 10
    assert len(voronoi([(0, 0), (1e150, 0), (1e150, 1e150)], 10)) == 10


def test_missingLibraryIsNamed(monkeypatch):
    monkeypatch.setitem(sys.modules, 'shapely.ops', None)
    with pytest.raises(ImportError, match="voronoi works only with .* install Debian's package python3-shapely[.]$"):
        voronoi(kPlate, 3)


def test_grainsShareSides():
    outline = geometry.rectangle((0, 0), (2, 1))
    grains = voronoi(outline, 20)
    joints = grainJoints(grains)
    inner = sum(math.dist(*side) for side in joints)
    around = sum(math.dist(a, b) for g in grains for a, b in zip(g, g[1:] + g[:1]))
    assert around == pytest.approx(2 * inner + 6, rel=1e-12)
    assert grainJoints(grains[:1]) == []


@pytest.mark.parametrize('call, words', [
    (lambda: voronoi([(0, 0), (1, 0)], 3), ('outline', '2 points')),
    (lambda: voronoi([(0, 0), (1, 1), (1, 0), (0, 1)], 3), ('vertex', 'outline')),
    (lambda: voronoi(geometry.circle((0, 0), 1), 0), ('n is 0', 'positive whole')),
    (lambda: voronoi(geometry.circle((0, 0), 1), 10**6), ('n is 1000000', 'at most')),
    (lambda: voronoi(geometry.circle((0, 0), 1), 3, seed=-1), ('seed is -1', '0 or more')),
    (lambda: voronoi(geometry.circle((0, 0), 1), 3, rounds=1.5), ('rounds is 1.5', 'whole')),
    (lambda: voronoi(geometry.circle((0, 0), 1), 3, shortest=-1), ('shortest is -1', '0 or a')),
    (lambda: voronoi(geometry.rectangle((0, 0), (1, 1)), 30, shortest=.8),
     ('shortest is 0.8 m, too long for these grains',)),
    (lambda: voronoi([(0, 0), (1, 1), (1 + 1e-9, 1)], 3), ('no room for 3 grains',)),
    (lambda: voronoi([(1e17, 1e17), (1e17 + 64, 1e17), (1e17, 1e17 + 64)], 50), ('too far from the origin',)),
    (lambda: grainJoints(3), ('grains is 3', 'list of outlines')),
    (lambda: grainJoints([[(0, 0)]]), ('grains[0]', '1 points')),
])
def test_wrongGrainsAreRefused(call, words):
    with pytest.raises(ValueError) as error:
        call()
    text = str(error.value)
    assert text.endswith('.') and text.count('. ') == 0 and all(word in text for word in words)
