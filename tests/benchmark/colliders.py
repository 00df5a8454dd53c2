"""YADE's collider against ours: scripts/bench colliders [--scenes a,b] [--sizes 1000,10000] ...

Plain Python; every measurement is a process of its own (measure.py inside yade, one thread). In
each scene and size the colliders take turns within every repeat, and ratios are formed within a
repeat, so that a slow minute of the machine falls on both. Shown are medians over the repeats.

The rows:
    InsertionSortCollider   YADE's collider at its defaults
    tuned                   the same, with the best of GRID: short runs of this scene and size, the
                            best three once more, the best of these measured in full
    LebesgueCollider, LinearCodeCollider, HierarchyCollider   at their defaults

Writes colliders.json (raw) and colliders.md (table) to out/bench. `×` is how many times faster than YADE's
collider at its defaults; `step` is collider + interaction loop + integrator. An asterisk: too few activations in the
measured steps, so the collider was called by hand.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import time

import measured_tables
from measured_tables import digits

RIVAL = 'InsertionSortCollider'
OURS = ['LebesgueCollider', 'LinearCodeCollider', 'HierarchyCollider']
ROWS = [RIVAL, 'tuned'] + OURS
SCENES = ['gas', 'gas4', 'packing', 'polydisperse', 'polydisperse4', 'polydisperse50', 'clusters',
          'plane', 'projectile', 'insertion', 'exchange', 'rest']
TIMES = ('first', 'perActivation', 'sumPerStep')
FINALISTS = 3
# Multiples of the smallest radius (YADE takes a negative verletDist so) and steps between bounds.
GRID = [dict(verletDist=-v, targetInterv=t) for v in (.05, .1, .2, .5, 1.) for t in (0, 10, 50)]


# --- measurements ---------------------------------------------------------------------------------
class Runner:
    """Runs measure.py, each time in a fresh yade process, and keeps all rows."""

    def __init__(self, options):
        self.options, self.rows = options, []

    def measure(self, collider, scene, n, budget, **settings):
        """One measurement; returns its row, with the key `error` if there is none."""
        arguments = dict(scene=scene, n=n, seed=self.options.seed, collider=collider, budget=budget, **settings)
        try:
            return measured_tables.measuredBy(self.options, 'measure.py', *(f'{k}={v}' for k, v in arguments.items()),
                                              limit=self.options.limit)
        except subprocess.TimeoutExpired:
            return dict(error=f'no result within {self.options.limit:g} s')
        except RuntimeError as error:
            return dict(error=str(error))

    def keep(self, row, **keys):
        """Store a row under its keys (scene, n, label, repeat)."""
        self.rows.append({**row, **keys})


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
                settings = tunedSettings(runner, scene, n, progress, grids, failed)
            tuned = label == 'tuned'
            if tuned and settings is None:
                row = dict(error='not tuned: the default collider gave no result here')
            else:
                row = runner.measure(RIVAL if tuned else label, scene, n, o.budget,
                                     **(settings if tuned else {}))
            if 'error' in row:
                failed.add(label)
            runner.keep(row, scene=scene, n=n, label=label, repeat=repeat)


def tunedSettings(runner, scene, n, progress, grids, failed):
    """Settings for the tuned rival, or None where the default one has failed already."""
    if RIVAL in failed:
        progress(f'{scene} {n}: tuning', len(GRID) + FINALISTS)
        return None
    settings, table = tune(runner, scene, n, progress)
    grids.append(dict(scene=scene, n=n, best=settings, table=table))
    return settings


def makeProgress():
    """A function (text, steps=1) that prints each new scene."""
    last = [None]

    def say(text, steps=1):
        scene = text.split(':')[0]
        if scene != last[0]:
            print(f'{time.strftime("%H:%M:%S")} {scene}', file=sys.stderr, flush=True)
        last[0] = scene
    return say


# --- tables ---------------------------------------------------------------------------------------
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
            for key in TIMES:
                pairs = [others[k][key] / r[key] for k, r in good.items()
                         if k in others and 'error' not in others[k]]
                entry[prefix + key] = statistics.median(pairs) if pairs else None
        summary[scene, n, label] = entry
    return summary


def allRows(summary):
    """A row for each scene, size and collider."""
    rows = []
    for (scene, n, label), entry in summary.items():
        row = {'scene': scene, 'bodies': str(n), 'collider': label}
        if 'error' in entry:
            rows.append({**row, 'first, ms': entry['error'].replace('|', '/')})
            continue
        ms = lambda key: digits(1e3 * entry[key])  # noqa: E731
        times = lambda key: digits(entry[key]) if entry.get(key) else ''  # noqa: E731
        rows.append({**row, 'first, ms': ms('first'), '×': times('xfirst'),
                     'later, ms': ms('perActivation') + '*' * bool(entry['activationsForced']),
                     '× later': times('xperActivation'), 'collider/step, ms': ms('colliderPerStep'),
                     'loop/step, ms': ms('loopPerStep'), 'integrator/step, ms': ms('integratorPerStep'),
                     'step, ms': ms('sumPerStep'), '× step': times('xsumPerStep'), '× tuned': times('tsumPerStep'),
                     'activations/steps': f"{entry['activations']:g}/{entry['steps']:g}",
                     'potential': f"{entry['potential']:.0f}", 'real': f"{entry['real']:.0f}",
                     'peak, MB': f"{entry['peakMemory'] / 2 ** 20:.0f}"})
    head = dict.fromkeys(key for row in rows for key in row)
    return [{key: row.get(key, '') for key in head} for row in rows]


def inShort(summary, n):
    """Searches and steps of a size, ms: YADE's collider, tuned, and ours."""
    rows = []
    for scene in dict.fromkeys(key[0] for key in summary if key[1] == n):
        theirs, tuned, ours = (summary.get((scene, n, label), {}) for label in (RIVAL, 'tuned', 'LebesgueCollider'))
        if 'sumPerStep' in theirs and 'sumPerStep' in ours:
            ms = lambda row, key: digits(1e3 * row[key]) if key in row else ''  # noqa: E731
            rows.append({'scene': scene, 'first YADE': ms(theirs, 'first'), 'first': ms(ours, 'first'),
                         'later YADE': ms(theirs, 'perActivation'), 'later': ms(ours, 'perActivation'),
                         'step YADE': ms(theirs, 'sumPerStep'), 'step tuned': ms(tuned, 'sumPerStep'),
                         'step': ms(ours, 'sumPerStep')})
    return rows


