"""Impact of an elastic cylinder on a block of brittle material, held at its bottom, which breaks
into fragments.

    scripts/impact            sets up, builds and runs this
    scripts/yade -n -x examples/impact/impact.py [--size 5e-4] [--speed 50] [--steps 4000] …

The impact of Diekmann et al., ECCOMAS 2000, §6, figure 15. Steel cylinder of 10 mm with a smooth
surface, ceramic block of 40 × 20 mm that cracks along the edges of its triangles; the fragments have
contact from that step on. All in SI units, plane strain, per metre of thickness. Writes to
out/impact/: impact.png (stress at six moments), impact_fragments.png (the fragments at the end),
impact_course.png (surface segments, cracks, fragments, energies over time), impact_sizes.png,
course.csv and fragments.csv.
"""
import math
import os
import sys
import time

import numpy as np

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [HERE, os.path.join(HERE, '..')]
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import BrittleFEMat, FEMat, FESolver  # noqa: E402
from yadefrag import circle, fragmentTable, recordFracture, rectangle  # noqa: E402
from yadefrag import plotFragmentSizes  # noqa: E402

RADIUS, BLOCK = 5e-3, (40e-3, 20e-3)  # m
BRITTLE, CYLINDER = 0, 1  # components
EVERY = 5  # steps between two lines of the record
TOP = 1500  # MPa, of the colours
SHARES = (.03, .06, .1, .2, .5, 1)  # of the steps: the moments of the pictures
CROP = ((-2.5, 42.5), (-.5, 32.))  # mm
INTACT = '#e4e1da'  # the largest fragment of a body
COLOURS = ('#8ecae6', '#ffb703', '#90be6d', '#f28482', '#b8a1d9', '#e9c46a', '#5f9ea0', '#d4a373')
OUT = os.path.normpath(os.path.join(HERE, '..', '..', 'out', 'impact'))
FILES = ('impact.png', 'impact_fragments.png', 'impact_course.png', 'impact_sizes.png',
         'course.csv', 'fragments.csv')


def build(options):
    """Block (body 0) and cylinder (body 1); returns the solver."""
    O.materials.append(FEMat(young=210e9, poisson=.3, density=7800, frictionAngle=0, label='steel'))
    O.materials.append(BrittleFEMat(
        young=370e9, poisson=.22, density=3900, frictionAngle=.3, tensileStrength=options.strength,
        fractureEnergy=options.fracture_energy, strengthScatter=.1, seed=options.seed,
        label='ceramic'))
    fe = FESolver(passes=options.passes)
    fe.addPolygon(rectangle((0, 0), BLOCK), size=options.size, material='ceramic',
                  fixed=lambda x, y: y < 1e-9)
    points = round(2 * math.pi * RADIUS / options.size)
    fe.addPolygon(circle((BLOCK[0] / 2, BLOCK[1] + RADIUS + 2e-5), RADIUS, points),
                  size=options.size, material='steel', smooth=True, velocity=(0, -options.speed))
    return fe


class Watch:
    """Mass, momentum and the record of the run; called after every step."""

    def __init__(self, fe, file):
        self.fe, self.start = fe, time.process_time()
        self.mass, self.segments = fe.masses.sum(), fe.numSegments
        self.record = recordFracture(fe, file) if file else None
        self.energy = fe.energy['total']  # J
        self.first = None  # step of the first crack

    def __call__(self):
        if self.first is None and self.fe.numCracks:
            self.first = O.iter
        if self.record and O.iter % EVERY == 0:
            self.record()

    def report(self):
        """Prints the results of cracking, and the time that it took."""
        fe = self.fe
        table = fragmentTable(fe)
        pieces = table[table['component'] == BRITTLE]
        share = pieces['area'] / pieces['area'].sum()
        back = table[table['component'] == CYLINDER]['vy'][0]
        first = 'none' if self.first is None else f'{1e6 * self.first * O.dt:.3f} µs'
        rows = [('surface segments', f'{self.segments:,} → {fe.numSegments:,}'),
                ('cracks', f'{fe.numCracks:,}'),
                ('first crack', first),
                ('fragments', f'{len(pieces):,}'),
                ('largest fragment', f'{share[0]:.1%} of the block'),
                ('of one triangle', f'{(pieces["triangles"] == 1).sum():,}'),
                ('mass', f'{fe.masses.sum() / self.mass - 1:+.1e} of it changed'),
                ('cylinder at the end', f'{back:+.2f} m/s'),
                ('dissipated by cracks', f'{fe.energy["fracture"] / self.energy:.2%}'),
                ('CPU time', f'{time.process_time() - self.start:.1f} s')]
        print('\n'.join(f'{name + ":":24}{value}' for name, value in rows))


def draw(film, stress, fragments, title, window, top):
    """Writes the stress at the last moments of a film, colours from 0 to `top`, MPa, and the fragments at the end."""
    import pictures
    pictures.frames(film, stress, title, columns=3, top=top, window=window, shots=film.shots[-6:],
                    cmap='afmhot_r', outline=.35, width=15)
    drawFragments(film.fe, film.shots[-1], fragments, title, window)


