"""Outlines from files of other programs, for FESolver.addPolygon."""

import math
import os

import numpy

from yadefrag.meshing import simplified
from yadefrag.readers import dxf, loops, picture, plain, svg
from yadefrag.values import flag, number, path, positive, refuse, shown, shownPath

_GAP = 1e-6  # of the longer side of the drawing: drawings have six digits
_LINES = {'.svg': svg.lines, '.dxf': dxf.lines, '.csv': plain.csvLines, '.wkt': plain.wktLines,
          '.json': plain.geoJsonLines, '.geojson': plain.geoJsonLines,
          **{ending: picture.lines for ending in picture.ENDINGS}}


def readOutline(file, tolerance=None, scale=1, gap=None, simplify=None, leastArea=0., layers=None,
                byLayer=False):
    """Outlines from a drawing, a map or a picture: list of (outline, holes), as for addPolygon.

    `for shape in readOutline('plate.svg', 1e-5, scale=1e-3): fe.addPolygon(*shape, size=...)`.
    file       its ending determines the format:
               .svg      visible paths and basic shapes with their transforms, in units of the viewBox;
                         y upwards, so that the page is below the origin
               .dxf      lines, polylines with bulges, arcs, circles, ellipses, splines, also in
                         blocks, seen from above; layers may be chosen
               .geojson, .json, .wkt  polygons, and closed lines
               .csv      `x, y` on each line, an empty line between two loops, # before comments
               .png, .jpg, .jpeg, .bmp, .tif, .tiff  areas darker than middle grey; transparent areas
                         count as white; in pixels from the lower left corner of the picture
    tolerance  m, permitted deviation of outlines: curves get so many points that the chords are
               within it (for splines in .dxf: at the chords' middles), and the contour of a picture
               is reduced as by `simplify`. Not needed for files without curves
    scale      m for one unit of the file
    gap        m, distance below which two points coincide and two ends of lines are joined; None: 10⁻⁶
               of the longer side of the drawing
    simplify   None, or m: as in addPolygon, on what has been read
    leastArea  m²: smaller loops, e.g. specks in a picture, are left out
    layers     of a .dxf: None: all of them; or the name of one or a list of names: only those
    byLayer    of a .dxf: True returns a dict {layer: list of (outline, holes)} instead of the list;
               lines are joined, and loops are holes, within their own layer only
    Points inside an odd number of loops are inside: a loop within an outline is a hole, one within
    a hole is a separate outline. All are counter-clockwise lists of (x, y) in m. ValueError with
    the file for an unknown format, for lines that are not closed and for a missing tolerance;
    ImportError with the name of Debian's package if a library is missing (svgelements, ezdxf,
    shapely, scikit-image); OSError for a file that cannot be read.
    """
    name = path('file', file)
    ending = os.path.splitext(name)[1].lower()
    if ending not in _LINES:
        raise ValueError('file ends with %r, an outline can be read from one of %s.' %
                         (ending[:20], ', '.join(_LINES)))
    scale = positive('scale', scale, 'm per unit of the file')
    tolerance = None if tolerance is None else positive('tolerance', tolerance, 'm')
    gap = None if gap is None else positive('gap', gap, 'm')
    simplify = None if simplify is None else positive('simplify', simplify, 'm')
    leastArea = number('leastArea', leastArea, lambda v: 0 <= v < math.inf,
                       '0 or a positive number (m²)')
    byLayer = flag('byLayer', byLayer)
    if ending != '.dxf' and (byLayer or layers is not None):
        raise ValueError('layers or byLayer is given, but %s has no layers: only a .dxf file has.' %
                         shownPath(name))
    wanted = None if layers is None else _names(layers)
    with open(name, 'rb'):  # OSError, before a library raises another exception
        pass
    units = None if tolerance is None else tolerance / scale
    parts = _chosen(name, dxf.linesByLayer(name, units), wanted) if ending == '.dxf' else \
        {'': _LINES[ending](name, units)}
    if not byLayer:
        parts = {'': [line for part in parts.values() for line in part]}
    found = {}
    for layer, part in parts.items():
        shapes = _shapes(name, [scale * line for line in part if len(line)], gap, leastArea)
        if ending in picture.ENDINGS:
            shapes = [_simplified(name, 'tolerance', tolerance, *shape) for shape in shapes]
        if simplify is not None:
            shapes = [_simplified(name, 'simplify', simplify, *shape) for shape in shapes]
        found[layer] = [(_pairs(outline), [_pairs(hole) for hole in holes])
                        for outline, holes in shapes]
    return found if byLayer else found['']


def _names(layers):
    names = [layers] if isinstance(layers, str) else layers
    try:
        names = list(names)
    except TypeError:
        names = []
    if not names or not all(isinstance(one, str) for one in names):
        refuse('layers', layers, 'the name of a layer, or a list of names')
    return names


def _chosen(file, parts, wanted):
    """The chosen layers of {layer: lines}; names are case-insensitive, as in the format."""
    if wanted is None:
        return parts
    known = {layer.casefold(): layer for layer in parts}
    for one in wanted:
        if one.casefold() not in known:
            raise ValueError('layers has %s, but the layers with lines of %s are %s.' %
                             (shown(one), shownPath(file),
                              ', '.join(map(repr, list(parts)[:10])) or 'none'))
    return {known[one.casefold()]: parts[known[one.casefold()]] for one in wanted}


def _shapes(name, lines, gap, leastArea):
    """[(outline, holes)] of arrays (n, 2)."""
    if not lines:
        raise ValueError('%s has no lines that could be an outline.' % shownPath(name))
    points = numpy.concatenate(lines)
    if not numpy.isfinite(points).all():
        raise ValueError('%s has points that are not finite.' % shownPath(name))
    side = float((points.max(axis=0) - points.min(axis=0)).max())
    try:
        closed = loops.joined(lines, gap or _GAP * side or 1)
    except ValueError as error:
        raise ValueError('%s: %s' % (shownPath(name), error)) from None
    closed = [loop for loop in closed if abs(loops.area(loop)) >= leastArea]
    flat = [loop for loop in closed if abs(loops.area(loop)) <= 1e-12 * side * side]
    if flat:
        raise ValueError('%s has a loop without area at (%g, %g).' %
                         (shownPath(name), *flat[0][0]))
    if not closed:
        raise ValueError('%s has no closed line%s.' %
                         (shownPath(name), ' around leastArea' if leastArea else ''))
    return loops.nested(closed)


def _simplified(name, argument, distance, outline, holes):
    try:
        outline, holes, _ = simplified(outline, holes, distance, None)
    except ValueError as error:
        raise ValueError('%s, %s: %s' % (shownPath(name), argument, error)) from None
    return outline, holes


def _pairs(loop):
    return list(map(tuple, loop.tolist()))
