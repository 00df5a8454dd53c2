"""FESolver in YADE at its limits: what a script meets there, with a collider, spheres and O.dt.

tests/extremes has the limits themselves, without YADE.
"""
import builtins
import json
import math
import os
import re
import subprocess
import sys

import numpy as np
import pytest

import fe_extreme_scenes as extreme
import yadefrag
from fe_extreme_scenes import SCENES, WAVE, blow, brittle, digest, slider, sphereOn
from project import yadeCommand
from yade import wrapper as w

O = builtins.O
kHere = os.path.dirname(os.path.abspath(__file__))
isLong = bool(os.environ.get('YADEFRAG_LONG'))


def run(scene):
    solver, steps = scene
    O.run(steps, True)
    return solver


def speeds(solver):
    """Mean velocities (n, 2) of the bodies that are in one piece."""
    return np.array([f['velocity'] for f in solver.fragments()])


def isSound(solver, start, allowed=1e-3):
    """No energy is created: `start` is the initial energy."""
    energy = solver.energy
    return energy['kinetic'] + energy['strain'] <= start * (1 + allowed) \
        and abs(energy['total'] / start - 1) < .01


@pytest.fixture(scope='module')
def usual():
    """(end speeds over the speed, nodes over the size) of a usual blow."""
    O.reset()
    solver = run(blow())
    return speeds(solver) / (1e-3 * WAVE), solver.nodes


# --- the same bits with two threads, and after saving in the middle

def digestOf(name, middle=None, path=None, most=math.inf):
    """Of a run, of no more than `most` steps; `path`: saved and loaded after `middle` of it."""
    O.reset()
    solver, steps = SCENES[name]()
    steps = min(steps, most)
    if path is None:
        O.run(steps, True)
        return digest(solver)
    half = max(1, int(middle * steps))
    O.run(half, True)
    O.save(path)
    O.reset()
    O.load(path)
    O.run(steps - half, True)
    return digest([e for e in O.engines if isinstance(e, w.FESolver)][0])


def byProcess(threads):
    command = [*yadeCommand(), '-j%d' % threads, os.path.join(kHere, 'fe_extreme_scenes.py'), 'print']
    # Threads that wait shall not take a busy machine's processors from those that they wait for.
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=600, env={**os.environ, 'OMP_WAIT_POLICY': 'passive'})
    lines = [line for line in done.stdout.splitlines() if line.startswith('@@@ ')]
    assert done.returncode == 0 and lines, done.stdout[-1500:] + done.stderr[-1500:]
    return json.loads(lines[-1][4:])


def test_twoThreadsGiveTheSameBits():
    two = byProcess(2)
    assert two['threads'] == 2
    assert two['results'] == {name: digestOf(name, most=extreme.MOST) for name in SCENES}


@pytest.mark.parametrize('name', SCENES)
def test_savedInTheMiddleItGoesOnBitForBit(name, folder):
    whole = digestOf(name)
    for middle, ending in ((.5, '.yade'), (.8, '.xml')) if isLong else ((.5, '.yade'),):
        assert digestOf(name, middle, folder + '/scene' + ending) == whole


# --- time steps and speeds

@pytest.mark.parametrize('part', [1e-3, .01, .1, .9, .9999])
def test_timeStepsUpToTheCriticalOne(part, usual):
    if part < .01 and not isLong:
        pytest.skip('only with YADEFRAG_LONG')
    solver = run(blow(part=part))
    assert speeds(solver)[:, 0] / (1e-3 * WAVE) == pytest.approx(usual[0][:, 0], abs=.004)


def test_timeStepJustAboveTheCriticalOne():
    solver, _ = blow(part=1.0001)
    before = solver.nodes
    with pytest.raises(ValueError, match='^O.dt: The time step is .* at most .* s, the critical'):
        O.step()
    assert np.array_equal(solver.nodes, before) and solver.energy['contact'] == 0
    O.dt = solver.criticalTimeStep()
    O.run(20, True)


@pytest.mark.parametrize('speed', [1e-9, 1e-6, 1e-3, 10, .5 * WAVE])
def test_speeds(speed, usual):
    solver, steps = blow(speed, gap=min(1e-3, .01 * speed / WAVE))
    start = solver.energy['kinetic']
    run((solver, steps))
    assert speeds(solver)[:, 0] / speed == pytest.approx(usual[0][:, 0], abs=.05)
    assert isSound(solver, start)


