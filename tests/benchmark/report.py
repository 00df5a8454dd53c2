"""Tables and plots of `scripts/bench colliders`."""
import json
import os
import statistics
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'examples'))
import origin  # noqa: E402

import measured_tables  # noqa: E402

RIVAL = 'InsertionSortCollider'
NAMES = {RIVAL: 'YADE default', 'tuned': 'YADE tuned', 'LebesgueCollider': 'Lebesgue',
         'LinearCodeCollider': 'LinearCode', 'HierarchyCollider': 'Hierarchy'}
COLOURS = {RIVAL: '#8c8c8c', 'tuned': '#404040', 'LebesgueCollider': '#d1495b',
           'LinearCodeCollider': '#3d8fb5', 'HierarchyCollider': '#e0a030'}
TIMES = [('first', 'first activation'), ('perActivation', 'each later activation'),
         ('sumPerStep', 'step: collider + loop + integrator')]


def write(folder, rows, grids, options):
    """Write colliders.json, colliders.md and the plots into the folder, and print their folder."""
    os.makedirs(folder, exist_ok=True)
    machine = machineOf(rows)
    raw = dict(machine=machine, repeat=options.repeat, seed=options.seed, budget=options.budget,
               rows=rows, grids=grids)
    with open(os.path.join(folder, 'colliders.json'), 'w') as f:
        json.dump(raw, f, indent=1)
    summary = summarise(rows)
    text = markdown(summary, grids, machine, options)
    with open(os.path.join(folder, 'colliders.md'), 'w') as f:
        f.write(text)
    plots(folder, summary, machine)
    if options.readme:
        n = max(key[1] for key in summary)
        measured_tables.write('colliders', f'{n:,} bodies, {line(machine)}, `scripts/bench colliders`; ms', inShort(summary, n))
    print(text)
    print('written to', folder)


def summarise(rows):
    """{(scene, n, label): dict of medians, ratios `x...` to default and `t...` to tuned, error}."""
    groups = {}
    for row in rows:
        groups.setdefault((row['scene'], row['n'], row['label']), {})[row['repeat']] = row
    summary = {}
    for (scene, n, label), repeats in groups.items():
        good = {k: r for k, r in repeats.items() if 'error' not in r}
        if not good:
            summary[scene, n, label] = dict(error=next(iter(repeats.values()))['error'])
            continue
        keys = [k for k, v in next(iter(good.values())).items() if isinstance(v, (int, float))]
        entry = {k: statistics.median(r[k] for r in good.values()) for k in keys}
        for prefix, rival in (('x', RIVAL), ('t', 'tuned')):
            others = groups.get((scene, n, rival), {})
            for key, _ in TIMES:
                pairs = [others[k][key] / r[key] for k, r in good.items()
                         if k in others and 'error' not in others[k]]
                entry[prefix + key] = statistics.median(pairs) if pairs else None
        summary[scene, n, label] = entry
    return summary


def inShort(summary, n):
    """Searches and steps of a size, ms: YADE's collider, tuned, and ours."""
    rows = []
    for scene in dict.fromkeys(key[0] for key in summary if key[1] == n):
        theirs, tuned, ours = (summary.get((scene, n, label), {}) for label in (RIVAL, 'tuned', 'LebesgueCollider'))
        if 'sumPerStep' in theirs and 'sumPerStep' in ours:
            ms = lambda row, key: _digits(1e3 * row[key]) if key in row else ''  # noqa: E731
            rows.append({'scene': scene, 'first YADE': ms(theirs, 'first'), 'first': ms(ours, 'first'),
                         'later YADE': ms(theirs, 'perActivation'), 'later': ms(ours, 'perActivation'),
                         'step YADE': ms(theirs, 'sumPerStep'), 'step tuned': ms(tuned, 'sumPerStep'),
                         'step': ms(ours, 'sumPerStep')})
    return rows


def machineOf(rows):
    """Machine, date, versions."""
    return dict(machine=origin.machine(), date=origin.date(), commit=origin.commit(),
                yade=next((r['yade'] for r in rows if 'yade' in r), 'unknown'))


def line(machine, used='one used'):
    """The machine in one line."""
    return (f"{machine['machine']} ({used}), {machine['date']}, "
            f"YADE {machine['yade']}, commit {machine['commit']}")


