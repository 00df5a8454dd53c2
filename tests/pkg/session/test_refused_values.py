"""What is refused, as in test_refused.py: constants of materials, curves, what a body is added with, and calls of
functions and methods for bodies that are there; and what selects nothing. The patterns are those of `re`."""
import math
import re
import warnings

import numpy as np
import pytest

import yadefrag
from fe_scene import FAILS, fe, finder, heard, O, run, STEEL, steps
from test_refused import added, sentenceOf
from yade import wrapper as w

INF, NAN = math.inf, math.nan

# --- constants of materials: {what: (class, constants that are accepted, [(wrong ones, sentence)])}

SOIL = dict(young=1e8, poisson=.3, density=2000, cohesion=1e4, internalFriction=.5)
CONCRETE = dict(young=30e9, poisson=.2, density=2400, cohesion=5e6, internalFriction=.5, dilationAngle=.5,
                tensionLimit=1.2e6)
MATERIALS = {
    'brittle': (w.BrittleFEMat, dict(young=30e9, poisson=.2, density=2500, tensileStrength=20e6), [
        (dict(tensileStrength=0), 'tensileStrength is 0 Pa; it must be positive and finite for a material that cracks.'),
        (dict(tensileStrength=-1), 'tensileStrength is -1 Pa'),
        (dict(tensileStrength=NAN), 'tensileStrength is nan'),
        (dict(fractureEnergy=-5), 'fractureEnergy is -5 J/m²; it must be positive and finite, or 0 for cracks that open at '
                                  'once.'),
        (dict(shearFactor=0), 'shearFactor is 0; it must be positive and finite.'),
        (dict(shearEnergyFactor=0), 'shearEnergyFactor is 0; it must be positive and finite.'),
        (dict(weibullModulus=-2), 'weibullModulus is -2; it must be positive and finite, or 0 for strengths without this '
                                  'scatter.'),
        (dict(referenceVolume=-1), 'referenceVolume is -1 m³; it must be positive and finite, or 0 for strengths on which '
                                   'the volume has no influence.'),
        (dict(strengthScatter=1), 'strengthScatter is 1; it must be at least 0 and below 1.'),
        (dict(coarseMesh='fine'), "coarseMesh is 'fine'; it must be 'warn', 'strength' or 'energy'"),
        *[(dict(rateEnergyPower=power), 'rateEnergyPower is .*; it must be from 0, for an energy')
          for power in (-1, 11, NAN, INF)]]),
    'plastic': (w.PlasticFEMat, STEEL, [
        (dict(yieldStress=0), 'yieldStress is 0 Pa; it must be positive and finite.'),
        (dict(hardening=-1e6), r'hardening is -1e\+06 Pa; it must be 0 or positive, and finite.'),
        (dict(hardeningExponent=0), 'hardeningExponent is 0; it must be above 0 and at most 1.'),
        (dict(meltTemperature=200), 'meltTemperature is 200 K; it must be above startTemperature, and finite.'),
        (dict(rateFactor=NAN), 'rateFactor is nan; it must be 0 or positive, and finite.'),
        (dict(heatShare=1.5), 'heatShare is 1.5; it must be from 0 to 1.'),
        (dict(fractureEnergy=1e4), 'fractureEnergy is 10000 J/m²; it must be 0 unless failureStrain'),
        (dict(failureD4=.01), 'failureD4 is 0.01; '),
        (dict(failureStrain=.3, weibullModulus=-1), 'weibullModulus is -1; it must be positive and finite, or 0'),
        (dict(failureStrain=.3, strengthScatter=1), 'strengthScatter is 1; it must be at least 0 and below 1.'),
        (dict(weibullModulus=5), 'weibullModulus is 5; it must be 0 unless failureStrain, failureD1, failureD2 or '
                                 'spallStress is given.')]),
    'that fails': (w.PlasticFEMat, {**STEEL, **FAILS}, [
        *[(dict(failureStrain=strain), 'failureStrain is %s; it must be positive, or infinite for none.' % strain)
          for strain in (0, -.1, NAN)],
        (dict(failureD1=-.3), 'failureD1, failureD2 and failureD3 give the failure strain -0.156945 where the mean stress '
                              "is 1.5 times von Mises' stress; it must be positive there, or failureStrain given as the "
                              'least one.'),
        (dict(failureD3=2.12), 'failureD3 is 2.12; it must be 0 or negative, since tension reduces the failure strain.'),
        (dict(failureD1=NAN), 'failureD1 is nan; '), (dict(failureD2=-1), 'failureD2 is -1; '),
        (dict(failureD4=-.1), 'failureD4 is -0.1; it must be at least -0.04, for a positive failure strain at any rate.'),
        (dict(failureD5=-2), 'failureD5 is -2; it must be above -1, for a positive failure strain up to melting.'),
        (dict(thermalExponent=0, meltTemperature=0), 'failureD5 is 0.61; it must be 0, or meltTemperature above'),
        (dict(failureD1=0, failureD2=0, failureStrain=.3),
         'failureD3 is -2.12; it must be 0 unless failureD1 or failureD2 is given.'),
        (dict(spallStress=-1), 'spallStress is -1 Pa; it must be positive, or infinite for none.'),
        (dict(spallStress=3e9, fractureEnergy=0), 'fractureEnergy is 0 J/m²; it must be positive if spallStress is given'),
        (dict(fractureEnergy=-1), 'fractureEnergy is -1 J/m²; it must be 0 or positive, and finite.')]),
    'frictional': (w.FrictionalFEMat, SOIL, [
        (dict(cohesion=-1), 'cohesion is -1 Pa; it must be 0 or positive, and finite.'),
        (dict(cohesion=0, fractureEnergy=1), 'cohesion is 0 Pa; it must be positive if fractureEnergy is given.'),
        (dict(cohesion=0, internalFriction=0), 'cohesion and internalFriction are 0; one of them must be positive.'),
        (dict(internalFriction=1.6), 'internalFriction is 1.6; it must be at least 0 and below π/2'),
        (dict(dilationAngle=.6), 'dilationAngle is 0.6; it must be at least 0 and at most internalFriction.'),
        (dict(tensionLimit=-1), 'tensionLimit is -1 Pa; it must be 0 or positive.'),
        (dict(planeStress=True), 'planeStress is True, but the material is frictional; it must be False.')]),
    'frictional that cracks': (w.FrictionalFEMat, CONCRETE, [
        (dict(fractureEnergy=-1), 'fractureEnergy is -1 J/m²; it must be 0 or positive, and finite.'),
        (dict(fractureEnergy=INF), 'fractureEnergy is inf J/m²; it must be 0 or positive, and finite.'),
        (dict(failureStrain=0), 'failureStrain is 0; it must be positive, or infinite for none.'),
        (dict(fractureEnergy=20, tensionLimit=0), 'tensionLimit is 0 Pa; it must be positive if fractureEnergy is given.'),
        (dict(fractureEnergy=20, tensionLimit=INF, internalFriction=0, dilationAngle=0), 'fractureEnergy is 20 J/m²; it '
         'must be 0 unless failureStrain, tensionLimit or internalFriction is given.')]),
}


