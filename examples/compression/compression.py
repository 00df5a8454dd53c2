"""Blocks of rock are compressed until they break, compared with the Mohr–Coulomb law.

    scripts/yade -n -x examples/compression/compression.py [--size 8e-4] [--pressures 0 2.5 5]
        [--held] [--scatter .1] [--fracture-energy 10] [--seed 1] [--out FOLDER] [--no-pictures]

A block of 20 × 40 mm, E 20 GPa, tensile strength 5 MPa, cohesion three times that, friction angle
0.6 rad, between platens on which the ends slide without friction (--held: the ends are held), under
lateral pressures in MPa. Theory: 2c cos φ/(1 − sin φ) + σ₃(1 + sin φ)/(1 − sin φ). A run ends when the
load falls to half of its peak, or at 1.25 times the shortening at failure. Writes compression.png
(compression_held.png): stress at the peak, fragments after it, and the load over the shortening.
"""
import math
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [HERE, os.path.join(HERE, '..')]
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import BrittleFEMat, FESolver  # noqa: E402
from yadefrag import rectangle  # noqa: E402

WIDE, HIGH = 20e-3, 40e-3  # m
YOUNG, POISSON, DENSITY, STRENGTH, SHEAR, FRICTION = 20e9, .2, 2500, 5e6, 3, .6
PLANE_YOUNG, PLANE_POISSON = YOUNG / (1 - POISSON**2), POISSON / (1 - POISSON)
CROSSINGS = 60  # of a wave, until the elastic block fails
LONGEST = 1.25
FILE, HELD_FILE = 'compression.png', 'compression_held.png'


def theory(pressure):
    """(Pa) Mohr–Coulomb law."""
    s = math.sin(FRICTION)
    return (2 * SHEAR * STRENGTH * math.cos(FRICTION) + pressure * (1 + s)) / (1 - s)


