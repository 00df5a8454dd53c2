"""How long the gain of inCurveOrder lasts in a stirred packing: scripts/bench stirred [...]

A block of n spheres, as the scene `packing`: its outermost spheres are fixed, and a bar of spheres through
its middle turns, so that its ends move by .005 radii per step. One run with spheres created in the order
of the curve, one in random order, each in a yade of its own, with LebesgueCollider and one thread; with CurveLoop and
CurveIntegrator, or (--loop InteractionLoop) YADE's loop and integrator. Shown is the loop per step: in the first
hundredth of the run, then in parts of it. Writes stirred.md to out/bench; with --readme the table goes into docs/data and the
pages.
"""
import json
import os
import subprocess
import sys

import measured_tables
import report

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ORDERS = ('curve', 'random')
PARTS = 5


def measure(options, order):
    """Rows of one run: the end of each part (steps), ms per step of the loop, contacts."""
    command = [options.yade, '-n', '-x', '-j1', os.path.join(ROOT, 'tests', 'benchmark', 'stirred_run.py'),
               str(options.n), str(options.steps), order, str(PARTS), options.loop]
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    rows = [line for line in run.stdout.splitlines() if line.startswith('[')]
    if run.returncode or len(rows) != 1:
        sys.exit(f'{order}: yade ended with status {run.returncode}: {run.stderr[-300:]}')
    return json.loads(rows[0])


def table(runs):
    """A row per part of the run."""
    return [{'steps': f'{curve["end"]:,}', 'contacts': f'{curve["real"]:,}', 'order of the curve': f'{curve["loop"]:.3g}',
             'random order': f'{random["loop"]:.3g}', '×': f'{random["loop"] / curve["loop"]:.2f}'}
            for curve, random in zip(runs['curve'], runs['random'])]


def main(arguments):
    """Parse, measure, report."""
    parser = measured_tables.parser('stirred', __doc__)
    parser.add_argument('--n', type=int, default=20000)
    parser.add_argument('--steps', type=int, default=10000)
    parser.add_argument('--loop', choices=['CurveLoop', 'InteractionLoop'], default='CurveLoop')
    options = parser.parse_args(arguments)
    if options.steps < 100:
        parser.error(f'--steps is {options.steps}; it must be at least 100.')
    runs = {order: measure(options, order) for order in ORDERS}
    about = f'{options.n:,} spheres, ms of `{options.loop}` per step, {report.origin.line()}, `scripts/bench stirred`'
    measured_tables.publish(options, 'stirred', table(runs), about)


if __name__ == '__main__':
    main(sys.argv[1:])
