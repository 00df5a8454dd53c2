"""Chains of SurfaceSegment bodies made by hand: rigid boundaries, material on the left."""
import builtins

import numpy as np
import yade.wrapper as w
from yade.minieigenHP import Vector3

O = builtins.O


def vector(p):
    return Vector3(float(p[0]), float(p[1]), 0)


def unit(p):
    p = np.asarray(p, float)
    return p / np.linalg.norm(p)


def body(shape, material):
    """A body that does not obey forces, with `shape` and a material (an object)."""
    made = w.Body()
    made.shape = shape
    made.material = material
    made.state.blockedDOFs = 'xyzXYZ'
    return made


def straight(points, material, closed=False, **attributes):
    """Bodies of the straight pieces along `points` (n,2)."""
    points = np.asarray(points, float)
    n = len(points)
    count = n if closed else n - 1
    travel = [unit(points[(i + 1) % n] - points[i]) for i in range(count)]
    bodies = []
    for i in range(count):
        shape = w.SurfaceSegment(start=vector(points[i]), end=vector(points[(i + 1) % n]),
                                 **attributes)
        if closed or i > 0:
            shape.before = vector(travel[i - 1])
        if closed or i + 1 < count:
            shape.after = vector(travel[(i + 1) % count])
        bodies.append(body(shape, material))
    return bodies


def smooth(points, material, **attributes):
    """Bodies of the arcs around the nodes of the closed polygon `points` (n,2)."""
    points = np.asarray(points, float)
    n = len(points)
    bodies = []
    for i in range(n):
        a, b, c = points[i - 1], points[i], points[(i + 1) % n]
        shape = w.SurfaceSegment(kind=3, start=vector(.5 * (a + b)), middle=vector(b),
                                 end=vector(.5 * (b + c)), before=vector(unit(b - a)),
                                 after=vector(unit(c - b)), **attributes)
        bodies.append(body(shape, material))
    return bodies


def arcPoints(points, count=400):
    """Many points of the closed smooth curve around the nodes `points`, in order."""
    points = np.asarray(points, float)
    xi = np.linspace(0, 1, count, endpoint=False)[:, None]
    h = [(2 - 3 * xi + xi**3) / 4, (2 + 3 * xi - 3 * xi**2) / 4, (3 * xi**2 - xi**3) / 4]
    pieces = []
    for i in range(len(points)):
        nodes = points[i - 1], points[i], points[(i + 1) % len(points)]
        pieces.append(sum(hi * p for hi, p in zip(h, nodes)))
    return np.concatenate(pieces)


def ball(centre, radius, material, **attributes):
    """A sphere's body at `centre` (2,), free to move."""
    from yade import utils
    made = utils.sphere((float(centre[0]), float(centre[1]), 0), radius, **attributes)
    made.material = material
    return made


def engines(collider=None, newton=True):
    """The usual loop for spheres and surface segments."""
    collider = collider or w.InsertionSortCollider(
        [w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb(), w.Bo1_Wall_Aabb()])
    loop = w.InteractionLoop(
        [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Sphere_SurfaceSegment_ScGeom(),
         w.Ig2_Wall_Sphere_ScGeom()],
        [w.Ip2_FrictMat_FrictMat_FrictPhys()], [w.Law2_ScGeom_FrictPhys_CundallStrack()])
    O.engines = [w.ForceResetter(), collider, loop]
    if newton:
        O.engines = O.engines + [w.NewtonIntegrator(damping=0)]
    return collider
