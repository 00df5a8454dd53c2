"""Messages of a step: for each the scene that provokes it, and the same scene with its advice followed.

A cause and a remedy build a scene and run it; the cause must give the message, by an exception or in fe.warnings, the
remedy must not. docs/checked.md has the thresholds. Steps that vary, and cracks whose energy step or mesh does not
resolve, with what their sentences advise: tests/step/energy_watch_test.cpp, tests/fracture/brittle_checks_test.cpp; the
order of engines: test_fe_scene_check.py.
"""
import math
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


# --- deformation and cracks

def spreading(factor):
    """A square of four triangles that rotates and spreads faster than waves."""
    solver = steel()
    nodes, triangles = yadefrag.rectangleMesh((-.5, -.5), (.5, .5), 1, 1, True)
    rate = 1.5 * math.sqrt(2e11 * .7 / 1.3 / .4 / 7800 * 2)
    solver.addTriangles(nodes, triangles, material='steel', selfContact=False,
                        velocity=lambda x, y: (rate * (x - y), rate * (.3 * y + x)))
    return ranAt(factor, solver, int(200 / factor))


def stretched(element='linear'):
    """A plate of concrete that is held stretched, and cracks."""
    solver = fe(w.BrittleFEMat(young=32e9, poisson=.2, density=2450, tensileStrength=3e6, strengthScatter=.1, label='concrete'))
    solver.addPolygon(yadefrag.rectangle((0, 0), (.04, .02)), size=.01, material='concrete', element=element,
                      displacement=lambda x, y: (1.2e-4 * x, 0), fixed=lambda x, y: x < 1e-9 or x > .04 - 1e-9)
    return ranAt(.5, solver, 300)


def thrown(factor=.9, speed=.1):
    """A wedge hits a sliver, whose nodes are so light that contact would throw them over many segments."""
    solver = fe(w.FEMat(young=1e3, poisson=.3, density=1000, frictionAngle=0, label='m'))
    nodes = [(-1, 0), (-1, -1), (0, -1), (0, 0), (1, 0), (0, -1e-3)]
    solver.addTriangles(nodes, [(0, 1, 3), (1, 5, 3), (1, 2, 5), (5, 4, 3)], material='m', selfContact=False)
    solver.addTriangles([(.08, .5), (.1, 1e-5), (.12, .5)], [(0, 1, 2)], material='m', selfContact=False)
    O.engines = yadefrag.engines(solver)
    critical = solver.criticalTimeStep()
    solver.prescribe(lambda x, y: y > 1e-9, vx=0, vy=-speed / critical)
    O.dt = factor * critical
    return ran(solver, int(3 / factor))


# --- spheres, clumps and boxes

