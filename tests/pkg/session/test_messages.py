"""Messages of a step: for each the scene that provokes it, and the same scene with its advice followed.

A cause and a remedy build a scene and run it; the cause must give the message, by an exception or in fe.warnings, the
remedy must not. docs/checked.md has the thresholds. Steps that vary, and cracks whose energy step or mesh does not
resolve, with what their sentences advise: tests/step/energy_watch_test.cpp, tests/fracture/brittle_checks_test.cpp; the
order of engines: test_fe_scene_check.py.
"""
import re

import pytest

from fe_scene import fe, heard, O, ready, throwBall
import yadefrag
from yade import utils
from yade import wrapper as w


def ran(solver, steps, each=None):
    """The messages of a run: those of fe.warnings, and that of the exception that ended it."""
    try:
        for _ in range(steps):
            if each:
                each()
            O.step()
    except (RuntimeError, ValueError) as error:
        return solver.warnings + [str(error)]
    return solver.warnings


def reported(scene, mayFail=True):
    """All messages of a scene: returned ones, Python's warnings, and that of the exception that ended it."""
    with heard() as texts:
        try:
            found = list(scene() or [])
        except (RuntimeError, ValueError) as error:
            if not mayFail:
                raise
            found = [str(error)]
    return found + texts


def assertAdviceHelps(pattern, cause, remedy):
    found = reported(cause)
    assert [one for one in found if re.search(pattern, one)], found
    O.reset()
    left = reported(remedy, mayFail=False)
    assert not [one for one in left if re.search(pattern, one)], left


def ranAt(part, solver, steps, **settings):
    """The same at a part of the critical step, with the usual engines."""
    ready(solver, part, **settings)
    return ran(solver, steps)


def steel(**settings):
    O.materials.append(w.FEMat(young=2e11, poisson=.3, density=7800, frictionAngle=.2, label='steel'))
    return w.FESolver(**settings)


def steelBlock(**settings):
    solver = steel(**settings)
    solver.addPolygon(yadefrag.rectangle((0, 0), (.4, .2)), size=.1, material='steel')
    return solver


def advised(sentence):
    """The step that a message asks for."""
    return float(re.search(r'a step of at most ([-+.e\d]+) s', sentence).group(1))


# --- the step

def bullet(speed, dt=None, shape=None):
    """Two blocks of which one is faster than waves."""
    solver = steel()
    shape = shape or [(0, 0), (.01, 0), (.01, .01), (0, .01)]
    solver.addPolygon(shape, size=5e-3, material='steel', velocity=(speed, 0))
    solver.addPolygon(yadefrag.rectangle((.0105, 0), (.03, .01)), size=5e-3, material='steel')
    O.engines = yadefrag.engines(solver)
    O.dt = dt or .8 * solver.criticalTimeStep()
    return ran(solver, 1)


def followed(scene, pattern):
    """A scene whose message states a step: the message, and those with that step."""
    found = scene(None)
    [sentence] = [one for one in found if re.search(pattern, one)]
    O.reset()
    return scene(advised(sentence))


# --- elements

def rubber(asked=0, young=5e6, speed=60, element='linear'):
    """A disc of rubber hits a strip of rubber on a rigid base. `asked`: how many times the step that a message
    states is taken, in the middle of the run."""
    solver = fe(w.FEMat(young=young, poisson=.4, density=1100, frictionAngle=.2, label='rubber'))
    nodes, triangles = yadefrag.rectangleMesh((-.03, 0), (.03, .002), 30, 1)
    solver.addTriangles(nodes, triangles, material='rubber', element=element, fixed=lambda x, y: y < 1e-9)
    solver.addPolygon(yadefrag.circle((0, .0071), .005, 32), size=1.2e-3, material='rubber', element=element,
                      velocity=(0, -speed))
    ready(solver, .4)
    end = .012 / speed
    found = ran(solver, int(end / O.dt))
    while asked and found and 'is pressed to' in found[-1]:
        asked, O.dt = asked - 1, advised(found[-1])
        found = ran(solver, int((end - O.time) / O.dt) + 1)
    return found


