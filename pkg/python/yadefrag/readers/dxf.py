"""Lines, polylines with bulges, arcs, circles, ellipses and splines of a DXF file, by ezdxf.

Also from blocks. Seen from above: z is ignored, and entities that are not lines are ignored.
"""

import math

import numpy

from yadefrag.readers import flatten, needed, refuseFile, requireTolerance

_PACKAGE = 'python3-ezdxf'
_SPLINE_PIECES = 16  # minimum between two knots: ezdxf checks the middle of a piece only
_DEEPEST = 20  # nested blocks


def lines(name, tolerance):
    return [line for layer in linesByLayer(name, tolerance).values() for line in layer]


def linesByLayer(name, tolerance):
    """{layer: lines}, of layers with lines, in the order of the file."""
    ezdxf = needed('ezdxf', _PACKAGE, name)
    try:
        entities = list(_entities(ezdxf.readfile(name).modelspace()))
    except Exception as error:  # of the library
        refuseFile(name, 'DXF file', error)
    found = {}
    for layer, entity in entities:
        reader = _READERS.get(entity.dxftype())
        if reader is not None:
            lines = [_plane(line) for line in reader(entity, tolerance, name)]
            found.setdefault(layer, []).extend(lines)
    return {layer: lines for layer, lines in found.items() if lines}


def _entities(layout, depth=0, around='0'):
    """(layer, entity): entities on layer 0 of a block are on the layer of the block's insert."""
    for entity in layout:
        layer = entity.dxf.get('layer', '0')
        layer = around if layer == '0' else layer
        if entity.dxftype() == 'INSERT' and depth < _DEEPEST:
            yield from _entities(entity.virtual_entities(), depth + 1, layer)
        else:
            yield layer, entity


def _plane(points):
    """(n, 2) from points with two or three coordinates."""
    return numpy.array([(p[0], p[1]) for p in points], dtype=float).reshape(-1, 2)


def _line(entity, tolerance, name):
    return [[entity.dxf.start, entity.dxf.end]]


def _arc(entity, tolerance, name):
    tolerance = requireTolerance(tolerance, name, 'has curves')
    radius = abs(entity.dxf.radius)
    if radius == 0:
        return []
    start, end = (0, 360) if entity.dxftype() == 'CIRCLE' else (entity.dxf.start_angle,
                                                                entity.dxf.end_angle)
    sweep = math.radians((end - start) % 360 or 360)
    pieces = flatten.count(radius * sweep**2, tolerance, math.ceil(sweep / (math.pi / 4)))
    angles = [start + math.degrees(sweep) * k / pieces for k in range(pieces + 1)]
    points = list(entity.vertices(angles))
    return [points[:-1] + points[:1] if sweep == 2 * math.pi else points]


def _ellipse(entity, tolerance, name):
    tolerance = requireTolerance(tolerance, name, 'has curves')
    drawn = entity.dxf
    start, end = drawn.start_param, drawn.end_param
    sweep = (end - start) % (2 * math.pi) or 2 * math.pi
    a, b, centre = ((p.x, p.y) for p in (drawn.major_axis, entity.minor_axis, drawn.center))
    points = flatten.ellipticArc(centre, (a, b), start, sweep, tolerance)
    if sweep == 2 * math.pi:
        points[-1] = points[0]
    return [points]


def _spline(entity, tolerance, name):
    tolerance = requireTolerance(tolerance, name, 'has curves')
    points = list(entity.flattening(tolerance, _SPLINE_PIECES))
    return [points + points[:1] if entity.closed and points[0] != points[-1] else points]


def _polyline(entity, tolerance, name):
    if entity.dxftype() == 'POLYLINE':
        if not (entity.is_2d_polyline or entity.is_3d_polyline):
            return []  # surfaces
        corners = [(v.dxf.location.x, v.dxf.location.y, v.dxf.get('bulge', 0))
                   for v in entity.vertices]
        isClosed, height = entity.is_closed, entity.dxf.get('elevation', (0, 0, 0))[2]
    else:
        corners, isClosed = list(entity.get_points('xyb')), entity.closed
        height = entity.dxf.get('elevation', 0)
    if len(corners) < 2:
        return []
    points = [numpy.array([corners[0][:2]], dtype=float)]
    for (x, y, bend), after in zip(corners, corners[1:] + corners[:1] * isClosed):
        if bend:
            requireTolerance(tolerance, name, 'has curves')
        points.append(flatten.bulge((x, y), after[:2], bend, tolerance))
    points = numpy.concatenate(points)
    # Mirrored entities have a coordinate system of their own.
    return [list(entity.ocs().points_to_wcs([(x, y, height) for x, y in points.tolist()]))]


_READERS = dict(LINE=_line, ARC=_arc, CIRCLE=_arc, ELLIPSE=_ellipse, SPLINE=_spline,
                LWPOLYLINE=_polyline, POLYLINE=_polyline)
