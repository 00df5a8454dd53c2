"""Calls by position, messages that many bodies have, and what is written about a refused step. Curves are given and
returned alike; what is refused is shown in short. What a script does to the bodies of an FESolver behind its back:
refused, or without harm; what cannot be copied whole is not copied at all. What is accepted: test_forms.py."""
import builtins
import copy
import gc
import pickle
import warnings
import weakref

import numpy as np
import pytest

import yadefrag
from fe_scene import brittleImpact, heard, impact, O, steps
from project import inYade
from yade import utils, wrapper as w
from yadefrag import arguments

kSquare = yadefrag.rectangle((0, 0), (1, 1))


def solver(**settings):
    O.materials.append(w.BrittleFEMat(young=70e9, poisson=.2, density=2500, tensileStrength=6e6, label='s',
                                      **settings))
    return w.FESolver()


@pytest.mark.parametrize('arguments', [(kSquare, .5, 's'), (kSquare, (), .5, 's'), (kSquare, lambda x, y: .5, 's'),
                                       (kSquare, [[(.2, .2), (.4, .2), (.3, .4)]], .5, 's')])
def test_bodiesByPosition(arguments):
    found = solver()
    found.addPolygon(*arguments)
    by = ('size', 'material') if len(arguments) == 3 else ('holes', 'size', 'material')
    nodes = found.nodes
    O.reset()
    other = solver()
    other.addPolygon(arguments[0], **dict(zip(by, arguments[1:])))
    assert (nodes == other.nodes).all() and len(nodes) > 4
    assert other.addTriangles(*yadefrag.rectangleMesh((2, 0), (3, 1), 2, 2), 's') == 1


def wall(count, fe):
    """`count` bricks with a mesh too coarse for their fracture energy."""
    with warnings.catch_warnings(record=True, action='always') as caught:
        for k in range(count):
            fe.addPolygon(yadefrag.rectangle((2 * k, 0), (2 * k + 1, 1)), .3 + .001 * k, 's')
        O.engines, O.dt = [fe], 1e-9
        O.step()
        O.run(2, True)
    return [str(one.message) for one in caught], [one.filename for one in caught]


def test_aMessageOfManyBodiesIsGivenOnceWithTheirNumber():
    said, files = wall(27, solver(fractureEnergy=1))
    assert len(said) == 2 and set(files) == {__file__}
    assert 'component 0' in said[0] and 'less than four elements' in said[0]
    assert said[1].startswith('27 bodies have this message') and said[1].endswith('the bodies 0 to 26.')
    O.reset()
    said, _ = wall(1, solver(fractureEnergy=1))  # another scene: from the beginning
    assert len(said) == 1 and 'component 0' in said[0]


def test_aMessageOfManyBondsIsGivenOnceWithTheirNumber():
    """Four strips side by side: three bonds too weak for their sides."""
    O.materials.append(w.FEMat(young=1e9, poisson=0, density=1000, label='m'))
    fe = w.FESolver()
    for k in range(4):
        fe.addPolygon(yadefrag.rectangle((k, 0), (k + 1, 1)), .5, 'm')
    with heard() as said:
        for k in range(3):
            assert fe.bond(k, k + 1, 5e6, 100) == 2
        O.engines, O.dt = [fe], 1e-7
        yadefrag.runSteps(1)
    assert len(said) == 2 and said[0].startswith('bond: energy is 100 J/m² of the bond between the bodies 0 and 1 at')
    assert said[1].startswith('3 bonds have this message') and said[1].endswith('the bonds 0-1, 1-2, 2-3.')


def test_relaxEndsWithoutLoads():
    fe = w.FESolver()
    O.materials.append(w.FEMat(young=5e9, poisson=.25, density=2500, label='g'))
    fe.addPolygon(kSquare, .4, 'g')
    O.engines, O.dt = [fe], .5 * fe.criticalTimeStep()
    assert fe.relax(most=500) < 200


