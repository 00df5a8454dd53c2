"""One process of one measurement of `scripts/bench mpi`: `yade -n -x mpi_measure.py COLLIDER BODIES STEPS`.

The gas of scenes.py above a plate of the master, in slices along x of equal numbers of spheres. The
master prints one line of JSON: times of all steps after the first (s), and the searches in them.
"""
import json
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade import O, config, utils  # noqa: E402
from yade import mpy as mp  # noqa: E402
from yade import wrapper as w  # noqa: E402

import yadefrag  # noqa: E402, F401
import scenes  # noqa: E402

kVerletDist = .5 * scenes.RADIUS    # a negative one would make YADE's master search at every step


def build(collider, n):
    parts = scenes.gas(n, 1)
    spheres = sorted((b.state.pos[0], b.id) for b in O.bodies)
    workers = mp.numThreads - 1
    for place, (_, body) in enumerate(spheres if workers else ()):
        O.bodies[body].subdomain = 1 + place * workers // len(spheres)
    low = min(b.state.pos[2] for b in O.bodies) - 2 * scenes.RADIUS
    wide = spheres[-1][0] - spheres[0][0]
    O.bodies.append(utils.box((spheres[0][0] + wide / 2, 0, low), (wide, wide, 0), fixed=True,
                              material=O.bodies[0].mat))
    O.engines = [
        w.ForceResetter(),
        getattr(w, collider)([*parts['bound'], w.Bo1_Box_Aabb()], label='collider',
                             verletDist=kVerletDist),
        w.InteractionLoop([*parts['geom'], w.Ig2_Box_Sphere_ScGeom()], parts['phys'],
                          parts['law']),
        w.NewtonIntegrator(**parts['newton'])]
    O.dt = parts['dt']


def run(steps):
    if mp.numThreads > 1:
        mp.mpirun(steps)
    else:
        O.timingEnabled = True
        O.run(steps, True)


def engine():
    return next(e for e in O.engines if isinstance(e, w.Collider))


def main(collider, n, steps):
    build(collider, n)
    run(1)
    before = engine().execTime, engine().numAction
    start = time.perf_counter()
    run(steps)
    step = (time.perf_counter() - start) / steps
    of = engine()
    search = (of.execTime - before[0]) / 1e9 / steps
    searches = (of.numAction - before[1]) / steps
    if mp.rank == 0:
        print(json.dumps(dict(step=step, search=search, searches=searches,
                              yade=config.version)), flush=True)


main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
