"""Outlines from files of other programs, for FESolver.addPolygon; the effect of their finest feature on the time
step."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable
from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag.arguments import (ArrayLike, FEMat, File, Shape, flag, listOf, number, path, pointsOf, positive, refuse,
                                shown, shownPath)
from yadefrag.fe.geometry import holesOf, simplified
from yadefrag.fe.mesh_values import oneMaterial
from yadefrag.io.readers import Found, dxf, leftOutWords, loops, plain, svg
from yadefrag.messages import shapely, treeOf, warn

_GAP = 1e-6  # of the longer side of the drawing: drawings have six digits
_FLAT = 1e-12  # of the square of its extent: the area of a loop that is a line
_READERS: dict[str, Callable] = {
    '.svg': svg.read, '.dxf': dxf.readLayers, '.csv': plain.readCsv, '.wkt': plain.readWkt, '.json': plain.readGeoJson,
    '.geojson': plain.readGeoJson, **{ending: plain.readPicture for ending in plain.ENDINGS}}
_WORKS = 'outlineReport works'


def readOutline(file: File, tolerance: float | None = None, scale: float = 1, gap: float | None = None,
                simplify: float | None = None, leastArea: float = 0., layers: str | Iterable[str] | None = None,
                byLayer: bool = False) -> list[Shape] | dict[str, list[Shape]]:
    """Outlines from a drawing, a map or a picture: list of (outline, holes), as for addPolygon.

    `for shape in readOutline('plate.svg', 1e-5, scale=1e-3): fe.addPolygon(*shape, size=...)`.
    file       its ending determines the format:
               .svg      paths and basic shapes that are painted, with styles, transforms and clipping;
                         a filled shape is a region by its fill rule, any other one a line; in units of
                         the viewBox, y upwards, so that the page is below the origin
               .dxf      lines, polylines with bulges, arcs, circles, ellipses, splines of the model
                         space, also in blocks, seen from above; layers may be chosen
               .geojson, .json, .wkt  polygons, and closed lines; one text, or several, e.g. one on
                         each line
               .csv      `x, y` on each line, an empty line between two loops, # before comments, one
                         heading without numbers
               .png, .jpg, .jpeg, .bmp, .tif, .tiff  areas darker than middle grey; transparent areas
                         count as white; in pixels from the lower left corner of the upright picture
    tolerance  m, permitted deviation of outlines: curves get so many points that the chords are
               within it (for splines in .dxf: at the chords' middles), and the contour of a picture
               is reduced as by `simplify`. Not needed for files without curves
    scale      m for one unit of the file
    gap        m, distance below which two points coincide and two ends of lines are joined; None: 10⁻⁶
               of the longer side of the drawing
    simplify   None, or m: as in addPolygon, on what has been read
    leastArea  m²: smaller loops, e.g. specks in a picture, are left out
    layers     of a .dxf: None: all that are neither off nor frozen; or the name of one or a list of
               names: only those, even if they are off
    byLayer    of a .dxf: True returns a dict {layer: list of (outline, holes)} instead of the list;
               lines are joined, and loops are holes, within their own layer only
    What is read is what the usual viewer shows. A warning gives the number of what is left out: what
    the file contains and a viewer hides, and what a viewer shows and is no outline, such as texts.
    Points inside an odd number of regions are inside: a loop within an outline is a hole, one within
    a hole is a separate outline, also if it fills the hole. What is drawn twice is read once. All are
    counter-clockwise lists of (x, y) in m. ValueError with
    the file for an unknown format, for lines that are not closed and for a missing tolerance;
    ImportError with the name of Debian's package if a library is missing (svgelements,
    cssselect2, ezdxf, shapely, scikit-image); OSError for a file that cannot be read.
    """
    found, leftOut = outlinesOf(file, tolerance, scale, gap, simplify, leastArea, layers, byLayer)
    if leftOut:
        warn('readOutline: %s is read without: %s.' % (shownPath(os.fspath(file)), leftOutWords(leftOut)))
    return found


def readPolygon(file: File) -> Shape:
    """(outline, holes) from a text file: `x y` (m) on each line, an empty line between two loops.

    The first loop is the outline. `#` begins a comment, and a line with only a comment is skipped.
    `file` is a path. ValueError with the file and the line for anything else; OSError with the path
    for a file that cannot be read.
    """
    name = path('file', file)
    loops = plain.loopsOf(name, str.split, False)
    if not loops:
        raise ValueError('%s, line 1: no points, a line must hold x and y in metres.' % shownPath(name))
    return loops[0], loops[1:]


def outlinesOf(file: File, tolerance: float | None = None, scale: float = 1, gap: float | None = None,
               simplify: float | None = None, leastArea: float = 0., layers: str | Iterable[str] | None = None,
               byLayer: bool = False) -> tuple[Any, dict[str, int]]:
    """(what readOutline returns, {what is left out: number})."""
    name = path('file', file)
    ending = os.path.splitext(name)[1].lower()
    if ending not in _READERS:
        raise ValueError('file ends with %r, an outline can be read from one of %s.' %
                         (ending[:20], ', '.join(_READERS)))
    scale = positive('scale', scale, 'm per unit of the file')
    tolerance = None if tolerance is None else positive('tolerance', tolerance, 'm')
    gap = None if gap is None else positive('gap', gap, 'm')
    simplify = None if simplify is None else positive('simplify', simplify, 'm')
    leastArea = number('leastArea', leastArea, lambda v: 0 <= v < math.inf, '0 or a positive number (m²)')
    byLayer = flag('byLayer', byLayer)
    if ending != '.dxf' and (byLayer or layers is not None):
        raise ValueError('layers or byLayer is given, but %s has no layers: only a .dxf file has.' % shownPath(name))
    wanted = None if layers is None else _names(layers)
    with open(name, 'rb'):  # OSError, before a library raises another exception
        pass
    units = None if tolerance is None else tolerance / scale
    parts = _layers(name, units, wanted) if ending == '.dxf' else {'': _READERS[ending](name, units)}
    whole = Found()
    for part in parts.values():
        whole.add(part)
    if not byLayer:
        parts = {'': whole}
    shapesOf = {layer: _shapes(name, part, scale, gap, leastArea, whole.leftOut)
                for layer, part in parts.items() if part.lines or part.regions or not byLayer}
    found = {}
    for layer, shapes in shapesOf.items():
        if ending in plain.ENDINGS:
            shapes = [_simplified(name, 'tolerance', tolerance, *shape) for shape in shapes]
        if simplify is not None:
            shapes = [_simplified(name, 'simplify', simplify, *shape) for shape in shapes]
        found[layer] = [(_pairs(outline), [_pairs(hole) for hole in holes]) for outline, holes in shapes]
    return (found if byLayer else found['']), dict(whole.leftOut)


def _names(layers):
    right = 'the name of a layer, or a list of names'
    names = [layers] if isinstance(layers, str) else listOf('layers', layers, right)
    if not names or not all(isinstance(one, str) for one in names):
        refuse('layers', layers, right)
    return names


def _layers(file, tolerance, wanted):
    """{layer: Found} of a .dxf, or of the wanted layers; names are case-insensitive, as in the format.
    """
    parts = dxf.readLayers(file, tolerance, frozenset(one.casefold() for one in wanted or ()))
    if wanted is None:
        return parts
    known = {layer.casefold(): layer for layer, part in parts.items() if part.lines}
    for one in wanted:
        if one.casefold() not in known:
            raise ValueError('layers has %s, but the layers with lines of %s are %s.' %
                             (shown(one), shownPath(file), ', '.join(map(repr, list(known.values())[:10])) or 'none'))
    return {known[one.casefold()]: parts[known[one.casefold()]] for one in wanted}


def _shapes(name, found, scale, gap, leastArea, leftOut):
    """[(outline, holes)] of arrays (n, 2), in m. Adds to leftOut the lines that are drawn twice."""
    lines = [scale * line for line in found.lines if len(line)]
    regions = [(scale * outline, [scale * hole for hole in holes]) for outline, holes in found.regions]
    every = lines + [loop for outline, holes in regions for loop in (outline, *holes)]
    if not every:
        words = leftOutWords(leftOut)
        raise ValueError('%s has no lines that could be an outline%s.' %
                         (shownPath(name), words and '; it is read without: ' + words))
    points = numpy.concatenate(every)
    if not numpy.isfinite(points).all():
        raise ValueError('%s has points that are not finite.' % shownPath(name))
    gap = gap or _GAP * float(numpy.ptp(points, axis=0).max()) or 1
    try:
        lines = [line for line, in loops.withoutCopies([[line] for line in lines], gap, leftOut)]
        joined = loops.joined(lines, gap)
    except ValueError as error:
        words = leftOutWords(leftOut)
        raise ValueError('%s: %s%s' % (shownPath(name), error,
                                       words and ' The file is read without: %s.' % words)) from None
    rings = [[loops.withoutDoubles(loops.closed(loop), gap) for loop in (outline, *holes)]
             for outline, holes in regions] + [[loops.closed(loop)] for loop in joined]
    rings = [[ring[:-1] for ring in those] for those in loops.withoutCopies(rings, gap, leftOut)]

    def isLarge(ring):
        size = abs(loops.area(ring))
        if leastArea <= size <= _FLAT * numpy.ptp(ring, axis=0).max()**2:
            raise ValueError('%s has a loop without area at (%g, %g).' % (shownPath(name), *ring[0]))
        return size >= leastArea

    regions = [(outline, list(filter(isLarge, holes))) for outline, *holes in rings if isLarge(outline)]
    if not regions:
        raise ValueError('%s has no closed line%s.' % (shownPath(name), ' around leastArea' if leastArea else ''))
    return loops.nested(regions, name)


def _simplified(name, argument, distance, outline, holes):
    try:
        outline, holes, _ = simplified(outline, holes, distance, None)
    except ValueError as error:
        raise ValueError('%s, %s: %s' % (shownPath(name), argument, error)) from None
    return outline, holes


def _pairs(loop):
    return list(map(tuple, loop.tolist()))


def outlineReport(outline: ArrayLike | File, holes: Iterable[ArrayLike] = (), *, size: float,
                  material: FEMat | str | int, simplify: float | None = None, **reading: Any) -> dict[str, Any]:
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
    loops = [points, *holesOf(holes)]
    if simplify is not None:
        points, fewer, _ = simplified(points, loops[1:], simplify, None)
        loops = [points, *fewer]
    return _report([loops], size, material)


def _ofFile(file, size, material, reading):
    if 'byLayer' in reading:
        raise TypeError('byLayer is given, but outlineReport reports on all layers, or on those of layers=.')
    shapes, leftOut = outlinesOf(file, **reading)
    report = _report([[numpy.array(loop) for loop in (outline, *holes)] for outline, holes in shapes], size, material)
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
    shapes = shapely('geometry', _WORKS)
    near = treeOf([shapes.LineString(side) for side in numpy.stack([starts, ends], axis=1)], 'query', _WORKS)
    found = [distances(i, numpy.asarray(near(shapes.box(x - most, y - most, x + most, y + most)), dtype=int)).min()
             for i, (x, y) in enumerate(starts.tolist())]
    best = int(numpy.argmin(found))
    return float(found[best]), tuple(starts[best].tolist())


def _words(report, size):
    if report['finest'] == size:
        return ('%d points, no edge and no gap finer than the size %.4g m: the critical step is '
                'about %.3g s.' % (report['points'], size, report['timeStep']))
    if report['shortestEdge'] <= report['narrowest']:
        what, (x, y) = 'an edge of %.3g m', report['shortestEdgeAt']
    else:
        what, (x, y) = 'a width of %.3g m', report['narrowestAt']
    return ('%d points, of which %s at (%.6g, %.6g) makes the critical step about %.3g s, %.3g times '
            'shorter than triangles of the size %.4g m.' % (report['points'], what % report['finest'], x, y,
                                                            report['timeStep'], report['ratio'], size))
