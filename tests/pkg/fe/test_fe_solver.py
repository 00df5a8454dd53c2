"""FESolver in YADE: its values; what addPolygon takes; loads, prescribed motion, and long runs. The same run with
any collider: test_same_bits.py."""
import math

import numpy as np
import pytest
import yadefrag
from yade import O
from yade.wrapper import *
from yadefrag import *
from fe_scene import fe, finder, impact, momentum, run, steps


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
    assert set(values) == {'kinetic', 'strain', 'contact', 'friction', 'fracture', 'damping', 'outside', 'total'}
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


def test_pieceBodiesFollow():
    """Shapes lie on the nodes, states move as the pieces do, with any integrator."""
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


# --- bodies

kSquare = [(0, 0), (1, 0), (1, 1), (0, 1)]


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
        kinds.append({tuple(np.round(b.shape.middle, 6)[:2]) for b in O.bodies if b.shape.kind == 3})
    assert kinds[0] == kinds[1] == {(0, 0), (0, .5), (0, 1)}


def clampedBlock(top):
    """A block of 1 m held at its bottom, at rest under `top` (a function of the solver)."""
    solver = fe(FEMat(young=1e7, poisson=0, density=1000, frictionAngle=0, label='m'), damping=60)
    solver.addPolygon(rectangle((0, 0), (1, 1)), size=.1, material='m')
    run(solver, LebesgueCollider([Bo1_SurfaceSegment_Aabb()]), spheres=True, newton=False)
    solver.prescribe(lambda x, y: y < 1e-9, vy=0)
    top(solver)
    return solver


def isTop(fe):
    return fe.nodes[:, 1] > 1 - 1e-9


def test_loadsStretchABlock():
    def pull(fe):
        loads = fe.loads
        top = isTop(fe)
        # Uniform traction: half as much at the two corners.
        share = np.where(np.isclose(fe.nodes[top][:, 0] % 1, 0), .5, 1)
        loads[top, 1] = 1e4 * share / share.sum()
        fe.loads = loads

    fe = clampedBlock(pull)
    runSteps(6000)
    # ν = 0: σ = 10⁴ Pa everywhere, but for the change of area (none) and of length (10⁻³ of it).
    assert np.allclose(fe.stress[:, 1], 1e4, rtol=2e-3)
    assert np.allclose(fe.displacements[isTop(fe)][:, 1], 1e-3, rtol=2e-3)
    energy = fe.energy
    assert abs(energy['total']) < 1e-4 * energy['external']
    fe.loads = None
    assert not fe.loads.any()


def test_prescribedMotionDoesItsWork():
    fe = clampedBlock(lambda fe: fe.prescribe(isTop(fe), vx=0, vy=.1))
    before = fe.nodes[isTop(fe)][0, 1]
    steps = int(.02 / O.dt)
    runSteps(steps)
    moving = np.argmax(fe.nodes[:, 1])
    assert fe.nodes[moving, 1] == pytest.approx(before + .1 * steps * O.dt, rel=1e-12)
    energy = fe.energy
    assert energy['external'] > 0
    assert abs(energy['total']) < 1e-4 * energy['external']
    fe.prescribe([int(moving)])
    speed = fe.velocities[moving, 1]
    runSteps(5)
    assert fe.velocities[moving, 1] != speed


def test_runCallsInBetween():
    clampedBlock(lambda fe: None)
    called = []
    assert runSteps(25, every=10, call=lambda: called.append(O.iter)) == 25
    assert called == [10, 20] and O.iter == 25


def test_minimalAngle():
    O.materials.append(FEMat(young=1e7, density=1000, label='m'))
    fe = FESolver()
    assert fe.minAngle == np.inf
    fe.addTriangles([(0, 0), (1, 0), (1, 1)], [(0, 1, 2)], material='m')
    assert fe.minAngle == pytest.approx(np.pi / 4)
    fe.addPolygon(rectangle((2, 0), (3, 1)), size=.1, material='m')
    assert np.pi / 6 < fe.minAngle <= np.pi / 4 + 1e-12


def drift(factor):
    """(of the work) What the books lose in one turn of a drum with stones of rubber."""
    O.reset()
    O.materials.append(FEMat(young=3e5, poisson=.3, density=1000, frictionAngle=.5, label='rubber'))
    solver = FESolver(gravity=(0, -9.81))
    solver.addPolygon(*ring((0, 0), .1, .11, 48), size=.02, material='rubber', name='drum')
    for k in range(8):
        x, y = .036 * (k % 4 - 1.5), .03 * (k // 4) - .045
        solver.addPolygon(rectangle((x - .013, y - .013), (x + .013, y + .013)), size=.01, material='rubber')
    solver.rotate('drum', 6., (0, 0))
    run(solver, factor=factor)
    started = solver.energy['total']
    steps(int(2 * math.pi / 6 / O.dt))
    return (solver.energy['total'] - started) / solver.energy['external']


def test_energyOfADrumDecreasesBySecondOrderInTheStep():
    """A quarter of the step, a sixteenth of the loss; stones take other ways, so that a sixth is required, or what
    the forces' tolerance leaves: 1e-4."""
    coarse, fine = abs(drift(.8)), abs(drift(.2))
    assert coarse < 2e-3 and fine < max(coarse / 6, 1e-4)
