"""YADE's rigid bodies that obey forces are part of the contact system: they and FE bodies exchange momentum and
energy within the step, whatever their masses."""
import math

import numpy as np
import pytest

import yadefrag
from fe_scene import bodyOf, fe, kineticEnergy, momentum, O, run, steps
from test_fe_rigid import block
from yade import utils
from yade import wrapper as w
from yade.minieigenHP import Quaternion, Vector3


def free(body, mass=None, velocity=(0, 0), turning=0, blocked='zXY'):
    """Lets it obey forces; `mass` in kg, that of its density if none."""
    state = body.state
    if mass is not None:
        ratio = mass / state.mass if state.mass else 1
        state.inertia = state.inertia * ratio if state.mass else (1, 1, mass * 1e-3)
        state.mass = mass
    state.blockedDOFs = blocked
    state.vel = (*velocity, 0)
    state.angVel = (0, 0, turning)
    state.angMom = (0, 0, turning * state.inertia[2])
    return body


def box(centre, half, angle=0, friction=.3, **motion):
    label = 'rigid%g' % friction
    if label not in [m.label for m in O.materials]:
        O.materials.append(w.FrictMat(density=1000, frictionAngle=friction, young=1e7, poisson=.3, label=label))
    number = O.bodies.append(utils.box((*centre, 0), (*half, .5), material=label,
                                       orientation=Quaternion((0, 0, 1), angle)))
    return free(O.bodies[number], **motion)


class Balance:
    """Momenta and energies of FE bodies and of rigid ones, before and after."""

    def __init__(self, solver, rigid):
        self.solver, self.rigid = solver, rigid
        self.before = self.momenta(), self.rigidEnergy(), -solver.energy['outside']
        self.most = self.rigidEnergy() + solver.energy['kinetic']
        self.total = solver.energy['total']

    def rigidEnergy(self):
        return kineticEnergy(*self.rigid)

    def momenta(self):
        return np.append(*momentum(self.solver, self.rigid))

    def check(self, exchanged, energy=1e-3, angular=1e-9, axes=(0, 1, 2), friction=1e-6):
        """What the rigid bodies lose is what the FE bodies get. `exchanged`: kg m/s; `angular`: of that times 1 m,
        for friction, which acts across the gap at the start of a step; `friction`: part of the energy that it may give,
        which is more for bodies much lighter than nodes, where sweeps converge slowly."""
        change = np.abs(self.momenta() - self.before[0])
        rounding = 1e-15 * sum(b.state.mass for b in self.rigid)
        for axis, limit in ((0, 1e-12), (1, 1e-12), (2, angular)):
            assert axis not in axes or change[axis] < limit * exchanged + rounding, (axis, change[axis] / exchanged)
        lost = self.before[1] - self.rigidEnergy()
        got = -self.solver.energy['outside'] - self.before[2]
        assert abs(lost - got) < energy * self.most, (lost, got)
        # Contact only takes energy, and nothing else changes it.
        assert self.solver.energy['contact'] > -1e-6 * self.most
        assert self.solver.energy['friction'] > -friction * self.most
        assert abs(self.solver.energy['total'] - self.total) < energy * self.most
        assert [one for one in self.solver.warnings if not one.startswith(('Spheres', 'FE bodies are'))] == []


@pytest.mark.parametrize('way', [{}, {'passes': 2}])
@pytest.mark.parametrize('ratio', [1e-6, 1e-3, .1, 1, 10, 1e3, 1e6])
def test_boxOfAnyMassHitsABlock(ratio, way):
    """Of 1e-6 to 1e6 of the mass of the block, 10 kg; off its middle, so that both turn."""
    solver = fe(**way)
    block(solver)
    body = box((-.061, .085), (.06, .04), mass=10 * ratio, velocity=(1, .2))
    run(solver)
    balance = Balance(solver, [body])
    steps(int(.03 / O.dt))
    assert solver.velocities[:, 0].mean() > 1e-3 * min(1, ratio) and abs(body.state.angVel[2]) > 1e-6 * min(1, 1 / ratio)
    balance.check(10 * min(1, ratio), angular=1e-6)
    if ratio < 1e-2:
        # It rebounds no faster than it came.
        assert -1 <= body.state.vel[0] < 0


