"""What a script's own habits cost: scripts/bench advice [--n 20000]

A packing with LebesgueCollider and CurveLoop, one thread: how O.run and O.step, engines in Python, the taking of
times and energies, and the order of the bodies change the time of a step. Each order of the bodies is a yade of its
own; everything else takes turns within it, and ratios are formed within a turn. Writes advice.md to out/bench; with
--readme the table goes into docs/data and the pages. docs/fast_scripts.md draws the conclusions.
"""
import os
import statistics
import subprocess
import sys

import colliders
import measured_tables
import report

BASE = 'O.run'


def measure(options, order):
    """What advice_yade.py prints."""
    command = [options.yade, '-n', '-x', '-j1', os.path.join(colliders.HERE, 'advice_yade.py'), str(options.n), order,
               str(options.rounds)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    row = colliders._lastRow(done.stdout)
    if not row:
        sys.exit(f'yade ended with status {done.returncode}: {colliders._lastLine(done.stderr)}')
    return row


def ratio(above, below):
    """Median of the ratios of turns."""
    return statistics.median(a / b for a, b in zip(above, below))


def table(runs):
    """Rows; `runs` are pairs of what the two orders gave."""
    names = list(runs[0][0])
    together = [{name: [x for run in runs for x in run[order][name]] for name in names} for order in (0, 1)]
    random, curve = together
    times = {name: random[name] for name in names} | {f'{BASE}, bodies in the order of the curve': curve[BASE]}
    return [{'a step': name, 'ms': measured_tables.digits(statistics.median(ms)), '×': f'{ratio(ms, random[BASE]):.2f}'}
            for name, ms in times.items()]


def main(arguments):
    """Parse, measure, write."""
    parser = measured_tables.parser('advice', __doc__)
    parser.add_argument('--n', type=int, default=20000)
    parser.add_argument('--rounds', type=int, default=5, help='turns in each yade; default: %(default)s')
    parser.add_argument('--repeat', type=int, default=2, help='yades for each order; default: %(default)s')
    options = parser.parse_args(arguments)
    runs = [[measure(options, order) for order in ('random', 'curve')] for _ in range(options.repeat)]
    measured_tables.publish(options, 'advice', table(runs),
                            f'{options.n:,} spheres, {report.origin.line()}, `scripts/bench advice`')


if __name__ == '__main__':
    main(sys.argv[1:])
