"""What a script gives wrongly is refused with one sentence that names the argument, and nothing has changed: tables by
argument; more of them in test_refused_values.py. Files have theirs in test_file_errors.py, steps in test_messages.py."""
import math
import warnings

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, impact, O, steps
from yade import wrapper as w

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def solver():
    """With an elastic material 'm' and a brittle one 'b'."""
    O.materials.append(w.BrittleFEMat(young=1e9, tensileStrength=1e6, fractureEnergy=1e4, label='b'))
    return fe()


def added(made, low=(0, 0), **settings):
    x, y = low
    return made.addPolygon(yadefrag.rectangle((x, y), (x + 1, y + 1)), **{**dict(size=.5, material='m'), **settings})


def sentenceOf(call, *kinds):
    with pytest.raises(kinds or (ValueError, TypeError)) as error:
        call()
    text = str(error.value)
    assert text.endswith('.') and '. ' not in text and '\n' not in text and len(text) <= 400, text
    return text


# --- adding a body: argument: {value: sentence}

HUGE = 10**400
POLYGON = {
    'outline': [([(0, 0), (1, 0)], 'outline has 2 points'), ([(0, 0), (1, 1), (1, 0), (0, 1)], 'outline'),
                ([(0, 0), (1, math.nan), (1, 1)], 'outline has a point 1'), ('flat', 'outline must be a list of points'),
                ([(0, 0, 0), (1, 0, 0), (1, 1, 0)], 'outline must be a list of points'),
                (SQUARE + SQUARE[:1], 'a loop closes by itself'), ([(0, 0), (1, 0), (2, 0)], 'must enclose an area')],
    'holes': [([[(0, 0), (1,)]], 'holes[0] must be a list of points'), (3, 'holes is 3, it must be a list of loops'),
              (None, 'holes is None'), ([(.2, .2), (.4, .2), (.4, .4)], 'holes[0] must be a list of points'),
              ([[(2, 2), (3, 2), (3, 3)]], 'holes must be inside')],
    'size': [(0, 'size is 0, it must be a positive number'), ('big', "size is 'big'"), (math.nan, 'size is nan'),
             (1e-5, 'Size 1e-05 m would give about 2.309e+10 triangles; a mesh can have'), (HUGE, 'size is 1000'),
             (2e-5, 'Size 2e-05 m would give about')],
    'material': [('none', "material is 'none', which is not in O.materials"), (.5, 'material is 0.5'),
                 (None, 'material is None'), (7, 'material is 7, which is not in O.materials'),
                 (10**30, 'which is not in O.materials'), (w.FrictMat(), 'must be an FEMat'),
                 *[(w.FEMat(**{name: value}), name + ' is ') for name, value in (
                     ('young', 0), ('young', -1), ('young', math.nan), ('poisson', .5), ('density', -1), ('density', 0),
                     ('frictionAngle', 2))]],
    'smooth': [([True], 'smooth has 1 flags, it must have one for each of the 4 points'), (3, 'smooth is 3'),
               (None, 'smooth is None')],
    'velocity': [(1, 'velocity is 1, it must be a pair'), ((1, 2, 3), 'velocity is (1, 2, 3), it must be a pair'),
                 ((1, math.nan), 'both numbers must be finite'), ((HUGE, 0), 'both numbers must be finite'),
                 (lambda x, y: (x, math.inf), 'both numbers must be finite'),
                 ((1e160, 0), 'velocity is 1e+160 m/s; it must be at most 1e100 m/s')],
    'spin': [('fast', "spin is 'fast'"), (math.inf, 'spin is inf'), (HUGE, 'it must be a finite number')],
    'displacement': [(lambda x, y: x, 'displacement('), (lambda x, y: (-2 * x, 0), 'displacement inverts the triangle at'),
                     (lambda x, y: (-x, 0), 'displacement inverts the triangle at')],
    'fixed': [(True, 'fixed is True, it must be a function'), ('x', "fixed is 'x', it must be a function"),
              (lambda x, y: 'z', "is 'z', it must be False, True, 'x' or 'y'")],
    'thickness': [(-1, 'thickness is -1'), (0, 'thickness is 0'), (math.nan, 'thickness is nan'),
                  (1e300, 'N/m; it must be in the range of ')],
    'selfContact': [(1, 'selfContact is 1, it must be True or False')],
    'element': [('quadratic', "element is 'quadratic', it must be 'linear' or 'smoothed'")],
    'mesh': [('lattice', "mesh is 'lattice', it must be 'regular', 'irregular' or None")],
    'strength': [(lambda x, y: 1, 'are given, but the material neither cracks nor fails; it must be a')],
    'fractureEnergy': [([1.], 'are given, but the material neither cracks nor fails')],
    'stress': [((-1e7, 0, 0), 'would be strained by more than half')],
    'simplify': [(0, 'simplify is 0, it must be a positive number (m)'), ('rough', "simplify is 'rough'"),
                 (.25, 'simplify is 0.25 m, but the outline could vanish; it must be less than')],
}


