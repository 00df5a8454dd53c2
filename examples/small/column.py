"""Five blocks on top of each other come to rest: the load on each one is the weight above it.

    scripts/yade -n -x examples/small/column.py [FOLDER of the picture]
"""
import os
import sys

from yadefrag import *

SIDE, RHO, G, COUNT = .1, 2500, 9.81, 5  # m, kg/m³, m/s², blocks

O.materials.append(FEMat(young=1e8, poisson=.2, density=RHO, frictionAngle=.5, label='stone'))
fe = FESolver(passes=2)
fe.addPolygon(rectangle((-.1, -.02), (.2, 0)), size=.02, material='stone', fixed=lambda x, y: True,
              name='floor')
names = ['block %d' % k for k in range(COUNT)]
for k, name in enumerate(names):
    left, bottom = .01 * (-1)**k, k * SIDE
    fe.addPolygon(rectangle((left, bottom), (left + SIDE, bottom + SIDE)), size=.02, material='stone', name=name)
O.engines = engines(fe, gravity=(0, -G))
O.dt = .8 * fe.criticalTimeStep()
fe.relax(1e-10)

weight = RHO * SIDE**2 * G  # N, weight of one block, 1 m thick
for k, (below, name) in enumerate(zip(['floor'] + names, names)):
    force = fe.contactForce(below, name)
    print('%s on %s: %.9g N, weight above %.9g N, sideways %.3g N' %
          (name, below, -force[1], (COUNT - k) * weight, force[0]))
print('reaction of the floor: %.9g N, weight %.9g N' % (fe.reaction('floor')[1], (COUNT * SIDE**2 + .02 * .3) * RHO * G))
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
plotMesh(fe, fields=['yy', 'component'], file=os.path.join(folder, 'column.png'))
