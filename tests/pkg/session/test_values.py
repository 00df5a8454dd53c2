"""What is refused is shown in short; attributes of a wrong kind. What is accepted: test_forms.py."""
import builtins
import math

import numpy as np
import pytest

import yadefrag
from fe_scene import impact
from yade import wrapper as w
from yadefrag import arguments

O = builtins.O
kSquare = [(0, 0), (1, 0), (1, 1), (0, 1)]

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


# --- attributes

@pytest.mark.parametrize('name, value, sentence', [
    ('passes', 2.5, 'FESolver.passes is 2.5, it must be a whole number.'),
    ('passes', 10**30, 'FESolver.passes is 1000000000...00000000000, it must be closer to 0.'),
    ('halo', 'wide', "FESolver.halo is 'wide', it must be a number."),
    ('halo', 10**400, 'FESolver.halo is 1000000000...00000000000, it must be a number.'),
    ('dead', 'no', "FESolver.dead is 'no', it must be True or False."),
    ('dead', 7, 'FESolver.dead is 7, it must be True or False.'),
    ('label', b'x', "FESolver.label is b'x', it must be a text."),
    ('correction', 3, 'FESolver.correction is 3, it must be a text.'),
    ('gravity', (0,), 'FESolver.gravity is (0,), it must be two or three numbers.'),
    ('label', None, 'FESolver.label is None, it must be a text.')])
def test_attributesOfAWrongKind(name, value, sentence):
    solver = w.FESolver(passes=2)
    before = repr(solver.dict())
    for call in (lambda: setattr(solver, name, value),
                 lambda: w.FESolver(**{'damping': 1, name: value}),
                 lambda: solver.updateAttrs({'damping': 1, name: value})):
        with pytest.raises(TypeError) as error:
            call()
        assert str(error.value) == sentence and repr(solver.dict()) == before


def test_updateAttrsChangesAllOrNothing():
    solver = w.FESolver()
    for wrong in ({'halo': -1}, {'nope': 1}, {'halo': 'a'}):
        with pytest.raises((ValueError, TypeError, AttributeError)):
            solver.updateAttrs({'passes': 2, **wrong})
        assert solver.passes == 1
    solver.updateAttrs({'passes': 2, 'halo': .1})
    assert solver.passes == 2 and solver.halo == .1


def test_aColliderNeedsADispatcher():
    for call in (lambda: w.LebesgueCollider(boundDispatcher=None),
                 lambda: w.LebesgueCollider().updateAttrs({'boundDispatcher': None})):
        with pytest.raises((TypeError, AttributeError), match='boundDispatcher'):
            call()


@pytest.mark.parametrize('functors', [[None], [3], 3, [w.FEMat()], None])
def test_aColliderNeedsFunctors(functors):
    """YADE itself would end the process for None in the list."""
    with pytest.raises(ValueError, match='it must be a list of bound functors'):
        w.LebesgueCollider(functors)


# --- numbers beyond all sizes

@pytest.mark.parametrize('wrong, sentence', [
    (dict(thickness=1e300), 'the stiffness of a triangle is inf N/m; it must be in the range of '),
    (dict(velocity=(1e160, 0)), r'velocity is 1e\+160 m/s; it must be at most 1e100 m/s'),
    (dict(velocity=(0, -10**30 * 10**90)), 'velocity is -1e.120 m/s'),
    (dict(velocity=(10**400, 0)), 'both numbers must be finite'),
    (dict(spin=10**400), 'spin is 1000.*, it must be a finite number'),
    (dict(size=10**400), 'size is 1000.*, it must be a positive number'),
    (dict(material=10**30), 'material is 1000.*, which is not in O.materials')])
def test_numbersBeyondAllSizes(wrong, sentence):
    O.materials.append(w.FEMat(young=2e11, density=7800, label='m'))
    solver = w.FESolver()
    with pytest.raises(ValueError, match=sentence):
        solver.addPolygon(**dict(dict(outline=kSquare, size=.5, material='m'), **wrong))
    assert len(O.bodies) == 0 and len(solver.nodes) == 0


@pytest.mark.parametrize('name', ['linearViscosity', 'quadraticViscosity'])
def test_viscosityHasABound(name):
    solver = impact()
    with pytest.raises(ValueError, match=r'FESolver.%s is 1e\+160, it must be 0 or pos' % name):
        setattr(solver, name, 1e160)
    setattr(solver, name, 1e6)
    critical = solver.criticalTimeStep()
    assert math.isfinite(critical) and critical > 0


def test_forcesBeyondAllSizesAreNamed():
    solver = impact()
    solver.gravity = (1e300, 0, 0)
    with pytest.raises(RuntimeError, match='leaves the range of numbers; loads, gravity or '):
        O.step()


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
