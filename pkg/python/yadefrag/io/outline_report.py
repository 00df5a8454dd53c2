"""Effect of an outline's finest feature on the time step, before a mesh is made."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag.arguments import pointsOf, positive, refuse
from yadefrag.fe.materials import oneMaterial
from yadefrag.fe.simplify import simplified
from yadefrag.hints import ArrayLike, FEMat, File
from yadefrag.io.outlines import outlinesOf
from yadefrag.io.readers import leftOutWords
from yadefrag.libraries import shapely, treeOf

_MOST_PIECES = 1000  # of one side
_WORKS = 'outlineReport works'


def outlineReport(outline: ArrayLike | File, holes: Iterable[ArrayLike] = (), *, size: float,
                  material: FEMat | str | int, simplify: float | None = None,
                  **reading: Any) -> dict[str, Any]:
    """A dict with the effect of an outline's finest features on the time step; no mesh is made.

    outline, holes, simplify  as in addPolygon; or `outline` is the path of a file, of whose outlines the
              finest one is reported
    size      m, desired length of the triangles' edges
    material  an FEMat, its label or its number in O.materials
    reading   for a file: `tolerance`, `scale`, `gap`, `leastArea`, `layers` of readOutline
    points        number of points of the outline and the holes, after `simplify`
    shortestEdge  m; shortestEdgeAt: its middle (x, y)
    narrowest     m, least distance between a corner and a side that does not end there, through the
                  body or across a gap; narrowestAt: that corner
    finest        m, the smallest of `size` and both
    timeStep      s, critical time step of equilateral triangles with edges `finest`
    ratio         critical time step for `size` over timeStep: factor of the number of steps
    words         all this in one sentence
    outlines, leftOut  of a file: the number of outlines; and what is not read, as a dict {what: number}
    A mesh has triangles with such edges there, but of other shapes: its critical time step is
    between half and three times timeStep. ValueError as addPolygon and readOutline.
    """
    size = positive('size', size, 'm')
    material = oneMaterial(material)
    if isinstance(outline, (str, os.PathLike)):
        return _ofFile(outline, size, material, {**reading, 'simplify': simplify})
    if reading:
        raise TypeError('%s is given, but outline is not the path of a file.' % ', '.join(reading))
    points = pointsOf('outline', outline, 3)
    if isinstance(holes, (str, bytes, dict, set)) or not hasattr(holes, '__iter__'):
        refuse('holes', holes, 'a list of loops of points (x, y) in m')
    loops = [points] + [pointsOf('holes[%d]' % i, hole, 3) for i, hole in enumerate(holes)]
    if simplify is not None:
        points, fewer, _ = simplified(points, loops[1:], simplify, None)
        loops = [points, *fewer]
    return _report([loops], size, material)


def _ofFile(file, size, material, reading):
    if 'byLayer' in reading:
        raise TypeError('byLayer is given, but outlineReport reports on all layers, or on those of layers=.')
    shapes, leftOut = outlinesOf(file, **reading)
    report = _report([[numpy.array(loop) for loop in (outline, *holes)] for outline, holes in shapes],
                     size, material)
    report.update(outlines=len(shapes), leftOut=leftOut)
    if leftOut:
        report['words'] += ' The file is read without: %s.' % leftOutWords(leftOut)
    return report


def _report(shapes, size, material):
    """Of a list of lists of loops."""
    starts = numpy.concatenate([loop for loops in shapes for loop in loops])
    ends = numpy.concatenate([part for loops in shapes for loop in loops for part in (loop[1:], loop[:1])])
    lengths = numpy.linalg.norm(ends - starts, axis=1)
    shortest = int(lengths.argmin())
    narrowest, place = min((_narrowest(loops) for loops in shapes), key=lambda one: one[0])
    report = dict(points=len(starts), shortestEdge=float(lengths[shortest]),
                  shortestEdgeAt=tuple(((starts + ends) / 2)[shortest].tolist()),
                  narrowest=narrowest, narrowestAt=place)
    report['finest'] = finest = min(size, report['shortestEdge'], narrowest)
    if finest == 0:
        at = 'shortestEdgeAt' if report['shortestEdge'] == 0 else 'narrowestAt'
        raise ValueError('the outline touches itself at (%g, %g).' % report[at])
    report['timeStep'] = _yadefrag.latticeTimeStep(material.young, material.poisson,
                                                   material.density, material.planeStress, finest)
    report['ratio'] = size / finest
    report['words'] = _words(report, size)
    return report


def _narrowest(loops):
    """(least distance of a corner to a side that does not end there, the corner's place); infinite without such a
    pair. Of several the first corner."""
    starts = numpy.concatenate(loops)
    ends = numpy.concatenate([numpy.roll(loop, -1, axis=0) for loop in loops])

    def distances(corners, sides):
        arms, along = starts[corners] - starts[sides], ends[sides] - starts[sides]
        squares = numpy.maximum((along**2).sum(axis=1), numpy.finfo(float).tiny)
        parts = numpy.clip((arms * along).sum(axis=1) / squares, 0, 1)
        found = numpy.hypot(*(arms - parts[:, None] * along).T)
        found[(arms == 0).all(axis=1) | (starts[corners] == ends[sides]).all(axis=1)] = math.inf
        return found

    # The next sides but one are near: an upper bound, at most the shortest side.
    numbers = numpy.split(numpy.arange(len(starts)), numpy.cumsum([len(loop) for loop in loops])[:-1])
    most = min(distances(own, numpy.roll(own, -shift)).min() for own in numbers for shift in (1, 2, 3))
    if most == math.inf:
        return most, tuple(starts[0].tolist())
    # Pieces, because the box of a long oblique side would contain many corners.
    lengths = numpy.hypot(*(ends - starts).T)
    counts = numpy.clip(lengths / lengths.mean(), 1, _MOST_PIECES).astype(int)
    owners = numpy.repeat(numpy.arange(len(starts)), counts)
    place = (numpy.arange(len(owners)) - numpy.repeat(numpy.cumsum(counts) - counts, counts))[:, None]
    step = ((ends - starts) / counts[:, None])[owners]
    shapes = shapely('geometry', _WORKS)
    near = treeOf([shapes.LineString(piece) for piece in
                   numpy.stack([starts[owners] + place * step, starts[owners] + (place + 1) * step], axis=1)],
                  'query', _WORKS)
    found = [near(shapes.box(x - most, y - most, x + most, y + most)) for x, y in starts.tolist()]
    corners = numpy.repeat(numpy.arange(len(starts)), [len(those) for those in found])
    every = distances(corners, owners[numpy.concatenate(found).astype(int)])
    return float(every.min()), tuple(starts[corners[every.argmin()]].tolist())


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
