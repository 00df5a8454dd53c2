"""inCurveOrder returns a permutation, in the order of the Lebesgue curve."""
import functools

import numpy as np
import pytest
import yadefrag
from yade import utils

from scenes import O, clear


def _later(a, b):
    """Of two cells (three whole numbers each): -1, 0, 1 as a comes before b on the curve. The axis
    whose coordinates differ in the highest bit decides; of equal bits, z before y before x."""
    best, axis = 0, 2
    for k in (2, 1, 0):
        bit = (int(a[k]) ^ int(b[k])).bit_length()
        if bit > best:
            best, axis = bit, k
    return (a[axis] > b[axis]) - (a[axis] < b[axis])


def _cells(places):
    places = np.asarray(places, float)
    low = places.min(axis=0)
    return np.floor((places - low) * ((2**21 - 1) / (places.max(axis=0) - low).max())).astype(int)


@pytest.mark.parametrize('flat', [None, 0, 2])
def testBodiesAreAPermutationInCurveOrder(flat):
    clear()
    rng = np.random.default_rng(1)
    places = rng.normal(size=(500, 3)) * [1, 10, .1] + [1e3, 0, -5]
    if flat is not None:
        places[:, flat] = 3
    bodies = [utils.sphere(p, .1) for p in places]
    ordered = yadefrag.inCurveOrder(bodies)
    assert sorted(map(id, ordered)) == sorted(map(id, bodies))
    assert len(O.bodies) == 0
    found = _cells([b.state.pos for b in ordered])
    expected = sorted(_cells(places).tolist(), key=functools.cmp_to_key(_later))
    assert found.tolist() == expected
    assert [tuple(p) for p in yadefrag.inCurveOrder(places)] == \
        [tuple(b.state.pos) for b in ordered]


def testNeighboursOnTheCurveAreNear():
    """Mean distance of consecutive bodies: of the order of their spacing, not of the box."""
    rng = np.random.default_rng(2)
    places = rng.uniform(0, 1, (8000, 3))
    ordered = np.array(yadefrag.inCurveOrder(places))
    step = np.linalg.norm(np.diff(ordered, axis=0), axis=1)
    assert step.mean() < 3 * 8000**(-1 / 3)
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).mean() > 10 * 8000**(-1 / 3)


def testPlacesWithRadiiAndEqualPlaces():
    pairs = [((0, 0, 0), .1), ((1, 1, 1), .2), ((0, 0, 0), .3), ((1, 0, 0), .4)]
    assert yadefrag.inCurveOrder(pairs) == [pairs[0], pairs[2], pairs[3], pairs[1]]
    assert yadefrag.inCurveOrder(iter([(2, 2, 2)])) == [(2, 2, 2)]
    assert yadefrag.inCurveOrder([]) == []
