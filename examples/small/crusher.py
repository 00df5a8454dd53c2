"""A jaw crusher: a pebble between two of YADE's boxes, of which one approaches; no other forces act on it.

    scripts/yade -n -x examples/small/crusher.py [FOLDER of pictures and table]
"""
import os
import sys

import numpy as np
from yade import utils
from yade.minieigenHP import Quaternion
from yadefrag import *

R, LEAN, SPEED, STRENGTH = .02, -.2, 1., 5e6  # m, rad, m/s, Pa
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))

O.materials.append(FrictMat(young=50e9, poisson=.3, density=7800, frictionAngle=.3, label='steel'))
# With shearEnergyFactor = shearFactor² the zones of sliding and of opening cracks are equally long: 8 mm.
O.materials.append(BrittleFEMat(young=10e9, poisson=.2, density=2500, tensileStrength=STRENGTH, fractureEnergy=20,
                                shearFactor=3, shearEnergyFactor=9, frictionAngle=.6, strengthScatter=.1, label='stone'))
fe = FESolver()
fe.addPolygon(circle((0, 0), R, 48), size=1.6e-3, material='stone', name='pebble')


def jaw(side, lean):
    """A plate with its face 0.1 mm beside the pebble; `lean` (rad) inclines it towards the pebble below."""
    normal, middle = np.array([np.cos(lean), np.sin(lean)]), R + 1e-4 + .005
    return utils.box((*(side * middle * normal), 0), (.005, .045, .02), fixed=True, material='steel', color=(.8, .8, .8),
                     orientation=Quaternion((0, 0, 1), lean))


fixed, moving = O.bodies.append([jaw(-1, 0), jaw(1, LEAN)])
O.bodies[moving].state.vel = (-SPEED, 0, 0)
O.engines = engines(fe, moving=True)
O.dt = .5 * fe.criticalTimeStep()
total = fe.energy['total']
course, impulse = [], np.zeros(2)
while fe.time < 9e-4:
    O.step()
    forces = [np.array(O.forces.f(number))[:2] for number in (fixed, moving)]
    impulse -= sum(forces) * O.dt
    course.append((fe.time, -forces[0][0], forces[1][0], fe.numCracks))
times, left, right, cracks = np.array(course).T
change = (fe.masses[:, None] * fe.velocities).sum(axis=0)
print('momentum: impulse of the jaws (%.6g, %.6g) N s, pebble (%.6g, %.6g) N s' % (*impulse, *change))
print('largest force: %.4g N; disc between plates breaks at %.4g N' % (left.max(), np.pi * R * STRENGTH))
print('pieces: %d, cracks: %d, energy off by %.3g of the work' %
      (len(fe.fragments()), fe.numCracks, abs(fe.energy['total'] - total) / abs(fe.energy['outside'])))
import matplotlib.figure  # noqa: E402
figure = matplotlib.figure.Figure(figsize=(11, 5), layout='constrained')
body, curve = figure.subplots(1, 2)
plotMesh(fe, 'fragment', ax=body)
body.locator_params(axis='x', nbins=5)
curve.plot(1e6 * times, 1e-3 * left, label='fixed jaw')
curve.plot(1e6 * times, 1e-3 * right, label='moving jaw')
curve.set(xlabel='time (µs)', ylabel='force (kN per m of thickness)')
curve.legend()
figure.savefig(os.path.join(folder, 'crusher.png'), dpi=120)
