"""FESolver in YADE: any collider, spheres, saving and loading, bodies that come and go."""
import builtins
import math
import os

import numpy as np
import pytest

import fe_chain as chain
import yadefrag
from yade import wrapper as w

O = builtins.O


def fe(**settings):
    """A solver and an elastic material 'm'."""
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.2, label='m'))
    return w.FESolver(**settings)


def run(solver, collider=None, spheres=False, newton=True, factor=.8):
    """The usual engines around `solver`, and a stable step."""
    engines = [w.ForceResetter()]
    if collider:
        engines.append(collider)
    if spheres:
        engines.append(w.InteractionLoop(
            [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Sphere_SurfaceSegment_ScGeom()],
            [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]))
    engines.append(solver)
    if newton:
        engines.append(w.NewtonIntegrator(damping=0))
    O.engines = engines
    O.dt = factor * solver.criticalTimeStep()


def finder(name, **attributes):
    return getattr(w, name)([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()], **attributes)


def steps(count):
    for _ in range(count):
        O.step()


def impact(name=None, smooth=False, **settings):
    """A disc that hits a block, ready to run."""
    solver = fe(**settings)
    solver.addPolygon(yadefrag.circle((0, 0), .1, 24), size=.02, material='m', velocity=(2, .3),
                      smooth=smooth, spin=3)
    solver.addPolygon(yadefrag.rectangle((.105, -.1), (.2, .1)), size=.02, material='m')
    run(solver, name and finder(name))
    return solver


def momentum(solver):
    """(linear (2,), angular) of the nodes, and of the spheres."""
    m, x, v = solver.masses, solver.nodes, solver.velocities
    linear = (m[:, None] * v).sum(0)
    angular = (m * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0])).sum()
    for b in O.bodies:
        if isinstance(b.shape, w.Sphere):
            s = b.state
            linear = linear + s.mass * np.array(s.vel)[:2]
            angular += s.mass * (s.pos[0] * s.vel[1] - s.pos[1] * s.vel[0])
            angular += s.inertia[2] * s.angVel[2]
    return linear, angular


# --- the same with any collider

@pytest.mark.parametrize('smooth', [False, True])
@pytest.mark.parametrize('passes', [1, 2])
def test_everyColliderGivesTheSameRun(smooth, passes):
    results = {}
    for name in (None, 'LebesgueCollider', 'LinearCodeCollider', 'HierarchyCollider',
                 'InsertionSortCollider'):
        O.reset()
        solver = impact(name, smooth, passes=passes)
        actives = []
        for _ in range(500):
            O.step()
            actives.append(solver.numActives)
        results[name] = solver.nodes, solver.velocities, actives
        assert solver.numSearches < 300
        if name:
            assert len(list(O.interactions)) == 0
    wanted = results.pop(None)
    assert max(wanted[2]) > 0
    for name, found in results.items():
        assert found[2] == wanted[2], name
        assert np.abs(found[0] - wanted[0]).max() < 1e-13, name
        assert np.abs(found[1] - wanted[1]).max() < 1e-9, name


def test_colliderBehindTheSolver():
    wanted = impact(None)
    steps(400)
    nodes = wanted.nodes
    O.reset()
    solver = impact('LebesgueCollider')
    O.engines = [O.engines[0], O.engines[2], O.engines[3], O.engines[1]]
    steps(400)
    assert np.abs(solver.nodes - nodes).max() < 1e-13
    assert O.engines[3].numAction > 1


def test_colliderWithoutTheFunctorLosesNothing():
    """Without bounds the solver searches by itself."""
    wanted = impact(None)
    steps(400)
    nodes = wanted.nodes
    O.reset()
    solver = fe()
    O.reset()
    solver = impact(None)
    O.engines = [O.engines[0], w.LebesgueCollider([w.Bo1_Sphere_Aabb()]), *O.engines[1:]]
    steps(400)
    assert np.abs(solver.nodes - nodes).max() < 1e-13


def test_twoThreadsGiveTheSameBits():
    runs = []
    for threads in (1, 2):
        O.reset()
        solver = impact('LebesgueCollider')
        solver.ompThreads = threads
        steps(300)
        runs.append((solver.nodes, solver.velocities))
    assert (runs[0][0] == runs[1][0]).all() and (runs[0][1] == runs[1][1]).all()


# --- values

