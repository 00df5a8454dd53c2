"""Prescribed motions of nodes: constant, by node, by tables in time, by functions, and rotations."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy

from yadefrag.arguments import (ArrayLike, FESolver, Nodes, array, atPlaces, flag, number, pair, real, refuse,
                                requireTakes)
from yadefrag.fe.contents import calledInStep, isBody, requireBetweenSteps
from yadefrag.messages import warn

_RIGHT = ('a finite number (m/s), an array of one for each of the nodes, a table of pairs (s, m/s), '
          'a function (x, y, t) or None')
_NONE = (), ()
_ROUNDING = 1e-9  # rounding of velocities that a script computes


def chosenNodes(fe: FESolver, nodes: Nodes) -> numpy.ndarray:
    """(k) node numbers from the argument `nodes` of FESolver.prescribe; ValueError if it is invalid, a
    warning if there are none."""
    places = fe.nodes
    chosen: Any
    if callable(nodes):
        chosen = numpy.array(atPlaces('nodes', nodes, places, flag), dtype=bool)
    elif isinstance(nodes, str):
        chosen = fe.nodesOf(nodes)
    else:
        chosen = array(nodes)
    if chosen is None:
        refuse('nodes', nodes, 'node numbers, a flag for each node, or a function (x, y)')
    if chosen.dtype == bool:
        if chosen.shape != (len(places),):
            raise ValueError('nodes has %d flags, it must have one for each of the %d nodes.' %
                             (chosen.size, len(places)))
        chosen = numpy.nonzero(chosen)[0]
    if chosen.ndim != 1 or (chosen.size and not numpy.issubdtype(chosen.dtype, numpy.integer)):
        raise ValueError('nodes must be node numbers, a flag for each node, or a function (x, y).')
    if chosen.size and (chosen.min() < 0 or chosen.max() >= len(places)):
        raise ValueError('nodes has numbers from %d to %d, but there are %d nodes.' %
                         (chosen.min(), chosen.max(), len(places)))
    if not len(chosen):
        warn('nodes selects none of the %d nodes%s.' % (len(places), ': a function gets the present positions; numbers '
             'from the start, numpy.flatnonzero(fe.nodes[:, 1] < 1e-9), stay with the nodes' * callable(nodes)))
    return chosen.astype(numpy.uint32)


def timeTable(value: Any) -> tuple[numpy.ndarray, numpy.ndarray] | None:
    """(times (k), values (k)) of a table of pairs; None for other types."""
    if callable(value) or isinstance(value, (str, bytes, dict, set)) or real(value) is not None:
        return None
    rows = array(value)
    if rows is None or rows.ndim != 2 or rows.shape[1] != 2 or not len(rows) or rows.dtype.kind not in 'iuf':
        return None
    times, values = rows.astype(float).T
    return times, values


def tableOrNumber(name: str, value: Any, unit: str) -> tuple[numpy.ndarray, numpy.ndarray]:
    """(times (k), values (k)) of a table of pairs; a number is a table of one row."""
    if real(value) is not None:
        one = number(name, value, math.isfinite, 'a finite number (%s)' % unit)
        return numpy.zeros(1), numpy.full(1, one)
    table = timeTable(value)
    if table is None:
        refuse(name, value, 'a finite number (%s) or a table of pairs (s, %s)' % (unit, unit))
    return table


def _motion(name, value, count):
    """None, a function, an array (count), or a table: (times, values)."""
    if value is None:
        return None
    if callable(value):
        requireTakes(name, value, 'x', 'y', 't')
        return value
    if real(value) is not None:
        return numpy.full(count, number(name, value, math.isfinite, _RIGHT))
    table = timeTable(value)
    if table is not None:
        return table
    each = array(value)
    if each is None or each.ndim != 1 or each.dtype.kind not in 'iuf':
        refuse(name, value, _RIGHT)
    if len(each) != count:
        raise ValueError('%s has %d values, it must have one for each of the %d nodes.' % (name, len(each), count))
    return each.astype(float)


def prescribe(self: FESolver, nodes: Nodes, vx: ArrayLike | Callable[[float, float, float], float] | None = None,
              vy: ArrayLike | Callable[[float, float, float], float] | None = None) -> None:
    """Prescribes the nodes' velocities vx, vy (m/s) from now on; None: free in that direction.

    nodes   node numbers, a flag for each node, a function (x, y) → bool of the present positions,
            or a body's name
    vx, vy  a number; an array with one for each of `nodes`, in their order; a table [(s, m/s), …],
            linear between its times and constant outside, whose exact integral is the nodes'
            displacement; or a function (x, y, t) of the nodes' present positions (m) and the middle of
            the step (s), called for each node in each step
    Times are fe.time. New nodes of cracks move as the nodes from which they were split. Call it
    again to change the motion; the required forces are in `reactions`, their work in
    `energy['external']`. A saved scene contains everything except functions: the first step after
    O.load raises RuntimeError until prescribe has been called for their nodes again. ValueError
    before any change, also for an array with a table or a function in the other direction; a
    warning if no node is chosen.
    """
    requireBetweenSteps()
    chosen = chosenNodes(self, nodes)
    given = dict(vx=vx, vy=vy)
    motions = {name: _motion(name, value, len(chosen)) for name, value in given.items()}
    held = (vx is not None) + 2 * (vy is not None)
    if not any(callable(one) or isinstance(one, tuple) for one in motions.values()):
        none = numpy.zeros(len(chosen))
        self._prescribe(chosen, held, numpy.column_stack([none if one is None else one for one in motions.values()]))
        return
    for name, value in given.items():
        if isinstance(motions[name], numpy.ndarray):
            if real(value) is None:
                raise ValueError('%s is an array, but the other direction is not: give arrays or numbers '
                                 'for both, or neither.' % name)
            motions[name] = tableOrNumber('v', value, 'm/s')
    _move(self, chosen, held, (0., 0.), **motions)


def _move(fe, chosen, held, centre, vx=None, vy=None, turn=_NONE):
    speeds = [one if isinstance(one, tuple) else _NONE for one in (vx, vy)]
    function = _velocities(vx, vy) if callable(vx) or callable(vy) else None
    fe._move(chosen, held, centre, *speeds, turn, function)


def _velocities(vx, vy):
    """The function that FESolver calls in each step: (positions (k, 2), time) → (k, 2) m/s."""
    def column(name, motion, places, time):
        if callable(motion):
            return [number('%s(%g, %g, %g)' % (name, x, y, time), motion(float(x), float(y), time),
                           math.isfinite, 'a finite number (m/s)') for x, y in places]
        return numpy.full(len(places), 0. if motion is None else numpy.interp(time, *motion))

    @calledInStep
    def velocities(places, time):
        return numpy.column_stack([column('vx', vx, places, time), column('vy', vy, places, time)])
    return velocities


def rotate(self: FESolver, nodes: int | Nodes, omega: ArrayLike, centre: ArrayLike) -> None:
    """Rotates the nodes at `omega` about `centre` from now on, exactly: after any number of steps
    they are on their circles, except for rounding.

    nodes   as in `prescribe`, or a body's number or name: the whole body
    omega   rad/s, counter-clockwise, or a table [(s, rad/s), …] as in `prescribe`
    centre  (x, y) in m
    ValueError before any change. A saved scene contains the motion; a later `prescribe` or `rotate`
    ends it.
    """
    requireBetweenSteps()
    chosen = self.nodesOf(nodes) if isBody(nodes) else chosenNodes(self, nodes)
    turn = tableOrNumber('omega', omega, 'rad/s')
    _move(self, chosen, 3, pair('centre', centre), turn=turn)


def keepTurning(fe: FESolver, component: int, held: numpy.ndarray, velocity: numpy.ndarray, spin: float,
                places: numpy.ndarray, centroid: numpy.ndarray) -> None:
    """Held nodes of a new body with the velocities of a rotating rigid body continue to rotate.

    velocity  without that of `spin` about `centroid`
    """
    fixed = numpy.nonzero(held == 3)[0] if len(held) else held
    if not len(fixed):
        return
    rigid = _rigidMotion(places[fixed], velocity[fixed])
    arms = places[fixed] - places[fixed].mean(axis=0)
    spread = numpy.linalg.eigvalsh(arms.T @ arms)
    if rigid is None or spread[0] <= _ROUNDING * spread[1]:  # the nodes of a line may rotate in a sheared body
        rigid = _rigidMotion(places, velocity)
    if rigid is None:
        return
    middle, speed, turn = rigid
    total = turn + spin
    if not total:
        return
    if not turn:
        centre, drift = centroid, speed  # a moving body that rotates about its centroid
    else:
        # The velocity at a position p is `origin` + total × p: 0 at the centre.
        x, y = turn * middle + spin * centroid
        origin = speed + numpy.array([y, -x])
        centre, drift = numpy.array([-origin[1], origin[0]]) / total, numpy.zeros(2)
    # Open joints have doubled nodes, which come after all others.
    own = fe.nodesOf(component)
    present = fe.nodes[own]
    heldPlaces = set(map(tuple, present[fixed].tolist()))
    doubled = [i for i in range(len(places), len(own)) if tuple(present[i].tolist()) in heldPlaces]
    chosen = own[numpy.concatenate([fixed, doubled]).astype(int)].astype(numpy.uint32)
    vx, vy = (tableOrNumber('velocity', float(one), 'm/s') for one in drift)
    _move(fe, chosen, 3, tuple(map(float, centre)), vx, vy, tableOrNumber('spin', float(total), 'rad/s'))


def _rigidMotion(places, velocity):
    """(centre (m), its velocity (m/s), rad/s) of a rigid-body motion; None if it is none."""
    middle, speed = places.mean(axis=0), velocity.mean(axis=0)
    arms = places - middle
    moment = (arms**2).sum()
    turn = (arms[:, 0] * velocity[:, 1] - arms[:, 1] * velocity[:, 0]).sum() / moment if moment else 0
    most = abs(velocity).max()
    if abs(turn) * math.sqrt(moment) <= _ROUNDING * most:
        turn = 0
    wrong = speed + turn * numpy.stack([-arms[:, 1], arms[:, 0]], axis=1) - velocity
    return (middle, speed, turn) if abs(wrong).max() <= _ROUNDING * most else None