@pytest.mark.parametrize('kind', ['bar hits', 'box hits'])
@pytest.mark.parametrize('part', [.05, .5])
def test_boxAtABarFollowsTheWave(kind, part):
    """A rigid body at the end of a long bar: the bar pushes it by ρcA times the difference of the velocities, so that
    this difference decreases as exp(-t ρcA/M); `part`: M of the bar's mass. 1 % of the velocity, for the waves of the
    mesh."""
    length, height, speed = 1., .05, .1
    moving = speed if kind == 'bar hits' else 0
    solver = bodyOf(yadefrag.rectangle((0, 0), (length, height)), .005,
                    w.FEMat(young=1e7, poisson=0, density=1000, frictionAngle=0), mesh='regular', velocity=(-moving, 0))
    mass = part * 1000 * length * height
    body = box((-.03, height / 2), (.03, .05), mass=mass, friction=0, velocity=(speed - moving, 0))
    run(solver, factor=.5)
    c = math.sqrt(1e7 / 1000)
    balance, last = Balance(solver, [body]), 1.6 * length / c
    rate = 1000 * c * height / mass
    while solver.time < last:
        steps(40)
        decayed = speed * math.exp(-rate * solver.time)
        wanted = speed - decayed if kind == 'bar hits' else decayed
        found = -body.state.vel[0] if kind == 'bar hits' else body.state.vel[0]
        assert abs(found - wanted) < .01 * speed, (solver.time, found, wanted)
    balance.check(mass * speed)


BLOCKED = {'zXY': (True, True, True), 'xzXY': (False, True, True), 'yzXY': (True, False, True),
           'zXYZ': (True, True, False), 'xyzXY': (False, False, True), 'yzXYZ': (True, False, False)}


@pytest.mark.parametrize('blocked', BLOCKED)
@pytest.mark.parametrize('friction', [0, .5])
def test_blockedDirectionsTakeNoPart(blocked, friction):
    """A tilted box, which the block hits off its middle: a blocked direction keeps its velocity, and the others have
    exact energy and momentum."""
    solver = fe()
    O.materials['m'].frictionAngle = friction
    block(solver, velocity=(-1, -.2))
    body = box((-.09, .03), (.06, .04), angle=.5, mass=2, friction=friction, blocked=blocked)
    run(solver)
    balance = Balance(solver, [body])
    steps(int(.03 / O.dt))
    s, allowed = body.state, BLOCKED[blocked]
    for value, may in zip((s.vel[0], s.vel[1], s.angVel[2]), allowed):
        assert (abs(value) > 1e-3) == may
    # A held turn takes angular momentum.
    balance.check(1, axes=[i for i in range(2) if allowed[i]] + [2] * all(allowed), angular=1e-6 if friction else 1e-9)
    assert (solver.energy['friction'] > 1e-4) == (friction > 0)


def clump(kind):
    """A clump of two boxes, of facets around a sphere, or of a box and spheres; the clump's body."""
    box((-.3, .05), (.01, .01))  # the material
    O.bodies.erase(O.bodies[-1].id)
    material = O.materials[-1].label
    if kind == 'boxes':
        parts = [utils.box((-.061, .08, 0), (.06, .02, .5), material=material),
                 utils.box((-.091, .03, 0), (.03, .029, .5), material=material)]
    elif kind == 'facets':
        corners = [(-.04, .04), (-.001, .08), (-.04, .12), (-.08, .08)]
        parts = [utils.facet([(*a, 1), (*a, -1), (*b, 0)], material=material)
                 for a, b in zip(corners, corners[1:] + corners[:1])]
        parts.append(utils.sphere((-.04, .08, 0), .02, material=material))
    else:
        parts = [utils.box((-.061, .08, 0), (.06, .02, .5), material=material),
                 utils.sphere((-.14, .08, 0), .02, material=material)]
    number, _ = O.bodies.appendClumped(parts)
    state = O.bodies[number].state
    z = state.ori.conjugate() * Vector3(0, 0, 1)
    state.inertia = (sum(z[k]**2 * state.inertia[k] for k in range(3)),) * 3  # about z: YADE uses only the third
    return O.bodies[number]


