"""How long the gain of inCurveOrder lasts in a stirred packing: scripts/bench stirred [...]

A block of n spheres, as the scene `packing`: its outermost spheres are fixed, and a bar of spheres through
its middle turns, so that its ends move by .005 radii per step. One run with spheres created in the order
of the curve, one in random order, each in a yade of its own (stirred.py run N STEPS ORDER LOOP), with LebesgueCollider
and one thread; with CurveLoop and CurveIntegrator, or (--loop InteractionLoop) YADE's loop and integrator. Shown is the
loop per step: in the first hundredth of the run, then in parts of it. Writes stirred.md to out/bench; with --readme the
table goes into docs/data and the pages.
"""
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import yade.wrapper as w  # noqa: E402
import yadefrag  # noqa: E402, F401  adds our engines
from yade import O  # noqa: E402

import driven_scenes  # noqa: E402
import measured_tables  # noqa: E402

PARTS = 5
INTEGRATORS = {'CurveLoop': 'CurveIntegrator', 'InteractionLoop': 'NewtonIntegrator'}


def run(n, steps, order, loopName):
    """Prints the end of each part (steps), ms per step of the loop, contacts; first of the first hundredth of the run."""
    O.reset()
    parts = driven_scenes.stirred(n, 1, order)
    O.dt = parts['dt']
    loop = getattr(w, loopName)(parts['geom'], parts['phys'], parts['law'])
    O.engines = [w.ForceResetter(), w.LebesgueCollider(parts['bound']), loop, parts['turning'],
                 getattr(w, INTEGRATORS[loopName])(**parts['newton'])]
    ends, rows = [steps // 100] + [steps * k // PARTS for k in range(1, PARTS + 1)], []
    O.timingEnabled = True
    O.step()
    for begin, end in zip([0] + ends, ends):
        before = loop.execTime
        O.run(end - begin, True)
        rows.append(dict(end=end, loop=(loop.execTime - before) * 1e-6 / (end - begin), real=O.interactions.countReal()))
    print(json.dumps(rows), flush=True)


def table(curves, randoms):
    """A row per part of the run."""
    return [{'steps': f'{curve["end"]:,}', 'contacts': f'{curve["real"]:,}', 'order of the curve': f'{curve["loop"]:.3g}',
             'random order': f'{random["loop"]:.3g}', '×': f'{random["loop"] / curve["loop"]:.2f}'}
            for curve, random in zip(curves, randoms)]


def main(arguments):
    """Parse, measure, report."""
    parser = measured_tables.parser('stirred', __doc__)
    parser.add_argument('--n', type=int, default=20000)
    parser.add_argument('--steps', type=int, default=10000)
    parser.add_argument('--loop', choices=list(INTEGRATORS), default='CurveLoop')
    options = parser.parse_args(arguments)
    if options.steps < 100:
        parser.error(f'--steps is {options.steps}; it must be at least 100.')
    runs = [measured_tables.measuredBy(options, 'stirred.py', 'run', options.n, options.steps, order, options.loop)
            for order in ('curve', 'random')]
    about = f'{options.n:,} spheres, ms of `{options.loop}` per step, {measured_tables.origin.line()}, `scripts/bench stirred`'
    measured_tables.publish(options, 'stirred', table(*runs), about)


if __name__ == '__main__':
    if sys.argv[1:2] == ['run']:
        run(int(sys.argv[2]), int(sys.argv[3]), *sys.argv[4:])
    else:
        main(sys.argv[1:])
