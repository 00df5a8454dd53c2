"""A steel disc hits a thin strip of rubber at 100 m/s, the wave speed of rubber.
Expected: no element collapses, or a message asks for a shorter step, and a shorter step runs. Seen once: the same
element collapsed at the same moment with a step 80 times shorter.
    scripts/yade -n -x collapse_advice.py"""
from yadefrag import *

times = []
for factor in (.8, .2, .05, .01):
    O.reset()
    O.materials.append(FEMat(young=210e9, poisson=.3, density=7800, frictionAngle=.2, label='steel'))
    O.materials.append(FEMat(young=5e6, poisson=.4, density=1100, frictionAngle=.2, label='rubber'))
    fe = FESolver()
    nodes, triangles = rectangleMesh((-.03, 0), (.03, .002), 30, 1)
    fe.addTriangles(nodes, triangles, material='rubber', fixed=lambda x, y: abs(x) > .03 - 1e-9)
    fe.addPolygon(circle((0, .0071), .005, 32), size=1.2e-3, material='steel', velocity=(0, -100))
    O.engines = engines(fe)
    O.dt = factor * fe.criticalTimeStep()
    try:
        O.run(int(6e-5 / O.dt), True)
        print('factor %g: runs' % factor)
        times.append(None)
    except RuntimeError as error:
        print('factor %g: %s' % (factor, error))
        times.append(O.time)
assert None in times[1:], 'no shorter step helps'
