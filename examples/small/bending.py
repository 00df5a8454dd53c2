"""Three-point bending of an elastic beam: deflection compared with Timoshenko's, reactions with the load.

    scripts/yade -n -x examples/small/bending.py [FOLDER of the picture]
"""
import os
import sys

import numpy as np
from yadefrag import *

SPAN, OVER, H, E, NU, LOAD = .4, .02, .04, 2e9, .3, 1e3  # m, m, m, Pa, -, N for 1 m of thickness

O.materials.append(FEMat(young=E, poisson=NU, density=1200, planeStress=True, label='resin'))
fe = FESolver()
# One node at each support is held; the load is on five nodes at the top.
nodes, triangles = rectangleMesh((-OVER, 0), (SPAN + OVER, H), 88, 8)
held = lambda x, y: y < 1e-9 and (abs(x) < 1e-9 and 'xy' or abs(x - SPAN) < 1e-9 and 'y')
fe.addTriangles(nodes, triangles, material='resin', element='smoothed', fixed=held, name='beam')
loads = np.zeros_like(fe.nodes)
top = (fe.nodes[:, 1] > H - 1e-9) & (abs(fe.nodes[:, 0] - SPAN / 2) < .011)
loads[top] = 0, -LOAD / top.sum()
fe.loads = loads
O.engines = engines(fe)
O.dt = .8 * fe.criticalTimeStep()
fe.relax(1e-10)

at = fe.nodes - fe.displacements


def sinks(x):
    """(m) Deflection of the axis at x."""
    near = (abs(at[:, 0] - x) < 1e-9) & (abs(at[:, 1] - H / 2) < 1e-9)
    return -fe.displacements[near, 1].mean()


deflection = sinks(SPAN / 2) - (sinks(0) + sinks(SPAN)) / 2
inertia, shear = H**3 / 12, E / 2 / (1 + NU)
theory = LOAD * SPAN**3 / 48 / E / inertia + LOAD * SPAN / 4 / (10 * (1 + NU) / (12 + 11 * NU)) / shear / H
print('deflection: %.6g m, Timoshenko %.6g m' % (deflection, theory))
for name, x in (('left', 0), ('right', SPAN)):
    reaction = fe.reaction((abs(at[:, 0] - x) < 1e-9) & (at[:, 1] < 1e-9))
    print('reaction %s: %.9g N, half of the load %.9g N' % (name, reaction[1], LOAD / 2))
tension = fe.stress[(abs(at[fe.triangles].mean(axis=1)[:, 0] - SPAN / 4) < .01), 0].max()
print('largest tension in a quarter of the span: %.4g Pa, theory at the surface %.4g Pa' %
      (tension, LOAD * SPAN / 8 * H / 2 / inertia))
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
plotMesh(fe, fields=['xx', 'xy'], limits=[(-4e5, 4e5), (-3e4, 3e4)], file=os.path.join(folder, 'bending.png'))
