"""Outlines moved onto their neighbours, since rounded coordinates make gaps and overlaps; bonds with neighbours."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy

from yadefrag import _yadefrag
from yadefrag.arguments import FESolver, Mesh, anyNumber, listOf, number, pointsOf, positive
from yadefrag.fe.contents import bodyNumber, requireBetweenSteps
from yadefrag.fe.mesh import Meshing, Outline
from yadefrag.fe.mesh_values import isClockwise
from yadefrag.messages import warn, warnOfOne

OVERLAP = .05    # of the size: overlaps up to this are removed without a request
_REACH = 2       # tolerance of that, in overlaps: vertices may be farther apart than the outlines
_MOVES = 12      # most moves in sequence
_CLOSABLE = .5   # of the size: overlaps up to this may be rounding, and snap= is advised
_TOLD = 1e-3     # of the size: smaller displacements of vertices are not reported
_WIDER = .3      # of the size: the tolerance that is tried against short steps
_HELPS = .5      # of the cost: an advice that leaves more is no advice


class Overlap(ValueError):
    """A body would overlap another one, by `depth` (m)."""

    def __init__(self, message: str, depth: float) -> None:
        super().__init__(message)
        self.depth = depth


def snapTolerance(snap: Any, displacement: object) -> float | None:
    """addPolygon's `snap`: None, 0, or m."""
    if snap is None:
        return None
    snap = number('snap', snap, lambda v: 0 <= v < float('inf'), '0, a positive number (m), or None')
    if snap and displacement is not None:
        raise ValueError('snap and displacement are both given, but only one of them can be: the '
                         'outline is the stress-free shape, which lies elsewhere.')
    return snap


def addSnapped(fe: FESolver, outline: Outline, snap: float | None, size: float, displacement: object,
               add: Callable[[Outline], int]) -> int:
    """Calls `add(outline)`, which adds a body and may raise Overlap, for the outline moved onto the
    bodies beside it as `snap` permits. `size` (m) is the length of the triangles' edges."""
    count = None
    if snap:
        outline, done = outline.snapped(fe, snap, size, matches=True)
        count = done.moved, done.inserted, done.farthest
    try:
        body = add(outline)
    except Overlap as overlap:
        if snap is not None or displacement is not None or overlap.depth > OVERLAP * size:
            raise ValueError(_advised(fe, outline, overlap, snap, size, displacement)) from None
        body, count = _withoutOverlap(fe, outline, size, overlap, add)
    if count:
        _tell(body, size, *count)
    return body


def _withoutOverlap(fe, outline, size, overlap, add):
    """(body, (moved, inserted, farthest)) of the outline moved off the bodies; where several of these
    meet with gaps, what is left of the overlap needs further moves."""
    first, moved, inserted, farthest, depth = overlap, 0, 0, 0., overlap.depth
    for _ in range(_MOVES):
        try:
            outline, done = outline.snapped(fe, _REACH * depth, size, matches=False)
            moved, inserted, farthest = max(moved, done.moved), inserted + done.inserted, farthest + done.farthest
            return add(outline), (moved, inserted, farthest)
        except Overlap as left:
            overlap, depth = left, left.depth
            if depth > OVERLAP * size:
                break
        except ValueError as error:
            overlap = error
            break
    raise ValueError('%s Its vertices were moved by up to %.3g m, which does not suffice: %s '
                     'snapOutlines, for all outlines before they are added, moves both sides.' %
                     (first, farthest, overlap)) from None


def _advised(fe, outline, overlap, snap, size, displacement):
    least = float('%.1e' % (1.1 * _REACH * overlap.depth))
    if overlap.depth > _CLOSABLE * size or displacement is not None or not _changes(fe, outline, least, size):
        return '%s Move it by that, or more where it is deeper elsewhere.' % overlap
    if snap is None or snap < least:
        return '%s snap=%g moves its vertices onto the bodies beside it.' % (overlap, least)
    return ('%s snap= has moved its vertices by up to %g m, which does not suffice: move it.' % (overlap, snap))


def _changes(fe, outline, tolerance, size):
    try:
        _, done = outline.snapped(fe, tolerance, size, matches=False)
    except ValueError:  # it would collapse
        return False
    return done.moved + done.inserted > 0


def _tell(body, size, moved, inserted, farthest):
    if farthest <= _TOLD * size:
        return
    warnOfOne('addPolygon: of body %d, %d vertices were moved onto the bodies beside it, and %d '
                  'of theirs were inserted; the outline has changed by at most %.3g m (snap=).' %
                  (body, moved, inserted, farthest), 'bodies', body)


