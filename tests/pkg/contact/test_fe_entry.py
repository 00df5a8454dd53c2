"""Points enter by their path; settings of earlier versions are accepted, and have no effect."""
import builtins
import os

import numpy as np
import pytest

import yadefrag
from fe_scene import impact, run, steps
from yade import wrapper as w

O = builtins.O

FORMER = [('entry', 'flags', "entry='flags' has no effect: points enter by their path (docs/contact.md)."),
          ('correction', 'penalty', "correction='penalty' has no effect: forces of contact just prevent "
           'interpenetration (docs/contact.md).'),
          ('penaltyFactor', .5, 'penaltyFactor=0.5 has no effect: forces of contact just prevent interpenetration '
           '(docs/contact.md).')]


def solverOfScene():
    return next(e for e in O.engines if isinstance(e, w.FESolver))


def drop(**settings):
    """A brittle block that a disc shatters."""
    O.materials.append(w.BrittleFEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.3,
                                      tensileStrength=5e4, strengthScatter=.1, label='b'))
    solver = w.FESolver(**settings)
    solver.addPolygon(yadefrag.rectangle((-.2, -.2), (.2, 0)), size=.03, material='b',
                      fixed=lambda x, y: y < -.2 + 1e-9)
    solver.addPolygon(yadefrag.circle((0, .101), .1, 24), size=.03, material='b', velocity=(0, -8))
    run(solver)
    return solver


def test_piecesStayApart():
    solver = drop()
    deepest = 0
    for _ in range(20):
        steps(20)
        deepest = max(deepest, solver.deepestOverlap())
    assert solver.numCracks > 20
    assert deepest < 2e-5             # m; sides have some .03


def test_defaults():
    solver = w.FESolver()
    assert (solver.entry, solver.correction, solver.penaltyFactor) == ('path', 'lagrange', .2)


@pytest.mark.parametrize('name, value, wrong', [('entry', 'flags', ''), ('entry', 'flags', 'Path'),
                                                ('correction', 'penalty', 'Lagrange'),
                                                ('penaltyFactor', .5, 0), ('penaltyFactor', .5, 1.1)])
def test_othersAreRefusedAndChangeNothing(name, value, wrong):
    with pytest.raises(ValueError, match='FESolver.%s is ' % name):
        w.FESolver(**{name: wrong})
    solver = w.FESolver(**{name: value})
    with pytest.raises(ValueError, match='FESolver.%s is ' % name):
        setattr(solver, name, wrong)
    assert getattr(solver, name) == value


@pytest.mark.parametrize('name, value, sentence', FORMER)
def test_formerValueHasNoEffectAndIsReportedOnce(name, value, sentence, tmp_path, capfd):
    impact()
    steps(300)
    wanted = np.array(solverOfScene().nodes)
    O.reset()
    solver = impact(**{name: value})
    steps(1)
    assert solver.warnings == [sentence]
    assert capfd.readouterr().err.count('WARN  FESolver: ' + sentence) == 1
    steps(199)
    file = os.path.join(str(tmp_path), 'scene.yade')
    O.save(file, quiet=True)
    O.load(file, quiet=True)
    solver = solverOfScene()
    assert getattr(solver, name) == value
    steps(100)
    assert (np.array(solver.nodes) == wanted).all()
    assert solver.warnings == [sentence] and 'WARN  FESolver' not in capfd.readouterr().err


def test_formerValueMayBeSetInARun():
    solver = impact()
    steps(10)
    assert solver.warnings == []
    solver.entry = 'flags'
    steps(2)
    assert solver.warnings == [FORMER[0][2]]
