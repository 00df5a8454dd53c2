"""Every shape and every geometry functor of YADE, against InsertionSortCollider on moving scenes. Interactions that
no search has found: functors and scripts insert them, for bodies without a bound too; they must be there when their
bodies meet, whatever the search distance."""
import numpy as np
import pytest
import yade.system
import yade.wrapper as w
from yade import gridpfacet, utils
from yade.minieigenHP import Vector3
import every_shape
import scenes
from every_shape import isHere, kInserting, kNearIsReal, kNoScene, kNoShape, kScenes, vector
from scenes import O, setEngines
from test_agreement import realAtEachStep


kSettings = [0, .004, .05]      # verletDist, m: none, and less and more than a step's way
_expected = {}


def pairsOf(make, functor, **attributes):
    """[set of real pairs] per step."""
    return realAtEachStep(make, lambda rng: kScenes[functor].build(functor, rng), seed=0, **attributes)


def settings(functor, verletDist):
    """(of YADE's collider, of ours). Where functors insert interactions YADE's loses those of bodies
    without a bound, unless all bounds reach everywhere; where what is near is real, both have to
    have the same bounds. Else it runs in every step."""
    if functor in kNearIsReal:
        return (dict(verletDist=verletDist, targetInterv=0),) * 2
    rivals = dict(verletDist=1e3, targetInterv=0) if functor in kInserting else dict(verletDist=0)
    return rivals, dict(verletDist=verletDist)


def expected(collider, functor, setting):
    key = functor, setting['verletDist']
    if key not in _expected:
        _expected[key] = pairsOf(collider.rival, functor, **setting)
    return _expected[key]


def compare(functor, wanted, found, mayBeLate):
    """Equal at every step. What a functor inserts is looked at one step later, by YADE's loop: a
    contact may be late by it if the search finds the pair in the step in which it touches."""
    before = set()
    for k, (a, b) in enumerate(zip(wanted, found)):
        missing = a - b
        if mayBeLate:
            missing &= before
        assert not missing and not b - a, \
            f'{functor}, step {k}: missing {sorted(missing)[:5]}, extra {sorted(b - a)[:5]}'
        before = a


@pytest.mark.parametrize('verletDist', kSettings)
@pytest.mark.parametrize('functor', sorted(kScenes))
def testContactsOfEveryFunctor(collider, functor, verletDist):
    if not isHere(functor):
        pytest.skip(f'this YADE has no {functor}')
    rivals, ours = settings(functor, verletDist)
    wanted = expected(collider, functor, rivals)
    compare(functor, wanted, pairsOf(collider, functor, **ours), functor in kInserting)
    assert len(set().union(*wanted)) - len(set.intersection(*wanted)) >= 5   # that come or go


def ofYade(base):
    """Names of YADE's own classes."""
    return {n for n in yade.system.childClasses(base) if 'SurfaceSegment' not in n}


def testNoFunctorIsMissing():
    assert ofYade('IGeomFunctor') == set(filter(isHere, kScenes)) | set(filter(isHere, kNoScene))


def shapesOf(functors):
    return {name for functor in filter(isHere, functors) for name in getattr(w, functor)().bases}


def testNoShapeIsMissing():
    tested = shapesOf(kScenes)
    assert ofYade('Shape') == tested | set(filter(isHere, kNoShape)) | shapesOf(kNoScene)
    assert not tested & set(kNoShape)


# --- interactions that no search has found

kGeometry = ('Ig2_PFacet_PFacet_ScGeom', 'Ig2_GridConnection_PFacet_ScGeom', 'Ig2_Wall_PFacet_ScGeom',
             'Ig2_Wall_Sphere_ScGeom', 'Ig2_Sphere_GridConnection_ScGridCoGeom')


def gridLoop():
    scene = kScenes['Ig2_PFacet_PFacet_ScGeom']
    scene = every_shape.Scene(others=[*scene.others, *kGeometry], grid=True)
    O.materials.append(every_shape.frictMat(1e7))
    O.materials.append(every_shape.cohesiveMat('node', 1e7))
    O.engines = [scene.loop('Ig2_PFacet_PFacet_ScGeom')]
    O.dt = 1e-5
    return O.engines[0]


def addPFacet(corners, fixed):
    nodes = []
    gridpfacet.pfacetCreator1([vector(x) for x in corners], .01, nodesIds=nodes, cylIds=[], pfIds=[],
                              fixed=fixed, materialNodes='node', material='m')
    return nodes


def triangle(side, z):
    return np.array([(-.3, -.3, 0), (.6, -.3, 0), (-.3, .6, 0)]) * side + [0, 0, z]


kPlaces = [(0, 0, 0), (3, -2, 5)]       # YADE takes the origin for the box of an unbounded body
kSearches = [dict(verletDist=0), dict(verletDist=1e-5), dict(verletDist=.01), {}]


