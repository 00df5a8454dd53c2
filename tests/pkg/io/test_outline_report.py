"""What the finest feature of an outline costs, before a mesh is made, beside the mesh's own step."""
import builtins
import warnings

import numpy as np
import pytest

import yadefrag
from fe_scene import fe
from outline_files import svg
from yadefrag import outlineReport

O = builtins.O
kSquare = yadefrag.rectangle((0, 0), (1, 1))
kShort = [(0, 0), (.5, 0), (.505, 0), (1, 0), (1, 1), (0, 1)]
kNotch = [(0, 0), (1, 0), (1, 1), (.504, 1), (.504, .5), (.5, .5), (.5, 1), (0, 1)]
kNeck = [(0, 0), (1, 0), (1, 1), (.51, .5), (1, 2), (0, 2), (.5, .5), (0, 1)]


def stepOf(outline, holes=(), **more):
    solver = fe()
    with warnings.catch_warnings():
        warnings.simplefilter('ignore')  # of short edges
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
    step = stepOf(outline)
    found = report(outline)
    assert found['finest'] == pytest.approx(finest) and found['points'] == len(outline)
    at = 'shortestEdgeAt' if 'edge' in word else 'narrowestAt'
    assert found[at] == pytest.approx(place)
    assert found['ratio'] == pytest.approx(.05 / finest)
    assert word in found['words'] and found['words'].endswith('.')
    # According to the docstring; the shapes of triangles differ.
    assert .5 < step / found['timeStep'] < 3


def test_noFeatureFinerThanTheSize():
    step = stepOf(kSquare)
    found = report(kSquare)
    assert found['ratio'] == 1 and found['finest'] == .05 and found['shortestEdge'] == 1
    assert found['timeStep'] == pytest.approx(step, rel=.4)
    assert 'no edge and no gap finer than the size' in found['words']


def test_holesAndWallsBetweenThem():
    hole = yadefrag.rectangle((.2, .01), (.4, .2))
    other = yadefrag.rectangle((.403, .05), (.6, .2))
    assert stepOf(kSquare, [hole, other]) > 0
    found = report(kSquare, [hole, other])
    assert found['narrowest'] == pytest.approx(.003) and found['narrowestAt'][0] in (.4, .403)
    assert report(kSquare, [hole])['narrowest'] == pytest.approx(.01)


def test_simplifyTakesTheCostAway():
    fe()
    bumps = np.linspace(0, 1, 401)
    outline = [(x, 1e-4 * (i % 2)) for i, x in enumerate(bumps)] + [(1, 1), (0, 1)]
    assert report(outline)['ratio'] == pytest.approx(20, rel=.01)
    assert report(outline, simplify=1e-3)['ratio'] == 1


def test_nothingIsAdded():
    fe()
    report(kShort)
    assert len(O.bodies) == 0


@pytest.mark.parametrize('call, sentence', [
    (lambda: report(kSquare[:2]), 'outline has 2 points, it must have at least 3'),
    (lambda: report(kSquare, 3), 'holes is 3, it must be a list of loops'),
    (lambda: report(kSquare, [[1]]), r'holes\[0\] must be a list of points'),
    (lambda: report(kSquare, size=0), 'size is 0, it must be a positive number'),
    (lambda: report(kSquare, material='wood'), "material is 'wood', which is not in O.materials"),
    (lambda: report(kSquare, simplify=1), 'could vanish'),
    (lambda: report([(0, 0), (0, 0), (1, 0), (0, 1)]), r'touches itself at \(0, 0\)'),
    (lambda: report([(0, 0), (1, 0), (1, 1), (.5, 0)]), r'touches itself at \(0.5, 0\)'),
])
def test_wrongArguments(call, sentence):
    fe()
    with pytest.raises(ValueError, match=sentence):
        call()


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
        report(kSquare, scale=2)
    with pytest.raises(TypeError, match='^byLayer is given, but outlineReport reports on all layers'):
        report(file, byLayer=True)
    with pytest.raises(TypeError, match="unexpected keyword argument 'scales'"):
        report(file, scales=2)
