"""Cracks in pictures: those that hold coloured by their damage, open ones black and above them."""

import numpy

_SCALE = ('#ffd21f', '#ff6a00', '#d4001a', '#7a0019')  # no damage to all of it
_OPEN = 'black'


class CrackLines:
    """Lines of the cracks at positions of the nodes (n, 2). Must be created between two steps."""

    def __init__(self, fe, places):
        cracks = fe._cracks()
        held, sides = cracks['held'], places[cracks['nodes']].reshape(-1, 4, 2)
        # A cohesive crack has hardly any width: one line between its two sides.
        self.held = (sides[held, :2] + sides[held, 2:]) / 2
        self.damage = cracks['damage'][held]
        self.open = sides[~held].reshape(-1, 2, 2)  # both faces

    def draw(self, ax):
        """Draws all; returns the lines with a colour scale, None without any."""
        from matplotlib.collections import LineCollection
        from matplotlib.colors import LinearSegmentedColormap, Normalize
        scaled = None
        if len(self.held):
            colours = LinearSegmentedColormap.from_list('damage', _SCALE)
            scaled = LineCollection(self.held, cmap=colours, norm=Normalize(0, 1), linewidths=1.4, zorder=3,
                                    label='held')
            scaled.set_array(self.damage)
            ax.add_collection(scaled, autolim=False)
        if len(self.open):
            ax.add_collection(LineCollection(self.open, colors=_OPEN, linewidths=1.2, zorder=4, label='open'),
                              autolim=False)
        return scaled


def damageBar(panels, lines):
    """One bar for the damage in all panels, if one of them has lines with a scale."""
    scaled = next((one for one in lines if one is not None), None)
    if scaled is not None:
        panels[0].figure.colorbar(scaled, ax=panels, location='bottom', shrink=.5, aspect=40, pad=.02,
                                  label='damage of cracks that hold; open ones are black')
