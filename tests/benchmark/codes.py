"""YADE, with and without our engines, beside LAMMPS and LIGGGHTS: scripts/bench codes [--sizes 1e4,1e5] ...

The same positions, velocities, radii, stiffness, friction and time step (codes_yade.py writes them, codes_others.py
reads them), without damping. Each measurement is a process of its own; the codes take turns
within every repeat. Shown are medians. Threads are OpenMP's in YADE and MPI
processes in LAMMPS and LIGGGHTS, which Debian builds without OpenMP. The first steps (--warm)
are not measured, as colliders adapt in them.

From a million spheres on, ten steps after five are measured.

After the last step the positions are compared with those of YADE with its own engines: the root of the mean square
of the differences, divided by that of the displacements, must be below TOLERANCE, or it is an error. Without friction
(--friction 0) it is some 1e-12; with friction LAMMPS's torque has another arm (a radius, not the distance to the
middle of the overlap). In the hopper, YADE gives a sphere two contacts where two facets of a wall meet; LAMMPS has no
facets, but planes.

Needs Debian's lammps and liggghts: scripts/setup does not install them. Writes codes.json (raw), codes.md and
codes_sizes.md (tables: 100,000 spheres, other sizes) and codes.png to out/bench; with --readme the tables go into
docs/data and the pages.
"""
import argparse
import json
import os
import shutil
import statistics
import sys
import tempfile
import time

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import codes_others  # noqa: E402
import measured_tables  # noqa: E402
from measured_tables import digits  # noqa: E402

SCENES = ['gas', 'packing', 'mindlin', 'polydisperse', 'stirred', 'hopper']
ENGINES = {  # collider, loop, integrator
    'YADE': ('InsertionSortCollider', 'InteractionLoop', 'NewtonIntegrator'),
    'collider': ('LebesgueCollider', 'InteractionLoop', 'NewtonIntegrator'),
    'loop': ('LebesgueCollider', 'CurveLoop', 'NewtonIntegrator'),
    'integrator': ('LebesgueCollider', 'CurveLoop', 'CurveIntegrator')}
OTHERS = {'LIGGGHTS': codes_others.measureLiggghts, 'LAMMPS': codes_others.measureLammps}
PROGRAMS = {'LIGGGHTS': 'liggghts', 'LAMMPS': 'lmp'}
TOLERANCE = .03
MILLION, FEW = 10**6, dict(warm=5, steps=10)  # from so many spheres on, YADE's own engines take seconds for a step


def parse(arguments):
    """The options."""
    parser = measured_tables.parser('codes', __doc__)
    known = [*ENGINES, *OTHERS]
    names = lambda of: lambda text: knownNames(text.split(','), of)  # noqa: E731
    numbers = lambda text: [int(float(x)) for x in text.split(',')]  # noqa: E731
    parser.add_argument('--scenes', type=names(SCENES), default=SCENES, help='default: all')
    parser.add_argument('--codes', type=names(known), default=known, help=f'default: {",".join(known)}')
    parser.add_argument('--sizes', type=numbers, default=[10000, 100000], help='default: 1e4,1e5')
    parser.add_argument('--threads', type=numbers, default=[1], help='default: 1')
    parser.add_argument('--steps', type=int, default=150, help='default: %(default)s')
    parser.add_argument('--warm', type=int, default=50, help='steps before these; default: %(default)s')
    parser.add_argument('--repeat', type=int, default=3, help='default: %(default)s')
    parser.add_argument('--friction', type=float, default=.3, help='angle of friction, radians; default: %(default)s')
    parser.add_argument('--limit', type=float, default=600., help='s per process; default: %(default)s')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--add', nargs='*', default=[], metavar='FILE',
                        help='codes.json of runs before, of other sizes or scenes, for the same table')
    return parser.parse_args(arguments)


def knownNames(names, known):
    """The names, if all are known."""
    unknown = [name for name in names if name not in known]
    if unknown:
        raise argparse.ArgumentTypeError(f'{unknown[0]} is not one of {", ".join(known)}')
    return names


def makeProgress():
    """A function of a text that prints each new scene."""
    last = [None]

    def say(text):
        scene = text.split(':')[0]
        if scene != last[0]:
            print(f'{time.strftime("%H:%M:%S")} {scene}', file=sys.stderr, flush=True)
        last[0] = scene
    return say


