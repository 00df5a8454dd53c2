"""A scene run and dumped with full precision, for test_threads.py: CLASS gas|mixed|periodic...; each scene a line of JSON."""
import json
import os
import sys

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', 'helpers')]

import numpy as np

import scenes
from yade import utils
from yade.minieigenHP import Vector3


def build(kind):
    """1500 moving spheres in a unit box; `mixed` adds facets, a box and a wall."""
    rng = np.random.default_rng(1)
    if kind == 'periodic':
        O.periodic = True
        O.cell.hSize = scenes.matrix(np.eye(3))
    n = 1500
    scenes.addSpheres(rng.uniform(0, 1, (n, 3)), rng.uniform(.015, .03, n),
                      rng.normal(size=(n, 3)) * .002)
    if kind == 'mixed':
        for _ in range(60):
            corner = rng.uniform(0, 1, 3)
            O.bodies.append(utils.facet(
                [Vector3(*(corner + rng.uniform(-.1, .1, 3))) for _ in range(3)]))
        O.bodies.append(utils.box((.5, .5, 0), (1, 1, .02), fixed=True))
        O.bodies.append(utils.wall(1, axis=1))
    O.dt = 1


def moment():
    return dict(
        interactions=[(i.id1, i.id2, i.isReal, *i.cellDist) for i in O.interactions.all()],
        positions=[tuple(map(repr, b.state.pos)) for b in O.bodies])


def main(name, kind):
    scenes.clear()
    build(kind)
    scenes.setEngines(scenes.makeCollider(name))
    moments = []
    for steps in (1, 1, 8, 10):
        O.run(steps, True)
        moments.append(moment())
        for k in range(40):     # bodies come and go, too
            O.bodies.erase(int(k * 31 + len(moments)))
        scenes.addSpheres(np.random.default_rng(len(moments)).uniform(0, 1, (40, 3)), [.02] * 40)
    print('\n@@@ ' + json.dumps(dict(threads=O.numThreads, moments=moments)), flush=True)


for kind in sys.argv[2:]:
    main(sys.argv[1], kind)
