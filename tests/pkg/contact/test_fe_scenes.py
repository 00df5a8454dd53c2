"""FESolver in YADE's scenes: saving and loading, other scenes, bodies that come and go."""
import builtins
import math
import os
from random import Random

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, finder, impact, newBall, O, ready, reloaded, run, steps, throwBall
from yade import wrapper as w


def course(seed, folder=None):
    """A run whose step and settings change at random; with a folder, saved and loaded at random
    moments, too."""
    O.reset()
    random, moments = Random(seed), Random(seed + 1)
    solver = impact(random.choice(['LebesgueCollider', 'InsertionSortCollider']), smooth=random.choice([False, True]))
    throwBall((.15, .151), .05, (0, -1)).mask = random.choice([1, 2])
    run(solver, O.engines[1], spheres=True, factor=.5)
    for _ in range(15):
        O.dt = random.uniform(.05, .5) * solver.criticalTimeStep()
        solver.halo = random.choice([0, random.uniform(.05, .5)])
        solver.passes = random.choice([1, 2])
        solver.damping = random.choice([0, 10])
        steps(random.randint(5, 40))
        if folder and moments.random() < .4:
            solver = reloaded(os.path.join(folder, 'scene' + moments.choice(['.yade', '.xml'])))
    return solver, tuple(O.bodies[-1].state.pos)


@pytest.mark.parametrize('seed', [*range(6), *(pytest.param(n, marks=pytest.mark.long) for n in range(6, 60))])
def test_changesAndSavesAtRandom(seed, folder):
    plain, place = course(seed)
    wanted = plain.nodes, plain.velocities, plain.energy, plain.warnings
    solver, again = course(seed, folder)
    assert np.array_equal(solver.nodes, wanted[0]) and np.array_equal(solver.velocities, wanted[1])
    assert (solver.energy, solver.warnings, again) == (*wanted[2:], place)


@pytest.mark.parametrize('ending', ['.xml', '.yade'])
@pytest.mark.parametrize('damage', ['edited', 'cut off'])
def test_damagedFileIsRefused(ending, damage, folder):
    """A body that is moved in the file must not overlap others undetected."""
    solver = impact('LebesgueCollider')
    steps(20)
    path = os.path.join(folder, 'scene' + ending)
    O.save(path)
    nodes = solver.nodes
    with open(path, 'rb') as file:
        data = file.read()
    at = data.index(b'<position>') + 100 if ending == '.xml' else data.index(nodes.tobytes()) + 200
    with open(path, 'wb') as file:
        file.write(data[:at])
        if damage == 'edited':
            digit = next(i for i in range(at, len(data)) if ending != '.xml' or chr(data[i]).isdigit())
            other = data[digit] ^ 1
            file.write(data[at:digit] + bytes([other]) + data[digit + 1:])
    O.reset()
    with pytest.raises(RuntimeError, match='^The saved state of FESolver is damaged .*; load ano'):
        O.load(path)
    with open(path, 'wb') as file:
        file.write(data)
    O.load(path)
    solver = [e for e in O.engines if isinstance(e, w.FESolver)][0]
    assert np.array_equal(solver.nodes, nodes)
    steps(3)


# --- scenes

def test_severalScenes():
    solver = impact('LebesgueCollider')
    steps(20)
    O.addScene()
    O.switchScene()
    try:
        O.materials.append(w.FEMat(label='n'))
        other = w.FESolver()
        other.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='n')
        run(other, finder('LebesgueCollider'))
        steps(5)
        assert len(other.nodes) < len(solver.nodes)
        with pytest.raises((ValueError, RuntimeError), match='not in the scene|no longer in the scene'):
            solver.addPolygon(yadefrag.rectangle((3, 3), (4, 4)), size=.5, material='n')
    finally:
        O.switchScene()
    before = solver.nodes
    steps(20)
    assert not np.array_equal(before, solver.nodes)


def test_resetScene():
    solver = impact('LebesgueCollider')
    steps(5)
    O.reset()
    assert len(O.bodies) == 0 and len(solver.nodes) > 0
    O.engines = [solver]
    with pytest.raises(RuntimeError, match='not in the scene|no longer in the scene'):
        O.step()


def test_eraseIsRefused():
    solver = impact('LebesgueCollider')
    count = len(O.bodies)
    with pytest.raises(ValueError, match='part of the boundary of body 0 of FESolver'):
        O.bodies.erase(3)
    assert len(O.bodies) == count and O.bodies[3]
    ball = O.bodies.append(newBall((5, 5), .1, O.materials['m']))
    assert O.bodies.erase(ball) and not O.bodies.erase(ball)
    steps(3)
    O.bodies.clear()
    with pytest.raises(RuntimeError, match='The bodies of this FESolver are not in the scene'):
        O.step()
    assert solver.numSearches > 0


