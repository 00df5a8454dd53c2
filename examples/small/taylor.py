"""Taylor's test around the axis: a copper cylinder hits a wall at 227 m/s; its foot after 80 µs.

    scripts/yade -n -x examples/small/taylor.py [FOLDER of the picture]
"""
import os
import sys

from yadefrag import *
from yade import utils

RADIUS, LENGTH, SPEED = 3.2e-3, 32.4e-3, 227  # m, m/s

O.materials.append(PlasticFEMat(young=117e9, poisson=.35, density=8930, yieldStress=400e6, hardening=100e6,
                                frictionAngle=0, label='copper'))
fe = FESolver(axisymmetric=True)
fe.addPolygon(rectangle((0, 0), (RADIUS, LENGTH)), size=.4e-3, material='copper', velocity=(0, -SPEED))
O.bodies.append(utils.wall((0, 0, 0), axis=1))
O.engines = engines(fe)
O.dt = .5 * fe.criticalTimeStep()
before = fe.energy['total']
while fe.time < 80e-6:
    O.run(100, True)

x, y = fe.nodes.T
print('largest radius: %.2f mm, Simo 1992 7.12 mm, Foulk 2021 7.22 mm' % (1e3 * x.max()))
print('final length: %.2f mm' % (1e3 * y.max()))
print('largest plastic strain: %.2f' % fe.plasticStrain.max())
print('energy: off by %.1e, %.1f %% plastic work' % (fe.energy['total'] / before - 1, 100 * fe.energy['plastic'] / before))
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
plotMesh(fe, 'plasticStrain', file=os.path.join(folder, 'taylor.png'), mirror=True, ylim=(-.0005, .0225))
