"""The pictures of the impact example."""
import numpy as np
import pictures
from yadefrag.plots import fragmentColours

INTACT = '#e4e1da'  # the largest fragment of a body
COLOURS = ('#8ecae6', '#ffb703', '#90be6d', '#f28482', '#b8a1d9', '#e9c46a', '#5f9ea0', '#d4a373')


def draw(film, stress, fragments, title, window, top):
    """Writes the stress at the last moments of a film, colours from 0 to `top`, MPa, and the fragments at the end."""
    pictures.frames(film, stress, title, columns=3, top=top, window=window, shots=film.shots[-6:],
                    cmap='afmhot_r', outline=.35, width=15)
    drawFragments(film.fe, film.shots[-1], fragments, title, window)


def drawFragments(fe, shot, file, title, window):
    """The fragments in colours, the largest of each body in grey."""
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


def course(file, picture, title):
    """Surface segments, cracks and fragments over time, and the energies, from a record."""
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
