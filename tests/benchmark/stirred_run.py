"""One run for stirred.py, inside yade: N STEPS ORDER PARTS; prints one line of JSON."""
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import yade.wrapper  # noqa: E402
import numpy as np  # noqa: E402
import yadefrag  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import ForceResetter, InteractionLoop, NewtonIntegrator, RotationEngine  # noqa: E402

import scenes  # noqa: E402
from scenes import RADIUS  # noqa: E402

PER_STEP = .005 * RADIUS  # m, of the ends of the bar


def build(n, order):
    """The block and its engines."""
    O.reset()
    rng = np.random.default_rng(1)
    positions = rng.permutation(scenes._block(rng, n))
    if order == 'curve':
        positions = np.array(yadefrag.inCurveOrder(positions.tolist()))
    half = np.abs(positions).max()
    reach = .75 * half
    skin = scenes._skin(positions)
    bar = (np.abs(positions[:, 1]) < 2.2 * RADIUS) & (np.abs(positions[:, 2]) < .8 * half) & ~skin
    bar &= np.hypot(positions[:, 0], positions[:, 1]) < reach
    material = scenes._material(1e7)
    for position, fixed in zip(positions.tolist(), (skin | bar).tolist()):
        O.bodies.append(scenes._sphere(position, RADIUS, (0, 0, 0), material, 'xyzXYZ' if fixed else ''))
    parts = scenes._parts(1e7, damping=.2)
    O.dt = parts['dt']
    turning = RotationEngine(ids=np.flatnonzero(bar).tolist(), angularVelocity=PER_STEP / O.dt / reach,
                             rotationAxis=(0, 0, 1), zeroPoint=(0, 0, 0), rotateAroundZero=True)
    loop = InteractionLoop(parts['geom'], parts['phys'], parts['law'])
    O.engines = [ForceResetter(), yadefrag.LebesgueCollider(parts['bound']), loop, turning,
                 NewtonIntegrator(**parts['newton'])]
    return loop


def main(n, steps, order, parts):
    """Build, run, print; the first row is that of the first hundredth of the run."""
    loop, rows = build(n, order), []
    ends = [steps // 100] + [steps * k // parts for k in range(1, parts + 1)]
    O.timingEnabled = True
    O.step()
    for begin, end in zip([0] + ends, ends):
        before = loop.execTime
        O.run(end - begin, True)
        rows.append(dict(end=end, loop=(loop.execTime - before) * 1e-6 / (end - begin),
                         real=O.interactions.countReal()))
    print(json.dumps(rows), flush=True)


main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], int(sys.argv[4]))