# The last one is a run in the background.
kRefused = """
from yadefrag import *
O.materials.append(FEMat(young=1e9, poisson=.2, density=1000, label='s'))
fe = FESolver()
fe.addPolygon(rectangle((0, 0), (1, 1)), .5, 's')
O.engines, O.dt = engines(fe), 1.
for run in (lambda: O.run(3, True), lambda: runSteps(3), lambda: O.run(3, True)):
    try:
        run()
    except RuntimeError as error:
        print('caught', error)
O.run()
O.wait()
"""


def test_aRefusedStepIsToldOnce(tmp_path):
    """Only a run in the background, whose error nobody gets, has YADE's own lines."""
    (tmp_path / 'refused.py').write_text(kRefused)
    done = inYade(tmp_path / 'refused.py', timeout=120)
    foreground, _, _ = done.stdout.partition('FATAL')
    lines = [line for line in foreground.splitlines() if 'time step' in line]
    assert len(lines) == 3 and all(line.startswith('caught') for line in lines), done.stdout
    assert 'ERROR' not in foreground.replace('<', '').split('caught')[0] and done.stdout.count('FATAL') == 1


def test_aWarningOfAFileIsAtTheLineOfTheScript(tmp_path):
    square = '0, 0\n1, 0\n1, 1\n0, 1\n'
    (tmp_path / 'twice.csv').write_text(square + '\n' + square)
    with pytest.warns(UserWarning, match='second copies of a line') as caught:
        assert len(yadefrag.readOutline(tmp_path / 'twice.csv')) == 1
    assert caught[0].filename == __file__


# --- curves by a name or by points

SOFTENING = [(0, 1), (.1, .4), (.5, .3), (1, 0)]


@pytest.mark.parametrize('cls, attribute, values', [
    (w.BrittleFEMat, 'softening', ('linear', 'bilinear', 'petersson', 'ceb-fip-2010', 'exponential', 'reinhardt', SOFTENING)),
    (w.BrittleFEMat, 'rateEffect', ('none', 'ceb-fip-2010', [(1, 1), (100, 4)])),
    (w.PlasticFEMat, 'hardeningTable', ('none', [(0, 1e8), (.1, 2e8)]))])
def test_curvesAreReturnedAsGiven(cls, attribute, values):
    """The first one is the default."""
    material = cls()
    for value in (values[0], *reversed(values), values[0]):
        assert cls(**{attribute: value}).dict()[attribute] == value
        assert cls().dict()[attribute] == values[0]
        setattr(material, attribute, value)
        assert getattr(material, attribute) == material.dict()[attribute] == value
    setattr(material, attribute, np.array(values[-1]))
    assert getattr(material, attribute) == values[-1]


# --- what is shown

kLong = [np.zeros((1000, 1000)), list(range(10**5)), 'x' * 10**5, 10**5000, -10**5000, b'\xff' * 1000,
         {i: i for i in range(1000)}, [[[[[[1] * 9] * 9] * 9] * 9]], np.zeros(5, dtype=[('a', 'f8')]), '\ud800\n\x00']


@pytest.mark.parametrize('value', kLong, ids=lambda v: type(v).__name__)
def test_valuesAreShownInShort(value):
    text = arguments.shown(value)
    assert 0 < len(text) <= arguments.LONGEST and text.isprintable()


def test_numbersOfNumPyAndABrokenReprAreShown():
    """NumPy 2 has np.float64(1.5) as repr."""
    assert arguments.shown((np.float64(1.5), np.int32(2))) == '(1.5, 2)'
    assert arguments.shown([np.bool_(True)]) == '[True]'

    class Broken:
        def __repr__(self):
            raise KeyError('no text')

    with pytest.raises(ValueError, match='^steps is <Broken instance at 0x[0-9a-f]*>, it must be'):
        yadefrag.runSteps(Broken())


