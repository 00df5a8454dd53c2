"""What a script gives wrongly to the functions and methods is refused with one sentence that names the argument, and
nothing has changed: tables by argument. Values of a wrong kind are in test_forms.py, those of attributes in
test_refused_values.py; files have theirs in test_file_errors.py, steps in test_messages.py."""
import inspect
import math
import re

import numpy as np
import pytest

import api_calls
import yadefrag
from fe_scene import FAILS, fe, O, run, STEEL, steps
from yade import wrapper as w

INF, NAN, HUGE = math.inf, math.nan, 10**400


def square(left):
    return yadefrag.rectangle((left, 0), (left + 1, 1))


def added(made, left=0, **settings):
    return made.addPolygon(square(left), **{**dict(size=.5, material='m'), **settings})


def sentenceOf(call, *kinds):
    with pytest.raises(kinds or (ValueError, TypeError)) as error:
        call()
    text = str(error.value)
    assert text.endswith('.') and '. ' not in text and '\n' not in text and len(text) <= 400, text
    return text


def bodies():
    """Two elastic bodies that touch, ready to run; materials of each kind."""
    solver = fe()
    for label in ('hard', 'soft'):
        O.materials.append(w.BrittleFEMat(young=2e9, poisson=.2, density=1000, tensileStrength=2e7, label=label))
    for label, more in (('yields', {}), ('fails', FAILS), ('spalls', dict(spallStress=3e9, fractureEnergy=1e4))):
        O.materials.append(w.PlasticFEMat(**STEEL, **more, label=label))
    for left in (0, 1):
        added(solver, left, name='first' if not left else None)
    run(solver)
    return solver


def assertRefused(solver, call, sentence, *kinds):
    """`sentence` is a pattern of `re`."""
    before = api_calls.state(solver)
    text = sentenceOf(call, *kinds)
    assert re.search(sentence, text), (sentence, text)
    assert api_calls.state(solver) == before, text


# --- addPolygon, beside others: argument: [(value, sentence)]

JOINT = [((5.3, .5), (5.7, .5))]
NOT_ONE = 'is given, but the material neither cracks nor fails; it must be a BrittleFEMat, or'
# What the argument is given with.
WITH = {**{name: dict(material='hard') for name in ('strength', 'fractureEnergy', 'selfContact')},
        **{name: dict(material='hard', joints=JOINT) for name in ('joints', 'jointStrength', 'jointEnergy')},
        **{name: dict(material=lambda x, y: 'hard' if x < 5.5 else 'soft') for name in ('interfaceStrength', 'interfaceEnergy')}}
byPlace = [(lambda x, y: -1, '%s is -1 .*; it must be'), (lambda x, y: NAN, '%s is nan .*; it must be'),
           (lambda x, y: 'hard', r"%s\(.*is 'hard', it must be"), ([1., 2.], '%s has 2 values, but the mesh has'),
           (1e6, '%s is 1000000.0, it must be None, a function'), ([[1.]], r'%s is \[\[1.0\]\], it must be None, a function')]
