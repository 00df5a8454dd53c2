"""FESolver in YADE: its values; what addPolygon takes. The same run with any collider: test_same_bits.py."""
import builtins

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, finder, impact, momentum, run, steps

O = builtins.O


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
                           'outside', 'total'}
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
        arcs = {
                (round(b.shape.middle[0], 6), round(b.shape.middle[1], 6))
                for b in O.bodies if b.shape.kind == 3}
        kinds.append(arcs)
    assert kinds[0] == kinds[1] == {(0, 0), (0, .5), (0, 1)}
