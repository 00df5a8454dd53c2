"""The pictures of the spheres example."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.colors import LogNorm

NAMES = {'YADE': "YADE's engines", 'collider': 'LebesgueCollider', 'yadefrag': "yadefrag's engines"}
COLOURS = {'collider': '#d1495b', 'loop': '#3d8fb5', 'integrator': '#8fb996', 'rest': '#cccccc'}


def frames(result, times, file):
    """Frames side by side: a section through the bed, spheres coloured by speed (m/s)."""
    shots = result['snapshots']
    half = 1e2 * np.abs(shots[0]['x'][:, 0]).max() * 1.03
    top = 1e2 * np.sort(shots[-1]['x'][:, 2])[-10] + 2
    figure, axes = plt.subplots(2, -(-len(shots) // 2), figsize=(13, 7.6), sharex=True, sharey=True,
                                layout='constrained')
    norm = LogNorm(.05, 80)
    for axis, shot, when in zip(axes.flat, shots, times):
        spheres = _cut(axis, shot, norm)
        axis.set_title(f'{1e3 * when:.1f} ms', loc='left', fontsize=11)
        axis.set_xlim(-half, half)
        axis.set_ylim(0, top)
        axis.set_aspect('equal')
        axis.set_facecolor('#f4f4f4')
    for axis in axes[-1]:
        axis.set_xlabel('x, cm')
    for axis in axes[:, 0]:
        axis.set_ylabel('z, cm')
    figure.colorbar(spheres, ax=axes, label='speed, m/s', shrink=.8, pad=.01, extend='both',
                    ticks=[.1, 1, 10], format='%g')
    figure.suptitle(f'Steel ball into {len(shots[0]["x"]) - 1:,} spheres, cut at y = 0', fontsize=13)
    figure.savefig(file, dpi=100)
    plt.close(figure)


def _cut(axis, shot, norm):
    """Draw the spheres behind the plane y = 0, the nearest last."""
    x, radii = shot['x'], shot['radii']
    order = np.flatnonzero((x[:, 1] > -radii * .5) & (x[:, 1] < .1))
    big = radii[order] > 2 * np.median(radii)
    rank = np.argsort(-x[order, 1] + 10 * big)
    order = order[rank]
    spheres = EllipseCollection(2e2 * radii[order], 2e2 * radii[order], np.zeros(len(order)),
                                units='xy', offsets=1e2 * x[order][:, [0, 2]],
                                offset_transform=axis.transData, norm=norm, cmap='plasma',
                                edgecolors='#00000080',
                                linewidths=np.where(big[rank], 1.6, .3))
    spheres.set_array(np.clip(shot['speed'][order], 1e-3, None))
    axis.add_collection(spheres)
    return spheres


def times(results, file):
    """Bars of the whole time, split into collider, interaction loop, integrator and the rest."""
    figure, axis = plt.subplots(figsize=(8, 1.4 + .8 * len(results)), layout='constrained')
    left = np.zeros(len(results))
    y = np.arange(len(results))[::-1]
    parts = {k: [r[k] for r in results] for k in ('collider', 'loop', 'integrator')}
    parts['rest'] = [max(0, r['seconds'] - r['collider'] - r['loop'] - r['integrator'])
                     for r in results]
    names = dict(loop='interaction loop')
    for part, values in parts.items():
        axis.barh(y, values, left=left, height=.6, color=COLOURS[part], label=names.get(part, part))
        left += values
    axis.bar_label(axis.containers[-1], [f'{r["seconds"]:.1f} s' for r in results], padding=4)
    axis.set_yticks(y, [NAMES[r['name']] for r in results])
    axis.set_xlim(0, 1.12 * left.max())
    axis.set_xlabel('time, s')
    axis.spines[['top', 'right']].set_visible(False)
    figure.suptitle('Projectile into 20,000 spheres: distribution of the time', fontsize=12)
    axis.legend(loc='lower center', bbox_to_anchor=(.5, 1), ncol=4, frameon=False)
    figure.savefig(file, dpi=110)
    plt.close(figure)
