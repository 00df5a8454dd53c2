"""Table and plot of codes.py."""
import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

from measured_tables import digits  # noqa: E402

NAMES = {'YADE': 'YADE', 'collider': '+ `LebesgueCollider`', 'loop': '+ `CurveLoop`', 'integrator': '+ `CurveLoop`, `CurveIntegrator`',
         'LIGGGHTS': 'LIGGGHTS', 'LAMMPS': 'LAMMPS'}
PARTS = {'search': '#3d8fb5', 'forces': '#d1495b', 'integration': '#e0a030', 'other': '#bbbbbb'}


def columns(found):
    """The codes that were measured, in the order of NAMES."""
    return [name for name in NAMES if any(key[3] == name for key in found)]


def rows(found):
    """A row for each scene, size, number of threads and code, ms."""
    return [{'scene': scene, 'spheres': str(n), 'contacts': str(int(entry['contacts'])), 'threads': str(threads), 'code': name,
             **{part: digits(1e3 * entry[part]) for part in ('step', 'search', 'forces', 'integration')}}
            for (scene, n, threads, name), entry in found.items()]


def plot(file, found, about):
    """Bars of the parts of a step, a panel for each scene: the largest size with all scenes, the fewest threads."""
    codes, scenes = columns(found), list(dict.fromkeys(key[0] for key in found))
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
        axis.set_yticks(range(len(codes)), [NAMES[name].replace('`', '') for name in codes], fontsize=9)
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
