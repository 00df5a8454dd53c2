"""CurveLoop with spheres beside facets, walls and boxes: the bits of YADE's functors, for faces, edges and corners, shapes
that move, and all options."""
import numpy as np
import pytest
import yade.config
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Quaternion, Vector3

import scenes
from loop_twins import geometries, requireSame
from scenes import O

kShapes = dict(
    facets=dict(facets=60),
    boxes=dict(boxes=25),
    walls=dict(walls=True),
    all=dict(facets=30, boxes=10, walls=True),
    periodic=dict(facets=30, boxes=10, periodic=True),
    few=dict(facets=30, boxes=10, walls=True, apart=300),
)
kOptions = dict(
    default={},
    planes=dict(Facet=dict(hertzian=True), Wall=dict(hertzian=True, noRatch=False),
                Box=dict(interactionDetectionFactor=1.3)),
    tiles=dict(Facet=dict(shrinkFactor=.01)),
)


def scattered(facets=0, boxes=0, walls=False, periodic=False, apart=0, seed=1):
    """Spheres of several sizes between shapes that move and turn; `apart`: spheres more, which touch nothing."""
    scenes.clear()
    chance = np.random.default_rng(seed)
    O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    if periodic:
        O.periodic = True
        O.cell.setBox(8, 8, 8)
    places = chance.uniform(0, 8, (150, 3))
    scenes.addSpheres(places, chance.choice([.2, .4, .7], len(places)), chance.normal(0, 5, (len(places), 3)), dynamic=True)
    made = []
    for _ in range(facets):
        made.append(utils.facet((chance.uniform(0, 8, 3) + chance.uniform(-1.5, 1.5, (3, 3))).tolist()))
    for _ in range(boxes):
        made.append(utils.box(chance.uniform(0, 8, 3), chance.uniform(.2, 1, 3), fixed=True))
        made[-1].state.ori = Quaternion(Vector3(*chance.normal(0, 1, 3)), chance.uniform(0, 6))
    if walls:
        made += [utils.wall(place, axis, sense) for axis in range(3) for place, sense in ((0, 1), (8, -1), (4, 0))]
    O.bodies.append(made)
    for body in made:
        body.state.vel = Vector3(*chance.normal(0, 1, 3))
        if not isinstance(body.shape, w.Wall):
            body.state.angVel = Vector3(*chance.normal(0, 2, 3))
    for number in range(apart):
        O.bodies.append(utils.sphere((20 + number, 0, 0), .3, fixed=True))
    O.dt = 1e-4


def functors(**options):
    """`options`: attributes of the functors of a shape, by its name."""
    return geometries(others=options), [w.Ip2_FrictMat_FrictMat_FrictPhys()], \
        [w.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]


def ofShapes():
    """Contacts of a sphere with another shape."""
    return [i for i in O.interactions if not isinstance(O.bodies[i.id1].shape, w.Sphere)]


@pytest.mark.parametrize('options', kOptions)
@pytest.mark.parametrize('shapes', kShapes)
def test_bits(shapes, options):
    settings = kShapes[shapes]
    loop = requireSame(lambda: functors(**kOptions[options]), 400, build=scattered, **settings)
    real, others = O.interactions.countReal(), ofShapes()
    assert len(others) > 10
    assert loop.fastForces == real
    # Tiles that shrink are left to YADE's functor; it computes the first geometry of each contact, and a distant box
    # is a contact that begins and ends in each step.
    tiles = sum(isinstance(O.bodies[i.id1].shape, w.Facet) for i in others) if options == 'tiles' else 0
    assert loop.fastGeometries == pytest.approx(real - tiles, abs=.5 * real if options == 'planes' else 6)
    if shapes == 'all' and options == 'tiles':
        lines = loop.report().splitlines()
        for words in ('Box and Sphere: geometry by the loop, force by the loop',
                      'Wall and Sphere: geometry by the loop',
                      "Facet and Sphere: geometry by YADE's Ig2_Facet_Sphere_ScGeom"):
            assert any(words in line for line in lines)


@pytest.mark.parametrize('seed', range(2, 12))
def test_randomScenes(seed):
    chance = np.random.default_rng(seed)
    options = dict(Facet=dict(hertzian=bool(chance.integers(2))),
                   Wall=dict(hertzian=bool(chance.integers(2)), noRatch=bool(chance.integers(2))),
                   Box=dict(interactionDetectionFactor=chance.choice([1, 1.1])))
    if yade.config.version >= '2025.2':
        options['Box']['hertzian'] = bool(chance.integers(2))
    loop = requireSame(lambda: functors(**options), 200, build=scattered, seed=seed, threads=1 + seed % 2,
                       **kShapes[list(kShapes)[seed % len(kShapes)]])
    assert len(ofShapes()) > 5 and loop.fastForces == O.interactions.countReal()


def test_shapesThatChange():
    """A facet that a script makes smaller, one that it removes, one that becomes a wall."""
    def change(part):
        body = O.bodies[150 + part]
        corners = [corner * .8 for corner in body.shape.vertices]
        body.shape.setVertices(*corners)
        O.bodies.erase(160 + part)
        O.bodies[part].shape.radius *= .9
    loop = requireSame(functors, 400, build=scattered, change=change, **kShapes['all'])
    assert loop.fastForces >= O.interactions.countReal() > 100
    touching = ofShapes()[0]
    first, second = touching.id1, touching.id2
    O.bodies[first].shape = w.Wall(axis=2)
    O.step()
    O.step()
    now = O.interactions[first, second]
    assert not now.isReal or abs(now.geom.normal[2]) == 1
