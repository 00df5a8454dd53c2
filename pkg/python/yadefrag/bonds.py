"""Bonds between bodies of FESolver."""

from yadefrag.messages import warnOfOne
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
