"""A steel cylinder hits a ceramic block that is held at its bottom.

    scripts/yade -n -x examples/cylinder/cylinder.py [--size 5e-4] [--steps 500] [--vtk FILE] …

The impact of Diekmann et al., ECCOMAS 2000, §6, figure 15, without cracks: both bodies stay
elastic. Steel cylinder of 10 mm with a smooth surface at 200 m/s, block of 40 × 20 mm. All in SI
units, plane strain, per metre of thickness. Writes cylinder.png (stress at several instants),
cylinder_force.png (force and energies over time), with --gif cylinder.gif, with --vtk a file for
ParaView (.vtu) of the last step.
"""
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import FEMat, FESolver  # noqa: E402
from yadefrag import circle, exportVTK, rectangle  # noqa: E402

RADIUS, BLOCK, SPEED = 5e-3, (40e-3, 20e-3), 200.  # m, m, m/s
FRAMES = 48  # of the animation, besides the first
TOP = 6000  # MPa, of the colours
CROP = ((-.5, 40.5), (-.5, 32.))  # mm


def build(size, passes):
    """Block (body 0) and cylinder (body 1); returns the solver."""
    O.materials.append(FEMat(young=210e9, poisson=.3, density=7800, frictionAngle=0, label='steel'))
    O.materials.append(FEMat(young=370e9, poisson=.22, density=3900, frictionAngle=.3,
                             label='ceramic'))
    fe = FESolver(passes=passes)
    fe.addPolygon(rectangle((0, 0), BLOCK), size=size, material='ceramic',
                  fixed=lambda x, y: y < 1e-9)
    points = round(2 * math.pi * RADIUS / size)
    fe.addPolygon(circle((BLOCK[0] / 2, BLOCK[1] + RADIUS + 1e-4), RADIUS, points), size=size,
                  material='steel', smooth=True, velocity=(0, -SPEED))
    return fe


class Watch:
    """Force on the cylinder after every step."""

    def __init__(self, fe):
        self.fe = fe
        self.nodes = np.unique(fe.triangles[fe.components == 1])
        self.times, self.forces = [], []

    def __call__(self):
        self.times.append(O.time)
        self.forces.append(self.fe.contactForces[self.nodes, 1].sum())

    def report(self):
        """Prints the force, the duration of contact, and the rebound of the cylinder."""
        times, forces = np.array(self.times), np.array(self.forces)
        mass = self.fe.fragments()[1]['mass']
        back = self.fe.fragments()[1]['velocity'][1]
        impulse = forces.sum() * O.dt / (mass * (SPEED + back))
        touching = times[forces > 0]
        print(f'largest force:          {1e-6 * forces.max():.3f} MN at '
              f'{1e6 * times[forces.argmax()]:.3f} µs')
        if len(touching):
            print(f'contact:                from {1e6 * touching[0]:.3f} to '
                  f'{1e6 * touching[-1]:.3f} µs')
        print(f'cylinder at the end:    {back:+.2f} m/s; impulse / change of momentum '
              f'{impulse:.6f}')


def curves(watch, run, file):
    """Force and energies over time."""
    import pictures
    figure, axes = pictures.plt.subplots(2, 1, figsize=(8, 6.4), sharex=True, layout='constrained')
    axes[0].plot(1e6 * np.array(watch.times), 1e-6 * np.array(watch.forces), color='#d1495b', lw=1)
    axes[0].set_ylabel('force on the cylinder, MN per m')
    for name, colour in (('total', 'k'), ('kinetic', '#3d8fb5'), ('strain', '#edae49'),
                         ('contact', '#66a182')):
        label = 'dissipated by contact' if name == 'contact' else name
        axes[1].plot(1e6 * run.series('time'), 1e-3 * run.series(name), label=label, color=colour)
    axes[1].set(xlabel='time, µs', ylabel='energy, kJ per m')
    axes[1].legend(ncol=4, frameon=False, loc='lower center', bbox_to_anchor=(.5, 1))
    for axis in axes:
        axis.spines[['top', 'right']].set_visible(False)
        axis.set_ylim(bottom=0)
    axes[1].set_xlim(0, 1e6 * O.time)
    figure.suptitle(f'Steel cylinder on a ceramic block, {SPEED:g} m/s', fontsize=12)
    figure.savefig(file, dpi=110)
    pictures.plt.close(figure)


def main():
    parser = common.Options(__doc__, steps=500)
    parser.add_argument('--size', type=common.positive, default=5e-4,
                        help='of the triangles, m; default: 5e-4')
    parser.add_argument('--gif', action='store_true', help='write cylinder.gif, too')
    parser.add_argument('--vtk', metavar='FILE', help='write the last state for ParaView (.vtu)')
    options = parser.parse()
    if options.size > RADIUS / 2:
        parser.error(f'--size is {options.size:g} m, it must be at most {RADIUS / 2:g} m')
    if options.vtk and not options.vtk.endswith('.vtu'):
        parser.error(f"--vtk is {options.vtk!r}, its name must end with '.vtu'")
    fe = build(options.size, options.passes)
    watch = Watch(fe)
    run, film = common.filmed(fe, options, 'mises', FRAMES, every=5, each=watch)
    print(f'Cylinder on block, size {options.size:g} m, {options.collider}, '
          f'passes={options.passes}')
    watch.report()
    run.report()
    if film:
        draw(options, film, watch, run)
    if options.vtk:
        exportVTK(fe, options.vtk)
    common.tell(options, 'cylinder.png', 'cylinder_force.png')
    return fe


def draw(options, film, watch, run):
    """Writes the pictures."""
    import pictures
    title = f'Steel cylinder on a ceramic block, {SPEED:g} m/s'
    shots = [film.shots[round(k * (len(film.shots) - 1) / FRAMES)] for k in (4, 10, 16, 24, 32, 44)]
    pictures.frames(film, os.path.join(options.out, 'cylinder.png'), title, columns=3, top=TOP,
                    window=CROP, shots=shots, cmap='inferno', outline=.8)
    curves(watch, run, os.path.join(options.out, 'cylinder_force.png'))
    if options.gif:
        pictures.animation(film, os.path.join(options.out, 'cylinder.gif'), TOP, window=CROP,
                           cmap='inferno', outline=.8)


fe = main()
