"""What a script's own habits cost: scripts/bench advice [--n 20000]

A packing with LebesgueCollider and CurveLoop, one thread: how O.run and O.step, engines in Python, the taking of
times and energies, and the order of the bodies change the time of a step. Each order of the bodies is a yade of its
own (advice.py run N ORDER ROUNDS); everything else takes turns within it, and ratios are formed within a turn. Writes
advice.md to out/bench; with --readme the table goes into docs/data and the pages. docs/fast_scripts.md draws the conclusions.
"""
import json
import os
import statistics
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade import O, utils  # noqa: E402, F401  utils: for commands of PyRunner
from yade.wrapper import ForceResetter, NewtonIntegrator, PyRunner  # noqa: E402
from yadefrag import CurveLoop, LebesgueCollider, inCurveOrder  # noqa: E402

import measured_tables  # noqa: E402
import scenes  # noqa: E402

BASE = 'O.run'
STEPS = 50


# --- inside the yade of one order -------------------------------------------------------------------
def energyInPython():
    """Through each body, as many scripts do."""
    return sum(.5 * body.state.mass * body.state.vel.squaredNorm() for body in O.bodies)


def stepByStep():
    for _ in range(STEPS):
        O.step()


def allAtOnce():
    O.run(STEPS, True)


def measured(action=allAtOnce, runner=None, switch=None):
    """ms per step of an action, with another engine or a switch of O in the meantime."""
    engines = O.engines
    if runner:
        O.engines = [*engines, runner]
    if switch:
        setattr(O, switch, True)
    start = time.perf_counter()
    action()
    took = (time.perf_counter() - start) / STEPS
    if switch:
        setattr(O, switch, False)
    O.engines = engines
    return 1e3 * took


def running(command, period):
    return measured(runner=PyRunner(command=command, iterPeriod=period))


VARIANTS = {
    BASE: measured, 'O.step in a loop': lambda: measured(stepByStep),
    'O.timingEnabled': lambda: measured(switch='timingEnabled'), 'O.trackEnergy': lambda: measured(switch='trackEnergy'),
    'PyRunner, every step, through all bodies': lambda: running('energyInPython()', 1),
    f'PyRunner, every {STEPS} steps, through all bodies': lambda: running('energyInPython()', STEPS),
    'PyRunner, every step, utils.kineticEnergy': lambda: running('utils.kineticEnergy()', 1)}


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


def run(n, order, rounds):
    """{variant: ms per step, one number for each round}, printed; the variants take turns."""
    build(n, order)
    O.run(30, True)
    found = {name: [] for name in VARIANTS}
    for _ in range(rounds):
        for name, measure in VARIANTS.items():
            found[name].append(measure())
    print(json.dumps(found), flush=True)


# --- the comparison ---------------------------------------------------------------------------------
def ratio(above, below):
    """Median of the ratios of turns."""
    return statistics.median(a / b for a, b in zip(above, below))


def table(runs):
    """Rows; `runs` are pairs of what the two orders gave."""
    random, curve = ({name: [x for pair in runs for x in pair[order][name]] for name in VARIANTS} for order in (0, 1))
    times = {**random, f'{BASE}, bodies in the order of the curve': curve[BASE]}
    return [{'a step': name, 'ms': measured_tables.digits(statistics.median(ms)), '×': f'{ratio(ms, random[BASE]):.2f}'}
            for name, ms in times.items()]


def main(arguments):
    """Parse, measure, write."""
    parser = measured_tables.parser('advice', __doc__)
    parser.add_argument('--n', type=int, default=20000)
    parser.add_argument('--rounds', type=int, default=5, help='turns in each yade; default: %(default)s')
    parser.add_argument('--repeat', type=int, default=2, help='yades for each order; default: %(default)s')
    options = parser.parse_args(arguments)
    runs = [[measured_tables.measuredBy(options, 'advice.py', 'run', options.n, order, options.rounds)
             for order in ('random', 'curve')] for _ in range(options.repeat)]
    measured_tables.publish(options, 'advice', table(runs),
                            f'{options.n:,} spheres, {measured_tables.origin.line()}, `scripts/bench advice`')


if __name__ == '__main__':
    if sys.argv[1:2] == ['run']:
        run(int(sys.argv[2]), sys.argv[3], int(sys.argv[4]))
    else:
        main(sys.argv[1:])