@pytest.mark.parametrize('name', MATERIALS)
def test_constantsOfMaterials(name):
    cls, accepted, rows = MATERIALS[name]
    for wrong, sentence in rows:
        O.reset()
        O.materials.append(cls(**{**accepted, **wrong}))
        solver = w.FESolver()
        text = sentenceOf(lambda: solver.addPolygon(  # noqa: B023
            yadefrag.rectangle((0, 0), (.008, .024)), .002, 0), ValueError)
        assert re.search(sentence, text), (wrong, text)
        assert len(solver.nodes) == len(O.bodies) == 0


# --- curves: {attribute: (class, error, [(value, sentence)])}

NAME_OR_POINTS = 'it must be a name, or a list of points'
CURVES = [
    ('softening', w.BrittleFEMat, ValueError, [
        ('cubic', "^softening is 'cubic'; it must be one of 'linear', 'bilinear'"),
        ('', "^softening is ''; it must be one of"), ([(0, 1)], '^softening has 1 points; it must have at least two'),
        ([(0, .9), (1, 0)], r'^softening begins at \(0, 0.9\); it must begin at \(0, 1\)'),
        ([(0, 1), (2e-4, 0)], r'^softening ends at \(0.0002, 0\); it must end at \(1, 0\)'),
        ([(0, 1), (.5, .2), (.4, .1), (1, 0)], '^softening has the opening 0.4 after 0.5'),
        ([(0, 1), (.4, .1), (.5, .2), (1, 0)], '^softening has the traction 0.2 after 0.1'),
        ([(0, 1), (NAN, .2), (1, 0)], 'openings must increase')]),
    ('softening', w.BrittleFEMat, TypeError, [
        (3, 'softening is 3, ' + NAME_OR_POINTS), (None, '^BrittleFEMat.softening is None, it must be a name'),
        *[(points, NAME_OR_POINTS) for points in ([0, 1, 1, 0], [(0, 1), (1, 0, 0)], [(0, 'a'), (1, 0)])]]),
    ('rateEffect', w.BrittleFEMat, ValueError, [
        ('ceb', "^rateEffect is 'ceb'; it must be one of 'none', 'ceb-fip-2010', or points"),
        ('', "^rateEffect is ''; it must be one of"), ([], '^rateEffect has no points; it must have at least two'),
        ([(1, 1)], '^rateEffect has one point; it must have at least two'),
        ([(1, 1), (.5, 2)], '^rateEffect has the strain rate 0.5 1/s after 1 1/s; rates must increase'),
        ([(1, 1), (2, .5)], '^rateEffect has the factor 0.5; factors must be from 1, the strength of a slow test, to 1000'),
        ([(-1, 1), (2, 2)], '^rateEffect has the strain rate -1 1/s; rates must be positive'),
        ([(1, 1), (NAN, 2)], 'rates must be positive and finite'), ([(1, 1), (2, NAN)], '^rateEffect has the factor nan')]),
    ('rateEffect', w.BrittleFEMat, TypeError, [
        (3, 'rateEffect is 3, %s .strain rate in 1/s, factor' % NAME_OR_POINTS),
        (None, '^BrittleFEMat.rateEffect is None, it must be a name'),
        *[(points, NAME_OR_POINTS) for points in ([1, 2], [(1, 1, 1), (2, 2, 2)])]]),
    ('hardeningTable', w.PlasticFEMat, ValueError, [
        ([(0, 2e8), (.1, 1e8)], r'^hardeningTable has the stress 1e\+08 Pa after 2e\+08 Pa; stresses must not decrease')]),
    ('hardeningTable', w.PlasticFEMat, TypeError, [(7, 'hardeningTable is')])]


