"""Strength and fracture energy by place, from Python."""
import builtins
import os

import numpy as np
import pytest

import yadefrag
from fe_impact import brittle, cracks, engines
from fe_scene import reloaded
from outline_files import area
from yade import wrapper as w

O = builtins.O
kLength, kHeight, kWeak, kEnergy, kRate = .1, .02, 5e6, 60., 20.


def inBand(x):
    return abs(x - .7 * kLength) < .004


def drawnBar(**given):
    """A bar that is drawn at a constant rate of strain; its stress is even."""
    solver = w.FESolver()
    material = brittle(young=1e9, poisson=0, density=1000, planeStress=True, fractureEnergy=1000,
                       tensileStrength=50e6)
    wanted = dict(strength=lambda x, y: kWeak if inBand(x) else 50e6,
                  fractureEnergy=lambda x, y: kEnergy if inBand(x) else 1000)
    solver.addPolygon(yadefrag.rectangle((0, 0), (kLength, kHeight)), size=.002, material=material,
                      velocity=lambda x, y: (kRate * (x - kLength / 2), 0),
                      fixed=lambda x, y: 'x' if x < 1e-9 or x > kLength - 1e-9 else False,
                      **{**wanted, **given})
    engines(solver, factor=.4)
    return solver


def test_aBarBreaksInItsWeakBand():
    solver = drawnBar()
    while solver.numCracks == 0:
        O.step()
    # The stress when the first edge cracks is the band's strength, to the node's mean of stresses.
    assert 1e9 * kRate * O.time == pytest.approx(kWeak, rel=.02)
    while len(solver.fragments()) < 2 and O.time < 2e-3:
        O.run(50, True)
    parts = solver.fragments()
    assert len(parts) >= 2
    assert all(abs(x - .7 * kLength) < .004 + .003 for x, _ in cracks(solver))
    # A path along the edges of an irregular mesh is longer than the section, and some edges beside
    # it open a little.
    spent = solver.energy['fracture'] / (kEnergy * kHeight)
    assert .8 < spent < 2.5


def test_arraysAreTheSameAsFunctions(folder):
    first = drawnBar()
    middles = (first.nodes[first.triangles]).mean(axis=1)
    O.run(700, True)
    nodes, energy = first.nodes, first.energy
    O.reset()
    again = drawnBar(strength=np.array([kWeak if inBand(x) else 50e6 for x, _ in middles]),
                     fractureEnergy=[kEnergy if inBand(x) else 1000 for x, _ in middles])
    O.run(300, True)
    again = reloaded(os.path.join(folder, 'bar.yade'))
    O.run(400, True)
    assert again.numCracks > 0
    assert np.array_equal(again.nodes, nodes) and again.energy == energy


# --- joints

kJoint = [((.03, .01), (.07, .01))]


def plate(**given):
    solver = w.FESolver()
    wanted = dict(size=.004, material=brittle(fractureEnergy=20), joints=kJoint)
    solver.addPolygon(yadefrag.rectangle((0, 0), (.1, .02)), **{**wanted, **given})
    return solver


def test_anOpenJointIsTwoFacesFromTheStart():
    cut = plate()
    assert cut.numCracks == 0 and len(cut.fragments()) == 1
    places = cracks(cut)
    assert len(places) >= 8 and np.all(np.abs(places[:, 1] - .01) < 1e-12)
    assert places[:, 0].min() > .03 and places[:, 0].max() < .07  # its ends are the crack's tips
    faces = [loop for loop in cut.surfaces if len(loop) == 2 * (len(places) + 1)]
    assert len(faces) == 1 and len(cut.surfaces) == 2
    assert len(O.bodies) == sum(map(len, cut.surfaces))
    engines(cut)
    O.run(20, True)
    assert abs(cut.energy['total']) < 1e-20  # rounding


def test_aJointThroughABodyMakesTwo():
    solver = plate(joints=[((.05, -1), (.05, 1))])
    assert len(solver.fragments()) == 2
    assert sum(f['mass'] for f in solver.fragments()) == pytest.approx(2500 * .002)


def test_jointsHoldUpToTheirOwnStrength():
    solver = drawnBar(strength=None, fractureEnergy=None, joints=[((.07, 0), (.07, .02))],
                      jointStrength=kWeak, jointEnergy=kEnergy)
    while solver.numCracks == 0:
        O.step()
    assert 1e9 * kRate * O.time == pytest.approx(kWeak, rel=.02)
    while len(solver.fragments()) < 2 and O.time < 2e-3:
        O.run(50, True)
    assert np.all(np.abs(cracks(solver)[:, 0] - .07) < 1e-9)
    O.run(400, True)
    # The error goes with how few steps an opening takes (tests/fracture/mode_one_test.cpp).
    assert solver.energy['fracture'] == pytest.approx(kEnergy * kHeight, rel=.01)


# --- grains

def test_grainsAsJointsOfOneBody():
    outline = yadefrag.rectangle((0, 0), (.1, .02))
    whole = plate(joints=()).criticalTimeStep()
    O.reset()
    grains = yadefrag.voronoi(outline, 30, seed=2, rounds=3, shortest=.0015)
    joints = yadefrag.grainJoints(grains)
    open_ = plate(joints=joints)
    assert len(open_.fragments()) == 30
    assert sorted(f['area'] for f in open_.fragments()) == \
        pytest.approx(sorted(area(grain) for grain in grains), rel=1e-9)
    O.reset()
    weak = plate(joints=joints, jointStrength=1e6)
    assert weak.criticalTimeStep() > whole / 8  # with sides of any length: a 200th
    assert len(weak.fragments()) == 1
    engines(weak)
    O.run(20, True)
    assert weak.numCracks == 0


def test_grainsAsBodies():
    solver = w.FESolver()
    for grain in yadefrag.voronoi(yadefrag.rectangle((0, 0), (.1, .02)), 12, seed=2, rounds=3):
        solver.addPolygon(grain, size=.004, material=brittle())
    engines(solver)
    O.run(50, True)
    assert solver.maxPenetration < 1e-12 and solver.energy['kinetic'] < 1e-15