@pytest.mark.parametrize('kind', ['boxes', 'facets', 'box and sphere'])
def test_clumpIsOneBody(kind):
    solver = fe()
    block(solver)
    body = free(clump(kind), mass=1, velocity=(1, .1))
    run(solver)
    steps(1)
    balance = Balance(solver, [body])
    steps(int(.03 / O.dt))
    assert body.state.vel[0] < .5 and abs(body.state.angVel[2]) > .05
    balance.check(1, angular=1e-6)


@pytest.mark.parametrize('friction', [0, .6])
@pytest.mark.parametrize('mass', [1e-3, 1, 100])
def test_boxBetweenTwoBlocks(mass, friction):
    """Both push it at once: their rows are one system. A light box transmits the impact of the two."""
    solver = fe()
    O.materials['m'].frictionAngle = friction
    block(solver, (-.16, 0), velocity=(1, 0))
    block(solver, (.0005, .01), velocity=(-.5, .2))
    body = box((-.03, .05), (.0295, .04), mass=mass, friction=friction)
    run(solver)
    balance = Balance(solver, [body])
    steps(int(.03 / O.dt))
    one, two = (solver.velocities[solver.nodesOf(i)].mean(axis=0)[0] for i in (0, 1))
    assert one < two
    # What sweeps leave matters most to a light box.
    balance.check(5, angular=3e-5 if mass < 1 else 1e-5 if friction else 1e-6, friction=1e-4 if mass < 1 else 1e-6)


def test_boxOnACrackingBlock():
    solver = bodyOf(yadefrag.rectangle((0, 0), (.1, .1)), .02,
                    w.BrittleFEMat(young=1e9, poisson=.2, density=2000, frictionAngle=.3, tensileStrength=2e5))
    body = box((-.058, .06), (.05, .03), angle=.3, mass=3, velocity=(4, 0))
    run(solver)
    balance = Balance(solver, [body])
    steps(int(.01 / O.dt))
    assert solver.numCracks > 10
    balance.check(10, angular=1e-4)


def test_boxComesToRestUnderItsWeight():
    """Gravity and forces of spheres are part of its free motion: at rest it presses with both, and does not move."""
    solver = bodyOf(yadefrag.rectangle((0, 0), (.2, .1)), .025,
                    w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.5),
                    solver=dict(gravity=(0, -9.81), damping=200), fixed=lambda x, y: y < 1e-9)
    body = box((.1, .12), (.05, .02), mass=.05, friction=.5)
    run(solver)
    O.engines[-1].gravity = (0, -9.81, 0)
    steps(int(.2 / O.dt))
    place = body.state.pos[1]
    steps(2000)
    assert abs(body.state.pos[1] - place) < 1e-9 and body.state.vel.norm() < 1e-6
    assert O.forces.f(body.id)[1] == pytest.approx(.05 * 9.81, rel=1e-4)
    assert solver.warnings == []


def test_bodyThatStopsToObeyForcesIsHeld():
    """A box blocked by the script in the midst of the contact is a fixed one from then on, and free again later."""
    solver = fe()
    block(solver, velocity=(-1, 0))
    body = box((-.0605, .05), (.06, .04), mass=.3)
    run(solver)
    steps(int(.003 / O.dt))
    assert body.state.vel[0] < -.1
    body.state.vel, body.state.blockedDOFs = (0, 0, 0), 'xyzXYZ'
    place = tuple(body.state.pos)
    steps(200)
    assert tuple(body.state.pos) == place and solver.nodes[:, 0].min() > place[0] + .06 - 1e-6
    body.state.blockedDOFs = 'zXY'
    balance = Balance(solver, [body])
    steps(int(.02 / O.dt))
    assert body.state.vel[0] < -.1 or solver.velocities[:, 0].mean() > 0
    balance.check(1, axes=(0, 1))
