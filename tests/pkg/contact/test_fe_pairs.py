"""Pairs of surface segments: FESolver finds them; with a collider they never become interactions."""
import builtins
import math

import numpy as np
import pytest

import fe_chain as chain
import yadefrag  # noqa: F401
from yade import wrapper as w

O = builtins.O


def ring(centre, count, component, mat, halo, selfContact=False):
    angles = np.arange(count) * 2 * math.pi / count
    points = np.stack([centre[0] + np.cos(angles), centre[1] + np.sin(angles)], axis=1)
    return chain.straight(points, mat, closed=True, component=component, halo=halo,
                          selfContact=selfContact)


def scene(collider, selfContact=False, spheres=()):
    mat = w.FEMat(young=1e6, poisson=.3, density=1000, frictionAngle=0)
    O.materials.append(mat)
    bodies = []
    for k, x in enumerate((0, 2.01, 4.02)):
        bodies += ring((x, .1 * k), 24, k, mat, .05, selfContact)
    bodies += [chain.ball(at, .3, mat) for at in spheres]
    O.bodies.append(bodies)
    return chain.engines(collider([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()]))


def overlapping():
    """{(id1, id2)} of segments' bounds that overlap, by a plain double loop."""
    found = set()
    segments = [b for b in O.bodies if isinstance(b.shape, w.SurfaceSegment)]
    for a in segments:
        for b in segments:
            if a.id < b.id and all(a.bound.min[i] <= b.bound.max[i] and
                                   b.bound.min[i] <= a.bound.max[i] for i in range(3)):
                found.add((a.id, b.id))
    return found


def isSelf(pair):
    return O.bodies[pair[0]].shape.component == O.bodies[pair[1]].shape.component


@pytest.mark.parametrize('selfContact', [False, True])
def test_pairsAreThoseOfTheBounds(collider, selfContact):
    finder = scene(collider, selfContact)
    O.step()
    wanted = {p for p in overlapping() if selfContact or not isSelf(p)}
    assert wanted and set(finder.entryPairs()) == wanted
    assert len(finder.entryPairs()) == len(wanted)
    assert len(O.interactions.all()) == 0


def test_masksHoldForPairs(collider):
    finder = scene(collider)
    for b in O.bodies:
        b.mask = 1 if b.shape.component == 1 else 2
    O.step()
    assert overlapping() and not finder.entryPairs()


def test_segmentsAloneAreSearchedOnDemand(collider):
    """Not every step, though verletDist has no sphere to be set by."""
    finder = scene(collider)
    for b in O.bodies:
        b.state.vel = (.1, 0, 0)
    for _ in range(20):
        O.step()
    assert finder.numAction == 1 and not finder.isActivated()
    finder.doSort = True
    O.step()
    assert finder.numAction == 2
    O.bodies.append(chain.ball((0, 1.2), .3, O.materials[0]))
    O.step()
    assert finder.numAction == 3
    O.step()
    assert [i.id1 for i in O.interactions] or len(O.interactions.all()) > 0


def test_spheresAmongSegments(collider):
    """Spheres meet segments by interactions; segments meet each other by pairs, as before."""
    finder = scene(collider, spheres=[(0, 1.25), (2, 1.35)])
    O.dt = 1e-6
    O.step()
    assert set(finder.entryPairs()) == {p for p in overlapping() if not isSelf(p)}
    kinds = {tuple(sorted(type(O.bodies[k].shape).__name__ for k in (i.id1, i.id2)))
             for i in O.interactions.all()}
    assert kinds == {('Sphere', 'SurfaceSegment')}
    assert len(list(O.interactions)) >= 2


def test_withoutSegmentsThereAreNoPairs(collider):
    finder = collider([w.Bo1_Sphere_Aabb()])
    O.bodies.append([chain.ball((x, 0), .6, w.FEMat()) for x in range(3)])
    chain.engines(finder)
    O.step()
    assert finder.entryPairs() == [] and len(O.interactions.all()) == 2


def test_pairsBecomeInteractionsElsewhereAndGo(collider):
    """After another collider has made interactions of them, ours takes them back."""
    finder = scene(collider)
    ours = O.engines
    rival = collider.rival([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()], verletDist=0)
    O.engines = [ours[0], rival, *ours[2:]]
    O.step()
    O.step()
    found = {tuple(sorted((i.id1, i.id2))) for i in O.interactions.all()}
    assert found == overlapping() and not list(O.interactions)
    O.engines = ours
    O.step()
    assert set(finder.entryPairs()) < found and len(O.interactions.all()) == 0


def test_boundsHoldUntilTheNextSearch(collider):
    """A body that falls, turns and rebounds among spheres: where spheres are looked for, its pieces
    are within their bounds, though the collider does not search in each step."""
    import yadefrag
    O.materials.append(w.FEMat(young=1e6, poisson=.3, density=1000, frictionAngle=.3, label='m'))
    fe = w.FESolver()
    fe.addPolygon(yadefrag.rectangle((0, .1), (1, .6)), size=.1, material='m',
                  velocity=lambda x, y: (-.7 * y, .7 * x - 1))
    fe.addPolygon(yadefrag.rectangle((-.5, -.5), (1.5, 0)), size=.1, material='m',
                  fixed=lambda x, y: y < -.499)
    O.bodies.append([chain.ball((x, .9), .1, O.materials[0]) for x in (-.2, .3, .8)])
    O.engines = yadefrag.engines(fe, spheres=True, gravity=(0, -10), collider=getattr(w, collider.name))
    O.dt = .5 * fe.criticalTimeStep()
    finder, least = O.engines[1], []

    def look():
        for b in O.bodies:
            if isinstance(b.shape, w.SurfaceSegment):
                for at in (b.shape.start, b.shape.end):
                    least.append(builtins.min(builtins.min(at[i] - b.bound.min[i],
                                                           b.bound.max[i] - at[i]) for i in range(2)))

    O.engines = O.engines[:3] + [w.PyRunner(iterPeriod=1, command='look()')] + O.engines[3:]
    builtins.look = look
    steps, met = 1000, 0
    try:
        for k in range(steps):
            O.step()
            if k % 20 == 0:
                met = builtins.max(met, len(list(O.interactions)))
    finally:
        del builtins.look
    assert fe.energy['contact'] != 0 and met > 0
    assert min(least) >= 0
    assert 2 < finder.numAction < steps / 2
