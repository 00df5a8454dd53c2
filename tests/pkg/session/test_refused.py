"""What a script gives wrongly to functions and methods is refused with one sentence that names the argument, and nothing
has changed: one table, by function and argument. Values of a wrong kind are in test_forms.py, attributes and steps in
test_refused_values.py; files have theirs in test_file_errors.py, what a step finds in test_messages.py."""
import inspect
import math
import re

import numpy as np
import pytest

import api_calls
import yadefrag
from fe_scene import FAILS, fe, O, STEEL, steps
from yade import wrapper as w
from yadefrag.studies import ensemble_runs, tradeoff_grid

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
    """Two bodies that touch, and spheres, after some steps; materials of each kind."""
    solver = api_calls.scene('between')
    for label in ('hard', 'soft'):
        O.materials.append(w.BrittleFEMat(young=2e9, poisson=.2, density=1000, tensileStrength=2e7, label=label))
    for label, more in (('yields', {}), ('fails', FAILS), ('spalls', dict(spallStress=3e9, fractureEnergy=1e4))):
        O.materials.append(w.PlasticFEMat(**STEEL, **more, label=label))
    return solver


def assertRefused(solver, call, sentence, *kinds):
    """`sentence` is a pattern of `re`."""
    before = api_calls.state(solver)
    text = sentenceOf(call, *kinds)
    assert re.search(sentence, text), (sentence, text)
    assert api_calls.state(solver) == before, text


def everywhere(x, y):
    return True


def local(_):
    """A scene that is not in the module of its name."""


local.__name__ = 'elsewhere'

# --- {function: {argument: [(value, sentence)]}}

