"""Walls of blocks beside other solvers of contact: scripts/bench walls [--repeat 3]

The same four-sided blocks, which touch exactly, in our contact and in Box2D's; cubes in Siconos'.
Time per contact and step, and the deepest overlap at the end. Box2D and Siconos are compared with where
libbox2d-dev, python3-siconos and python3-h5py are installed. Medians over the repeats.
"""
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

import measured_tables
import report

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
PROGRAM = os.path.join(ROOT, 'build', 'release', 'tests', 'yadefrag_walls')
SICONOS = os.path.join(HERE, 'walls', 'siconos_wall.py')
SIZES = (5, 14, 32)
STEPS = 300
ITERATIONS = (8, 32, 128)
# Blocks in a row, steps, tolerance of the solver: 196 blocks would take 20 s a step.
OF_SICONOS = ((5, 50, 1e-4), (5, 50, 1e-8), (8, 20, 1e-4))


def main(arguments):
    """Run all, write all."""
    parser = measured_tables.parser('walls', __doc__)
    parser.add_argument('--repeat', type=int, default=3, help='runs of each')
    options = parser.parse_args(arguments)
    rows = []
    for blocks in SIZES:
        tasks = [('ours, one pass', 'ours', 1), ('ours, two passes', 'ours', 2)]
        tasks += [(f'Box2D, {count} iterations', 'Box2D', count) for count in ITERATIONS]
        for name, solver, count in tasks:
            runs = [_measure(solver, blocks, count) for _ in range(options.repeat)]
            if None not in runs:
                rows.append(dict({key: statistics.median(r[key] for r in runs) for key in runs[0]},
                                 blocks=blocks, name=name))
    if _hasSiconos():
        rows += [_ofSiconos(*scene) for scene in OF_SICONOS]
    machine = report._machine([])
    text = '\n'.join([f"{machine['machine']}, {machine['date']}, commit {machine['commit']}; medians of "
                      f'{options.repeat} runs.', ''] + _table(rows)) + '\n'
    print(text)


def _measure(solver, blocks, count):
    """Figures of one run; None without this solver."""
    done = subprocess.run([PROGRAM, solver, str(blocks), str(STEPS), str(count)], text=True,
                          capture_output=True, check=False)
    if done.returncode == 3:
        return None
    if done.returncode:
        sys.exit(done.stderr.strip())
    return json.loads(done.stdout)


def _hasSiconos():
    test = 'import siconos.mechanics.collision.bullet, h5py'
    return subprocess.run(['/usr/bin/python3', '-c', test], capture_output=True,
                          check=False).returncode == 0


def _ofSiconos(blocks, steps, tolerance):
    """Medians over the steps, from what Siconos prints."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(['/usr/bin/python3', SICONOS, str(blocks), str(steps), str(tolerance)],
                              cwd=folder, text=True, capture_output=True, check=True)
    contacts = [int(c) for c in re.findall(r'number of contacts (\d+)', done.stdout)]
    times = [float(t) for t in re.findall(r'computeOneStep\s+\.+ (\S+) s', done.stdout)]
    return dict(name=f'Siconos, tolerance {tolerance:g}', blocks=blocks, contact=statistics.median(times),
                contacts=statistics.median(contacts), depth=None)


def _table(rows):
    """Markdown."""
    out = ['| blocks | solver | contacts | µs per contact and step | deepest overlap / side |',
           '|--:|---|--:|--:|--:|']
    for row in sorted(rows, key=lambda r: r['blocks']):
        each = 1e6 * row['contact'] / row['contacts']
        depth = '' if row['depth'] is None else f"{row['depth']:.1g}"
        out.append(f"| {row['blocks'] ** 2} | {row['name']} | {row['contacts']:.0f} | {each:.2f} | {depth} |")
    return out


if __name__ == '__main__':
    main(sys.argv[1:])