def test_tooSlowForTheCoordinates():
    solver, _ = blow(0)
    count = len(O.bodies)
    with pytest.raises(ValueError, match='velocity is 1e-09 m/s at most: .* lost in rounding'):
        solver.addPolygon(yadefrag.rectangle((1e6, 0), (1e6 + 1, 1)), size=.5,
                          material=O.materials[0], velocity=(1e-9, 0))
    assert len(O.bodies) == count


def proposed(error):
    """The step (s) that a sentence proposes."""
    found = re.search('take a step of at most ([^ ]*) s', str(error.value))
    assert found, str(error.value)
    return float(found.group(1))


def stepAsAsked(solver, most):
    """O.step, with the shorter steps that it proposes, and how many times it did."""
    for asked in range(most):
        before, velocity = solver.nodes, solver.velocities
        try:
            O.step()
            return asked
        except RuntimeError:
            with pytest.raises(RuntimeError) as error:
                O.step()  # it proposes the same again
        assert np.abs(solver.nodes - before).max() <= 1e-12 and O.dt > proposed(error)
        assert np.abs(solver.velocities - velocity).max() <= 1e-12 * np.abs(velocity).max()
        O.dt = .999 * proposed(error)
    raise AssertionError('it never stops asking')


@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
def test_supersonicPassByNeedsNoShorterStep(collider):
    """Two blocks shoot past each other, a hair apart: their ways do not cross."""
    solver, _ = blow(5 * WAVE, gap=.2, aside=1.0001, collider=collider)
    O.run(100, True)
    assert solver.nodes[0, 0] > 1.5 and solver.energy['contact'] == 0
    assert speeds(solver)[:, 0] == pytest.approx([5 * WAVE, 0], abs=1e-9 * WAVE)


@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
def test_supersonicPassByGoesOnWithTheStepThatIsProposed(collider):
    """Two blocks shoot past each other and just touch, which cannot be predicted. The corners graze
    each other: half a per cent of the speed goes over."""
    solver, _ = blow(5 * WAVE, gap=.2, aside=1, collider=collider)
    asked = 0
    while speeds(solver)[0, 0] > 0 and solver.nodes[0, 0] < 1.5:
        asked += stepAsAsked(solver, 5)
    assert 1 <= asked < 5
    assert speeds(solver)[:, 0] == pytest.approx([5 * WAVE, 0], abs=.03 * WAVE)


@pytest.mark.parametrize('isBehind', [False, True])
@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
def test_supersonicBlowEndsWithASentence(collider, isBehind):
    """It goes on with the step proposed, until it crushes an element, or contact would: the bounds
    of the refused step were made for slower bodies, and what they miss must not go through unseen."""
    solver, _ = blow(5 * WAVE, gap=.2, collider=collider)
    if isBehind:
        O.engines = [O.engines[0], *O.engines[2:], O.engines[1]]
    asked = 0
    with pytest.raises(RuntimeError, match='is inverted|contact moves a surface node'):
        for _ in range(1000):
            try:
                O.step()
            except RuntimeError as error:
                if 'take a step of' not in str(error):
                    raise
                asked += stepAsAsked(solver, 5)
    assert asked >= 1 and np.isfinite(solver.nodes).all()


# --- sizes, places, masses, shapes

@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('size', [1e-9, 1e-3, 1e6])
def test_sizes(size, collider, usual):
    solver = run(blow(size=size, collider=collider))
    assert np.abs(solver.nodes / size - usual[1]).max() < 1e-12


@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('size', [1, 1e-3])
def test_farFromTheOrigin(size, collider):
    near = run(blow(size=size, gap=1e-3)).nodes
    O.reset()
    solver, steps = blow(size=size, gap=1e-3, at=(1e6, -1e6), collider=collider)
    start = solver.energy['kinetic']
    far = run((solver, steps)).nodes
    assert np.abs(far - (1e6, -1e6) - near).max() < (1e-8 if size == 1 else 3e-8)
    assert isSound(solver, start, 1e-3 if size == 1 else .01)


