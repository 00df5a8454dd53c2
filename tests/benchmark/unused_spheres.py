"""Spheres in yade without the plugin, with the plugin imported, and with its collider.

    yade -n -x -j1 tests/benchmark/unused_spheres.py COUNTING.so SPHERES STEPS WAY...

WAY is absent, imported or used, in this order: what is imported stays so. Prints a line of JSON for
each: seconds of the steps and of the import, interactions, and the peak memory so far (bytes).
Under callgrind each way writes a file of its own (tests/instructions/counting.cpp).
"""
import ctypes
import json
import random
import re
import sys
import time

import yade.wrapper as w
from yade import O, utils


def build(spheres, collider):
    """A gas in which spheres meet; made by numbers that are the same in every run."""
    O.reset()
    O.dt = 1e-4
    numbers = random.Random(1)
    edge = 1.2 * spheres ** (1 / 3)
    for _ in range(spheres):
        O.bodies.append(utils.sphere([edge * numbers.random() for _ in 'xyz'], .5))
        O.bodies[-1].state.vel = [numbers.gauss(0, 1) for _ in 'xyz']
    O.engines = [w.ForceResetter(), collider([w.Bo1_Sphere_Aabb()]),
                 w.InteractionLoop([w.Ig2_Sphere_Sphere_ScGeom()],
                                   [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                                   [w.Law2_ScGeom_FrictPhys_CundallStrack()]),
                 w.NewtonIntegrator(damping=0)]


def run(way, counting, spheres, steps):
    """One line of JSON for one way."""
    start = time.perf_counter()
    if way != 'absent':
        import yadefrag
    importing = time.perf_counter() - start
    build(spheres, yadefrag.LebesgueCollider if way == 'used' else w.InsertionSortCollider)
    for _ in range(20):
        O.step()
    start = time.perf_counter()
    counting.startCounting()
    for _ in range(steps):
        O.step()
    counting.stopCounting()
    took = time.perf_counter() - start
    print('@@@ ' + json.dumps(dict(way=way, importing=importing, step=took / steps,
                                   real=O.interactions.countReal(), peak=peakMemory())), flush=True)


def peakMemory():
    """Of this process (bytes)."""
    with open('/proc/self/status', encoding='utf-8') as file:
        return 1024 * int(re.search(r'VmHWM:\s+(\d+)', file.read()).group(1))


for theWay in sys.argv[4:]:
    run(theWay, ctypes.CDLL(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
