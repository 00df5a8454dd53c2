"""A scene of FESolver inside yade, read and changed while it runs: for scripts/check tsan.

The simulation's thread and Python's share what StepLock guards. One OpenMP thread: libgomp's
barriers are unknown to the sanitizer; yadefrag_races has the threads of lib/.
"""
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', 'pkg', 'helpers'))
import yadefrag  # noqa: E402
from fe_scene import brittle, brittleImpact, heapSpheres  # noqa: E402

kSquare = yadefrag.rectangle((2, 2), (2.01, 2.01))


def readAndChange(solver, folder):
    for k in range(20):
        yadefrag.fragmentTable(solver)
        yadefrag.exportVTK(solver, os.path.join(folder, 'a.vtu'))
        solver.damping = .1 * k
        solver.nodes, solver.stress, solver.fragments(), solver.energy, solver.warnings
        solver.criticalTimeStep()
        if k % 5 == 4:
            O.save(os.path.join(folder, 'a.yade'))


def main(folder):
    solver = brittleImpact('LebesgueCollider', threads=1, fractureEnergy=0, strengthScatter=.1)
    heapSpheres()
    yadefrag.runSteps(100)
    O.run()
    readAndChange(solver, folder)
    O.pause()
    solver.removeBody(solver.addPolygon(kSquare, size=.005, material=brittle()))
    yadefrag.runSteps(20)
    assert solver.numCracks > 0


with tempfile.TemporaryDirectory() as place:
    main(place)
