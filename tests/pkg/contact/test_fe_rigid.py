"""YADE's Wall, Box and Facet are rigid bodies to FE bodies: contact forces act on both."""
import math

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, finder, O, run, steps
from yade import utils
from yade import wrapper as w
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


def block(solver, low=(0, 0), size=.1, mesh=.025, velocity=(0, 0), angle=0, name=None, **settings):
    """A square on its lower left corner, turned by `angle` about that."""
    c, s = math.cos(angle), math.sin(angle)
    corners = [(low[0] + c * x - s * y, low[1] + s * x + c * y) for x, y in yadefrag.rectangle((0, 0), (size, size))]
    return solver.addPolygon(corners, size=mesh, material='m', velocity=velocity, name=name, **settings)


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


def path(make, count=500, **settings):
    solver = onSurface(make, **settings)
    nodes, forces = [], []
    for _ in range(count):
        O.step()
        nodes.append(solver.nodes)
        forces.append(sum(np.array(O.forces.f(b.id)) for b in O.bodies if not isinstance(b.shape, w.SurfaceSegment)))
    return solver, np.array(nodes), np.array(forces)


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
    solver, found, forces = path(SURFACES[what], **way)
    assert O.dt == .8 * critical
    assert np.abs(found - np.array(wanted)).max() < 1e-10
    assert abs(forces[:, 1]).max() > 100 and solver.velocities[:, 1].mean() > 0
    mass = solver.masses.sum()
    gained = (solver.masses[:, None] * solver.velocities).sum(axis=0) - mass * np.array([.3, -1 - G * O.dt * 500])
    assert -forces[:, :2].sum(axis=0) * O.dt == pytest.approx(gained, rel=1e-9, abs=1e-9)
    assert solver.warnings == []


@pytest.mark.parametrize('make', ['wall', 'box', 'facet'])
def test_restingBlockPressesWithItsWeight(make):
    solver = fe(gravity=(0, -G))
    block(solver)
    SURFACES[make]()
    run(solver)
    solver.relax(1e-12)
    O.step()
    [surface] = [b for b in O.bodies if not isinstance(b.shape, w.SurfaceSegment)]
    weight = G * solver.masses.sum()
    assert O.forces.f(surface.id)[1] == pytest.approx(-weight, rel=1e-4)
    # The moment about the place of the surface's body: the weight acts in the block's middle.
    arm = solver.nodes[:, 0].mean() - surface.state.pos[0]
    assert O.forces.t(surface.id)[2] == pytest.approx(-arm * weight, rel=1e-3, abs=1e-6 * weight)


@pytest.mark.parametrize('above', [-.05, .05])
@pytest.mark.parametrize('shape', ['box', 'facet'])
def test_slidesOnATiltedSurfaceAsFrictionRequires(shape, above):
    """A block at an angle of friction of 0.4, on slopes around it: it stays, or gains speed at
    g (sin a - cos a tan phi); 2 % of g sin a for the vibrations of its own start."""
    phi, slope = .4, .4 + above
    solver = fe(gravity=(0, -G), damping=300)
    O.materials['m'].frictionAngle = phi
    smooth(phi, 'rough')
    along, across = np.array([math.cos(slope), -math.sin(slope)]), np.array([math.sin(slope), math.cos(slope)])
    block(solver, (0, 0), angle=-slope)
    if shape == 'box':
        O.bodies.append(utils.box((*(-.1 * across), 0), (3, .1, .5), fixed=True, material='rough',
                                  orientation=Quaternion((0, 0, 1), -slope)))
    else:
        O.bodies.append(facet(tuple(-2 * along), tuple(2 * along), fixed=True, material='rough'))
    run(solver)
    steps(int(.05 / O.dt))
    solver.damping = 0
    start, begin = solver.velocities.mean(axis=0) @ along, solver.time
    place = solver.nodes.mean(axis=0) @ along
    steps(int(.1 / O.dt))
    gained = (solver.velocities.mean(axis=0) @ along - start) / (solver.time - begin)
    wanted = G * (math.sin(slope) - math.cos(slope) * math.tan(phi)) if above > 0 else 0
    assert gained == pytest.approx(wanted, abs=.02 * G * math.sin(slope))
    assert (solver.nodes.mean(axis=0) @ along - place > 1e-3) == (above > 0)
    assert abs(solver.nodes @ across).min() < 1e-5


