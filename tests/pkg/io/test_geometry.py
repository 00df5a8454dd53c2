"""The outlines that yadefrag.geometry makes and reads."""

import math

import pytest

from yadefrag.fe import geometry
from yadefrag.io import outlines


def area(loop):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(loop, loop[1:] + loop[:1])) / 2


def isOneSentence(error):
    text = str(error.value)
    return text.endswith('.') and text.count('. ') == 0 and '\n' not in text


def test_rectangleIsCounterClockwise():
    assert geometry.rectangle((0, 1), (2, 4)) == [(0, 1), (2, 1), (2, 4), (0, 4)]


def test_circleHasItsPointsOnIt():
    loop = geometry.circle((1, 2), 3)
    assert len(loop) == 64 and loop[0] == (4, 2)
    assert all(math.isclose(math.dist(p, (1, 2)), 3, rel_tol=1e-15) for p in loop)
    assert area(loop) == pytest.approx(math.pi * 9 * (1 - .0016), rel=2e-5)
    assert len(geometry.circle((0, 0), 1, 5)) == 5


def test_ringIsTwoCircles():
    outline, holes = geometry.ring((0, 0), .8, 1, 12)
    assert outline == geometry.circle((0, 0), 1, 12)
    assert holes == [geometry.circle((0, 0), .8, 12)]


@pytest.mark.parametrize('call, words', [
    (lambda: geometry.rectangle((0, 0), (0, 1)), ('high', '(0, 1)', 'low')),
    (lambda: geometry.rectangle((0, 0, 0), (1, 1)), ('low', '(0, 0, 0)', 'pair')),
    (lambda: geometry.rectangle(3, (1, 1)), ('low', '3', 'pair')),
    (lambda: geometry.rectangle((0, 0), (1, math.nan)), ('high', 'nan', 'finite')),
    (lambda: geometry.circle((0, math.inf), 1), ('centre', 'inf', 'finite')),
    (lambda: geometry.circle((0, 0), 0), ('radius', '0', 'positive')),
    (lambda: geometry.circle((0, 0), 'a'), ('radius', "'a'", 'number')),
    (lambda: geometry.circle((0, 0), math.nan), ('radius', 'nan', 'positive')),
    (lambda: geometry.circle((0, 0), 1, 2), ('n', '2', 'at least 3')),
    (lambda: geometry.circle((0, 0), 1, 3.5), ('n', '3.5', 'whole')),
    (lambda: geometry.ring((0, 0), 1, 1), ('inner', '1 m', 'less than outer')),
    (lambda: geometry.ring((0, 0), -1, 1), ('inner', '-1', 'positive')),
])
def test_badArgumentsAreNamed(call, words):
    with pytest.raises(ValueError) as error:
        call()
    assert isOneSentence(error)
    for word in words:
        assert word in str(error.value)


def test_polygonFileIsRead(folder):
    path = folder + '/plate.txt'
    with open(path, 'w', encoding='utf-8') as file:
        file.write('# a plate\n\n0 0  # corner\n4 0\n# half way\n4 3\n\n\n1 1\n1 2\n2e0 1\n\n')
    outline, holes = outlines.readPolygon(path)
    assert outline == [(0, 0), (4, 0), (4, 3)]
    assert holes == [[(1, 1), (1, 2), (2, 1)]]


@pytest.mark.parametrize('text, line', [
    ('0 0\n1\n', 'line 2'), ('0 0\n1 0\nx 1\n', 'line 3'), ('0 0 0\n', 'line 1'),
    ('# nothing\n', 'line 1'), ('', 'line 1'), ('0 0\n\n1 nan\n', 'line 3'),
    ('0 0\n1e999 0\n', 'line 2'), ('0 0\n1 0x\n', 'line 2'), ('\udcff\udc80\n', 'line 1'),
])
def test_badPolygonFileNamesTheLine(folder, text, line):
    path = folder + '/bad.txt'
    with open(path, 'wb') as file:
        file.write(text.encode('utf-8', 'surrogateescape'))
    with pytest.raises(ValueError) as error:
        outlines.readPolygon(path)
    assert path in str(error.value) and line in str(error.value)
    assert str(error.value).endswith('.')
