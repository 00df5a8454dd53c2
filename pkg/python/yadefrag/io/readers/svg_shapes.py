"""Lines and regions of SVG shapes: curves flattened, filled by their rule, clipped."""

import dataclasses
from collections.abc import Iterable, Sequence

import numpy

from yadefrag.io.readers import Found, ellipticArc, needed, piecesOf, requireTolerance
from yadefrag.io.readers.loops import area, around, nested, regionOf

_FLAT = 1e-12  # of the square of the extent: the area of a line
_SLIVER = 1e-9  # of the extent, or of an area: rounding, at an edge that cuts a shape


@dataclasses.dataclass(frozen=True)
class Item:
    path: object           # of svgelements
    matrix: numpy.ndarray  # (3, 3), to the units of the viewBox
    isFilled: bool
    isStroked: bool
    rule: str              # 'nonzero' or 'evenodd'
    clips: tuple = ()      # of tuples of items: only what is inside one of each is shown
    isWhite: bool = False


def appended(found: Found, items: Iterable[Item], page: Sequence[float] | None, tolerance: float | None,
             name: str) -> None:
    """Adds the items to a Found, with y upwards. `page` is (left, top, right, bottom) or None."""
    isAnythingSeen = False
    for item in items:
        if item.isWhite and not isAnythingSeen:
            found.leftOut['white shapes behind all others'] += 1
            continue
        isAnythingSeen = True
        one = _painted(item, tolerance, name)
        found.leftOut += one.leftOut
        for lines in one.lines, *([outline, *holes] for outline, holes in one.regions):
            points = numpy.concatenate([*lines, numpy.zeros((0, 2))])
            if page is not None and len(points) and _isBeyond(points, page):
                found.leftOut['the cut at the edge of the page'] += 1
                break
        found.lines += [line * (1, -1) for line in one.lines]
        found.regions += [(outline * (1, -1), [hole * (1, -1) for hole in holes]) for outline, holes in one.regions]


def _isBeyond(points, page):
    low, high = numpy.array(page[:2]), numpy.array(page[2:])
    edge = _SLIVER * (high - low).max()
    return (points < low - edge).any() or (points > high + edge).any()


def _painted(item, tolerance, name):
    """A Found of one item, with y downwards."""
    found = Found()
    linear, shift = item.matrix[:2, :2], item.matrix[:2, 2]
    most = numpy.linalg.norm(linear, 2)  # largest factor of a length
    if abs(numpy.linalg.det(linear)) <= _FLAT * most**2:
        found.leftOut['shapes that are not painted'] += 1
        return found
    own = None if tolerance is None else tolerance / most
    loops = []
    for line in _subpaths(item.path, own, name):
        line = line @ linear.T + shift
        loop = line[:-1] if (line[0] == line[-1]).all() else line
        extent = (line.max(axis=0) - line.min(axis=0)).max()
        hasArea = len(loop) > 2 and abs(area(loop)) > _FLAT * extent**2
        if item.isFilled and hasArea:
            loops.append(loop)
        elif item.isStroked:
            found.lines.append(line)
        else:
            found.leftOut['shapes that are not painted'] += 1
    found.regions, covered = _filled(loops, item.rule, name)
    found.leftOut['inner lines that the fill covers'] += covered
    return _clipped(found, item, tolerance, name) if item.clips else found


def _filled(loops, rule, name):
    """([(outline, holes)], number of loops on both sides of which there is paint)."""
    if len(loops) < 2:
        return [(loop, []) for loop in loops], 0
    turns = [1 if area(loop) > 0 else -1 for loop in loops]
    loops = [loop[::turn] for loop, turn in zip(loops, turns)]
    kept = loops
    if rule != 'evenodd':
        outside = [sum(turns[j] for j in those) for those in around([(one, []) for one in loops])]
        kept = [loop for loop, turn, beyond in zip(loops, turns, outside) if beyond == 0 or beyond + turn == 0]
    return nested([(loop, []) for loop in kept], name), len(loops) - len(kept)


