"""The paper's figure 14: scripts/bench figure14 [--repeat 3] [--out FOLDER] ...

Comparisons and time of one global search in the scenes squares, rings and bars, for the printed
Lebesgue search (SPC), the same with a directory, rows (LPC), the hierarchy (HO), sweep-and-prune;
beside them the time of YADE's collider and of LebesgueCollider inside YADE, on the same motion. The
scenes and our searches are in bench.cpp, the runs inside YADE in figure14_yade.py.

Times are medians over the repeats, each the mean over a run's searches; counts do not vary. Writes
figure14.json (raw), figure14.md (tables) and figure14.png to the folder, by default out/bench.
"""
import argparse
import collections
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(ROOT, 'tests', 'benchmark'))

import measured_tables  # noqa: E402

SCENES = {'squares': 'squares a side', 'rings': 'rings', 'bars': 'bars'}
COUNTED = ['SPC', 'SPC-directory', 'LPC', 'HO', 'sweep']
TIMED = ['SPC', 'SPC-directory', 'LPC', 'HO']
INSIDE = ['InsertionSortCollider', 'LebesgueCollider']
STAGES = ['move', 'resort', 'range', 'test']
GROWTH = [('squares', 16, 32), ('squares', 24, 48), ('rings', 24, 48), ('bars', 8, 32)]
RULES = """\
One comparison is that of two integers (codes, indices) or of two coordinates. Per search, from the
nodes having moved to all candidates; the first search, from nothing, is left out.

- SPC, LPC: 2 for each axis of each node (has it left its box); SPC 1 more for each level up to the
  boundary crossed; 1 for each code looked at where moved codes are merged and where a range begins
  (the few codes that moved are sorted by radix, without comparisons); 1 for the code that ends a
  range; 5 for each node in a range, the segment's own among them (its code, four coordinates).
- SPC finds the beginning of a range by exponential, then binary search from the segment's own node;
  with the directory by a look into a table (2, and 1 for each code of the slot); LPC by binary
  search in the whole list.
- HO: 4 for each inner node of the tree, refitted in every search; 4 for each pair of groups whose
  boxes are compared; 4 for each node in the halo of a segment that is left.
- sweep-and-prune: 1 for each comparison of two bounds on the three axes (two have an extent), 4 for
  each overlap test. It keeps its pairs from one search to the next. A model of YADE's collider for
  the counts; its time is YADE's own."""


def main(arguments):
    """Run all, write all; exits with one sentence where a run fails."""
    options = _parse(arguments)
    os.makedirs(options.out, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        rows = runSearches(options, folder)
        runInsideYade(options, folder, rows)
    machine = measured_tables.machineOf(list(rows.values()))
    text = markdown(rows, machine, options)
    with open(os.path.join(options.out, 'figure14.json'), 'w') as f:
        json.dump(dict(machine=machine, repeat=options.repeat, rows=list(rows.values())), f,
                  indent=1)
    with open(os.path.join(options.out, 'figure14.md'), 'w') as f:
        f.write(text)
    draw(os.path.join(options.out, 'figure14.png'), rows, machine)
    print(text)
    print('written to', options.out)


def runSearches(options, folder):
    """{(scene, method, size): row} of the searches without YADE; leaves the frames in `folder`."""
    _bench(options, '^figure14/frames/', 1, dict(os.environ, FIGURE14_FRAMES=folder))
    times, rows = collections.defaultdict(list), {}
    for b in _bench(options, '^figure14/(squares|rings|bars)/', options.repeat, os.environ):
        scene, method, size = b['run_name'].split('/')[1:4]
        key = scene, method, int(size)
        times[key].append(b['real_time'])
        rows[key] = dict(scene=scene, method=method, size=int(size), segments=int(b['segments']),
                         **{k: b[k] for k in STAGES + ['searches', 'candidates', 'comparisons',
                                                       'b', 'lastHalo']})
    for key, row in rows.items():
        row['time'] = statistics.median(times[key])
    return rows


def _bench(options, which, repeat, environment):
    """Rows of one call of the benchmark program; `which` chooses frames or searches."""
    print('running', which, file=sys.stderr, flush=True)
    command = [options.program, f'--benchmark_filter={which}', '--benchmark_format=json',
               f'--benchmark_repetitions={repeat}', '--benchmark_display_aggregates_only=false',
               '--benchmark_enable_random_interleaving=true']
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode:
        sys.exit(f'{options.program} ended with status {done.returncode}')
    rows = [b for b in json.loads(done.stdout)['benchmarks'] if b['run_type'] == 'iteration']
    for b in rows:
        if b.get('error_occurred'):
            sys.exit(f"{b['name']}: {b['error_message']}")
    return rows


def runInsideYade(options, folder, rows):
    """Add the rows of YADE's and our collider inside YADE; their pairs must be the same."""
    for scene, size in sorted({(s, n) for s, _, n in rows}):
        segments = rows[scene, 'SPC', size]['segments']
        times, pairs, last = collections.defaultdict(list), set(), {}
        for _ in range(options.repeat):
            for collider in INSIDE:
                last = _yade(options, os.path.join(folder, f'{scene}_{size}.f64'), segments,
                             collider)
                times[collider].append(1e3 * last['time'])
                pairs.add(round(last['pairs'], 6))
        if len(pairs) > 1:
            sys.exit(f'the colliders disagree in {scene} {size}: {pairs} pairs')
        for collider in INSIDE:
            rows[scene, collider, size] = dict(
                last, scene=scene, method=collider, size=size, segments=segments,
                time=statistics.median(times[collider]))
        print(f'{scene} {size} inside YADE', file=sys.stderr, flush=True)


def _yade(options, file, segments, collider):
    command = [options.yade, '-n', '-x', '-j1', os.path.join(HERE, 'figure14_yade.py'), file,
               str(segments), collider]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=600, check=False)
    for line in reversed(done.stdout.splitlines()):
        if line.startswith('{'):
            return json.loads(line)
    sys.exit(f'{collider}: yade ended with status {done.returncode}: {done.stderr[-300:]}')


