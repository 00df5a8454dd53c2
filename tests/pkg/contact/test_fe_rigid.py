"""YADE's Wall, Box and Facet are rigid bodies to FE bodies: contact forces act on both. FESolver in YADE's scenes: other scenes,
bodies that come and go."""
import builtins
import math

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, finder, impact, newBall, O, ready, run, solverOfScene, steps
from yade import utils, wrapper as w
from yade.minieigenHP import Quaternion


G = 9.81


def smooth(angle, label):
    """Friction of YADE's bodies; the density is theirs, too."""
    O.materials.append(w.FrictMat(density=1000, frictionAngle=angle, young=1e7, poisson=.3, label=label))
    return label


def wall(place, axis=1, sense=0, **settings):
    return utils.wall(place, axis=axis, sense=sense, **settings)


def facet(a, b, height=1, **settings):
    """A facet whose section with z = 0 is the line from a to b."""
    return utils.facet([(*a, height), (*a, -height), (*b, 0)], **settings)


def block(solver, low=(0, 0), size=.1, mesh=.025, **settings):
    """A square on its lower left corner."""
    high = low[0] + size, low[1] + size
    return solver.addPolygon(yadefrag.rectangle(low, high), size=mesh, material='m', **settings)


def onSurface(make, smooth=False, **settings):
    """A block 1 mm above y = 0, which falls; `make` makes what is there."""
    solver = fe(gravity=(0, -G), **settings)
    block(solver, (0, .001), velocity=(.3, -1), smooth=smooth)
    make()
    run(solver)
    return solver


# Where arcs touch the mean displacement of all boundaries decides what sweeps leave.
WAYS = [{}, {'passes': 2}, {'smooth': True, 'contactTolerance': 1e-9}]
SURFACES = {
    'wall': lambda: O.bodies.append(wall(0)),
    'wall of one side': lambda: O.bodies.append(wall(0, sense=1)),
    'box': lambda: O.bodies.append(utils.box((0, -.1, 0), (1, .1, .5), fixed=True)),
    'turned box': lambda: O.bodies.append(utils.box(
        (0, -.1, 0), (.1, 1, .5), fixed=True, orientation=Quaternion((0, 0, 1), math.pi / 2))),
    'facet': lambda: O.bodies.append(facet((-1, 0), (1, 0), fixed=True)),
    'two facets': lambda: O.bodies.append([facet((-1, 0), (.05, 0), fixed=True),
                                           facet((1, 0), (.05, 0), fixed=True)]),
}


@pytest.mark.parametrize('way', WAYS)
@pytest.mark.parametrize('what', SURFACES)
def test_dropIsThatOnABodyWithFixedNodes(what, way):
    """The same rows and the same bits but for rounding, 1e-9 of the block; the momentum that the block
    gains is that which the surface loses, to rounding."""
    fixed = onSurface(lambda: None, **way)
    critical = fixed.criticalTimeStep()
    fixed.addPolygon(yadefrag.rectangle((-1, -1), (1, 0)), size=1, material='m', fixed=lambda x, y: True)
    run(fixed)
    O.dt = .8 * critical
    wanted = []
    for _ in range(500):
        O.step()
        wanted.append(fixed.nodes[:len(fixed.nodesOf(0))])
    O.reset()
    solver, forces = onSurface(SURFACES[what], **way), []
    assert O.dt == .8 * critical
    for nodes in wanted:
        O.step()
        assert np.abs(solver.nodes - nodes).max() < 1e-10
        forces.append(sum(np.array(O.forces.f(b.id)) for b in O.bodies if not isinstance(b.shape, w.SurfaceSegment)))
    forces = np.array(forces)
    assert abs(forces[:, 1]).max() > 100 and solver.velocities[:, 1].mean() > 0
    mass = solver.masses.sum()
    gained = (solver.masses[:, None] * solver.velocities).sum(axis=0) - mass * np.array([.3, -1 - G * O.dt * 500])
    assert -forces[:, :2].sum(axis=0) * O.dt == pytest.approx(gained, rel=1e-9, abs=1e-9)
    assert solver.warnings == []


def test_surfacesComeAndGo():
    solver = fe(gravity=(0, -G))
    block(solver)
    run(solver)
    nodes, triangles = solver.nodes, solver.triangles
    O.bodies.append(wall(0))
    steps(100)
    assert solver.nodes[:, 1].min() > -1e-6
    O.bodies.erase(O.bodies[-1].id if O.bodies[-1] else len(O.bodies) - 1)
    steps(100)
    fallen = solver.nodes[:, 1].min()
    assert fallen < -.5 * G * (99 * O.dt)**2 * .9
    O.bodies.append(utils.box((0, fallen - .0501, 0), (1, .05, 1), fixed=True))
    steps(400)
    assert solver.nodes[:, 1].min() > fallen - .0001 - 1e-6
    solver.rigidBodies = False
    steps(100)
    assert solver.nodes[:, 1].min() < fallen - .0002
    # Scripts can access nodes of FE bodies only.
    assert len(solver.nodes) == len(nodes) and (solver.triangles == triangles).all()


