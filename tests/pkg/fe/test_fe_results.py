"""Reactions, forces of contact, strains, principal stresses and cracks, against what they must be."""
import builtins
import csv
import math

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, impact, run, steps
from yade import utils
from yade import wrapper as w

O = builtins.O
WEIGHT = 1000 * 9.81  # of a block of 1 m


def blockOnFloor():
    solver = fe(gravity=(0, -9.81))
    solver.addPolygon(yadefrag.rectangle((-1, -1), (2, 0)), size=.5, material='m', name='floor',
                      fixed=lambda x, y: True)
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.3, material='m', name='block')
    run(solver)
    solver.relax(1e-9)
    return solver


def test_weightOnTheFloor():
    solver = blockOnFloor()
    assert solver.contactForce('block', 'floor') == pytest.approx((0, WEIGHT), rel=1e-4, abs=1e-4 * WEIGHT)
    assert solver.contactForce('floor', 1) == pytest.approx((0, -WEIGHT), rel=1e-4, abs=1e-4 * WEIGHT)
    assert solver.contactForce('block') == pytest.approx(solver.contactForce('block', 'floor'), abs=1e-6)
    assert solver.contactForce(1, 1) == (0, 0)
    # The floor bears itself, too: 3 m³.
    assert solver.reaction('floor') == pytest.approx((0, 4 * WEIGHT), rel=1e-4, abs=1e-4 * WEIGHT)
    assert solver.reaction(0) == solver.reaction(solver.nodesOf('floor')) == solver.reaction(
        lambda x, y: y <= 1e-3)