# --- tables ---------------------------------------------------------------------------------------
def markdown(rows, machine, options):
    """The whole report."""
    out = ['# Figure 14', '', measured_tables.line(machine) + f'; medians of {options.repeat} runs.', '',
           RULES, '']
    for scene in SCENES:
        out += [f'## {scene}', '', f'{EDGES[scene]}; {_settings(rows, scene)}', '']
        out += _table(rows, scene) + ['']
    return '\n'.join(out + _growthTable(rows))


def _settings(rows, scene):
    mine = [r for (s, m, _), r in rows.items() if s == scene and m == 'SPC']
    b = {round(r['b'], 3) for r in mine}
    low, high = (f(r['lastHalo'] for r in mine) for f in (min, max))
    halo = f'{low:.3f}' if high - low < .001 else f'{low:.3f}…{high:.3f}'
    return f"b = {'/'.join(f'{v:g}' for v in sorted(b))}, δ = {halo} at the end."


def _table(rows, scene):
    head = (['size', 'segments', 'searches', 'candidates'] + COUNTED + ['LPC/SPC', 'HO/SPC']
            + [f'{m}, ms' for m in TIMED] + ['YADE, ms', 'LebesgueCollider, ms'])
    out = ['| ' + ' | '.join(head) + ' |', '|' + '--:|' * len(head)]
    for size in sizes(rows, scene):
        get = lambda m: rows[scene, m, size]  # noqa: E731
        n, per = get('SPC')['segments'], {m: perSegment(get(m)) for m in COUNTED}
        cells = [size, n, f"{get('SPC')['searches']:.0f}", f"{get('SPC')['candidates'] / n:.2f}"]
        cells += [f'{per[m]:.1f}' for m in COUNTED]
        cells += [f"{per['LPC'] / per['SPC']:.2f}", f"{per['HO'] / per['SPC']:.2f}"]
        cells += [f"{get(m)['time']:.3g}" for m in TIMED + INSIDE]
        out.append('| ' + ' | '.join(map(str, cells)) + ' |')
    return out + ['', 'Candidates and comparisons are per segment and search.']


def _growthTable(rows):
    out = ['## Growth', '', 'Comparisons per segment, relative; in brackets without the look at '
           'the nodes found. Exponent: of all comparisons in the number of segments.', '',
           '| scene | segments | ' + ' | '.join(f'{m} | exponent' for m in COUNTED) + ' |',
           '|---|--:|' + '--:|--:|' * len(COUNTED)]
    for scene, small, large in GROWTH:
        cells = []
        for method in COUNTED:
            a, b = rows[scene, method, small], rows[scene, method, large]
            more = b['segments'] / a['segments']
            grown = perSegment(b) / perSegment(a)
            located = perSegment(b, STAGES[:3]) / perSegment(a, STAGES[:3])
            cells += [f'{100 * grown - 100:+.1f} % ({100 * located - 100:+.1f} %)',
                      f'{1 + math.log(grown) / math.log(more):.3f}']
        out.append(f'| {scene} {small} → {large} | × {more:.2f} | ' + ' | '.join(cells) + ' |')
    return out + ['']


