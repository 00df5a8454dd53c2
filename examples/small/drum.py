"""Ten turns of a drum with stones: the drum stays round, and its work is the energy of the stones.

    scripts/yade -n -x examples/small/drum.py [FOLDER of the picture] [turns]
"""
import os
import sys

import numpy as np
from yadefrag import *

INNER, OUTER, OMEGA = .1, .11, 6.  # m, m, rad/s: 0.37 of gravity at the wall
turns = float(sys.argv[2]) if len(sys.argv) > 2 else 10

O.materials.append(FEMat(young=3e5, poisson=.3, density=1000, frictionAngle=.5, label='rubber'))
fe = FESolver()
fe.addPolygon(*ring((0, 0), INNER, OUTER, 48), size=.02, material='rubber', name='drum')
for k in range(8):
    x, y = .036 * (k % 4 - 1.5), .03 * (k // 4) - .045
    shape = rectangle((x - .013, y - .013), (x + .013, y + .013)) if k % 2 else circle((x, y), .013, 12)
    fe.addPolygon(shape, size=.01, material='rubber', name='stone %d' % k)
fe.rotate('drum', OMEGA, (0, 0))
O.engines = engines(fe, gravity=(0, -9.81))
O.dt = .8 * fe.criticalTimeStep()

drum, start = fe.nodesOf('drum'), fe.nodes.copy()
stones = np.concatenate([fe.nodesOf('stone %d' % k) for k in range(8)])
masses, heights = fe.masses[stones], []
total = fe.energy['total']
runSteps(int(turns * 2 * np.pi / OMEGA / O.dt), every=100,
         call=lambda: heights.append(masses @ fe.nodes[stones] / masses.sum()))

radii = [np.linalg.norm(nodes[drum], axis=1) for nodes in (start, fe.nodes)]
angle = OMEGA * fe.time
right = start[drum] @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]
print('radius: off by %.3g of it after %.3g turns' % (abs(radii[1] / radii[0] - 1).max(), angle / 2 / np.pi))
print('places: off by %.3g of the radius' % (np.linalg.norm(fe.nodes[drum] - right, axis=1).max() / INNER))
centre = np.mean(heights[len(heights) // 5:], axis=0)
print('stones lean by: %.3g degrees; farthest corner %.4g of the radius' %
      (np.degrees(np.arctan2(centre[0], -centre[1])), np.linalg.norm(fe.nodes[stones], axis=1).max() / INNER))
energy = fe.energy
print('energy: work of the drum and of gravity %.6g J, friction %.6g J, total changed by %.3g of it' %
      (-energy['outside'], energy['friction'], abs(energy['total'] - total) / abs(energy['outside'])))
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
plotMesh(fe, fields=['mises', 'speed'], limits=[(0, 2e4), None], file=os.path.join(folder, 'drum.png'))
