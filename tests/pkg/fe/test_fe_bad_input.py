"""What a newcomer types wrongly at an FESolver: one sentence, and the scene as it was."""
import builtins
import math
import warnings

import numpy as np
import pytest

import yadefrag
from fe_scene import fe, finder, impact, run, steps
from yade import wrapper as w

O = builtins.O


def test_timeStepAboveTheCriticalOne():
    solver = impact('LebesgueCollider')
    critical = solver.criticalTimeStep()
    O.dt = 1.01 * critical
    before = solver.nodes
    with pytest.raises((ValueError, RuntimeError)) as error:
        O.step()
    assert '%.6g' % O.dt in str(error.value) and '%.6g' % critical in str(error.value)
    assert np.array_equal(solver.nodes, before)
    O.dt = .9 * critical
    steps(3)


kSquare = [(0, 0), (1, 0), (1, 1), (0, 1)]


@pytest.mark.parametrize('wrong, sentence', [
    (dict(outline=[(0, 0), (1, 0)]), 'outline has 2 points'),
    (dict(outline=[(0, 0), (1, 1), (1, 0), (0, 1)]), '.'),
    (dict(outline=[(0, 0), (1, math.nan), (1, 1)]), 'outline has a point 1'),
    (dict(holes=[[(0, 0), (1,)]]), r'holes\[0\] must be a list of points'),
    (dict(size=0), 'size is 0, it must be a positive number'),
    (dict(size='big'), "size is 'big'"),
    (dict(material='none'), "material is 'none', which is not in O.materials"),
    (dict(material=0.5), 'material is 0.5'),
    (dict(smooth=[True]), 'smooth has 1 flags, it must have one for each of the 4 points'),
    (dict(smooth=3), 'smooth is 3'),
    (dict(velocity=1), 'velocity is 1, it must be a pair'),
    (dict(velocity=lambda x, y: (x, math.inf)), r'velocity\(.*both numbers must be finite'),
    (dict(spin='fast'), "spin is 'fast'"),
    (dict(displacement=lambda x, y: x), r'displacement\('),
    (dict(fixed=True), 'fixed is True, it must be a function'),
    (dict(fixed=lambda x, y: 'z'), r"fixed\(.*is 'z', it must be False, True, 'x' or 'y'"),
    (dict(thickness=-1), 'thickness is -1'),
    (dict(selfContact=1), 'selfContact is 1, it must be True or False'),
    (dict(element='quadratic'), "element is 'quadratic', it must be 'linear' or 'smoothed'"),
    (dict(strength=lambda x, y: 1), 'strength is given, but the material does not crack; it must'),
    (dict(fractureEnergy=[1.]), 'fractureEnergy is given, but the material does not crack'),
    (dict(simplify=0), r'simplify is 0, it must be a positive number \(m\)'),
    (dict(simplify='rough'), "simplify is 'rough', it must be a positive number"),
    (dict(simplify=.25), 'simplify is 0.25 m, but the outline could vanish; it must be less than'),
    (dict(outline=None), 'outline must be a list of points'),
    (dict(outline=[(0, 0, 0), (1, 0, 0), (1, 1, 0)]), 'outline must be a list of points'),
    (dict(outline=kSquare + kSquare[:1]), 'a loop closes by itself'),
    (dict(outline=[(0, 0), (1, 0), (2, 0)]), 'must enclose an area'),
    (dict(holes=3), 'holes is 3, it must be a list of loops'),
    (dict(holes=None), 'holes is None, it must be a list of loops'),
    (dict(holes=[(.2, .2), (.4, .2), (.4, .4)]), r'holes\[0\] must be a list of points'),
    (dict(holes=[[(2, 2), (3, 2), (3, 3)]]), 'holes must be inside'),
    (dict(size=math.nan), 'size is nan, it must be a positive number'),
    (dict(size=1e-5), r'Size 1e-05 m would give about 2.309e\+10 triangles; a mesh can have'),
    (dict(outline=[(0, 0), (1e4, 0), (1e4, 1e4), (0, 1e4)], size=.35),
     r'Size 0.35 m would give about 1.885e\+09 triangles, which take about .* GB, but there are '
     '.* GB of memory; .* m would fill it'),
    (dict(smooth=None), 'smooth is None'),
    (dict(velocity=(1, 2, 3)), r'velocity is \(1, 2, 3\), it must be a pair'),
    (dict(velocity=(1, math.nan)), 'both numbers must be finite'),
    (dict(spin=math.inf), 'spin is inf'),
    (dict(displacement=lambda x, y: (-2 * x, 0)), 'displacement inverts the triangle at .* every'),
    (dict(displacement=lambda x, y: (-x, 0)), 'displacement inverts the triangle at .* every'),
    (dict(fixed='x'), "fixed is 'x', it must be a function"),
    (dict(thickness=0), 'thickness is 0'),
    (dict(thickness=math.nan), 'thickness is nan'),
    (dict(material=None), 'material is None'),
    (dict(material=7), 'material is 7, which is not in O.materials'),
])
def test_badInputIsRefused(wrong, sentence):
    solver = fe()
    args = dict(outline=kSquare, size=.5, material='m')
    args.update(wrong)
    with pytest.raises(ValueError, match=sentence) as error:
        solver.addPolygon(**args)
    assert str(error.value).count('. ') == 0
    assert len(O.bodies) == 0 and len(solver.nodes) == 0


