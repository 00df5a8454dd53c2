"""The interval that LebesgueCollider chooses, against fixed ones: scripts/bench intervals [...]

For each scene the default (`adaptInterval=True`) and fixed intervals (`adaptInterval=False` with each
of STEPS as `targetInterv`) take turns in each repeat. Shown are collider + interaction loop +
integrator per step, medians over the repeats, and the ratio of the chosen to the best fixed interval.
The integrator does the same work in all runs of a scene: its time shows how fast the machine is during
a run, and all times are relative to it. Writes intervals.json and intervals.md to out/bench; with
--readme the table goes into docs/data and the pages.
"""
import json
import os
import statistics
import sys

import colliders
import measured_tables

STEPS = (3, 5, 10, 20, 40, 80)
SCENES = ['gas025', 'gas', 'gas4', 'polydisperse025', 'polydisperse', 'polydisperse4', 'packing',
          'clusters', 'insertion']


def measure(options):
    """{scene: {steps or 'chosen': s per step}}; a run without a result ends the comparison.

    A run's ratio of collider and loop to the integrator counts, times the median of the integrator.
    """
    runner = colliders.Runner(options)
    settings = {'chosen': {}, **{t: dict(adaptInterval='False', targetInterv=t) for t in STEPS}}
    found = {}
    for scene in options.scenes:
        runs, integrator = {name: [] for name in settings}, []
        for _ in range(options.repeat):
            for name, values in settings.items():
                row = runner.measure('LebesgueCollider', scene, options.n, options.budget,
                                     warm=options.warm, **values)
                if 'error' in row:
                    sys.exit(f'{scene}, {name}: {row["error"]}')
                runs[name].append(row['sumPerStep'] / row['integratorPerStep'])
                integrator.append(row['integratorPerStep'])
        unit = statistics.median(integrator)
        found[scene] = {name: unit * statistics.median(ratios) for name, ratios in runs.items()}
        print(scene, {name: f'{1e3 * time:.4g}' for name, time in found[scene].items()}, file=sys.stderr,
              flush=True)
    return found


def table(found):
    """A row per scene."""
    return [{'scene': scene, **{str(name): f'{1e3 * times[name]:.3g}' for name in (*STEPS, 'chosen')},
             'chosen over the best': f'{times["chosen"] / min(times[t] for t in STEPS):.2f}'} for scene, times in found.items()]


def main(arguments):
    """Parse, measure, report."""
    parser = measured_tables.parser('intervals', __doc__)
    parser.add_argument('--scenes', type=lambda t: t.split(','), default=SCENES)
    parser.add_argument('--n', type=int, default=100000)
    parser.add_argument('--repeat', type=int, default=3)
    parser.add_argument('--warm', type=int, default=300, help='steps before those that are measured')
    parser.add_argument('--budget', type=float, default=6.)
    parser.add_argument('--limit', type=float, default=180.)
    parser.add_argument('--seed', type=int, default=1)
    options = parser.parse_args(arguments)
    found = measure(options)
    about = f'{options.n:,} bodies, ms per step relative to the integrator of the same run, {measured_tables.origin.line()}, `scripts/bench intervals`'
    measured_tables.publish(options, 'intervals', table(found), about)
    with open(os.path.join(options.out, 'intervals.json'), 'w') as file:
        json.dump(found, file, indent=1)


if __name__ == '__main__':
    main(sys.argv[1:])
