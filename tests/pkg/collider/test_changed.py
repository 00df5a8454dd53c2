"""A search of the bodies that changed leaves the interactions of a search of all.

The oracle's contacts are all there at every step, and the potential interactions are those that
brute force finds from the bounds, whenever these were made."""
import random

import numpy as np
import pytest
import yadefrag  # noqa: F401
from yade import utils
from yade.minieigenHP import Vector3

from scenes import (
    O, addSpheres, allPairs, clear, makeCollider, positions, realPairs, setEngines, stepAndCheck)

RADIUS = .02


def _cloud(n, seed, speed=0.):
    """`n` spheres in a unit box, a hundredth of them fast; the fast ones' ids and the collider."""
    clear()
    rng = np.random.default_rng(seed)
    velocities = rng.normal(size=(n, 3)) * speed
    fast = rng.choice(n, max(1, n // 100), replace=False)
    velocities[fast] = rng.normal(size=(len(fast), 3)) * .02
    O.dt = .1
    addSpheres(rng.uniform(0, 1, (n, 3)), np.full(n, RADIUS), velocities)
    return fast, setEngines(makeCollider('LebesgueCollider'))


def _pairsByBounds(collider):
    """(sure, possible) pairs of spheres, by brute force: those that could touch within the rooms
    that their bounds have now."""
    bodies = [b for b in O.bodies if b and b.bound and isinstance(b.shape, utils.Sphere)]
    centres = np.array([b.bound.refPos for b in bodies])
    radii = np.array([b.shape.radius for b in bodies])
    sweeps = np.array([b.bound.sweepLength for b in bodies])
    ids = np.array([b.id for b in bodies])
    # Of every pair first one coordinate: most of the time is in the others.
    room = 1.001 * (radii + sweeps)
    near = abs(centres[:, 0, None] - centres[:, 0]) <= room[:, None] + room
    i, j = np.nonzero(np.triu(near, 1))
    apart = np.maximum(abs(centres[i] - centres[j]) - (sweeps[i] + sweeps[j])[:, None], 0)
    distance = np.sqrt((apart**2).sum(axis=1)) - radii[i] - radii[j]
    may = np.array([b.mask for b in bodies])
    clumps = np.array([b.clumpId for b in bodies])
    allowed = (may[i] & may[j] != 0) & ((clumps[i] < 0) | (clumps[i] != clumps[j]))

    def names(where):
        return {(min(a, b), max(a, b)) for a, b in zip(ids[i[where]], ids[j[where]])}
    return names(allowed & (distance < -1e-12)), names(distance < 1e-12)


def _check(collider):
    sure, possible = _pairsByBounds(collider)
    found = allPairs()
    assert sure <= found, f'step {O.iter}: missing {sorted(sure - found)[:3]}'
    assert found <= possible, f'step {O.iter}: too many {sorted(found - possible)[:3]}'
    return len(sure)


@pytest.mark.long
def testFewAreSearchedWhereFewMove():
    fast, collider = _cloud(2000, 1)
    stepAndCheck()
    assert collider.searched == 2000
    counts = []
    for _ in range(60):
        before = collider.numAction
        stepAndCheck()
        if collider.numAction > before:
            counts.append(collider.searched)
            _check(collider)
    assert len(counts) >= 5
    # All are searched once in a while, when the few have cost as much.
    assert sum(n > len(fast) for n in counts) <= len(counts) / 5


@pytest.mark.parametrize('seed', range(3))
def testSamePairsWhileSomeMove(seed):
    """A few fast ones among slow ones: most searches are of few, some of all."""
    _, collider = _cloud(600, seed, speed=.0005)
    some = 0
    for _ in range(80):
        before = collider.numAction
        stepAndCheck()
        if collider.numAction > before:
            _check(collider)
            some += 0 < collider.searched < 600
    assert some >= 5


@pytest.mark.parametrize('redirection', [False, True])
def testSamePairsWhileBodiesComeAndGo(redirection):
    rng = random.Random(3)
    _, collider = _cloud(500, 4, speed=.0005)
    O.bodies.enableRedirection = redirection
    O.step()
    some = 0
    for step in range(60):
        new = [utils.sphere(Vector3(rng.random(), rng.random(), rng.random()), RADIUS)
               for _ in range(3)]
        for body in new:
            body.state.blockedDOFs = 'xyzXYZ'
        O.bodies.append(new)
        for id in rng.sample([b.id for b in O.bodies], 3):
            O.bodies.erase(id)
        stepAndCheck()
        _check(collider)
        some += collider.searched < 50
    assert some >= 30


def testRadiiThatGrowAndShrink():
    rng = random.Random(5)
    _, collider = _cloud(400, 6, speed=.0005)
    for step in range(40):
        for id in rng.sample(range(400), 4):
            O.bodies[id].shape.radius *= rng.choice([.8, 1.3])
        collider()  # growth alone does not call for a search
        _check(collider)
        stepAndCheck()
    assert collider.searchedTotal < 400 * collider.numAction / 2


def testMasksAndClumpsThatChange():
    rng = random.Random(7)
    _, collider = _cloud(400, 8)
    O.step()
    touching = sorted(realPairs())
    for step in range(20):
        a, b = rng.choice(touching)
        O.bodies[a].mask = rng.choice([1, 2, 3])
        collider()
        sure, _ = _pairsByBounds(collider)
        assert sure <= allPairs()
    for id in range(400):
        O.bodies[id].mask = 1
    pair = touching[0]
    others = [id for id in range(400) if id not in pair][:2]
    clump = O.bodies.clump([*pair, *others])  # YADE releases none of the last two
    collider()
    O.bodies.releaseFromClump(pair[0], clump)
    collider()
    sure, _ = _pairsByBounds(collider)
    assert pair in sure and sure <= allPairs()


def testWallsFacetsAndBoxesThatMove():
    rng = np.random.default_rng(9)
    _, collider = _cloud(300, 10, speed=.0005)
    ids = O.bodies.append([utils.wall(.5, 0), utils.box((.5, .5, .5), (.1, .2, .05)),
                           utils.facet([(.2, .2, .2), (.8, .2, .2), (.2, .8, .3)])])
    O.bodies[ids[0]].state.vel = (.01, 0, 0)
    O.bodies[ids[1]].state.angVel = (0, 0, .05)
    O.bodies[ids[1]].state.blockedDOFs = O.bodies[ids[2]].state.blockedDOFs = 'xyzXYZ'
    some = 0
    for step in range(60):
        O.step()
        some += 0 < collider.searched < 200
        found = {p for p in allPairs() if set(p) & set(ids)}
        for id in ids:
            bare = O.bodies[id].bound
            for body in O.bodies:
                if body.id in ids or not body.bound:
                    continue
                low, high = body.bound.min, body.bound.max
                meets = all(low[k] <= bare.max[k] and bare.min[k] <= high[k] for k in range(3))
                assert meets == (tuple(sorted((id, body.id))) in found), (step, id, body.id)
    assert some >= 5


def testInteractionsThatAScriptTakesAwayComeBack():
    _, collider = _cloud(400, 11)
    O.step()
    pairs = allPairs()
    O.interactions.clear()
    collider()
    assert len(pairs) > 20 and realPairs() == {}
    _check(collider)


def testSameOutcomeAsWithSearchesOfAll():
    """The oracle's contacts in both runs are those of one motion, to the last bit."""
    def run(all):
        _cloud(500, 12, speed=.0005)
        collider = O.engines[1]
        for _ in range(50):
            collider.doSort = all
            stepAndCheck()
        return positions(), collider.searchedTotal
    (few, fewSearched), (every, allSearched) = run(False), run(True)
    assert (few == every).all()
    assert fewSearched < allSearched / 3
