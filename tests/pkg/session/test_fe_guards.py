"""What a script does to the bodies of an FESolver behind its back: refused, or without harm. What cannot be copied whole
is not copied at all."""
import builtins
import copy
import gc
import pickle
import weakref

import numpy as np
import pytest

from fe_impact import impact, steps
from fe_scene import impact as elasticImpact
from yade import utils
from yade import wrapper as w

O = builtins.O


# --- clumps and single pieces

def addClump():
    """Numbers of two spheres, and of their clump."""
    clump, ids = O.bodies.appendClumped([utils.sphere((9, 0, 0), 1), utils.sphere((9, 1, 0), 1)])
    return ids, clump


@pytest.mark.parametrize('kind', [list, tuple, iter, np.array, lambda ids: range(2), set,
                                  lambda ids: (i for i in ids), lambda ids: np.array(ids)[::1],
                                  lambda ids: map(int, ids), lambda ids: dict.fromkeys(ids)])
def test_clumpsAreRefused(kind):
    """YADE itself would end the process, for want of a mass."""
    elasticImpact('LebesgueCollider')
    _, clump = addClump()
    for call in (lambda: O.bodies.clump(kind([0, 1])),
                 lambda: O.bodies.addToClump(kind([3, 2]), clump)):
        with pytest.raises(ValueError, match='part of the boundary of body 0 .* in a clump'):
            call()
    O.step()


def test_piecesAreNoMembersOfClumps():
    elasticImpact('LebesgueCollider')
    ids, clump = addClump()
    piece, own = O.bodies[0], O.bodies[clump]
    for call in (lambda: O.bodies.deleteClumpMember(own, piece),
                 lambda: O.bodies.deleteClumpMember(piece, O.bodies[ids[0]]),
                 lambda: O.bodies.deleteClumpBody(piece)):
        with pytest.raises(ValueError, match='part of the boundary of body 0 .* in a clump'):
            call()
    for id in (0, np.int64(0)):
        with pytest.raises(ValueError, match='another one cannot replace it'):
            O.bodies.insertAtId(utils.sphere((9, 5, 0), 1), id)
        with pytest.raises(ValueError, match='cannot be erased alone'):
            O.bodies.erase(id)
    O.step()
    assert len(O.bodies) > 3 and O.bodies[0].id == 0


def test_clumpsOfOthersAreMadeAsBefore():
    elasticImpact('LebesgueCollider')
    ids, clump = addClump()
    other = O.bodies.append(utils.sphere((9, 2, 0), 1))
    O.bodies.addToClump([other], clump)
    assert O.bodies[other].clumpId == clump
    O.bodies.releaseFromClump(other, clump)
    another = O.bodies.append(utils.sphere((9, 4, 0), 1))
    made = O.bodies.clump(i for i in (other, another))
    assert O.bodies[another].clumpId == made
    O.bodies.deleteClumpMember(O.bodies[clump], O.bodies[ids[0]])
    O.bodies.deleteClumpBody(O.bodies[made])


# --- what a body is made of

def aSphere():
    return w.Sphere(radius=1)


@pytest.mark.parametrize('finder', [None, 'LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('name, value', [
    ('mat', lambda: None), ('shape', lambda: None), ('shape', aSphere), ('bound', lambda: None),
    ('mat', lambda: w.FrictMat()), ('state', lambda: None), ('state', w.State)])
def test_partsAreTakenAway(name, value, finder):
    """From all pieces, or from the first, as cracks begin: the step succeeds or reports what is wrong,
    and so does loading what was saved."""
    for count in (1, 10**6):
        O.reset()
        solver = impact(finder)
        steps(120)
        before = solver.numCracks
        sentence = None
        try:
            for body in [b for b in O.bodies if isinstance(b.shape, w.SurfaceSegment)][:count]:
                setattr(body, name, value())
            steps(100)
        except (RuntimeError, ValueError) as error:
            sentence = str(error)
        assert solver.numCracks > before or 'must not replace it' in sentence
        assert sentence is not None or name not in ('state', 'shape')
        if name == 'bound':
            assert sentence is None
        if sentence is None:
            solver.removeBody(0)
            O.saveTmp()
            O.loadTmp()
            try:
                steps(3)
            except (RuntimeError, ValueError) as error:
                assert 'must not replace it' in str(error)


# --- copies

COPIES = [copy.copy, copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))]


@pytest.mark.parametrize('make', COPIES)
def test_aSolverWithBodiesIsNotCopied(make):
    solver = elasticImpact()
    with pytest.raises(TypeError, match='cannot be copied or pickled.*O.save keeps them'):
        make(solver)
    steps(3)


@pytest.mark.parametrize('make', COPIES)
@pytest.mark.parametrize('thing', [
    lambda: w.FESolver(damping=3, passes=2), lambda: w.FEMat(young=3e7, poisson=.1),
    lambda: w.BrittleFEMat(young=3e7, tensileStrength=5, seed=7), lambda: w.SurfaceSegment(halo=.2),
    lambda: w.LebesgueCollider([w.Bo1_Sphere_Aabb()], verletDist=.3),
    lambda: w.Ig2_Sphere_SurfaceSegment_ScGeom(label='a'), lambda: w.Bo1_SurfaceSegment_Aabb()])
def test_allElseIsCopiedWhole(make, thing):
    one = thing()
    other = make(one)
    assert type(other) is type(one) and other is not one
    values, copied = one.dict(), other.dict()
    values.pop('boundDispatcher', None), copied.pop('boundDispatcher', None)
    assert values == copied


# --- memory

@pytest.mark.parametrize('collider', [None, 'LebesgueCollider'])
def test_resetFreesTheSolver(collider):
    def made():
        solver = elasticImpact(collider)
        steps(3)
        O.engines = list(O.engines)
        O.engines = O.engines[:1] + [w.PyRunner(label='named')] + O.engines[1:]
        steps(1)
        return [weakref.ref(engine) for engine in O.engines]
    engines = made()
    assert all(engine() for engine in engines)
    O.reset()
    gc.collect()
    assert [engine() for engine in engines if not isinstance(engine(), w.PyRunner)] == \
        [None] * (len(engines) - 1)


def test_whatWasInAListIsFreed():
    """YADE alone keeps what is in a list of bodies, engines or functors permanently."""
    def made():
        functors = [w.Bo1_Sphere_Aabb()], [w.Ig2_Sphere_Sphere_ScGeom()], \
            [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]
        listed = [w.Body(), w.Body(), *(functor for one in functors for functor in one)]
        O.bodies.append(listed[:1])
        O.bodies.append(tuple(listed[1:2]))
        O.engines = [w.InsertionSortCollider(functors[0]), w.InteractionLoop(*functors[1:])]
        return [weakref.ref(item) for item in listed + O.engines]
    O.reset()
    items = made()
    assert all(item() for item in items)
    O.reset()
    gc.collect()
    assert [item() for item in items] == [None] * len(items)
