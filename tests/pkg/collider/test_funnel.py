"""Spheres that fall into a funnel of imported facets: every ten steps, between the interaction loop and the
integrator, all contacts are compared with those by brute force."""

import builtins

import numpy as np
import pytest

import yade.wrapper as w
import yadefrag
from scenes import O, clear
from yade import utils, ymport

ROUNDING = 1e-12  # m, of two ways to compute the overlap


def writeFunnel(path, around, rings):
    """An STL file: a cone from radius .25 m at z = .3 m to .05 m at z = 0."""
    angles = 2 * np.pi * np.arange(around + 1) / around
    radii, heights = np.linspace(.05, .25, rings + 1), np.linspace(0, .3, rings + 1)
    with open(path, 'w') as out:
        out.write('solid funnel\n')
        for k in range(rings):
            for a, b in zip(angles, angles[1:]):
                corners = [(radii[j] * np.cos(t), radii[j] * np.sin(t), heights[j])
                           for j, t in ((k, a), (k, b), (k + 1, b), (k + 1, a))]
                for three in (0, 1, 2), (0, 2, 3):
                    out.write('facet normal 0 0 0\nouter loop\n%s\nendloop\nendfacet\n' %
                              '\n'.join('vertex %.9g %.9g %.9g' % corners[i] for i in three))
        out.write('endsolid funnel\n')


def distances(points, corners):
    """(n, m) from points (n, 3) to triangles (m, 3, 3)."""
    a, sides = corners, np.roll(corners, -1, axis=1) - corners
    least = np.full((len(points), len(corners)), np.inf)
    for k in range(3):
        off = points[:, None] - a[None, :, k]
        along = np.clip((off * sides[:, k]).sum(2) / (sides[:, k]**2).sum(1), 0, 1)
        least = np.minimum(least, np.linalg.norm(off - along[..., None] * sides[:, k], axis=2))
    normal = np.cross(sides[:, 0], sides[:, 1])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    off = points[:, None] - a[None, :, 0]
    above = (off * normal).sum(2)
    inside = np.ones_like(above, bool)
    for k in range(3):
        inside &= (np.cross(normal, sides[:, k]) * (points[:, None] - a[None, :, k])).sum(2) >= 0
    return np.where(inside, np.minimum(least, abs(above)), least)


class Check:
    """Counts real contacts, and overlaps by brute force without one."""

    def __init__(self, facets, spheres):
        self.facets, self.spheres = np.array(facets), np.array(spheres)
        self.corners = np.array([[O.bodies[f].state.pos + v for v in O.bodies[f].shape.vertices] for f in facets])
        self.radii = np.array([O.bodies[s].shape.radius for s in spheres])
        self.found = self.withFacets = 0
        self.missed = []

    def __call__(self):
        at = np.array([O.bodies[int(s)].state.pos for s in self.spheres])
        real = {tuple(sorted((i.id1, i.id2))) for i in O.interactions if i.isReal}
        gaps = distances(at, self.corners) - self.radii[:, None]
        pairs = [(self.facets[f], self.spheres[s]) for s, f in zip(*np.nonzero(gaps < -ROUNDING))]
        self.withFacets += len(pairs)
        near = np.linalg.norm(at[:, None] - at, axis=2) - self.radii - self.radii[:, None]
        pairs += [(self.spheres[s], self.spheres[t]) for s, t in zip(*np.nonzero(np.triu(near < -ROUNDING, 1)))]
        pairs = {tuple(sorted(map(int, pair))) for pair in pairs}
        self.found += len(pairs)
        self.missed += [(O.iter, *pair) for pair in pairs - real]


def fall(engine, folder):
    clear()
    rng = np.random.default_rng(28)
    O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2500, frictionAngle=.5))
    writeFunnel(folder + '/funnel.stl', 24, 6)
    facets = O.bodies.append(ymport.stl(folder + '/funnel.stl'))
    places = rng.permutation([(x, y, z) for x in range(-5, 6) for y in range(-5, 6) for z in range(8)
                              if x**2 + y**2 < 30])[:300]
    spheres = []
    for place in places:
        one = utils.sphere(place * .034 + (0, 0, .33), rng.uniform(.008, .016))
        one.state.vel = (*rng.uniform(-2, 2, 2), -rng.uniform(5, 12))
        spheres.append(O.bodies.append(one))
    builtins.checkFunnel = Check(facets, spheres)
    O.engines = [
        w.ForceResetter(), engine([w.Bo1_Sphere_Aabb(), w.Bo1_Facet_Aabb()]),
        w.InteractionLoop([w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Facet_Sphere_ScGeom()],
                          [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()]),
        w.PyRunner(command='checkFunnel()', iterPeriod=10), w.NewtonIntegrator(gravity=(0, 0, -9.81))]
    O.dt = utils.PWaveTimeStep()
    try:
        O.run(600, True)
        return builtins.checkFunnel
    finally:
        del builtins.checkFunnel


@pytest.mark.parametrize('settings', [{}, dict(adaptInterval=False, trueHalo=False)])
def test_noContactIsMissed(settings, folder):
    check = fall(lambda bounds: yadefrag.LebesgueCollider(bounds, **settings), folder)
    assert check.found > 1000 and check.withFacets > 250
    assert not check.missed


def test_theCheckSeesMissedContacts(folder):
    """A collider that stops before the spheres touch."""
    check = fall(lambda bounds: yadefrag.LebesgueCollider(bounds, dead=True), folder)
    assert check.found > 0 and len(check.missed) == check.found
