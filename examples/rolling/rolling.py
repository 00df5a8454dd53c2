"""A cylinder rolls over a straight edge: contact force with smooth and with straight surfaces.

    scripts/yade -n -x examples/rolling/rolling.py [--segments 64] [--block .25] [--passes 2] …

A rubber cylinder (E 200 MPa, radius 10 mm) is pressed by gravity (2000 m/s²) onto a flat block and
rolls at 0.25 m/s without slipping. A polygon of N sides falls onto its sides and is lifted over its
corners, so that the force changes with each segment; with the smooth surface of the same nodes it
changes less. The difference depends on the block's segments and on the passes (README.md).
Mass-proportional damping removes the first bounce, and a force along the block compensates its effect
on the motion. Prints the ripple (max − min) / mean of the vertical force, and its standard deviation.
All in SI units, plane strain, per metre of thickness. Writes rolling.png.
"""
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import FEMat, FESolver  # noqa: E402
from yadefrag import circle, rectangle  # noqa: E402

RADIUS, SPEED, GRAVITY = 10e-3, .25, 2000.  # m, m/s, m/s²
DAMPING = 3000.  # 1/s
SETTLING, SEGMENTS = 4e-3, 6  # s before the measurement; its length in segments


def build(segments, block, passes, smooth):
    """Block (body 0) and cylinder (body 1); returns the solver."""
    O.reset()
    O.materials.append(FEMat(young=200e6, poisson=.3, density=1000, frictionAngle=math.atan(.6),
                             label='m'))
    # Damping reduces the translation by α·m·v, and by α·m·v/2 through the spin.
    fe = FESolver(passes=passes, damping=DAMPING, gravity=(1.5 * DAMPING * SPEED, -GRAVITY, 0))
    segment = 2 * math.pi * RADIUS / segments
    far = SPEED * SETTLING + SEGMENTS * segment
    fe.addPolygon(rectangle((-4e-3, -5e-3), (far + 5e-3, 0)), size=block * segment, material='m',
                  fixed=lambda x, y: y < -4.999e-3, selfContact=False)
    fe.addPolygon(circle((0, RADIUS), RADIUS, segments), size=1.01 * segment, material='m',
                  smooth=smooth, velocity=(SPEED, 0), spin=-SPEED / RADIUS, selfContact=False)
    return fe


def roll(options, smooth, film=None):
    """(angle in segments, vertical force in N) of the measured part, and the report."""
    fe = build(options.segments, options.block, options.passes, smooth)
    common.setEngines(fe, options.collider)
    segment = 2 * math.pi * RADIUS / options.segments
    steps = math.ceil((SETTLING + SEGMENTS * segment / SPEED) / O.dt)
    steps = min(steps, options.steps)
    nodes = np.unique(fe.triangles[fe.components == 1])
    times, forces = [], []

    def each():
        times.append(O.time)
        forces.append(fe.contactForces[nodes, 1].sum())

    run = common.Run(fe).go(steps, each=each)
    print(f'{"Smooth" if smooth else "Straight"} cylinder of {options.segments} segments, '
          f'{options.collider}, passes={options.passes}')
    speed = fe.fragments()[1]['velocity'][0]
    spin = fe.fragments()[1]['spin']
    weight = fe.fragments()[1]['mass'] * GRAVITY
    times, forces = np.array(times), np.array(forces)
    part = times > min(SETTLING, times[-1] / 2)
    times, forces = times[part], forces[part]
    print(f'rolls at:               {speed:.4f} m/s, radius × spin {-spin * RADIUS:.4f} m/s')
    print(f'mean force / weight:    {forces.mean() / weight:.4f}')
    print(f'ripple:                 {np.ptp(forces) / forces.mean():.4f} of the mean, standard '
          f'deviation {forces.std() / forces.mean():.4f}')
    run.report()
    if film is not None:
        import pictures
        film.append(pictures.Shot(fe, 'mises'))
    return (times - times[0]) * SPEED / segment, forces / weight, run.interrupted


def draw(file, options, results, shot):
    """The force over the angle, and the cylinder at the end."""
    import pictures
    figure, axes = pictures.plt.subplots(1, 2, figsize=(12, 4.4), layout='constrained',
                                         width_ratios=(1.5, 1))
    for (name, colour), (way, force, _) in zip((('straight', '#d1495b'), ('smooth', '#3d8fb5')),
                                               results):
        axes[0].plot(way, force, color=colour, lw=1,
                     label=f'{name}: ripple {np.ptp(force) / force.mean():.1%}')
    axes[0].set(xlabel='rolling distance, segments', ylabel='vertical contact force / weight')
    axes[0].legend(frameon=False, loc='lower center', bbox_to_anchor=(.5, 1), ncol=2)
    axes[0].spines[['top', 'right']].set_visible(False)
    top = np.percentile(shot.values, 99.8)
    drawn = pictures.draw(axes[1], shot, pictures.Normalize(0, top), outline=.8)
    axes[1].autoscale()
    axes[1].set(xlabel='x, mm', ylabel='y, mm')
    figure.colorbar(drawn, ax=axes[1], label=pictures.FIELDS['mises'], extend='max', shrink=.8)
    figure.suptitle(f'A cylinder of {options.segments} segments rolls over a straight edge, '
                    f'passes={options.passes}',
                    fontsize=12)
    figure.savefig(file, dpi=100)
    pictures.plt.close(figure)


def main():
    parser = common.Options(__doc__, steps=10**6)
    parser.add_argument('--segments', type=common.atLeast(24), default=64,
                        help='around the cylinder; default: 64')
    parser.add_argument('--block', type=common.positive, default=.25,
                        help="the block's segments, in those of the cylinder; default: 0.25")
    parser.set_defaults(passes=2)
    options = parser.parse()
    shots = None if options.no_pictures else []
    results = []
    for smooth in (False, True):
        results.append(roll(options, smooth, shots))
        if results[-1][-1]:
            return
    ripples = [np.ptp(force) / force.mean() for _, force, _ in results]
    for name, ripple, (_, force, _) in zip(('straight', 'smooth'), ripples, results):
        print(f'{"ripple, " + name + ":":24}{ripple:.1%}, standard deviation {force.std() / force.mean():.1%}')
    print(f'straight / smooth:      {ripples[0] / ripples[1]:.2f}')
    if shots:
        draw(os.path.join(options.out, 'rolling.png'), options, results, shots[-1])
    common.tell(options, 'rolling.png')


main()
