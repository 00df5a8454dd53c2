"""YADE's collider against ours: scripts/bench colliders [--scenes a,b] [--sizes 1000,10000] ...

Plain Python; every measurement is a process of its own (measure.py inside yade, one thread). In
each scene and size the colliders take turns within every repeat, and ratios are formed within a
repeat, so that a slow minute of the machine falls on both. Shown are medians over the repeats.

The rows:
    InsertionSortCollider   YADE's collider at its defaults
    tuned                   the same, with the best of GRID: short runs of this scene and size, the
                            best three once more, the best of these measured in full
    LebesgueCollider, LinearCodeCollider, HierarchyCollider   at their defaults

Writes colliders.json (raw), colliders.md (tables) and colliders*.png to out/bench.
"""
import argparse
import json
import os
import signal
import subprocess
import sys
import time

import report

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
RIVAL = 'InsertionSortCollider'
OURS = ['LebesgueCollider', 'LinearCodeCollider', 'HierarchyCollider']
ROWS = [RIVAL, 'tuned'] + OURS
SCENES = ['gas', 'gas4', 'packing', 'polydisperse', 'polydisperse4', 'polydisperse50', 'clusters',
          'plane', 'projectile', 'insertion', 'exchange', 'rest']
FINALISTS = 3
# Multiples of the smallest radius (YADE takes a negative verletDist so) and steps between bounds.
GRID = [dict(verletDist=-v, targetInterv=t) for v in (.05, .1, .2, .5, 1.) for t in (0, 10, 50)]


class Runner:
    """Runs measure.py, each time in a fresh yade process, and keeps all rows."""

    def __init__(self, options):
        self.options, self.rows = options, []

    def measure(self, collider, scene, n, budget, threads=1, **settings):
        """One measurement; returns its row, with the key `error` if there is none."""
        o = self.options
        arguments = dict(scene=scene, n=n, seed=o.seed, collider=collider, budget=budget,
                         **settings)
        command = [o.yade, '-n', '-x', f'-j{threads}', os.path.join(HERE, 'measure.py')]
        command += [f'{k}={v}' for k, v in arguments.items()]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   stdin=subprocess.DEVNULL, text=True, start_new_session=True)
        try:
            output, messages = process.communicate(timeout=o.limit)
        except subprocess.TimeoutExpired:
            return dict(error=f'no result within {o.limit:g} s', timedOut=True)
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        return _lastRow(output) or dict(
            error=f'yade ended with status {process.returncode}: {_lastLine(messages)}')

    def keep(self, row, **keys):
        """Store a row under its keys (scene, n, label, repeat)."""
        self.rows.append({**row, **keys})


def _lastRow(output):
    for line in reversed(output.splitlines()):
        if line.startswith('{'):
            return json.loads(line)
    return None


def _lastLine(text):
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else 'no message'


def tune(runner, scene, n, progress):
    """Best settings of GRID by collider + loop + integrator per step; (settings, table of all)."""
    table = [dict(settings=settings, runs=[]) for settings in GRID]

    def run(entry):
        progress(f'{scene} {n}: tuning')
        row = runner.measure(RIVAL, scene, n, runner.options.budget / 4, **entry['settings'])
        if 'error' in row:
            entry['error'] = row['error']
        else:
            entry['runs'].append(row['sumPerStep'])

    for entry in table:
        run(entry)
    good = [entry for entry in table if entry['runs']]
    finalists = sorted(good, key=lambda e: e['runs'][0])[:FINALISTS]
    for entry in finalists:
        run(entry)
    progress(f'{scene} {n}: tuned', FINALISTS - len(finalists))
    return (min(finalists, key=lambda e: min(e['runs']))['settings'] if good else None), table


def rowsOf(options, scene):
    """The colliders that are measured in a scene."""
    return [label for label in options.colliders if label != 'tuned' or scene in options.tune]


