"""Force on a fixed YADE wall below an FE block at rest, with the engines that the manual gives.
Expected: the weight, 24525 N."""
import os

from yadefrag import *

O.materials.append(FEMat(young=1e8, poisson=.2, density=2500, frictionAngle=.5, label='stone'))
fe = FESolver()
fe.addPolygon(rectangle((0, 0), (1, 1)), size=.25, material='stone')
floor = O.bodies.append(wall(0, axis=1))
O.engines = engines(fe, gravity=(0, -9.81))
O.dt = .8 * fe.criticalTimeStep()
fe.damping = 200
O.run(4000, True)
force, weight = abs(O.forces.f(floor)[1]), fe.masses.sum() * 9.81
print('floor %.6g N, weight %.6g N' % (force, weight))
os._exit(0 if abs(force / weight - 1) < 1e-3 else 1)
