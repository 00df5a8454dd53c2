"""fe.energy: a dict with one alias."""


class Energies(dict):
    """Energies (J) by name; 'external' is an alias: the negative of 'outside'."""

    _ALIAS = 'external'

    def __missing__(self, name):
        if name != self._ALIAS:
            raise KeyError(name)
        return 0. - self['outside']

    def __contains__(self, name):
        return name == self._ALIAS or dict.__contains__(self, name)

    def get(self, name, default=None):
        return self[name] if name in self else default


def energy(self):
    """Dict of J: kinetic, strain, contact, friction, fracture, damping, outside (energy that left:
    negative where work was done on the bodies); with minFragmentArea, dropped (energy of removed
    fragments); total, their sum, is constant, except for impacts of soft bodies that rotate, which
    reduce it by second order in O.dt: 5e-4 of the work in a drum of rubber, 1.3e-4 with half the step.
    O.energy has the same values, with the same signs, as feKinetic, feStrain ... feOutside, if
    O.trackEnergy.

    After contact with YADE's bodies also scene: total plus the energy that this contact has created
    (work on both sides, elastic energy and friction of the contacts, up to the last step); constant,
    whatever gravity, damping or prescribed motion do, unless the contact law itself dissipates by
    other means. 'external' can be read as well: it is -outside.
    """
    return Energies(self._energies)
