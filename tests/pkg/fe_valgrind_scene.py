"""A small scene with finite elements that goes through all of FESolver, for test_fe_valgrind.py."""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

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
    O.reset()
    print('\n@@@ done', flush=True)


main()
