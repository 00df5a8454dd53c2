"""Curves are given and returned alike; what is refused is shown in short. What is accepted: test_forms.py."""
import builtins

import numpy as np
import pytest

import yadefrag
from fe_scene import impact
from yade import wrapper as w
from yadefrag import arguments

O = builtins.O
kSquare = [(0, 0), (1, 0), (1, 1), (0, 1)]

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