def test_wholeBodyIsRemoved(colliderName):
    solver = impact(colliderName)
    third = solver.addPolygon(yadefrag.rectangle((.21, -.1), (.3, .1)), size=.02, material='m')
    steps(200)
    entries = {c: [b.id for b in O.bodies if b.shape.component == c] for c in range(3)}
    solver.removeBody(1)
    assert all(O.bodies[k] is None for k in entries[1])
    assert set(solver.components) == {0, 2} and third == 2
    assert len(solver.surfaces) == 2
    kept = [O.bodies[k].shape.entry for k in entries[0] + entries[2]]
    assert kept == list(range(len(kept)))
    steps(800)  # the disc goes on and meets the third body
    assert solver.fragments()[1]['velocity'][0] > .01
    with pytest.raises(ValueError, match='component is 1, which is no body'):
        solver.removeBody(1)
    solver.removeBody(0)
    solver.removeBody(2)
    steps(2)
    assert len(solver.nodes) == 0 and solver.criticalTimeStep() == math.inf


@pytest.mark.parametrize('kind', ['elastic', 'smoothed', 'brittle', 'plastic'])
def test_totalEnergyStaysWhereBodiesComeAndGo(kind):
    solver = fe()
    constants = dict(young=1e7, poisson=.3, density=1000, frictionAngle=.3, label='own')
    O.materials.append(dict(brittle=w.BrittleFEMat(tensileStrength=3e4, fractureEnergy=20, **constants),
                            plastic=w.PlasticFEMat(yieldStress=2e4, **constants)).get(kind) or w.FEMat(**constants))
    def add(y, speed):
        return solver.addPolygon(yadefrag.rectangle((0, y), (.1, y + .05)), size=.0125, material='own',
                                 velocity=(0, speed), element='smoothed' if kind == 'smoothed' else 'linear')
    add(0, 5)
    second = add(.0501, -5)
    O.bodies.append(newBall((.05, .1107), .01, O.materials['m']))
    O.bodies[-1].state.vel = (0, -8, 0)
    ready(solver, .3, spheres=True)
    while not any(i.isReal for i in O.interactions):
        O.step()
    steps(10)
    def check(change):
        before = solver.energy
        change()
        after = solver.energy
        for name in ('total', 'scene'):
            assert after[name] == pytest.approx(before[name], abs=1e-9 * before['kinetic'])
        assert after['outside'] - before['outside'] == pytest.approx(
            builtins.sum(before[name] - after[name] for name in ('kinetic', 'strain')), abs=.05 * before['strain'])
    check(lambda: add(.3, 2))
    check(lambda: solver.removeBody(second))
    total = solver.energy['total']
    steps(60)
    assert solver.energy['total'] == pytest.approx(total, abs=1e-3 * solver.energy['kinetic'])
    assert not [one for one in solver.warnings if 'created' in one]


def test_bodiesJoinARun():
    solver = impact('LebesgueCollider')
    steps(100)
    number = solver.addPolygon(yadefrag.rectangle((.21, -.1), (.3, .1)), size=.02, material='m', velocity=(-3, 0))
    assert number == 2
    steps(300)
    assert solver.fragments()[2]['velocity'][0] > -2.9


def test_contactGoesOnWhenAThirdBodyIsRemoved():
    """A block that lies on another one, and sticks to it."""
    def heights(removes):
        O.reset()
        solver = fe(gravity=(0, -9.81), damping=200.)
        still = dict(material='m', size=.02, fixed=lambda x, y: y < -.09 or y > 1)
        solver.addPolygon(yadefrag.rectangle((2, 2), (2.1, 2.1)), **still, name='third')
        solver.addPolygon(yadefrag.rectangle((-.2, -.1), (.2, 0)), **still, name='floor')
        solver.addPolygon(yadefrag.rectangle((-.1, 0), (.1, .3)), **still, name='block')
        run(solver)
        O.run(1500, True)
        if removes:
            solver.removeBody('third')
        found = []
        for _ in range(200):
            O.step()
            found.append(solver.nodes[solver.nodesOf('block'), 1].mean())
        weight = .2 * .3 * 1000 * 9.81
        assert solver.contactForce('floor', 'block')[1] == pytest.approx(-weight, rel=1e-2)
        return np.array(found)

    assert np.abs(heights(True) - heights(False)).max() < 1e-12