@pytest.mark.parametrize('attribute, cls, kind, rows', CURVES)
def test_curves(attribute, cls, kind, rows):
    """By assignment and by constructor; the value stays the default."""
    material = cls()
    former = getattr(material, attribute)
    for wrong, sentence in rows:
        for call in (lambda: setattr(material, attribute, wrong), lambda: cls(**{attribute: wrong})):  # noqa: B023
            assert re.search(sentence, sentenceOf(call, kind)), wrong
        assert getattr(material, attribute) == former == getattr(cls(), attribute)


# --- what a body is added with, beside another one

JOINT = [((1.03, .45), (1.07, .45))]
MIXED = dict(material=lambda x, y: 'hard' if x < 1.05 else 'soft')


def brittle(argument, value, sentence):
    return {'material': 'hard', argument: value}, '^' + argument + sentence


ADDED = [
    # Several materials.
    (dict(material=lambda x, y: 'none'), r"material\(.*is 'none', which is not in O.materials"),
    (dict(material=lambda x, y: None), r'material\(.*is None, it must be an FEMat'),
    (dict(material=['hard']), 'material has 1 values, it must have one for each of the'),
    (dict(material=(['hard'], [1])), r'material\[1\] must be an array of whole numbers from 0 to 0'),
    (dict(MIXED, element='smoothed'), "element is 'smoothed', but the body has several"),
    (dict(material='hard', interfaceStrength=1), 'interfaceStrength is given, but the body has one'),
    (dict(MIXED, interfaceStrength=-1), 'interfaceStrength is -1, it must be 0 or a pos'),
    (dict(MIXED, interfaceStrength='x'), "interfaceStrength is 'x', it must be None"),
    (dict(MIXED, interfaceEnergy=lambda x, y: -1), r'interfaceEnergy\(.*is -1, it must'),
    (dict(MIXED, interfaceStrength={'hard': 1}), 'a key of interfaceStrength is'),
    (dict(MIXED, interfaceStrength={('hard', 'x'): 1}), "is 'x', which is not in O.mat"),
    (dict(MIXED, interfaceStrength={('hard', 'soft'): 'x'}), r"interfaceStrength\[.*is 'x', it must be 0 or .*, or None"),
    (dict(material=lambda x, y: 'yields' if x < 1.05 else 'm'), 'several materials, one of which yields'),
    # Strength and energy by place, where the material has none, too.
    *[brittle(name, value, sentence) for name in ('strength', 'fractureEnergy') for value, sentence in (
        (lambda x, y: -1, ' is -1 .*; it must be'), (lambda x, y: NAN, ' is nan .*; it must be'),
        (lambda x, y: 'hard', r"\(.*is 'hard', it must be"), ([1., 2.], ' has 2 values, but the mesh has'),
        (1e6, ' is 1000000.0, it must be None, a function'), ([[1.]], r' is \[\[1.0\]\], it must be None, a function'),
        ('weak', " is 'weak', it must be None, a function"))],
    *[({'material': 'yields', name: lambda x, y: 1}, 'are given, but the material neither cracks nor fails; it must be a '
       'BrittleFEMat, or') for name in ('strength', 'fractureEnergy')],
    (dict(material='spalls', fractureEnergy=lambda x, y: 0),
     'fractureEnergy is 0 J/m²; it must be positive for every triangle'),
    (dict(material='fails', selfContact=False), 'selfContact is False'),
    (dict(material='hard', selfContact=False), 'selfContact is False, but the material is a Brittle'),
    # Joints.
    *[(dict(material='hard', joints=JOINT) | more, sentence) for more, sentence in (
        (dict(joints=3), 'joints is 3, it must be a list of pairs of points'),
        (dict(joints=[(0, 0)]), r'joints\[0\]\[0\] is 0, it must be a pair of numbers'),
        (dict(joints=[((0, 0), (1, 1), (2, 2))]), r'joints\[0\] is .*, it must be a pair of points'),
        (dict(joints=[((0, 0), (1, NAN))]), r'joints\[0\]\[1\] is .*, both numbers must be finite'),
        (dict(joints=[((5, 5), (6, 6))]), r'joints\[0\] from .* must run inside the outline'),
        (dict(joints=[((1.05, .45), (1.05, .45))]), r'joints\[0\] .* must have two different ends'),
        (dict(jointStrength=-1), 'jointStrength is -1 Pa; it must be 0 or positive'),
        (dict(jointStrength=[1, 2]), 'jointStrength has 2 values, it must have one for each of the 1'),
        (dict(jointStrength=[NAN]), r'jointStrength\[0\] is nan, it must be a finite number, or None'),
        (dict(jointEnergy='much'), "jointEnergy is 'much', it must be a number"),
        (dict(material='m'), 'joints are given, but the material neither cracks nor fails; it must be a BrittleFEMat'),
        (dict(material='fails', jointStrength=0), 'joints are given, but .* it must be a BrittleFEMat'))],
    # Outline and mesh.
    (dict(snap=-1), 'snap is -1, it must be 0, a positive number'), (dict(snap='x'), "snap is 'x', it must be"),
    (dict(snap=.1, displacement=lambda x, y: (0, 0)), 'snap and displacement are both given'),
    (dict(snap=2.), 'would collapse; it must be less than half its width'),
    (dict(mesh=True), 'mesh is True'), (dict(meshSeed=-1), 'meshSeed is -1, it must be a whole number'),
    (dict(meshSeed=1.5), 'meshSeed is 1.5'), (dict(meshSeed=True), 'meshSeed is True'),
    (dict(size=lambda x, y: 0), r'size\(1, 0.4\) is 0, it must be a positive number'),
    (dict(size=lambda x, y: NAN), r'size\(1, 0.4\) is nan'), (dict(size=lambda x, y: 'fine'), r"size\(1, 0.4\) is 'fine'"),
    (dict(size='fine'), r"size is 'fine', it must be a positive number \(m\) or a function"),
    # Initial stress.
    *[(dict(stress=stress), '^stress is .*three or four finite numbers')
      for stress in (3, (1, 2), (1, NAN, 2), (1, 2, 3, INF))],
    (dict(stress='high'), "^stress is 'high'"),
    (dict(stress=np.zeros((2, 3))), r'^stress has the shape \(2, 3\), it must be \(\d+, 3\)'),
    (dict(stress=lambda x, y: (x, y)), r'^stress\(.*three or four finite numbers'),
    (dict(stress=(9e7, 0, 0)), r'^stress at \(.* m is \(9e\+07, 0, 0\) Pa, .*strained by more than half'),
    (dict(stress=(1, 0, 0), displacement=lambda x, y: (0, 0)), 'only one of them can be'),
    *[(dict(name=name), 'name') for name in ('first', '', 'a\nb', 3)],
]


