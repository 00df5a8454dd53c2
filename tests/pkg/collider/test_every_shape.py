"""Every shape and every geometry functor of YADE, against InsertionSortCollider on moving scenes.

YADEFRAG_SHAPE_SEEDS sets the number of random scenes per functor and setting (1).
"""

import numpy as np
import pytest
import yade.system
import yade.wrapper as w

import every_shape
import scenes
from every_shape import isHere, kInserting, kNearIsReal, kNoScene, kNoShape, kScenes
from scenes import O, setEngines

kSteps = 30
kSettings = [0, .004, .05]      # verletDist, m: none, and less and more than a step's way
_expected = {}


def realAtEachStep(make, functor, offset=0, **attributes):
    """[set of real pairs] per step; ids are those of both runs."""
    scenes.clear()
    more = kScenes[functor].build(functor, np.random.default_rng(0), offset)
    setEngines(make(every_shape.boundFunctors(), **attributes), **more)
    history = []
    for _ in range(kSteps):
        O.step()
        history.append(set(scenes.realPairs()))
    return history


def settings(functor, verletDist):
    """(of YADE's collider, of ours). Where functors insert interactions YADE's loses those of bodies
    without a bound, unless all bounds reach everywhere; where what is near is real, both have to
    have the same bounds. Else it runs in every step."""
    if functor in kNearIsReal:
        return (dict(verletDist=verletDist, targetInterv=0),) * 2
    rivals = dict(verletDist=1e3, targetInterv=0) if functor in kInserting else dict(verletDist=0)
    return rivals, dict(verletDist=verletDist)


def expected(collider, functor, setting):
    key = functor, setting['verletDist']
    if key not in _expected:
        _expected[key] = realAtEachStep(collider.rival, functor, **setting)
    return _expected[key]


def compare(functor, wanted, found, mayBeLate):
    """Equal at every step. What a functor inserts is looked at one step later, by YADE's loop: a
    contact may be late by it if the search finds the pair in the step in which it touches."""
    before = set()
    for k, (a, b) in enumerate(zip(wanted, found)):
        missing = a - b
        if mayBeLate:
            missing &= before
        assert not missing and not b - a, \
            f'{functor}, step {k}: missing {sorted(missing)[:5]}, extra {sorted(b - a)[:5]}'
        before = a


@pytest.mark.parametrize('verletDist', kSettings)
@pytest.mark.parametrize('functor', sorted(kScenes))
def testContactsOfEveryFunctor(collider, functor, verletDist):
    if not isHere(functor):
        pytest.skip(f'this YADE has no {functor}')
    rivals, ours = settings(functor, verletDist)
    wanted = expected(collider, functor, rivals)
    compare(functor, wanted, realAtEachStep(collider, functor, **ours), functor in kInserting)
    assert len(set().union(*wanted)) - len(set.intersection(*wanted)) >= 5   # that come or go


def ofYade(base):
    """Names of YADE's own classes."""
    return {n for n in yade.system.childClasses(base) if 'SurfaceSegment' not in n}


def testNoFunctorIsMissing():
    assert ofYade('IGeomFunctor') == set(filter(isHere, kScenes)) | set(filter(isHere, kNoScene))


def shapesOf(functors):
    return {name for functor in filter(isHere, functors) for name in getattr(w, functor)().bases}


def testNoShapeIsMissing():
    tested = shapesOf(kScenes)
    assert ofYade('Shape') == tested | set(filter(isHere, kNoShape)) | shapesOf(kNoScene)
    assert not tested & set(kNoShape)
