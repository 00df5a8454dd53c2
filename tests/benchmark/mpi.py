"""yade.mpy with YADE's collider and ours: scripts/bench mpi [--bodies 20000] [--ranks 1,2,4] ...

Plain Python; every measurement is a run of its own (mpi_measure.py inside yade, one thread in each
process). The colliders take turns within a repeat, and a ratio is formed within a repeat, so that a
slow minute of the machine falls on both. Shown are medians over the repeats. The processes share the
machine's cores, and one of them, the master, has no spheres.

Writes mpi.json (raw) and mpi.md (the table) to out/bench.
"""
import argparse
import json
import os
import statistics
import sys
import tempfile

import report

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.append(os.path.join(ROOT, 'tests', 'pkg', 'helpers'))
import mpi_processes  # noqa: E402

COLLIDERS = ['InsertionSortCollider', 'LebesgueCollider']


def measure(collider, ranks, options):
    """What the master prints; RuntimeError with its last lines otherwise."""
    command = [os.path.join(ROOT, 'scripts', 'yade'), '-n', '-x',
               os.path.join(HERE, 'mpi_measure.py'), collider, str(options.bodies),
               str(options.steps)]
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        _, output = mpi_processes.run(ranks, command, folder, options.limit)
    rows = [line for line in output.splitlines() if line.startswith('{')]
    if not rows:
        raise RuntimeError('%s in %d processes: %s' % (collider, ranks, output[-1000:]))
    return json.loads(rows[-1])


def table(rows, options):
    """Markdown: milliseconds per step, and the part of the search with its messages."""
    lines = ['| processes | step with YADE\'s, ms | with ours, ms | × | search with YADE\'s, ms per '
             'step | with ours, ms per step | steps with a search, YADE\'s, ours |',
             '|--:|--:|--:|--:|--:|--:|--:|']
    for ranks in options.ranks:
        pairs = [[r[name] for name in COLLIDERS] for r in rows if r['ranks'] == ranks]
        middle = lambda key: [statistics.median(1e3 * pair[k][key] for pair in pairs)  # noqa: E731
                              for k in (0, 1)]
        ratio = statistics.median(pair[0]['step'] / pair[1]['step'] for pair in pairs)
        # mpy runs a collider twice for one search.
        parts = [100 * pairs[0][k]['searches'] / (2 if ranks > 1 else 1) for k in (0, 1)]
        lines.append('| %d | %.1f | %.1f | %.2f | %.2f | %.2f | %.1f, %.1f %% |' % (
            ranks, *middle('step'), ratio, *middle('search'), *parts))
    return '\n'.join(lines) + '\n'


def main(arguments):
    parser = argparse.ArgumentParser(prog='scripts/bench mpi', description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--bodies', type=int, default=20000, help='default: 20000')
    parser.add_argument('--steps', type=int, default=200, help='default: 200')
    parser.add_argument('--ranks', type=lambda t: [int(x) for x in t.split(',')],
                        default=[1, 2, 4], help='default: 1,2,4')
    parser.add_argument('--repeat', type=int, default=3, help='default: 3')
    parser.add_argument('--limit', type=float, default=300, help='s per run; default: 300')
    parser.add_argument('--out', default=os.path.join(ROOT, 'out', 'bench'))
    options = parser.parse_args(arguments)
    rows = []
    for repeat in range(options.repeat):
        for ranks in options.ranks:
            found = {name: measure(name, ranks, options) for name in COLLIDERS}
            rows.append(dict(found, ranks=ranks, repeat=repeat))
            print('repeat %d, %d processes' % (repeat + 1, ranks), file=sys.stderr, flush=True)
    machine = report._machine([row[COLLIDERS[0]] for row in rows])
    text = '%s\n%d spheres, %d steps, medians of %d; %s\n' % (
        table(rows, options), options.bodies, options.steps, options.repeat,
        report.line(machine, 'shared by all processes'))
    os.makedirs(options.out, exist_ok=True)
    with open(os.path.join(options.out, 'mpi.json'), 'w') as out:
        json.dump(dict(machine=machine, rows=rows), out, indent=1)
    with open(os.path.join(options.out, 'mpi.md'), 'w') as out:
        out.write(text)
    print(text + 'written to ' + options.out)


if __name__ == '__main__':
    main(sys.argv[1:])