def test_added():
    solver = fe()
    for label in ('hard', 'soft'):
        O.materials.append(w.BrittleFEMat(young=2e9, poisson=.2, density=1000, tensileStrength=2e7, label=label))
    for label, more in (('yields', {}), ('fails', FAILS), ('spalls', dict(spallStress=3e9, fractureEnergy=1e4))):
        O.materials.append(w.PlasticFEMat(**STEEL, **more, label=label))
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m', name='first')
    before = len(O.bodies), len(solver.nodes)
    for wrong, sentence in ADDED:
        text = sentenceOf(lambda: solver.addPolygon(  # noqa: B023
            yadefrag.rectangle((1, .4), (1.1, .5)), **{**dict(size=.01, material='m'), **wrong}), ValueError)  # noqa: B023
        assert re.search(sentence, text), (wrong, text)
        assert (len(O.bodies), len(solver.nodes)) == before, wrong


# --- calls

def square(left):
    return yadefrag.rectangle((left, 0), (left + 1, 1))


def everywhere(x, y):
    return True


TOUCHING = [[(0, 0), (1, 0), (1, 1)], [(1, 0), (1.01, 0), (1, .01)]]
JOINTS = [((5.2, .2), (5.8, .7)), ((5.1, .9), (5.9, .1)), ((5.5, -1), (5.5, .3))]
CALLS = [
    # Loads and motions.
    (lambda fe: fe.pressure([0], 1), 'No side of the boundary'), (lambda fe: fe.pressure([99], 1), 'there are'),
    (lambda fe: fe.pressure(everywhere, 'high'), "p is 'high'"), (lambda fe: fe.pressure(everywhere, INF), 'p is inf'),
    (lambda fe: fe.pressure(everywhere, [(1, 0), (0, 0)]), 'times of a pressure must ascend'),
    (lambda fe: fe.absorb([0]), 'No side of the boundary'), (lambda fe: fe.absorb('rim'), "component is 'rim'"),
    (lambda fe: fe.relax(0), 'tolerance is 0'), (lambda fe: fe.relax(most=0), 'most is 0'),
    (lambda fe: setattr(fe, 'loads', np.zeros((3, 2))), '3 loads'),
    (lambda fe: setattr(fe, 'loads', np.zeros(3)), r'must be \(n, 2\)'),
    (lambda fe: setattr(fe, 'loads', np.full_like(fe.loads, INF)), 'not finite'),
    (lambda fe: fe.prescribe([99999], vx=0), 'there are'), (lambda fe: fe.prescribe([True], vx=0), 'one for each'),
    (lambda fe: fe.prescribe([0.5], vx=0), 'node numbers'), (lambda fe: fe.prescribe([0], vx='fast'), "vx is 'fast'"),
    (lambda fe: fe.prescribe([0], vy=NAN), 'vy is nan'),
    (lambda fe: fe.prescribe([0, 1], vx=[1., 2., 3.]), 'vx has 3 values, it must have one for each of the 2'),
    (lambda fe: fe.prescribe([0], vx=[(0, 1), (0, 2)]), 'times of a motion must ascend'),
    (lambda fe: fe.prescribe([0], vx=[(0, NAN)]), 'must be finite|its values be finite'),
    (lambda fe: fe.prescribe([0, 1], vx=[1., 2.], vy=[(0, 1)]), 'vx is an array, but the other'),
    (lambda fe: fe.prescribe('anvil', vx=1), "component is 'anvil', it must be the number or the name"),
    (lambda fe: fe.rotate(7, 1, (0, 0)), 'component is 7, which is no body'),
    (lambda fe: fe.rotate([0], 'fast', (0, 0)), "omega is 'fast'"),
    (lambda fe: fe.rotate([0], 1, 'here'), "centre is 'here'"),
    (lambda fe: fe.rotate([99], 1, (0, 0)), 'there are'), (lambda fe: yadefrag.runSteps(0), 'steps is 0'),
    (lambda fe: yadefrag.runSteps(10, every=5, call=3), 'call is 3'),
    # Queries.
    (lambda fe: fe.nodesOf('anvil'), "component is 'anvil'"), (lambda fe: fe.nodesOf(1.5), 'component is 1.5'),
    (lambda fe: fe.removeBody('anvil'), "component is 'anvil'"), (lambda fe: fe.reaction('anvil'), "component is 'anvil'"),
    (lambda fe: fe.reaction([99]), 'but there are'), (lambda fe: fe.contactForce(0, 9), 'b is 9, which is no body'),
    (lambda fe: fe.contactForce('anvil'), "a is 'anvil', it must be the number or the name"),
    (lambda fe: yadefrag.crackTable(3), 'fe is 3, it must be an FESolver'),
    (lambda fe: fe.meshQuality(), 'component is None, but there are 2 bodies'),
    *[(lambda fe, wrong=wrong: fe.meshQuality(wrong), r'component is %r.*one of \[0, 1\]' % wrong)
      for wrong in (3, -1, True, 1.5)],
    (lambda fe: fe.meshQuality('block'), "component is 'block'.*no body has a name"),
    # Bonds.
    (lambda fe: fe.bond(0, 1, strength=0, energy=1), 'strength is 0, it must be a positive number'),
    (lambda fe: fe.bond(0, 1, strength=1, energy=-1), 'energy is -1, it must be a positive number'),
    (lambda fe: fe.bond(0, 'x', 1, 1), "b is 'x', it must be the number or the name of a body"),
    (lambda fe: fe.bond(0, 2, 1, 1), 'There is no body 2 to bond'),
    (lambda fe: fe.bond(1, 1, 1, 1), 'cannot be bonded to itself'),
    (lambda fe: yadefrag.snapOutlines(3, 1.), 'shapes is 3, it must be a list of outlines'),
    (lambda fe: yadefrag.snapOutlines([[(0, 0), (1, 0)]], 1.), r'shapes\[0\]'),
    (lambda fe: yadefrag.snapOutlines(TOUCHING[:1], 0), 'tolerance is 0, it must be a positive number'),
    (lambda fe: yadefrag.snapOutlines(TOUCHING, .1), 'would collapse'),
    # Meshes.
    (lambda fe: fe.addMesh(3, 'm'), r'mesh is 3, it must be a Mesh, the MeshFile of readMesh, or a pair'),
    (lambda fe: fe.addMesh((1, 2, 3), 'm'), r'it must be a Mesh'),
    (lambda fe: fe.addMesh((square(5), [(0, 1, 4)]), 'm'), 'triangles has node numbers from 0 to 4'),
    (lambda fe: fe.addMesh((square(5), [(0, 1, 2)]), 'm'), 'node 3 belongs to no triangle'),
    (lambda fe: fe.addMesh((square(5), [(0, 2, 1), (0, 1, 3)]), 'm'), '(?i)triangle'),
    (lambda fe: fe.addMesh(yadefrag.Mesh(square(5), [(0, 1, 2), (0, 2, 3)]), 'm', smooth=2), 'smooth is 2'),
    (lambda fe: fe.addMesh(yadefrag.rectangleMesh((5, 0), (6, 1), 2, 2), 'none'), "material is 'none'"),
    (lambda fe: fe.addMesh(yadefrag.polygonMesh(square(5), size=.4, joints=JOINTS), 'm'), 'joints are given, but the material'),
    (lambda fe: fe.addMesh(yadefrag.polygonMesh(square(5), size=.4, joints=JOINTS), 'b', jointStrength=[1, 2]),
     'jointStrength has 2 values, it must have one for each of the 3 joints'),
    (lambda fe: yadefrag.polygonMesh(square(5), size=0), 'size is 0'),
    (lambda fe: yadefrag.polygonMesh(square(5), size=.4, jointTolerance=-1), 'jointTolerance is -1'),
    (lambda fe: yadefrag.polygonMesh(square(5), size=.4, mesh='fine'), "mesh is 'fine'"),
    (lambda fe: yadefrag.Mesh(square(5), [(0, 1.5, 2)]), r'triangles must be an array \(m, 3\)'),
    # The scene.
    *[(lambda fe, name=name, value=value: yadefrag.engines(fe, spheres=True, gravity=(0, -1), **{name: value}),
       '^%s is .* it must be None, or a class derived from ' % name) for name, value in (
        ('loop', w.NewtonIntegrator), ('loop', 'CurveLoop'), ('integrator', w.InteractionLoop), ('integrator', 3),
        ('collider', w.CurveLoop), ('collider', 'LebesgueCollider'))],
    *[(lambda fe, wrong=wrong: yadefrag.engines(**{'fe': fe, **wrong}), '%s is ' % next(iter(wrong))) for wrong in (
        dict(fe=3), dict(gravity='down'), dict(gravity=(0, 0, -9.81)), dict(gravity=(1,)), dict(spheres='many'),
        dict(damping=10**400))],
    *[(lambda fe, wrong=wrong: yadefrag.inCurveOrder([(0, 0, 0), wrong]), r'bodies\[1\]') for wrong in (
        (1, 2), (1, 2, NAN), 'abc', 3, None, (1, 2, 3, 4), ((1, 2, INF), .1))],
]


