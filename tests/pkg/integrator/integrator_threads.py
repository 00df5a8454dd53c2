"""A cloud that falls, with both integrators, for test_curve_integrator.py: a line of JSON with the bits of each."""
import hashlib
import json
import os
import sys

sys.path[:0] = [os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', 'helpers')]

import numpy as np

import scenes
import yadefrag  # noqa: F401  adds CurveIntegrator
from scenes import O, w

found = {}
for name in ('NewtonIntegrator', 'CurveIntegrator'):
    scenes.clear()
    chance = np.random.default_rng(2)
    places = np.array(list(np.ndindex(12, 12, 16))) * 1.2
    O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    scenes.addSpheres(places, [.5] * len(places), chance.normal(0, 2, (len(places), 3)), dynamic=True)
    for body in O.bodies:
        body.state.angVel = chance.normal(0, 3, 3)
    O.dt = 1e-3
    O.engines = [w.ForceResetter(), getattr(w, name)(gravity=(0, 0, -9), damping=.2)]
    O.run(100, True)
    rows = [[*b.state.pos, *b.state.vel, *b.state.angVel, *b.state.ori] for b in O.bodies]
    found[name] = hashlib.sha256(np.array(rows, float).tobytes()).hexdigest()
print('\n@@@ ' + json.dumps(found), flush=True)