@pytest.mark.parametrize('wrong', [dict(young=0), dict(young=-1), dict(young=math.nan),
                                   dict(poisson=.5), dict(density=-1), dict(density=0),
                                   dict(frictionAngle=2)])
def test_badMaterialIsRefused(wrong):
    solver = w.FESolver()
    with pytest.raises(ValueError, match="the material's %s is" % list(wrong)[0]):
        solver.addPolygon(kSquare, size=.5, material=w.FEMat(**wrong))


def test_otherMaterialsAreRefused():
    with pytest.raises(ValueError, match='must be an FEMat'):
        w.FESolver().addPolygon(kSquare, size=.5, material=w.FrictMat())


@pytest.mark.parametrize('name, value', [('correction', 'lagrangian'), ('passes', 3),
                                         ('damping', -1), ('penaltyFactor', 0),
                                         ('halo', -.1), ('halo', .6), ('halo', math.nan),
                                         ('gravity', (math.nan, 0, 0)), ('gravity', (0, 0, -9.8)),
                                         ('linearViscosity', -1), ('quadraticViscosity', -1)])
def test_badSettingsAreRefused(name, value):
    with pytest.raises(ValueError, match='FESolver.' + name):
        w.FESolver(**{name: value})
    solver = w.FESolver()
    before = getattr(solver, name)
    with pytest.raises(ValueError, match='FESolver.' + name):
        setattr(solver, name, value)
    assert getattr(solver, name) == before


def test_periodicSceneIsRefused():
    solver = fe()
    O.periodic = True
    with pytest.raises(ValueError, match='periodic'):
        solver.addPolygon(kSquare, size=.5, material='m')
    assert len(O.bodies) == 0


def test_secondSolverIsRefused():
    solver = impact('LebesgueCollider')
    with pytest.raises(ValueError, match='another FESolver'):
        w.FESolver().addPolygon(kSquare, size=.5, material='m')
    solver.removeBody(0)
    solver.removeBody(1)
    assert w.FESolver().addPolygon(kSquare, size=.5, material='m') == 0


# --- overlap

def test_bodyThatOverlapsIsNotAdded():
    solver = fe()
    first = solver.addPolygon(kSquare, size=.5, material='m')
    bodies, nodes = len(O.bodies), solver.nodes
    inside = yadefrag.rectangle((.4, .4), (.6, .6))
    for outline in (kSquare, yadefrag.rectangle((.9, .2), (2, .8)), inside):
        with pytest.raises(ValueError, match=r'^The new body overlaps body %d at \(.*\) m by \S+ m; '
                           'it may touch others at the start, but not overlap them.' % first):
            solver.addPolygon(outline, size=.5, material='m')
    with pytest.raises(ValueError, match='overlaps body 0'):
        solver.addPolygon(yadefrag.rectangle((2, 0), (3, 1)), size=.5, material='m',
                          displacement=lambda x, y: (-1.1, 0))
    with pytest.raises(ValueError, match='overlaps body 0'):
        solver.addTriangles([(.5, .5), (3, .5), (3, 2)], [(0, 1, 2)], material='m')
    assert len(O.bodies) == bodies and np.array_equal(solver.nodes, nodes)
    beside = solver.addPolygon(yadefrag.rectangle((1, 0), (2, 1)), size=.5, material='m')
    assert beside == first + 1
    with pytest.raises(ValueError, match='overlaps body %d at' % beside):
        solver.addPolygon(yadefrag.rectangle((1.2, .5), (1.4, 3)), size=.5, material='m')
    run(solver, finder('LebesgueCollider'))
    steps(5)


