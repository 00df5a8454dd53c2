"""Outlines for FESolver.addPolygon: lists of (x, y) in metres, counter-clockwise."""

import math
import numbers
import os

from yadefrag import _yadefrag

CIRCLE_POINTS = 64


def _pair(name, value):
    try:
        x, y = value
        pair = (float(x), float(y))
    except (TypeError, ValueError):
        raise ValueError('%s is %r, it must be a pair of numbers (x, y).' % (name, value)) from None
    if not all(map(math.isfinite, pair)):
        raise ValueError('%s is %r, both numbers must be finite.' % (name, value))
    return pair


def _length(name, value):
    try:
        length = float(value)
    except (TypeError, ValueError):
        raise ValueError('%s is %r, it must be a number of metres.' % (name, value)) from None
    if not (math.isfinite(length) and length > 0):
        raise ValueError('%s is %r m, it must be positive and finite.' % (name, value))
    return length


def _count(n):
    if n is None:
        return CIRCLE_POINTS
    if not isinstance(n, numbers.Integral) or isinstance(n, bool) or n < 3:
        raise ValueError('n is %r, it must be a whole number of at least 3 points.' % (n,))
    return int(n)


def rectangle(low, high):
    """The four corners of an upright rectangle from its lower left and upper right one (m).

    ValueError unless `high` is above and to the right of `low`.
    """
    left, bottom = _pair('low', low)
    right, top = _pair('high', high)
    if not (left < right and bottom < top):
        raise ValueError('high is %r, it must be above and to the right of low, which is %r.' %
                         (high, low))
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def circle(centre, radius, n=None):
    """`n` points (default 64) on a circle of `radius` (m), the first to the right of the centre.

    With `smooth=True`, addPolygon needs no more points than there are to be boundary nodes. A
    straight-sided circle is a polygon of n sides, whose long sides addPolygon divides without
    bulging them: take n of about 2π·radius/size or more. The polygon's area is less than the
    circle's, by 0.16 % for 64 points. Points closer than `size` make smaller triangles.
    ValueError for a radius that is not positive or fewer than 3 points.
    """
    x, y = _pair('centre', centre)
    radius = _length('radius', radius)
    n = _count(n)
    angles = [2 * math.pi * i / n for i in range(n)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def ring(centre, inner, outer, n=None):
    """(outline, holes) of a ring with the radii `inner` < `outer` (m), `n` points on each circle.

    As `circle` in all else: `fe.addPolygon(*ring((0, 0), .8, 1), size=.05, ...)`.
    """
    inner = _length('inner', inner)
    outer = _length('outer', outer)
    if not inner < outer:
        raise ValueError('inner is %g m, it must be less than outer, which is %g m.' %
                         (inner, outer))
    return circle(centre, outer, n), [circle(centre, inner, n)]


def readPolygon(file):
    """(outline, holes) from a text file: `x y` (m) on each line, an empty line between two loops.

    The first loop is the outline. `#` begins a comment, and a line with nothing but a comment is
    skipped. `file` is a path. ValueError with the file and the line for anything else; OSError with
    the path for a file that cannot be read.
    """
    if not isinstance(file, (str, os.PathLike)):
        raise ValueError('file is %r, it must be a path.' % (file,))
    with open(file, 'rb') as data:
        text = data.read()
    try:
        return _yadefrag.polygonOfText(text)
    except ValueError as error:
        raise ValueError('%s, %s' % (file, error)) from None
