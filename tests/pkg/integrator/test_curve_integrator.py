"""CurveIntegrator in the place of YADE's NewtonIntegrator: the same bits, whatever bodies the scene has.
Threads: test_lifecycle.py."""

import numpy as np
import pytest
import yade.config
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Matrix3, Quaternion, Vector3

import scenes
from scenes import O, heap, state


def engines(name, **settings):
    newton = getattr(w, name)(**dict(dict(damping=.1, gravity=(1, 2, -10)), **settings))
    O.engines = [w.ForceResetter(), scenes.makeCollider('LebesgueCollider'), scenes.loop(), newton]
    return newton


def states():
    """As `state`, with what the integrator tells the collider, and angular momenta."""
    more = [[*b.state.angMom, O.engines[-1].maxVelocitySq] for b in O.bodies if b]
    return state() + [np.array(more, float).tobytes()]


def requireSame(build=heap, steps=500, every=100, change=None, **settings):
    """The integrator, after comparing all bits several times."""
    found = []
    for name in ('NewtonIntegrator', 'CurveIntegrator'):
        build()
        newton = engines(name, **settings)
        one = []
        for step in range(0, steps, every):
            if change:
                change(step)
            O.run(every, True)
            one.append(states())
        found.append(one)
        moved = [(b.state.pos - b.state.refPos).norm() for b in O.bodies if b]
        assert max(moved) > .5
    assert found[0] == found[1]
    return newton


@pytest.mark.parametrize('settings', [
    dict(), dict(damping=0), dict(dampGravity=False), dict(exactAsphericalRot=False), dict(mask=2),
    dict(damping=.7, gravity=(0, 0, 0))], ids=str)
def test_bits(settings):
    def masked():
        heap()
        for body in O.bodies:
            body.mask = 1 + body.id % 3
    newton = requireSame(masked, **settings)
    moved = [b for b in O.bodies if not b.isClumpMember and (settings.get('mask', -1) < 0 or b.mask & 2)]
    assert newton.fastBodies == len(moved) > 40


def test_blockedAndNotDamped():
    """Each set of blocked axes, bodies that move though all are blocked, bodies without damping or bound."""
    def various():
        heap()
        for body in O.bodies:
            if body.isClumpMember or body.isClump or not isinstance(body.shape, w.Sphere):
                continue
            body.state.blockedDOFs = ''.join(c for k, c in enumerate('xyzXYZ') if body.id >> k & 1)
            body.state.isDamped = body.id % 5 > 0
            body.state.densityScaling = 1 + body.id % 3
    various()
    assert len({b.state.blockedDOFs for b in O.bodies}) == 64
    requireSame(various)
    requireSame(various, dampGravity=False)


kRotations = [dict(rotAlgorithm=name, normalizeEvery=7) for name in ('delValle2023', 'Fincham1992', 'Omelyan1998')
              ] if yade.config.version >= '2025.2' else [{}]


@pytest.mark.parametrize('settings', [dict(one, **more) for one in kRotations for more in ({}, dict(damping=0))], ids=str)
@pytest.mark.parametrize('periodic', [False, True])
def test_aspherical(settings, periodic):
    """Bodies with three moments of inertia, some of which are scaled, or do not rotate about an axis; clumps among them."""
    def aspherical():
        heap(periodic=periodic)
        if periodic:
            O.cell.homoDeform = 2
            O.cell.velGrad = Matrix3(-.3, .2, 0, .1, -.2, 0, 0, 0, -.3)
        for body in O.bodies:
            if body.isStandalone and isinstance(body.shape, w.Sphere) and body.id % 2:
                body.aspherical = True
                body.state.inertia = (100, 200, 150)
                body.state.ori = Quaternion((1, body.id, 2), .1 * body.id)
                if body.id % 3 == 0:
                    body.state.blockedDOFs = 'X'

    def scaled(step):
        if step == 200:
            for body in O.bodies:
                body.state.densityScaling = 1 + .1 * (body.id % 7)
            O.engines[-1].densityScaling = True
    newton = requireSame(aspherical, change=scaled, **settings)
    free = [b for b in O.bodies if b.aspherical and not b.isClumpMember and not b.state.blockedDOFs]
    moved = sum(not b.isClumpMember for b in O.bodies)
    assert newton.fastBodies == moved - len(free) * (settings.get('rotAlgorithm') == 'Omelyan1998') and len(free) > 30


