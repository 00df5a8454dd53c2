"""What is refused, as in test_refused.py: constants of materials, curves, attributes, scenes and steps; and what selects
nothing. The patterns are those of `re`."""
import re
import warnings

import numpy as np
import pytest

import yadefrag
from fe_scene import FAILS, fe, finder, heard, impact, O, run, STEEL, steps
from test_refused import added, HUGE, INF, NAN, sentenceOf
from yade import wrapper as w

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
        ([(1, 1), (.5, 2)], '^rateEffect has the strain rate 0.5 1/s after 1 1/s; these must increase'),
        ([(1, 1), (2, .5)], '^rateEffect has the factor 0.5; factors must be from 1, the strength of a slow test, to 1000'),
        ([(-1, 1), (2, 2)], '^rateEffect has the strain rate -1 1/s; these must be positive'),
        ([(1, 1), (NAN, 2)], 'these must be positive and finite'), ([(1, 1), (2, NAN)], '^rateEffect has the factor nan')]),
    ('speedEffect', w.BrittleFEMat, ValueError, [
        ('glass', "^speedEffect is 'glass'; it must be 'none', or a list of points"), ([], '^speedEffect has no points'),
        ([(2, 1), (1, 2)], '^speedEffect has the speed 1 m/s after 2 m/s; these must increase'),
        ([(1, .5), (2, 2)], '^speedEffect has the factor 0.5; factors must be from 1, the energy of a slow crack, to 1000')]),
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


# --- a scene in which a body cannot be

def test_scenes():
    O.periodic = True
    assert 'periodic' in sentenceOf(lambda: added(fe()))
    O.reset()
    assert 'is lost in the rounding of coordinates' in sentenceOf(lambda: added(fe(), 1e14))
    O.reset()
    impact('LebesgueCollider')
    assert 'another FESolver' in sentenceOf(lambda: added(w.FESolver()))


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


def test_withoutBodies(folder):
    made = w.FESolver()
    O.engines, O.dt = [made], 1
    steps(2)
    assert made.criticalTimeStep() == made.minAngle == INF
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
            ('rough', "'rough'"), (0, '0'), (-1e-3, '-0.001'), (.2, '0.2'), (NAN, 'nan'),
            ('x' * 99, 'a text of 99 bytes'))],
        *[(wrong, "%s, it must be 'fine', 'default', 'coarse' or a number." % (wrong,)) for wrong in ((1,), None)]],
    'minFragmentArea': [(wrong, 'it must be positive') for wrong in (-1, NAN, INF)],
    'maxCracks': [(-2, 'FESolver.maxCracks is -2')],
    'halo': [(-.1, ''), (.6, ''), (NAN, ''), ('wide', "FESolver.halo is 'wide', it must be a number."),
             (HUGE, 'FESolver.halo is 1000000000...00000000000, it must be a number.')],
    'view': [('stress', "FESolver.view is 'stress', it must be 'component', 'fragment' or 'mises'.")],
    'damping': [(-1, '')], 'linearViscosity': [(-1, ''), (1e160, 'FESolver.linearViscosity is 1e+160, it must be 0 or pos')],
    'quadraticViscosity': [(-1, ''), (1e160, '')],
    'gravity': [((NAN, 0, 0), ''), ((0, 0, -9.8), ''), ((0,), 'FESolver.gravity is (0,), it must be two or three numbers.')],
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
    **{'dt %s' % dt: (lambda s, dt=dt: setattr(O, 'dt', dt), STEP) for dt in (0, NAN, INF, 1)},
    'a little above': (lambda s: setattr(O, 'dt', 1.01 * s.criticalTimeStep()), STEP),
    'twice': (lambda s: setattr(O, 'engines', [*O.engines, s]), 'same FESolver more than once'),
    'periodic': (lambda s: setattr(O, 'periodic', True), 'periodic'),
    'position': (lambda s: setattr(O.bodies[3].state, 'pos', (NAN, 0, 0)), 'Body #3 is at .*not finite'),
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
        added(made, 2 * k, fixed=lambda x, y: 2 * low < x < 2 * low + .5)
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