def test_aRunWithinAStepIsRefused():
    """It would wait for ever."""
    solver, answers = impact(), []

    def nested():
        for call in (lambda: yadefrag.runSteps(2), lambda: yadefrag.animate(solver, 'a.gif', 2, 1)):
            with pytest.raises(RuntimeError, match='cannot be called within a step') as error:
                call()
            answers.append(str(error.value))

    builtins.nested = nested
    O.engines = O.engines + [w.PyRunner(command='nested()', iterPeriod=1, initRun=True)]
    try:
        O.step()
        O.run(1, True)
    finally:
        del builtins.nested
    assert len(answers) == 4
    O.engines = O.engines[:-1]
    assert yadefrag.runSteps(2) == 2


# --- clumps

def addClump():
    """The number of a clump of two spheres."""
    return O.bodies.appendClumped([utils.sphere((9, 0, 0), 1), utils.sphere((9, 1, 0), 1)])[0]


@pytest.mark.parametrize('kind', [list, tuple, iter, np.array, lambda ids: range(2), set,
                                  lambda ids: (i for i in ids), lambda ids: np.array(ids)[::1],
                                  lambda ids: map(int, ids), lambda ids: dict.fromkeys(ids)])
def test_clumpsAreRefused(kind):
    """YADE itself would end the process, for want of a mass."""
    impact('LebesgueCollider')
    clump = addClump()
    for call in (lambda: O.bodies.clump(kind([0, 1])), lambda: O.bodies.addToClump(kind([3, 2]), clump)):
        with pytest.raises(ValueError, match='part of the boundary of body 0 .* in a clump'):
            call()
    O.step()


def test_clumpsOfOthersAreMadeAsBefore():
    impact('LebesgueCollider')
    clump = addClump()
    other = O.bodies.append(utils.sphere((9, 2, 0), 1))
    O.bodies.addToClump([other], clump)
    assert O.bodies[other].clumpId == clump
    O.bodies.releaseFromClump(other, clump)
    another = O.bodies.append(utils.sphere((9, 4, 0), 1))
    made = O.bodies.clump(i for i in (other, another))
    assert O.bodies[another].clumpId == made


# --- what a body is made of

@pytest.mark.parametrize('finder', [None, 'LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('name, value', [
    ('mat', lambda: None), ('shape', lambda: None), ('shape', lambda: w.Sphere(radius=1)), ('bound', lambda: None),
    ('mat', lambda: w.FrictMat()), ('state', w.State)])  # without a state YADE itself ends the process
def test_partsAreTakenAway(name, value, finder):
    """From all pieces, or from the first, as cracks begin: the step succeeds or reports what is wrong,
    and so does loading what was saved."""
    for count in (1, 10**6):
        O.reset()
        solver = brittleImpact(finder)
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
        assert (sentence is None) <= (name not in ('state', 'shape')) and (name != 'bound' or sentence is None)
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
    solver = impact()
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

def requireFreed(make):
    """All that `make` gives weak references to, when the scene is empty."""
    O.reset()
    items = make()
    assert all(item() for item in items)
    O.reset()
    gc.collect()
    assert [item() for item in items] == [None] * len(items)


@pytest.mark.parametrize('collider', [None, 'LebesgueCollider'])
def test_resetFreesTheSolver(collider):
    def made():
        impact(collider)
        steps(3)
        O.engines = O.engines[:1] + [w.PyRunner(label='named')] + O.engines[1:]
        steps(1)
        return [weakref.ref(engine) for engine in O.engines if not isinstance(engine, w.PyRunner)]
    requireFreed(made)


def test_whatWasInAListIsFreed():
    """YADE alone keeps what is in a list of bodies, engines or functors permanently."""
    def made():
        functors = ([w.Bo1_Sphere_Aabb()], [w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                    [w.Law2_ScGeom_FrictPhys_CundallStrack()])
        listed = [w.Body(), w.Body(), *(functor for one in functors for functor in one)]
        O.bodies.append(listed[:1])
        O.bodies.append(tuple(listed[1:2]))
        O.engines = [w.InsertionSortCollider(functors[0]), w.InteractionLoop(*functors[1:])]
        return [weakref.ref(item) for item in listed + O.engines]
    requireFreed(made)
