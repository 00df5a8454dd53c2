"""Searches of overlapping boxes, ours and those of other libraries: scripts/bench search [...]

Plain Python; every scene and size is a process of its own (yadefrag_rivals), in which all methods
see the same boxes and have to find the same pairs:

    Lebesgue, LinearCode, Hierarchy   the paper's three
    Lebesgue, moved boxes given       the first, which searches only for the boxes given as moved
    SweptRows                         codes row by row, in a sweep over all boxes
    LinearBvh                         a tree over position codes (Karras 2012)
    cell list                         a grid with cells as long as the longest box
    CGAL                              box_self_intersection_d
    Boost R-tree                      packed anew, or changed where less than 1 in 20 boxes moved
    Bullet, Box2D                     btDbvtBroadphase, b2DynamicTree (2D), in single precision, where
                                      libbullet-dev and libbox2d-dev are installed

Times are processor time in ms, elapsed time with several threads: the first search of all, and the
least of a few later ones. Writes search.json, search.md and search.png to out/bench.
"""
import argparse
import json
import os
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(ROOT, 'examples'))
import origin  # noqa: E402


SCENES = ['uniform', 'few move', 'clusters', 'sizes', 'slivers']


def measure(options):
    """All rows, as dicts; a scene whose process fails ends the comparison."""
    rows = []
    tasks = [(scene, d, n, t) for n in options.sizes for t in options.threads
             for d in (2, 3) for scene in options.scenes]
    for scene, dimensions, n, threads in tasks:
        print(f'{time.strftime("%H:%M:%S")} {scene}, {dimensions}D, {n}, {threads} thread(s)',
              file=sys.stderr, flush=True)
        rounds = 20 if n <= 10000 else 3
        command = [options.program, scene, dimensions, n, threads, rounds, options.most]
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr.strip() or f'{command[0]} ended with {done.returncode}')
        rows += [json.loads(line) for line in done.stdout.splitlines()]
    return rows


def later(row):
    """ms of one later search: update and query."""
    return row['update'] + row['query']


def table(rows, n, threads):
    """Markdown: a later search of n boxes, ms, a row per method; the fastest is bold."""
    rows = [r for r in rows if r['n'] == n and r['threads'] == threads]
    columns = sorted({(r['dimensions'], SCENES.index(r['scene'])) for r in rows})
    methods = list(dict.fromkeys(r['method'] for r in rows))
    found = {(r['method'], r['dimensions'], SCENES.index(r['scene'])): r for r in rows}
    lines = ['| first; later | ' + ' | '.join(f'{d}D {SCENES[s]}' for d, s in columns) + ' |',
             '|---|' + '--:|' * len(columns)]
    for method in methods:
        cells = []
        for column in columns:
            row = found.get((method, *column))
            least = min(later(found[m, *column]) for m in methods if (m, *column) in found)
            text = f'{_short(row["build"])}; {_short(later(row))}' if row else '–'
            cells.append(f'**{text}**' if row and later(row) == least else text)
        lines.append(f'| {method} | ' + ' | '.join(cells) + ' |')
    return '\n'.join(lines)


def _short(ms):
    return f'{ms:.2g}' if ms < 100 else f'{ms:.0f}'


def plot(rows, file):
    """Microseconds per box and later search over the number of boxes, one thread."""
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    scenes = [s for s in SCENES if any(r['scene'] == s for r in rows)]
    figure, axes = plt.subplots(2, len(scenes), figsize=(3.1 * len(scenes) + 2, 6), sharex=True,
                                sharey=True, squeeze=False, layout='constrained')
    methods = list(dict.fromkeys(r['method'] for r in rows))
    for d, line in zip((2, 3), axes):
        for scene, axis in zip(scenes, line):
            for k, method in enumerate(methods):
                part = [r for r in rows if (r['scene'], r['dimensions'], r['method'], r['threads'])
                        == (scene, d, method, 1)]
                part = [r for r in part if later(r) < float('inf')]
                axis.loglog([r['n'] for r in part], [1e3 * later(r) / r['n'] for r in part],
                            '.-', color=f'C{k}' if k < 10 else 'black', label=method, lw=2.5 if k < 2 else 1)
            axis.set_title(f'{d}D, {scene}', fontsize=10, loc='left')
            axis.grid(alpha=.3)
    for axis in axes[-1]:
        axis.set_xlabel('boxes')
    for axis in axes[:, 0]:
        axis.set_ylabel('µs per box and search')
    handles = {h.get_label(): h for axis in axes.flat for h in axis.get_lines()}
    figure.legend(handles=list(handles.values()), loc='center left', bbox_to_anchor=(1, .5),
                  fontsize=9)
    figure.savefig(file, dpi=100, bbox_inches='tight')


def report(rows, options):
    """Write search.json, search.md, search.png."""
    os.makedirs(options.out, exist_ok=True)
    with open(os.path.join(options.out, 'search.json'), 'w') as file:
        json.dump(rows, file, indent=1)
    about = f'{origin.line()}, `scripts/bench search`'
    parts = [f'ms for the first search and a later one of {n:,} boxes, {t} thread(s). {about}.\n\n'
             + table(rows, n, t) for t in options.threads for n in options.sizes]
    with open(os.path.join(options.out, 'search.md'), 'w') as file:
        file.write('\n\n'.join(parts) + '\n')
    plot([r for r in rows if r['threads'] == 1], os.path.join(options.out, 'search.png'))


def main(arguments):
    """Parse, measure, report."""
    parser = argparse.ArgumentParser(
        prog='scripts/bench search', formatter_class=argparse.RawDescriptionHelpFormatter,
        description=__doc__)
    whole = lambda text: [int(float(x)) for x in text.split(',')]  # noqa: E731
    parser.add_argument('--scenes', type=lambda t: t.split(','), default=SCENES)
    parser.add_argument('--sizes', type=whole, default=[1000, 10000, 100000, 1000000])
    parser.add_argument('--threads', type=whole, default=[1, 2])
    parser.add_argument('--most', type=float, default=20., help='s per method; default: 20')
    parser.add_argument('--out', default=os.path.join(ROOT, 'out', 'bench'))
    parser.add_argument('--program', help='default: build/release/tests/yadefrag_rivals',
                        default=os.path.join(ROOT, 'build', 'release', 'tests', 'yadefrag_rivals'))
    options = parser.parse_args(arguments)
    unknown = [scene for scene in options.scenes if scene not in SCENES]
    if unknown:
        parser.error(f'no scene {unknown[0]!r}; there are {", ".join(SCENES)}')
    report(measure(options), options)


if __name__ == '__main__':
    main(sys.argv[1:])
