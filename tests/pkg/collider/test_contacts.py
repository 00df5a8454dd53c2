"""No true contact missing at any step, compared with a reference without a collider."""
import numpy as np
import pytest
import yade.wrapper as w
from yade import utils
from yade.minieigenHP import Vector3
import scenes
from scenes import addSpheres, O, setEngines, stepAndCheck


def uniform(rng, n, dim=3):
    radii = rng.uniform(.02, .06, n) * (1 if dim == 3 else .5)
    return addZ(rng.uniform(0, 1, (n, dim)), dim), radii


def clustered(rng, n, dim=3):
    centres = rng.uniform(0, 1, (6, dim))[rng.integers(0, 6, n)] + rng.normal(0, .05, (n, dim))
    return addZ(centres, dim), rng.uniform(.005, .02, n)


def ratios(rng, n, dim=3):
    """Radii over four decades, the small ones near the surface of the large ones."""
    radii = 10**rng.uniform(-5, -1, n)
    radii[:3] = .1
    radii[3:8] = 1e-5
    direction = rng.normal(size=(n, dim))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    home = rng.uniform(0, 1, (3, dim))
    centres = home[rng.integers(0, 3, n)] + direction * (.1 + radii * rng.uniform(0, 2, n))[:, None]
    centres[:3] = home
    return addZ(centres, dim), radii


