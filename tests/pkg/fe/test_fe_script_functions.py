"""Functions of a script that a step calls: what they must not do is refused with its own sentence."""
import builtins

import numpy as np
import pytest

from fe_scene import fe, steps
from yade import utils
from yade import wrapper as w
from yadefrag import engines, rectangle, rectangleMesh

O = builtins.O
kSentence = 'change between steps only, not in a function that was given to prescribe or pressure; do it in a PyRunner'


def scene():
    """Two squares with a distance of 2."""
    solver = fe()
    for left in (0, 3):
        solver.addPolygon(rectangle((left, 0), (left + 1, 1)), size=.4, material='m')
    O.engines = engines(solver)
    O.dt = .3 * solver.criticalTimeStep()
    return solver


kChanges = {
    'addPolygon': lambda s: s.addPolygon(rectangle((6, 0), (7, 1)), size=.4, material='m'),
    'addTriangles': lambda s: s.addTriangles(*rectangleMesh((6, 0), (7, 1), 2, 2), material='m'),
    'removeBody': lambda s: s.removeBody(1),
    'removeOwn': lambda s: s.removeBody(0),
    'prescribe': lambda s: s.prescribe(s.nodesOf(1), vx=1),
    'prescribeByFunction': lambda s: s.prescribe(s.nodesOf(1), vx=lambda x, y, t: 1.),
    'rotate': lambda s: s.rotate(1, 1, (3, 0)),
    'pressure': lambda s: s.pressure(s.nodesOf(1), 1e3),
    'absorb': lambda s: s.absorb(s.nodesOf(1)),
    'loads': lambda s: setattr(s, 'loads', np.zeros((len(s.nodes), 2))),
}


@pytest.mark.parametrize('change', kChanges)
@pytest.mark.parametrize('kind', ['motion', 'pressure'])
def test_bodiesChangeBetweenStepsOnly(change, kind):
    """In the third step, after which the scene is as before; a PyRunner may do it, as the sentence says."""
    solver, calls = scene(), []

    def act(*place):
        calls.append(place)
        if len(calls) == 3:
            kChanges[change](solver)
        return 0.

    if kind == 'motion':
        solver.prescribe([0], vx=act)
    else:
        solver.pressure(solver.nodesOf(0), act)
    before = len(solver.nodes), len(solver.triangles), len(O.bodies)
    with pytest.raises(RuntimeError, match=kSentence) as error:
        steps(10)
    assert 'saved' not in str(error.value) and O.iter == 2
    assert (len(solver.nodes), len(solver.triangles), len(O.bodies)) == before
    assert len(calls) == 3 and abs(solver.velocities).max() < 1e-12  # rounding
    steps(5)  # the function returns now
    assert O.iter == 7


@pytest.mark.parametrize('change', [name for name in kChanges if name != 'removeOwn'])
def test_aPyRunnerMayDoIt(change):
    solver, calls = scene(), []
    solver.prescribe([0], vx=lambda x, y, t: calls.append(t) or 0.)
    builtins.change = lambda: kChanges[change](solver)
    O.engines = [w.PyRunner(command='__import__("builtins").change()', iterPeriod=3, nDo=1), *O.engines]
    O.run(10, True)
    assert O.iter == 10 and len(calls) == 10


def test_readingAndSpheresAreAllowed():
    """A function may look at the scene, and other bodies of YADE may come and go."""
    solver, seen = scene(), []

    def look(x, y, t):
        seen.append((len(solver.nodes), len(solver.fragments()), solver.energy['total']))
        ball = O.bodies.append(utils.sphere((20, 20, 0), .1))
        O.bodies.erase(ball)
        return 0.

    solver.prescribe([0], vx=look)
    O.run(10, True)
    assert len(seen) == 10 and O.iter == 10
