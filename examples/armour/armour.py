"""A steel projectile hits an aluminium plate that is backed by ceramic: what yields, yields, what breaks, breaks.

    scripts/yade -n -x examples/armour/armour.py [FOLDER of the picture]
"""
import sys

from matplotlib import pyplot

from yadefrag import *

steel = O.materials.append(PlasticFEMat(
    young=200e9, poisson=.29, density=7830, frictionAngle=.2, yieldStress=792e6, hardening=510e6, hardeningExponent=.26,
    rateFactor=.014, thermalExponent=1.03, meltTemperature=1793, heatCapacity=477,
    failureD1=.05, failureD2=3.44, failureD3=-2.12, failureD4=.002, failureD5=.61, fractureEnergy=2e4))
aluminium = O.materials.append(PlasticFEMat(
    young=68.9e9, poisson=.33, density=2700, frictionAngle=.2, yieldStress=324e6, hardening=114e6,
    hardeningExponent=.42, rateFactor=.002, thermalExponent=1.34, meltTemperature=925, heatCapacity=896,
    failureD1=-.77, failureD2=1.45, failureD3=-.47, failureD5=1.6, failureStrain=.1, fractureEnergy=1e4))
ceramic = O.materials.append(BrittleFEMat(
    young=370e9, poisson=.22, density=3900, frictionAngle=.3, tensileStrength=300e6, strengthScatter=.1))

fe = FESolver(passes=2)
fe.addPolygon([(-.004, .0061), (-.002, .0041), (.002, .0041), (.004, .0061), (.004, .016), (-.004, .016)], size=6e-4,
              material=steel, velocity=(0, -400), name='projectile')
fe.addPolygon(rectangle((-.03, 0), (.03, .004)), size=6e-4, material=aluminium, name='plate')
fe.addPolygon(rectangle((-.03, -.012), (.03, 0)), size=8e-4, material=ceramic, name='ceramic',
              fixed=lambda x, y: y < -.0119 and abs(x) > .02)
O.engines = engines(fe)
O.dt = .8 * fe.criticalTimeStep()
start = fe.energy['total']
while fe.time < 30e-6:
    runSteps(200)

energy = fe.energy
print('plastic strain up to %.2f, %.0f K; %d cracks, %d fragments' % (
    fe.plasticStrain.max(), fe.temperature.max(), fe.numCracks, len(fe.fragments())))
print('of %.0f J: plastic %.0f, kinetic %.0f, strain %.0f; balance %.1e' % (
    start, energy['plastic'], energy['kinetic'], energy['strain'], energy['total'] / start - 1))
folder = sys.argv[1] if len(sys.argv) > 1 else '.'
axes = pyplot.figure(figsize=(12, 6), layout='constrained').add_subplot()
plotMesh(fe, 'plasticStrain', folder + '/armour.png', axes, limits=(0, 1))
