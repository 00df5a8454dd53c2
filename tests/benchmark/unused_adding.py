"""Adds squares to an FESolver; of the last ones in each of two rows the instructions are counted.

    yade -n -x -j1 tests/benchmark/unused_adding.py COUNTING.so FEW MANY COUNTED

Prints a line of JSON for each row: the entries that were there before.
"""
import ctypes
import json
import sys

from yade import O
from yadefrag import FEMat, FESolver


def add(solver, material, number):
    """The number-th of a row of squares."""
    x = 1.2e-3 * number
    solver.addPolygon([(x, 0), (x + 1e-3, 0), (x + 1e-3, 1e-3), (x, 1e-3)], size=.25e-3,
                      material=material)


def run(counting, bodies, counted):
    """One line of JSON for one row."""
    O.reset()
    solver, material = FESolver(), FEMat(young=210e9, poisson=.3, density=7800)
    for k in range(bodies):
        add(solver, material, k)
    entries = len(O.bodies)
    counting.startCounting()
    for k in range(bodies, bodies + counted):
        add(solver, material, k)
    counting.stopCounting()
    print('@@@ ' + json.dumps(dict(entries=entries)), flush=True)


theCounting = ctypes.CDLL(sys.argv[1])
for theNumber in sys.argv[2:4]:
    run(theCounting, int(theNumber), int(sys.argv[4]))
