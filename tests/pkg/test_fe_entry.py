"""entry='path' and entry='flags': both hold bodies apart, are saved, and may be changed in a run."""
import builtins
import os

import numpy as np
import pytest

import yadefrag
from fe_scene import impact, run, steps
from yade import wrapper as w

O = builtins.O


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


def test_theDefaultIsThePath():
    assert w.FESolver().entry == 'path'
    assert w.FESolver(entry='flags').entry == 'flags'


@pytest.mark.parametrize('value', ['', 'Path', 'flag'])
def test_othersAreRefused(value):
    with pytest.raises(ValueError, match="FESolver.entry is '%s', it must be 'path' or" % value):
        w.FESolver(entry=value)


# What the next step's motion brings in, of a segment; flags leave corners that came in aside.
@pytest.mark.parametrize('entry, most', [('path', 1e-3), ('flags', .02)])
def test_piecesStayApart(entry, most):
    solver = drop(entry=entry)
    deepest = 0
    for _ in range(20):
        steps(20)
        deepest = max(deepest, solver.deepestOverlap())
    assert solver.numCracks > 20
    assert deepest < most * .02       # m; sides have some .03


def test_bothGiveTheSameBlowOfTwoElasticBodies():
    """Nothing slides past an end here, so the two agree."""
    places = []
    for entry in ('path', 'flags'):
        O.reset()
        solver = impact(entry=entry)
        steps(300)
        places.append(np.array(solver.nodes))
    assert np.abs(places[0] - places[1]).max() < 1e-6


def test_itIsSavedAndMayChangeInARun(tmp_path):
    solver = drop(entry='flags')
    steps(100)
    solver.entry = 'path'
    steps(100)
    solver.entry = 'flags'
    steps(100)
    file = os.path.join(str(tmp_path), 'scene.yade')
    O.save(file, quiet=True)
    steps(50)
    wanted = np.array(solver.nodes)
    O.load(file, quiet=True)
    assert solverOfScene().entry == 'flags'
    steps(50)
    assert (np.array(solverOfScene().nodes) == wanted).all()