def kicked(part):
    """A node that would move past its neighbours in one step of .99 of the critical one."""
    critical = 1
    for speed in (0, 1):
        O.reset()
        solver = steel()
        nodes, triangles = yadefrag.rectangleMesh((0, 0), (.02, .01), 4, 2)
        solver.addTriangles(nodes, triangles, material='steel', selfContact=False,
                            velocity=lambda x, y, critical=critical: (speed * .0052 / critical * (abs(x - .01) + abs(y - .005) < 1e-9), 0))
        critical = solver.criticalTimeStep()
    O.engines = yadefrag.engines(solver)
    O.dt = part * critical
    return ran(solver, int(40 / part))


# --- YADE's bodies

def beside(radius, thickness):
    """A block, and a sphere above it."""
    solver = steel()
    solver.addPolygon(yadefrag.rectangle((0, 0), (.4, .2)), size=.1, material='steel', thickness=thickness)
    throwBall((.2, .3), radius, material='steel')
    return ranAt(.1, solver, 3, spheres=True)


def facets(corners):
    solver = steelBlock()
    O.bodies.append(utils.facet(corners, material='steel'))
    return ranAt(.1, solver, 3)


# --- the first step

def defaultStep(dt):
    solver = steelBlock()
    O.engines = yadefrag.engines(solver)
    O.dt = dt or .8 * solver.criticalTimeStep()
    return ran(solver, 2)


def changedMaterial(when):
    solver = steel()
    if when == 'before':
        O.materials['steel'].young = 1e9
    solver.addPolygon(yadefrag.rectangle((0, 0), (.4, .2)), size=.1, material='steel')
    if when != 'before':
        O.materials['steel'].young = 1e9
    if when == 'again':
        solver.removeBody(0)
        solver.addPolygon(yadefrag.rectangle((0, 0), (.4, .2)), size=.1, material='steel')
    return ranAt(.5, solver, 2)


UPRIGHT = [(-1, -1, 1), (1, -1, 1), (0, -1, -2)]
PRESSED = 'is pressed to .* of its area in a step of .*; the flatter an element is, the stiffer it gets: '
TABLE = {
    'a body moves too far against another': (
        'a body moves against another by', lambda: bullet(5e4),
        lambda: followed(lambda dt: bullet(5e4, dt), 'a body moves against another by')),
    'a node moves too far': (
        'a node moves by', lambda: bullet(1e6),
        lambda: followed(lambda dt: bullet(1e6, dt), 'a node moves by')),
    'an element is inverted by one step': (
        'is inverted in a step of .*; take a shorter one', lambda: kicked(.99), lambda: kicked(.05)),
    'an element nearly collapses: step': (PRESSED + 'take a step of at most', rubber, lambda: rubber(asked=6)),
    'an element nearly collapses: another material': (PRESSED + '.*a stiffer material', rubber, lambda: rubber(young=5e7)),
    'an element nearly collapses: slower': (PRESSED + '.*slower bodies', rubber, lambda: rubber(speed=30)),
    'smoothed elements nearly collapse: step': (
        PRESSED + 'take a step of at most', lambda: rubber(element='smoothed'),
        lambda: rubber(asked=6, element='smoothed')),
    'a thick body beside small spheres': (
        r'FE bodies are 1 m thick.*addPolygon\(thickness=0.04\)', lambda: beside(.02, 1), lambda: beside(.02, .04)),
    'a facet in the plane': (
        'FE bodies go through facets that lie in their plane',
        lambda: facets([(-1, -1, 0), (1, -1, 0), (0, -2, 0)]), lambda: facets(UPRIGHT)),
    'O.dt is the default': (
        "O.dt has YADE's default, 1e-08 s, .*criticalTimeStep", lambda: defaultStep(1e-8), lambda: defaultStep(None)),
    'a changed material: earlier': (
        "young of material 'steel' was changed from 2e.11 to 1e.09", lambda: changedMaterial('after'),
        lambda: changedMaterial('before')),
}


def test_eachChangeOfAMaterialIsReported():
    solver = steelBlock()
    O.engines, O.dt = yadefrag.engines(solver), .1 * solver.criticalTimeStep()
    for name, value in (('young', 1e9), ('density', 1e3), ('young', 2e9)):
        setattr(O.materials['steel'], name, value)
        O.run(1, True)
    said = [one for one in solver.warnings if "material 'steel' was changed" in one]
    assert [one.split(' of ')[0] + one.split(' to ')[1].split(' after')[0] for one in said] == [
        'young1e+09', 'density1000', 'young2e+09']


@pytest.mark.parametrize('name', TABLE)
def test_messageComesAndItsAdviceHelps(name):
    assertAdviceHelps(*TABLE[name])