@pytest.mark.parametrize('argument', POLYGON)
def test_polygon(argument):
    for value, sentence in POLYGON[argument]:
        O.reset()
        made = fe()
        assert sentence in sentenceOf(lambda: added(made, **{argument: value}) if argument != 'outline' else  # noqa: B023
                                      made.addPolygon(value, size=.5, material='m')), value  # noqa: B023
        assert len(O.bodies) == len(made.nodes) == 0


def test_memory():
    text = sentenceOf(lambda: fe().addPolygon(yadefrag.rectangle((0, 0), (1e4, 1e4)), size=.35, material='m'))
    assert 'would give about 1.885e+09 triangles, which take about' in text and 'm would fill it' in text


ARITY = {
    **{name: lambda s, f, name=name: added(s, **{name: f}) for name in
       ('fixed', 'size', 'velocity', 'displacement', 'stress', 'material')},
    'strength': lambda s, f: added(s, material='b', strength=f), 'nodes': lambda s, f: s.prescribe(f, vx=0)}


@pytest.mark.parametrize('name', ARITY)
def test_functionsWithAWrongNumberOfArguments(name):
    made = solver()
    for wrong in (lambda p: 0, lambda: 0, lambda x, y, z: 0):
        assert sentenceOf(lambda: ARITY[name](made, wrong), TypeError) == (  # noqa: B023
            '%s is a function that cannot be called as %s(x, y): it must take 2 arguments.' % (name, name))
    assert len(O.bodies) == 0


def test_functionsOfTimeWithAWrongNumberOfArguments():
    made = fe()
    added(made)
    assert 'vy is a function that cannot be called as vy(x, y, t): it must take 3' in sentenceOf(
        lambda: made.prescribe([0], vy=lambda t: 0), TypeError)
    assert 'p is a function that cannot be called as p(t): it must take one argument' in sentenceOf(
        lambda: made.pressure(lambda x, y: True, lambda x, y: 0), TypeError)


def test_errorsWithinAFunctionAreThoseOfTheScript():
    with pytest.raises(TypeError, match='has no len'):
        added(fe(), fixed=lambda x, y: len(x) < 0)
    with pytest.raises(TypeError, match='NoneType'):
        added(fe(), velocity=lambda x, y: (x + None, 0))


# --- a scene in which a body cannot be

def test_scenes():
    O.periodic = True
    assert 'periodic' in sentenceOf(lambda: added(fe()))
    O.reset()
    assert 'is lost in the rounding of coordinates' in sentenceOf(lambda: added(fe(), (1e14, 0)))
    assert 'selfContact is False, but' in sentenceOf(lambda: added(solver(), material='b', selfContact=False))
    O.reset()
    made = impact('LebesgueCollider')
    assert 'another FESolver' in sentenceOf(lambda: added(w.FESolver()))
    for component in (2, -1, 'a', None, 1.5, True):
        assert sentenceOf(lambda: made.removeBody(component)).startswith('component is ')  # noqa: B023
    assert len(made.surfaces) == 2


@pytest.mark.parametrize('isLoaded', [False, True])
def test_aSolverOfAnotherScene(isLoaded):
    """Also if the other scene is a saved state of the same one, with bodies of the same numbers."""
    made = impact('LebesgueCollider')
    O.step()
    O.saveTmp()
    O.reset()
    O.materials.append(w.FEMat(label='m'))
    if isLoaded:
        O.loadTmp()
    count = len(O.bodies)
    for call in (lambda: added(made), lambda: made.removeBody(0)):
        with pytest.raises(RuntimeError, match='O.reset, .* this scene needs a new FESolver'):
            call()
    assert len(O.bodies) == count
    assert isLoaded or added(w.FESolver()) == 0


