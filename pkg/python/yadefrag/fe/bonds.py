"""Bonds between bodies of FESolver."""

import numpy

from yadefrag.arguments import FESolver, positive
from yadefrag.fe.contents import bodyNumber, requireBetweenSteps
from yadefrag.messages import warn, warnOfOne


def _ofCorners(corners, farthest):
    """The sentence about corners of outlines that a bond has moved."""
    if not corners:
        return ''
    return ('%s moved by up to %.3g m onto a corner of the other body, since a side between them would have been '
            'less than 0.2 of an element.' % (
                'a corner of an outline was' if corners == 1 else '%d corners of outlines were' % corners, farthest))


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
    sides, corners, farthest, problem = self._bond(first, second, positive('strength', strength, 'Pa'),
                                                   positive('energy', energy, 'J/m²'))
    for sentence in filter(None, [_ofCorners(corners, farthest), problem]):
        warnOfOne('bond: ' + sentence, 'bonds', '%d-%d' % (first, second))
    return sides


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
    (sides, corners, farthest, problem), unmatched, bodies, place = self._bondAll(
        tolerance, positive('strength', strength, 'Pa'), positive('energy', energy, 'J/m²'))
    if not sides and not unmatched:
        raise ValueError('bondAll: no sides that are not bonded yet are within %g m of another body; '
                         'bodies to be bonded must touch.' % tolerance)
    sentences = [_ofCorners(corners, farthest), problem]
    if unmatched:
        sentences.insert(0, (
            '%d sides within %g m of another body are not bonded, since its sides there have other ends, as '
            'between the bodies %d and %d at (%g, %g) m, which cannot be moved onto each other: they are too '
            'near each other, or nodes of other bonds. A larger tolerance, or snapOutlines before the bodies '
            'are added, may help.' % (unmatched, tolerance, *bodies, *place)))
    problem = ' '.join(filter(None, sentences))
    if not sides:
        raise ValueError('bondAll: ' + problem)
    if problem:
        warn('bondAll: ' + problem)
    return sides
