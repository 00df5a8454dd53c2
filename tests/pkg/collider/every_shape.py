"""Scenes for every geometry functor of YADE up to 2026.1.0: bodies that fly through each other.

`kScenes` has one scene per functor, `kNoScene` the reason where there is none; `isHere` is true for the
functors of this YADE (later ones have more, and Debian's packages of these lack some features). All bodies
keep their velocity whatever forces act, so that a run does not depend on the order of summation. Positions are
in m, in a unit box; a step takes 1 s.
"""
import itertools
import warnings

import numpy as np
import yade.wrapper as w
from scenes import O
from yade import gridpfacet, utils
from yade.minieigenHP import Vector3

kSpeed = .02        # m per step
_chainNumbers = itertools.count()   # YADE keeps the chains of earlier scenes

# These insert potential interactions by themselves, of bodies that have no bound.
kInserting = ('Ig2_PFacet_PFacet_ScGeom', 'Ig2_GridConnection_PFacet_ScGeom', 'Ig2_Wall_PFacet_ScGeom')

# These make contacts of any near bodies, so that what is real depends on the bounds.
kNearIsReal = ('Ig2_Facet_Polyhedra_PolyhedraGeom', 'Ig2_Wall_Polyhedra_PolyhedraGeom',
               'Ig2_Polyhedra_Polyhedra_PolyhedraGeom', 'Ig2_Polyhedra_Polyhedra_ScGeom',
               'Ig2_Polyhedra_Polyhedra_PolyhedraGeomOrScGeom', 'Ig2_Sphere_ChainedCylinder_CylScGeom',
               'Ig2_Sphere_ChainedCylinder_CylScGeom6D', 'Ig2_LevelSet_LevelSet_VolumeGeom',
               'Ig2_LevelSet_LevelSet_LSnodeGeom', 'Ig2_Wall_LevelSet_VolumeGeom')

kNoScene = {
    'Ig2_Tetra_Tetra_TTetraGeom':
        'no law functor takes its geometry, and an InteractionLoop without one ends the process',
}

kNoShape = {
    'Clump': 'has no bound; its members are bodies of their own',
    'Cylinder': 'no functor makes geometry from it; ChainedCylinder is the one that is used',
    'DeformableElement': 'no functor makes geometry from it: its forces come from its nodes',
    'DeformableCohesiveElement': 'as DeformableElement',
    'Lin4NodeTetra': 'as DeformableElement',
    'Lin4NodeTetra_Lin4NodeTetra_InteractionElement': 'as DeformableElement',
    'Node': 'as DeformableElement',
    'FluidDomainBbox': 'the outline of another program, in runs with MPI',
    'Subdomain': 'a part of the scene, in runs with MPI',
}


def vector(x):
    return Vector3(*map(float, x))


def fly(rng, bodies, speed=kSpeed, turn=.05):
    """Appends bodies at random places, with random velocities that last."""
    for body in bodies:
        body.state.blockedDOFs = 'xyzXYZ'
        body.state.pos = body.state.refPos = vector(rng.uniform(0, 1, 3))
        body.state.vel = vector(rng.normal(size=3) * speed)
        body.state.angVel = vector(rng.normal(size=3) * turn)
    return O.bodies.append(bodies)


def spheres(rng, n=50):
    fly(rng, [utils.sphere((0, 0, 0), float(r), material='m') for r in rng.uniform(.03, .06, n)])


def facets(rng, n=20):
    fly(rng, [utils.facet([vector(x) for x in rng.uniform(-.2, .2, (3, 3))], material='m') for _ in range(n)])


def boxes(rng, n=12):
    fly(rng, [utils.box((0, 0, 0), vector(rng.uniform(.02, .15, 3)), material='m') for _ in range(n)])


def sidedWalls(rng):
    """The linear functor ends the process where a sphere goes through a wall without sides."""
    walls(rng, sense=1)


def walls(rng, sense=0):
    for axis in range(3):
        wall = utils.wall(float(rng.uniform(.2, .8)), axis=axis, sense=sense, material='m')
        wall.state.blockedDOFs = 'xyzXYZ'
        wall.state.vel = vector(kSpeed * rng.normal(size=3) * (np.arange(3) == axis))
        O.bodies.append(wall)


def polyhedra(rng, n=20):
    from yade import polyhedra_utils    # not in every YADE
    # corners given: with a seed alone YADE makes another body each time
    fly(rng, [polyhedra_utils.polyhedra(O.materials['m'], v=[
        vector(x) for x in rng.uniform(-.12, .12, (10, 3))]) for _ in range(n)])


