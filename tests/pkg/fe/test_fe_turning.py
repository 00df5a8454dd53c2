"""Motions that change: turns that keep their circle, values by node, tables and functions of time."""
import math
import os

import numpy as np
import pytest

import yadefrag
from fe_scene import bodyOf, fe, O, reloaded, run, steps
from yade import utils
from yade import wrapper as w
from yadefrag import engines, rectangle, rectangleMesh

CENTRE = np.array([.3, .2])


def everywhere(x, y):
    return True


def drum(**settings):
    """A ring of radius 1 about CENTRE."""
    solver = bodyOf(yadefrag.ring(CENTRE, .7, 1, 32), .3, **settings)
    run(solver)
    return solver


def block(size=.5, material=None, **settings):
    solver = bodyOf(rectangle((0, 0), (1, 1)), size, material, **settings)
    run(solver)
    return solver


def bottom(solver):
    return np.nonzero(solver.nodes[:, 1] < 1e-9)[0]


def radii(solver, centre=CENTRE):
    return np.linalg.norm(solver.nodes - centre, axis=1)


def turned(places, centre, angle):
    x, y = (places - centre).T
    return centre + np.stack([math.cos(angle) * x - math.sin(angle) * y,
                              math.sin(angle) * x + math.cos(angle) * y], axis=1)


@pytest.mark.parametrize('how', ['spin', 'field', 'rotate', 'name', 'nodes'])
def test_drumKeepsItsRadiusOverTenTurns(how):
    omega = 40.
    settings = dict(spin=dict(fixed=everywhere, spin=omega),
                    field=dict(fixed=everywhere, velocity=lambda x, y: (-omega * (y - CENTRE[1]),
                                                                        omega * (x - CENTRE[0]))),
                    name=dict(name='drum')).get(how, {})
    solver = drum(**settings)
    if how in ('rotate', 'name'):
        solver.rotate(dict(rotate=0, name='drum')[how], omega, CENTRE)
    if how == 'nodes':
        solver.rotate(everywhere, omega, CENTRE)
    before, start = radii(solver), solver.nodes
    count = math.ceil(10 * 2 * math.pi / omega / O.dt)
    assert count > 400  # a tangent would gain (ωΔt)²/2 a step: 10 % of the radius at least
    O.run(count, True)
    assert abs(radii(solver) / before - 1).max() < 1e-9
    # The angle is that of the time, which adds up roundings of the step.
    assert abs(solver.nodes - turned(start, CENTRE, omega * solver.time)).max() < 1e-9
    # Stress-free, and no energy comes of it: what a rigid body has, to the order of (ωΔt)².
    kinetic = .5 * (solver.masses * before**2).sum() * omega**2
    assert solver.energy['strain'] < 1e-9 * kinetic
    assert abs(solver.energy['total'] - (0 if how in ('rotate', 'name', 'nodes') else kinetic)) < 1e-3 * kinetic


def test_heldNodesOfABodyThatIsThrownTurnAboutItsCentroid():
    solver = drum(fixed=everywhere, spin=30., velocity=(2., -1.))
    before, start = radii(solver), solver.nodes
    steps(200)
    centre = CENTRE + np.array([2, -1]) * solver.time
    # The outline's 32 points are even about the centre, the mesh's triangles nearly so.
    middle = start.mean(axis=0)
    assert abs(solver.nodes - turned(start, middle, 30 * solver.time) - (centre - CENTRE)).max() < \
        2 * abs(middle - CENTRE).max() + 1e-9
    assert abs(radii(solver, centre) / before - 1).max() < 1e-6


def test_oneHeldNodeTurnsAboutTheCentroid():
    solver = block(spin=20., fixed=lambda x, y: x + y < 1e-9)
    steps(300)
    assert np.linalg.norm(solver.nodes[solver.reactions.any(axis=1)][0] - .5) == \
        pytest.approx(math.sqrt(.5), abs=1e-12)


def test_heldNodesWithOtherVelocitiesGoOnStraight():
    solver = block(fixed=everywhere, velocity=lambda x, y: (.1 * x, 0))
    before = solver.nodes
    steps(50)
    assert solver.nodes == pytest.approx(before * [1 + .1 * solver.time, 1], abs=1e-12)


def test_ratesOfTurnByATable():
    solver = drum()
    solver.rotate(0, [(0, 0), (.01, 30), (.02, 0)], CENTRE)
    start = solver.nodes
    while solver.time < .03:
        O.step()
    assert solver.nodes == pytest.approx(turned(start, CENTRE, .3), abs=1e-12)  # the triangle's area
    assert abs(solver.velocities).max() < 1e-9


