"""Lines from files without curves: CSV, GeoJSON, WKT."""

import json
import re

import numpy

from yadefrag.readers import needed, refuseFile
from yadefrag.values import shown, shownPath

_PACKAGE = 'python3-shapely'


def csvLines(name, tolerance):
    """`x, y` on each line, an empty line between two loops, # before a comment, one heading."""
    with open(name, encoding='utf-8-sig', errors='replace') as file:
        rows = file.read().splitlines()
    loops, mayBeHeading = [[]], True
    for number, row in enumerate(rows, 1):
        words = row.partition('#')[0].strip()
        if not words:
            if not row.strip():
                loops.append([])
            continue
        point = _point(words)
        if point is None and not mayBeHeading:
            raise ValueError('%s, line %d: %s, it must be two numbers x, y.' %
                             (shownPath(name), number, shown(words)))
        mayBeHeading = False
        if point is not None:
            loops[-1].append(point)
    return [numpy.array(loop + loop[:1]) for loop in loops if loop]


def _point(words):
    """(x, y), or None."""
    cells = [cell for cell in re.split(r'[\s,;]+', words) if cell]
    try:
        point = tuple(map(float, cells))
    except ValueError:
        return None
    return point if len(point) == 2 else None


def geoJsonLines(name, tolerance):
    geometry = needed('shapely.geometry', _PACKAGE, name)
    try:
        with open(name, encoding='utf-8-sig') as file:
            data = json.load(file)
        return [line for one in _geometries(data) for line in _linesOf(geometry.shape(one))]
    except Exception as error:  # of the library, of JSON and of missing members
        refuseFile(name, 'GeoJSON file', error)


def _geometries(data):
    """The geometries of a collection of features, of one feature, or of a geometry itself."""
    kind = data['type']
    if kind == 'FeatureCollection':
        return [one for feature in data['features'] for one in _geometries(feature)]
    if kind == 'Feature':
        return [] if data['geometry'] is None else [data['geometry']]
    return [data]


def wktLines(name, tolerance):
    wkt = needed('shapely.wkt', _PACKAGE, name)
    with open(name, encoding='utf-8-sig', errors='replace') as file:
        text = file.read()
    try:
        return _linesOf(wkt.loads(text))
    except Exception as error:  # of the library
        refuseFile(name, 'WKT file', error)


def _linesOf(shape):
    """[(n, 2)] of shapely's shapes; points give no lines."""
    if hasattr(shape, 'geoms'):
        return [line for part in shape.geoms for line in _linesOf(part)]
    if shape.geom_type == 'Polygon':
        return [line for ring in (shape.exterior, *shape.interiors) for line in _linesOf(ring)]
    if shape.geom_type not in ('LineString', 'LinearRing') or shape.is_empty:
        return []
    return [numpy.array(shape.coords, dtype=float)[:, :2]]