def test_bodyThatOverlapsIsNotAddedToARun(folder):
    """Where a body is now counts, also after O.load."""
    solver = impact('LebesgueCollider')
    steps(100)
    place = solver.fragments()[0]['centroid']
    O.save(folder + '/scene.xml')
    for loaded in (False, True):
        if loaded:
            O.reset()
            O.load(folder + '/scene.xml')
            solver = [e for e in O.engines if isinstance(e, w.FESolver)][0]
        bodies = len(O.bodies)
        with pytest.raises(ValueError, match='overlaps body 0 at'):
            solver.addPolygon(yadefrag.circle(place, .01, 8), size=.01, material='m')
        assert len(O.bodies) == bodies and len(solver.surfaces) == 2
        solver.addPolygon(yadefrag.rectangle((.25, 0), (.3, .1)), size=.02, material='m')
        steps(2)


# --- the time step, the engines, the scene

@pytest.mark.parametrize('dt', [0, math.nan, math.inf, 1])
def test_badTimeStepIsRefused(dt):
    solver = impact('LebesgueCollider')
    steps(2)
    good, before = O.dt, solver.nodes
    O.dt = dt
    with pytest.raises(ValueError, match='^O.dt: The time step is .* s, but must be above 0 and at'
                       ' most .* s, the critical step of the present mesh.$'):
        O.step()
    assert np.array_equal(solver.nodes, before)
    O.dt = good
    steps(2)


def test_sameSolverTwiceIsRefused():
    solver = impact('LebesgueCollider')
    O.engines = O.engines + [solver]
    before = solver.nodes
    with pytest.raises(ValueError, match='same FESolver more than once'):
        O.step()
    assert np.array_equal(solver.nodes, before)


@pytest.mark.parametrize('isLoaded', [False, True])
def test_ofAnotherSceneIsRefused(isLoaded):
    """Also if the other scene is a saved state of the same one, with bodies of the same numbers."""
    solver = impact('LebesgueCollider')
    O.step()
    O.saveTmp()
    O.reset()
    O.materials.append(w.FEMat(label='m'))
    if isLoaded:
        O.loadTmp()
    count = len(O.bodies)
    for call in (lambda: solver.addPolygon(kSquare, size=.5, material='m'),
                 lambda: solver.removeBody(0)):
        with pytest.raises(RuntimeError, match='O.reset, .* this scene needs a new FESolver'):
            call()
    assert len(O.bodies) == count
    assert isLoaded or w.FESolver().addPolygon(kSquare, size=.5, material='m') == 0


def test_periodicLaterIsRefused():
    solver = impact('LebesgueCollider')
    O.periodic = True
    before = solver.nodes
    with pytest.raises((ValueError, RuntimeError), match='periodic'):
        O.step()
    assert np.array_equal(solver.nodes, before)


@pytest.mark.parametrize('component', [2, -1, 'a', None, 1.5, True])
def test_noSuchBodyToRemove(component):
    solver = impact()
    with pytest.raises(ValueError, match='^component is '):
        solver.removeBody(component)
    assert len(solver.surfaces) == 2


@pytest.mark.parametrize('spoil, error', [
    (lambda: O.forces.setPermF(0, (math.nan, 0, 0)), 'a force or a velocity that is not finite'),
    (lambda: setattr(O.bodies[3].state, 'pos', (math.nan, 0, 0)), 'Body #3 is at .*not finite'),
])
def test_valuesThatAreNotFinite(spoil, error):
    solver = impact('LebesgueCollider')
    before = solver.nodes
    spoil()
    with pytest.raises(RuntimeError, match=error):
        O.step()
    assert np.abs(solver.nodes - before).max() < 1e-15