@pytest.mark.parametrize('ratio', [1e-8, 1e8])
def test_masses(ratio):
    solver = run(blow(ratio=ratio, gap=1e-6 * min(1, math.sqrt(ratio)),
                      until=6 * min(1, math.sqrt(ratio))))
    left, right = speeds(solver)[:, 0] / (1e-3 * WAVE)
    if ratio > 1:
        assert left == pytest.approx(-.7, abs=.1) and abs(right) < 1e-7
    else:
        assert left == pytest.approx(1, abs=1e-6)


def test_sliver():
    solver, steps = extreme.needle()
    start = solver.energy['kinetic']
    touched = 0
    for _ in range(10):
        O.run(steps // 10, True)
        touched += solver.numActives
    assert touched > 0 and isSound(solver, start)
    assert solver.maxPenetration < 1e-6


@pytest.mark.parametrize('at', [(0, 0), (1e6, -1e6)])
@pytest.mark.parametrize('speed', [0, 1e-3 * WAVE])
def test_touchingBodies(at, speed, usual):
    solver = run(blow(speed, gap=0, at=at))
    if speed:
        assert speeds(solver)[:, 0] / speed == pytest.approx(usual[0][:, 0], abs=.01)
    else:
        assert np.abs(solver.velocities).max() < (1e-6 if at[0] else 1e-12)


# --- friction and strength

@pytest.mark.parametrize('friction, end', [(0, 1), (.5, .75), (1, .5), (100, 0)])
def test_friction(friction, end):
    """At 1000 m/s², over 0.5 ms."""
    assert speeds(run(slider(friction)))[1, 0] == pytest.approx(end, abs=.05)


def test_strengthWithoutBoundIsElastic():
    elastic = run(brittle(None)).nodes
    dt = O.dt
    O.reset()
    solver, steps = brittle(1e300)
    O.dt = dt
    assert np.abs(run((solver, steps)).nodes - elastic).max() <= 1e-12
    assert solver.numCracks == 0
    O.reset()
    with pytest.raises(ValueError, match='^tensileStrength is inf Pa; it must be positive and fin'):
        brittle(math.inf)


def test_strengthOfNextToNothing():
    solver, steps = brittle(1e-300)
    mass, momentum = solver.masses.sum(), (solver.masses[:, None] * solver.velocities).sum(0)
    start = solver.energy['kinetic']
    run((solver, steps))
    after = (solver.masses[:, None] * solver.velocities).sum(0)
    assert len(solver.fragments()) == len(solver.triangles)
    assert solver.masses.sum() == pytest.approx(mass, rel=1e-12)
    assert np.abs(after - momentum).max() < 1e-12 * mass * 20
    assert isSound(solver, start, .01)


def test_fractureEnergyOfNextToNothing():
    """No step resolves it; none at all opens at once."""
    with pytest.warns(UserWarning, match='less than four elements'):
        solver, _ = brittle(1e6, 1e-9)
    before = solver.nodes
    with pytest.raises(ValueError, match='^fractureEnergy is 1e-09 J/m² .* is sufficient'):
        O.step()
    assert np.array_equal(solver.nodes, before)
    O.reset()
    assert run(brittle(1e4)).numCracks > 0


# --- spheres

@pytest.mark.parametrize('collider', ['LebesgueCollider', 'InsertionSortCollider'])
@pytest.mark.parametrize('radius, size, at', [
    (1e-6, 1, (0, 0)), (1e-3, 1, (0, 0)), (100, 1, (0, 0)), (1e4, 1, (0, 0)), (.5, 1e-9, (0, 0)),
    (.5, 1e6, (0, 0)), (.5, 1, (1e6, -1e6))])
def test_spheresOfAnySizeComeBack(radius, size, at, collider):
    solver, steps = sphereOn(radius, at, size, collider)
    ball = O.bodies[-1].state
    speed = ball.vel[1]
    momentum = ball.mass * speed
    touched = 0
    for _ in range(steps):
        O.step()
        touched += any(i.isReal for i in O.interactions)
    given = (solver.masses[:, None] * solver.velocities).sum(0)[1]
    assert touched > 5
    assert ball.mass * ball.vel[1] + given == pytest.approx(momentum, rel=1e-9)
    if radius <= 1:
        assert .3 < ball.vel[1] / -speed < 1.1
    else:  # it weighs much more than what it falls on
        assert given / solver.masses.sum() < speed
