"""Lines, polylines with bulges, arcs, circles, ellipses and splines of a DXF file, by ezdxf.

Those of the model space that are shown, also from blocks, seen from above: z is ignored.
"""

import collections
import importlib
import math
from collections.abc import Callable, Collection

import numpy

from yadefrag.io.readers import Found, ellipticArc, needed, readable, requireTolerance

_PACKAGE = 'python3-ezdxf'
_SPLINE_PIECES = 16  # minimum between two knots: ezdxf checks the middle of a piece only
_DEEPEST = 20  # nested blocks
_FRAME_POINT = 16  # flag of a polyline's vertex that only controls a spline
_NAMELESS = '0'  # in a block: the layer of the block's insert


def readLayers(name: str, tolerance: float | None, chosen: Collection[str]) -> dict[str, Found]:
    """{layer: Found}, in the order of the file. `chosen` are names, in lower case, of layers that are
    read even if they are off or frozen."""
    ezdxf = needed('ezdxf', _PACKAGE, name)
    with readable(name, 'DXF file'):
        document, damages = _document(ezdxf, name)
        walk = _Walk(document, chosen)
        if damages:
            walk.skipped(_NAMELESS)['damaged parts of the file'] += damages
        entities = list(walk.shown(document.modelspace()))
        walk.skipPaper()
    for layer, entity, matrix in entities:
        found = walk.of(layer)
        reader = _READERS.get(entity.dxftype())
        own = tolerance and tolerance / numpy.linalg.norm(matrix[:3, :3], 2)  # by the largest factor of a length
        points = None if reader is None else reader(entity, own, name)
        if points is None:
            found.leftOut['entities of type %s' % entity.dxftype()] += 1
            continue
        found.lines += [(points @ matrix[:3] + matrix[3])[:, :2]] if len(points) else []
        found.leftOut['widths of polylines'] += getattr(entity, 'has_width', False)
    for layer, leftOut in walk.leftOut.items():
        walk.of(layer).leftOut += leftOut
    return walk.found


def _document(ezdxf, name):
    """(document, number of its damaged parts); viewers read damaged files, too."""
    try:
        return ezdxf.readfile(name), 0
    except Exception as error:  # of the library: any, for damaged files
        recover = importlib.import_module('ezdxf.recover')
        try:
            document, auditor = recover.readfile(name)
        except Exception:
            raise error from None
        return document, len(auditor.errors) + len(auditor.fixes)


def _attribute(entity, key, default):
    """ezdxf knows no attributes of some entities, such as tables."""
    return entity.dxf.get(key, default) if entity.dxf.is_supported(key) else default


class _Walk:
    """Entities of the model space, as they are shown; the others are counted by layer."""

    def __init__(self, document, chosen):
        self.document, self.chosen = document, chosen
        self.found, self.leftOut, self._names = {}, {}, {}
        tables = {layer.dxf.name.casefold(): layer for layer in document.layers}
        self._frozen = {key for key, layer in tables.items() if layer.is_frozen()} - chosen
        self._off = {key for key, layer in tables.items() if layer.is_off()} - chosen

    def of(self, layer):
        """The Found of a layer; names are case-insensitive, as in the format."""
        name = self._names.setdefault(layer.casefold(), layer)
        return self.found.setdefault(name, Found())

    def skipped(self, layer):
        return self.leftOut.setdefault(layer, collections.Counter())

    def shown(self, layout, matrix=numpy.eye(4)[:, :3], depth=0, around=_NAMELESS):
        """(layer, entity, matrix (4, 3) to the drawing): entities on layer 0 of a block are on the layer of the block's
        insert."""
        for entity in layout:
            layer = _attribute(entity, 'layer', _NAMELESS)
            layer = around if layer == _NAMELESS else layer
            isInsert = entity.dxftype() == 'INSERT'
            if _attribute(entity, 'invisible', 0):
                self.skipped(layer)['invisible entities'] += 1
            elif layer.casefold() in self._frozen:
                self.skipped(layer)['entities on frozen layers'] += 1
            elif isInsert and depth < _DEEPEST:
                yield from self._insert(entity, matrix, depth, layer)
            elif layer.casefold() in self._off:
                self.skipped(layer)['entities on layers that are off'] += 1
            elif not depth or entity.dxftype() != 'ATTDEF':
                yield layer, entity, matrix

    def _insert(self, insert, matrix, depth, layer):
        """The contents of a block: an insert's layer hides them if it is frozen, and not if it is off.
        """
        leftOut = self.skipped(layer)
        if insert.block() is None:
            leftOut['blocks that the file does not contain'] += 1
            return
        if _isClipped(insert):
            leftOut['clipping boundaries of blocks'] += 1
        leftOut['attributes of blocks'] += len(insert.attribs)
        for one in insert.multi_insert() if insert.mcount > 1 else [insert]:  # rows and columns
            own = numpy.array(list(one.matrix44().rows())) @ numpy.column_stack([matrix, (0, 0, 0, 1)])
            yield from self.shown(insert.block(), own[:, :3], depth + 1, layer)

    def skipPaper(self):
        for layout in self.document.layouts:
            if layout.is_any_paperspace:
                for entity in layout:
                    if entity.dxftype() != 'VIEWPORT':
                        self.skipped(_attribute(entity, 'layer', _NAMELESS))['entities in paper space'] += 1


