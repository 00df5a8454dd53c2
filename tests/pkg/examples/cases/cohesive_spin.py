"""A free block tears in two by its own velocities; cohesion acts, nothing else does.
Expected: angular momentum stays within 1e-6 of the sum of m r v. Seen once: 3e-4 (Gc 500, shearFactor 1), 8e-3 (shearFactor 3),
no message; without fractureEnergy 2e-8.
    scripts/yade -n -x -j1 cohesive_spin.py"""
import os

import numpy as np
from yadefrag import *


def run(energy, shearFactor):
    O.reset()
    O.materials.append(BrittleFEMat(young=1e9, poisson=.2, density=2000, frictionAngle=0, tensileStrength=1e6,
                                    fractureEnergy=energy, shearFactor=shearFactor, label='c'))
    fe = FESolver()
    fe.addPolygon(rectangle((-.01, -.01), (.01, .01)), size=2e-3, material='c', meshSeed=1,
                  velocity=lambda x, y: (0, 10 * np.sign(y)))
    O.engines = engines(fe)
    O.dt = .5 * fe.criticalTimeStep()

    def spin():
        r, v, m = np.array(fe.nodes), np.array(fe.velocities), np.array(fe.masses)
        return (m * (r[:, 0] * v[:, 1] - r[:, 1] * v[:, 0])).sum(), (m * np.hypot(*r.T) * np.hypot(*v.T)).sum()

    begin, worst = spin()[0], 0
    for _ in range(20):
        O.run(max(1, int(2.5e-5 / O.dt)), True)
        now, size = spin()
        worst = max(worst, abs(now - begin) / size)
    print('Gc %g, shearFactor %g: %.1e, cracks %d, messages %d' % (energy, shearFactor, worst, fe.numCracks, len(fe.warnings)))
    return worst


worst = max(run(energy, shearFactor) for energy in (0, 500, 2000) for shearFactor in (1, 3))
print('largest change %.1e (1e-6 wanted)' % worst)
os._exit(0 if worst < 1e-6 else 1)
