"""Bonds between bodies of FESolver."""

from yadefrag.messages import warn, warnOfOne
from yadefrag.names import bodyNumber
from yadefrag.script_calls import requireBetweenSteps
from yadefrag.values import positive


def bond(self, a, b, strength, energy):
    """Bonds bodies a and b, from the next step on, along all sides that they have in common at
    present; returns the number of these sides (int).

    a, b      numbers or names of two bodies that touch, with nodes at the same positions along their
              common sides, to 1e-9 of a side: give both outlines the same points there, and the same
              size
    strength  Pa, tensile; the shear strength is shearFactor times that. shearFactor,
              shearEnergyFactor and softening are those of the body with the smaller
              tensileStrength; 1, 1 and 'linear' for FEMat
    energy    J/m², that opens the bond in tension; positive
    A bond acts like a crack that has not opened yet, by the cohesive law. An opening dissipates
    `energy`; after that, or where the bond is closed, the faces have contact like any others.
    fragments() counts bonded bodies as one; crackCounts counts bonds, numCracks does not. ValueError,
    before any change, if no sides match or if sides coincide with different ends; a warning if
    sides are too long for the energy.
    """
    requireBetweenSteps()
    first, second = (bodyNumber(self, one, name, least=0)
                     for name, one in (('a', a), ('b', b)))
    sides, problem = self._bond(first, second, positive('strength', strength, 'Pa'),
                                positive('energy', energy, 'J/m²'))
    if problem:
        warnOfOne('bond: ' + problem, 'bonds', '%d-%d' % (first, second))
    return sides


def bondAll(self, tolerance, strength, energy):
    """Bonds all bodies, from the next step on, along all sides that lie on each other at present, as
    `bond` does; returns the number of bonded sides (int).

    tolerance  m: sides up to this distance apart that run along each other are neighbours. Those
               without the same ends are not bonded, and a warning states their number, two bodies
               and a place. snapOutlines, before the bodies are added, gives neighbours the same ends
    strength   Pa, as in bond
    energy     J/m², as in bond
    ValueError, before any change, if no sides match.
    """
    requireBetweenSteps()
    tolerance = positive('tolerance', tolerance, 'm')
    sides, unmatched, bodies, place, problem = self._bondAll(
        tolerance, positive('strength', strength, 'Pa'), positive('energy', energy, 'J/m²'))
    if not sides and not unmatched:
        raise ValueError('bondAll: no sides that are not bonded yet are within %g m of another body; '
                         'bodies to be bonded must touch.' % tolerance)
    if unmatched:
        problem = ' '.join(filter(None, [
            '%d sides within %g m of another body are not bonded, since its sides there have other '
            'ends, as between the bodies %d and %d at (%g, %g) m. Give the outlines the same points '
            'by snapOutlines before they are added, and the bodies the same size.' %
            (unmatched, tolerance, *bodies, *place), problem]))
    if not sides:
        raise ValueError('bondAll: ' + problem)
    if problem:
        warn('bondAll: ' + problem)
    return sides