# --- Markdown -------------------------------------------------------------------------------------
HEAD = ['scene', 'collider', 'first, ms', '×', 'activation, ms', '×', 'collider/step, ms',
        'loop/step, ms', 'integrator/step, ms', 'sum/step, ms', '× default', '× tuned',
        'whole step, ms', 'activations/steps', 'potential', 'real', 'peak, MB']


def markdown(summary, grids, machine, options):
    """The whole report as Markdown, one table per size."""
    out = ['# Colliders', '', line(machine) + '.', '',
           f'Medians of {options.repeat} runs, one process each, one thread. `×`: how many times '
           'faster than YADE\'s collider at its defaults; `sum` is collider + interaction loop + '
           'integrator, compared with the default and with the tuned rival in the same repeat. '
           'An asterisk: too few activations in the measured steps, so the collider was called by '
           'hand.', '']
    for n in sorted({key[1] for key in summary}):
        out += [f'## {n} bodies', '', '| ' + ' | '.join(HEAD) + ' |',
                '|---|---|' + '--:|' * (len(HEAD) - 2)]
        for (scene, size, label), entry in summary.items():
            if size == n:
                out.append('| ' + ' | '.join([scene, NAMES[label]] + _cells(entry)) + ' |')
        out.append('')
        out += _tunedLines([g for g in grids if g['n'] == n]) + _disagreements(summary, n)
    return '\n'.join(out)


def _cells(entry):
    if 'error' in entry:
        return [entry['error'].replace('|', '/')] + [''] * (len(HEAD) - 3)
    ms = lambda key: _digits(1e3 * entry[key])  # noqa: E731
    times = lambda key: _digits(entry[key]) if entry.get(key) else '–'  # noqa: E731
    star = '*' if entry['activationsForced'] else ''
    return [ms('first'), times('xfirst'), ms('perActivation') + star, times('xperActivation'),
            ms('colliderPerStep'), ms('loopPerStep'), ms('integratorPerStep'), ms('sumPerStep'),
            times('xsumPerStep'), times('tsumPerStep'), ms('wallPerStep'),
            f"{entry['activations']:g}/{entry['steps']:g}", f"{entry['potential']:.0f}",
            f"{entry['real']:.0f}", f"{entry['peakMemory'] / 2 ** 20:.0f}"]


def _digits(value):
    """Three digits."""
    return f'{value:.0f}' if abs(value) >= 100 else f'{value:.3g}'


def _tunedLines(grids):
    if not grids:
        return []
    best = [f"{g['scene']} {g['best']['verletDist']:g}, {g['best']['targetInterv']}"
            for g in grids if g['best']]
    return ['Tuned (`verletDist`, `targetInterv`; a negative distance is in smallest radii): '
            + '; '.join(best) + '.', '']


def _disagreements(summary, n):
    """A warning for each scene whose real contacts after the first step depend on the collider."""
    out = []
    for scene in _ordered(key[0] for key in summary if key[1] == n):
        counts = {NAMES[k[2]]: int(v['realAfterFirst']) for k, v in summary.items()
                  if k[:2] == (scene, n) and 'error' not in v}
        if len(set(counts.values())) > 1:
            out += [f'**Contacts differ after the first step of {scene}: {counts}.**', '']
    return out


# --- plots ----------------------------------------------------------------------------------------
def plots(folder, summary, machine):
    """colliders.png: relative times at the largest size; colliders_sizes.png: against the size."""
    good = {k: v for k, v in summary.items() if 'error' not in v}
    sizes = {k[1] for k in good if k[2] == RIVAL}
    if sizes:
        _bars(os.path.join(folder, 'colliders.png'), good, max(sizes), machine)
    if len(sizes) > 1:
        _lines(os.path.join(folder, 'colliders_sizes.png'), good, machine)


def _ordered(values):
    return list(dict.fromkeys(values))


def _labels(good):
    return [label for label in NAMES if any(k[2] == label for k in good)]


TALLEST = 2.2  # taller bars are cut; their number is written


