"""What FESolver complains of: energy that contact makes, bodies that sink into one another."""
import builtins
import warnings

import pytest

import yadefrag
from fe_scene import blow, fe, finder, run
from yade import wrapper as w

O = builtins.O


@pytest.mark.parametrize('settings', [{}, dict(passes=2)])
def test_correctImpactGivesNoMessage(settings, capfd):
    solver = blow(**settings)
    O.run(400, True)
    assert solver.numSearches > 0 and solver.energy['contact'] > 0
    assert solver.warnings == [] and 'WARN  FESolver' not in capfd.readouterr().err


def test_overlapIsReportedOncePerDoubling(capfd, tmp_path):
    """No force of contact moves held nodes."""
    solver = blow(held=True)
    O.run(400, True)
    sentences = solver.warnings
    assert 0 < len(sentences) < 8
    assert 'bodies overlap by' in sentences[0] and 'take a shorter step' in sentences[0]
    err = capfd.readouterr().err
    assert [line for line in err.splitlines() if line.startswith('WARN')] == \
        ['WARN  FESolver: ' + sentence for sentence in sentences]
    # They are part of the state, and not repeated.
    for name in ('x.yade', 'x.xml'):
        path = str(tmp_path / name)
        O.save(path)
        O.load(path)
        [again] = [e for e in O.engines if isinstance(e, w.FESolver)]
        assert again.warnings == sentences
        assert 'WARN  FESolver' not in capfd.readouterr().err


def test_untouchedBodyGivesNoMessage():
    material = w.FEMat(young=210e9, poisson=.3, density=7800)
    O.materials.append(material)
    solver = w.FESolver()
    nodes, triangles = yadefrag.rectangleMesh((.3, .3), (1, 1), 7, 7)
    solver.addTriangles(nodes, triangles, material=material)
    run(solver, finder('LebesgueCollider'))
    O.run(7000, True)
    assert solver.energy['total'] > 0 and solver.warnings == []


def test_deepestOverlapIsThatOfContact():
    """Held faces that move into one another: the same depth by triangles as by points, to some 0.05 of a segment."""
    solver = blow(held=True)
    assert solver.deepestOverlap() == 0
    O.run(20, True)
    assert solver.maxPenetration > 1e-5
    assert abs(solver.deepestOverlap() / solver.maxPenetration - 1) < .05


def test_bodiesWithoutTheirEngineAreReported():
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m')
    O.engines, O.dt = [w.ForceResetter()], 1e-6
    with pytest.warns(UserWarning, match='O.engines has no FESolver, so that nothing moves its bodies'):
        yadefrag.runSteps(1)
    O.reset()
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m')
    O.engines = yadefrag.engines(solver)
    O.dt = .5 * solver.criticalTimeStep()
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        yadefrag.runSteps(1)