def test_scriptsGetNoNodesOfSurfaces():
    solver = fe(gravity=(0, -G))
    one = block(solver, (0, 0), name='one')
    O.bodies.append([wall(0), facet((-1, .3), (1, .3), fixed=True)])
    run(solver)
    count, segments = len(solver.nodes), solver.numSegments
    critical = solver.criticalTimeStep()
    steps(3)
    two = block(solver, (0, .15), name='two')
    steps(3)
    assert solver.criticalTimeStep() == pytest.approx(critical, rel=1e-6)
    assert len(solver.nodes) == 2 * count == len(solver.masses) == len(solver.velocities) \
        == len(solver.reactions) == len(solver.contactForces) == len(solver.displacements)
    assert solver.numSegments == 2 * segments and len(solver.surfaces) == 2
    assert (solver.nodesOf('two') == count + np.arange(count)).all()
    assert (solver.nodes[solver.nodesOf(two)][:, 1] > .14).all()
    assert (np.unique(solver.triangles) == np.arange(2 * count)).all()
    corners = solver.nodes[solver.triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).min() > 0
    assert solver.masses.min() > 1e-3
    solver.prescribe(lambda x, y: y > .24, vx=0., vy=.1)
    loads = np.zeros((2 * count, 2))
    loads[solver.nodesOf('two'), 0] = 1
    solver.loads = loads
    assert (solver.loads == loads).all()
    steps(3)
    top = solver.nodes[:, 1] > .24
    assert (solver.velocities[top] == (0, .1)).all() and top.sum() >= 4
    assert not (solver.velocities[~top][:, 1] == .1).any()
    solver.removeBody(one)
    steps(3)
    assert len(solver.nodes) == count


def test_overlapIsRefused():
    solver = fe()
    block(solver)
    O.bodies.append(utils.box((.05, .05, 0), (.01, .01, 1), fixed=True))
    number = O.bodies[-1].id
    run(solver)
    before = solver.nodes
    with pytest.raises(ValueError, match=r'Box #%d overlaps body 0 at .*rigidBodies=False' % number):
        O.step()
    assert (solver.nodes == before).all()
    solver.rigidBodies = False
    steps(2)
    assert solver.warnings[0].startswith('FE bodies go through bodies of the shape Box, such as #%d' % number)


def test_integratorBeforeTheSolverIsReported():
    """Rigid bodies that obey forces then keep their velocity in a step; behind the solver they do not."""
    solver = fe()
    block(solver)
    O.bodies.append(utils.box((-.2, 0, 0), (.1, .1, .5), material=smooth(.3, 'light')))
    O.bodies[-1].state.blockedDOFs = 'zXY'
    O.engines = [w.NewtonIntegrator(damping=0), w.ForceResetter(), solver]
    O.dt = .8 * solver.criticalTimeStep()
    steps(3)
    [warning] = solver.warnings
    assert warning.startswith('NewtonIntegrator comes before FESolver in O.engines')
    O.engines = [w.ForceResetter(), solver, w.NewtonIntegrator(damping=0)]
    steps(3)
    assert len(solver.warnings) == 1
    O.engines = [w.ForceResetter(), w.NewtonIntegrator(damping=0), solver]
    with pytest.raises(ValueError, match='deletes the forces of FESolver before NewtonIntegrator'):
        O.step()


@pytest.mark.parametrize('isAdvised', [False, True])
def test_bodyWithoutMassIsReported(isAdvised):
    solver = fe()
    block(solver)
    O.bodies.append(facet((-.2, 0), (-.2, .1), fixed=False))
    one = O.bodies[-1]
    if isAdvised:
        one.state.mass, one.state.inertia = 1, (1, 1, 1)
    run(solver)
    steps(3)
    wanted = [] if isAdvised else ['Facet #%d is not fixed but has no mass or no inertia' % one.id]
    assert [text.partition(' inertia')[0] + ' inertia' for text in solver.warnings] == wanted
    assert not isAdvised or abs(one.state.pos[0]) < 1


def test_sceneWithoutThemHasNoCost():
    """The same bits and searches with the option on and off."""
    runs = []
    for rigid in (True, False):
        O.reset()
        solver = fe(rigidBodies=rigid)
        block(solver, velocity=(1, 0))
        block(solver, (.101, .03))
        run(solver, finder('LebesgueCollider'))
        steps(200)
        runs.append((solver.nodes.tobytes(), solver.numSearches, solver.numActives))
    assert runs[0] == runs[1] and runs[0][2] >= 0


# --- FESolver in YADE's scenes: saving and loading, other scenes, bodies that come and go

@pytest.mark.parametrize('ending', ['.xml', '.yade'])
@pytest.mark.parametrize('damage', ['edited', 'cut off'])
def test_damagedFileIsRefused(ending, damage, folder):
    """A body that is moved in the file must not overlap others undetected."""
    solver = impact('LebesgueCollider')
    steps(20)
    path = folder + '/scene' + ending
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
    assert np.array_equal(solverOfScene().nodes, nodes)
    steps(3)


@pytest.mark.parametrize('erase', [lambda: O.bodies.erase(3), lambda: O.bodies.deleteClumpBody(O.bodies[3])])
def test_stepsWithoutAPieceAreRefused(erase):
    impact('LebesgueCollider')
    erase()
    with pytest.raises(RuntimeError, match='Body #3 is no longer in the scene, but it is part of the boundary'):
        O.step()
    O.bodies.clear()
    with pytest.raises(RuntimeError, match='The bodies of this FESolver are not in the scene'):
        O.step()


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