def _clipped(found, item, tolerance, name):
    """What is inside all clips of an item."""
    geometry = needed('shapely.geometry', 'python3-shapely', name)
    operations = needed('shapely.ops', 'python3-shapely', name)
    for clip in item.clips:
        parts = [_solid(geometry, operations, region, one.rule) for one in clip
                 for region in _painted(one, tolerance, name).regions]
        window = operations.unary_union(parts)
        inside = Found()
        inside.leftOut += found.leftOut
        for outline, holes in found.regions:
            solid = _solid(geometry, operations, (outline, holes), item.rule)
            if solid.difference(window).area <= _SLIVER * solid.area:
                inside.regions.append((outline, holes))
                continue
            inside.leftOut['parts that are clipped away'] += 1
            inside.regions += [regionOf(part) for part in _parts(solid.intersection(window))
                               if part.geom_type == 'Polygon' and part.area > _SLIVER * solid.area]
        for line in found.lines:
            whole = geometry.LineString(line)
            if whole.difference(window).length <= _SLIVER * whole.length:
                inside.lines.append(line)
                continue
            inside.leftOut['parts that are clipped away'] += 1
            shown = whole.intersection(window)
            merged = operations.linemerge(shown) if shown.geom_type == 'MultiLineString' else shown
            inside.lines += [numpy.array(part.coords) for part in _parts(merged)
                             if part.geom_type == 'LineString' and part.length > 0]
        found = inside
    return found


def _solid(geometry, operations, region, rule):
    """shapely's region; of a line that crosses itself what its fill paints."""
    solid = geometry.Polygon(*region)
    if solid.is_valid:
        return solid
    loops = [region[0], *region[1]]
    edges = operations.unary_union([geometry.LineString(loop[numpy.r_[:len(loop), :1]]) for loop in loops])
    return operations.unary_union([face for face in operations.polygonize(edges)
                                   if _isPainted(face.representative_point().coords[0], loops, rule)])


def _isPainted(place, loops, rule):
    """By the number of turns around a place."""
    turns = 0
    for loop in loops:
        after = numpy.roll(loop, -1, axis=0)
        crosses = (loop[:, 1] > place[1]) != (after[:, 1] > place[1])
        a, b = loop[crosses], after[crosses]
        isRight = a[:, 0] + (place[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1]) > place[0]
        turns += int((numpy.sign(b[:, 1] - a[:, 1]) * isRight).sum())
    return turns % 2 == 1 if rule == 'evenodd' else turns != 0


def _parts(shape):
    return [one for one in getattr(shape, 'geoms', [shape]) if not one.is_empty]


def _subpaths(path, tolerance, name):
    """[(n, 2)] before the shape's transform."""
    found: list[list] = []
    isOpen = False
    for segment in path:
        end = None if segment.end is None else numpy.array([[segment.end.x, segment.end.y]], dtype=float)
        kind = type(segment).__name__
        if kind == 'Move':
            found.append([end])
        elif end is not None:
            if not isOpen and len(found[-1]) > 1:  # after a closed part, which ends where it began
                found.append([found[-1][0]])
            # An arc without a radius is a line in SVG.
            isLine = kind in ('Line', 'Close') or kind == 'Arc' and not (segment.rx and segment.ry)
            found[-1].append(end if isLine else _curve(segment, requireTolerance(tolerance, name, 'has curves')))
        isOpen = kind != 'Close'
    return [numpy.concatenate(parts) for parts in found if len(parts) > 1]


def _curve(segment, tolerance):
    """(n, 2) without its first point."""
    if type(segment).__name__ == 'Arc':
        centre, a, b = ((p.x, p.y) for p in (segment.center, segment.prx, segment.pry))
        axes = numpy.subtract(a, centre), numpy.subtract(b, centre)
        points = ellipticArc(centre, axes, segment.get_start_t(), segment.sweep, tolerance)
        points[-1] = segment.end.x, segment.end.y
        return points[1:]
    controls = numpy.array([(p.x, p.y) for p in segment])  # of a Bézier curve: three or four
    degree = len(controls) - 1
    bends = degree * (degree - 1) * numpy.linalg.norm(numpy.diff(controls, n=2, axis=0), axis=1)
    pieces = piecesOf(bends.max(), tolerance)
    return segment.npoint(numpy.arange(1, pieces + 1) / pieces)
