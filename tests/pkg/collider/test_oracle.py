"""The oracle itself, on scenes small enough to know the answer. Needs no yade."""
import numpy as np

from oracle import contacts, masked


def testAperiodic():
    sure, possible = contacts([(0, 0, 0), (1, 0, 0), (0, 3, 0), (2, 0, 0)], [.6, .6, 1, .4])
    assert set(sure) == {(0, 1)}
    assert set(possible) == {(0, 1), (1, 3)}     # 1 and 3 just touch


def testNanNeverTouches():
    sure, _ = contacts([(0, 0, 0), (np.nan, 0, 0), (.1, 0, 0)], [1, np.nan, 1])
    assert sure == {(0, 2): (0, 0, 0)}


def testBlocksDoNotMatter():
    rng = np.random.default_rng(0)
    scene = rng.uniform(0, 1, (90, 3)), rng.uniform(0, .1, 90)
    assert contacts(*scene)[0] == contacts(*scene, block=7)[0] != {}


def testPeriodicImage():
    sure, _ = contacts([(.05, .5, .5), (.95, .5, .5)], [.1, .1], np.eye(3))
    assert sure == {(0, 1): (-1, 0, 0)}
    sure, _ = contacts([(5.05, .5, .5), (-2.05, .5, -9.5)], [.1, .1], np.eye(3))
    assert sure == {(0, 1): (7, 0, 10)}


def testShearedAgainstAllImages():
    """Against a plain search over many images, in a strongly sheared cell."""
    rng = np.random.default_rng(2)
    hSize = np.array([[1, .9, -.8], [0, 1, .7], [0, 0, 1]])
    centres, radii = rng.uniform(0, 2, (25, 3)) @ hSize.T, rng.uniform(.05, .25, 25)
    images = np.array(list(np.ndindex(9, 9, 9))) - 4
    expected = set()
    for i in range(25):
        for j in range(i + 1, 25):
            distance = np.linalg.norm(centres[j] + images @ hSize.T - centres[i], axis=1)
            expected |= {(i, j, *map(int, k)) for k in images[distance < radii[i] + radii[j]]}
    sure, _ = contacts(centres, radii, hSize)
    # where two images touch at once the oracle names one of them
    assert set(sure) == {e[:2] for e in expected} and len(sure) > 20
    assert all((*k, *v) in expected for k, v in sure.items())


def testMasks():
    pairs = dict.fromkeys([(0, 1), (0, 2), (1, 2), (3, 4)])
    assert set(masked(pairs, [1, 2, 3, 2, 2])) == {(0, 2), (1, 2), (3, 4)}
    assert set(masked(pairs, [1, 2, 3, 2, 2], avoid=2)) == {(0, 2), (1, 2)}
    assert set(masked(pairs, [1] * 5, clumps=[7, 7, 2, -1, -1])) == {(0, 2), (1, 2), (3, 4)}