def tellJoined(body: int, size: float, count: int, farthest: float) -> None:
    if count:
        warnOfOne('addPolygon: of the joints of body %d, %d ends, crossings and bends near another '
                      'line were joined with it, and moved by at most %.3g m, %.2g of the size (snap=).'
                      % (body, count, farthest, farthest / size), 'bodies', body)


def tellCostly(fe: FESolver, body: int, mesh: Mesh, meshing: Meshing, outline: Outline, call: str) -> None:
    """Warns of a body whose mesh has a short time step. `mesh` is that of `outline`, by `meshing`, a Meshing;
    `call`: the name of the function that the script has called."""
    costly = fe._costlyStepWarning(body, meshing.size)
    if costly:
        sentence = _tooLarge(meshing.size, outline.points) or \
            '%s %s' % (costly, _costAdvice(fe, body, mesh, meshing, outline,
                                           'snap' if call == 'addPolygon' else 'jointTolerance'))
        warnOfOne('%s: %s' % (call, sentence), 'bodies', body)


def _tooLarge(size, points):
    """The sentence about a size that the body is too small for; empty if it is not."""
    width, height = numpy.ptp(points, axis=0)
    least = min(width, height)
    if size <= least:
        return ''
    return ('size is %g m, but the body has only %g m by %g m: its outline requires smaller triangles, which '
            'determine the critical time step; take a size of at most %g m.' % (size, width, height, least))


def _costAdvice(fe, body, mesh, meshing, outline, joining):
    """A sentence about a mesh with a short time step: what has been tried, and helps."""
    wider = float('%.2g' % (_WIDER * meshing.size))
    present = fe._costOfMesh(body, meshing.size, mesh)
    for argument in (joining, 'simplify'):
        try:
            if argument == 'simplify':
                other = meshing.mesh(outline.simplified(wider), meshing.jointTolerance)
            elif len(meshing.lines) and meshing.jointTolerance < wider:
                other = meshing.mesh(outline, wider)
            else:
                continue
        except (ImportError, ValueError):  # without shapely; an outline that such a tolerance would destroy
            continue
        after = fe._costOfMesh(body, meshing.size, other)
        if after <= _HELPS * present:
            return '%s=%g reduces that to %.3g.' % (argument, wider, max(after, 1))
    return ('Neither simplify= nor %s= reduces that: move vertices or joints apart there, or '
            'take them out.' % joining)


def snapOutlines(shapes: Iterable, tolerance: float) -> tuple[list, dict[str, Any]]:
    """Outlines that touch, without the gaps and overlaps of rounded coordinates: (shapes, report).

    shapes     list of outlines, or of (outline, holes), as readOutline returns them; the result has
               the same form
    tolerance  m: vertices within it of an earlier outline are moved onto its nearest vertex, or
               else onto its nearest side. Then each outline gets the vertices of all others on its
               sides (T-junctions), so that common sides have the same ends. Less than the width of
               the narrowest part
    report     dict: `moved` and `inserted`, numbers of vertices, and `farthest`, the largest
               displacement (m)
    Bodies of these outlines and of one size then match node by node, and can be bonded. ValueError
    for an outline that addPolygon would refuse, and for one that would collapse.
    """
    tolerance = positive('tolerance', tolerance, 'm')
    shapes = listOf('shapes', shapes, 'a list of outlines, or of pairs (outline, holes)')
    given = [_loopsOf('shapes[%d]' % i, shape) for i, shape in enumerate(shapes)]
    made = _yadefrag.snapTogether([(loops[0], loops[1:]) for loops in given], tolerance)
    report = dict(moved=sum(one.moved for one in made), inserted=sum(one.inserted for one in made),
                  farthest=max((one.farthest for one in made), default=0.))
    found = []
    for shape, before, after in zip(shapes, given, made):
        loops = [_turned(loop.points, was) for loop, was in zip(after.loops, before)]
        found.append((loops[0], loops[1:]) if _hasHoles(shape) else loops[0])
    return found, report


def _hasHoles(shape):
    """True for (outline, holes); False for a list of points."""
    try:
        outline, _ = shape
        return numpy.ndim(outline[0]) == 1
    except (TypeError, ValueError, IndexError, KeyError):
        return False


def _loopsOf(name, shape):
    outline, holes = shape if _hasHoles(shape) else (shape, ())
    return [pointsOf(name, outline, 3)] + [pointsOf('%s, hole %d' % (name, i), hole, 3)
                                           for i, hole in enumerate(holes)]


