"""A packing that is stirred, with CurveLoop, for test_curve_loop.py: a line of JSON with the bits of each moment."""
import hashlib
import json
import os
import sys

sys.path[:0] = [os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', 'helpers')]

import numpy as np

import scenes
import yadefrag  # noqa: F401  adds CurveLoop
from scenes import O, w

scenes.clear()
chance = np.random.default_rng(2)
places = np.array(list(np.ndindex(12, 12, 8))) * .97
# The order of the bodies is not that of their places.
chance.shuffle(places)
O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
scenes.addSpheres(places, [.5] * len(places), chance.normal(0, 2, (len(places), 3)), dynamic=True)
O.dt = 1e-4
loop = w.CurveLoop([w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                   [w.Law2_ScGeom_FrictPhys_CundallStrack()])
scenes.setEngines(scenes.makeCollider('LebesgueCollider'), interactionLoop=loop)
states, contacts = [], []
for steps in (1, 1, 60, 60):
    O.run(steps, True)
    rows = [[*b.state.pos, *b.state.vel, *b.state.angVel, *O.forces.f(b.id), *O.forces.t(b.id)] for b in O.bodies]
    states.append(hashlib.sha256(np.array(rows, float).tobytes()).hexdigest())
    contacts.append(O.interactions.countReal())
    # Bodies go and come: rows are made for new ones.
    O.bodies.erase(5 * steps)
    scenes.addSpheres([(6, 6, 10 + 2 * len(states))], [.5], dynamic=True)
print('\n@@@ ' + json.dumps(dict(states=states, contacts=contacts, threads=loop.threads)), flush=True)
