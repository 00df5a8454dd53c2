"""Pictures of the finite-element examples, in mm."""
import matplotlib
import numpy as np

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.colors import Normalize  # noqa: E402
from yade import O  # noqa: E402

FIELDS = dict(speed='speed, m/s', mises='von Mises stress, MPa')


class Shot:
    """The bodies at one moment: outlines and triangles (mm), a number for each triangle."""

    def __init__(self, fe, field):
        self.time = O.time
        nodes, triangles = 1e3 * fe.nodes, fe.triangles
        self.corners = nodes[triangles]
        self.values = values(fe, field, triangles)
        self.components = fe.components
        self.outlines = [nodes[np.append(loop, loop[0])] for loop in fe.surfaces]


class Film:
    """Shots of a run; call `film.take` at the moments of the pictures."""

    def __init__(self, fe, field):
        self.fe, self.field, self.shots = fe, field, []

    def take(self):
        self.shots.append(Shot(self.fe, self.field))


def values(fe, field, triangles):
    """(m) speed of the triangles (m/s), or von Mises stress from the in-plane components (MPa).

    Stresses are first averaged at the nodes: those of single linear triangles scatter.
    """
    if field == 'speed':
        return np.linalg.norm(fe.velocities[triangles].mean(axis=1), axis=1)
    xx, yy, xy = (averaged(triangles, part) for part in 1e-6 * fe.stress.T)
    return np.sqrt(xx**2 - xx * yy + yy**2 + 3 * xy**2)


def averaged(triangles, values):
    """(m) Values of the triangles, averaged at the nodes and then at each triangle's corners."""
    corners = triangles.ravel()
    count = np.bincount(corners)
    return (np.bincount(corners, np.repeat(values, 3)) / np.maximum(count, 1))[triangles].mean(axis=1)


def draw(axis, shot, norm, cmap='viridis', outline=.6):
    """Draws a shot; returns the mappable for a colour bar."""
    drawn = PolyCollection(shot.corners, array=shot.values, norm=norm, cmap=cmap,
                           edgecolors='none', antialiaseds=False)
    axis.add_collection(drawn)
    axis.add_collection(LineCollection(shot.outlines, colors='k', linewidths=outline))
    axis.set_aspect('equal')
    return drawn


def limits(shots, margin=.03):
    """((left, right), (bottom, top)) in mm around everything in the shots."""
    points = np.concatenate([np.concatenate(shot.outlines) for shot in shots])
    low, high = points.min(axis=0), points.max(axis=0)
    room = margin * (high - low).max()
    return (low[0] - room, high[0] + room), (low[1] - room, high[1] + room)


def frames(film, file, title, columns, top, unit='µs', window=None, width=13, shots=None, **style):
    """Shots (None: all) side by side, with one colour bar from 0 to `top`; writes `file`."""
    shots = shots or film.shots
    x, y = window or limits(shots)
    rows = -(-len(shots) // columns)
    height = ((width - 1.9) / columns * (y[1] - y[0]) / (x[1] - x[0]) + .3) * rows + .8
    figure, axes = plt.subplots(rows, columns, figsize=(width, height), sharex=True, sharey=True,
                                layout='constrained', squeeze=False)
    norm = Normalize(0, top)
    scale = {'µs': 1e6, 'ms': 1e3}[unit]
    digits = max(0, 2 - int(np.log10(max(1, scale * shots[-1].time))))
    for axis, shot in zip(axes.flat, shots):
        drawn = draw(axis, shot, norm, **style)
        axis.set(xlim=x, ylim=y)
        axis.set_title(f'{scale * shot.time:.{digits}f} {unit}', loc='left', fontsize=11)
    for axis in list(axes.flat)[len(shots):]:
        axis.set_visible(False)
    for axis in axes[-1]:
        axis.set_xlabel('x, mm')
    for axis in axes[:, 0]:
        axis.set_ylabel('y, mm')
    figure.colorbar(drawn, ax=axes, label=FIELDS[film.field], shrink=.8, pad=.01, extend='max')
    figure.suptitle(title, fontsize=13)
    figure.savefig(file, dpi=100)
    plt.close(figure)


def animation(film, file, top, window=None, rate=12, width=4.6, dpi=75, **style):
    """Shots one after the other; writes `file`, a GIF."""
    from matplotlib.animation import PillowWriter
    x, y = window or limits(film.shots)
    height = width * (y[1] - y[0]) / (x[1] - x[0]) + .9
    figure, axis = plt.subplots(figsize=(width, height), layout='constrained')
    writer, norm = PillowWriter(fps=rate), Normalize(0, top)
    with writer.saving(figure, file, dpi=dpi):
        for shot in film.shots:
            axis.clear()
            draw(axis, shot, norm, **style)
            axis.set(xlim=x, ylim=y, xlabel='x, mm', ylabel='y, mm')
            axis.set_title(f'{1e6 * shot.time:5.2f} µs', loc='left', fontsize=10)
            writer.grab_frame()
    plt.close(figure)