def pushed(how):
    """A block that a wall or a box pushes along x: by its velocity, or by its place."""
    solver = fe()
    block(solver, (.001, 0))
    O.bodies.append(wall(0, axis=0) if how != 'box' else utils.box((-.1, .05, 0), (.1, .03, 1), fixed=True))
    run(solver)
    body = O.bodies[-1]
    if how != 'place':
        body.state.vel = (.5, 0, 0)
    for _ in range(int(.03 / O.dt)):
        if how == 'place':
            body.state.pos = (body.state.pos[0] + .5 * O.dt, 0, 0)
        O.step()
    return solver, body


@pytest.mark.parametrize('how', ['velocity', 'place', 'box'])
def test_surfaceThatMovesPushes(how):
    solver, body = pushed(how)
    front = body.state.pos[0] + (.1 if how == 'box' else 0)
    assert .014 < front < .016
    # Nothing is behind the surface, and energy comes from outside.
    assert solver.nodes[:, 0].min() > front - 1e-7
    assert solver.energy['external'] > 0 and solver.energy['kinetic'] > .1
    assert abs(solver.energy['total']) < 1e-3 * solver.energy['external']


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


def test_bodyWithoutMassIsReported():
    solver = fe()
    block(solver)
    O.bodies.append(facet((-.2, 0), (-.2, .1), fixed=False))
    number = O.bodies[-1].id
    run(solver)
    O.step()
    [warning] = solver.warnings
    assert warning.startswith('Facet #%d is not fixed but has no mass or no inertia' % number)
    # Its advice helps.
    O.reset()
    solver = fe()
    block(solver)
    O.bodies.append(facet((-.2, 0), (-.2, .1), fixed=False))
    O.bodies[-1].state.mass, O.bodies[-1].state.inertia = 1, (1, 1, 1)
    run(solver)
    steps(3)
    assert solver.warnings == [] and abs(O.bodies[number].state.pos[0]) < 1


def test_forcesThatAreTakenAwayAreRefused():
    solver = fe()
    block(solver)
    O.bodies.append(utils.box((-.2, 0, 0), (.1, .1, .5)))
    O.bodies[-1].state.blockedDOFs = 'zXY'
    run(solver)
    O.engines = [w.ForceResetter(), w.NewtonIntegrator(damping=0), solver]
    with pytest.raises(ValueError, match='deletes the forces of FESolver before NewtonIntegrator'):
        O.step()


@pytest.mark.parametrize('what', ['wall', 'two facets'])
def test_brittleBlockShattersOnIt(what):
    """No node is behind the surface by more than the 4e-4 of the shortest segment up to which contact
    takes a point for one before it, and the ledger adds up as on a body with fixed nodes."""
    solver = w.FESolver()
    O.materials.append(w.BrittleFEMat(young=1e9, poisson=.2, density=2000, frictionAngle=.3, tensileStrength=1e6,
                                      strengthScatter=.1, label='brittle'))
    solver.addPolygon([(0, .0005), (.05, .02), (.05, .1), (-.05, .1), (-.05, .03)], size=.01, material='brittle',
                      velocity=(0, -15))
    SURFACES[what]()
    run(solver, factor=.4)
    deepest = overlap = 0
    started = solver.energy['kinetic']
    for _ in range(120):
        steps(10)
        deepest = max(deepest, -solver.nodes[:, 1].min())
        overlap = max(overlap, solver.deepestOverlap())
    assert len(solver.fragments()) > 20
    assert deepest < 4e-4 * .005 and overlap < 4e-4 * .01
    assert abs(solver.energy['total'] - started) < 1e-3 * started


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