@pytest.mark.parametrize('order', [(1e6, 10, 1e-3), (10, 1e6, 1e-3)])
def test_bondAllWithArgumentsInAnotherOrder(order):
    made = fe()
    added(made), added(made, (0, 1))
    assert sentenceOf(lambda: made.bondAll(*order)) == (
        'bondAll: tolerance is %g m, but the largest body has only 1 m; the order is '
        'bondAll(tolerance, strength, energy).' % order[0])


# --- other functions

WRONG = [
    (lambda s: yadefrag.plotMesh(3), 'fe is 3, it must be an FESolver'), (lambda s: yadefrag.exportVTK(3, 'a.vtu'), 'fe is 3'),
    (lambda s: yadefrag.animate(3, 'a.gif', 2, 1), 'fe is 3'), (lambda s: yadefrag.fragmentTable(3), 'fe is 3'),
    (lambda s: yadefrag.recordFracture(3, 'a.csv'), 'fe is 3'),
    (lambda s: yadefrag.plotMesh(s, 'mises', limits=3), 'limits is 3, it must be a pair'),
    (lambda s: yadefrag.plotMesh(s, 'mises', limits=('a', 1)), 'limits is'),
    (lambda s: yadefrag.plotMesh(s, 'mises', limits=(0, math.nan)), 'limits is'),
    (lambda s: yadefrag.animate(s, 'a.gif', 'a', 1), "steps is 'a', it must be a positive whole"),
    (lambda s: yadefrag.animate(s, 'a.gif', 2.5, 1), 'steps is 2.5'),
    (lambda s: yadefrag.animate(s, 'a.gif', 2, 1, window=3), 'window is 3, it must be'),
    (lambda s: yadefrag.animate(s, 'a.gif', 2, 1, window=((0, 0), 1)), 'window is'),
    (lambda s: yadefrag.animate(s, 'a.gif', 2, 1, limits=3), 'limits is 3'),
    (lambda s: yadefrag.animate(s, 'a.gif', 2, 1, rate='fast'), "rate is 'fast'"),
    *[(lambda s, change=change: yadefrag.animate(s, **{'file': 'a.gif', 'steps': 10, 'every': 5, **change}), words)
      for change, words in ((dict(steps=0), 'steps is 0'), (dict(every=-1), 'every is -1'), (dict(rate=0), 'rate is 0'),
                            (dict(file='a.avi'), "must end with '.gif'"), (dict(field='none'), "field is 'none'"),
                            (dict(field=[1, 2]), 'field is an array'))],
    (lambda s: yadefrag.readPolygon(7), 'file is 7, it must be a path'), (lambda s: yadefrag.readPolygon(None), 'file is None'),
    (lambda s: setattr(s, 'loads', 'much'), "loads is 'much', it must be an array"),
    # The call itself.
    (lambda s: s.addPolygon(), 'addPolygon needs outline, size and material: addPolygon(outline, size=..., material=...).'),
    (lambda s: s.addPolygon(SQUARE, size=.5), 'addPolygon needs material'),
    (lambda s: s.addPolygon(SQUARE, .5, 'm', size=.5), 'addPolygon has size twice, by position and by name.'),
    (lambda s: s.addPolygon(SQUARE, .5, 'm', True), 'addPolygon takes outline, size and material'),
    (lambda s: s.addPolygon(SQUARE, sise=.5, material='m'), "addPolygon has no argument 'sise', but size."),
    (lambda s: s.bond(0, 1, 1e6), 'bond needs energy: bond(a, b, strength, energy).'),
    (lambda s: s.bond(0, 1, 1e6, 1, 2, 3, 4), 'bond takes a, b, strength and energy, but 7 are given'),
    (lambda s: s.prescribe(vx=1), 'prescribe needs nodes'),
    (lambda s: s.removeBody(), 'removeBody needs component: removeBody(component).'),
    (lambda s: s.criticalTimeStep(3), 'criticalTimeStep takes no arguments'),
    (lambda s: s.fragments(hold=True), "fragments has no argument 'hold', but held."),
    (lambda s: yadefrag.rectangle(0, 0, 1, 1), 'rectangle takes low and high, but 4 are given: rectangle(low, high)'),
    (lambda s: yadefrag.plotMesh(), 'plotMesh needs fe: plotMesh(fe).'),
    (lambda s: yadefrag.plotMesh(s, feild='speed'), "plotMesh has no argument 'feild', but field."),
    (lambda s: w.FEMat(1e9), 'FEMat takes no arguments by position'),
    (lambda s: yadefrag.Mesh(SQUARE), 'Mesh needs triangles: Mesh(nodes, triangles).'),
    (lambda s: s.addMesh(SQUARE), 'addMesh needs material: addMesh(mesh, material).'),
    (lambda s: s.addMesh(SQUARE, 'm', spinn=1), "addMesh has no argument 'spinn', but spin."),
    (lambda s: s.addTriangles(SQUARE, [(0, 1, 2)], 'b', jointStrength=0), "addTriangles has no argument 'jointStrength'"),
    (lambda s: w.FESolver(2), 'FESolver takes no arguments by position'),
    *[(lambda s, functors=functors: w.LebesgueCollider(functors), 'it must be a list of bound functors')
      for functors in ([None], [3], 3, [w.FEMat()], None)],  # YADE itself would end the process for None in the list
]


