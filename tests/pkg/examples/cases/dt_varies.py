"""Steps drawn between .27 and .9 of the critical one, each stable by itself.
Expected: the energy stays within 1 %, or a message tells that it grew."""
import math
import os
import random

from yadefrag import *

O.materials.append(FEMat(young=2e11, poisson=.3, density=7800, label='s'))
fe = FESolver()
fe.addPolygon(rectangle((0, 0), (.04, .02)), size=1e-3, material='s', velocity=lambda x, y: (10 * math.sin(300 * x), 5 * y))
critical, draw = fe.criticalTimeStep(), random.Random(1)


def drawStep():
    O.dt = .9 * critical * (.3 + .7 * draw.random())


O.engines = [PyRunner(command='drawStep()', iterPeriod=1)] + engines(fe)
O.dt = .5 * critical
O.step()
begin = fe.energy['total']
O.run(1000, True)
growth = fe.energy['total'] / begin
print('energy x %.4g, messages %s' % (growth, fe.warnings))
os._exit(0 if abs(growth - 1) < .01 or fe.warnings else 1)