def drawFragments(fe, shot, file, title, window):
    """The fragments in colours, the largest of each body in grey."""
    import pictures
    from yadefrag.plots import fragmentColours
    of = fe.fragmentOf
    palette = np.array([pictures.matplotlib.colors.to_rgb(c) for c in COLOURS])
    colours = palette[fragmentColours(fe) % len(palette)]
    area = np.array([f['area'] for f in fe.fragments()])
    component = np.array([f['component'] for f in fe.fragments()])
    for body in np.unique(component):
        here = np.flatnonzero(component == body)
        colours[of == here[area[here].argmax()]] = pictures.matplotlib.colors.to_rgb(INTACT)
    (left, right), (low, high) = window
    figure, axis = pictures.plt.subplots(
        figsize=(13, 13 * (high - low) / (right - left) + .3), layout='constrained')
    axis.add_collection(pictures.PolyCollection(shot.corners, facecolors=colours,
                                                edgecolors='none', antialiaseds=False))
    axis.add_collection(pictures.LineCollection(shot.outlines, colors='k', linewidths=.5))
    axis.set(aspect='equal', xlim=(left, right), ylim=(low, high), xlabel='x, mm', ylabel='y, mm')
    axis.set_title(f'{title}: {(component == 0).sum():,} fragments after {1e6 * shot.time:.1f} µs', loc='left')
    figure.savefig(file, dpi=100)
    pictures.plt.close(figure)


def drawCourse(file, picture, title):
    """Surface segments, cracks and fragments over time, and the energies, from a record."""
    import pictures
    data = np.genfromtxt(file, delimiter=',', names=True, deletechars='')
    time = 1e6 * data['time_(s)']
    figure, axes = pictures.plt.subplots(2, 1, figsize=(9, 7.4), sharex=True, layout='constrained')
    for name, label, colour in (('segments', 'surface segments', 'k'),
                                ('cracks', 'cracks', '#d1495b'),
                                ('fragments', 'fragments', '#3d8fb5')):
        axes[0].plot(time, data[name], label=label, color=colour)
    axes[0].set_ylabel('number')
    for name, label, colour in (
            ('total', 'total', 'k'), ('kinetic', 'kinetic', '#3d8fb5'),
            ('strain', 'strain', '#edae49'), ('friction', 'dissipated by friction', '#8d6a9f'),
            ('contact', 'by contact', '#66a182'), ('fracture', 'by cracks', '#d1495b')):
        axes[1].plot(time, 1e-3 * data[f'{name}_(J)'], label=label, color=colour)
    axes[1].set(xlabel='time, µs', ylabel='energy, kJ per m')
    for axis in axes:
        axis.legend(ncol=6, frameon=False, loc='lower center', bbox_to_anchor=(.5, 1), fontsize=9)
        axis.spines[['top', 'right']].set_visible(False)
        axis.set_ylim(bottom=0)
    axes[1].set_xlim(0, time[-1])
    figure.suptitle(title, fontsize=12)
    figure.savefig(picture, dpi=110)
    pictures.plt.close(figure)


def arguments():
    """The options, checked."""
    parser = common.Options(__doc__, steps=4000)
    parser.set_defaults(out=OUT)
    parser.add_argument('--size', type=common.positive, default=5e-4,
                        help='of the triangles, m; default: %(default)s')
    parser.add_argument('--speed', type=common.positive, default=50.,
                        help='of the cylinder, m/s; default: %(default)s')
    parser.add_argument('--strength', type=common.positive, default=300e6,
                        help='tensile strength, Pa; default: %(default)s')
    parser.add_argument('--fracture-energy', type=common.notNegative, default=0., metavar='J/M²',
                        help='of the cracks; default: 0, they open at once, as in the paper')
    parser.add_argument('--seed', type=int, default=1, help='of the strengths; default: 1')
    options = parser.parse()
    if options.size > RADIUS / 2:
        parser.error(f'--size is {options.size:g} m, it must be at most {RADIUS / 2:g} m')
    return options


def main():
    options = arguments()
    fe = build(options)
    path = lambda name: os.path.join(options.out, name)  # noqa: E731
    watch = Watch(fe, None if options.no_pictures else path('course.csv'))
    shown = [round(share * options.steps) for share in SHARES]
    run, film = common.filmed(fe, options, 'mises', shown, every=EVERY, each=watch)
    print(f'Cylinder on a brittle block, {options.speed:g} m/s, size {options.size:g} m, '
          f'{options.fracture_energy:g} J/m², {options.collider}, passes={options.passes}')
    watch.report()
    run.report()
    if film:
        title = f'Steel cylinder on a brittle block, {options.speed:g} m/s'
        fragmentTable(fe, path('fragments.csv'))
        draw(film, path('impact.png'), path('impact_fragments.png'), title, CROP, TOP)
        drawCourse(path('course.csv'), path('impact_course.png'), title)
        if (np.bincount([f['component'] for f in fe.fragments()]) > 1).any():
            plotFragmentSizes(fe, path('impact_sizes.png'))
    common.tell(options, *FILES)
    return fe


fe = main()
