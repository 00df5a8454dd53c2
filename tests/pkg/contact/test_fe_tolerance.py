"""The tolerance at which the solution of contact ends, and pieces of a body that cracks stay apart."""
import builtins

import numpy as np
import pytest

import yadefrag
from fe_scene import impact, run, steps
from yade import wrapper as w

O = builtins.O


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


@pytest.mark.parametrize('tolerance, most', [('coarse', 1e-4), ('default', 2e-5), ('fine', 2e-5)])
def test_piecesStayApart(tolerance, most):
    solver = drop(contactTolerance=tolerance)
    deepest = 0
    for _ in range(20):
        steps(20)
        deepest = max(deepest, solver.deepestOverlap())
    assert solver.numCracks > 20
    assert deepest < most             # m; sides have some .03
    assert -solver.energy['contact'] < 1e-3 * solver.energy['kinetic']


def test_namesAndNumbers():
    assert w.FESolver().contactTolerance == .003
    for name, number in (('fine', 1e-4), ('default', .003), ('coarse', .01)):
        assert w.FESolver(contactTolerance=name).contactTolerance == number
    solver = w.FESolver(contactTolerance=np.float32(.5**8))
    assert solver.contactTolerance == .5**8
    solver.contactTolerance = 'fine'
    assert solver.dict()['contactTolerance'] == 1e-4


def test_finerOnesTakeMoreSweeps():
    def nodes(tolerance):
        O.reset()
        solver = impact(contactTolerance=tolerance)
        steps(300)
        return np.array(solver.nodes)
    exact = nodes(1e-9)
    errors = [abs(nodes(one) - exact).max() for one in ('coarse', 1e-5)]
    assert errors[0] > 3 * errors[1]