def tetrahedra(rng, n=25):
    fly(rng, [utils.tetra([vector(x) for x in rng.uniform(-.15, .15, (4, 3))], strictCheck=False,
                          material='m') for _ in range(n)])


def levelSets(rng, n=26, **more):
    fly(rng, [utils.levelSetBody('superellipsoid', extents=(.12, .09, .07), epsilons=(.7, 1.2), spacing=.03,
                                 nSurfNodes=102, material='m', **more) for _ in range(n)], turn=.02)


def levelSetsOfNeighbours(rng):
    """With the six neighbours of each surface node."""
    levelSets(rng, n_neighborsNodes=6)


def floor(rng, n=1):
    """A box below level sets, whose centres must stay out of it."""
    for body in O.bodies:
        (x, y, _), (u, v, _) = body.state.pos, body.state.vel
        body.state.pos = vector((x, y, rng.uniform(.13, .19)))
        body.state.vel = vector((u, v, rng.uniform(-.0007, .0007)))
    O.bodies.append(utils.box((.5, .5, -1), (9, 9, 1.1), fixed=True, material='m'))


def potentialParticles(rng, n=20):
    half, r = .09, .01
    bodies = []
    for k in range(n):
        box = Vector3(1, 1, 1) * half
        body = w.Body()
        body.shape = w.PotentialParticle(
            k=.2, r=r, R=3**.5 * half, id=k, AabbMinMax=True, isBoundary=False, a=[1, -1, 0, 0, 0, 0],
            b=[0, 0, 1, -1, 0, 0], c=[0, 0, 0, 0, 1, -1], d=[half - r] * 6, minAabb=3**.5 * box, maxAabb=3**.5 * box,
            minAabbRotated=1.02 * box, maxAabbRotated=1.02 * box)
        utils._commonBodySetup(body, 1, Vector3(1, 1, 1), material='m', pos=(0, 0, 0))
        bodies.append(body)
    fly(rng, bodies, turn=.01)


def chains(rng, n=6, links=4):
    """Chains of cylinders, each of which moves as a whole."""
    for _ in range(n):
        w.ChainedState.currentChain = next(_chainNumbers)
        start, step = rng.uniform(0, .7, 3), rng.normal(size=3) * .06
        velocity = rng.normal(size=3) * kSpeed
        for i in range(links):
            with warnings.catch_warnings(action='ignore'):  # deprecated in YADE
                body = gridpfacet.chainedCylinder(
                    vector(start + i * step), vector(start + (i + 1) * step), .03, material='m')
            body.state.blockedDOFs = 'xyzXYZ'
            body.state.vel = vector(velocity)


def gridNode(rng, place, velocity, radius=.02):
    body = gridpfacet.gridNode(vector(place), radius, fixed=True, material='node')
    body.state.vel = vector(velocity)
    return O.bodies.append(body)


def nodeVelocities(rng, n):
    """At rest, all alike, each another, or all but the first one at rest."""
    common, own = rng.normal(size=3) * kSpeed, rng.normal(size=(n, 3)) * kSpeed * .4
    kind = rng.integers(0, 4)
    if kind == 3:
        own[0] = 0
    return [np.zeros((n, 3)), np.tile(common, (n, 1)), common + own, own][kind]


def connections(rng, n=25):
    for _ in range(n):
        places = rng.uniform(0, 1, 3) + rng.uniform(-.25, .25, (2, 3))
        nodes = [gridNode(rng, *x) for x in zip(places, nodeVelocities(rng, 2))]
        O.bodies.append(gridpfacet.gridConnection(*nodes, .02, material='m'))


def pfacets(rng, n=10):
    for _ in range(n):
        places = rng.uniform(0, 1, 3) + rng.uniform(-.25, .25, (3, 3))
        nodes = [gridNode(rng, *x) for x in zip(places, nodeVelocities(rng, 3))]
        for a, b in ((0, 1), (1, 2), (2, 0)):
            O.bodies.append(gridpfacet.gridConnection(nodes[a], nodes[b], .02, material='m'))
        O.bodies.append(gridpfacet.pfacet(*nodes, material='m'))


def looseNodes(rng, n=30):
    """Grid nodes with a bound, which meet each other."""
    for k in range(n):
        node = gridNode(rng, rng.uniform(0, 1, 3), rng.normal(size=3) * kSpeed, .06)
        O.bodies[node].bounded = True
        O.bodies[node].mask = 1


def frictMat(young=1e5):
    return w.FrictMat(young=young, poisson=.3, density=1e3, label='m')


def polyhedraMat():
    return w.PolyhedraMat(density=1e3, young=1e5, poisson=.3, frictionAngle=.5, label='m')