def installed(codes):
    """Those of the codes that there are; a sentence about the others."""
    missing = [name for name in codes if name in OTHERS and not shutil.which(PROGRAMS[name])]
    if missing:
        packages = ' '.join(name.lower() for name in missing)
        print(f'not compared with {" and ".join(missing)}: not installed (sudo apt-get install {packages}).',
              file=sys.stderr)
    return [name for name in codes if name not in missing]


def stepsOf(options, n):
    """Steps before those that are measured, and these."""
    return FEW if n >= MILLION else dict(warm=options.warm, steps=options.steps)


def ofYade(options, name, scene, n, threads, folder):
    """One run of YADE; its row. RuntimeError if it fails."""
    collider, loop, integrator = ENGINES[name]
    settings = dict(scene=scene, n=n, **stepsOf(options, n), seed=options.seed, friction=options.friction,
                    collider=collider, loop=loop, integrator=integrator, folder=folder)
    row = measured_tables.measuredBy(options, 'codes_yade.py', json.dumps(settings), threads=threads, limit=options.limit)
    return row, np.load(os.path.join(folder, 'end.npy'))


def ofOther(options, name, n, threads, folder):
    """One run of another code; its row, and the positions at the end."""
    row = OTHERS[name](folder, **stepsOf(options, n), processes=threads, limit=options.limit)
    return row, codes_others.ended(folder)


def deviation(folder, end, reference):
    """Difference of positions relative to the displacements since the start, of the spheres that obey forces."""
    arrays, _ = codes_others.start(folder)
    free = ~arrays['fixed']
    size = lambda x: np.sqrt((x[free] ** 2).sum(axis=1).mean())  # noqa: E731
    return float(size(end - reference) / size(reference - arrays['places']))


def measured(options, progress):
    """A row for each scene, size, number of threads, repeat and code."""
    rows = []
    for n in options.sizes:
        for scene in options.scenes:
            with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
                reference = contacts = None
                for threads in options.threads:
                    for repeat in range(options.repeat):
                        # The first of all is YADE, without which the others have no scene.
                        for name in options.codes:
                            progress(f'{scene} {n}: {name}')
                            if name in ENGINES:
                                row, end = ofYade(options, name, scene, n, threads, folder)
                                reference = end if reference is None else reference
                                contacts = contacts or row['contacts']
                            else:
                                row, end = ofOther(options, name, n, threads, folder)
                            row.update(scene=scene, n=n, threads=threads, repeat=repeat, code=name,
                                       deviation=deviation(folder, end, reference), contacts=contacts)
                            if not row['deviation'] < TOLERANCE:
                                raise RuntimeError(f'{scene}, {n} bodies: the positions of {name} differ by '
                                                   f'{row["deviation"]:.2g} of the displacements')
                            rows.append(row)
    return rows


def earlier(file, steps):
    """The rows of a run before."""
    with open(file) as source:
        found = json.load(source)
    if found['steps'] != steps and any(row['n'] < MILLION for row in found['rows']):
        sys.exit(f'scripts/bench codes: {file} has the means of {found["steps"]} steps, not of --steps {steps}.')
    if found['machine']['commit'] != measured_tables.origin.commit():
        sys.exit(f'scripts/bench codes: {file} is of commit {found["machine"]["commit"]}.')
    return found['rows']


def summary(rows):
    """{(scene, n, threads, code): medians}."""
    groups = {}
    for row in rows:
        groups.setdefault((row['scene'], row['n'], row['threads'], row['code']), []).append(row)
    names = ('search', 'forces', 'integration', 'step', 'contacts', 'deviation', 'memory')
    return {key: {name: statistics.median(row[name] for row in own) for name in names} for key, own in groups.items()}


# --- table and plot

PARTS = {'search': '#3d8fb5', 'forces': '#d1495b', 'integration': '#e0a030', 'other': '#bbbbbb'}


