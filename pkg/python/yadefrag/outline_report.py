"""Effect of an outline's finest feature on the time step, before a mesh is made."""

import math

import numpy

from yadefrag import _yadefrag
from yadefrag.materials import oneMaterial
from yadefrag.meshing import simplified
from yadefrag.values import pointsOf, positive, refuse

_CHUNK = 2 * 10**6  # pairs of a point and an edge per block


def outlineReport(outline, holes=(), *, size, material, simplify=None):
    """A dict with the effect of an outline's finest features on the time step; no mesh is made.

    outline, holes, simplify  as in addPolygon
    size      m, desired length of the triangles' edges
    material  an FEMat, its label or its number in O.materials
    points        number of points of the outline and the holes, after `simplify`
    shortestEdge  m; shortestEdgeAt: its middle (x, y)
    narrowest     m, least distance between a corner and a side that does not end there, through the
                  body or across a gap; narrowestAt: that corner
    finest        m, the smallest of `size` and both
    timeStep      s, critical time step of equilateral triangles with edges `finest`
    ratio         critical time step for `size` over timeStep: factor of the number of steps
    words         all this in one sentence
    A mesh has triangles with such edges there, but of other shapes: its critical time step is
    between half and three times timeStep. ValueError as addPolygon.
    """
    points = pointsOf('outline', outline, 3)
    size = positive('size', size, 'm')
    material = oneMaterial(material)
    if isinstance(holes, (str, bytes, dict, set)) or not hasattr(holes, '__iter__'):
        refuse('holes', holes, 'a list of loops of points (x, y) in m')
    loops = [points] + [pointsOf('holes[%d]' % i, hole, 3) for i, hole in enumerate(holes)]
    if simplify is not None:
        outline, holes, _ = simplified(points, loops[1:], simplify, None)
        loops = [outline, *holes]
    starts = numpy.concatenate(loops)
    ends = numpy.concatenate([numpy.roll(loop, -1, axis=0) for loop in loops])
    lengths = numpy.linalg.norm(ends - starts, axis=1)
    shortest = int(lengths.argmin())
    narrowest, corner = _narrowest(starts, ends)
    report = dict(points=len(starts), shortestEdge=float(lengths[shortest]),
                  shortestEdgeAt=tuple(((starts + ends) / 2)[shortest].tolist()),
                  narrowest=narrowest, narrowestAt=tuple(starts[corner].tolist()))
    report['finest'] = finest = min(size, report['shortestEdge'], narrowest)
    if finest == 0:
        at = 'shortestEdgeAt' if report['shortestEdge'] == 0 else 'narrowestAt'
        raise ValueError('the outline touches itself at (%g, %g).' % report[at])
    report['timeStep'] = _yadefrag.latticeTimeStep(material.young, material.poisson,
                                                   material.density, material.planeStress, finest)
    report['ratio'] = size / finest
    report['words'] = _words(report, size)
    return report


def _narrowest(starts, ends):
    """(least distance of a corner to a side that does not end there, number of the corner)."""
    sides = ends - starts
    squares = (sides**2).sum(axis=1)
    least, corner = math.inf, 0
    part = max(1, _CHUNK // len(starts))
    for first in range(0, len(starts), part):
        points = starts[first:first + part, None]
        arms = points - starts
        along = numpy.clip((arms * sides).sum(axis=2) / numpy.maximum(squares, 1e-300), 0, 1)
        distance = numpy.linalg.norm(arms - along[:, :, None] * sides, axis=2)
        own = (points == starts).all(axis=2) | (points == ends).all(axis=2)
        distance[own] = math.inf
        nearest = int(distance.min(axis=1).argmin())
        if distance[nearest].min() < least:
            least, corner = float(distance[nearest].min()), first + nearest
    return least, corner


def _words(report, size):
    if report['finest'] == size:
        return ('%d points, no edge and no gap finer than the size %.4g m: the critical step is '
                'about %.3g s.' % (report['points'], size, report['timeStep']))
    if report['shortestEdge'] <= report['narrowest']:
        what, (x, y) = 'an edge of %.3g m', report['shortestEdgeAt']
    else:
        what, (x, y) = 'a width of %.3g m', report['narrowestAt']
    return ('%d points, of which %s at (%.6g, %.6g) makes the critical step about %.3g s, %.3g times '
            'shorter than triangles of the size %.4g m.' %
            (report['points'], what % report['finest'], x, y, report['timeStep'], report['ratio'],
             size))
