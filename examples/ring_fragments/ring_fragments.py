"""Expanding ceramic rings break: size of the fragments over the strain rate.

    scripts/yade -n -x examples/ring_fragments/ring_fragments.py [--seeds 3] [--rates 1e3 1e4 1e5]
        [--moduli 0 50 20] [--out FOLDER] [--no-pictures]

Thin rings of 50 mm circumference, E 275 GPa, 2750 kg/m³, strength 300 MPa, fracture energy
100 J/m², in plane stress without lateral strain, start just below their strength with a uniform
radial speed. The mean size of the fragments is compared with the result of Zhou, Molinari and Ramesh
2006 (Appl. Phys. Lett. 88, 261917) for a ring in one dimension without scatter,
s/s0 = 4.5 / (1 + 0.77 r^0.25 + 5.4 r^0.75), s0 = E Gc/σ², r = rate · E² Gc/(c σ³). A Weibull
modulus of 0 means a scatter of ±10⁻⁴ only. Writes ring_sizes.png (sizes over rates) and
ring_pieces.png (the fragments of the first seed along the ring, unrolled).
"""
import argparse
import math
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [HERE, os.path.join(HERE, '..')]
import common  # noqa: E402
from yade import O  # noqa: E402
from yade.wrapper import BrittleFEMat, FESolver  # noqa: E402

YOUNG, DENSITY, STRENGTH, ENERGY = 275e9, 2750, 300e6, 100  # Pa, kg/m³, Pa, J/m²
CIRCUMFERENCE = 50e-3  # m
RADIUS = CIRCUMFERENCE / (2 * math.pi)
FILES = ('ring_sizes.png', 'ring_pieces.png')


def theory(rate):
    """(m) The mean size of a fragment at a strain rate (1/s)."""
    wave = math.sqrt(YOUNG / DENSITY)
    r = rate * YOUNG**2 * ENERGY / (wave * STRENGTH**3)
    return 4.5 * YOUNG * ENERGY / STRENGTH**2 / (1 + .77 * r**.25 + 5.4 * r**.75)


def cellsFor(rate):
    """Number of square cells: five for each expected fragment, and three for E Gc/σ²."""
    return max(500, 50 * round(5 * CIRCUMFERENCE / theory(rate) / 50))


def ringMesh(cells):
    """(nodes, triangles) of square cells, each divided into four triangles around its middle: with two, the
    light ends of radial edges open first, and the ring unfolds in a zigzag."""
    angles = 2 * math.pi * np.arange(cells) / cells
    around = lambda angle, radius: radius * np.stack([np.cos(angle), np.sin(angle)], 1)  # noqa: E731
    width = CIRCUMFERENCE / cells
    nodes = np.concatenate([around(angles, RADIUS - width / 2), around(angles, RADIUS + width / 2),
                            around(angles + math.pi / cells, RADIUS * math.cos(math.pi / cells))])
    inner, outer, middle = np.arange(3 * cells).reshape(3, cells)
    corners = [inner, outer, np.roll(outer, -1), np.roll(inner, -1)]
    triangles = [np.stack([a, b, middle], 1) for a, b in zip(corners, corners[1:] + corners[:1])]
    return nodes, np.stack(triangles, 1).reshape(-1, 3)


def outward(x, y):
    return np.array([x, y]) / math.hypot(x, y)


class Ring:
    """One ring from its start until no further edge breaks."""

    def __init__(self, rate, modulus, seed):
        O.reset()
        cells = cellsFor(rate)
        O.materials.append(BrittleFEMat(
            young=YOUNG, poisson=0, density=DENSITY, planeStress=True, frictionAngle=0,
            tensileStrength=STRENGTH, fractureEnergy=ENERGY, weibullModulus=modulus, seed=seed,
            strengthScatter=0 if modulus else 1e-4))
        # Just below the probable strength of the weakest radial edge.
        start = .98 * STRENGTH * (cells**(-1 / modulus) if modulus else 1)
        stretch = start / YOUNG * RADIUS
        self.fe = fe = FESolver()
        nodes, triangles = ringMesh(cells)
        fe.addTriangles(
            nodes, triangles, material=0,
            displacement=lambda x, y: stretch * outward(x, y),
            velocity=lambda x, y: rate * RADIUS * outward(x, y))
        O.engines = [fe]
        O.dt = .4 * fe.criticalTimeStep()
        O.step()
        before = fe.energy['total']
        # Until no edge breaks any more; the strongest edges are reached that much later.
        duration = 2.5e-6 * (1e3 / rate)**.4 + 2 * (1.1 * STRENGTH - start) / YOUNG / rate
        O.run(math.ceil(duration / O.dt), True)
        self.drift = fe.energy['total'] / before - 1
        self.pieces = fe.fragments(held=True)
        self.spent = fe.energy['fracture']

    def size(self):
        """(m) The mean length of a fragment."""
        return CIRCUMFERENCE / len(self.pieces)

    def arcs(self):
        """(k, 2) begin and length of the fragments along the ring (m), in order."""
        mass = np.array([piece['mass'] for piece in self.pieces])
        at = np.array([math.atan2(*piece['centroid'][::-1]) for piece in self.pieces])
        order = np.argsort(at)
        lengths = CIRCUMFERENCE * mass[order] / mass.sum()
        begin = RADIUS * at[order[0]] - lengths[0] / 2
        return np.stack([begin + np.cumsum(lengths) - lengths, lengths], 1)


