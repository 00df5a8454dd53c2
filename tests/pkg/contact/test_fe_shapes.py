"""Surface segments, their bounds and their contacts with spheres: rigid chains made by hand."""
import math

import numpy as np
import pytest

from fe_scene import chain, newBall, O, reloaded, rigid, sphereEngines, steps
from yade import utils, wrapper as w
from yade.minieigenHP import Vector3

RADIUS = .1


def material(**attributes):
    made = w.FEMat(young=1e6, poisson=.3, density=1000, frictionAngle=0, **attributes)
    O.materials.append(made)
    return made


def hexagon():
    return np.array([(math.cos(a), math.sin(a)) for a in np.arange(6) * math.pi / 3])


def smoothChain(points, material, **attributes):
    """Bodies of the arcs around the nodes of the closed polygon `points` (n, 2)."""
    bodies = []
    for i, b in enumerate(points):
        a, c = points[i - 1], points[(i + 1) % len(points)]
        start, middle, end, before, after = (
            Vector3(*map(float, place), 0) for place in (.5 * (a + b), b, .5 * (b + c), b - a, c - b))
        shape = w.SurfaceSegment(kind=3, start=start, middle=middle, end=end, before=before.normalized(),
                                 after=after.normalized(), **attributes)
        bodies.append(rigid(shape, material))
    return bodies


def arcPoints(points, count=400):
    """Many points of the closed smooth curve around the nodes `points`, in order."""
    xi = np.linspace(0, 1, count, endpoint=False)[:, None]
    h = (2 - 3 * xi + xi**3) / 4, (2 + 3 * xi - 3 * xi**2) / 4, (3 * xi**2 - xi**3) / 4
    return np.concatenate([sum(part * points[(i + k) % len(points)] for k, part in zip((-1, 0, 1), h))
                           for i in range(len(points))])


@pytest.mark.parametrize('ending', ['.xml', '.yade.gz'])
def test_allIsSavedAndLoaded(ending, folder):
    brittle = w.BrittleFEMat(tensileStrength=3e8, fractureEnergy=50, shearFactor=2,
                             shearEnergyFactor=3, weibullModulus=20, strengthScatter=.1, seed=7, planeStress=True,
                             young=3e11, poisson=.2, density=3900, frictionAngle=.3, label='c')
    O.materials.append(brittle)
    O.bodies.append(smoothChain(hexagon(), brittle, halo=.01, entry=3, component=1, selfContact=False))
    sphereEngines()
    wanted = [O.bodies[2].shape.dict(), O.materials['c'].dict()]
    reloaded('%s/scene%s' % (folder, ending))
    shape = O.bodies[2].shape
    assert [shape.dict(), O.materials['c'].dict()] == wanted
    assert type(shape) is w.SurfaceSegment and type(O.materials['c']) is w.BrittleFEMat
    assert type(O.bodies[2].material) is w.BrittleFEMat
    assert w.Bo1_SurfaceSegment_Aabb in map(type, O.engines[1].boundDispatcher.functors)
    assert w.Ig2_Sphere_SurfaceSegment_ScGeom in map(type, O.engines[2].geomDispatcher.functors)


def test_boundOfASegment(collider):
    O.bodies.append(chain([(1, 2), (4, 1)], material(), halo=.25))
    sphereEngines(collider([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()], verletDist=0))
    O.step()
    bound = O.bodies[0].bound
    assert tuple(bound.min) == (.75, .75, -.25) and tuple(bound.max) == (4.25, 2.25, .25)


def test_boundOfAnArcHoldsTheCurve():
    O.bodies.append(smoothChain(hexagon(), material()))
    sphereEngines()
    O.step()
    points = arcPoints(hexagon(), 200).reshape(6, 200, 2)
    for b, curve in zip(O.bodies, points):
        assert (curve >= np.array(b.bound.min)[:2] - 1e-12).all()
        assert (curve <= np.array(b.bound.max)[:2] + 1e-12).all()
        # not the box of the node: the arc stays within its own control points
        a, m, c = (np.array(p)[:2] for p in (b.shape.start, b.shape.middle, b.shape.end))
        hull = np.array([a, (a + m) / 2, (m + c) / 2, c])
        assert np.allclose(np.array(b.bound.min)[:2], hull.min(0))
        assert np.allclose(np.array(b.bound.max)[:2], hull.max(0))


def bounce(makeFloor, segmentsFirst):
    """Heights of a ball that falls onto a floor at y = 0 and comes back; one per 10 steps."""
    O.reset()
    O.dt = 2e-4
    mat = material()
    floor = makeFloor(mat)
    ball = newBall((.237, .102), RADIUS, mat)
    O.bodies.append(floor + [ball] if segmentsFirst else [ball] + floor)
    ball.state.vel = (0, -1, 0)
    ball.state.blockedDOFs = 'zXYZ'
    sphereEngines()
    heights = []
    for _ in range(60):
        steps(10)
        heights.append(ball.state.pos[1])
    return np.array(heights), ball.state.vel


@pytest.mark.parametrize('segmentsFirst', [True, False])
def test_flatChainIsAWall(segmentsFirst):
    def wall(mat):
        return [utils.wall(0, axis=1, material=mat)]

    def segments(mat):
        return chain([(x, 0) for x in np.linspace(1, -1, 21)], mat)

    ours, velocity = bounce(segments, segmentsFirst)
    wanted, wallVelocity = bounce(wall, segmentsFirst)
    assert wanted.min() < .95 * RADIUS and wanted[-1] > RADIUS
    assert np.abs(ours - wanted).max() < 1e-12
    assert abs(velocity[1] - wallVelocity[1]) < 1e-12 and velocity[0] == 0