def small(factor=.8, young=1e9):
    """A sphere that is too light for the step of the bodies."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, .5)), size=.125, material='m', fixed=lambda x, y: y < 1e-9)
    throwBall((.44, .51), .0101, (0, -1), w.FrictMat(young=young, density=300, frictionAngle=.3))
    ready(solver, factor, spheres=True)
    return ran(solver, int(.004 / O.dt))


def bent(smooth=False, factor=.5):
    """Soft spheres fall on a thin wire, which bends under them."""
    solver = fe(w.FEMat(young=5e7, poisson=.3, density=1100, frictionAngle=.3, label='wire'))
    solver.addPolygon(yadefrag.rectangle((0, 0), (.4, .006)), size=.003, material='wire', element='smoothed',
                      smooth=smooth, thickness=.02, fixed=lambda x, y: x < 1e-9 or x > .3999)
    soft = w.FrictMat(young=3e6, poisson=.2, density=1500, frictionAngle=.3)
    for i in range(5):
        throwBall((.08 + .06 * i, .05 + .03 * (i % 2)), .02, (0, -3), soft)
    ready(solver, factor, gravity=(0, -9.81), spheres=True)
    O.run(int(.02 / O.dt), True)
    return solver.warnings


def thrownAt(young=1e7, radius=.01, speed=50, factor=.4, body=1e9, smooth=False):
    """A sphere hits a block."""
    solver = fe(w.FEMat(young=body, poisson=.2, density=2000, frictionAngle=.3, label='m'))
    solver.addPolygon(yadefrag.rectangle((0, 0), (.4, .1)), size=.02, material='m', thickness=.02, smooth=smooth,
                      fixed=lambda x, y: y < 1e-9)
    ball = throwBall((.2, .1001 + radius), radius, (0, -speed), w.FrictMat(young=young, density=7800, frictionAngle=.3))
    ready(solver, factor, spheres=True)
    O.run(int(1200 / factor), True)
    assert ball.state.pos[1] > .1 or any('may pass through' in one for one in solver.warnings)
    return solver.warnings


def putAt(height, isLate=True):
    """A sphere is put onto a block, or a block below a sphere."""
    solver = fe()
    if not isLate:
        throwBall((.5, height), .1)
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, .5)), size=.25, material='m', thickness=.2)
    ready(solver, .2, spheres=True)
    ran(solver, 3)
    if isLate:
        throwBall((.5, height), .1)
    return ran(solver, 200)


def clump(moment=None, blocked='zXY'):
    """A clump whose third principal axis is not z, beside a block."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, .5)), size=.25, material='m')
    number, _ = O.bodies.appendClumped([utils.box((-.2, .1, 0), (.02, .01, .02), material='m'),
                                        utils.box((-.2, .12, 0), (.01, .012, .02), material='m')])
    state = O.bodies[number].state
    state.blockedDOFs = blocked
    if moment:
        state.inertia = (moment,) * 3
    return ranAt(.1, solver, 1, moving=True)


def clumpAsAdvised():
    [moment] = [re.search(r'another axis.*instead of ([-+.e\d]+)', one)[1] for one in reported(clump) if 'another axis' in one]
    O.reset()
    return clump(float(moment))


