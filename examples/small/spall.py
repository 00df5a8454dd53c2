"""Spall around the axis: a copper disc of 2 mm hits one of 4 mm at 120 m/s, whose rear part flies off; after 8 µs.

    scripts/yade -n -x examples/small/spall.py [FOLDER of the picture]
"""
import math
import os
import sys

import numpy
from yadefrag import *

SPEED, RADIUS, STRENGTH, YIELD, DENSITY = 120, 12e-3, 1.35e9, 90e6, 8960  # m/s, m, Pa, Pa, kg/m³
YOUNG, POISSON = 124e9, .34

bulk, shear = YOUNG / (3 * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
elastic, plastic = math.sqrt((bulk + 4 * shear / 3) / DENSITY), math.sqrt(bulk / DENSITY)  # m/s, speeds of waves
copper = dict(young=YOUNG, poisson=POISSON, density=DENSITY, yieldStress=YIELD, frictionAngle=.2)
O.materials.append(PlasticFEMat(**copper, label='flyer'))
O.materials.append(PlasticFEMat(**copper, spallStress=STRENGTH, fractureEnergy=5e3, label='disc'))
fe = FESolver(axisymmetric=True, linearViscosity=.06, quadraticViscosity=1.2)
fe.addPolygon(rectangle((0, -.002), (RADIUS, 0)), size=.15e-3, material='flyer', velocity=(0, SPEED), mesh='irregular')
fe.addPolygon(rectangle((0, 0), (RADIUS, .004)), size=.15e-3, material='disc')
O.engines = engines(fe)
O.dt = .8 * fe.criticalTimeStep()
before = fe.energy['total']
x, y = fe.nodes.T
rear = numpy.flatnonzero((y > .004 - 1e-9) & (x < 1e-3))
times, velocities = [], []
while fe.time < 8e-6:
    O.run(2, True)
    times.append(fe.time)
    velocities.append(fe.velocities[rear, 1].mean())

times, velocities = numpy.array(times), numpy.array(velocities)
limit = YIELD * (bulk + 4 * shear / 3) / (2 * shear)
plateau = velocities[(1.3e-6 < times) & (times < 1.6e-6)].mean()
pullBack = plateau - velocities[(1.8e-6 < times) & (times < 2.5e-6)].min()
found = DENSITY * elastic * pullBack / (1 + elastic / plastic) - 2 / 3 * YIELD
print('velocity of the rear face: %.1f m/s, closed form %.1f m/s' % (
    plateau, SPEED - limit / DENSITY * (1 / plastic - 1 / elastic)))
print('pull-back: %.1f m/s, strength by it %.3f GPa, given %.3f GPa' % (pullBack, found / 1e9, STRENGTH / 1e9))
print('cracks: %d, energy off by %.1e' % (fe.numCracks, fe.energy['total'] / before - 1))
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
plotMesh(fe, 'speed', file=os.path.join(folder, 'spall.png'), mirror=True)