def test_calls():
    made = impact()
    nodes = made.nodes
    for call, sentence in WRONG:
        assert sentence in sentenceOf(lambda: call(made))  # noqa: B023
    assert O.iter == 0 and np.array_equal(made.nodes, nodes)


def test_filesThatCannotBeOpenedAreNamed():
    made = impact()
    for call in (lambda: yadefrag.readPolygon('/nowhere/x'), lambda: yadefrag.plotMesh(made, file='/nowhere/x.png'),
                 lambda: yadefrag.exportVTK(made, '/nowhere/x.vtu')):
        with pytest.raises(FileNotFoundError, match='/nowhere/x'):
            call()


def test_withoutBodies(folder):
    made = w.FESolver()
    O.engines, O.dt = [made], 1
    steps(2)
    assert made.criticalTimeStep() == made.minAngle == math.inf
    assert made.energy['total'] == 0 and made.fragments() == made.surfaces == []
    assert made.nodes.shape == (0, 2) and len(yadefrag.fragmentTable(made)) == 0
    made.prescribe(lambda x, y: True, vx=1)
    for call in (lambda: yadefrag.plotMesh(made), lambda: made.prescribe([0], vx=1),
                 lambda: yadefrag.animate(made, folder + '/a.gif', 2, 1),
                 lambda: yadefrag.exportVTK(made, folder + '/a.vtu'),
                 lambda: yadefrag.plotFragmentSizes(made), lambda: made.removeBody(0),
                 lambda: setattr(made, 'loads', [(0, 1)])):
        with pytest.raises(ValueError, match='no bod|no broken body|0 nodes'):
            call()


# --- attributes: value: sentence, by assignment, by constructor and by updateAttrs

ATTRIBUTES = {
    'passes': [(3, ''), (2.5, 'FESolver.passes is 2.5, it must be a whole number.'),
               (10**30, 'FESolver.passes is 1000000000...00000000000, it must be closer to 0.')],
    'contactTolerance': [
        *[(wrong, 'FESolver.contactTolerance is %s, it must be ' % text) for wrong, text in (
            ('rough', "'rough'"), (0, '0'), (-1e-3, '-0.001'), (.2, '0.2'), (math.nan, 'nan'),
            ('x' * 99, 'a text of 99 bytes'))],
        *[(wrong, "%s, it must be 'fine', 'default', 'coarse' or a number." % (wrong,)) for wrong in ((1,), None)]],
    'minFragmentArea': [(wrong, 'it must be positive') for wrong in (-1, math.nan, math.inf)],
    'maxCracks': [(-2, 'FESolver.maxCracks is -2')],
    'halo': [(-.1, ''), (.6, ''), (math.nan, ''), ('wide', "FESolver.halo is 'wide', it must be a number."),
             (HUGE, 'FESolver.halo is 1000000000...00000000000, it must be a number.')],
    'view': [('stress', "FESolver.view is 'stress', it must be 'component', 'fragment' or 'mises'.")],
    'damping': [(-1, '')], 'linearViscosity': [(-1, ''), (1e160, 'FESolver.linearViscosity is 1e+160, it must be 0 or pos')],
    'quadraticViscosity': [(-1, ''), (1e160, '')],
    'gravity': [((math.nan, 0, 0), ''), ((0, 0, -9.8), ''), ((0,), 'FESolver.gravity is (0,), it must be two or three numbers.')],
    'dead': [('no', "FESolver.dead is 'no', it must be True or False."), (7, 'FESolver.dead is 7, it must be True or False.')],
    'label': [(b'x', "FESolver.label is b'x', it must be a text."), (None, 'FESolver.label is None, it must be a text.')]}