def run(options):
    """Dict (modulus, rate) → (sizes of all seeds, m; the first ring's arcs)."""
    found = {}
    print('| Weibull modulus | strain rate, 1/s | fragments | mean size, mm   | theory, mm | ratio |'
          ' energy drift |')
    print('|--:|--:|--:|--:|--:|--:|--:|')
    for modulus in options.moduli:
        for rate in options.rates:
            rings = [Ring(rate, modulus, seed) for seed in range(1, options.seeds + 1)]
            sizes = np.array([ring.size() for ring in rings])
            found[modulus, rate] = sizes, rings[0].arcs()
            print(f'| {modulus or "none":>15} | {rate:16g} | {np.mean(CIRCUMFERENCE / sizes):9.1f}'
                  f' | {1e3 * sizes.mean():.4f} ± {1e3 * sizes.std():.4f}'
                  f' | {1e3 * theory(rate):10.4f} | {sizes.mean() / theory(rate):5.3f}'
                  f' | {max((ring.drift for ring in rings), key=abs):+12.1e} |', flush=True)
    return found


def name(modulus):
    return f'Weibull, m = {modulus:g}' if modulus else 'no scatter (±10⁻⁴)'


def drawSizes(found, options, file):
    import pictures
    figure, axis = pictures.plt.subplots(figsize=(7, 5), layout='constrained')
    rates = np.geomspace(min(options.rates) / 3, max(options.rates) * 3, 100)
    axis.plot(rates, [1e3 * theory(rate) for rate in rates], 'k-', linewidth=1,
              label='Zhou, Molinari and Ramesh 2006')
    for modulus, marker in zip(options.moduli, 'osD^v'):
        sizes = 1e3 * np.array([found[modulus, rate][0] for rate in options.rates])
        mean = sizes.mean(axis=1)
        spread = np.abs(np.stack([sizes.min(axis=1), sizes.max(axis=1)]) - mean)
        axis.errorbar(options.rates, mean, spread, fmt=marker, capsize=3, label=name(modulus))
    axis.set(xscale='log', yscale='log', xlabel='strain rate, 1/s',
             ylabel='mean size of the fragments, mm')
    axis.grid(True, which='both', linewidth=.3)
    axis.legend()
    figure.savefig(file, dpi=150)


def drawPieces(found, options, file):
    import pictures
    rows = [(modulus, rate) for modulus in options.moduli for rate in options.rates]
    figure, axis = pictures.plt.subplots(figsize=(9, .6 + .35 * len(rows)), layout='constrained')
    for height, key in enumerate(rows):
        arcs = 1e3 * found[key][1]
        whole = 1e3 * CIRCUMFERENCE
        colours = np.where(np.arange(len(arcs)) % 2, '#d8b365', '#5ab4ac')
        for shift in (-whole, 0, whole):  # a fragment may extend over the end of the strip
            axis.broken_barh(arcs + [shift, 0], (height - .38, .76), facecolors=colours)
    axis.set(xlim=(0, whole), ylim=(len(rows) - .5, -.5), xlabel='along the ring, mm',
             yticks=range(len(rows)),
             yticklabels=[f'{name(modulus)}, {rate:g}/s' for modulus, rate in rows])
    figure.savefig(file, dpi=150)


def arguments():
    """The options, checked."""
    parser = argparse.ArgumentParser(prog=os.path.basename(sys.argv[0]),
                                     description=__doc__.split('\n')[0])
    parser.add_argument('--seeds', type=common.wholeNumber, default=3,
                        help='rings of each kind; default: 3')
    # At these rates the mesh is fine enough and the ring breaks.
    rate = common.number(lambda value: 500 <= value <= 2e5, 'from 500 to 200,000 per second')
    parser.add_argument('--rates', type=rate, nargs='+', default=[1e3, 1e4, 1e5], metavar='1/S',
                        help='of strain; default: 1e3 1e4 1e5')
    parser.add_argument('--moduli', type=common.notNegative, nargs='+', default=[0, 50, 20],
                        metavar='M', help='of Weibull, 0: no scatter; default: 0 50 20')
    parser.add_argument('--out', default=HERE, metavar='FOLDER',
                        help='for the pictures; default: next to the script')
    parser.add_argument('--no-pictures', action='store_true')
    options = parser.parse_args(sys.argv[1:])
    if not options.no_pictures:
        common.makeFolder(parser, options.out)
    return options


def main():
    options = arguments()
    found = run(options)
    if not options.no_pictures:
        drawSizes(found, options, os.path.join(options.out, FILES[0]))
        drawPieces(found, options, os.path.join(options.out, FILES[1]))
    common.tell(options, *FILES)
    return found


found = main()
