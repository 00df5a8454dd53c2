"""A small scene with finite elements that goes through all of FESolver, for valgrind_scene.py."""
import os
import sys
import tempfile

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', '..', 'pkg', 'helpers')]

import fe_chain as chain
import yadefrag
import yade.wrapper as w

O = chain.O


def build():
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.2, label='m'))
    fe = w.FESolver()
    fe.addPolygon(yadefrag.circle((0, 0), .1, 12), size=.05, material='m', velocity=(2, 0),
                  smooth=True)
    fe.addPolygon(yadefrag.rectangle((.102, -.1), (.2, .1)), size=.05, material='m')
    ball = chain.ball((.15, .151), .05, O.materials['m'])
    ball.state.vel = (0, -1, 0)
    O.bodies.append(ball)
    chain.engines(w.LebesgueCollider([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()]))
    O.engines = [*O.engines[:3], fe, O.engines[3]]
    O.dt = .5 * fe.criticalTimeStep()
    return fe


def readAll(fe):
    for name in ('nodes', 'velocities', 'displacements', 'masses', 'triangles', 'stress',
                 'components', 'contactForces', 'surfaces', 'energy'):
        assert len(getattr(fe, name))
    return fe.fragments()


def refuse(fe):
    try:
        fe.addPolygon([(0, 0), (1, 1), (1, 0), (0, 1)], size=.1, material='m')
    except ValueError:
        return
    raise AssertionError('an outline that crosses itself was accepted')


def crack(finder):
    """A block that shatters: new bodies, bodies that go, saved in between."""
    O.reset()
    O.materials.append(w.BrittleFEMat(young=30e9, poisson=.2, density=2500, tensileStrength=20e6,
                                      frictionAngle=.2, strengthScatter=.1, label='b'))
    fe = w.FESolver(minFragmentArea=6e-6)
    fe.addPolygon(yadefrag.rectangle((0, 0), (.02, .012)), size=.003, material='b', smooth=True)
    fe.addPolygon(yadefrag.rectangle((.008, .0121), (.014, .018)), size=.003, material='b',
                  velocity=(0, -60))
    chain.engines(finder([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()]))
    O.engines = [*O.engines[:3], fe, O.engines[3]]
    O.dt = .5 * fe.criticalTimeStep()
    for _ in range(60):
        O.step()
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        O.save(os.path.join(folder, 'a.yade'))
        O.load(os.path.join(folder, 'a.yade'))
    fe = O.engines[3]
    for _ in range(60):
        O.step()
    readAll(fe)
    fe.fragments(held=True)
    assert fe.numCracks > 10 and fe.dropped['count'] > 0 and fe.fragmentOf.min() == -1
    fe.removeBody(0)
    O.step()


def main():
    build()
    for _ in range(60):
        O.step()
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        for name in ('a.xml', 'b.yade'):
            O.save(os.path.join(folder, name))
            O.load(os.path.join(folder, name))
            for _ in range(20):
                O.step()
    fe = O.engines[3]
    readAll(fe)
    refuse(fe)
    assert fe.numSearches > 0 and fe.energy['contact'] != 0
    fe.removeBody(0)
    O.step()
    fe.removeBody(1)
    O.step()
    for finder in (w.LebesgueCollider, w.InsertionSortCollider):
        crack(finder)
    O.reset()