def perSegment(row, stages=STAGES):
    """Comparisons per search and segment, of some stages."""
    return sum(row[s] for s in stages) / row['segments']


def sizes(rows, scene):
    """The sizes of a scene, ascending."""
    return sorted({n for s, _, n in rows if s == scene})


# --- picture --------------------------------------------------------------------------------------
STYLES = {'HO': ('HO', '#e0a030', 's-'), 'LPC': ('LPC', '#3d8fb5', '^-'),
          'SPC': ('SPC, as printed', '#d1495b', 'o-'),
          'SPC-directory': ('SPC with a directory', '#d1495b', 'o--'),
          'sweep': ('sweep-and-prune (keeps its pairs)', '#8c8c8c', 'v-'),
          'InsertionSortCollider': ("YADE's sweep-and-prune, inside YADE", '#404040', 'v-'),
          'LebesgueCollider': ('LebesgueCollider, inside YADE', '#8a5aa8', 'D--')}


EDGES = {'squares': 'b: side of a square', 'rings': 'b: shortest segment',
         'bars': 'b: segment before bending'}
CAPTION = """\
Comparison: of two integers or two coordinates. Codes: 4 a node and 1 a level crossed; 1 each code \
compared to place a moved code or a range; 5 a node in a range.
HO: 4 a tree node refitted, 4 a pair of groups, 4 a node met. Sweep-and-prune: 1 each two bounds, \
4 an overlap test. δ: half the shortest segment. SPC, LPC and HO find the same candidates."""


def draw(file, rows, machine):
    """Counts above, as the paper's figure, and times below; one column for each scene."""
    figure, axes = plt.subplots(2, len(SCENES), figsize=(13, 8.6), sharex='col')
    for column, scene in zip(axes.T, SCENES):
        _curves(column[0], rows, scene, COUNTED, lambda r: r['comparisons'] / 1e3)
        _curves(column[1], rows, scene, TIMED + INSIDE, lambda r: r['time'])
        column[0].set_title(f'{scene}\n{EDGES[scene]}: {_settings(rows, scene)[:-1]}', loc='left',
                            fontsize=9.5)
        column[1].set_xlabel('number of ' + SCENES[scene])
    axes[0, 0].set_ylabel('1000 comparisons per search')
    axes[1, 0].set_ylabel('ms per search')
    figure.suptitle("The paper's figure 14: the cost of one global search", fontsize=13)
    handles = {}
    for axis in axes[:, 0]:
        handles.update({label: h for h, label in zip(*axis.get_legend_handles_labels())})
    figure.tight_layout(rect=(0, .06, 1, .94))
    figure.legend(handles.values(), handles.keys(), loc='upper center', ncol=4, frameon=False,
                  bbox_to_anchor=(.5, .967), fontsize=9.5)
    figure.text(.01, .008, CAPTION + '\n' + measured_tables.line(machine), fontsize=8, color='#555555')
    figure.savefig(file, dpi=100)
    plt.close(figure)


def _curves(axis, rows, scene, methods, value):
    for method in methods:
        label, colour, line = STYLES[method]
        x = sizes(rows, scene)
        axis.plot(x, [value(rows[scene, method, n]) for n in x], line, color=colour, label=label,
                  ms=4, lw=1.6)
    axis.set_ylim(bottom=0)
    axis.set_xticks([n for n in sizes(rows, scene) if n % 8 == 0])
    axis.grid(axis='y', color='#dddddd', lw=.8, zorder=0)
    axis.spines[['top', 'right']].set_visible(False)


def _parse(arguments):
    parser = argparse.ArgumentParser(
        prog='scripts/bench figure14', formatter_class=argparse.RawDescriptionHelpFormatter,
        description=__doc__)
    parser.add_argument('--repeat', type=int, default=3, help='runs of each (default: 3)')
    parser.add_argument('--out', default=os.path.join(ROOT, 'out', 'bench'), help='folder')
    parser.add_argument('--program', help='the benchmark program',
                        default=os.path.join(ROOT, 'build', 'release', 'tests', 'yadefrag_figure14'))
    parser.add_argument('--yade', default=os.path.join(ROOT, 'scripts', 'yade'),
                        help='the command that starts yade')
    return parser.parse_args(arguments)


if __name__ == '__main__':
    main(sys.argv[1:])
