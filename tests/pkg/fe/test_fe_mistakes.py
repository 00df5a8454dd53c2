"""Mistakes that a script would not notice by itself: one sentence each."""
import builtins
import warnings

import pytest

import yadefrag
from fe_scene import fe, run, steps
from yade import wrapper as w

O = builtins.O


def added(solver, low=(0, 0), **settings):
    x, y = low
    return solver.addPolygon(yadefrag.rectangle((x, y), (x + .1, y + .05)), **{**dict(size=.05, material='m'), **settings})


def told(call):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always')
        call()
    return [str(one.message) for one in caught]


def test_fixedThatSelectsNothingIsReportedBeforeTheRun():
    solver = fe()
    assert not told(lambda: added(solver, fixed=lambda x, y: y < -1e-9))
    run(solver)
    assert told(O.step) == ['fixed selects none of the nodes of body 0.']
    assert not told(O.step)
    O.reset()
    solver = fe()
    added(solver, fixed=lambda x, y: y < -1e-9)
    O.reset()
    solver = fe()
    added(solver)
    run(solver)
    assert not told(O.step), 'the body is gone'


@pytest.mark.parametrize('low', [-1, 2])
def test_fixedOfSeveralBodiesMaySelectNothingOfSome(low):
    """In a loop over bodies, whichever of them it holds."""
    solver = fe()
    for k in range(3):
        added(solver, (k, 0), fixed=lambda x, y: low < x < low + .5)
    run(solver)
    assert told(O.step) == ([] if low == 2 else ['fixed selects none of the nodes of the bodies 0 to 2.'])


@pytest.mark.parametrize('corners', [(.1, .05), (.4, .006)])
def test_sizeAboveTheBody(corners):
    solver = fe()
    shape = yadefrag.rectangle((0, 0), corners)
    [sentence] = told(lambda: solver.addPolygon(shape, size=10, material='m'))
    assert sentence == (
        'addPolygon: size is 10 m, but the body has only %g m by %g m: its outline requires smaller triangles, which '
        'determine the critical time step; take a size of at most %g m.' % (*corners, corners[1]))
    O.reset()
    assert not told(lambda: fe().addPolygon(shape, size=corners[1], material='m'))


@pytest.mark.parametrize('name, call', [
    (name, lambda s, f, name=name: added(s, **{name: f})) for name in
    ('fixed', 'size', 'velocity', 'displacement', 'stress', 'material')] + [
    ('strength', lambda s, f: added(s, material='b', strength=f)),
    ('nodes', lambda s, f: s.prescribe(f, vx=0))])
def test_functionsWithAWrongNumberOfArguments(name, call):
    solver = fe()
    O.materials.append(w.BrittleFEMat(young=1e9, tensileStrength=1e6, fractureEnergy=1e4, label='b'))
    before = len(O.bodies)
    for wrong in (lambda p: 0, lambda: 0, lambda x, y, z: 0):
        with pytest.raises(TypeError) as error:
            call(solver, wrong)
        assert str(error.value) == '%s is a function that cannot be called as %s(x, y): it must take 2 arguments.' % (
            name, name)
    assert len(O.bodies) == before


def test_functionsOfTimeWithAWrongNumberOfArguments():
    solver = fe()
    added(solver)
    with pytest.raises(TypeError, match=r'^vy is a function that cannot be called as vy\(x, y, t\): it must take 3'):
        solver.prescribe([0], vy=lambda t: 0)
    with pytest.raises(TypeError, match=r'^p is a function that cannot be called as p\(t\): it must take one argument'):
        solver.pressure(lambda x, y: True, lambda x, y: 0)


def test_errorsWithinAFunctionAreThoseOfTheScript():
    with pytest.raises(TypeError, match='has no len'):
        added(fe(), fixed=lambda x, y: len(x) < 0)


@pytest.mark.parametrize('order', [(1e6, 10, 1e-3), (10, 1e6, 1e-3)])
def test_bondAllWithArgumentsInAnotherOrder(order):
    solver = fe()
    added(solver), added(solver, (0, .05))
    with pytest.raises(ValueError) as error:
        solver.bondAll(*order)
    assert str(error.value) == ('bondAll: tolerance is %g m, but the largest body has only 0.1 m; the order is '
                                'bondAll(tolerance, strength, energy).' % order[0])
    assert solver.bondAll(1e-3, 10, 1e6) == 2


def test_unknownAttributesOfAConstructor():
    for make, sentence in ((lambda: w.FESolver(pases=2), "FESolver has no attribute 'pases', but passes."),
                           (lambda: w.FEMat(yuong=1), "FEMat has no attribute 'yuong', but young.")):
        with pytest.raises(AttributeError) as error:
            make()
        assert str(error.value) == sentence
    solver = w.FESolver()
    with pytest.raises(AttributeError, match='but damping'):
        solver.updateAttrs(dict(passes=2, dampng=3))
    assert solver.passes == 1
