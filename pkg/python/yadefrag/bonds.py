"""Bonds between bodies of FESolver."""

import warnings

from yadefrag._yadefrag import requirePaused
from yadefrag.names import bodyNumber
from yadefrag.values import positive


def bond(self, a, b, strength, energy):
    """From the next step on bodies a and b hang together along all sides that they have in common
    now; returns how many these are (int).

    a, b      numbers or names of two bodies that touch, with nodes at the same places along what they have
              in common, to 1e-9 of a side: give both outlines the same points there, and the same
              size
    strength  Pa, tensile; the shear strength is shearFactor times that, shearFactor and
              shearEnergyFactor being those of the body with the smaller tensileStrength, 1 of FEMat
    energy    J/m², that opens the bond by tension; positive
    A bond holds as a crack does whose faces have not parted yet, by the cohesive law: an opening
    spends `energy`, and after that, or where it is shut, the faces touch like any others.
    fragments(held=True) counts what it holds as one; numCracks does not count it. ValueError before
    anything changes where no sides match, or sides run along each other without the same ends; a
    warning where sides are too long for the energy.
    """
    requirePaused()
    first, second = (bodyNumber(self, one, name, least=0)
                     for name, one in (('a', a), ('b', b)))
    sides, problem = self._bond(first, second, positive('strength', strength, 'Pa'),
                                positive('energy', energy, 'J/m²'))
    if problem:
        warnings.warn('bond: ' + problem, stacklevel=2)
    return sides