def rows(found):
    """A row for each scene, size, number of threads and code: ms; MB of the largest process."""
    return [{'scene': scene, 'spheres': str(n), 'contacts': str(int(entry['contacts'])), 'threads': str(threads), 'code': name,
             **{part: digits(1e3 * entry[part]) for part in ('step', 'search', 'forces', 'integration')},
             'memory': digits(entry['memory'] / 1e6)}
            for (scene, n, threads, name), entry in found.items()]


def plot(file, found, about):
    """Bars of the parts of a step, a panel for each scene: the largest size with all scenes, the fewest threads."""
    codes = [name for name in measured_tables.CODES if any(key[3] == name for key in found)]
    scenes = list(dict.fromkeys(key[0] for key in found))
    threads = min(key[2] for key in found)
    n = max(size for size in {key[1] for key in found}
            if all((scene, size, threads, codes[0]) in found for scene in scenes))
    figure, axes = plt.subplots(len(scenes), 1, figsize=(8, 1.9 * len(scenes) + .9), squeeze=False)
    for axis, scene in zip(axes[:, 0], scenes):
        entries = [found[scene, n, threads, name] for name in codes]
        left = [0.] * len(codes)
        for part, colour in PARTS.items():
            if part == 'other':
                widths = [max(0., 1e3 * entry['step'] - begin) for entry, begin in zip(entries, left)]
            else:
                widths = [1e3 * entry[part] for entry in entries]
            axis.barh(range(len(codes)), widths, left=left, color=colour, label=part, height=.75, zorder=2)
            left = [a + b for a, b in zip(left, widths)]
        for place, entry in enumerate(entries):
            axis.text(1e3 * entry['step'], place, ' ' + digits(1e3 * entry['step']), va='center', fontsize=8)
        axis.set_yticks(range(len(codes)), [measured_tables.CODES[name].replace('`', '') for name in codes], fontsize=9)
        axis.invert_yaxis()
        axis.set_xlim(0, axis.get_xlim()[1] * 1.06)
        axis.set_title(scene, loc='left', fontsize=11)
        axis.grid(axis='x', color='#dddddd', lw=.8, zorder=0)
        axis.spines[['top', 'right']].set_visible(False)
    axes[-1, 0].set_xlabel('ms per step')
    inch = 1 / figure.get_figheight()
    figure.suptitle(f'One step of {n:,} spheres, {threads} thread{"s" * (threads > 1)}', fontsize=13)
    figure.tight_layout(rect=(0, .25 * inch, 1, 1 - .3 * inch))
    handles, names = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, names, loc='upper center', bbox_to_anchor=(.5, 1 - .32 * inch), ncol=len(PARTS), frameon=False)
    figure.text(.01, .08 * inch, about, fontsize=8, color='#555555')
    figure.savefig(file, dpi=110)
    plt.close(figure)


def main(arguments):
    """Parse, measure, write."""
    options = parse(arguments)
    options.codes = installed(options.codes)
    former = [row for file in options.add for row in earlier(file, options.steps)]
    if not options.codes or options.codes[0] not in ENGINES:
        sys.exit('scripts/bench codes: the first of --codes must be one of ' + ', '.join(ENGINES) + '.')
    runs = former + measured(options, makeProgress())
    machine = measured_tables.machineOf(runs)
    os.makedirs(options.out, exist_ok=True)
    with open(os.path.join(options.out, 'codes.json'), 'w') as out:
        json.dump(dict(machine=machine, steps=options.steps, friction=options.friction, rows=runs), out, indent=1)
    found = summary(runs)
    repeats = 'one run of each' if options.repeat == 1 else f'medians of {options.repeat} runs'
    about = (f'{measured_tables.line(machine, "as many used as threads")}, `scripts/bench codes`; ms, means of {options.steps} steps '
             f'({FEW["steps"]} with a million), {repeats}, MB of the largest process, '
             f'positions differ by {max(entry["deviation"] for entry in found.values()):.1g} of the displacements at most')
    for name, isMain in (('codes', True), ('codes_sizes', False)):
        own = [row for row in rows(found) if (row['spheres'] == measured_tables.SIZE) == isMain]
        if own:
            measured_tables.publish(options, name, own, about)
    plot(os.path.join(options.out, 'codes.png'), found, measured_tables.line(machine))


if __name__ == '__main__':
    main(sys.argv[1:])
