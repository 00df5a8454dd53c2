"""One run for stirred.py, inside yade: N STEPS ORDER PARTS; prints one line of JSON."""
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import yade.wrapper  # noqa: E402
import yadefrag  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import ForceResetter, InteractionLoop, NewtonIntegrator  # noqa: E402

import driven_scenes  # noqa: E402


def build(n, order):
    """The block and its engines."""
    O.reset()
    parts = driven_scenes.stirred(n, 1, order)
    O.dt = parts['dt']
    loop = InteractionLoop(parts['geom'], parts['phys'], parts['law'])
    O.engines = [ForceResetter(), yadefrag.LebesgueCollider(parts['bound']), loop, parts['turning'],
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