class Block:
    """One block, from the uniform lateral pressure (Pa) to its end."""

    def __init__(self, options, pressure):
        O.reset()
        self.pressure, self.failure = pressure, theory(pressure)
        self.strain = (self.failure - pressure) / PLANE_YOUNG  # at failure
        wave = math.sqrt(YOUNG / DENSITY)
        self.rate = self.strain / (CROSSINGS * HIGH / wave)  # 1/s
        self.fe = self.build(options)
        self.fe.damping = .2 * wave / HIGH
        common.setEngines(self.fe, options.collider)
        self.shortening, self.load, self.atPeak, self.peak = [0.], [pressure], None, 0.
        self.run(options)

    def build(self, options):
        O.materials.append(BrittleFEMat(
            young=YOUNG, poisson=POISSON, density=DENSITY, frictionAngle=FRICTION,
            tensileStrength=STRENGTH, shearFactor=SHEAR, fractureEnergy=options.fracture_energy,
            strengthScatter=options.scatter, seed=options.seed))
        fe = FESolver(passes=options.passes)
        squeezed = (1 - PLANE_POISSON) * self.pressure / PLANE_YOUNG
        fe.addPolygon(
            rectangle((0, 0), (WIDE, HIGH)), size=options.size, material=0, meshSeed=options.seed,
            displacement=lambda x, y: (squeezed * (WIDE / 2 - x), squeezed * (HIGH / 2 - y)),
            velocity=lambda x, y: (PLANE_POISSON * self.rate * (x - WIDE / 2),
                                   -self.rate * (y - HIGH / 2)))
        low, high = fe.nodes[:, 1].min(), fe.nodes[:, 1].max()
        aside = dict(vx=0) if options.held else {}
        fe.prescribe(lambda x, y: y < low + 1e-9, vy=self.rate * HIGH / 2, **aside)
        fe.prescribe(lambda x, y: y > high - 1e-9, vy=-self.rate * HIGH / 2, **aside)
        if self.pressure > 0:
            fe.loads = self.lateral(fe)
        return fe

    def lateral(self, fe):
        """(n, 2) Nodal forces of the pressure on both sides (N)."""
        loads, nodes = np.zeros((len(fe.nodes), 2)), fe.nodes
        for loop in fe.surfaces:
            after = np.roll(loop, -1)
            along = nodes[after] - nodes[loop]
            isSide = abs(along[:, 0]) < 1e-9
            for end in (loop, after):
                np.add.at(loads[:, 0], end[isSide], -self.pressure / 2 * along[isSide, 1])
        return loads

    def platensWork(self):
        """(J) All external work except that of the lateral pressure."""
        work = self.fe.energy['external']
        return work - (self.fe.loads * self.fe.nodes).sum() if self.pressure > 0 else work

    def run(self, options):
        every = max(1, round(HIGH / math.sqrt(YOUNG / DENSITY) / O.dt / 4))
        work, start = self.platensWork(), self.fe.energy['total']
        for _ in range(options.steps // every):
            O.run(every, True)
            now = self.platensWork()
            self.load.append((now - work) / (self.rate * HIGH * every * O.dt) / WIDE)
            work = now
            self.shortening.append(self.rate * O.time)
            if self.load[-1] > self.peak and not options.no_pictures:
                self.atPeak = shot(self.fe)
            self.peak = max(self.peak, self.load[-1])
            if self.shortening[-1] > LONGEST * self.strain:
                break
            if self.fe.numCracks and self.load[-1] < .5 * self.peak:
                break
        self.drift = self.fe.energy['total'] - start

    def keep(self):
        """Stores the data for the pictures: the next block resets the scene."""
        fe = self.fe
        nodes = 1e3 * fe.nodes
        self.after = (nodes[fe.triangles], pieceColours(fe),
                      [nodes[np.append(loop, loop[0])] for loop in fe.surfaces])

    def report(self):
        fe = self.fe
        external = self.fe.energy['external']
        return (f'| {1e-6 * self.pressure:21g} | {1e-6 * self.failure:6.2f} | {1e-6 * self.peak:5.2f}'
                f' | {self.peak / self.failure:11.4f} | {self.load[-1] / self.peak:9.2f}'
                f' | {fe.numCracks:6} | {len(fe.fragments()):6} | {self.drift / external:+8.1e} |')


def shot(fe):
    """(m, 3, 2) corners in mm, (m) axial pressure in MPa, averaged at the nodes."""
    import pictures
    return 1e3 * fe.nodes[fe.triangles], pictures.averaged(fe.triangles, -1e-6 * fe.stress[:, 1])


def pieceColours(fe):
    """(m, 3) Colours of the fragments; the largest is grey."""
    import pictures
    from yadefrag.plots import fragmentColours
    palette = np.array([pictures.matplotlib.colors.to_rgb(c) for c in
                        ('#8ecae6', '#ffb703', '#90be6d', '#f28482', '#b8a1d9', '#e9c46a')])
    colours = palette[fragmentColours(fe) % len(palette)]
    largest = np.argmax([piece['area'] for piece in fe.fragments()])
    colours[fe.fragmentOf == largest] = pictures.matplotlib.colors.to_rgb('#e4e1da')
    return colours


def drawColumn(block, axes, norm):
    """Draws a block's pictures; returns the mappable for a colour bar."""
    import pictures
    corners, stress = block.atPeak
    drawn = axes[0].add_collection(pictures.PolyCollection(
        corners, array=stress, edgecolors='face', linewidths=.1, cmap='viridis', norm=norm))
    corners, colours, outlines = block.after
    axes[1].add_collection(pictures.PolyCollection(corners, facecolors=colours, edgecolors='face',
                                                   linewidths=.1))
    axes[1].add_collection(pictures.LineCollection(outlines, colors='k', linewidths=.6))
    axes[0].set_title(f'σ₃ = {1e-6 * block.pressure:g} MPa: peak, {1e-6 * block.peak:.1f} MPa',
                      fontsize=10)
    axes[1].set_title(f'pieces, at {1e-6 * block.load[-1]:.1f} MPa', fontsize=10)
    for axis in axes:
        axis.set(aspect='equal', xlim=(-3, 23), ylim=(-.5, 40.5), xlabel='mm')
    return drawn


def picture(blocks, file):
    import pictures
    columns = 2 * len(blocks)
    figure = pictures.plt.figure(figsize=(2.9 * columns + 1, 8.6), layout='constrained')
    grid = figure.add_gridspec(2, columns, height_ratios=(5, 3))
    top = 1.15e-6 * max(block.failure for block in blocks)
    norm, panels = pictures.Normalize(0, top), []
    for i, block in enumerate(blocks):
        axes = [figure.add_subplot(grid[0, 2 * i + k]) for k in (0, 1)]
        drawn = drawColumn(block, axes, norm)
        panels += axes
    figure.colorbar(drawn, ax=panels, label='axial pressure, MPa', shrink=.8, pad=.01)
    curves = figure.add_subplot(grid[1, :])
    for block in blocks:
        line, = curves.plot(1e3 * np.array(block.shortening), 1e-6 * np.array(block.load),
                            label=f'σ₃ = {1e-6 * block.pressure:g} MPa')
        curves.axhline(1e-6 * block.failure, color=line.get_color(), linewidth=.7, linestyle='--')
    curves.set(xlabel='shortening, mm per m', ylabel='load, MPa', ylim=(0, None))
    curves.legend(title='dashed: Mohr–Coulomb', loc='lower right')
    figure.savefig(file, dpi=90)
    pictures.plt.close(figure)


def parse():
    parser = common.Options(__doc__, 60000)
    parser.add_argument('--size', default=8e-4, type=common.number(
        lambda value: 2e-4 <= value <= 5e-3, 'from 0.0002 to 0.005 m'),
        help='m, of the triangles; default: %(default)s')
    parser.add_argument('--pressures', type=common.notNegative, nargs='+', default=[0, 2.5, 5],
                        metavar='MPA', help='lateral; default: 0 2.5 5')
    parser.add_argument('--held', action='store_true', help='the platens hold the ends sideways')
    parser.add_argument('--scatter', default=.1, type=common.number(
        lambda value: 0 <= value < 1, 'at least 0 and below 1'), help='of the strengths, ±; default: %(default)s')
    parser.add_argument('--fracture-energy', type=common.notNegative, default=10, metavar='J/M²',
                        help='default: %(default)s')
    parser.add_argument('--seed', type=common.wholeNumber, default=1,
                        help='of the mesh and the strengths; default: %(default)s')
    return parser.parse()


def main():
    options = parse()
    blocks = []
    print('| lateral pressure, MPa | theory | peak  | peak/theory | last/peak | cracks | pieces | drift    |')
    print('|--:|--:|--:|--:|--:|--:|--:|--:|')
    for pressure in options.pressures:
        blocks.append(Block(options, 1e6 * pressure))
        print(blocks[-1].report(), flush=True)
        if not options.no_pictures:
            blocks[-1].keep()
    if not options.no_pictures:
        file = HELD_FILE if options.held else FILE
        picture(blocks, os.path.join(options.out, file))
        common.tell(options, file)


main()
