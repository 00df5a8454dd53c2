"""test_fe_background.py: a scene that cracks in the background as the script ends."""
import sys
import time

import yadefrag
from yade import wrapper as w

kind = sys.argv[1]
material = w.BrittleFEMat(young=1e7, poisson=.3, density=1000, tensileStrength=1e4)
solver = w.FESolver()
nodes, triangles = yadefrag.rectangleMesh((0, 0), (1, .5), 16, 8)
solver.addTriangles(nodes, triangles, material=material,
                    velocity=lambda x, y: (20 * (x - .5), 20 * (y - .25)))
O.engines = [w.ForceResetter(), solver]
if kind != 'alone':
    O.engines = O.engines + [w.PyRunner(command='solver.numCracks', iterPeriod=1)]
O.dt = .5 * solver.criticalTimeStep()
O.run()
while O.iter < 3:
    time.sleep(.001)
if kind == 'reset':
    for _ in range(20):
        O.reset()
        O.engines = [w.PyRunner(command='solver.numCracks', iterPeriod=1)]
        O.run()
print('@@@ end', O.iter, flush=True)