def box(mass=100, damping=0., isFirst=False, speed=3, steps=100):
    """A box hits a block that rotates."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, .5)), size=.125, material='m', velocity=(0, -.5), spin=2)
    one = utils.box((.5, -.15, 0), (.1, .1, .5), material='m')
    one.state.vel, one.state.blockedDOFs = (0, speed, 0), 'zXY'
    one.state.mass, one.state.inertia = mass, (.01 * mass,) * 3
    O.bodies.append(one)
    integrator = w.NewtonIntegrator(damping=damping)
    O.engines = [integrator, w.ForceResetter(), solver] if isFirst else [w.ForceResetter(), solver, integrator]
    O.dt = .8 * solver.criticalTimeStep()
    return ran(solver, steps)


# --- adding bodies

def rested(most):
    solver = fe(gravity=(0, -1))
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m', fixed=lambda x, y: y < 1e-9)
    ready(solver, .5)
    assert solver.relax(most=most) >= 5


# --- running and saving

def standing(onWall=True):
    """A smooth disc on a slope of 0.04."""
    O.materials.append(w.FEMat(young=1e8, poisson=.3, density=1000, frictionAngle=.4, label='m'))
    solver = w.FESolver(linearViscosity=.1, passes=1 if onWall else 2)
    solver.addPolygon(yadefrag.circle((0, .05), .05, 48), size=.0066, material='m', smooth=True)
    if onWall:
        O.bodies.append(utils.wall(0, axis=1, material='m'))
    else:
        solver.addPolygon(yadefrag.rectangle((-.1, -.02), (.1, 0)), size=.0066, material='m', fixed=lambda x, y: y < -.0199)
    ready(solver, .8, gravity=(.04 * 9.81, -9.81))
    body = solver.nodesOf(0)
    O.run(int(.2 / O.dt), True)
    share = solver.masses[body] @ solver.velocities[body][:, 0] / solver.masses[body].sum() / (2 / 3 * .04 * 9.81 * .2)
    assert share < .2 if onWall else share == pytest.approx(1, abs=.05)
    return solver.warnings


ENERGY = "contact with YADE's walls, boxes or facets has created"
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
    'too fast a rotation': (
        'time integration has created .*take a shorter step: .* the bodies rotate or deform too much',
        lambda: spreading(.99), lambda: spreading(.25)),
    'smoothed cracks': (
        "cracks in bodies with element='smoothed' have created .*element='linear' avoids this",
        lambda: stretched('smoothed'), stretched),
    'contact moves a node: step': ('contact moves a surface node by', thrown, lambda: thrown(.02)),
    'contact moves a node: slower': ('contact moves a surface node by', thrown, lambda: thrown(speed=.01)),
    'a sphere that is too light: step': (
        "contact with YADE's spheres has created .*take a shorter step", small, lambda: small(.01)),
    'a sphere that is too light: stiffness': (
        "contact with YADE's spheres has created .*a smaller stiffness", small, lambda: small(young=1e4)),
    'spheres on corners that bend': (
        "contact with YADE's spheres has created .*take smooth=True", bent, lambda: bent(True)),
    'a sphere that is too soft': (
        'overlaps an FE body by .* of its radius, and may pass through; the contact is too soft: take a larger stiffness',
        thrownAt, lambda: thrownAt(1e10)),
    'a sphere that is too soft, smooth': (
        'may pass through; the contact is too soft', lambda: thrownAt(smooth=True), lambda: thrownAt(1e10, smooth=True)),
    'a sphere that is too fast for the step': (
        'may pass through; it moves by .* of its radius in a step: take a shorter step',
        lambda: thrownAt(1e10, .002, 100, .8), lambda: thrownAt(1e10, .002, 100, .05)),
    'a sphere put into a body': (
        'Sphere #.* overlaps an FE body by .*; put it outside', lambda: putAt(.55), lambda: putAt(.6)),
    'a sphere put inside a body': ('Sphere #.* overlaps an FE body', lambda: putAt(.25), lambda: putAt(.6)),
    'a body over a sphere': (
        'The new body overlaps sphere #0 by 0.05 m, 0.5 of its radius', lambda: putAt(.55, False), lambda: putAt(.6, False)),
    'a body around a sphere': (
        'The new body overlaps sphere #0', lambda: putAt(.25, False), lambda: putAt(.6, False)),
    'a clump that rotates by another axis: inertia': (
        'by the moment of inertia of another axis', clump, clumpAsAdvised),
    'a clump that rotates by another axis: free': (
        'by the moment of inertia of another axis', clump, lambda: clump(blocked='z')),
    'a smooth body on a wall': ('rests on Wall #', standing, lambda: standing(False)),
    'rigid bodies get energy: order': (ENERGY, lambda: box(isFirst=True), box),
    'rigid bodies get energy: heavier': (ENERGY, lambda: box(isFirst=True), lambda: box(1e4, isFirst=True)),
    'rigid bodies get energy: damping': (ENERGY, lambda: box(1, .2, speed=8), lambda: box(1, speed=8)),
    'no rest': ('relax: after [0-9]+ steps the kinetic energy is still', lambda: rested(5), lambda: rested(10**5)),
}


def test_eachChangeOfAMaterialIsReported():
    """One before the body is added is none."""
    solver = steel()
    O.materials['steel'].young = 1e11
    solver.addPolygon(yadefrag.rectangle((0, 0), (.4, .2)), size=.1, material='steel')
    O.engines, O.dt = yadefrag.engines(solver), .1 * solver.criticalTimeStep()
    O.run(1, True)
    assert not solver.warnings
    for name, value in (('young', 1e9), ('density', 1e3), ('young', 2e9)):
        setattr(O.materials['steel'], name, value)
        O.run(1, True)
    said = [one for one in solver.warnings if "material 'steel' was changed" in one]
    assert re.search("young of material 'steel' was changed from 1e.11 to 1e.09", said[0])
    assert [one.split(' of ')[0] + one.split(' to ')[1].split(' after')[0] for one in said] == [
        'young1e+09', 'density1000', 'young2e+09']


@pytest.mark.parametrize('name', TABLE)
def test_messageComesAndItsAdviceHelps(name):
    pattern, cause, remedy = TABLE[name]
    found = reported(cause)
    assert [one for one in found if re.search(pattern, one)], found
    O.reset()
    left = reported(remedy, mayFail=False)
    assert not [one for one in left if re.search(pattern, one)], left