@pytest.mark.parametrize('settings', [*kRotations, dict(exactAsphericalRot=False)], ids=str)
def test_clumps(settings):
    """Members of any number and shape, a force on a clump, clumps that rotate about one axis or are fixed; a member that a
    script releases, a clump that it removes."""
    def build():
        heap()
        chance = np.random.default_rng(5)
        for number in range(40):
            at = chance.uniform(1, 8, 3) + (0, 0, 9)
            parts = [utils.sphere(at + chance.uniform(-.4, .4, 3), chance.uniform(.2, .5)) for _ in range(1 + number % 5)]
            if number % 9 == 0:
                parts.append(utils.box(at, (.2, .3, .1)))
            clump, _ = O.bodies.appendClumped(parts)
            state = O.bodies[clump].state
            state.vel, state.angVel = chance.normal(0, 3, 3), chance.normal(0, 4, 3)
            state.angMom = Vector3(*(state.inertia[k] * state.angVel[k] for k in range(3)))
            state.blockedDOFs = {3: 'XZ', 7: 'xyzXYZ'}.get(number, '')
            O.forces.setPermF(clump, (0, 0, 20. * number))

    def change(step):
        clumps = [b.id for b in O.bodies if b and b.isClump]
        if step == 200:
            O.bodies.releaseFromClump(list(O.bodies[clumps[5]].shape.members)[0], clumps[5])
        elif step == 300:
            O.bodies.erase(clumps[9], eraseClumpMembers=True)
    newton = requireSame(build, change=change, **settings)
    assert sum(b.isClump for b in O.bodies if b) == 40
    assert newton.fastBodies > 140 or settings.get('rotAlgorithm') == 'Omelyan1998'


@pytest.mark.parametrize('homoDeform', [0, 1, 2, 3])
def test_periodicCell(homoDeform):
    """Sheared and compressed, with a velocity gradient that changes."""
    def sheared():
        heap(periodic=True)
        O.cell.homoDeform = homoDeform
        O.cell.velGrad = Matrix3(-.3, .2, 0, .1, -.2, 0, 0, 0, -.3)

    def change(step):
        if step == 200:
            O.cell.velGrad = Matrix3(.1, 0, .3, 0, -.1, 0, 0, .2, 0)
    requireSame(sheared, change=change)


def test_energies():
    """YADE's integrator moves all bodies while energies are tracked."""
    def tracked():
        heap()
        O.trackEnergy = True
    found = []
    for split in (False, True):
        for name in ('NewtonIntegrator', 'CurveIntegrator'):
            tracked()
            newton = engines(name, kinSplit=split)
            O.run(300, True)
            found.append((states(), dict(O.energy.items())))
            O.trackEnergy = False
    assert found[0] == found[1] and found[2] == found[3]
    assert 'kinetic' in found[0][1] and 'kinRot' in found[2][1]
    assert newton.fastBodies == 0


def test_isAnIntegrator(capfd):
    """YADE's functions and other engines find it; a missing ForceResetter is reported as by YADE's."""
    heap()
    newton = engines('CurveIntegrator')
    assert isinstance(newton, w.NewtonIntegrator) and utils.typedEngine('NewtonIntegrator') == newton
    with pytest.raises(AttributeError, match='no setter'):
        newton.fastBodies = 3
    with pytest.raises(AttributeError):
        w.CurveIntegrator(wrong=1)
    O.engines = O.engines[1:]
    O.run(2, True)
    assert 'ForceResetter' in ''.join(capfd.readouterr())


def test_emptyScene():
    scenes.clear()
    O.engines = [w.ForceResetter(), w.CurveIntegrator(damping=0, gravity=(0, 0, -1))]
    O.dt = .1
    O.run(3, True)
    ball = utils.sphere((0, 0, 0), 1)
    O.bodies.append(ball)
    O.run(10, True)
    # Velocities at half steps: z = -g dt² n (n + 1) / 2.
    assert tuple(ball.state.pos) == pytest.approx((0, 0, -.01 * 55)) and O.engines[1].fastBodies == 1


def test_timing():
    """yade.timing shows no parts of NewtonIntegrator's time: these would be those of few bodies only."""
    heap()
    newton = engines('CurveIntegrator')
    O.timingEnabled = True
    O.run(20, True)
    assert newton.execCount == 20 and newton.execTime > 0 and newton.timingDeltas is None