def forceAt(ball, centre):
    """Force (2,) on a ball held at `centre`, from all interactions there."""
    ball.state.pos = (centre[0], centre[1], 0)
    O.step()
    return np.array(O.forces.f(ball.id, True))[:2]


def stiffness():
    """Of a contact of two equal materials and radii, as Ip2_FrictMat_FrictMat_FrictPhys has it."""
    return 1e6 * RADIUS


def heldBall(bodies, mat):
    ball = newBall((50, 50), RADIUS, mat)
    ball.state.blockedDOFs = 'xyzXYZ'
    O.bodies.append(bodies + [ball])
    sphereEngines(w.LebesgueCollider([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()], verletDist=0), newton=False)
    return ball


@pytest.mark.parametrize('bend', [0, 1e-9, 1e-3, .05, .5, 1.5, -1e-9, -1e-3, -.05, -.5])
def test_forceIsContinuousOverAJoint(bend):
    """A ball slides past the joint of two sides at angle `bend` (rad; positive: convex)."""
    mat = material()
    side = np.array([math.cos(bend), -math.sin(bend)])
    ball = heldBall(chain([side, (0, 0), (-1, 0)], mat), mat)
    step = 2e-4
    forces = []
    for x in np.arange(-.05, .05, step):
        uphill = -x * math.tan(bend) if bend < 0 < x else 0
        forces.append(forceAt(ball, (x, .985 * RADIUS + uphill)))
    forces = np.array(forces)
    jumps = np.linalg.norm(np.diff(forces, axis=0), axis=1)
    assert (forces[:, 1] > 0)[:len(forces) // 2].all()
    assert jumps.max() < 4 * stiffness() * step
    if abs(bend) < 1e-6:
        assert np.allclose(forces[:, 1], stiffness() * .015 * RADIUS, rtol=1e-6)


def test_bothSidesOfAConcaveCornerHoldABall():
    mat = material()
    ball = heldBall(chain([(0, 1), (0, 0), (-1, 0)], mat), mat)
    force = forceAt(ball, (-.09, .08))
    assert force == pytest.approx(stiffness() * np.array([-.01, .02]), abs=1e-6 * stiffness())


def test_deepBallIsPushedOut():
    mat = material()
    ball = heldBall(chain([(x, 0) for x in np.linspace(1, -1, 9)], mat), mat)
    for depth in (.2, .5, .9):
        force = forceAt(ball, (.1, -depth * RADIUS))
        assert force[1] == pytest.approx(stiffness() * RADIUS * (1 + depth), rel=1e-9)
    assert (forceAt(ball, (.1, -1.1 * RADIUS)) == 0).all()


def test_frictionlessRollKeepsItsEnergy():
    """A ball slides along a bumpy closed chain of small segments, under no force but contact."""
    O.dt = 1e-4
    mat = material()
    angles = np.arange(48) * 2 * math.pi / 48
    ring = np.array([((1 + .02 * math.cos(8 * a)) * math.cos(a),
                      (1 + .02 * math.cos(8 * a)) * math.sin(a)) for a in -angles])
    O.bodies.append(chain(ring, mat, closed=True))  # clockwise: a hole
    ball = newBall((.7, 0), RADIUS, mat)
    ball.state.blockedDOFs = 'zXYZ'
    ball.state.vel = (.3, 1, 0)
    O.bodies.append(ball)
    sphereEngines()
    start = ball.state.vel.squaredNorm()
    speeds = []
    for _ in range(400):
        steps(100)
        if not len(list(O.interactions)):
            speeds.append(ball.state.vel.squaredNorm() / start)
        assert ball.state.pos.norm() < 1.05
    assert O.iter == 40000 and len(speeds) > 10
    assert np.abs(np.array(speeds) - 1).max() < .01


def test_movingBoundaryDragsByFriction():
    """The relative velocity is that at the contact point: a turning piece counts."""
    mat = material()
    mat.frictionAngle = .5
    O.dt = 1e-5
    floor = chain([(1, 0), (-1, 0)], mat)
    floor[0].state.vel = (.2, 0, 0)
    floor[0].state.angVel = (0, 0, .5)
    ball = heldBall(floor, mat)
    ball.state.pos = (.3, .99 * RADIUS, 0)
    O.step()
    geom = O.interactions[0, 1].geom
    incident = geom.incidentVel(O.interactions[0, 1], False)
    # ball is body 1 of the contact; the piece moves at vel + ω × (point - pos) there, halfway into
    # the overlap; its position is the origin, though the piece goes from 1 to -1
    depth = .005 * RADIUS
    assert tuple(incident) == pytest.approx((.2 + .5 * depth, .5 * .3, 0), abs=1e-12)
    assert tuple(geom.normal) == pytest.approx((0, -1, 0))
    assert tuple(geom.contactPoint) == pytest.approx((.3, -depth, 0))
    assert tuple(geom.shearInc) == pytest.approx(((.2 + .5 * depth) * O.dt, 0, 0), abs=1e-15)


def test_explicitInteractionEitherWay():
    mat = material()
    ball = heldBall(chain([(1, 0), (-1, 0)], mat), mat)
    ball.state.pos = (.1, .09, 0)
    for ids in ((0, 1), (1, 0)):
        O.interactions.clear()
        made = utils.createInteraction(*ids)
        assert (made.id1, made.id2) == (1, 0)
        assert made.geom.penetrationDepth == pytest.approx(.01)