def _bars(file, good, n, machine):
    """Time relative to YADE's default, whose own time stands under each scene."""
    labels = _labels(good)
    scenes = _ordered(k[0] for k in good if k[1:] == (n, RIVAL))
    figure, axes = plt.subplots(3, 1, figsize=(max(8., 1.75 * len(scenes) + 1), 10))
    width = .86 / len(labels)
    for axis, (key, title) in zip(axes, TIMES):
        for i, label in enumerate(labels):
            places = [j for j, s in enumerate(scenes) if (s, n, label) in good]
            ratios = [good[scenes[j], n, label]['x' + key] for j in places]
            x = [j + (i - (len(labels) - 1) / 2) * width for j in places]
            bars = axis.bar(x, [min(1 / r, TALLEST) for r in ratios], width * .92, label=NAMES[label],
                            color=COLOURS[label], zorder=2)
            if label != RIVAL:
                axis.bar_label(bars, [_times(r) for r in ratios], fontsize=7.5, padding=1)
        axis.set_title(title[0].upper() + title[1:], loc='left', fontsize=11)
        axis.set_ylabel('time / default')
        axis.set_ylim(0, axis.get_ylim()[1] * 1.08)
        own = [f'{s}\n{_seconds(good[s, n, RIVAL][key])}' for s in scenes]
        axis.set_xticks(range(len(scenes)), own)
        _clean(axis)
    figure.suptitle(f'Contact search inside YADE, {n:,} bodies: time relative to YADE\'s collider\n'
                    'at its defaults (whose time is under the scene); on the bars, times faster',
                    fontsize=12)
    _finish(figure, axes[0], file, machine, len(labels))


def _times(ratio):
    return f'{ratio:.{0 if ratio >= 9.5 else 1 if ratio >= .95 else 2}f}×'


def _seconds(value):
    return f'{_digits(value)} s' if value >= 1 else f'{_digits(1e3 * value)} ms'


def _lines(file, good, machine):
    labels, scenes = _labels(good), _ordered(k[0] for k in good)
    columns = min(4, len(scenes))
    rows = -(-len(scenes) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.1 * columns + .8, 2.7 * rows + 1.5),
                                sharex=True, sharey=True, squeeze=False)
    for axis, scene in zip(axes.flat, scenes):
        for label in labels:
            sizes = sorted(k[1] for k in good if k[0] == scene and k[2] == label)
            values = [1e6 * good[scene, n, label]['sumPerStep'] / n for n in sizes]
            axis.plot(sizes, values, 'o-', color=COLOURS[label], label=NAMES[label], ms=4, lw=1.6)
        axis.set_title(scene, loc='left', fontsize=11)
        axis.set_xscale('log')
        _logAxis(axis.yaxis)
        _clean(axis)
    for axis in list(axes.flat)[len(scenes):]:
        axis.set_visible(False)
    for axis in axes[-1]:
        axis.set_xlabel('bodies')
    for axis in axes[:, 0]:
        axis.set_ylabel('µs per step and body')
    figure.suptitle('Collider + interaction loop + integrator (less is better)', fontsize=13)
    _finish(figure, axes[0, 0], file, machine, len(labels))


def _logAxis(axis):
    getattr(axis.axes, f'set_{axis.axis_name}scale')('log')
    axis.set_major_formatter(FuncFormatter(lambda v, _: f'{v:g}'))
    low, high = axis.get_view_interval()
    few = high / low < 30
    axis.set_minor_formatter(FuncFormatter(_minorLabel) if few else NullFormatter())


def _minorLabel(value, _):
    first = f'{value:e}'[0]
    return f'{value:g}' if first in '25' else ''


def _clean(axis):
    axis.grid(axis='y', color='#dddddd', lw=.8, zorder=0)
    axis.spines[['top', 'right']].set_visible(False)


def _finish(figure, axis, file, machine, columns):
    """Legend under the title, machine at the foot, margins in inches whatever the height."""
    inch = 1 / figure.get_figheight()
    handles, names = axis.get_legend_handles_labels()
    figure.tight_layout(rect=(0, .25 * inch, 1, 1 - .6 * inch))
    figure.legend(handles, names, loc='upper center', bbox_to_anchor=(.5, 1 - .5 * inch),
                  ncol=columns, frameon=False, fontsize=10)
    figure.text(.01, .08 * inch, line(machine), fontsize=8, color='#555555')
    figure.savefig(file, dpi=110)
    plt.close(figure)