def test_arraysAndLedger():
    solver = impact('LebesgueCollider')
    n, m = len(solver.nodes), len(solver.triangles)
    start = momentum(solver)
    energy = solver.energy['total']
    steps(500)
    assert solver.nodes.shape == solver.velocities.shape == (n, 2)
    assert solver.displacements.shape == solver.contactForces.shape == (n, 2)
    assert solver.triangles.shape == solver.stress.shape == (m, 3)
    assert solver.masses.shape == (n,) and solver.components.shape == (m,)
    assert set(solver.components) == {0, 1}
    assert solver.triangles.max() == n - 1
    nodes = solver.nodes
    nodes[:] = 0
    assert solver.nodes.any()
    corners = solver.nodes[solver.triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0).all()
    assert [len(loop) for loop in solver.surfaces][0] > 20 and len(solver.surfaces) == 2
    values = solver.energy
    assert set(values) == {'kinetic', 'strain', 'contact', 'friction', 'fracture', 'damping',
                           'external', 'total'}
    assert abs(values['total'] / energy - 1) < 1e-4
    linear, angular = momentum(solver)
    scale = np.linalg.norm(start[0])
    assert np.abs(linear - start[0]).max() < 1e-12 * scale
    assert abs(angular - start[1]) < 1e-5 * scale * .2


def test_fragmentsAreTheBodies():
    solver = impact()
    parts = solver.fragments()
    assert [p['component'] for p in parts] == [0, 1]
    assert parts[0]['velocity'] == pytest.approx((2, .3))
    assert parts[0]['spin'] == pytest.approx(3)
    assert parts[1]['area'] == pytest.approx(.095 * .2)
    assert parts[1]['centroid'] == pytest.approx((.1525, 0))
    assert sum(p['mass'] for p in parts) == pytest.approx(solver.masses.sum())


def test_energyIsTracked():
    solver = impact('LebesgueCollider')
    O.trackEnergy = True
    O.step()
    first = O.energy.total()
    steps(400)
    items = dict(O.energy.items())
    assert items['feKinetic'] == pytest.approx(solver.energy['kinetic'])
    assert items['feStrain'] > 0
    assert O.energy.total() == pytest.approx(first, rel=1e-4)


def test_pieceBodiesFollow():
    """Shapes lie on the nodes, states move as the pieces do, whoever moves the bodies."""
    for newton in (True, False):
        O.reset()
        solver = fe()
        solver.addPolygon(yadefrag.rectangle((0, 0), (.1, .1)), size=.05, material='m',
                          velocity=(1, 2), spin=5, smooth=[True, False, False, True])
        run(solver, finder('LebesgueCollider'), newton=newton)
        steps(50)
        loop = solver.nodes[solver.surfaces[0]]
        kinds = {}
        for b in O.bodies:
            shape = b.shape
            kinds[shape.kind] = kinds.get(shape.kind, 0) + 1
            follower = O.bodies[(b.id + 1) % len(O.bodies)].shape
            assert tuple(shape.end) == tuple(follower.start)
            assert b.state.blockedDOFs == 'xyzXYZ'
            if shape.kind == 0:
                middle = (np.array(shape.start) + np.array(shape.end)) / 2
                assert np.abs(np.array(b.state.pos) - middle).max() < 1e-14
                at = np.abs(loop - np.array(shape.start)[:2]).sum(1).argmin()
                assert (loop[at] == np.array(shape.start)[:2]).all()
            assert b.state.angVel[2] == pytest.approx(5, rel=.2)
        assert kinds == {0: 5, 1: 1, 2: 1, 3: 3} or kinds[3] > 0


# --- spheres

@pytest.mark.parametrize('smooth', [False, True])
@pytest.mark.parametrize('friction', [0, .5])
def test_sphereOnABodyKeepsMomentum(smooth, friction):
    solver = fe()
    O.materials['m'].frictionAngle = friction
    solver.addPolygon(yadefrag.rectangle((-.1, -.1), (.1, 0)), size=.02, material='m',
                      smooth=smooth)
    ball = chain.ball((.033, .052), .05, O.materials['m'])
    ball.state.vel = (.5, -1, 0)
    ball.state.angVel = (0, 0, 20)
    ball.state.blockedDOFs = 'zXY'
    O.bodies.append(ball)
    run(solver, finder('LebesgueCollider'), spheres=True, factor=.3)
    linear, angular = momentum(solver)
    energy = solver.energy['total'] + .5 * ball.state.mass * ball.state.vel.squaredNorm()
    touched = 0
    for _ in range(4000):
        O.step()
        touched += len(list(O.interactions)) > 0
        if touched and not len(list(O.interactions)):
            break
    assert touched > 20 and ball.state.vel[1] > 0
    after, afterAngular = momentum(solver)
    scale = ball.state.mass
    assert np.abs(after - linear).max() < 1e-12 * scale
    assert abs(afterAngular - angular) < 1e-9 * scale * .1
    assert not solver.numActives
    if not friction:
        ledger = solver.energy
        work = .5 * ball.state.mass * ball.state.vel.squaredNorm()
        assert ledger['kinetic'] + ledger['strain'] + work == pytest.approx(energy, rel=.01)
    assert ledgerHolds(solver)


