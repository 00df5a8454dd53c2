"""A rock specimen 50 x 100 mm (E 30 GPa, 5 MPa, cohesion 15 MPa, 35 degrees, 40 J/m²), turned by 20 degrees, is crushed between
smooth platens at 0.15 m/s.
Expected: contact can only dissipate, so that fe.energy['contact'] does not fall by more than 1 % of the work of the platens, and
friction heat is less than that work. Seen before: contact fell by 60 J (15 % of all work) in 150 steps, and friction heat rose by
as much, without a message: rows of corners that had passed each other supported each other.
    scripts/yade -n -x crushed_rock_ledger.py"""
import math

from yadefrag import *

TURN, HEIGHT, SPEED = math.radians(20), .1, .15
COS, SIN = math.cos(TURN), math.sin(TURN)


def turned(outline):
    return [(x * COS - y * SIN, x * SIN + y * COS) for x, y in outline]


O.materials.append(BrittleFEMat(young=30e9, poisson=.22, density=2600, planeStress=True, tensileStrength=5e6, shearFactor=3,
                                frictionAngle=math.radians(35), fractureEnergy=40, shearEnergyFactor=5, label='rock'))
O.materials.append(FEMat(young=210e9, poisson=0, density=7800, frictionAngle=0, label='steel'))
fe = FESolver()
fe.addPolygon(turned(rectangle((-.025, 0), (.025, HEIGHT))), size=2.5e-3, material='rock', meshSeed=0)
platen = fe.addPolygon(turned(rectangle((-.04, HEIGHT + 1e-9), (.04, HEIGHT + .01))), size=.005, material='steel')
fe.addPolygon(turned(rectangle((-.04, -.01), (.04, -1e-9))), size=.005, material='steel', fixed=lambda x, y: True)
fe.prescribe(fe.nodesOf(platen), vx=[(0, 0), (2e-4, SPEED * SIN), (1, SPEED * SIN)],
             vy=[(0, 0), (2e-4, -SPEED * COS), (1, -SPEED * COS)])
fe.linearViscosity = .06
O.engines = engines(fe)
O.dt = .5 * fe.criticalTimeStep()
O.run(9200, True)
least = 0
for _ in range(36):
    O.run(10, True)
    least = min(least, fe.energy['contact'])
work = -fe.energy['outside']
print('contact %.2f J, friction %.2f J, work of the platens %.2f J' % (least, fe.energy['friction'], work))
assert fe.numCracks > 100 and least > -.01 * work and fe.energy['friction'] < work