@pytest.mark.parametrize('element, part, off', [('smoothed', 1.005, .015), ('linear', .89, .02)])
def test_reactionIsTheAppliedLoad(element, part, off):
    """A cantilever, four triangles high, under a load at its tip: force and moment at the clamp, and its deflection, over
    Timoshenko's."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (8, 1)), size=.25, material='m', element=element,
                      fixed=lambda x, y: x < 1e-9)
    run(solver)
    places, tip = solver.nodes, solver.nodes[:, 0] > 8 - 1e-9
    loads = solver.loads
    loads[tip, 1] = -1 / tip.sum()
    solver.loads = loads
    solver.relax(1e-9)
    assert solver.reaction(lambda x, y: x < 1e-3) == pytest.approx((0, 1), abs=1e-4)
    force, arm = solver.reactions, solver.nodes
    # Load and weight of the arm: 8 m, but for the deflection.
    assert (arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]).sum() == pytest.approx(8, rel=1e-3)
    theory = 8**3 * 4 * (1 - .3**2) / 1e7 + 1.2 * 8 * 2 * 1.3 / 1e7
    assert (places - arm)[tip, 1].mean() / theory == pytest.approx(part, abs=off)


def test_forcesOfContactAreOppositeAndAddUp():
    solver = impact()
    seen = 0
    for _ in range(120):
        O.step()
        one, other = np.array(solver.contactForce(0, 1)), np.array(solver.contactForce(1, 0))
        assert one == pytest.approx(-other)
        assert one == pytest.approx(np.array(solver.contactForce(0)), abs=1e-9 * (1 + abs(one).max()))
        seen += one.any()
    assert seen > 10


def test_strainsAndPrincipalStressesOfAStretch():
    solver = fe()
    angle, stretch = .3, .01
    axis = np.array([math.cos(angle), math.sin(angle)])
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m',
                      displacement=lambda x, y: tuple(stretch * (axis @ (x, y)) * axis))
    outer = np.outer(axis, axis)
    wanted = (stretch + stretch**2 / 2) * outer
    assert solver.strain == pytest.approx(np.tile([wanted[0, 0], wanted[1, 1], wanted[0, 1]],
                                                  (len(solver.strain), 1)), abs=1e-12)
    large, small, at = solver.principalStress.T
    assert at == pytest.approx(angle, abs=1e-9)
    # Plane strain, but for the change of the section: terms of the stretch's square.
    lame, shear = 1e7 * .3 / (1.3 * .4), 1e7 / 2.6
    assert large == pytest.approx((lame + 2 * shear) * stretch, rel=2 * stretch)
    assert small == pytest.approx(lame * stretch, rel=2 * stretch)
    xx, yy, xy = solver.stress.T
    assert large + small == pytest.approx(xx + yy) and large * small == pytest.approx(xx * yy - xy**2)


def strip(energy):
    """A strip that is pulled apart at a joint, x = .5, across its whole height."""
    O.materials.append(w.BrittleFEMat(young=1e7, poisson=0, density=1000, tensileStrength=1e9, label='b'))
    solver = w.FESolver()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, .2)), size=.1, material='b', name='strip',
                      joints=[((.5, 0), (.5, .2))], jointStrength=1e4, jointEnergy=energy)
    run(solver, factor=.2)
    solver.prescribe(lambda x, y: x < 1e-9, vx=-.5, vy=0)
    solver.prescribe(lambda x, y: x > 1 - 1e-9, vx=.5, vy=0)
    return solver


def test_cracksAreATable(folder):
    energy = 20.
    solver = strip(energy)
    assert len(yadefrag.crackTable(solver)) == 0
    while not solver.numCracks:
        O.step()
    started = solver.time
    critical = 2 * energy / 1e4
    seen = set()
    while len(seen) < 2 and solver.time < 1:
        steps(5)
        table = yadefrag.crackTable(solver)
        assert len(table) == solver.numCracks == 2
        assert table['x'] == pytest.approx(.5, abs=1e-2)
        assert sorted(table['y']) == pytest.approx([.05, .15], abs=1e-2)
        assert abs(table['nx']) == pytest.approx(1, abs=1e-3)
        assert (table['component'] == 0).all() and (table['other'] == 0).all()
        assert (table['start'] <= started + O.dt).all() and (table['start'] > 0).all()
        for row in table:
            seen.add(bool(row['held']))
            assert row['opening'] > 0 and abs(row['slip']) < row['opening']
            if row['held']:
                # Opened without a way back: spent is σδ/2 of Gc = σδc/2.
                assert row['damage'] == pytest.approx(row['opening'] / critical, rel=.05)
            else:
                assert row['damage'] == 1 and row['opening'] >= .95 * critical
    assert seen == {True, False}
    file = folder + '/cracks.csv'
    table = yadefrag.crackTable(solver, file)
    with open(file) as lines:
        rows = list(csv.DictReader(lines))
    assert [float(row['opening (m)']) for row in rows] == table['opening'].tolist()
    with pytest.raises(ValueError, match='must end with'):
        yadefrag.crackTable(solver, folder + '/cracks.txt')


def crackLines(solver):
    from matplotlib.collections import LineCollection
    return [c for c in yadefrag.plotMesh(solver).collections if isinstance(c, LineCollection)]


@pytest.mark.parametrize('wall', [False, True])
def test_heldCracksAreDrawnAndExported(folder, wall):
    """A wall has nodes of its own between those of the body and those that cracks add."""
    solver = strip(20.)
    if wall:
        O.bodies.append(utils.wall(-3, axis=1))
    while not solver.numCracks:
        O.step()
    steps(5)
    table = yadefrag.crackTable(solver)
    assert table['held'].all() and len(table) == 2
    [line] = crackLines(solver)
    assert line.get_label() == 'held' and np.array_equal(line.get_array(), table['damage'])
    drawn = np.array([path.vertices for path in line.get_paths()])
    middles = drawn.mean(axis=1)
    assert middles == pytest.approx(np.stack([table['x'], table['y']], axis=1), abs=1e-12)
    assert np.hypot(*(drawn[:, 1] - drawn[:, 0]).T) == pytest.approx([.1, .1], rel=.05)
    meshio = pytest.importorskip('meshio')
    yadefrag.exportVTK(solver, folder + '/out.vtu')
    mesh = meshio.read(folder + '/out.vtu')
    places = mesh.points[mesh.cells_dict['line']][:, :, :2]
    # The first side of a crack is beside its middle by half the opening.
    assert places.mean(axis=1)[:, 1] == pytest.approx(table['y'], abs=1e-4)
    assert mesh.cell_data['damage'][1] == pytest.approx(table['damage'], abs=1e-12)
    assert not mesh.cell_data['damage'][0].any() and len(mesh.cell_data['stress'][1]) == 2
    while yadefrag.crackTable(solver)['held'].any():
        steps(20)
    yadefrag.exportVTK(solver, folder + '/out.vtu')
    assert list(meshio.read(folder + '/out.vtu').cells_dict) == ['triangle']
    # Open ones are black, both faces, above those that hold.
    [open_] = crackLines(solver)
    assert open_.get_label() == 'open' and (open_.get_colors() == (0, 0, 0, 1)).all()
    assert open_.get_zorder() > line.get_zorder() and len(open_.get_paths()) == 4


def test_principalStressesAndEnlargedDisplacementsAreDrawn():
    """Their sum and product are trace and determinant of the stress; positions are multiples of the
    displacements."""
    solver = strip(20.)
    steps(3)
    stress = solver.principalStress
    for name, other, values in (('sigma1', 'principal1', stress[:, 0]), ('sigma2', 'principal2', stress[:, 1])):
        for field in (name, other):
            drawn = next(c for c in yadefrag.plotMesh(solver, field).collections if c.get_array() is not None)
            assert np.array_equal(drawn.get_array(), values)
    xx, yy, xy = solver.stress.T
    assert np.allclose(stress[:, 0] + stress[:, 1], xx + yy) and (stress[:, 0] >= stress[:, 1]).all()
    assert np.allclose(stress[:, 0] * stress[:, 1], xx * yy - xy**2)
    rest, moved = solver.nodes - solver.displacements, solver.displacements
    for scale in (0, 1, 3):
        [mesh] = [c for c in yadefrag.plotMesh(solver, 'xx', scale=scale).collections if c.get_array() is not None]
        corners = np.array([path.vertices[:3] for path in mesh.get_paths()])
        assert np.allclose(corners, (rest + scale * moved)[solver.triangles], atol=1e-12)
    length = yadefrag.plotMesh(solver, 'displacement').collections[0].get_array()
    assert np.allclose(length, np.hypot(*moved.T))
    with pytest.raises(ValueError, match='scale is -1'):
        yadefrag.plotMesh(solver, scale=-1)


def test_openJointsHaveNoStart():
    O.materials.append(w.BrittleFEMat(young=1e7, density=1000, tensileStrength=1e9, label='b'))
    solver = w.FESolver()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='b', joints=[((0, .5), (1, .5))])
    table = yadefrag.crackTable(solver)
    assert len(table) > 0 == solver.numCracks and np.isnan(table['start']).all()
    assert (table['damage'] == 1).all() and not table['held'].any() and table['y'] == pytest.approx(.5)
