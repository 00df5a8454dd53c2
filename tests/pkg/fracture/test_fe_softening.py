"""Softening curves of cracks, from Python."""
import builtins

import numpy as np
import pytest

import yadefrag
from yade import wrapper as w

O = builtins.O
kTable = [(0, 1), (.1, .4), (.5, .3), (1, 0)]
kCurves = ('linear', 'bilinear', 'petersson', 'ceb-fip-2010', 'exponential', 'reinhardt', kTable)
# Of Gc/ft: the critical opening. The table's area is .07 + .14 + .075.
kCritical = dict(zip(map(str, kCurves), (2, 3.6, 3.6, 5, 7, 5.136, 1 / .285)))
kStrength, kEnergy, kLength, kHeight = 2e6, 100., .02, .01


def bar(softening, speed=.5):
    """Two halves of a stiff bar, bonded by a joint; their ends part."""
    O.materials.append(w.BrittleFEMat(young=100e9, poisson=0, density=2500, frictionAngle=0, planeStress=True,
                                      tensileStrength=kStrength, fractureEnergy=kEnergy, softening=softening))
    fe = w.FESolver()
    fe.addPolygon(yadefrag.rectangle((-kLength / 2, 0), (kLength / 2, kHeight)), size=.0025, material=0,
                  joints=[((0, -1), (0, 1))], jointStrength=kStrength, jointEnergy=kEnergy,
                  strength=lambda x, y: 1e3 * kStrength, fractureEnergy=lambda x, y: 0,
                  velocity=lambda x, y: (speed * np.sign(x), 0),
                  fixed=lambda x, y: 'x' if abs(x) > kLength / 2 - 1e-9 else False)
    O.engines = yadefrag.engines(fe)
    O.dt = .5 * fe.criticalTimeStep()
    return fe


@pytest.mark.parametrize('softening', kCurves, ids=str)
def test_aJointOpensWithItsEnergyUpToTheCriticalOpening(softening):
    fe = bar(softening)
    # The ends go on: each point of the curve is passed.
    ends = np.nonzero(abs(abs(fe.nodes[:, 0]) - kLength / 2) < 1e-9)[0]
    fe.prescribe(ends[fe.nodes[ends, 0] > 0], vx=[(0, .5)])
    fe.prescribe(ends[fe.nodes[ends, 0] < 0], vx=[(0, -.5)])
    begin = fe.energy['total']
    critical = kCritical[str(softening)] * kEnergy / kStrength
    for _ in range(100):
        O.run(max(1, int(critical / 60 / O.dt)), True)
        cracks = yadefrag.crackTable(fe)
        if len(cracks) and not cracks['held'].any():
            break
    assert len(cracks) == 4 and not cracks['held'].any()
    assert cracks['opening'].min() >= .999 * critical
    assert cracks['opening'].max() < 1.1 * critical
    # The mesh has no other edges that may open: Gc times the section.
    assert fe.energy['fracture'] == pytest.approx(kEnergy * kHeight, rel=2e-3)
    assert fe.energy['total'] == pytest.approx(begin, abs=1e-3 * kEnergy * kHeight)
    assert not fe.warnings
