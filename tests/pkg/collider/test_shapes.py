"""Bodies other than spheres: the real contacts that YADE's collider has when it runs every step."""
import math

import numpy as np
import pytest

import scenes
from scenes import O, addSpheres, setEngines
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Quaternion, Vector3

kSteps = 30


def realAtEachStep(makeCollider, build, steps=kSteps, **attributes):
    """[set of real pairs] per step, of the scene that `build(rng)` makes."""
    scenes.clear()
    O.dt = 1
    more = build(np.random.default_rng(1)) or {}
    functors = more.pop('functors', None)
    setEngines(makeCollider(functors, **attributes), *more.pop('engines', ()), **more)
    history = []
    for _ in range(steps):
        O.step()
        history.append(set(scenes.realPairs()))
    return history


def sameContacts(collider, build, atLeast=20, **attributes):
    expected = realAtEachStep(collider.rival, build, verletDist=0)
    found = realAtEachStep(collider, build, **attributes)
    for k, (a, b) in enumerate(zip(expected, found)):
        assert a == b, f'step {k}: missing {sorted(a - b)[:5]}, extra {sorted(b - a)[:5]}'
    assert len(set().union(*expected)) >= atLeast


def flying(rng, n=80, speed=.02, radius=.05):
    addSpheres(rng.uniform(0, 1, (n, 3)), rng.uniform(.5, 1, n) * radius,
               rng.normal(size=(n, 3)) * speed)


def facets(rng):
    flying(rng)
    for _ in range(25):
        corner = rng.uniform(0, 1, 3)
        points = [Vector3(*(corner + rng.uniform(-.2, .2, 3))) for _ in range(3)]
        O.bodies.append(utils.facet(points, fixed=True))


def flatFacets(rng):
    """Boxes of no thickness, all in one plane, on the border of one another."""
    flying(rng)
    for x in np.arange(0, 1, .25):
        for y in np.arange(0, 1, .25):
            O.bodies.append(utils.facet([(x, y, .5), (x + .25, y, .5), (x, y + .25, .5)]))


def boxes(rng):
    flying(rng)
    for _ in range(15):
        angle = rng.uniform(0, math.pi)
        O.bodies.append(utils.box(Vector3(*rng.uniform(0, 1, 3)), Vector3(*rng.uniform(.01, .2, 3)),
                                  Quaternion(Vector3(*rng.normal(size=3)), angle), fixed=True))


def walls(rng):
    flying(rng)
    for axis in range(3):
        for sense in (-1, 0, 1):
            O.bodies.append(utils.wall(float(rng.uniform(0, 1)), axis=axis, sense=sense))


def wallsOnly(rng):
    """Nothing but walls and one sphere: no finite extent to build a grid on."""
    for axis in range(3):
        O.bodies.append(utils.wall(.1, axis=axis))
    addSpheres([(0, 0, 0)], [.05], [(.013, .0131, .0132)])


def hugeFloor(rng):
    flying(rng)
    O.bodies.append(utils.box((0, 0, .5), (1e6, 1e6, .01), fixed=True))
    O.bodies.append(utils.facet([(-1e7, -1e7, .2), (1e7, -1e7, .2), (0, 1e7, .2)]))


def movingWalls(rng):
    """Walls, boxes and facets that fly through spheres at rest."""
    addSpheres(rng.uniform(0, 1, (80, 3)), [.04] * 80)
    bodies = [utils.wall(0., axis=0), utils.box((.5, .5, -.1), (.3, .3, .02)),
              utils.facet([(0, -.1, 0), (1, -.1, 0), (.5, -.1, 1)])]
    O.bodies.append(bodies)
    for body, v in zip(bodies, ((.05, 0, 0), (0, 0, .04), (0, .06, 0))):
        body.state.blockedDOFs = 'xyzXYZ'
        body.state.vel = Vector3(*v)


@pytest.mark.parametrize('build', [facets, flatFacets, boxes, walls, hugeFloor, movingWalls],
                         ids=lambda f: f.__name__)
@pytest.mark.parametrize('verletDist', [-.5, 0, .1])
def testShapes(collider, build, verletDist):
    sameContacts(collider, build, verletDist=verletDist)


def testWallsOnly(collider):
    sameContacts(collider, wallsOnly, atLeast=1, verletDist=0)


def testWallsDoNotMeetEachOther(collider):
    """Bounds with infinite extents overlap, and may be interactions, but harm nothing."""
    wallsOnly(None)
    setEngines(collider())
    for _ in range(5):
        O.step()
    assert all(math.isfinite(x) for x in O.bodies[3].state.pos)


