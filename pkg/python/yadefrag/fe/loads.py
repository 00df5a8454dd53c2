"""Loads on the boundary that depend on its shape, and relaxation to a state of rest."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable

import numpy

from yade import wrapper
from yadefrag.arguments import (ArrayLike, FESolver, Nodes, array, flag, number, positive, refuse, requireTakes,
                                shown, whole)
from yadefrag.fe.contents import betweenSteps, calledInStep, requireBetweenSteps
from yadefrag.fe.motions import chosenNodes, tableOrNumber
from yadefrag.messages import warn
from yadefrag.scene.lifecycle import requireNoStep, runPart, wholeSteps

_LOOK = 25  # steps from one evaluation of the motion to the next
_DAMPING = .4  # of NewtonIntegrator, while spheres come to rest
_FALLS = .1  # of gravity: a body of YADE with a larger mean acceleration is not at rest


def getLoads(self: FESolver) -> numpy.ndarray:
    """Constant external forces on the nodes (N), array (n, 2); set the whole array, or None for no
    forces.

    A copy: `loads = fe.loads; loads[top] = (0, -1); fe.loads = loads`. ValueError unless there is
    one finite pair for each node.
    """
    return self._loads


def setLoads(self: FESolver, loads: ArrayLike | None) -> None:
    requireBetweenSteps()
    forces = numpy.zeros((0, 2)) if loads is None else array(loads, float)
    if forces is None:
        refuse('loads', loads, 'an array (n, 2) of N, or None')
    if forces.ndim != 2 or forces.shape[1] != 2:
        raise ValueError('loads has the shape %s, it must be (n, 2).' % shown(forces.shape))
    self._setLoads(forces)


def pressure(self: FESolver, nodes: Nodes, p: ArrayLike | Callable[[float], float], intoCracks: bool = False) -> None:
    """Applies a pressure, from now on, to the sides of the boundary whose two ends are among
    `nodes`.

    nodes  as in `prescribe`: node numbers, flags, a function (x, y) of the present positions, or a
           body's name for all of its boundary
    p      Pa, towards the body: a number, a table [(s, Pa), …] linear between its times and constant
           outside, or a function (t) → Pa; times are fe.time. 0 ends it
    intoCracks  False: no pressure on new faces of cracks; True: full pressure also on faces of cracks
           that open after this call, as soon as they are connected with a side under this pressure
           and are not cohesive any more: the gas of a blast
    The pressure acts along the present normal, on the present length, half at both ends of a side: it
    turns with the surface, and follows it where nodes split. A later pressure on the same side
    replaces an earlier one. Its work is in `energy['external']`. A saved scene contains numbers and
    tables; with a function the first step after O.load raises RuntimeError until pressure has been
    called for these nodes again. ValueError before any change, also if no side has both ends among
    the nodes.
    """
    requireBetweenSteps()
    intoCracks = flag('intoCracks', intoCracks)
    chosen = chosenNodes(self, nodes)
    if callable(p):
        requireTakes('p', p, 't')
        function: Callable[[float], float] = p

        @calledInStep
        def value(time):
            return number('p(%g)' % time, function(time), math.isfinite, 'a finite number (Pa)')
        self._pressure(chosen, (), (), value, intoCracks)
        return
    self._pressure(chosen, *tableOrNumber('p', p, 'Pa'), None, intoCracks)


def absorb(self: FESolver, nodes: Nodes) -> None:
    """Absorbs waves, from now on, at the sides of the boundary whose two ends are among `nodes`.

    nodes  as in `prescribe`
    Dashpots ρc at the nodes (Lysmer and Kuhlemeyer 1969, J. Eng. Mech. Div. 95, 859), with the speed
    of compression waves across the boundary and that of shear waves along it: waves at normal
    incidence are absorbed completely, oblique ones are partly reflected. Dashpots carry no static
    load: a body that is pushed drifts. Their dissipated energy is in `energy['damping']`. Each side
    has the density and speeds of the triangle behind it. ValueError before any change.
    """
    requireBetweenSteps()
    self._absorb(chosenNodes(self, nodes))


def relax(self: FESolver, tolerance: float = 1e-6, most: int = 10**6) -> int:
    """Runs the scene until its bodies are at rest, and YADE's that obey forces; returns the number of
    steps (int).

    tolerance  criterion of rest: the kinetic energy of all bodies is below this fraction of the elastic
               energy, of strain and of contacts, at two successive evaluations, 25 steps apart, and no
               body of YADE falls
    most       maximum number of steps; after these a warning reports the ratio of energies
    Damping is set anew at each evaluation, so that the slowest vibration in the motion is critically
    damped, by its Rayleigh quotient (Underwood 1983, Computational Methods for Transient Analysis,
    p. 245); if YADE's bodies are spheres and clumps of spheres, NewtonIntegrator has a damping of at
    least 0.4. Afterwards both have their previous values. Call it between runs, with O.dt set.
    RuntimeError and KeyboardInterrupt as from runSteps.
    """
    tolerance = positive('tolerance', tolerance, 'a ratio of energies')
    most = whole('most', most)
    requireNoStep('relax')
    before, begin = self.damping, wrapper.Omega().iter
    movers = [(one, one.damping) for one in wrapper.Omega().engines if isinstance(one, wrapper.NewtonIntegrator)]
    try:
        if _areSpheres(_freeBodies()):
            for mover, damping in movers:
                mover.damping = max(damping, _DAMPING)
        with wholeSteps():
            calm, ratio = _damped(self, tolerance, most)
    except KeyboardInterrupt:
        print('relax: stopped after %d steps.' % (wrapper.Omega().iter - begin), file=sys.stderr)
        raise
    finally:
        self.damping = before
        for mover, damping in movers:
            mover.damping = damping
    done = wrapper.Omega().iter - begin
    if calm < 2:
        warn('relax: after %d steps the kinetic energy is still %.3g of the elastic energy%s.' %
             (done, ratio, ', with that of %d bodies of YADE' % len(_freeBodies()) if _freeBodies() else ''))
    return done


def _freeBodies():
    """YADE's bodies that obey forces."""
    return [body for body in wrapper.Omega().bodies if not body.isClumpMember and body.dynamic
            and not isinstance(body.shape, wrapper.SurfaceSegment)]