def _isClipped(insert):
    if not insert.has_extension_dict:
        return False
    filters = insert.get_extension_dict().dictionary.get('ACAD_FILTER')
    return filters is not None and 'SPATIAL' in filters


# Readers: points (n, 3) of an entity, before the matrix of its block.

def _places(points):
    return numpy.array([point.xyz for point in points]).reshape(-1, 3)


def _arc(entity, tolerance, name):
    """Of arcs, circles and ellipses."""
    tolerance = requireTolerance(tolerance, name, 'has curves')
    if entity.dxftype() != 'ELLIPSE':
        if entity.dxf.radius == 0:
            return []
        entity = importlib.import_module('ezdxf.entities').Ellipse.from_arc(entity)
    drawn = entity.construction_tool()
    sweep = drawn.param_span or 2 * math.pi
    a, b, centre = _places([drawn.major_axis, drawn.minor_axis, drawn.center])
    points = ellipticArc(centre, (a, b), drawn.start_param, sweep, tolerance)
    if sweep == 2 * math.pi:
        points[-1] = points[0]
    return points


def _spline(entity, tolerance, name):
    tolerance = requireTolerance(tolerance, name, 'has curves')
    points = list(entity.flattening(tolerance, _SPLINE_PIECES))
    return _places(points + points[:1] if entity.closed and points[0] != points[-1] else points)


def _polyline(entity, tolerance, name):
    if entity.dxftype() == 'LWPOLYLINE':
        isClosed, height = entity.closed, entity.dxf.elevation
        corners = [(x, y, height, bend) for x, y, bend in entity.get_points('xyb')]
    elif entity.is_2d_polyline or entity.is_3d_polyline:
        isFlat = entity.is_2d_polyline and entity.dxf.hasattr('elevation')
        corners = [(x, y, entity.dxf.elevation[2] if isFlat else z, v.dxf.get('bulge', 0)) for v in entity.vertices
                   if not v.dxf.get('flags', 0) & _FRAME_POINT for x, y, z in [v.dxf.location]]
        isClosed = entity.is_closed
    else:
        return None  # a surface
    if len(corners) < 2:
        return []
    points, arcOf = [corners[0][:3]], importlib.import_module('ezdxf.math').bulge_to_arc
    for (x, y, z, bend), after in zip(corners, corners[1:] + corners[:1] * isClosed):
        if bend and (x, y) != after[:2]:
            centre, start, end, radius = arcOf((x, y), after[:2], bend)  # counter-clockwise
            sweep = 4 * math.atan(bend)
            arc = ellipticArc(tuple(centre), radius * numpy.eye(2), start if bend > 0 else end, sweep,
                              requireTolerance(tolerance, name, 'has curves'))
            points += [(a, b, z) for a, b in arc[1:-1].tolist()]
        points.append(after[:3])
    # Mirrored entities have a coordinate system of their own.
    return numpy.array([tuple(point) for point in entity.ocs().points_to_wcs(points)])


_READERS: dict[str, Callable] = dict(
    LINE=lambda entity, *_: _places([entity.dxf.start, entity.dxf.end]), ARC=_arc, CIRCLE=_arc, ELLIPSE=_arc,
    SPLINE=_spline, LWPOLYLINE=_polyline, POLYLINE=_polyline)
