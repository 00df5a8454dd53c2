"""One run for advice.py, inside yade: advice_yade.py N ORDER ROUNDS; prints one line of JSON.

The packing of scenes.py with our collider and loop, spheres created in random order or in that of the curve.
{variant: ms per step, one number for each round}, by the clock around all steps; the variants take turns.
"""
import json
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade import O, utils  # noqa: E402
from yade.wrapper import ForceResetter, NewtonIntegrator, PyRunner  # noqa: E402
from yadefrag import CurveLoop, LebesgueCollider, inCurveOrder  # noqa: E402

import scenes  # noqa: E402

STEPS = 50


def energyInPython():
    """Through each body, as many scripts do."""
    return sum(.5 * body.state.mass * body.state.vel.squaredNorm() for body in O.bodies)


def stepByStep():
    for _ in range(STEPS):
        O.step()


def allAtOnce():
    O.run(STEPS, True)


def measured(action, runner=None):
    """ms per step of an action, with another engine in the meantime."""
    engines = O.engines
    if runner:
        O.engines = [*engines, runner]
    start = time.perf_counter()
    action()
    took = (time.perf_counter() - start) / STEPS
    O.engines = engines
    return 1e3 * took


def timed():
    """With the times of the engines taken."""
    O.timingEnabled = True
    took = measured(allAtOnce)
    O.timingEnabled = False
    return took


def tracked():
    """With the energies tracked."""
    O.trackEnergy = True
    took = measured(allAtOnce)
    O.trackEnergy = False
    return took


VARIANTS = {
    'O.run': lambda: measured(allAtOnce), 'O.step in a loop': lambda: measured(stepByStep),
    'O.timingEnabled': timed, 'O.trackEnergy': tracked,
    'PyRunner, every step, through all bodies': lambda: measured(allAtOnce, PyRunner(
        command='energyInPython()', iterPeriod=1)),
    f'PyRunner, every {STEPS} steps, through all bodies': lambda: measured(allAtOnce, PyRunner(
        command='energyInPython()', iterPeriod=STEPS)),
    'PyRunner, every step, utils.kineticEnergy': lambda: measured(allAtOnce, PyRunner(
        command='utils.kineticEnergy()', iterPeriod=1))}


def build(n, order):
    """The scene; its bodies are created anew in the order of the curve."""
    parts = scenes.build('packing', n, 1)
    if order == 'curve':
        old = [(tuple(body.state.pos), tuple(body.state.vel), body.state.blockedDOFs) for body in O.bodies]
        rest = {place: more for place, *more in old}
        material = O.bodies[0].mat
        O.bodies.clear()
        for place in inCurveOrder([place for place, *_ in old]):
            velocity, blocked = rest[tuple(place)]
            O.bodies.append(scenes._sphere(place, scenes.RADIUS, velocity, material, blocked))
    O.engines = [ForceResetter(), LebesgueCollider(parts['bound']),
                 CurveLoop(parts['geom'], parts['phys'], parts['law']), NewtonIntegrator(**parts['newton'])]


def main(n, order, rounds):
    """Build, measure, print."""
    build(n, order)
    O.run(30, True)
    found = {name: [] for name in VARIANTS}
    for _ in range(rounds):
        for name, measure in VARIANTS.items():
            found[name].append(measure())
    print(json.dumps(found), flush=True)


main(int(sys.argv[1]), sys.argv[2], int(sys.argv[3]))