def polyhedra(rng):
    """Convex bodies that fly through each other; no law, so that contacts end with the geometry."""
    from yade import polyhedra_utils
    material = w.PolyhedraMat(density=1000, young=1e5, poisson=.3, frictionAngle=.5)
    O.materials.append(material)
    for k in range(40):
        # corners given: with a seed alone YADE makes another body each time
        body = polyhedra_utils.polyhedra(
            material, v=[Vector3(*x) for x in rng.uniform(-.12, .12, (10, 3))])
        body.state.ori = Quaternion(Vector3(0, 0, 1), float(rng.uniform(0, 3)))
        body.state.pos = Vector3(*rng.uniform(0, 1, 3))
        body.state.vel = Vector3(*(rng.normal(size=3) * .02))
        body.state.blockedDOFs = 'xyzXYZ'
        O.bodies.append(body)
    O.bodies.append(utils.wall(.5, axis=2, material=material))
    return dict(
        functors=[w.Bo1_Polyhedra_Aabb(), w.Bo1_Wall_Aabb()],
        interactionLoop=w.InteractionLoop(
            [w.Ig2_Polyhedra_Polyhedra_PolyhedraGeom(), w.Ig2_Wall_Polyhedra_PolyhedraGeom()],
            [w.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
            [w.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]))


@pytest.mark.skipif(not hasattr(w, 'Bo1_Polyhedra_Aabb'), reason='this YADE has no polyhedra')
def testPolyhedra(collider):
    sameContacts(collider, polyhedra)


def grids(rng):
    """Nodes, connections and PFacets, with spheres flying through."""
    from yade import gridpfacet
    interactionLoop = gridLoop()
    O.engines = [interactionLoop]       # the creators make their interactions through it
    O.materials.append(w.CohFrictMat(young=1e5, poisson=.3, density=1e3, label='node'))
    O.materials.append(w.FrictMat(young=1e5, poisson=.3, density=1e3, label='outer'))
    for k in range(4):
        low = rng.uniform(.1, .6, 3)
        corners = [low, low + [.3, 0, .1], low + [0, .3, 0]]
        gridpfacet.pfacetCreator1([Vector3(*c) for c in corners], .02, fixed=True,
                                  materialNodes='node', material='outer',
                                  nodesIds=[], cylIds=[], pfIds=[])
    for k in range(3):
        nodes = [O.bodies.append(gridpfacet.gridNode(Vector3(*rng.uniform(0, 1, 3)), .03,
                                                     fixed=True, material='node'))
                 for _ in range(2)]
        O.bodies.append(gridpfacet.gridConnection(*nodes, .03, material='outer'))
    addSpheres(rng.uniform(0, 1, (60, 3)), [.03] * 60, rng.normal(size=(60, 3)) * .01,
               material='outer')
    return dict(functors=[w.Bo1_Sphere_Aabb(), w.Bo1_GridConnection_Aabb(), w.Bo1_PFacet_Aabb()],
                interactionLoop=interactionLoop)


def gridLoop():
    return w.InteractionLoop(
        [w.Ig2_GridNode_GridNode_GridNodeGeom6D(), w.Ig2_Sphere_GridConnection_ScGridCoGeom(),
         w.Ig2_Sphere_PFacet_ScGridCoGeom(), w.Ig2_GridConnection_GridConnection_GridCoGridCoGeom(),
         w.Ig2_Sphere_Sphere_ScGeom()],
        [w.Ip2_FrictMat_FrictMat_FrictPhys(),
         w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True,
                                                    setCohesionOnNewContacts=False)],
        [w.Law2_ScGeom_FrictPhys_CundallStrack(), w.Law2_ScGridCoGeom_FrictPhys_CundallStrack(),
         w.Law2_GridCoGridCoGeom_FrictPhys_CundallStrack(),
         w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment()])


@pytest.mark.skipif(not hasattr(w, 'Bo1_PFacet_Aabb'), reason='this YADE has no PFacets')
def testGrids(collider):
    sameContacts(collider, grids)


@pytest.mark.rivalFails('its strides see only positions, not rotation')
@pytest.mark.parametrize('shape', ['facet', 'box'])
def testSpinningBody(collider, shape):
    """A body that turns about its own centre into a sphere at rest must be found."""
    if shape == 'facet':
        body = utils.facet([(-1, -.1, 0), (1, -.1, 0), (0, .2, 0)])
    else:
        body = utils.box((0, 0, 0), (1, .1, .02))
    O.bodies.append(body)
    body.state.blockedDOFs = 'xyzXYZ'
    addSpheres([(0, 0, .8), (0, 0, 5)], [.05, .05])
    O.dt = .01
    setEngines(collider(), w.RotationEngine(ids=[0], rotationAxis=(0, 1, 0), angularVelocity=1,
                                            rotateAroundZero=True, zeroPoint=body.state.pos))
    met = False
    for _ in range(200):
        O.step()
        met = met or (0, 1) in scenes.realPairs()
    assert met


@pytest.mark.parametrize('strides', [True, False])
def testMovedByAnotherEngine(collider, strides):
    """TranslationEngine pushes a facet and a box through spheres at rest."""
    def build(rng):
        addSpheres(rng.uniform(0, 1, (60, 3)), [.04] * 60)
        ids = O.bodies.append([utils.facet([(-.1, -1, 0), (-.1, 2, 0), (-.1, .5, 2)]),
                               utils.box((.5, .5, 1.2), (.5, .5, .01))])
        return dict(engines=[
            w.TranslationEngine(ids=[ids[0]], translationAxis=(1, 0, 0), velocity=.04),
            w.TranslationEngine(ids=[ids[1]], translationAxis=(0, 0, -1), velocity=.03)])
    sameContacts(collider, build, verletDist=-.5 if strides else 0)


def testMaskedIntegrator(collider):
    """Bodies that NewtonIntegrator.mask leaves out stay where they are and are still met."""
    def build(rng):
        flying(rng, 100)
        for body in O.bodies:
            body.mask = 1 + int(rng.integers(0, 2)) * 2
        return dict(newton=w.NewtonIntegrator(mask=2))
    sameContacts(collider, build)
