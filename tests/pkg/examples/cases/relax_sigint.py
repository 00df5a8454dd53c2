"""Ctrl-C while fe.relax runs. Expected: the first one ends it, in each of 20 tries.
    scripts/yade -n -x -j1 relax_sigint.py"""
import os
import signal
import threading
import time

from yadefrag import *

lost = 0
for k in range(20):
    O.reset()
    O.materials.append(FEMat(young=3.7e11, poisson=.22, density=3900, frictionAngle=.3, label='c'))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (.04, .02)), size=1e-3, material='c', velocity=lambda x, y: (x, y))
    O.engines = engines(fe)
    O.dt = .5 * fe.criticalTimeStep()
    sent, ended = [0], []

    def interrupt():
        time.sleep(.1 + .0137 * k)
        while not ended and sent[0] < 40:
            sent[0] += 1
            os.kill(os.getpid(), signal.SIGINT)
            for _ in range(10):
                if not ended:
                    time.sleep(.05)

    thread = threading.Thread(target=interrupt)
    thread.start()
    try:
        fe.relax(1e-300)
    except KeyboardInterrupt:
        pass
    ended.append(1)
    thread.join()
    lost += sent[0] > 1
print('first Ctrl-C lost in %d of 20' % lost)
os._exit(0 if lost == 0 else 1)