ADDED = {
    'outline': [(square(5)[:2], 'outline has 2 points'), ([(5, 0), (6, 1), (6, 0), (5, 1)], 'outline'),
                ([(5, 0), (6, NAN), (6, 1)], 'outline has a point 1'),
                ([(*place, 0) for place in square(5)], 'outline must be a list of points'),
                (square(5) + square(5)[:1], 'a loop closes by itself'), ([(5, 0), (6, 0), (7, 0)], 'must enclose an area')],
    'holes': [([[(0, 0), (1,)]], r'holes\[0\] must be a list of points'),
              ([(5.2, .2), (5.4, .2), (5.4, .4)], r'holes\[0\] must be a list of points'),
              ([[(2, 2), (3, 2), (3, 3)]], 'holes must be inside')],
    'size': [(0, 'size is 0, it must be a positive number'), (HUGE, 'size is 1000'), (2e-5, 'Size 2e-05 m would give about'),
             (1e-5, r'Size 1e-05 m would give about 2.309e\+10 triangles; a mesh can have'),
             *[(lambda x, y, value=value: value, r'size\(5, 0\) is ' + words) for value, words in (
                 (0, '0, it must be a positive number'), (NAN, 'nan'), ('fine', "'fine'"))]],
    'material': [('none', "material is 'none', which is not in O.materials"), (.5, 'material is 0.5'),
                 (7, 'material is 7, which is not in O.materials'), (10**30, 'which is not in O.materials'),
                 (w.FrictMat(), 'must be an FEMat'),
                 *[(w.FEMat(**{name: value}), name + ' is ') for name, value in (
                     ('young', 0), ('young', -1), ('young', NAN), ('poisson', .5), ('density', -1), ('density', 0),
                     ('frictionAngle', 2))],
                 (lambda x, y: 'none', r"material\(.*is 'none', which is not in O.materials"),
                 (lambda x, y: None, r'material\(.*is None, it must be an FEMat'),
                 (['hard'], 'material has 1 values, it must have one for each of the'),
                 ((['hard'], [1]), r'material\[1\] must be an array of whole numbers from 0 to 0'),
                 (lambda x, y: 'yields' if x < 5.5 else 'm', 'several materials, one of which yields')],
    'interfaceStrength': [
        (dict(material='hard', interfaceStrength=1), 'interfaceStrength is given, but the body has one'),
        (-1, 'interfaceStrength is -1, it must be 0 or a pos'), ({'hard': 1}, 'a key of interfaceStrength is'),
        ({('hard', 'x'): 1}, "is 'x', which is not in O.mat"),
        ({('hard', 'soft'): 'x'}, r"interfaceStrength\[.*is 'x', it must be 0 or .*, or None")],
    'interfaceEnergy': [(lambda x, y: -1, r'interfaceEnergy\(.*is -1, it must')],
    **{name: [*[(value, '^' + words % name) for value, words in byPlace],
              *[({'material': label, name: lambda x, y: 1}, NOT_ONE) for label in ('m', 'yields')],
              (dict(material='spalls', fractureEnergy=lambda x, y: 0),
               'fractureEnergy is 0 J/m²; it must be positive for every triangle')] for name in ('strength', 'fractureEnergy')},
    'selfContact': [(dict(material=label, selfContact=False), 'selfContact is False, but the body has joints, or a material that cracks')
                    for label in ('fails', 'hard')],
    'joints': [([(0, 0)], r'joints\[0\]\[0\] is 0, it must be a pair of numbers'),
               ([((0, 0), (1, 1), (2, 2))], r'joints\[0\] is .*, it must be a pair of points'),
               ([((0, 0), (1, NAN))], r'joints\[0\]\[1\] is .*, both numbers must be finite'),
               ([((7, 7), (8, 8))], r'joints\[0\] from .* must run inside the outline'),
               ([((5.5, .5), (5.5, .5))], r'joints\[0\] .* must have two different ends'),
               (dict(joints=JOINT, material='fails'), 'joints are given, but .* it must be a BrittleFEMat')],
    'jointStrength': [(-1, 'jointStrength is -1 Pa; it must be 0 or positive'),
                      ([1, 2], 'jointStrength has 2 values, it must have one for each of the 1'),
                      ([NAN], r'jointStrength\[0\] is nan, it must be a finite number, or None')],
    'smooth': [([True], 'smooth has 1 flags, it must have one for each of the 4 points')],
    'velocity': [((HUGE, 0), 'both numbers must be finite'), (lambda x, y: (x, INF), r'velocity\(.*both numbers must be finite'),
                 ((1e160, 0), r'velocity is 1e\+160 m/s; it must be at most 1e100 m/s')],
    'spin': [(INF, 'spin is inf'), (HUGE, 'it must be a finite number')],
    'displacement': [(lambda x, y: x, r'displacement\('), (lambda x, y: (-2 * x, 0), 'displacement inverts the triangle at'),
                     (lambda x, y: (-x, 0), 'displacement inverts the triangle at')],
    'fixed': [(True, 'fixed is True, it must be a function'), (lambda x, y: 'z', "is 'z', it must be False, True, 'x' or 'y'")],
    'thickness': [(-1, 'thickness is -1'), (0, 'thickness is 0'), (1e300, 'N/m; it must be in the range of ')],
    'element': [('quadratic', "element is 'quadratic', it must be 'linear' or 'smoothed'"),
                (dict(WITH['interfaceStrength'], element='smoothed'), "element is 'smoothed', but the body has several")],
    'mesh': [('lattice', "mesh is 'lattice', it must be 'regular', 'irregular' or None"), (True, 'mesh is True')],
    'simplify': [(0, r'simplify is 0, it must be a positive number \(m\)'),
                 (.25, 'simplify is 0.25 m, but the outline could vanish; it must be less than')],
    'snap': [(-1, 'snap is -1, it must be 0, a positive number'), 
             (dict(outline=yadefrag.rectangle((2, .4), (2.1, .5)), size=.01, snap=2.), 'would collapse; it must be less than half its width'),
             (dict(snap=.1, displacement=lambda x, y: (0, 0)), 'snap and displacement are both given')],
    'stress': [*[(value, '^stress is .*three or four finite numbers') for value in (3, (1, 2), (1, NAN, 2), (1, 2, 3, INF))],
               (np.zeros((2, 3)), r'^stress has the shape \(2, 3\), it must be \(\d+, 3\)'),
               (lambda x, y: (x, y), r'^stress\(.*three or four finite numbers'),
               ((9e7, 0, 0), r'^stress at \(.* m is \(9e\+07, 0, 0\) Pa, .*strained by more than half'),
               (dict(stress=(1, 0, 0), displacement=lambda x, y: (0, 0)), 'only one of them can be')],
    'name': [(name, '^name is ') for name in ('first', '', 'a\nb')],
}


