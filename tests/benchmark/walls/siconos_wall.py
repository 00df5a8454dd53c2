"""A wall of blocks in Siconos (Moreau–Jean time stepping, NSGS): siconos_wall.py BLOCKS STEPS TOLERANCE

Run by scripts/bench walls, with Debian's Python, in a folder of its own. Unit cubes in place of the
plane blocks: Siconos' collision detection is Bullet's, in space. Siconos prints the time and the contacts
of each step itself.
"""
import sys

import siconos.kernel
import siconos.numerics as numerics
from siconos.io.mechanics_run import MechanicsHdf5Runner
from siconos.mechanics.collision.tools import Contactor

FILE, STEP = 'wall.hdf5', 5e-3  # s


def build(blocks):
    """Store the scene: `blocks` rows of as many cubes on a floor, friction 0.5."""
    with MechanicsHdf5Runner(io_filename=FILE) as io:
        io.add_primitive_shape('block', 'Box', (1, 1, 1), insideMargin=0., outsideMargin=0.)
        io.add_primitive_shape('floor', 'Box', (4 * blocks, 4, 1), insideMargin=0., outsideMargin=0.)
        io.add_Newton_impact_friction_nsl('contact', mu=.5, e=0)
        io.add_object('floor', [Contactor('floor')], translation=[0, 0, -.5])
        for row in range(blocks):
            for column in range(blocks):
                io.add_object(f'{row} {column}', [Contactor('block')], mass=2500., inertia=[2500 / 6] * 3,
                              translation=[column - (blocks - 1) / 2, 0, row + .5])


def run(steps, tolerance):
    """Do the steps."""
    options = siconos.kernel.solver_options_create(numerics.SICONOS_FRICTION_3D_NSGS)
    options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = 1000
    options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
    with MechanicsHdf5Runner(mode='r+', io_filename=FILE) as io:
        io.run(t0=0, T=steps * STEP, h=STEP, theta=.5, Newton_max_iter=1, solver_options=options,
               output_frequency=None, with_timer=True)


def main(arguments):
    """Run the scene."""
    blocks, steps, tolerance = int(arguments[0]), int(arguments[1]), float(arguments[2])
    build(blocks)
    run(steps, tolerance)


if __name__ == '__main__':
    main(sys.argv[1:])