def cohesiveMat(label='m', young=1e5):
    return w.CohFrictMat(young=young, poisson=.3, density=1e3, normalCohesion=1e30,
                         shearCohesion=1e30, momentRotationLaw=True, label=label)


class Scene:
    """Bodies of the given kinds, and the functors that they need beside their own: names, or
    (name, attributes)."""

    def __init__(self, *bodies, material=frictMat, physics=('Ip2_FrictMat_FrictMat_FrictPhys',),
                 laws=('Law2_ScGeom_FrictPhys_CundallStrack',), others=(), grid=False,
                 cohesive=False, loopAttributes=None):
        self.bodies, self.material = bodies, material
        self.physics, self.laws, self.others = list(physics), list(laws), list(others)
        self.grid, self.cohesive = grid, cohesive
        self.loopAttributes = loopAttributes or {}

    def build(self, functor, rng):
        """Fills the scene; returns the arguments of scenes.setEngines, and functors for bounds."""
        loop = self.loop(functor)
        O.engines = [loop]      # connections make their interactions through it
        O.materials.append(self.material())
        if self.grid:
            O.materials.append(cohesiveMat('node'))
        for make in self.bodies:
            make(rng)
        for body in O.bodies if functor in kNearIsReal else ():  # YADE's collider does not see that bodies turn
            body.state.angVel = Vector3.Zero
        return dict(interactionLoop=loop, functors=boundFunctors())

    def loop(self, functor):
        physics = [functorOf(entry) for entry in self.physics]
        laws = self.laws
        if self.grid or self.cohesive:
            physics.append(w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(
                setCohesionNow=self.grid, setCohesionOnNewContacts=False))
        if self.grid:
            laws = [*laws, 'Law2_ScGeom6D_CohFrictPhys_CohesionMoment', 'Law2_ScGridCoGeom_FrictPhys_CundallStrack',
                    'Law2_GridCoGridCoGeom_FrictPhys_CundallStrack']
        others = ['Ig2_GridNode_GridNode_GridNodeGeom6D'] if self.grid else []
        geometry = list(dict.fromkeys([functor, *others, *self.others]))
        # Sorted: functors of chains and grids look at other interactions of the same step.
        return w.InteractionLoop([functorOf(entry) for entry in geometry], physics,
                                 [functorOf(entry) for entry in laws],
                                 loopOnSortedInteractions=True, **self.loopAttributes)


def functorOf(entry):
    name, attributes = (entry, {}) if isinstance(entry, str) else entry
    return getattr(w, name)(**attributes)


def boundFunctors():
    names = ('Sphere', 'Facet', 'Box', 'Wall', 'Polyhedra', 'Tetra', 'LevelSet', 'ChainedCylinder',
             'GridConnection', 'PFacet')
    classes = [*(f'Bo1_{name}_Aabb' for name in names), 'PotentialParticle2AABB']
    return [getattr(w, name)() for name in classes if isHere(name)]


def isHere(name):
    """True if this YADE has the class."""
    return hasattr(w, name)


kVolumetric = dict(material=polyhedraMat, physics=['Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys'],
                   laws=['Law2_PolyhedraGeom_PolyhedraPhys_Volumetric'])
kFacetted = dict(material=polyhedraMat)
kLinear = dict(laws=['Law2_L3Geom_FrictPhys_ElPerfPl'])
kLinear6 = dict(laws=['Law2_L6Geom_FrictPhys_Linear'])
kChained = dict(material=cohesiveMat, physics=[], cohesive=True)
kSeveralPoints = dict(
    physics=[('Ip2_FrictMat_FrictMat_MultiFrictPhys', dict(kn=1e4, ks=1e4))],
    laws=[('Law2_MultiScGeom_MultiFrictPhys_CundallStrack', dict(sphericalBodies=False))])
kOverlapVolume = dict(physics=['Ip2_FrictMat_FrictMat_KnKsPhys'], laws=['Law2_VolumeGeom_FrictPhys_Elastic'])
kGridContacts = ['Ig2_GridConnection_GridConnection_GridCoGridCoGeom', 'Ig2_Sphere_PFacet_ScGridCoGeom']