def test_velocitiesByNodeTablesAndFunctions():
    solver = block()
    low, start = bottom(solver), solver.nodes
    speeds = np.linspace(1, 2, len(low))
    solver.prescribe(low, vx=speeds, vy=0)
    steps(10)
    assert solver.nodes[low] - start[low] == pytest.approx(
        np.stack([speeds * solver.time, 0 * speeds], axis=1), abs=1e-12)
    # A ramp that begins now and ends between two steps: its exact integral.
    begin, from_ = solver.time, solver.nodes
    end = begin + 7.3 * O.dt
    solver.prescribe(low, vx=[(begin, 0), (end, 3), (end + 1, 3)], vy=-1)
    steps(20)
    way = 1.5 * (end - begin) + 3 * (solver.time - end)
    assert solver.nodes[low] - from_[low] == pytest.approx(
        np.tile([way, begin - solver.time], (len(low), 1)), abs=1e-12)
    # The arguments of a function are positions and the middle of the step.
    seen = []
    from_, begin = solver.nodes, solver.time
    solver.prescribe(low, vx=lambda x, y, t: seen.append((x, y, t)) or 100 * t, vy=[(0, 0), (1, 0)])
    steps(5)
    assert [t for x, y, t in seen[::len(low)]] == pytest.approx([begin + (k + .5) * O.dt for k in range(5)])
    assert seen[0][:2] == tuple(from_[low[0]])
    way = 50 * (solver.time**2 - begin**2)  # the middle of steps sums a line exactly
    assert solver.nodes[low] - from_[low] == pytest.approx(np.tile([way, 0], (len(low), 1)), abs=1e-12)
    energy = solver.energy
    assert abs(energy['total']) < 1e-3 * energy['external']


def test_crackedNodesMoveOn():
    """Both halves of a plate that is pulled apart by its turning ends; new nodes turn, too."""
    solver = block(.2, w.BrittleFEMat(young=1e7, density=1000, tensileStrength=1e3))
    chosen = np.nonzero(solver.nodes[:, 1] > .7)[0]
    solver.rotate(chosen, 5., (0, 0))
    distance = np.linalg.norm(solver.nodes, axis=1)
    count = len(distance)
    steps(300)
    assert solver.numCracks > 0 and len(solver.nodes) > count
    reference = np.linalg.norm(solver._reference, axis=1)
    moved = np.nonzero(solver.reactions.any(axis=1))[0]
    assert set(chosen) <= set(moved) and moved.max() >= count
    assert np.linalg.norm(solver.nodes[moved], axis=1) == pytest.approx(reference[moved], rel=1e-9)


def test_functionsAreRequiredAfterALoad(folder):
    solver = block()
    path = os.path.join(folder, 'scene.yade')
    low = bottom(solver)
    solver.prescribe(low, vy=lambda x, y, t: 1)
    steps(3)
    solver = reloaded(path)
    before, speed = solver.nodes, solver.velocities
    with pytest.raises(RuntimeError, match='call FESolver.prescribe for them again'):
        O.step()
    assert (solver.nodes == before).all() and (solver.velocities == speed).all()
    # That of other nodes is not theirs.
    top = np.nonzero(solver.nodes[:, 1] > solver.nodes[:, 1].max() - 1e-9)[0]
    solver.prescribe(top, vy=lambda x, y, t: -2)
    with pytest.raises(RuntimeError, match='call FESolver.prescribe for them again'):
        O.step()
    solver.prescribe(low, vy=lambda x, y, t: 1)
    O.run(4, True)  # in YADE's own thread
    assert (solver.velocities[low, 1] == 1).all() and (solver.velocities[top, 1] == -2).all()
    assert solver.time == pytest.approx(7 * O.dt)


@pytest.mark.parametrize('value, sentence', [
    (lambda x, y, t: 1 / 0, 'raised ZeroDivisionError: '),
    (lambda x, y, t: 'fast', r"raised ValueError: vy\(.*\) is 'fast', it must be a finite number"),
])
def test_functionsThatFailStopTheStepUnharmed(value, sentence):
    solver = block()
    low = bottom(solver)
    steps(2)
    solver.prescribe(low, vy=value)
    before, speed, energy = solver.nodes, solver.velocities, solver.energy
    with pytest.raises(RuntimeError, match=sentence):
        O.step()
    assert (solver.nodes == before).all() and (solver.velocities == speed).all()
    assert solver.energy == energy
    solver.prescribe(low)
    O.step()


def test_namesAreTakenOnce():
    solver = fe()
    place = [rectangle((2 * k, 0), (2 * k + 1, 1)) for k in range(2)]
    assert solver.addPolygon(place[0], size=.5, material='m', name='anvil') == 0
    solver.removeBody('anvil')
    assert solver.addPolygon(place[1], size=.5, material='m', name='anvil') == 1
    assert repr(solver.meshQuality('anvil')) == repr(solver.meshQuality(1))


# --- functions of a script that a step calls: what they must not do is refused with its own sentence

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
