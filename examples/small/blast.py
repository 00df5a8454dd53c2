"""Pressure in the hole of a disc of rock: first a small one, compared with Lamé's solution, then a blast that cracks it.

    scripts/yade -n -x examples/small/blast.py [FOLDER of the picture]
"""
import os
import sys

import numpy as np
from yadefrag import *

A, B, E, NU, LITTLE = .02, .2, 30e9, .2, 1e5  # m, m, Pa, -, Pa

O.materials.append(BrittleFEMat(young=E, poisson=NU, density=2500, tensileStrength=8e6, fractureEnergy=60,
                                shearFactor=3, shearEnergyFactor=9, frictionAngle=.6, strengthScatter=.1,
                                planeStress=True, label='rock'))
fe = FESolver()
size = lambda x, y: max(2e-3, .06 * np.hypot(x, y))
fe.addPolygon(*ring((0, 0), A, B, 64), size=size, material='rock', name='rock')
O.engines = engines(fe)
O.dt = .4 * fe.criticalTimeStep()
wall = np.nonzero(np.hypot(*fe.nodes.T) < 1.01 * A)[0]
fe.pressure(wall, LITTLE)
fe.relax(1e-8)

places = fe.nodes - fe.displacements
outwards = (fe.displacements[wall] * places[wall]).sum(axis=1) / np.hypot(*places[wall].T)
theory = LITTLE * A / E * ((1 - NU) * A**2 + (1 + NU) * B**2) / (B**2 - A**2)
print('hole widens by: %.5g m, Lamé %.5g m, between %.5g and %.5g m' %
      (outwards.mean(), theory, outwards.min(), outwards.max()))
middles = places[fe.triangles].mean(axis=1)
near = abs(np.hypot(*middles.T) - 2 * A) < .1 * A
hoop = fe.principalStress[near, 0].mean()
radius = np.hypot(*middles[near].T)
print('hoop stress at two radii: %.5g Pa, Lamé %.5g Pa' %
      (hoop, np.mean(LITTLE * A**2 / (B**2 - A**2) * (1 + B**2 / radius**2))))

rim = np.nonzero(np.hypot(*fe.nodes.T) > .99 * B)[0]
fe.absorb(rim)  # as in infinite rock
now = fe.time
fe.pressure(wall, [(now, LITTLE), (now + 5e-6, 60e6), (now + 8e-5, 0.)])
before = fe.energy['total']
runSteps(int(1.2e-4 / O.dt))
print('cracks: %d, fragments: %d, energy off by %.3g of the work' %
      (fe.numCracks, len(fe.fragments()), abs(fe.energy['total'] - before) / abs(fe.energy['outside'])))
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
plotMesh(fe, fields=['fragment', 'speed'], limits=[None, (0, 1)], xlim=(-.12, .12), ylim=(-.12, .12), file=os.path.join(folder, 'blast.png'))