kScenes = {
    'Ig2_Box_LevelSet_ScGeom': Scene(levelSets, floor),
    'Ig2_Box_Sphere_ScGeom': Scene(boxes, spheres),
    'Ig2_Box_Sphere_ScGeom6D': Scene(boxes, spheres),
    'Ig2_ChainedCylinder_ChainedCylinder_ScGeom6D': Scene(
        chains, laws=['Law2_ChCylGeom6D_CohFrictPhys_CohesionMoment',
                      'Law2_ScGeom6D_CohFrictPhys_CohesionMoment'], **kChained),
    'Ig2_Facet_Polyhedra_PolyhedraGeom': Scene(facets, polyhedra, **kVolumetric),
    'Ig2_Facet_Sphere_L3Geom': Scene(facets, spheres, **kLinear),
    'Ig2_Facet_Sphere_ScGeom': Scene(facets, spheres),
    'Ig2_Facet_Sphere_ScGeom6D': Scene(facets, spheres),
    'Ig2_GridConnection_GridConnection_GridCoGridCoGeom': Scene(connections, grid=True),
    'Ig2_GridConnection_PFacet_ScGeom': Scene(connections, pfacets, others=kGridContacts, grid=True),
    'Ig2_GridNode_GridNode_GridNodeGeom6D': Scene(looseNodes, grid=True),
    # It makes contacts of near bodies before they touch, and asks itself for their removal.
    'Ig2_LevelSet_LevelSet_LSnodeGeom': Scene(
        levelSetsOfNeighbours, laws=[('Law2_ScGeom_FrictPhys_CundallStrack', dict(neverErase=True))],
        loopAttributes=dict(warnRoleIg2=False)),
    'Ig2_LevelSet_LevelSet_MultiScGeom': Scene(levelSets, **kSeveralPoints),
    'Ig2_LevelSet_LevelSet_ScGeom': Scene(levelSets),
    'Ig2_LevelSet_LevelSet_VolumeGeom': Scene(levelSets, **kOverlapVolume),
    'Ig2_PFacet_PFacet_ScGeom': Scene(pfacets, others=kGridContacts, grid=True),
    'Ig2_PP_PP_ScGeom': Scene(potentialParticles, physics=['Ip2_FrictMat_FrictMat_KnKsPhys'],
                              laws=['Law2_SCG_KnKsPhys_KnKsLaw']),
    'Ig2_Polyhedra_Polyhedra_PolyhedraGeom': Scene(polyhedra, **kVolumetric),
    'Ig2_Polyhedra_Polyhedra_PolyhedraGeomOrScGeom': Scene(polyhedra, **kFacetted),
    'Ig2_Polyhedra_Polyhedra_ScGeom': Scene(polyhedra, **kFacetted),
    'Ig2_Sphere_ChainedCylinder_CylScGeom': Scene(
        spheres, chains, laws=['Law2_CylScGeom_FrictPhys_CundallStrack']),
    'Ig2_Sphere_ChainedCylinder_CylScGeom6D': Scene(
        spheres, chains, laws=['Law2_CylScGeom6D_CohFrictPhys_CohesionMoment'], **kChained),
    'Ig2_Sphere_GridConnection_ScGridCoGeom': Scene(spheres, connections, grid=True),
    'Ig2_Sphere_LevelSet_ScGeom': Scene(spheres, levelSets),
    'Ig2_Sphere_PFacet_ScGridCoGeom': Scene(spheres, pfacets, grid=True),
    'Ig2_Sphere_Polyhedra_ScGeom': Scene(spheres, polyhedra, **kFacetted),
    'Ig2_Sphere_Sphere_L3Geom': Scene(spheres, **kLinear),
    'Ig2_Sphere_Sphere_L6Geom': Scene(spheres, **kLinear6),
    'Ig2_Sphere_Sphere_ScGeom': Scene(spheres),
    'Ig2_Sphere_Sphere_ScGeom6D': Scene(spheres),
    'Ig2_Tetra_Tetra_TTetraSimpleGeom': Scene(
        tetrahedra, physics=['Ip2_ElastMat_ElastMat_NormPhys'],
        laws=['Law2_TTetraSimpleGeom_NormPhys_Simple']),
    'Ig2_Wall_LevelSet_MultiScGeom': Scene(walls, levelSets, **kSeveralPoints),
    'Ig2_Wall_LevelSet_ScGeom': Scene(walls, levelSets),
    'Ig2_Wall_LevelSet_VolumeGeom': Scene(walls, levelSets, **kOverlapVolume),
    'Ig2_Wall_PFacet_ScGeom': Scene(walls, pfacets, others=['Ig2_Wall_Sphere_ScGeom'], grid=True),
    'Ig2_Wall_Polyhedra_PolyhedraGeom': Scene(walls, polyhedra, **kVolumetric),
    'Ig2_Wall_Sphere_L3Geom': Scene(sidedWalls, spheres, **kLinear),
    'Ig2_Wall_Sphere_ScGeom': Scene(walls, spheres),
}