def ledgerHolds(solver):
    e = solver.energy
    return e['total'] == pytest.approx(e['kinetic'] + e['strain'] - e['external'], abs=1e-12) \
        and e['external'] > 0


def test_forceOnAPieceGoesToItsNodes():
    """Force and torque on an entry's body: sum and moment of the nodes' forces are the same."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (.1, .1)), size=.05, material='m',
                      smooth=[True, False, False, True])
    run(solver, newton=False)
    for b in O.bodies:
        O.forces.setPermF(b.id, (3, -2, 0))
        O.forces.setPermT(b.id, (0, 0, .25))
    arms = [b.state.pos for b in O.bodies]
    n = len(arms)
    O.step()
    linear, angular = momentum(solver)
    assert linear == pytest.approx(np.array([3, -2]) * n * O.dt)
    # the momentum is that about the origin with the positions where the forces acted
    x = solver.nodes - O.dt * solver.velocities
    v, m = solver.velocities, solver.masses
    angular = (m * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0])).sum()
    wanted = sum(p[0] * -2 - p[1] * 3 + .25 for p in arms) * O.dt
    assert angular == pytest.approx(wanted)


# --- saving and loading

@pytest.mark.parametrize('ending', ['.xml', '.yade.gz', '.yade'])
@pytest.mark.parametrize('finderName', ['LebesgueCollider', 'InsertionSortCollider', None])
def test_savedRunGoesOnBitForBit(ending, finderName, folder):
    def build():
        solver = impact(finderName, smooth=True)
        ball = chain.ball((.15, .151), .05, O.materials['m'])
        ball.state.vel = (0, -1, 0)
        ball.state.blockedDOFs = 'zXY'
        O.bodies.append(ball)
        run(solver, finderName and finder(finderName), spheres=bool(finderName), factor=.5)
        return solver

    solver = build()
    steps(150)
    path = os.path.join(folder, 'scene' + ending)
    O.save(path)
    saved = solver.nodes, solver.velocities, solver.energy, solver.numSearches
    steps(350)
    wanted = solver.nodes, solver.velocities, solver.energy, O.bodies[-1].state.pos
    assert solver.numActives or solver.energy['contact'] != 0
    O.reset()
    O.load(path)
    solver = [e for e in O.engines if isinstance(e, w.FESolver)][0]
    loaded = solver.nodes, solver.velocities, solver.energy, solver.numSearches
    assert all(np.array_equal(a, b) for a, b in zip(saved[:2], loaded[:2]))
    assert saved[2:] == loaded[2:]
    steps(350)
    assert np.array_equal(solver.nodes, wanted[0]) and np.array_equal(solver.velocities, wanted[1])
    assert solver.energy == wanted[2]
    assert tuple(O.bodies[-1].state.pos) == tuple(wanted[3])
    solver.removeBody(0)
    O.step()


def test_memorySaveAndReload():
    solver = impact('LebesgueCollider')
    steps(50)
    O.saveTmp()
    steps(50)
    nodes = solver.nodes
    O.reload()
    steps(50)
    assert np.array_equal(O.engines[2].nodes, nodes)


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
        with pytest.raises((ValueError, RuntimeError), match='not in the scene'):
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
    with pytest.raises(RuntimeError, match='not in the scene'):
        O.step()


def test_eraseIsRefused():
    solver = impact('LebesgueCollider')
    count = len(O.bodies)
    with pytest.raises(ValueError, match='part of the boundary of body 0 of FESolver'):
        O.bodies.erase(3)
    assert len(O.bodies) == count and O.bodies[3]
    ball = O.bodies.append(chain.ball((5, 5), .1, O.materials['m']))
    assert O.bodies.erase(ball) and not O.bodies.erase(ball)
    steps(3)
    O.bodies.clear()
    with pytest.raises(RuntimeError, match='Body #0 is not in the scene any more'):
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


def test_bodiesJoinARun():
    solver = impact('LebesgueCollider')
    steps(100)
    number = solver.addPolygon(yadefrag.rectangle((.21, -.1), (.3, .1)), size=.02, material='m',
                               velocity=(-3, 0))
    assert number == 2
    steps(300)
    assert solver.fragments()[2]['velocity'][0] > -2.9


# --- input

def test_timeStepAboveTheCriticalOne():
    solver = impact('LebesgueCollider')
    critical = solver.criticalTimeStep()
    O.dt = 1.01 * critical
    before = solver.nodes
    with pytest.raises((ValueError, RuntimeError)) as error:
        O.step()
    assert '%.6g' % O.dt in str(error.value) and '%.6g' % critical in str(error.value)
    assert np.array_equal(solver.nodes, before)
    O.dt = .9 * critical
    steps(3)


kSquare = [(0, 0), (1, 0), (1, 1), (0, 1)]


@pytest.mark.parametrize('wrong, sentence', [
    (dict(outline=[(0, 0), (1, 0)]), 'outline has 2 points'),
    (dict(outline=[(0, 0), (1, 1), (1, 0), (0, 1)]), '.'),
    (dict(outline=[(0, 0), (1, math.nan), (1, 1)]), 'outline has a point 1'),
    (dict(holes=[[(0, 0), (1,)]]), r'holes\[0\] must be a list of points'),
    (dict(size=0), 'size is 0, it must be a positive number'),
    (dict(size='big'), "size is 'big'"),
    (dict(material='none'), "material is 'none', which is not in O.materials"),
    (dict(material=0.5), 'material is 0.5'),
    (dict(smooth=[True]), 'smooth has 1 flags, it must have one for each of the 4 points'),
    (dict(smooth=3), 'smooth is 3'),
    (dict(velocity=1), 'velocity is 1, it must be a pair'),
    (dict(velocity=lambda x, y: (x, math.inf)), r'velocity\(.*both numbers must be finite'),
    (dict(spin='fast'), "spin is 'fast'"),
    (dict(displacement=lambda x, y: x), r'displacement\('),
    (dict(fixed=True), 'fixed is True, it must be a function'),
    (dict(fixed=lambda x, y: 'z'), r"fixed\(.*is 'z', it must be False, True, 'x' or 'y'"),
    (dict(thickness=-1), 'thickness is -1'),
    (dict(selfContact=1), 'selfContact is 1, it must be True or False'),
])
def test_badInputIsRefused(wrong, sentence):
    solver = fe()
    args = dict(outline=kSquare, size=.5, material='m')
    args.update(wrong)
    with pytest.raises(ValueError, match=sentence) as error:
        solver.addPolygon(**args)
    assert str(error.value).count('. ') == 0
    assert len(O.bodies) == 0 and len(solver.nodes) == 0


@pytest.mark.parametrize('wrong', [dict(young=0), dict(poisson=.5), dict(density=-1),
                                   dict(frictionAngle=2)])
def test_badMaterialIsRefused(wrong):
    solver = w.FESolver()
    with pytest.raises(ValueError, match="the material's %s is" % list(wrong)[0]):
        solver.addPolygon(kSquare, size=.5, material=w.FEMat(**wrong))


def test_otherMaterialsAreRefused():
    with pytest.raises(ValueError, match='must be an FEMat'):
        w.FESolver().addPolygon(kSquare, size=.5, material=w.FrictMat())


@pytest.mark.parametrize('name, value', [('correction', 'lagrangian'), ('passes', 3),
                                         ('damping', -1), ('penaltyFactor', 0),
                                         ('halo', -.1), ('halo', .6), ('halo', math.nan),
                                         ('gravity', (math.nan, 0, 0)),
                                         ('linearViscosity', -1), ('quadraticViscosity', -1)])
def test_badSettingsAreRefused(name, value):
    with pytest.raises(ValueError, match='FESolver.' + name):
        w.FESolver(**{name: value})
    solver = w.FESolver()
    before = getattr(solver, name)
    with pytest.raises(ValueError, match='FESolver.' + name):
        setattr(solver, name, value)
    assert getattr(solver, name) == before


def test_periodicSceneIsRefused():
    solver = fe()
    O.periodic = True
    with pytest.raises(ValueError, match='periodic'):
        solver.addPolygon(kSquare, size=.5, material='m')
    assert len(O.bodies) == 0


def test_secondSolverIsRefused():
    solver = impact('LebesgueCollider')
    with pytest.raises(ValueError, match='another FESolver'):
        w.FESolver().addPolygon(kSquare, size=.5, material='m')
    solver.removeBody(0)
    solver.removeBody(1)
    assert w.FESolver().addPolygon(kSquare, size=.5, material='m') == 0


def test_functionsOfPlace():
    solver = fe()
    solver.addPolygon(kSquare, size=.25, material='m', velocity=lambda x, y: (y, 0),
                      displacement=lambda x, y: (.01 * x, 0),
                      fixed=lambda x, y: 'x' if y < 1e-9 else x > 1 - 1e-9 and y > .5)
    moved = solver.displacements
    rest = solver.nodes - moved
    assert moved == pytest.approx(np.stack([.01 * rest[:, 0], 0 * rest[:, 0]], axis=1))
    assert solver.velocities[:, 0] == pytest.approx(rest[:, 1])
    run(solver)
    speed = solver.velocities
    steps(30)
    held = (rest[:, 0] > 1 - 1e-9) & (rest[:, 1] > .5)
    assert np.array_equal(solver.velocities[held], speed[held])
    bottom = rest[:, 1] < 1e-9
    assert np.array_equal(solver.velocities[bottom, 0], speed[bottom, 0])
    assert (solver.velocities[bottom, 1] != 0).any()


def test_addTriangles():
    solver = fe()
    nodes, triangles = yadefrag.rectangleMesh((0, 0), (2, 1), 8, 4)
    assert solver.addTriangles(nodes, triangles, material='m') == 0
    assert np.array_equal(solver.nodes, nodes) and np.array_equal(solver.triangles, triangles)
    assert len(O.bodies) == 24
    for wrong, sentence in ((triangles[:, ::-1], '.'), (triangles[:5], 'belongs to no triangle'),
                            (triangles + 40, 'node numbers from'), (triangles * .5, 'an array')):
        with pytest.raises(ValueError, match=sentence):
            solver.addTriangles(nodes, wrong, material='m')
    crossing = np.array([(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)])
    with pytest.raises(ValueError, match='passes twice through node 0'):
        solver.addTriangles(crossing, [(0, 1, 2), (0, 3, 4)], material='m')


def test_clockwiseOutlineKeepsItsFlags():
    kinds = []
    for order in (1, -1):
        O.reset()
        solver = fe()
        flags = [True, False, False, True][::order]
        solver.addPolygon(kSquare[::order], size=.5, material='m', smooth=flags)
        arcs = {
                (round(b.shape.middle[0], 6), round(b.shape.middle[1], 6))
                for b in O.bodies if b.shape.kind == 3}
        kinds.append(arcs)
    assert kinds[0] == kinds[1] == {(0, 0), (0, .5), (0, 1)}


def rain(name, smooth):
    """Heights of spheres that fall onto a clamped beam; the same engines whatever the collider."""
    O.reset()
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((-.2, -.05), (.2, 0)), size=.02, material='m',
                      smooth=smooth, fixed=lambda x, y: abs(x) > .199)
    rng = np.random.default_rng(1)
    for i in range(8):
        for j in range(2):
            ball = chain.ball((-.17 + .047 * i, .021 + .045 * j + .002 * rng.uniform()), .02,
                              O.materials['m'])
            ball.state.vel = (.2 * rng.normal(), -1, 0)
            ball.state.blockedDOFs = 'zXY'
            O.bodies.append(ball)
    run(solver, finder(name), spheres=True, factor=.3)
    contacts = 0
    for _ in range(1500):
        O.step()
        contacts = max(contacts, len(list(O.interactions)))
    assert contacts > 4 and solver.energy['external'] > 0
    return np.array([b.state.pos[1] for b in O.bodies if isinstance(b.shape, w.Sphere)]), \
        solver.nodes


@pytest.mark.parametrize('smooth', [False, True])
def test_spheresRainOnABeam(smooth):
    wanted = rain('InsertionSortCollider', smooth)
    assert wanted[0].min() > .01
    for name in ('LebesgueCollider', 'LinearCodeCollider', 'HierarchyCollider'):
        found = rain(name, smooth)
        assert np.abs(found[0] - wanted[0]).max() < 1e-9, name
        assert np.abs(found[1] - wanted[1]).max() < 1e-9, name
