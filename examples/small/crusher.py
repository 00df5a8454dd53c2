"""A jaw crusher: a pebble between two plates, of which one comes nearer; the plates' forces balance.

    scripts/yade -n -x examples/small/crusher.py [FOLDER of pictures and table]
"""
import os
import sys

import numpy as np
from yadefrag import *

R, LEAN, SPEED, STRENGTH = .02, -.2, 1., 5e6  # m, rad, m/s, Pa
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))

O.materials.append(FEMat(young=50e9, poisson=.3, density=7800, frictionAngle=.3, label='steel'))
O.materials.append(BrittleFEMat(young=10e9, poisson=.2, density=2500, tensileStrength=STRENGTH, fractureEnergy=10,
                                shearFactor=3, frictionAngle=.6, strengthScatter=.1, label='stone'))
fe = FESolver()
turned = np.array([[np.cos(LEAN), np.sin(LEAN)], [-np.sin(LEAN), np.cos(LEAN)]])
still = rectangle((-R - .0101, -.04), (-R - .0001, .05))
moving = np.array(rectangle((R + .0001, -.04), (R + .0101, .05))) @ turned  # nearer below
moving += np.array([R + .0001, 0]) - np.array([R + .0001, 0]) @ turned
moving[:, 0] += R * (1 / np.cos(LEAN) - 1)
fe.addPolygon(still, size=5e-3, material='steel', fixed=lambda x, y: x < -R - .01 + 1e-9, name='still jaw')
back = lambda x, y: abs((x - moving[1, 0]) * (moving[2, 1] - moving[1, 1])
                        - (y - moving[1, 1]) * (moving[2, 0] - moving[1, 0])) < 1e-9
fe.addPolygon(moving, size=5e-3, material='steel', fixed=back, velocity=(-SPEED, 0), name='moving jaw')
fe.addPolygon(circle((0, 0), R, 48), size=1.6e-3, material='stone', name='pebble')
O.engines = engines(fe)
O.dt = .5 * fe.criticalTimeStep()
begun, total = (fe.masses[:, None] * fe.velocities).sum(axis=0), fe.energy['total']
course, impulse = [], np.zeros(2)
while fe.time < 9e-4:
    O.step()
    impulse += fe.reactions.sum(axis=0) * O.dt
    course.append((fe.time, fe.reaction('still jaw')[0], -fe.reaction('moving jaw')[0], fe.numCracks))
times, left, right, cracks = np.array(course).T
change = (fe.masses[:, None] * fe.velocities).sum(axis=0) - begun
print('momentum: reactions gave (%.6g, %.6g) N s, bodies have (%.6g, %.6g) N s more' % (*impulse, *change))
print('largest force: %.4g N; disc between plates breaks at %.4g N' % (left.max(), np.pi * R * STRENGTH))
print('pieces: %d, cracks: %d, energy off by %.3g of the work' %
      (len(fe.fragments()), fe.numCracks, abs(fe.energy['total'] - total) / abs(fe.energy['outside'])))
import matplotlib.figure  # noqa: E402
figure = matplotlib.figure.Figure(figsize=(11, 5), layout='constrained')
body, curve = figure.subplots(1, 2)
plotMesh(fe, 'fragment', ax=body)
curve.plot(1e6 * times, 1e-3 * left, label='still jaw')
curve.plot(1e6 * times, 1e-3 * right, label='moving jaw')
curve.set(xlabel='time (µs)', ylabel='force (kN per m of thickness)')
curve.legend()
figure.savefig(os.path.join(folder, 'crusher.png'), dpi=120)