def coincident(rng, n, dim=3):
    centres = rng.uniform(0, 1, (max(1, n // 8), dim))[rng.integers(0, max(1, n // 8), n)]
    return addZ(centres, dim), rng.uniform(.01, .03, n)


def collinear(rng, n, dim=3):
    centres = np.zeros((n, 3))
    centres[:, rng.integers(0, dim)] = np.round(rng.uniform(0, 1, n) * n) / n
    return centres, np.full(n, .5 / n)      # neighbours touch exactly


def lattice(rng, n, dim=3):
    """A regular grid: every bound coincides with bounds of neighbours."""
    side = int(np.ceil(n**(1 / dim)))
    grid = np.stack(np.meshgrid(*[np.arange(side)] * dim, indexing='ij'), -1).reshape(-1, dim)[:n]
    return addZ(grid * .125, dim), np.full(len(grid), .0625 * rng.choice([1, 1.01]))


def addZ(centres, dim):
    return centres if dim == 3 else np.c_[centres, np.zeros(len(centres))]


kScenes = [uniform, clustered, ratios, coincident, collinear, lattice]


def velocitiesFor(rng, centres, radii, dim, fast=3):
    """Most move by a tenth of a radius per step, a few by ten times the median radius."""
    velocity = rng.normal(size=(len(centres), 3)) * radii[:, None] * .1
    velocity[rng.integers(0, len(centres), fast)] *= 100 * np.median(radii) / radii.max()
    if dim == 2:
        velocity[:, 2] = 0
    return velocity


def kinematic(collider, centres, radii, velocity, **attributes):
    O.dt = 1
    addSpheres(centres, radii, velocity)
    return setEngines(collider(**attributes))


def moving(collider, seed, n=120, speed=None, **attributes):
    """Spheres in a unit box: the generator of their places; velocities are normal, or those of velocitiesFor."""
    rng = np.random.default_rng(seed)
    centres, radii = uniform(rng, n)
    velocity = velocitiesFor(rng, centres, radii, 3) if speed is None else 0 * centres
    if speed:
        velocity = rng.normal(size=(n, 3)) * speed
    kinematic(collider, centres, radii, velocity, **attributes)
    return rng


@pytest.mark.parametrize('dim', [2, 3])
@pytest.mark.parametrize('shape', kScenes, ids=lambda f: f.__name__)
def testRandomScenes(collider, shape, dim):
    total = 0
    for seed in range(3):
        rng = np.random.default_rng(seed)
        scenes.clear()
        centres, radii = shape(rng, 120, dim)
        kinematic(collider, centres, radii, velocitiesFor(rng, centres, radii, dim))
        total += stepAndCheck(steps=25)
    assert total > 50       # the scenes do have contacts


@pytest.mark.parametrize('scale', [1e-9, 1, 1e9])
@pytest.mark.parametrize('offset', [0, 1e6])
def testScaleAndOffset(collider, scale, offset):
    rng = np.random.default_rng(7)
    centres, radii = uniform(rng, 120)
    velocity = velocitiesFor(rng, centres, radii, 3)
    kinematic(collider, (centres + offset) * scale, radii * scale, velocity * scale)
    assert stepAndCheck(steps=25) > 50


@pytest.mark.parametrize('attributes', [
    dict(verletDist=0), dict(verletDist=.01), dict(verletDist=-2), dict(verletDist=.05, targetInterv=0),
    dict(targetInterv=5), dict(minSweepDistFactor=.001), dict(minSweepDistFactor=1), dict(sortAxis=1),
    dict(sortThenCollide=True), dict(updatingDispFactor=1.5), dict(adaptInterval=False, trueHalo=False)], ids=str)
def testAttributes(collider, attributes):
    moving(collider, 11, **attributes)
    assert stepAndCheck(steps=40) > 50


def testAcceleratedBodies(collider):
    """Speeds that grow a hundredfold after the first search."""
    moving(collider, 3, speed=1e-4)
    for _ in range(40):
        stepAndCheck()
        for body in O.bodies:
            body.state.vel *= 1.2


@pytest.mark.parametrize('verletDist', [0, -.5])
def testJumps(collider, verletDist):
    """Positions set from Python: found at once without strides, one step later with them."""
    rng = moving(collider, 5, speed=.001, verletDist=verletDist)
    stepAndCheck()
    for _ in range(15):
        jumped = [int(i) for i in rng.integers(0, 120, 10)]
        for i in jumped:
            O.bodies[i].state.pos = Vector3(*rng.uniform(0, 1, 3))
        assert stepAndCheck(mayMiss=jumped if verletDist else (), steps=2)


def testFewBodies(collider):
    """None, one, two bodies, and back."""
    setEngines(collider())
    O.step()
    addSpheres([(0, 0, 0)], [1])
    stepAndCheck(steps=2)
    addSpheres([(1, 0, 0)], [1])
    assert stepAndCheck(steps=2) == 2
    O.bodies.erase(0)
    stepAndCheck(steps=2)
    O.bodies.erase(1)
    stepAndCheck(steps=2)
    addSpheres([(0, 0, 0), (0, 1.5, 0)], [1, 1])
    assert stepAndCheck(steps=2) == 2


@pytest.mark.parametrize('redirection', [False, True])
def testBodiesComeAndGo(collider, redirection):
    """Appended, erased and put back at an erased id, at any step."""
    O.bodies.enableRedirection = redirection
    rng = moving(collider, 13, 150, .003)
    total = stepAndCheck()
    free = []
    for k in range(40):
        for i in rng.integers(0, len(O.bodies), 4):
            if O.bodies[int(i)]:
                O.bodies.erase(int(i))
                free.append(int(i))
        if k % 2:
            addSpheres(*uniform(rng, 5), rng.normal(size=(5, 3)) * .003)
        if k % 5 == 4:
            for i in free[:6]:
                if not O.bodies[i]:
                    assert O.bodies.insertAtId(held(rng.uniform(0, 1, 3), .05), i) == i
            free = free[6:]
        total += stepAndCheck(steps=1 + k % 2)
    assert total > 100


def held(place, radius):
    body = utils.sphere(Vector3(*place), radius)
    body.state.blockedDOFs = 'xyzXYZ'
    return body


def testInsertBeyondTheEnd(collider):
    """insertAtId past the last body leaves a gap of ids that never existed."""
    O.bodies.enableRedirection = True
    setEngines(collider())
    addSpheres([(0, 0, 0)], [1])
    stepAndCheck()
    O.bodies.insertAtId(held((1., 0., 0.), 1), 40)
    assert stepAndCheck(steps=2) == 2


def testClearedBodies(collider):
    rng = moving(collider, 17, 60, 0)
    stepAndCheck()
    O.interactions.clear()
    O.bodies.clear()
    addSpheres(*uniform(rng, 30))
    assert stepAndCheck(steps=2)


def testMasks(collider):
    rng = np.random.default_rng(19)
    centres, radii = uniform(rng, 150)
    addSpheres(centres, radii * 1.5, rng.normal(size=(150, 3)) * .005)
    for body in O.bodies:
        body.mask = int(rng.integers(0, 8))
    O.dt = 1
    setEngines(collider(avoidSelfInteractionMask=2))
    assert stepAndCheck(avoid=2, steps=15) > 50


def testUnboundedBodies(collider):
    """bounded=False: never found, and no obstacle to the others."""
    rng = np.random.default_rng(23)
    centres, radii = uniform(rng, 100)
    addSpheres(centres, radii * 1.5)
    for i in range(0, 100, 3):
        O.bodies[i].bounded = False
    setEngines(collider())
    assert stepAndCheck(steps=3)
    assert not any(i % 3 == 0 or j % 3 == 0 for i, j in scenes.allPairs())


def testBodyWithoutShapeOrFunctor(collider):
    O.bodies.append(w.Body())
    addSpheres([(0, 0, 0), (1, 0, 0)], [1, 1])
    O.bodies.append(utils.wall(.2, axis=0))
    setEngines(collider([w.Bo1_Sphere_Aabb()]))
    O.bodies[0].bounded = False
    assert stepAndCheck(steps=2) == 2


def testClumps(collider):
    """Members of one clump never meet, those of two do; clumps are released and erased."""
    rng = np.random.default_rng(29)
    O.dt = 1e-2
    ids = []
    for k in range(25):
        c = rng.uniform(0, 1, 3)
        members = [utils.sphere(Vector3(*c), .06), utils.sphere(Vector3(*(c + [.05, 0, 0])), .05)]
        ids.append(O.bodies.appendClumped(members))
    addSpheres(*uniform(rng, 50))
    for clump, _ in ids:
        O.bodies[clump].state.blockedDOFs = 'xyzXYZ'
        O.bodies[clump].state.vel = Vector3(*rng.normal(size=3))
        O.bodies[clump].state.angVel = Vector3(*rng.normal(size=3))
    setEngines(collider())
    assert stepAndCheck(steps=15) > 50
    O.bodies.releaseFromClump(ids[0][1][0], ids[0][0])
    O.bodies.erase(ids[1][0], True)
    assert stepAndCheck(steps=10)


def testEnlargedBounds(collider):
    """aabbEnlargeFactor keeps its meaning: distant interactions appear as potential ones."""
    addSpheres([(0, 0, 0), (2.5, 0, 0), (2.5 + 3.2, 0, 0)], [1, 1, 1])
    setEngines(collider([w.Bo1_Sphere_Aabb(aabbEnlargeFactor=1.5)], verletDist=0))
    O.step()
    assert scenes.allPairs() == {(0, 1)}


def testRealPairsAreKept(collider):
    """A real interaction stays, however far its bodies: only its law may end it."""
    O.materials.append(w.CohFrictMat(isCohesive=True, normalCohesion=1e30, shearCohesion=1e30))
    addSpheres([(0, 0, 0), (1, 0, 0)], [.5001, .5001], [(0, 0, 0), (1000., 0, 0)])
    setEngines(collider(), interactionLoop=w.InteractionLoop(
        [w.Ig2_Sphere_Sphere_ScGeom6D()],
        [w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True, setCohesionOnNewContacts=True)],
        [w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]))
    for _ in range(20):
        O.step()
    assert set(scenes.realPairs()) == {(0, 1)}
