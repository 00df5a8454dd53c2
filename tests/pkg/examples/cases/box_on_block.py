"""A dynamic YADE box of 13.5 kg hits an FE block at 20 m/s, three element sizes.
Expected: what the box loses is what the block gets (1e-3 of 2696 J).
    scripts/yade -n -x -j1 box_on_block.py"""
import os
import warnings

from yadefrag import *

warnings.simplefilter('ignore')
worst = 0
for size in (.05, .025, .0125):
    O.reset()
    O.materials.append(FEMat(young=10e9, poisson=.2, density=1800, frictionAngle=.6, label='brick'))
    O.materials.append(FrictMat(young=50e9, poisson=.3, density=7800, frictionAngle=.4, label='steel'))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (.8, .6)), size=size, material='brick', mesh='regular')
    b = O.bodies[O.bodies.append(box((.91, .35, 0), (.06, .06, .06), fixed=False, material='steel'))]
    if b.state.mass == 0:
        b.state.mass = .12**3 * 7800
        b.state.inertia = (1, 1, b.state.mass * .12**2 / 6)
    b.state.vel, b.state.blockedDOFs = (-20, 0, 0), 'zXY'
    O.engines = engines(fe, moving=True)
    O.dt = .5 * fe.criticalTimeStep()

    def energy():
        return .5 * b.state.mass * b.state.vel.squaredNorm() + .5 * b.state.inertia[2] * b.state.angVel[2]**2

    before = energy()
    O.run(int(.006 / O.dt), True)
    lost, got = before - energy(), -fe.energy['outside']
    worst = max(worst, abs(lost - got) / before)
    print('size %g: box lost %.0f J, block got %.0f J, contact took %.0f J, %d messages' % (size, lost, got, fe.energy['contact'],
                                                                                      len(fe.warnings)))
print('largest difference %.2g of the energy (1e-3 wanted)' % worst)
os._exit(0 if worst < 1e-3 else 1)