kArguments = set(inspect.signature(w.FESolver.addPolygon).parameters)


@pytest.mark.parametrize('argument', ADDED)
def test_added(argument):
    """A dict of arguments is that."""
    solver = bodies()
    for value, sentence in ADDED[argument]:
        given = value if isinstance(value, dict) and set(value) <= kArguments else {argument: value}
        settings = {**dict(outline=square(5), size=.5, material='m'), **WITH.get(argument, {}), **given}
        assertRefused(solver, lambda: solver.addPolygon(**settings), sentence, ValueError)  # noqa: B023


def test_memory():
    text = sentenceOf(lambda: fe().addPolygon(yadefrag.rectangle((0, 0), (1e4, 1e4)), size=.35, material='m'))
    assert 'would give about 1.885e+09 triangles, which take about' in text and 'm would fill it' in text


# --- functions of a script

ARITY = {
    **{name: lambda s, f, name=name: added(s, 5, **{'material': 'hard', name: f}) for name in
       ('fixed', 'size', 'velocity', 'displacement', 'stress', 'material', 'strength')},
    'nodes': lambda s, f: s.prescribe(f, vx=0)}


def test_functionsWithAWrongNumberOfArguments():
    solver = bodies()
    for name, call in ARITY.items():
        for wrong in (lambda p: 0, lambda: 0, lambda x, y, z: 0):
            assertRefused(solver, lambda: call(solver, wrong), re.escape(  # noqa: B023
                '%s is a function that cannot be called as %s(x, y): it must take 2 arguments.' % (name, name)), TypeError)
    assertRefused(solver, lambda: solver.prescribe([0], vy=lambda t: 0),
                  r'vy is a function that cannot be called as vy\(x, y, t\): it must take 3', TypeError)
    assertRefused(solver, lambda: solver.pressure(lambda x, y: True, lambda x, y: 0),
                  r'p is a function that cannot be called as p\(t\): it must take one argument', TypeError)


def test_errorsWithinAFunctionAreThoseOfTheScript():
    for settings, words in ((dict(fixed=lambda x, y: len(x) < 0), 'has no len'), (dict(velocity=lambda x, y: (x + None, 0)), 'NoneType')):
        with pytest.raises(TypeError, match=words):
            added(fe(), **settings)


# --- other methods and functions: [(call of the solver, sentence)]

def everywhere(x, y):
    return True