def compare(runner, scene, n, progress, grids):
    """All rows of one scene and size, interleaved; appends to runner.rows and grids."""
    o, failed, settings = runner.options, set(), {}
    for repeat in range(o.repeat):
        for label in rowsOf(o, scene):
            progress(f'{scene} {n}: {label}')
            if label in failed:
                continue
            if label == 'tuned' and repeat == 0:
                settings = _tunedSettings(runner, scene, n, progress, grids, failed)
            tuned = label == 'tuned'
            if tuned and settings is None:
                row = dict(error='not tuned: the default collider gave no result here')
            else:
                row = runner.measure(RIVAL if tuned else label, scene, n, o.budget,
                                     **(settings if tuned else {}))
            if 'error' in row:
                failed.add(label)
            runner.keep(row, scene=scene, n=n, label=label, repeat=repeat)


def _tunedSettings(runner, scene, n, progress, grids, failed):
    """Settings for the tuned rival, or None where the default one has failed already."""
    if RIVAL in failed:
        progress(f'{scene} {n}: tuning', len(GRID) + FINALISTS)
        return None
    settings, table = tune(runner, scene, n, progress)
    grids.append(dict(scene=scene, n=n, best=settings, table=table))
    return settings


def makeProgress(total):
    """A function (text, steps=1) that shows the progress, on a terminal or in plain lines."""
    if sys.stderr.isatty():
        try:
            from tqdm import tqdm
            bar = tqdm(total=total, unit='run', dynamic_ncols=True)

            def show(text, steps=1):
                bar.set_description(text)
                bar.update(steps)
            return show
        except ImportError:
            pass
    last = [None]

    def say(text, steps=1):
        scene = text.split(':')[0]
        if scene != last[0]:
            print(f'{time.strftime("%H:%M:%S")} {scene}', file=sys.stderr, flush=True)
        last[0] = scene
    return say


def _parse(arguments):
    parser = argparse.ArgumentParser(
        prog='scripts/bench colliders', formatter_class=argparse.RawDescriptionHelpFormatter,
        description=__doc__)
    names = lambda known: lambda text: _known(text.split(','), known)  # noqa: E731
    parser.add_argument('--scenes', type=names(SCENES), default=SCENES, help='default: all')
    parser.add_argument('--sizes', type=lambda t: [int(float(x)) for x in t.split(',')],
                        default=[1000, 10000, 100000], help='default: 1000,10000,100000')
    parser.add_argument('--colliders', type=names(ROWS), default=ROWS, help='default: all rows')
    parser.add_argument('--tune', type=names(SCENES), default=SCENES,
                        help='scenes with the row `tuned`; default: all')
    parser.add_argument('--repeat', type=int, default=3, help='default: 3')
    parser.add_argument('--budget', type=float, default=8., help='s of measured steps; default: 8')
    parser.add_argument('--limit', type=float, default=180., help='s per process; default: 180')
    parser.add_argument('--quick', action='store_true',
                        help='sizes 1000 and 10000, one repeat, 2 s of measured steps')
    parser.add_argument('--readme', action='store_true',
                        help='write the table of the largest size into docs/data and the pages')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--out', default=os.path.join(ROOT, 'out', 'bench'))
    parser.add_argument('--yade', default=os.path.join(ROOT, 'scripts', 'yade'),
                        help='command to measure with; default: scripts/yade')
    options = parser.parse_args(arguments)
    if options.quick:
        options.sizes, options.repeat, options.budget = [1000, 10000], 1, 2.
    return options


def _known(names, known):
    unknown = [name for name in names if name not in known]
    if unknown:
        raise argparse.ArgumentTypeError(f'{unknown[0]} is not one of {", ".join(known)}')
    return names


def main(arguments):
    """Measure according to the arguments; report the results so far if interrupted."""
    options = _parse(arguments)
    runner, grids = Runner(options), []
    places = [(scene, n) for n in options.sizes for scene in options.scenes]
    rows = [rowsOf(options, scene) for scene, _ in places]
    runs = sum(options.repeat * len(labels) + (len(GRID) + FINALISTS) * ('tuned' in labels) for labels in rows)
    progress = makeProgress(runs)
    status = 0
    try:
        for scene, n in places:
            compare(runner, scene, n, progress, grids)
    except KeyboardInterrupt:
        print('\ninterrupted: the report holds what was measured so far', file=sys.stderr)
        status = 130
    if runner.rows:
        report.write(options.out, runner.rows, grids, options)
    return status


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
