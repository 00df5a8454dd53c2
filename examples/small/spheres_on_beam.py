"""YADE's spheres on an elastic beam, which two of YADE's boxes support: deflection, forces.

    scripts/yade -n -x examples/small/spheres_on_beam.py [FOLDER of the picture]

The spheres move vertically only, as between guides.
"""
import os
import sys

from yade import utils
from yadefrag import *

SPAN, OVER, H, WIDTH, E, NU, RHO, R, G = .5, .02, .02, .04, 1e8, .3, 1200, .02, 9.81  # m, Pa, kg/m³, m, m/s²

O.materials.append(FEMat(young=E, poisson=NU, density=RHO, frictionAngle=.3, planeStress=True, label='resin'))
O.materials.append(FrictMat(young=1e7, poisson=.3, density=7800, frictionAngle=0, label='steel'))
fe = FESolver()
nodes, triangles = rectangleMesh((-OVER, 0), (SPAN + OVER, H), 108, 4)
fe.addTriangles(nodes, triangles, material='resin', thickness=WIDTH, element='smoothed', name='beam')
supports = [utils.box((x, -.01, 0), (.03, .01, .03), fixed=True, material='steel', color=(.8, .8, .8))
            for x in (-.03, SPAN + .03)]
O.bodies.append(supports)  # the beam rests on their inner edges
for place in (.25, .5, .75):
    ball = utils.sphere((place * SPAN, H + R, 0), R, material='steel', color=(.5, .6, .8))
    ball.state.blockedDOFs = 'xzXYZ'
    O.bodies.append(ball)
mass = O.bodies[-1].state.mass
O.engines = engines(fe, gravity=(0, -G), spheres=True, damping=.1)
O.dt = .5 * fe.criticalTimeStep()
fe.damping = 100.  # 1/s, about critical for the slowest vibration
runSteps(int(.7 / O.dt))

inertia, area = WIDTH * H**3 / 12, WIDTH * H
load, line = mass * G, RHO * area * G  # N, N/m
bending = (load * SPAN**3 / 48 * (1 + 2 * .25 * (3 - 4 * .25**2)) + 5 / 384 * line * SPAN**4 - line * OVER**2 * SPAN**2 / 16) / E / inertia
shear = (load * SPAN / 4 * 2 + line * SPAN**2 / 8) / (E / 2 / (1 + NU) * area * 10 * (1 + NU) / (12 + 11 * NU))
axis = (abs(nodes[:, 0] - SPAN / 2) < 1e-9) & (abs(nodes[:, 1] - H / 2) < 1e-9)
print('deflection: %.5g m, Timoshenko %.5g m' % (-fe.displacements[axis, 1].mean(), bending + shear))
bears = [-O.forces.f(support.id)[1] for support in supports]
weight = 3 * load + line * (SPAN + 2 * OVER)
print('forces on the supports: %.7g and %.7g N, half of the weight %.7g N' % (*bears, weight / 2))
print('force of the spheres: %.8g N, weight %.8g N' %
      (sum(O.forces.f(b.id)[1] for b in O.bodies if isinstance(b.shape, Sphere)), 3 * load))
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
plotMesh(fe, fields=['xx', 'speed'], file=os.path.join(folder, 'spheres_on_beam.png'))