def _turned(loop, was):
    """A list of points, in the direction of the given loop."""
    if isClockwise(loop) != isClockwise(was):
        loop = numpy.concatenate([loop[:1], loop[:0:-1]])
    return list(map(tuple, loop.tolist()))


# --- bonds

def _tellings(done):
    """Sentences about corners of outlines that a bond has moved, and about its mesh."""
    if done.corners:
        yield ('%s moved by up to %.3g m onto a corner of the other body, since a side between them would have been '
               'less than 0.2 of an element.' % ('a corner of an outline was' if done.corners == 1 else
                                                 '%d corners of outlines were' % done.corners, done.farthest))
    if done.problem:
        yield done.problem


def _requireNear(self, tolerance):
    """The arguments of bondAll are three numbers, and may be given in another order."""
    nodes = self.nodes
    if not len(nodes):
        return
    largest = max(float(numpy.ptp(nodes[self.triangles[self.components == body]].reshape(-1, 2), axis=0).max())
                  for body in set(self.components))
    if tolerance > largest:
        raise ValueError('bondAll: tolerance is %g m, but the largest body has only %g m; the order is '
                         'bondAll(tolerance, strength, energy).' % (tolerance, largest))


def bond(self: FESolver, a: int | str, b: int | str, strength: float, energy: float) -> int:
    """Bonds bodies a and b, from the next step on, along all sides that they have in common at
    present; returns the number of these sides (int).

    a, b      numbers or names of two bodies that touch
    strength  Pa, tensile; the shear strength is shearFactor times that. shearFactor,
              shearEnergyFactor and softening are those of the body with the smaller
              tensileStrength; 1, 1 and 'linear' for FEMat
    energy    J/m², that opens the bond in tension; positive
    A bond acts like a crack that has not opened yet, by the cohesive law. An opening dissipates
    `energy`; after that, or where the bond is closed, the faces have contact like any others.
    fragments() counts bonded bodies as one; crackCounts counts bonds, numCracks does not. Where the
    nodes of both sides differ, they are made the same first: a node slides along its side by up to a
    third of it onto a node of the other body, and each other node divides the side opposite it and the
    triangle behind that side. New nodes have the last numbers; triangles of later bodies get higher ones. The
    critical time step may be shorter then: set O.dt after the bonds. Corners nearer than 0.2 of a side
    are joined, with a warning. ValueError, before any change, if no sides lie on each other, or if
    their ends cannot be joined; a warning if sides are too long for the energy.
    """
    requireBetweenSteps()
    first, second = (bodyNumber(self, one, name, least=0) for name, one in (('a', a), ('b', b)))
    done = self._bond(first, second, anyNumber('strength', strength, 'Pa'), anyNumber('energy', energy, 'J/m²'))
    for sentence in _tellings(done):
        warnOfOne('bond: ' + sentence, 'bonds', '%d-%d' % (first, second))
    return done.sides


def bondAll(self: FESolver, tolerance: float, strength: float, energy: float) -> int:
    """Bonds all bodies, from the next step on, along all sides that lie on each other at present, as
    `bond` does; returns the number of bonded sides (int).

    tolerance  m: sides up to this distance apart that run along each other are neighbours. Gaps and
               overlaps up to it are closed, without stress, where their nodes are made the same
    strength   Pa, as in bond
    energy     J/m², as in bond
    Sides whose nodes cannot be made the same are not bonded; a warning states their number, two
    bodies and a place. ValueError, before any change, if no sides lie on each other.
    """
    requireBetweenSteps()
    tolerance = positive('tolerance', tolerance, 'm')
    _requireNear(self, tolerance)
    done = self._bondAll(tolerance, anyNumber('strength', strength, 'Pa'), anyNumber('energy', energy, 'J/m²'))
    if not done.sides and not done.unmatched:
        raise ValueError('bondAll: no sides that are not bonded yet are within %g m of another body; '
                         'bodies to be bonded must touch.' % tolerance)
    sentences = list(_tellings(done))
    if done.unmatched:
        sentences.insert(0, (
            '%d sides within %g m of another body are not bonded, since its sides there have other ends, as '
            'between the bodies %d and %d at (%g, %g) m, which cannot be moved onto each other: they are too '
            'near each other, or nodes of other bonds. A larger tolerance, or snapOutlines before the bodies '
            'are added, may help.' % (done.unmatched, tolerance, *done.bodies, *done.place)))
    if not done.sides:
        raise ValueError('bondAll: ' + ' '.join(sentences))
    if sentences:
        warn('bondAll: ' + ' '.join(sentences))
    return done.sides
