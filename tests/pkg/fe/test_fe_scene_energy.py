"""fe.energy['scene']: contact with YADE's bodies creates no energy, or a message tells how much."""
import builtins
import math
import warnings

import numpy as np
import pytest

import yadefrag
from fe_scene import blow, fe, finder, kineticEnergy, O, ready, reloaded, run, throwBall
from yade import utils
from yade import wrapper as w

G = 9.81


def ball(place, radius=.1, velocity=(0, 0), young=1e7, density=1000, angle=.3, **more):
    """A sphere's body in the scene."""
    return throwBall(place, radius, velocity, w.FrictMat(young=young, density=density, frictionAngle=angle), **more)


def block(solver, **settings):
    settings = dict(size=.125, fixed=lambda x, y: y < 1e-9) | settings
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, .5)), material='m', **settings)


def drift(solver, count, portion=20):
    """Largest change of the scene's energy, over its first value (J), and the messages."""
    values = []
    for _ in range(count // portion):
        O.run(portion, True)
        values.append(solver.energy.get('scene', solver.energy['total']))
    return np.abs(np.array(values) - values[0]).max(), solver.warnings


def falling(damping=0, factor=.1, name='LebesgueCollider', **settings):
    """Spheres that fall on a block and roll there."""
    solver = fe(gravity=(0, -G))
    block(solver)
    for i, x in enumerate((.2, .45, .8)):
        ball((x, .65 + .3 * i), velocity=(.5, -2), spin=4 * i - 4, **settings)
    run(solver, finder(name), spheres=True, factor=factor)
    O.engines[-1].gravity, O.engines[-1].damping = (0, -G, 0), damping
    return solver


@pytest.mark.parametrize('damping', [0, .4])
@pytest.mark.parametrize('angle', [0, .5])
def test_spheresThatFallGiveNoMessage(damping, angle):
    solver = falling(damping, angle=angle)
    given = kineticEnergy(*[b for b in O.bodies if isinstance(b.shape, w.Sphere)])
    # Young's moduli of 1e7: the spheres bounce, roll and come to rest within .4 s.
    off, messages = drift(solver, int(.4 / O.dt))
    assert messages == []
    assert off < 2e-3 * given
    assert solver.energy['outside'] < 0


def test_clumpAndBlockedSpheresGiveNoMessage():
    solver = fe(gravity=(0, -G))
    block(solver)
    members = [ball(place).id for place in ((.3, .65), (.42, .7), (.3, .8))]
    clump = O.bodies.clump(members)
    O.bodies[clump].state.vel, O.bodies[clump].state.blockedDOFs = (1, -3, 0), 'zXY'
    ball((.8, .602), velocity=(.1, -.05), blocked='xyzXYZ')
    run(solver, finder('LebesgueCollider'), spheres=True, factor=.1)
    O.engines[-1].gravity = (0, -G, 0)
    off, messages = drift(solver, int(.3 / O.dt))
    # The clump has 63 J.
    assert messages == [] and off < .3
    # The pusher has done work, which is no change of energy by contact.
    assert -solver.energy['outside'] > 2


@pytest.mark.parametrize('move', ['constant', 'oscillating', 'by its position'])
def test_movingWallGivesNoMessage(move):
    solver = fe()
    block(solver)
    wall = O.bodies[O.bodies.append(utils.wall(.501, axis=1, sense=-1, material='m'))]
    run(solver, factor=.5)
    builtins._wall, builtins._period = wall, 400 * O.dt
    commands = {
        'constant': '_wall.state.vel = (0, -.2, 0)',
        'oscillating': '_wall.state.vel = (0, -.5 * __import__("math").cos(6.28 * O.time / _period), 0)',
        'by its position': '_wall.state.pos = (0, .501 - .2 * O.time, 0)'}
    O.engines = [w.PyRunner(command=commands[move], iterPeriod=1)] + O.engines
    off, messages = drift(solver, 2000)
    work = -solver.energy['outside']
    assert messages == [] and abs(work) > .1
    assert off < 5e-3 * max(work, solver.energy['strain'])


@pytest.mark.parametrize('smooth', [False, True])
def test_shorterStepIsAdvisedOnlyWhereItHelps(smooth):
    """A steel sphere dents a plate that yields; the contact's (ω Δt)² is below .05 at both steps."""
    created, messages = [], []
    for factor in (.3, .1):
        O.reset()
        solver = fe(w.PlasticFEMat(young=1e8, poisson=.3, density=2700, yieldStress=3e5, hardening=0,
                                   frictionAngle=.4, label='p'), linearViscosity=.06)
        solver.addPolygon(yadefrag.rectangle((0, 0), (.5, .04)), size=.0125, material='p', thickness=.04, smooth=smooth,
                          fixed=lambda x, y: x < 1e-9 or x > .5 - 1e-9)
        ball((.45, .0561), .016, (1, -15), 1e8, 7800, .4)
        ready(solver, factor, spheres=True)
        O.run(int(.02 / O.dt), True)
        created.append(max(0., solver.energy['scene'] - solver.energy['total']))
        messages += [one for one in solver.warnings if 'has created' in one]
    assert not any('shorter step' in one for one in messages)
    assert all('step is short enough' in one or 'radius' in one for one in messages)


def test_createdEnergyIsThatOfTheBodies():
    """The number in `scene` is the kinetic energy that the sphere and the bodies have got from nothing."""
    solver = fe()
    block(solver, fixed=None)
    sphere = ball((.44, .51), .0101, (0, -1), 1e9, 300)
    run(solver, finder('LebesgueCollider'), spheres=True, factor=.8)
    before = kineticEnergy(sphere)
    O.run(int(.002 / O.dt), True)
    O.run(2, True)
    gained = kineticEnergy(sphere) - before - solver.energy['outside']
    assert gained > .1 * before
    assert solver.energy['scene'] - solver.energy['total'] == pytest.approx(gained, rel=.05)


def test_balanceIsRecorded(tmp_path):
    solver = falling(angle=.3, factor=.2)
    O.engines = O.engines + [yadefrag.FERecorder(iterPeriod=50, file=str(tmp_path / 'run'), fields=[])]
    O.run(2500, True)
    wanted = solver.energy
    assert 'scene' in wanted and wanted['scene'] != wanted['total']
    head, *rows = (tmp_path / 'run.csv').read_text().splitlines()
    place = head.split(',').index('scene (J)')
    # The last record is of a step before the end of the run, or of that.
    assert float(rows[-1].split(',')[place]) == pytest.approx(wanted['scene'], abs=1e-3 * abs(wanted['outside']))


def test_externalIsAnAlias():
    solver = fe(gravity=(0, -G))
    block(solver, fixed=None)
    run(solver)
    O.run(10, True)
    energy = solver.energy
    assert energy['external'] == -energy['outside'] > 0 and energy.get('external') == energy['external']
    assert 'external' in energy and 'external' not in list(energy)
    assert builtins.sum(value for name, value in energy.items() if name != 'total') == \
        pytest.approx(energy['total'], abs=1e-12)
    with pytest.raises(KeyError):
        energy['nothing']
    assert energy.get('nothing', 3) == 3 and not math.isnan(energy['total'])


# --- what FESolver complains of: energy that contact makes, bodies that sink into one another

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
        again = reloaded(str(tmp_path / name))
        assert again.warnings == sentences
        assert 'WARN  FESolver' not in capfd.readouterr().err


def test_untouchedBodyGivesNoMessage():
    solver = fe(w.FEMat(young=210e9, poisson=.3, density=7800, label='m'))
    solver.addMesh(yadefrag.rectangleMesh((.3, .3), (1, 1), 7, 7), 'm')
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
    ready(solver, .5)
    with warnings.catch_warnings(action='error'):
        yadefrag.runSteps(1)
