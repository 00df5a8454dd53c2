"""A steel sphere hits a brittle block, on a node of its side and between two nodes, with three element sizes.
Expected: sphere and block together gain no energy, and lose none either (1e-3 and 5e-3 of 2241 J).
    scripts/yade -n -x -j1 tests/pkg/examples/cases/sphere_on_cracking_wall.py"""
import os
import warnings

from yadefrag import *

warnings.simplefilter('ignore')
worst = 0
for size in (.05, .025, .0125):
    for height in (.35, .34):
        O.reset()
        O.materials.append(BrittleFEMat(young=10e9, poisson=.2, density=1800, frictionAngle=.6, tensileStrength=3e6,
                                        fractureEnergy=50, label='brick'))
        O.materials.append(FrictMat(young=50e9, poisson=.3, density=7800, frictionAngle=.4, label='steel'))
        fe = FESolver()
        fe.addPolygon(rectangle((0, 0), (.8, .6)), size=size, material='brick', mesh='regular')
        b = O.bodies[O.bodies.append(sphere((.88, height, 0), .07, material='steel'))]
        b.state.vel, b.state.blockedDOFs = (-20, 0, 0), 'zXY'
        O.engines = engines(fe, spheres=True)
        O.dt = .5 * fe.criticalTimeStep()

        def energy():
            return .5 * b.state.mass * b.state.vel.squaredNorm() + .5 * b.state.inertia[2] * b.state.angVel[2]**2

        before = energy()
        O.run(int(.002 / O.dt), True)
        gain = energy() - before - fe.energy['outside']
        worst = max(worst, gain / before, -.2 * gain / before)
        print('size %g, height %g: gain %+.1f J of %.0f, %d cracks, %d messages' % (size, height, gain, before, fe.numCracks,
                                                                                   len(fe.warnings)))
print('largest gain, or fifth of a loss, %.2g of the energy (1e-3 wanted)' % worst)
os._exit(0 if worst < 1e-3 else 1)
