"""Several materials in a body, and what is between them, from Python."""
import builtins
import os

import numpy as np
import pytest

import yadefrag
from fe_impact import cracks, engines
from fe_scene import solverOfScene
from yade import wrapper as w

O = builtins.O
kLength, kHeight, kRate = .1, .02, 20.
kLine = [((kLength / 2, -1), (kLength / 2, 1))]


def hard(**given):
    return w.BrittleFEMat(**{**dict(young=2e9, poisson=0, density=1000, planeStress=True, tensileStrength=20e6,
                                    fractureEnergy=2000, label='hard'), **given})


def soft(**given):
    return w.BrittleFEMat(**{**dict(young=1e9, poisson=0, density=2000, planeStress=True, tensileStrength=10e6,
                                    fractureEnergy=1000, label='soft'), **given})


def halves(x, y):
    return 'hard' if x < kLength / 2 else 'soft'


def drawnBar(first=hard, second=soft, material=halves, factor=.4, **given):
    O.materials.append(first())
    O.materials.append(second())
    solver = w.FESolver()
    args = dict(size=.002, velocity=lambda x, y: (kRate * (x - kLength / 2), 0), joints=kLine, jointStrength=None,
                fixed=lambda x, y: 'x' if x < 1e-9 or x > kLength - 1e-9 else False)
    solver.addPolygon(yadefrag.rectangle((0, 0), (kLength, kHeight)), material=material, **{**args, **given})
    engines(solver, factor=factor)
    return solver


def test_halvesHaveTheirOwnMassesStressesAndSteps():
    solver = drawnBar()
    numbers = solver.materialNumbers
    middles = solver.nodes[solver.triangles].mean(axis=1)
    isHard = middles[:, 0] < kLength / 2
    assert set(numbers[isHard]) | set(numbers[~isHard]) == {0, 1}
    assert len(set(numbers[isHard])) == len(set(numbers[~isHard])) == 1
    # The line is in the mesh: each half has its own mass exactly.
    assert solver.masses.sum() == pytest.approx(kLength / 2 * kHeight * 3000, rel=1e-12)
    O.run(20, True)
    strain = kRate * O.time
    stress = solver.stress[:, 0]
    far = np.abs(middles[:, 0] - kLength / 2) > .01
    assert stress[far & isHard] == pytest.approx(2e9 * strain, rel=1e-2)
    assert stress[far & ~isHard] == pytest.approx(1e9 * strain, rel=1e-2)
    # The stiffer and lighter half determines the step.
    step = solver.criticalTimeStep()
    O.reset()
    alone = drawnBar(material='hard')
    assert step / alone.criticalTimeStep() == pytest.approx(1, rel=.05)


@pytest.mark.parametrize('weak', [2e6, {('soft', 'hard'): 2e6}, lambda x, y: 2e6])
def test_aWeakInterfaceCracks(weak):
    solver = drawnBar(interfaceStrength=weak, interfaceEnergy=100)
    while solver.numCracks == 0 and O.time < 2e-3:
        O.step()
    # In series the stress at the interface is the same; what is drawn at a constant rate bears
    # between both moduli times the strain before waves have evened it out.
    assert 2e6 / 2e9 < kRate * O.time < 1.1 * 2e6 / 1e9
    while len(solver.fragments(held=True)) < 2 and O.time < 2e-3:
        O.run(50, True)
    assert len(solver.fragments()) == 2
    assert np.abs(cracks(solver)[:, 0] - kLength / 2).max() < 1e-9
    assert solver.energy['fracture'] == pytest.approx(100 * kHeight, rel=.02)


def test_materialsThatDoNotCrackByThemselvesCrackBetween():
    plain = dict(poisson=0, density=1000, planeStress=True)
    solver = drawnBar(lambda: w.FEMat(young=2e9, label='hard', **plain),
                      lambda: w.FEMat(young=1e9, label='soft', **plain), interfaceStrength=2e6, interfaceEnergy=100)
    O.run(3000, True)
    assert len(solver.fragments()) == 2
    assert solver.energy['fracture'] == pytest.approx(100 * kHeight, rel=.02)


def test_listsArraysAndFunctionsAreTheSame(folder):
    nodes, triangles = yadefrag.rectangleMesh((0, 0), (kLength, kHeight), 20, 4)
    middles = nodes[triangles].mean(axis=1)
    first, second = hard(), soft()
    O.materials.append(first)
    O.materials.append(second)
    isHard = [x < kLength / 2 for x, _ in middles]
    forms = [halves, [first if one else second for one in isHard], ['hard' if one else 'soft' for one in isHard],
             np.array([0 if one else 1 for one in isHard]), ([second, 'hard'], [1 if one else 0 for one in isHard])]

    def result(form, reload):
        O.reset()
        O.materials.append(hard())
        O.materials.append(soft())
        solver = w.FESolver()
        solver.addTriangles(nodes, triangles, material=form, velocity=lambda x, y: (40 * x, 0))
        engines(solver, factor=.4)
        O.run(100, True)
        if reload:
            O.save(os.path.join(folder, 'bar.yade'))
            O.reset()
            O.load(os.path.join(folder, 'bar.yade'))
            solver = solverOfScene()
        O.run(100, True)
        return solver.nodes, solver.energy, solver.materialNumbers, solver.criticalTimeStep()

    wanted = result(forms[0], False)
    for form in forms:
        found = result(form, form is forms[0])
        assert np.array_equal(wanted[0], found[0]) and wanted[1] == found[1]
        assert np.array_equal(wanted[2], found[2]) and wanted[3] == found[3]


def test_spheresHaveTheMaterialBesideThem():
    O.materials.append(hard())
    O.materials.append(soft())
    solver = w.FESolver()
    solver.addPolygon(yadefrag.rectangle((0, 0), (kLength, kHeight)), size=.005, material=halves, joints=kLine,
                      jointStrength=None)
    for body in O.bodies:
        x = body.state.pos[0]
        assert body.material.label == ('hard' if x < kLength / 2 else 'soft'), x