def remarks(summary, grids):
    """Sentences: what was tuned, and scenes whose real contacts after the first step depend on the collider."""
    best = [f"{g['scene']} {g['n']}: {g['best']['verletDist']:g}, {g['best']['targetInterv']}" for g in grids if g['best']]
    lines = ['Tuned (`verletDist`, in smallest radii, and `targetInterv`): ' + '; '.join(best) + '.'] if best else []
    for scene, n in dict.fromkeys(key[:2] for key in summary):
        counts = {k[2]: int(v['realAfterFirst']) for k, v in summary.items() if k[:2] == (scene, n) and 'error' not in v}
        if len(set(counts.values())) > 1:
            lines.append(f'**Contacts differ after the first step of {scene}, {n} bodies: {counts}.**')
    return lines


def write(options, rows, grids):
    """Write colliders.json and colliders.md, and the page's table if requested."""
    machine, summary = measured_tables.machineOf(rows), summarise(rows)
    os.makedirs(options.out, exist_ok=True)
    with open(os.path.join(options.out, 'colliders.json'), 'w') as file:
        json.dump(dict(machine=machine, repeat=options.repeat, seed=options.seed, budget=options.budget, rows=rows,
                       grids=grids), file, indent=1)
    about = f'{measured_tables.line(machine)}, medians of {options.repeat} runs, one process each, one thread'
    text = '\n\n'.join([measured_tables.markdown(allRows(summary), about), *remarks(summary, grids)])
    with open(os.path.join(options.out, 'colliders.md'), 'w') as file:
        file.write(text + '\n')
    print(text)
    if options.readme:
        n = max(key[1] for key in summary)
        measured_tables.write('colliders', f'{n:,} bodies, {measured_tables.line(machine)}, `scripts/bench colliders`; ms',
                              inShort(summary, n))


# --- command --------------------------------------------------------------------------------------
def parse(arguments):
    """The options."""
    parser = measured_tables.parser('colliders', __doc__)
    names = lambda known: lambda text: knownNames(text.split(','), known)  # noqa: E731
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
    parser.add_argument('--seed', type=int, default=1)
    options = parser.parse_args(arguments)
    if options.quick:
        options.sizes, options.repeat, options.budget = [1000, 10000], 1, 2.
    return options


def knownNames(names, known):
    """The names, if all are known."""
    unknown = [name for name in names if name not in known]
    if unknown:
        raise argparse.ArgumentTypeError(f'{unknown[0]} is not one of {", ".join(known)}')
    return names


def main(arguments):
    """Measure according to the arguments; report the results so far if interrupted."""
    options = parse(arguments)
    runner, grids, progress, status = Runner(options), [], makeProgress(), 0
    try:
        for n in options.sizes:
            for scene in options.scenes:
                compare(runner, scene, n, progress, grids)
    except KeyboardInterrupt:
        print('\ninterrupted: the report holds what was measured so far', file=sys.stderr)
        status = 130
    if runner.rows:
        write(options, runner.rows, grids)
    return status


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
