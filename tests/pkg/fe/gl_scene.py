"""`xvfb-run yade -x gl_scene.py FOLDER`: pictures of scenes in YADE's 3D view, for test_fe_results.py."""
import os
import sys
import time

import numpy as np
from PyQt5.QtWidgets import QApplication

from yade import qt, utils
from yade import wrapper as w

import yadefrag  # after qt, whose renderer is there before the classes of yadefrag

O = w.Omega()
folder = sys.argv[1]


def frames(count):
    for _ in range(count):
        QApplication.processEvents()
        time.sleep(.03)


def solver():
    O.reset()
    O.materials.append(w.FEMat(young=1e7, poisson=0, density=1000, frictionAngle=.2, label='m'))
    return w.FESolver()


def ready(fe):
    O.engines = yadefrag.engines(fe, spheres=True)
    O.dt = .5 * fe.criticalTimeStep()


def square(fe, low=(0, 0), **settings):
    return fe.addPolygon(yadefrag.rectangle(low, (low[0] + 1, low[1] + 1)), size=.2, material='m', **settings)


def picture(name):
    frames(20)
    screen = QApplication.primaryScreen().grabWindow(0)
    assert screen.save(os.path.join(folder, name + '.png'), 'PNG')


view = qt.View()
frames(10)
view.screenSize = (500, 400)
view.viewDir, view.upVector, view.axes = (0, 0, -1), (0, 1, 0), False
view.fitAABB((-.3, -.3, -.3), (2.8, 2, .3))

fe = solver()
square(fe)
fe.addPolygon(yadefrag.circle((2, .5), .5, 48), size=.1, material='m')
O.bodies.append(utils.sphere((.5, 1.5, 0), .3, material='m', color=(0, 1, 0)))
ready(fe)
O.step()
picture('component')
for body in O.bodies:
    body.shape.wire = True
picture('wire')

fe = solver()  # stretched on the right
square(fe, displacement=lambda x, y: (1e-3 * max(0, x - .6), 0))
fe.view = 'mises'
ready(fe)
picture('mises')

O.reset()
O.materials.append(w.BrittleFEMat(young=1e7, density=1000, tensileStrength=1e5, label='m'))
fe = w.FESolver(view='fragment')
square(fe, joints=[((.5, -1), (.5, 2))], jointStrength=0)
ready(fe)
picture('fragment')

fe = solver()
a, b = square(fe), square(fe, low=(1, 0))
fe.bond(a, b, strength=1e6, energy=1e4)
ready(fe)
O.step()
picture('held')

# Drawn while a run goes on, in which cracks bring new bodies.
O.reset()
O.materials.append(w.BrittleFEMat(young=1e9, poisson=.2, density=2000, tensileStrength=1e6, label='m'))
fe = w.FESolver(view='fragment')
square(fe, velocity=(0, -15))
O.bodies.append(utils.wall(-.001, axis=1))
ready(fe)
O.dt *= .5
O.run(300)
while O.running:
    frames(1)
frames(5)
picture('running')
np.save(os.path.join(folder, 'cracks.npy'), [fe.numCracks, len(fe.fragments())])
sys.stdout.flush()
os._exit(0)
