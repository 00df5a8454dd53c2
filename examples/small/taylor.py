"""Taylor's test around the axis: cylinders of three metals hit a wall; their shapes beside measured ones.

    scripts/yade -n -x examples/small/taylor.py [FOLDER of the picture]

Constants: docs/materials.md. Measured: Wilkins and Guinan 1973, Johnson and Cook 1983, in the drawings of
github.com/bbanerjee/HighRateExptData; the first point has the radius of the foot, the last one the length.
"""
import os
import sys

import matplotlib.pyplot as plt
import numpy
from yadefrag import *

# Speed (m/s), length (mm), what was measured (mm from the axis and from the wall), constants.
CYLINDERS = {
    'copper, OFHC': (
        210, 23.47, [(8.29, 0), (7.37, .73), (5.74, 1.79), (5.02, 4.06), (4.52, 7.47), (3.95, 10.72), (3.81, 15.09)],
        dict(young=124e9, poisson=.34, density=8960, yieldStress=90e6, hardening=292e6, hardeningExponent=.31,
             rateFactor=.025, thermalExponent=1.09, meltTemperature=1356, heatCapacity=383)),
    'steel 4340': (
        208, 25.4, [(5.55, 0), (4.78, 2.1), (4.3, 4.02), (4.03, 6), (3.98, 8.09), (3.88, 10.1), (3.88, 12.15),
                    (3.75, 14.26), (3.78, 16.3), (3.77, 18.3), (3.77, 20.4), (3.81, 22.48)],
        dict(young=200e9, poisson=.29, density=7830, yieldStress=792e6, hardening=510e6, hardeningExponent=.26,
             rateFactor=.014, thermalExponent=1.03, meltTemperature=1793, heatCapacity=477)),
    'aluminium 6061-T6': (
        373, 23.47, [(8.3, 0), (7.14, .79), (6.22, 1.47), (5.21, 2.3), (4.68, 2.73), (4.38, 3.37), (4.29, 4.1),
                     (4.05, 4.98), (3.9, 6.1), (3.76, 11.34), (3.81, 16.5)],
        dict(young=68.9e9, poisson=.33, density=2700, yieldStress=324e6, hardening=114e6, hardeningExponent=.42,
             rateFactor=.002, thermalExponent=1.34, meltTemperature=925, heatCapacity=896))}
RADIUS = 3.81e-3  # m

figure, axes = plt.subplots(1, 3, figsize=(11, 4.8), sharey=True, layout='constrained')
for panel, (name, (speed, length, profile, constants)) in zip(axes, CYLINDERS.items()):
    O.reset()
    O.materials.append(PlasticFEMat(frictionAngle=0, **constants))
    fe = FESolver(axisymmetric=True)
    fe.addPolygon(rectangle((0, 0), (RADIUS, length / 1e3)), size=RADIUS / 8, material=0, velocity=(0, -speed))
    O.bodies.append(wall((0, 0, 0), axis=1))
    O.engines, O.dt = engines(fe), .5 * fe.criticalTimeStep()
    before = fe.energy['total']
    while fe.masses @ fe.velocities[:, 1] < 0:
        O.run(100, True)
    O.run(O.iter // 2, True)  # it rebounds
    (foot, _), (_, final) = profile[0], profile[-1]
    print('%s, %d m/s: length %.2f mm, measured %.2f mm; foot %.2f mm, measured %.2f mm; energy off by %.1e' % (
        name, speed, 1e3 * numpy.ptp(fe.nodes[:, 1]), final, 2e3 * fe.nodes[:, 0].max(), 2 * foot,
        fe.energy['total'] / before - 1))
    plotMesh(fe, 'plasticStrain', ax=panel, limits=(0, 2), mirror=True, rigidBodies=False)
    if panel is not axes[2]:
        panel.collections[0].colorbar.remove()
    x, y = numpy.transpose(profile) / 1e3 + [[0], [fe.nodes[:, 1].min()]]
    panel.plot([*-x, *x], [*y, *y], 'o', mfc='w', mec='C3', mew=1.5, ms=6, label='measured')
    panel.set(title=f'{name}, {speed} m/s', xlim=(-.0095, .0095), ylim=(-.0005, .0238))
    panel.axhline(0, color='k', linewidth=2)
    panel.label_outer()
axes[0].legend(loc='upper left')
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(sys.argv[0]))
figure.savefig(os.path.join(folder, 'taylor.png'), dpi=120)