def test_callsForBodies():
    solver = fe()
    O.materials.append(w.BrittleFEMat(young=5e9, poisson=.2, density=2000, tensileStrength=1e6, label='b'))
    for left in (0, 1):
        solver.addPolygon(square(left), size=.5, material='m')
    run(solver)

    def state():
        return (solver.nodes.tobytes(), solver.velocities.tobytes(), solver.loads.tobytes(), repr(solver.energy),
                len(O.bodies), tuple(solver.gravity), solver.takesGravity)

    before = state()
    for call, sentence in CALLS:
        text = sentenceOf(lambda: call(solver), ValueError)  # noqa: B023
        assert re.search(sentence, text), (sentence, text)
        assert state() == before, text
    assert tuple(solver.gravity) == (0, 0, 0) and solver.takesGravity and O.iter == 0
    steps(2)
    assert not solver.reactions.any() and solver.energy['external'] == solver.energy['damping'] == 0
    assert solver.bond(0, 1, 1e6, 1e6) > 0


# --- what selects nothing

@pytest.mark.parametrize('call', [
    lambda solver, nodes: solver.prescribe(nodes, vx=0), lambda solver, nodes: solver.rotate(nodes, 1, (0, 0)),
    lambda solver, nodes: solver.reaction(nodes)])
@pytest.mark.parametrize('kind', ['function', 'flags', 'numbers'])
def test_placesWithoutNodesAreReported(call, kind):
    """After a motion: a function gets the present positions."""
    made = fe()
    added(made, velocity=(1, 0))
    run(made, finder('LebesgueCollider'))
    left = lambda x, y: x < 1e-9
    numbers = np.flatnonzero([left(x, y) for x, y in made.nodes])
    with warnings.catch_warnings(action='error'):
        call(made, left)
    made.prescribe(numbers)
    steps(3)
    nodes = dict(function=left, flags=np.array([left(x, y) for x, y in made.nodes]), numbers=[])[kind]
    with pytest.warns(UserWarning, match='^nodes selects none of the %d nodes' % len(made.nodes)) as caught:
        call(made, nodes)
    assert ('present positions' in str(caught[0].message)) == (kind == 'function')


def told(call):
    with heard() as texts:
        call()
    return texts


@pytest.mark.parametrize('low', [-1, 2])
def test_fixedThatSelectsNothingIsReportedBeforeTheRun(low):
    """Of several bodies it may select nothing of some, whichever of them it holds."""
    made = fe()
    for k in range(3):
        added(made, (2 * k, 0), fixed=lambda x, y: 2 * low < x < 2 * low + .5)
    run(made)
    assert told(O.step) == ([] if low == 2 else ['fixed selects none of the nodes of the bodies 0 to 2.'])
    assert not told(O.step)


@pytest.mark.parametrize('corners', [(.1, .05), (.4, .006)])
def test_sizeAboveTheBody(corners):
    shape = yadefrag.rectangle((0, 0), corners)
    [sentence] = told(lambda: fe().addPolygon(shape, size=10, material='m'))
    assert sentence == (
        'addPolygon: size is 10 m, but the body has only %g m by %g m: its outline requires smaller triangles, which '
        'determine the critical time step; take a size of at most %g m.' % (*corners, corners[1]))
    O.reset()
    assert not told(lambda: fe().addPolygon(shape, size=corners[1], material='m'))
