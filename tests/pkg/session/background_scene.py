"""test_fe_background.py: scenes in the background as the script ends."""
import sys
import time

import yadefrag
from yade import utils, wrapper as w

kind = sys.argv[1]
if kind == 'moved':  # bodies and contacts are moved in memory, with Python's lock
    O.bodies.append([utils.sphere((i % 14 * .97, i // 14 % 14 * .97, i // 196 * .97), .5) for i in range(14 ** 3)])
    O.engines = [w.ForceResetter(), w.InsertionSortCollider([w.Bo1_Sphere_Aabb()]),
                 w.CurveLoop([w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                             [w.Law2_ScGeom_FrictPhys_CundallStrack()]), w.CurveIntegrator(damping=.2)]
    O.dt = 1e-4
    O.run()
    while O.iter < 31:
        pass
    print('@@@ end', O.iter, flush=True)
    O.exitNoBacktrace()
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
if kind == 'exit':
    O.exitNoBacktrace()
