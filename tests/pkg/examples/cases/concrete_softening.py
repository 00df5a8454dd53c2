"""Half-notched concrete beam, 50 mm deep, span 125 mm, 50 mm thick (values of a published series: E 37 GPa, ft 3.9 MPa,
GF 143 J/m²; peak loads 933 to 1114 N). Concrete needs a softening law with a long tail.
Expected: the peak is within 15 % of the measured range by a documented choice of law, softening='reinhardt'. Seen before
there was a choice: 1388 N on a straight joint, 1424 to 1439 N on irregular meshes.
    scripts/yade -n -x concrete_softening.py"""
import numpy as np
from yadefrag import *

E, FT, GF, DEPTH, HALF = 37e9, 3.9e6, 143.2, .05, .0875
O.materials.append(BrittleFEMat(young=E, poisson=.2, density=2346, frictionAngle=.6, tensileStrength=FT, fractureEnergy=GF,
                                planeStress=True, softening='reinhardt', label='c'))
fe = FESolver()
slit = 1.5e-4
near = lambda x, y: abs(x - HALF) < .03 and y < .045
fe.addPolygon([(0, 0), (.025, 0), (HALF - slit, 0), (HALF, DEPTH / 2), (HALF + slit, 0), (.15, 0), (2 * HALF, 0), (2 * HALF, DEPTH),
               (HALF, DEPTH), (0, DEPTH)], size=lambda x, y: 2e-3 + .2 * max(0, abs(x - HALF) - .015), material='c', thickness=.05,
              fixed=lambda x, y: 'y' if y < 1e-9 and min(abs(x - .025), abs(x - .15)) < 1e-6 else False,
              strength=lambda x, y: FT if near(x, y) else 1e3 * FT, fractureEnergy=lambda x, y: GF if near(x, y) else 0)
O.engines = engines(fe)
O.dt = .8 * fe.criticalTimeStep()
fe.damping = 1 / 6e-4
top = np.nonzero((abs(fe.nodes[:, 0] - HALF) < 1e-6) & (abs(fe.nodes[:, 1] - DEPTH) < 1e-9))[0]
fe.prescribe(top, vy=[(0, 0), (.002, -.0105)])
forces = []
while len(forces) < 400:
    O.run(200, True)
    forces.append(-fe.reaction(top)[1])
    if max(forces) > 300 and np.mean(forces[-5:]) < .6 * max(forces):
        break
peak = max(np.mean(forces[k:k + 5]) for k in range(len(forces) - 4))
print('peak %.0f N, measured 933 to 1114 N' % peak)
assert peak < 1.15 * 1114
