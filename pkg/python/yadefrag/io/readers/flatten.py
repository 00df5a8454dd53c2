"""Points on curves, so many that the deviation of the polyline is within a tolerance.

The deviation of a polyline through n uniform parameters of a curve r(t), 0 ≤ t ≤ 1, is at most
max|r''|/(8n²).
"""

from __future__ import annotations

import math

import numpy
from numpy.typing import ArrayLike

MOST_POINTS = 10**6  # on one curve: a tolerance that needs more is a mistake


def count(bend: float, tolerance: float, least: int = 1) -> int:
    """Number of pieces for a curve whose second derivative is at most `bend`; ValueError for too many."""
    wanted = math.sqrt(bend / (8 * tolerance))
    if not wanted < MOST_POINTS:
        raise ValueError('tolerance needs more than %d points on one curve.' % MOST_POINTS)
    return max(least, math.ceil(wanted))


def bezier(points: ArrayLike, tolerance: float) -> numpy.ndarray:
    """(n, 2) points of a Bézier curve with 3 or 4 control points, without its first point."""
    points = numpy.asarray(points, dtype=float)
    degree = len(points) - 1
    bends = degree * (degree - 1) * numpy.linalg.norm(numpy.diff(points, n=2, axis=0), axis=1)
    pieces = count(bends.max(), tolerance)
    t = numpy.arange(1, pieces + 1)[:, None] / pieces
    parts = list(points)
    while len(parts) > 1:  # de Casteljau's scheme
        parts = [(1 - t) * a + t * b for a, b in zip(parts, parts[1:])]
    return parts[0]


def ellipticArc(centre: ArrayLike, axes: ArrayLike, start: float, sweep: float,
                tolerance: float) -> numpy.ndarray:
    """(n + 1, 2) points from the angle `start` over `sweep` (rad) on centre + a·cos + b·sin; `axes`
    are the vectors (a, b). At least eight pieces per turn."""
    a, b = numpy.asarray(axes, dtype=float)
    reach = math.hypot(numpy.linalg.norm(a), numpy.linalg.norm(b))
    if abs(a @ b) <= 1e-12 * (a @ a + b @ b):  # perpendicular, e.g. for circles: exact
        reach = float(max(numpy.linalg.norm(a), numpy.linalg.norm(b)))
    pieces = count(reach * sweep**2, tolerance, math.ceil(abs(sweep) / (math.pi / 4)))
    angles = start + sweep * numpy.arange(pieces + 1)[:, None] / max(pieces, 1)
    return numpy.asarray(centre, dtype=float) + a * numpy.cos(angles) + b * numpy.sin(angles)


def bulge(start: ArrayLike, end: ArrayLike, value: float, tolerance: float) -> numpy.ndarray:
    """(n, 2) points of the arc of a DXF bulge, tan(angle / 4), from `start` to `end`, without the first."""
    start, end = numpy.asarray(start, dtype=float), numpy.asarray(end, dtype=float)
    chord = end - start
    if value == 0 or not chord.any():
        return end[None]
    left = numpy.array([-chord[1], chord[0]])
    centre = (start + end) / 2 + left * (1 - value**2) / (4 * value)
    arm = start - centre
    points = ellipticArc(centre, (arm, (-arm[1], arm[0])), 0, 4 * math.atan(value), tolerance)[1:]
    points[-1] = end
    return points