JOINT = [((5.3, .5), (5.7, .5))]
JOINTS = [((5.2, .2), (5.8, .7)), ((5.1, .9), (5.9, .1)), ((5.5, -1), (5.5, .3))]
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
    'size': [(0, 'size is 0, it must be a positive number'), (2e-5, 'Size 2e-05 m would give about'),
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
    'velocity': [(lambda x, y: (x, INF), r'velocity\(.*both numbers must be finite'),
                 ((1e160, 0), r'velocity is 1e\+160 m/s; it must be at most 1e100 m/s')],
    'spin': [(INF, 'spin is inf')],
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

LINE = [(0, 0), (1, 0)]
TOUCHING = [[(0, 0), (1, 0), (1, 1)], [(1, 0), (1.01, 0), (1, .01)]]
ANVIL = "component is 'anvil'"
CROSSING = [(0, 0), (1, 1), (1, 0), (0, 1)]
FAR = [(1e17, 1e17), (1e17 + 64, 1e17), (1e17, 1e17 + 64)]
UNIT = yadefrag.rectangle((0, 0), (1, 1))
REFUSED = {
    'addPolygon': ADDED,
    'addMesh': {
        'mesh': [((1, 2, 3), 'it must be a Mesh, the MeshFile of readMesh, or a pair'),
                 ((square(5), [(0, 1, 4)]), 'triangles has node numbers from 0 to 4'),
                 ((square(5), [(0, 1, 2)]), 'node 3 belongs to no triangle'),
                 ((square(5), [(0, 2, 1), (0, 1, 3)]), '(?i)triangle')],
        'jointStrength': [(dict(mesh=yadefrag.polygonMesh(square(5), size=.4, joints=JOINTS), material='hard', jointStrength=[1, 2]),
                           'jointStrength has 2 values, it must have one for each of the 3 joints')]},
    'addTriangles': {'nodes': [(dict(nodes=[(5, 0), (6, 0), (5, 1), (4, 0), (5, -1)], triangles=[(0, 1, 2), (0, 3, 4)]),
                                'passes twice through node 0'),
                               ([(5, 5, 1), (6, 5, 2), (6, 6, 3)], r'^nodes must be a list of points \(x, y\) in m')]},
    # Loads and motions.
    'pressure': {'nodes': [([4], 'No side of the boundary'), ([99], 'there are')],
                 'p': [([(1, 0), (0, 0)], 'times of a pressure must ascend')]},
    'absorb': {'nodes': [([4], 'No side of the boundary'), ('rim', "component is 'rim'")]},
    'relax': {'tolerance': [(0, 'tolerance is 0')], 'most': [(0, 'most is 0')]},
    'setLoads': {'loads': [(np.zeros((3, 2)), '3 loads'), (np.zeros(3), r'must be \(n, 2\)'), ([[0, INF]] * 19, 'not finite')]},
    'prescribe': {
        'nodes': [([99999], 'there are'), ([True], 'one for each'), ([.5], 'node numbers'),
                  ('anvil', "component is 'anvil', it must be the number or the name")],
        'vx': [(dict(nodes=[0, 1], vx=[1., 2., 3.]), 'vx has 3 values, it must have one for each of the 2'),
               ([(0, 1), (0, 2)], 'times of a motion must ascend'), ([(0, NAN)], 'must be finite|its values be finite'),
               (dict(nodes=[0, 1], vx=[1., 2.], vy=[(0, 1)]), 'vx is an array, but the other')]},
    'rotate': {'nodes': [(7, 'component is 7, which is no body'), ([99], 'there are')]},
    # Queries.
    'nodesOf': {'component': [('anvil', ANVIL)]},
    'removeBody': {'component': [('anvil', ANVIL), (2, '^component is ')]},
    'reaction': {'nodes': [('anvil', ANVIL), ([99], 'but there are')]},
    'contactForce': {'a': [('anvil', "a is 'anvil', it must be the number or the name")], 'b': [(9, 'b is 9, which is no body')]},
    'meshQuality': {'component': [(3, 'component is 3'), ('anvil', ANVIL)]},
    # Bonds.
    'bond': {'strength': [(0, 'strength is 0')], 'energy': [(-1, 'energy is -1')],
             'b': [('x', "b is 'x', it must be the number or the name of a body"), (2, 'There is no body 2 to bond'),
                   (0, 'cannot be bonded to itself')]},
    'bondAll': {'tolerance': [
        (dict(tolerance=tolerance, strength=strength, energy=energy), '^bondAll: tolerance is .* m, but the largest body has only '
         r'1.* m; the order is bondAll\(tolerance, strength, energy\)') for tolerance, strength, energy in ((1e6, 10, 1e-3), (10, 1e6, 1e-3))]},
    # Outlines and meshes.
    'rectangle': {'high': [((0, 1), r'high is \(0, 1\).* low')]},
    'circle': {'centre': [((0, INF), 'centre is .*inf.* finite')], 'radius': [(0, 'radius is 0, .*positive')], 'n': [(2, 'n is 2, .*at least 3')]},
    'ring': {'inner': [(2, 'inner is 2 m, .*less than outer'), (-1, 'inner is -1, .*positive')]},
    'voronoi': {'outline': [(LINE, 'outline has 2 points'), (CROSSING, 'outline.*vertex|vertex.*outline'),
                            ([(0, 0), (1, 1), (1 + 1e-9, 1)], 'no room for 3 grains'), (dict(outline=FAR, n=50), 'too far from the origin')],
                'n': [(0, 'n is 0, .*positive whole'), (10**6, 'n is 1000000, .*at most')],
                'shortest': [(-1, 'shortest is -1, .*0 or a'), (dict(outline=UNIT, n=30, shortest=.8), 'shortest is 0.8 m, too long for these')]},
    'grainJoints': {'grains': [([[(0, 0)]], r'grains\[0\].* 1 points')]},
    'snapOutlines': {'shapes': [([LINE], r'shapes\[0\]')], 'tolerance': [(0, 'tolerance is 0, it must be a positive number'),
                                                                         (dict(shapes=TOUCHING, tolerance=.1), 'would collapse')]},
    'polygonMesh': {'jointTolerance': [(-1, 'jointTolerance is -1')]},
    'outlineReport': {
        'outline': [(LINE, 'outline has 2 points, it must have at least 3'),
                    ([(0, 0), (0, 0), (1, 0), (0, 1)], r'touches itself at \(0, 0\)'),
                    ([(0, 0), (1, 0), (1, 1), (.5, 0)], r'touches itself at \(0.5, 0\)')],
        'size': [(0, 'size is 0, it must be a positive number')], 'simplify': [(1, 'could vanish')],
        'material': [('wood', "material is 'wood', which is not in O.materials")]},
    'readOutline': {'scale': [(0, 'scale is 0, it must be a positive number')], 'gap': [(-1, 'gap is -1, it must be a positive number')],
                    'leastArea': [(-1, 'leastArea is -1, it must be 0 or a positive')]},
    # The scene and its pictures.
    'engines': {name: [(dict(spheres=True, gravity=(0, -1), **{name: wrong}), '^%s is .* it must be None, or a class derived from ' % name)]
                for name, wrong in (('loop', w.NewtonIntegrator), ('integrator', w.InteractionLoop), ('collider', w.CurveLoop))},
    'inCurveOrder': {'bodies': [([(0, 0, 0), wrong], r'bodies\[1\]') for wrong in (
        (1, 2), (1, 2, NAN), 'abc', 3, None, (1, 2, 3, 4), ((1, 2, INF), .1))]},
    'runSteps': {'steps': [(0, 'steps is 0')]},
    'plotMesh': {
        'field': [('heat', "field is 'heat', it must be one of 'displacement'"), ([1, 2, 3], r'shape \(3,\).*\d triangles or of the \d+ nodes\.')],
        'ylim': [((1, 0), r'ylim is \(1, 0\), it must be a pair of numbers \(m\), the lower one first')], 'scale': [(-1, 'scale is -1')]},
    'severalFields': {
        'fields': [([], r'fields is \[\], it must be a list of 1 to 12'), ('xx', "fields is 'xx', it must be a list"),
                   (['xx', 'zx'], "field is 'zx', it must be one of"), (dict(field='yy'), 'fields comes with field or ax')],
        'limits': [([(0, 1)], 'a list with a pair or None for each of the 2 fields')]},
    'animate': {'steps': [(0, 'steps is 0')], 'rate': [(0, 'rate is 0')], 'file': [('a.avi', "must end with '.gif'")],
                'field': [('none', "field is 'none'"), ([1, 2], 'field is an array')]},
    **{name: {'file': [('a.txt', "its name must end with '.%s'" % ending)]}
       for name, ending in (('crackTable', 'csv'), ('fragmentTable', 'csv'), ('exportVTK', 'vtu'))},
    'FERecorder': {'file': [('', 'file is ')], 'fields': [(['heat'], "'heat'")], 'virtPeriod': [(HUGE, r"A setting of FERecorder is too large: .'virtPeriod'")]},
    # Studies.
    'tradeoff': {
        'vary': [*[({name: [wrong]}, words) for name, wrong, words in (
            ('passes', 3, 'passes=3, it must be 1 or 2'), ('passes', True, 'passes=True, it must be 1 or 2'),
            ('contactTolerance', 'rough', "contactTolerance='rough', it must be 'fine', 'default'"),
            ('contactTolerance', 1., 'contactTolerance=1.0, it must be'), ('smooth', 1, 'smooth=1, it must be True or False'),
            ('size', 0., 'size=0.0, it must be a positive length'), ('timeStep', -1, 'timeStep=-1, it must be a positive fraction'),
            ('halo', .6, 'halo=0.6, it must be a fraction'), ('collider', 'Sweep', "collider='Sweep', it must be 'none' or one of 'Leb"),
            ('verletDist', 'far', "verletDist='far', it must be a length"), ('plane', 'strained', "plane='strained', it must be 'strain' or"),
            ('bulkViscosity', -1, 'bulkViscosity=-1, it must be 0 or a positive'),
            ('fracture', 'brittle', "fracture='brittle', it must be 'none', 'instant'"),
            ('threads', 10**6, 'threads=1000000, it must be a whole number from 1 to'),
            ('own', [1, 2], r'own=\[1, 2\], it must be a number, a text'), ('wall', 1, "the choice 'wall', a name must be"))],
            *[({'passes': wrong}, r"vary\['passes'\] is .*, it must be a list") for wrong in (1, [])],
            ('passes', "vary is 'passes', it must be a dict")],
        'scene': [(wrong, 'scene is .*at the top level of a file') for wrong in (lambda c: None, local)],
        'measure': [(yadefrag.rectangle, 'they must be in one file')],
        'duration': [(0, r'duration is 0, it must be a positive number \(s\)')], 'every': [(-1., 'every is -1.0, it must be')],
        'repeats': [(0, 'repeats is 0, it must be a positive whole number')],
        'reference': [('nowhere.txt', "reference is 'nowhere.txt', which is not a file of numbers"),
                      (NAN, 'reference is nan, it must be finite numbers'), ({'passes': 3}, 'passes=3, it must be 1 or 2')]},
    'ensemble': {
        'runs': [(0, 'runs is 0, it must be a positive whole number'), ([], r'runs is \[\], it must be a number of runs'),
                 ('three', "runs is 'three', it must be a number of runs"),
                 ([1.5], 'runs has the seed 1.5, it must be a whole number, or a dict'),
                 ({'seed': [1, 2], 'a': [1]}, 'a dict of lists that have all the same length'),
                 ([dict(value=1)], "runs has the choice 'value', a name must be a text that is no other"),
                 ([dict(passes=3)], 'passes=3, it must be 1 or 2'), ([dict(a=[1])], r'runs has the choice a=\[1\], it must be a number')],
        'executor': [(3, 'executor is 3, it must be None, or an executor with a method submit')],
        'workers': [(0, 'workers is 0, it must be a positive whole number')],
        'resume': [('a.txt', "resume is 'a.txt', its name must end with '.jsonl'")]},
}


@pytest.mark.parametrize('name, argument', [(name, argument) for name in REFUSED for argument in REFUSED[name]])
def test_refused(name, argument, folder, monkeypatch):
    """A dict of arguments is that. Nothing is left of the calls: steps have the same bits as without them."""
    for runs in ((tradeoff_grid, '_runAll'), (ensemble_runs, '_run')):
        monkeypatch.setattr(*runs, lambda *_: pytest.fail('it has run'))
    found = []
    for rows in ((), REFUSED[name][argument]):
        solver = bodies()
        api_calls.exampleFiles(solver, folder)
        call, _, right = api_calls.calls(solver, folder)[name]
        if name == 'addPolygon':
            right = {**dict(outline=square(5), size=.5, material='m'), **WITH.get(argument, {})}
        known = inspect.signature(call).parameters
        for value, sentence in rows:
            given = value if isinstance(value, dict) and set(value) <= set(known) else {argument: value}
            assertRefused(solver, lambda: call(**{**right, **given}), sentence, ValueError)  # noqa: B023
        steps(2)
        found.append((api_calls.state(solver), solver.reactions.any()))
    assert found[0] == found[1]


def test_memory():
    text = sentenceOf(lambda: fe().addPolygon(yadefrag.rectangle((0, 0), (1e4, 1e4)), size=.35, material='m'))
    assert 'would give about 1.885e+09 triangles, which take about' in text and 'm would fill it' in text


# --- functions of a script

def test_functionsWithAWrongNumberOfArguments():
    solver = bodies()
    calls = {name: lambda f, name=name: added(solver, 5, **{'material': 'hard', name: f}) for name in
             ('fixed', 'size', 'velocity', 'displacement', 'stress', 'material', 'strength')}
    calls['nodes'] = lambda f: solver.prescribe(f, vx=0)
    for name, call in calls.items():
        for wrong in (lambda p: 0, lambda: 0, lambda x, y, z: 0):
            assertRefused(solver, lambda: call(wrong), re.escape(  # noqa: B023
                '%s is a function that cannot be called as %s(x, y): it must take 2 arguments.' % (name, name)), TypeError)
    assertRefused(solver, lambda: solver.prescribe([0], vy=lambda t: 0),
                  r'vy is a function that cannot be called as vy\(x, y, t\): it must take 3', TypeError)
    assertRefused(solver, lambda: solver.pressure(everywhere, lambda x, y: 0),
                  r'p is a function that cannot be called as p\(t\): it must take one argument', TypeError)


def test_errorsWithinAFunctionAreThoseOfTheScript():
    for settings, words in ((dict(fixed=lambda x, y: len(x) < 0), 'has no len'), (dict(velocity=lambda x, y: (x + None, 0)), 'NoneType')):
        with pytest.raises(TypeError, match=words):
            added(fe(), **settings)


# --- classes, and the call itself: TypeError

CLASSES = [
    (lambda: yadefrag.Mesh(square(5), [(0, 1.5, 2)]), r'triangles must be an array \(m, 3\)'),
    *[(lambda functors=functors: w.LebesgueCollider(functors), 'it must be a list of bound functors')
      for functors in ([None], [3], 3, [w.FEMat()], None)],  # YADE itself would end the process for None in the list
]
ARGUMENTS = [
    (lambda fe: fe.addPolygon(),
     'addPolygon needs outline, size and material: addPolygon(outline, size=..., material=...).'),
    (lambda fe: fe.addPolygon(square(5), size=.5), 'addPolygon needs material'),
    (lambda fe: fe.addPolygon(square(5), .5, 'm', size=.5), 'addPolygon has size twice, by position and by name.'),
    (lambda fe: fe.addPolygon(square(5), .5, 'm', True), 'addPolygon takes outline, size and material'),
    (lambda fe: fe.addPolygon(square(5), sise=.5, material='m'), "addPolygon has no argument 'sise', but size."),
    (lambda fe: fe.bond(0, 1, 1e6), 'bond needs energy: bond(a, b, strength, energy).'),
    (lambda fe: fe.bond(0, 1, 1e6, 1, 2, 3, 4), 'bond takes a, b, strength and energy, but 7 are given'),
    (lambda fe: fe.removeBody(), 'removeBody needs component: removeBody(component).'),
    (lambda fe: fe.criticalTimeStep(3), 'criticalTimeStep takes no arguments'),
    (lambda fe: fe.fragments(hold=True), "fragments has no argument 'hold', but held."),
    (lambda fe: yadefrag.rectangle(0, 0, 1, 1), 'rectangle takes low and high, but 4 are given: rectangle(low, high)'),
    (lambda fe: yadefrag.plotMesh(fe, feild='speed'), "plotMesh has no argument 'feild', but field."),
    (lambda fe: w.FEMat(1e9), 'FEMat takes no arguments by position'),
    (lambda fe: yadefrag.Mesh(square(5)), 'Mesh needs triangles: Mesh(nodes, triangles).'),
    (lambda fe: fe.addMesh(square(5)), 'addMesh needs material: addMesh(mesh, material).'),
    (lambda fe: fe.addTriangles(square(5), [(0, 1, 2)], 'hard', jointStrength=0),
     "addTriangles has no argument 'jointStrength'"),
]


def test_classesAndCalls():
    solver = bodies()
    for call, sentence in CLASSES:
        assertRefused(solver, call, sentence, ValueError)
    for call, sentence in ARGUMENTS:
        assertRefused(solver, lambda: call(solver), re.escape(sentence), TypeError)  # noqa: B023