@pytest.mark.parametrize('name', ATTRIBUTES)
def test_attributes(name):
    made = w.FESolver(ompThreads=2)
    before = repr(made.dict())
    for value, sentence in ATTRIBUTES[name]:
        for call in (lambda: setattr(made, name, value), lambda: w.FESolver(**{'ompThreads': 1, name: value}),  # noqa: B023
                     lambda: made.updateAttrs({'ompThreads': 1, name: value})):  # noqa: B023
            text = sentenceOf(call)
            assert text.startswith('FESolver.%s is ' % name) and sentence in text
            assert repr(made.dict()) == before


def test_namesThatDoNotExist():
    for make, sentence in ((lambda: w.FESolver(pases=2), "FESolver has no attribute 'pases', but passes."),
                           (lambda: w.FEMat(yuong=1), "FEMat has no attribute 'yuong', but young.")):
        assert sentenceOf(make, AttributeError) == sentence
    made = w.FESolver()
    for wrong in ({'halo': -1}, {'nope': 1}, {'halo': 'a'}, {'dampng': 3}):
        with pytest.raises((ValueError, TypeError, AttributeError)):
            made.updateAttrs({'passes': 2, **wrong})
        assert made.passes == 1
    with pytest.warns(UserWarning, match="^FESolver has no attribute 'dampng', but damping: it is stored, but has no"):
        made.dampng = 3
    with pytest.warns(UserWarning, match="^FESolver has no attribute 'x': it is stored"):
        made.x = 3
    with warnings.catch_warnings(action='error'):
        made.damping, made.label, made.dead = 3, 'fe', False


def test_aColliderNeedsADispatcher():
    for call in (lambda: w.LebesgueCollider(boundDispatcher=None),
                 lambda: w.LebesgueCollider().updateAttrs({'boundDispatcher': None})):
        with pytest.raises((TypeError, AttributeError), match='boundDispatcher'):
            call()


# --- steps

STEP = r'^O.dt: The time step is .* s, but must be above 0 and at most .* s, the critical step of the present mesh.$'
SPOILED = {
    **{'dt %s' % dt: (lambda s, dt=dt: setattr(O, 'dt', dt), STEP) for dt in (0, math.nan, math.inf, 1)},
    'a little above': (lambda s: setattr(O, 'dt', 1.01 * s.criticalTimeStep()), STEP),
    'twice': (lambda s: setattr(O, 'engines', [*O.engines, s]), 'same FESolver more than once'),
    'periodic': (lambda s: setattr(O, 'periodic', True), 'periodic'),
    'force': (lambda s: O.forces.setPermF(0, (math.nan, 0, 0)), 'a force or a velocity that is not finite'),
    'position': (lambda s: setattr(O.bodies[3].state, 'pos', (math.nan, 0, 0)), 'Body #3 is at .*not finite'),
    'gravity': (lambda s: setattr(s, 'gravity', (1e300, 0, 0)), 'leaves the range of numbers; loads, gravity or ')}


@pytest.mark.parametrize('name', SPOILED)
def test_steps(name):
    made = impact('LebesgueCollider')
    before, good = made.nodes, O.dt
    spoil, sentence = SPOILED[name]
    spoil(made)
    with pytest.raises((ValueError, RuntimeError), match=sentence):
        O.step()
    assert np.abs(made.nodes - before).max() < 1e-15
    if sentence is STEP:
        with pytest.raises(RuntimeError, match=r'^The run stopped in step 0: O.dt: The time step is .* s, but must be'):
            yadefrag.runSteps(3)
        O.dt = good
        assert yadefrag.runSteps(3) == 3
