"""One run for stirred.py, inside yade: N STEPS ORDER PARTS LOOP; prints one line of JSON."""
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import yade.wrapper  # noqa: E402
import yadefrag  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import ForceResetter  # noqa: E402

import driven_scenes  # noqa: E402


INTEGRATORS = {'InteractionLoop': 'NewtonIntegrator', 'CurveLoop': 'CurveIntegrator'}


def build(n, order, loopName):
    """The block and its engines."""
    O.reset()
    parts = driven_scenes.stirred(n, 1, order)
    O.dt = parts['dt']
    engine = lambda name: getattr(yadefrag, name, None) or getattr(yade.wrapper, name)  # noqa: E731
    loop = engine(loopName)(parts['geom'], parts['phys'], parts['law'])
    O.engines = [ForceResetter(), yadefrag.LebesgueCollider(parts['bound']), loop, parts['turning'],
                 engine(INTEGRATORS[loopName])(**parts['newton'])]
    return loop


def main(n, steps, order, parts, loopName):
    """Build, run, print; the first row is that of the first hundredth of the run."""
    loop, rows = build(n, order, loopName), []
    ends = [steps // 100] + [steps * k // parts for k in range(1, parts + 1)]
    O.timingEnabled = True
    O.step()
    for begin, end in zip([0] + ends, ends):
        before = loop.execTime
        O.run(end - begin, True)
        rows.append(dict(end=end, loop=(loop.execTime - before) * 1e-6 / (end - begin),
                         real=O.interactions.countReal()))
    print(json.dumps(rows), flush=True)


main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], int(sys.argv[4]), sys.argv[5])
