"""test_memory.py: builds, cracks, saves, loads, removes and adds for some seconds.

Prints a line of JSON: rounds, cracks, and the memory in use after each round (kB).
"""
import ctypes
import gc
import json
import os
import random
import sys
import tempfile
import time

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', '..', 'pkg', 'helpers')]
import yadefrag  # noqa: E402
from fe_impact import brittle, heapSpheres, impact  # noqa: E402
from yade import wrapper as w  # noqa: E402

kColliders = (None, 'LebesgueCollider', 'HierarchyCollider', 'InsertionSortCollider')
kSquare = yadefrag.rectangle((2, 2), (2.01, 2.01))


def memory():
    """kB in use, once all that is free has gone back to the system."""
    gc.collect()
    ctypes.CDLL('libc.so.6').malloc_trim(0)
    with open('/proc/self/status') as status:
        return next(int(line.split()[1]) for line in status if line.startswith('VmRSS'))


def theSolver():
    return next(engine for engine in O.engines if isinstance(engine, w.FESolver))


def cycle(number, folder, draw):
    """One scene from its beginning to its end; returns its number of cracks."""
    O.reset()
    finder = kColliders[number % len(kColliders)]
    solver = impact(finder, threads=1 + number % 2, fractureEnergy=0, strengthScatter=.1)
    if finder and draw.random() < .5:
        heapSpheres()
    solver.minFragmentArea = draw.choice((0, 4e-6))
    yadefrag.runSteps(130)
    path = os.path.join(folder, draw.choice(('a.yade', 'a.yade.gz', 'a.xml')))
    record = yadefrag.recordFracture(solver, os.path.join(folder, 'a.csv'))
    O.run()
    for _ in range(4):  # of a scene that runs
        yadefrag.fragmentTable(solver)
        solver.damping = draw.random()
        record()
        yadefrag.exportVTK(solver, os.path.join(folder, 'a.vtu'))
    O.save(path)
    added = draw.random() < .5
    O.pause()
    if added:
        number = solver.addPolygon(kSquare, size=.005, material=brittle())
        yadefrag.runSteps(5)
        solver.removeBody(number)
    yadefrag.runSteps(20)
    O.load(path)
    solver = theSolver()
    yadefrag.runSteps(20)
    solver.removeBody(0)
    yadefrag.runSteps(5)
    cracks = solver.numCracks
    O.saveTmp()
    O.loadTmp()
    return cracks


def main(seconds):
    draw = random.Random(1)
    end = time.time() + seconds
    cracks, used = [], []
    with tempfile.TemporaryDirectory() as folder:
        while time.time() < end or len(used) < 3 * len(kColliders):
            cracks.append(cycle(len(used), folder, draw))
            O.reset()
            used.append(memory())
    print('@@@ ' + json.dumps(dict(cracks=cracks, memory=used)), flush=True)


main(float(sys.argv[1]))
