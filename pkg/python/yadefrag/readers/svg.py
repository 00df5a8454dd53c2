"""Outlines of the shapes of an SVG file, by svgelements: in units of the viewBox, y upwards."""

import numpy

from yadefrag.readers import flatten, needed, refuseFile, requireTolerance

_PACKAGE = 'python3-svgelements'


def lines(name, tolerance):
    svg = needed('svgelements', _PACKAGE, name)
    try:
        drawing = svg.SVG.parse(name, reify=False)
        shapes = [e for e in drawing.elements() if isinstance(e, svg.Shape) and _isShown(e)]
        page = _inverse(svg.Matrix(drawing.viewbox_transform or ''))
    except Exception as error:  # of the library, and of Python's parser of XML
        refuseFile(name, 'SVG file', error)
    found = []
    for shape in shapes:
        matrix, shift = _product(page, _affine(shape.transform))
        most = numpy.linalg.norm(matrix, 2)  # largest factor of a length
        own = None if tolerance is None else tolerance / most if most else numpy.inf
        for line in _subpaths(svg, shape, own, name):
            found.append((line @ matrix.T + shift) * (1, -1))
    return found


def _isShown(element):
    values = element.values
    return values.get('display') != 'none' and values.get('visibility') not in ('hidden',
                                                                                'collapse')


def _affine(matrix):
    """((2, 2), (2,)) of svgelements' matrix."""
    return (numpy.array([[matrix.a, matrix.c], [matrix.b, matrix.d]], dtype=float),
            numpy.array([float(matrix.e), float(matrix.f)]))


def _inverse(matrix):
    """Inverts the transform of the page: back to the units of the viewBox."""
    linear, shift = _affine(matrix)
    inverse = numpy.linalg.inv(linear)
    return inverse, -inverse @ shift


def _product(outer, inner):
    return outer[0] @ inner[0], outer[0] @ inner[1] + outer[1]


def _subpaths(svg, shape, tolerance, name):
    """[(n, 2)] before the shape's transform."""
    found = []
    for segment in shape.segments(transformed=False):
        end = None if segment.end is None else numpy.array([segment.end.x, segment.end.y])
        if isinstance(segment, svg.Move):
            found.append([end[None]])
        elif not found or end is None:
            continue
        elif isinstance(segment, (svg.Line, svg.Close)) or _isFlat(svg, segment):
            found[-1].append(end[None])
        else:
            found[-1].append(_curve(svg, segment, requireTolerance(tolerance, name, 'has curves')))
    return [numpy.concatenate(parts) for parts in found if len(parts) > 1]


def _isFlat(svg, segment):
    """True for an arc without a radius, which is a line in SVG."""
    return isinstance(segment, svg.Arc) and not (segment.rx and segment.ry)


def _curve(svg, segment, tolerance):
    if isinstance(segment, svg.QuadraticBezier):
        controls = (segment.start, segment.control, segment.end)
    elif isinstance(segment, svg.CubicBezier):
        controls = (segment.start, segment.control1, segment.control2, segment.end)
    else:
        centre, a, b = ((p.x, p.y) for p in (segment.center, segment.prx, segment.pry))
        axes = numpy.subtract(a, centre), numpy.subtract(b, centre)
        points = flatten.ellipticArc(centre, axes, segment.get_start_t(), segment.sweep, tolerance)
        points[-1] = segment.end.x, segment.end.y
        return points[1:]
    return flatten.bezier([(p.x, p.y) for p in controls], tolerance)