def meet(collider, build, search, place, steps=1500):
    """Speeds of the falling PFacet's nodes after it should have rebounded."""
    loop = gridLoop()
    nodes = build(np.array(place, float))
    for i in nodes:
        O.bodies[i].state.vel = Vector3(0, 0, -5)
    # A tiny sphere far away: the default search distance is half its radius.
    O.bodies.append(utils.sphere((99, 99, 99), 2e-5, material='m', fixed=True))
    setEngines(collider(every_shape.boundFunctors(), **search), interactionLoop=loop)
    O.run(steps, True)
    return [O.bodies[i].state.vel[2] for i in nodes]


def onPFacet(place):
    """Nodes and faces of two PFacets."""
    addPFacet(triangle(1, 0) + place, True)
    return addPFacet(triangle(.3, .05) + place, False)


def onMovingPFacet(place):
    """The lower one may move, but is heavy."""
    for i in addPFacet(triangle(1, 0) + place, False):
        O.bodies[i].state.mass *= 1e6
    return addPFacet(triangle(.3, .05) + place, False)


def edgeOnEdge(place):
    """Two PFacets that cross: no projection of a node lies in the other."""
    addPFacet(np.array([(0, -1, 0), (0, 1, 0), (.05, 0, -1.)]) * .3 + place, True)
    return addPFacet(np.array([(-1, 0, 0), (1, 0, 0), (0, .05, 1.)]) * .3 + [0, 0, .05] + place, False)


def onConnection(place):
    ends = [O.bodies.append(gridpfacet.gridNode(vector(x + place), .01, fixed=True, material='node'))
            for x in ((-.5, 0, 0), (.5, .02, 0))]
    O.bodies.append(gridpfacet.gridConnection(*ends, .01, material='m'))
    return addPFacet(np.array([(-.1, -.1, .1), (.12, -.1, .1), (0, .15, .06)]) + place, False)


def onWall(place):
    O.bodies.append(utils.wall(vector(place), axis=2, sense=0, material='m'))
    return addPFacet(triangle(.3, .05) + place, False)


@pytest.mark.parametrize('search', kSearches, ids=str)
@pytest.mark.parametrize('place', kPlaces, ids=str)
@pytest.mark.parametrize('build', [onPFacet, onMovingPFacet, edgeOnEdge, onConnection, onWall],
                         ids=lambda f: f.__name__)
def testPFacetsRebound(collider, build, search, place):
    speeds = meet(collider, build, search, place)
    assert all(v > -4.9 for v in speeds) and np.mean(speeds) > 0, speeds


@pytest.mark.parametrize('verletDist', [0, .01, .1])
def testPFacetThatTurnsAboutItsFirstNode(collider, verletDist):
    """The first node stays; the others carry the PFacet into a sphere at rest."""
    loop = gridLoop()
    O.dt = .01
    nodes = addPFacet([(0, 0, 0), (1, 0, 0), (1, .5, 0)], True)
    for i in nodes[1:]:
        O.bodies[i].state.vel = Vector3(0, 0, 1)
    sphere = O.bodies.append(utils.sphere((.8, .2, .5), .05, fixed=True, material='m'))
    setEngines(collider(every_shape.boundFunctors(), verletDist=verletDist), interactionLoop=loop)
    met = False
    for _ in range(120):
        O.step()
        met = met or any(sphere in pair for pair in scenes.realPairs())
    assert met


@pytest.mark.parametrize('place', kPlaces, ids=str)
def testNodesOfABrokenConnectionMeetAgain(collider, place):
    """Their interaction was made by the script; once broken, it is potential and has to stay."""
    gridLoop()
    O.materials.append(w.CohFrictMat(young=1e5, poisson=.3, density=1e3, label='weak'))
    loop = O.engines[0]
    loop.physDispatcher.functors[-1].setCohesionNow = False
    ids = [O.bodies.append(gridpfacet.gridNode(vector(place) + Vector3(x, 0, 0), .05, fixed=True,
                                               material='weak')) for x in (0, .11)]
    utils.createInteraction(*ids)
    O.bodies[ids[1]].state.vel = Vector3(.1, 0, 0)
    setEngines(collider(every_shape.boundFunctors(), verletDist=0), interactionLoop=loop)
    O.dt = .01
    O.run(20, True)
    assert not scenes.realPairs()
    O.bodies[ids[1]].state.vel = Vector3(-.1, 0, 0)
    O.run(60, True)
    assert tuple(ids) in scenes.realPairs()


def testVirtualInteractionOfBoundedBodiesGoes(collider):
    """The search erases a far potential interaction, whether or not it has made it."""
    ids = scenes.addSpheres([(0, 0, 0), (9, 0, 0)], [1, 1])
    setEngines(collider(verletDist=0))
    utils.createInteraction(*ids, virtualI=True)
    O.step()
    assert not scenes.allPairs()
