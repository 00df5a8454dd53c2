"""What FESolver complains of: energy that contact makes, bodies that sink into one another."""
import builtins

import pytest

import yadefrag
from fe_scene import finder, run
from yade import wrapper as w

O = builtins.O


def blow(**settings):
    """Two blocks of 1 cm that meet at 20 m/s."""
    material = w.FEMat(young=210e9, poisson=.3, density=7800)
    O.materials.append(material)
    solver = w.FESolver(**settings)
    for k in range(2):
        low = (.01 * k, -.001 * k)
        nodes, triangles = yadefrag.rectangleMesh(low, (low[0] + .01, low[1] + .01), 6 + k, 6 + k)
        solver.addTriangles(nodes, triangles, material=material, velocity=(20 * (1 - k), 0))
    run(solver, finder('LebesgueCollider'))
    return solver


@pytest.mark.parametrize('settings', [{}, dict(passes=2), dict(correction='penalty')])
def test_healthyBlowIsQuiet(settings, capfd):
    solver = blow(**settings)
    O.run(400, True)
    assert solver.numSearches > 0 and solver.energy['contact'] > 0
    assert solver.warnings == [] and 'WARN  FESolver' not in capfd.readouterr().err


def test_softPenaltyIsToldOncePerDoubling(capfd, tmp_path):
    solver = blow(correction='penalty', penaltyFactor=1e-4)
    O.run(400, True)
    told = solver.warnings
    assert 0 < len(told) < 8
    assert 'bodies are in one another by' in told[0] and 'larger penalty factor' in told[0]
    err = capfd.readouterr().err
    assert [line for line in err.splitlines() if line.startswith('WARN')] == \
        ['WARN  FESolver: ' + sentence for sentence in told]
    # They are part of the state, and not told again.
    for name in ('x.yade', 'x.xml'):
        path = str(tmp_path / name)
        O.save(path)
        O.load(path)
        [again] = [e for e in O.engines if isinstance(e, w.FESolver)]
        assert again.warnings == told
        assert 'WARN  FESolver' not in capfd.readouterr().err