# --- without bodies, and pictures

def test_withoutBodies(folder):
    solver = w.FESolver()
    O.engines = [solver]
    O.dt = 1
    steps(2)
    assert solver.criticalTimeStep() == solver.minAngle == math.inf
    assert solver.energy['total'] == 0 and solver.fragments() == solver.surfaces == []
    assert solver.nodes.shape == (0, 2) and len(yadefrag.fragmentTable(solver)) == 0
    solver.prescribe(lambda x, y: True, vx=1)
    for call in (lambda: yadefrag.plotMesh(solver), lambda: solver.prescribe([0], vx=1),
                 lambda: yadefrag.animate(solver, folder + '/a.gif', 2, 1),
                 lambda: yadefrag.exportVTK(solver, folder + '/a.vtu'),
                 lambda: yadefrag.plotFragmentSizes(solver), lambda: solver.removeBody(0),
                 lambda: setattr(solver, 'loads', [(0, 1)])):
        with pytest.raises(ValueError, match='no bod|no broken body|0 nodes'):
            call()


@pytest.mark.parametrize('call, sentence', [
    (lambda s: yadefrag.plotMesh(3), 'fe is 3, it must be an FESolver'),
    (lambda s: yadefrag.animate(3, 'a.gif', 2, 1), 'fe is 3'),
    (lambda s: yadefrag.exportVTK(3, 'a.vtu'), 'fe is 3'),
    (lambda s: yadefrag.fragmentTable(3), 'fe is 3'),
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
    (lambda s: yadefrag.readPolygon(7), 'file is 7, it must be a path'),
    (lambda s: yadefrag.readPolygon(None), 'file is None'),
    (lambda s: setattr(s, 'loads', 'much'), "loads is 'much', it must be an array"),
])
def test_wrongArguments(call, sentence):
    solver = impact()
    with pytest.raises(ValueError, match=sentence) as error:
        call(solver)
    assert str(error.value).endswith('.') and O.iter == 0


def test_filesThatCannotBeOpenedAreNamed():
    solver = impact()
    for call in (lambda: yadefrag.readPolygon('/nowhere/x'),
                 lambda: yadefrag.plotMesh(solver, file='/nowhere/x.png'),
                 lambda: yadefrag.exportVTK(solver, '/nowhere/x.vtu')):
        with pytest.raises(FileNotFoundError, match='/nowhere/x'):
            call()


def test_namesThatDoNotExistAreReported():
    solver = fe()
    with pytest.warns(UserWarning, match="^FESolver has no attribute 'dampng', but damping: it is stored, but has no"):
        solver.dampng = 3
    with pytest.warns(UserWarning, match="^FESolver has no attribute 'x': it is stored"):
        solver.x = 3
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        solver.damping, solver.label, solver.dead = 3, 'fe', False


@pytest.mark.parametrize('call', [
    lambda solver, nodes: solver.prescribe(nodes, vx=0), lambda solver, nodes: solver.rotate(nodes, 1, (0, 0)),
    lambda solver, nodes: solver.reaction(nodes)])
@pytest.mark.parametrize('kind', ['function', 'flags', 'numbers'])
def test_placesWithoutNodesAreReported(call, kind):
    """After a motion: a function gets the present positions."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m', velocity=(1, 0))
    run(solver)
    left = lambda x, y: x < 1e-9
    numbers = np.flatnonzero([left(x, y) for x, y in solver.nodes])
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        call(solver, left)
    solver.prescribe(numbers)
    steps(3)
    nodes = dict(function=left, flags=np.array([left(x, y) for x, y in solver.nodes]), numbers=[])[kind]
    with pytest.warns(UserWarning, match='^nodes selects none of the %d nodes' % len(solver.nodes)) as caught:
        call(solver, nodes)
    assert ('present positions' in str(caught[0].message)) == (kind == 'function')
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        call(solver, numbers)


def test_runStepsShowsFESolversMessages():
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m')
    run(solver)
    critical, O.dt = O.dt, 1
    with pytest.raises(RuntimeError, match=r'^The run stopped in step 0: O.dt: The time step is 1 s, but must be'):
        yadefrag.runSteps(3)
    O.dt = critical
    assert yadefrag.runSteps(3) == 3
