"""Wind on a pane of glass, in a section across its edge: it breaks in the middle, at the pressure of beam theory.

    scripts/yade -n -x examples/small/glass.py [FOLDER of the picture]
"""
import os
import sys

import numpy as np
from yadefrag import *

SPAN, H, ROWS, E, NU, RHO, STRENGTH = .1, .008, 10, 70e9, .22, 2500, 45e6  # m, m, Pa, kg/m³, Pa
# σ = 3/4 p (L/h)² at the surface of a strip on two supports; the middles of edges there are half an
# edge below the surface.
THEORY = 4 / 3 * STRENGTH * (H / SPAN)**2 / (1 - 1 / ROWS)  # Pa
PERIOD = 2 / np.pi * SPAN**2 / H * np.sqrt(12 * RHO * (1 - NU**2) / E)  # s, of the slowest vibration

O.materials.append(BrittleFEMat(young=E, poisson=NU, density=RHO, tensileStrength=STRENGTH, fractureEnergy=0,
                                frictionAngle=.2, label='glass'))
fe = FESolver()
nodes, triangles = rectangleMesh((0, 0), (SPAN, H), 12 * ROWS, ROWS)
held = lambda x, y: abs(y - H / 2) < 1e-9 and (x < 1e-9 and 'xy' or x > SPAN - 1e-9 and 'y')
fe.addTriangles(nodes, triangles, material='glass', fixed=held, name='pane')
O.engines = engines(fe)
O.dt = .7 * fe.criticalTimeStep()
fe.pressure(lambda x, y: y > H - 1e-9, .9 * THEORY)
fe.relax(1e-8)
sinks, bears = -fe.displacements[:, 1].min(), fe.reactions[:, 1].sum()
print('sinks by: %.4g m, beam theory %.4g m' % (sinks, .9 * THEORY * SPAN**2 / H * (
    5 / 32 * SPAN**2 / H**2 * (1 - NU**2) + 3 / 10 * (1 + NU)) / E))
print('reactions: %.6g N, load %.6g N' % (bears, .9 * THEORY * SPAN))
begin, rate = fe.time, .1 * THEORY / PERIOD
fe.pressure(lambda x, y: y > H / 2, [(begin, .9 * THEORY), (begin + 1, .9 * THEORY + rate)])
while fe.numCracks == 0 and fe.time < begin + 6 * PERIOD:
    runSteps(20)
print('breaks at: %.5g Pa, beam theory %.5g Pa' % (.9 * THEORY + rate * (fe.time - begin), THEORY))
print('first crack: at %.4g of the span' % (np.mean(crackTable(fe)['x']) / SPAN))
runSteps(int(1e-4 / O.dt))
print('pieces: %d, cracks: %d' % (len(fe.fragments()), fe.numCracks))
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
plotMesh(fe, fields=['xx', 'fragment'], limits=[(-5e7, 5e7), None], file=os.path.join(folder, 'glass.png'))