TOUCHING = [[(0, 0), (1, 0), (1, 1)], [(1, 0), (1.01, 0), (1, .01)]]
JOINTS = [((5.2, .2), (5.8, .7)), ((5.1, .9), (5.9, .1)), ((5.5, -1), (5.5, .3))]
CALLS = [
    # Loads and motions.
    (lambda fe: fe.pressure([0], 1), 'No side of the boundary'), (lambda fe: fe.pressure([99], 1), 'there are'),
    (lambda fe: fe.pressure(everywhere, [(1, 0), (0, 0)]), 'times of a pressure must ascend'),
    (lambda fe: fe.absorb([0]), 'No side of the boundary'), (lambda fe: fe.absorb('rim'), "component is 'rim'"),
    (lambda fe: fe.relax(0), 'tolerance is 0'), (lambda fe: fe.relax(most=0), 'most is 0'),
    (lambda fe: setattr(fe, 'loads', np.zeros((3, 2))), '3 loads'),
    (lambda fe: setattr(fe, 'loads', np.zeros(3)), r'must be \(n, 2\)'),
    (lambda fe: setattr(fe, 'loads', np.full_like(fe.loads, INF)), 'not finite'),
    (lambda fe: fe.prescribe([99999], vx=0), 'there are'), (lambda fe: fe.prescribe([True], vx=0), 'one for each'),
    (lambda fe: fe.prescribe([0.5], vx=0), 'node numbers'),
    (lambda fe: fe.prescribe([0, 1], vx=[1., 2., 3.]), 'vx has 3 values, it must have one for each of the 2'),
    (lambda fe: fe.prescribe([0], vx=[(0, 1), (0, 2)]), 'times of a motion must ascend'),
    (lambda fe: fe.prescribe([0], vx=[(0, NAN)]), 'must be finite|its values be finite'),
    (lambda fe: fe.prescribe([0, 1], vx=[1., 2.], vy=[(0, 1)]), 'vx is an array, but the other'),
    (lambda fe: fe.prescribe('anvil', vx=1), "component is 'anvil', it must be the number or the name"),
    (lambda fe: fe.rotate(7, 1, (0, 0)), 'component is 7, which is no body'), (lambda fe: fe.rotate([99], 1, (0, 0)), 'there are'),
    (lambda fe: yadefrag.runSteps(0), 'steps is 0'),
    # Queries.
    (lambda fe: fe.nodesOf('anvil'), "component is 'anvil'"), (lambda fe: fe.removeBody('anvil'), "component is 'anvil'"),
    *[(lambda fe, wrong=wrong: fe.removeBody(wrong), '^component is ') for wrong in (2, -1, None, 1.5, True)],
    (lambda fe: fe.reaction('anvil'), "component is 'anvil'"), (lambda fe: fe.reaction([99]), 'but there are'),
    (lambda fe: fe.contactForce(0, 9), 'b is 9, which is no body'),
    (lambda fe: fe.contactForce('anvil'), "a is 'anvil', it must be the number or the name"),
    (lambda fe: fe.meshQuality(), 'component is None, but there are 2 bodies'),
    (lambda fe: fe.meshQuality(3), 'component is 3'), (lambda fe: fe.meshQuality('block'), "component is 'block'"),
    # Bonds.
    (lambda fe: fe.bond(0, 1, strength=0, energy=1), 'strength is 0'), (lambda fe: fe.bond(0, 1, strength=1, energy=-1), 'energy is -1'),
    (lambda fe: fe.bond(0, 'x', 1, 1), "b is 'x', it must be the number or the name of a body"),
    (lambda fe: fe.bond(0, 2, 1, 1), 'There is no body 2 to bond'), (lambda fe: fe.bond(1, 1, 1, 1), 'cannot be bonded to itself'),
    *[(lambda fe, order=order: fe.bondAll(*order), '^bondAll: tolerance is .* m, but the largest body has only 1 m; the order is '
       r'bondAll\(tolerance, strength, energy\)') for order in ((1e6, 10, 1e-3), (10, 1e6, 1e-3))],
    (lambda fe: yadefrag.snapOutlines([[(0, 0), (1, 0)]], 1.), r'shapes\[0\]'),
    (lambda fe: yadefrag.snapOutlines(TOUCHING[:1], 0), 'tolerance is 0, it must be a positive number'),
    (lambda fe: yadefrag.snapOutlines(TOUCHING, .1), 'would collapse'),
    # Meshes.
    (lambda fe: fe.addMesh((1, 2, 3), 'm'), r'it must be a Mesh, the MeshFile of readMesh, or a pair'),
    (lambda fe: fe.addMesh((square(5), [(0, 1, 4)]), 'm'), 'triangles has node numbers from 0 to 4'),
    (lambda fe: fe.addMesh((square(5), [(0, 1, 2)]), 'm'), 'node 3 belongs to no triangle'),
    (lambda fe: fe.addTriangles([(5, 0), (6, 0), (5, 1), (4, 0), (5, -1)], [(0, 1, 2), (0, 3, 4)], 'm'), 'passes twice through node 0'),
    (lambda fe: fe.addMesh((square(5), [(0, 2, 1), (0, 1, 3)]), 'm'), '(?i)triangle'),
    (lambda fe: fe.addMesh(yadefrag.polygonMesh(square(5), size=.4, joints=JOINTS), 'hard', jointStrength=[1, 2]),
     'jointStrength has 2 values, it must have one for each of the 3 joints'),
    (lambda fe: yadefrag.polygonMesh(square(5), size=.4, jointTolerance=-1), 'jointTolerance is -1'),
    (lambda fe: yadefrag.Mesh(square(5), [(0, 1.5, 2)]), r'triangles must be an array \(m, 3\)'),
    # The scene and its pictures.
    *[(lambda fe, wrong=wrong: yadefrag.engines(fe, spheres=True, gravity=(0, -1), **wrong),
       '^%s is .* it must be None, or a class derived from ' % next(iter(wrong))) for wrong in (
        dict(loop=w.NewtonIntegrator), dict(integrator=w.InteractionLoop), dict(collider=w.CurveLoop))],
    *[(lambda fe, wrong=wrong: yadefrag.engines(fe, **wrong), '%s is ' % next(iter(wrong))) for wrong in (
        dict(gravity=(0, 0, -9.81)), dict(gravity=(1,)), dict(damping=HUGE))],
    *[(lambda fe, wrong=wrong: yadefrag.inCurveOrder([(0, 0, 0), wrong]), r'bodies\[1\]') for wrong in (
        (1, 2), (1, 2, NAN), 'abc', 3, None, (1, 2, 3, 4), ((1, 2, INF), .1))],
    (lambda fe: yadefrag.plotMesh(fe, 'mises', limits=('a', 1)), 'limits is'), (lambda fe: yadefrag.plotMesh(fe, scale=-1), 'scale is -1'),
    *[(lambda fe, table=table: table(fe, 'a.txt'), r"its name must end with '\.csv'") for table in (yadefrag.crackTable, yadefrag.fragmentTable)],
    *[(lambda fe, change=change: yadefrag.animate(fe, **{'file': 'a.gif', 'steps': 10, 'every': 5, **change}), words)
      for change, words in ((dict(steps=0), 'steps is 0'), (dict(window=((0, 0), 1)), 'window is'), (dict(rate=0), 'rate is 0'),
                            (dict(file='a.avi'), "must end with '.gif'"), (dict(field='none'), "field is 'none'"),
                            (dict(field=[1, 2]), 'field is an array'))],
    *[(lambda fe, functors=functors: w.LebesgueCollider(functors), 'it must be a list of bound functors')
      for functors in ([None], [3], 3, [w.FEMat()], None)],  # YADE itself would end the process for None in the list
]
# The call itself: TypeError.
ARGUMENTS = [
    (lambda fe: fe.addPolygon(),
     'addPolygon needs outline, size and material: addPolygon(outline, size=..., material=...).'),
    (lambda fe: fe.addPolygon(square(5), size=.5), 'addPolygon needs material'),
    (lambda fe: fe.addPolygon(square(5), .5, 'm', size=.5), 'addPolygon has size twice, by position and by name.'),
    (lambda fe: fe.addPolygon(square(5), .5, 'm', True), 'addPolygon takes outline, size and material'),
    (lambda fe: fe.addPolygon(square(5), sise=.5, material='m'), "addPolygon has no argument 'sise', but size."),
    (lambda fe: fe.bond(0, 1, 1e6), 'bond needs energy: bond(a, b, strength, energy).'),
    (lambda fe: fe.bond(0, 1, 1e6, 1, 2, 3, 4), 'bond takes a, b, strength and energy, but 7 are given'),
    (lambda fe: fe.prescribe(vx=1), 'prescribe needs nodes'),
    (lambda fe: fe.removeBody(), 'removeBody needs component: removeBody(component).'),
    (lambda fe: fe.criticalTimeStep(3), 'criticalTimeStep takes no arguments'),
    (lambda fe: fe.fragments(hold=True), "fragments has no argument 'hold', but held."),
    (lambda fe: yadefrag.rectangle(0, 0, 1, 1), 'rectangle takes low and high, but 4 are given: rectangle(low, high)'),
    (lambda fe: yadefrag.plotMesh(), 'plotMesh needs fe: plotMesh(fe).'),
    (lambda fe: yadefrag.plotMesh(fe, feild='speed'), "plotMesh has no argument 'feild', but field."),
    (lambda fe: w.FEMat(1e9), 'FEMat takes no arguments by position'),
    (lambda fe: w.FESolver(2), 'FESolver takes no arguments by position'),
    (lambda fe: yadefrag.Mesh(square(5)), 'Mesh needs triangles: Mesh(nodes, triangles).'),
    (lambda fe: fe.addMesh(square(5)), 'addMesh needs material: addMesh(mesh, material).'),
    (lambda fe: fe.addMesh(square(5), 'm', spinn=1), "addMesh has no argument 'spinn', but spin."),
    (lambda fe: fe.addTriangles(square(5), [(0, 1, 2)], 'hard', jointStrength=0),
     "addTriangles has no argument 'jointStrength'"),
]


def test_calls():
    solver = bodies()
    for call, sentence in CALLS:
        assertRefused(solver, lambda: call(solver), sentence, ValueError)  # noqa: B023
    for call, sentence in ARGUMENTS:
        assertRefused(solver, lambda: call(solver), re.escape(sentence), TypeError)  # noqa: B023
    assert tuple(solver.gravity) == (0, 0, 0) and solver.takesGravity and O.iter == 0
    steps(2)
    assert not solver.reactions.any() and solver.energy['external'] == solver.energy['damping'] == 0
    assert solver.bond(0, 1, 1e6, 1e6) > 0
