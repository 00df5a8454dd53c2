"""NumPy's numbers are numbers wherever a script gives one; what is refused is shown in short."""
import builtins

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, impact
from yade import wrapper as w
from yadefrag import arguments

O = builtins.O
kSquare = [(0, 0), (1, 0), (1, 1), (0, 1)]
kWhole = [np.int8, np.uint8, np.int32, np.uint32, np.int64, np.uint64, lambda v: np.array(v)]
kReal = [np.float16, np.float32, np.float64, np.longdouble, lambda v: np.array(v, dtype=np.float32)]
kFlag = [np.bool_, lambda v: np.array(v)]


@pytest.mark.parametrize('make', kWhole)
def test_wholeNumbersOfNumPy(make):
    solver = w.FESolver(passes=make(2), maxCracks=make(3), halo=make(0), ompThreads=make(1))
    assert (solver.passes, solver.maxCracks, solver.ompThreads) == (2, 3, 1)
    solver.passes, solver.damping, solver.gravity = make(1), make(0), (make(0), make(1), 0)
    assert solver.passes == 1 and solver.gravity[1] == 1
    solver.updateAttrs({'passes': make(2)})
    assert solver.passes == 2 and w.LebesgueCollider(targetInterv=make(3)).targetInterv == 3
    fe()
    assert solver.addPolygon(kSquare, size=.5, material=make(0), spin=make(1),
                             thickness=make(2)) == 0
    O.engines, O.dt = [solver], .5 * solver.criticalTimeStep()
    assert yadefrag.runSteps(make(5), every=make(2), call=lambda: None) == 5 == O.iter
    assert len(yadefrag.circle((make(0), make(0)), make(1), make(8))) == 8
    assert len(yadefrag.rectangleMesh((0, 0), (make(1), 1), make(2), make(3))[0]) == 12
    solver.prescribe(np.array([0]), vx=make(1))
    solver.removeBody(make(0))
    assert len(O.bodies) == 0 or all(b is None for b in O.bodies)


@pytest.mark.parametrize('make', kReal)
def test_realNumbersOfNumPy(make):
    assert w.FEMat(young=make(1024), frictionAngle=make(.5), density=make(2)).young == 1024
    material = w.FEMat()
    material.young = make(1024)
    assert material.young == 1024 and w.LebesgueCollider(verletDist=make(.25)).verletDist == .25
    solver = w.FESolver(halo=make(.25), gravity=(make(0), make(-.5), 0))
    assert solver.halo == .25 and solver.gravity[1] == -.5
    solver.addPolygon([(make(0), make(0)), (make(1), 0), (1, make(1))], size=make(.5),
                      material=material, velocity=(make(.5), make(0)), thickness=make(.5))
    assert solver.velocities[0, 0] == .5


@pytest.mark.parametrize('make', kFlag)
def test_flagsOfNumPy(make):
    assert w.FEMat(planeStress=make(True)).planeStress
    collider = w.LebesgueCollider(trueHalo=make(False))
    collider.dead = make(True)
    assert collider.dead and not collider.trueHalo
    solver = fe()
    solver.addPolygon(kSquare, size=.5, material='m', smooth=make(True), selfContact=make(False),
                      fixed=lambda x, y: make(x < .1))
    solver.addPolygon(yadefrag.rectangle((2, 0), (3, 1)), size=.5, material='m',
                      smooth=np.array([True, False, 1, 0]))
    solver.prescribe(lambda x, y: make(x > .9), vx=1)
    assert solver.fragments(held=make(True))


# --- what is shown

kLong = [np.zeros((1000, 1000)), list(range(10**5)), 'x' * 10**5, 10**5000, -10**5000, b'\xff' * 1000,
         {i: i for i in range(1000)}, [[[[[[1] * 9] * 9] * 9] * 9]],
         np.zeros(5, dtype=[('a', 'f8')]), '\ud800\n\x00']


@pytest.mark.parametrize('value', kLong, ids=lambda v: type(v).__name__)
def test_valuesAreShownInShort(value):
    text = arguments.shown(value)
    assert 0 < len(text) <= arguments.LONGEST and text.isprintable()
    for call in (lambda: yadefrag.runSteps(value), lambda: yadefrag.circle((0, 0), value),
                 lambda: yadefrag.rectangle(value, value), lambda: yadefrag.readPolygon(value),
                 lambda: w.FESolver().addPolygon(kSquare, size=value, material='m'),
                 lambda: w.FESolver(passes=value), lambda: w.FESolver(gravity=value),
                 lambda: yadefrag.tradeoff(None, value, None, duration=value)):
        with pytest.raises((ValueError, TypeError)) as error:
            call()
        assert len(str(error.value)) <= 300


def test_numbersOfNumPyAreShownAsPythons():
    """NumPy 2 has np.float64(1.5) as repr."""
    assert arguments.shown((np.float64(1.5), np.int32(2))) == '(1.5, 2)'
    assert arguments.shown([np.bool_(True)]) == '[True]'


def test_aBrokenReprIsNoReasonToFail():
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