def _areSpheres(bodies):
    shapes = wrapper.Omega().bodies
    members = [shapes[number].shape for body in bodies if body.isClump for number in body.shape.members]
    return bool(bodies) and all(isinstance(one, wrapper.Sphere) for one in members + [
        body.shape for body in bodies if not body.isClump])


def _velocitiesAndEnergy(bodies):
    """((n, 3) m/s, kinetic energy (J)) of bodies of YADE."""
    states = [body.state for body in bodies]
    moving = numpy.array([state.vel for state in states]).reshape(-1, 3)
    turning = numpy.array([state.angVel for state in states]).reshape(-1, 3)
    masses, inertia = [state.mass for state in states], [state.inertia for state in states]
    twice = (numpy.array(masses)[:, None] * moving**2).sum() + (
        numpy.array(inertia).reshape(-1, 3) * turning**2).sum()
    return moving, twice / 2


def _contactEnergy():
    """(J) Elastic energy of the contacts of YADE's laws that have it."""
    laws = [law for loop in wrapper.Omega().engines if isinstance(loop, wrapper.InteractionLoop)
            for law in loop.lawDispatcher.functors]
    return sum(law.elasticEnergy() for law in laws if hasattr(law, 'elasticEnergy'))


def _damped(fe, tolerance, most):
    """Runs to rest; returns the number of successive evaluations at rest, and the last ratio of energies."""
    done, calm, ratio = 0, 0, math.inf
    speeds, _ = _velocitiesAndEnergy(_freeBodies())
    while done < most and calm < 2:
        wanted = min(_LOOK, most - done)
        part, _ = runPart(wanted)
        done += part
        if part < wanted:
            break  # O.pause()
        energy, former = fe.energy, speeds
        speeds, ofBodies = _velocitiesAndEnergy(_freeBodies())
        kinetic, elastic = energy['kinetic'] + ofBodies, energy['strain'] + _contactEnergy()
        ratio = kinetic / elastic if elastic > 0 else math.inf
        isRounding = kinetic <= fe._energyBalance.rounding  # nothing else without loads
        calm = calm + 1 if (ratio <= tolerance or isRounding) and not _anyFalls(former, speeds, part) else 0
        fe.damping, part = _critical(fe)
        done += part
    return calm, ratio


def _anyFalls(before, after, steps):
    """True if gravity has accelerated one of YADE's bodies, which then has no support."""
    omega = wrapper.Omega()
    pulls = [numpy.linalg.norm(one.gravity) for one in omega.engines if isinstance(one, wrapper.NewtonIntegrator)]
    most = _FALLS * max(pulls, default=0) * steps * omega.dt
    return len(before) == len(after) and len(after) > 0 and most > 0 and bool(
        (numpy.linalg.norm(after - before, axis=1) > most).any())


def _critical(fe):
    """(damping (1/s), number of steps): critical for the present motion, from three steps: twice the
    angular frequency of the motion's Rayleigh quotient. The present damping if there is no motion."""
    present, speeds = fe.damping, []
    for step in range(3):
        if runPart(1)[0] == 0:
            return present, step
        with betweenSteps(fe):
            speeds.append(fe.velocities)
            free, masses = ~fe.reactions.any(axis=1), fe.masses
    if len(speeds[0]) != len(speeds[2]):
        return present, 3  # cracks opened meanwhile
    dt = wrapper.Omega().dt
    first, middle, last = (numpy.where(free[:, None], v, 0) for v in speeds)
    moving = (masses * (middle**2).sum(axis=1)).sum()
    # M j = -K v - αM a: without the damping term, the jerk is due to the stiffness.
    pull = (last - 2 * middle + first) / dt**2 + present * (last - first) / (2 * dt)
    squared = -(masses * (middle * pull).sum(axis=1)).sum()
    # Above 1/Δt one step would already stop all motion.
    return (min(2 * math.sqrt(squared / moving), 1 / dt) if moving > 0 < squared else present), 3
