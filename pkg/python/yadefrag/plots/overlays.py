"""YADE's own bodies in Matplotlib's pictures: spheres, walls, boxes and facets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy

from yade import wrapper
from yadefrag import _yadefrag
from yadefrag.arguments import FESolver

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDENING = .5  # of the other contents: largest enlargement of a picture by rigid bodies, per side


class YadeBodies:
    """Bodies of YADE's scene at present.

    places, radii    of spheres: (n, 2), (n) in m; empty without `spheres`
    outlines, lines  sections of boxes and facets with the plane z = 0: lists of arrays (k, 2) in m;
                     empty without `rigidBodies`
    walls            [(axis that they cross, position on it in m)]
    """

    def __init__(self, spheres: bool, rigidBodies: bool) -> None:
        self._takeSpheres(wrapper.Omega().bodies if spheres else ())
        sections = _yadefrag.sectionsOfScene() if rigidBodies else ()
        self.outlines, self.lines, self.walls = [], [], []
        self._colours = {'outline': [], 'line': [], 'wall': []}
        for number, kind, points in sections:
            points = numpy.array(points)
            if not numpy.isfinite(points).all():
                continue
            if kind == 'wall':
                axis = int(points[0, 0] != points[1, 0])
                self.walls.append((axis, points[0, axis]))
            else:
                (self.outlines if kind == 'outline' else self.lines).append(points)
            colour = wrapper.Omega().bodies[number].shape.color
            self._colours[kind].append(numpy.clip(colour, 0, 1))

    def _takeSpheres(self, bodies):
        found = [(body.state.pos[0], body.state.pos[1], body.shape.radius, *body.shape.color)
                 for body in bodies if isinstance(body.shape, wrapper.Sphere)]
        table = numpy.array(found, dtype=float).reshape(-1, 6)
        table = table[numpy.isfinite(table).all(axis=1)]
        self.places, self.radii, self._shades = table[:, :2], table[:, 2], table[:, 3:].clip(0, 1)

    def extent(self, low: numpy.ndarray, high: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
        """The lower left and upper right corner of a picture of all bodies and of the box from `low` to
        `high`, each (2) in m."""
        arms = self.radii[:, None]
        low = numpy.vstack([[low], self.places - arms]).min(axis=0)
        high = numpy.vstack([[high], self.places + arms]).max(axis=0)
        margin = WIDENING * (high - low).max()
        lowest, highest = low - margin, high + margin
        parts = [(part.min(axis=0), part.max(axis=0)) for part in self.outlines + self.lines]
        for axis, place in self.walls:
            ends = low.copy(), high.copy()
            ends[0][axis] = ends[1][axis] = place
            parts.append(ends)
        for begin, end in parts:
            if (end >= lowest).all() and (begin <= highest).all():
                low = numpy.minimum(low, begin.clip(lowest, highest))
                high = numpy.maximum(high, end.clip(lowest, highest))
        return low, high

    def draw(self, ax: Axes, low: numpy.ndarray, high: numpy.ndarray) -> None:
        """Adds them to the axes, whose limits are extended up to extent(low, high)."""
        self._drawRigid(ax)
        self._drawSpheres(ax)
        ax.update_datalim(self.extent(low, high))
        ax.autoscale_view()

    def _drawSpheres(self, ax):
        from matplotlib.collections import EllipseCollection
        if not len(self.radii):
            return
        sides = 2 * self.radii
        ax.add_collection(EllipseCollection(
            sides, sides, numpy.zeros(len(sides)), units='xy', offsets=self.places,
            offset_transform=ax.transData, facecolors=self._shades, edgecolors='k', linewidths=.3,
            zorder=2), autolim=False)

    def _drawRigid(self, ax):
        from matplotlib.collections import LineCollection, PolyCollection
        from matplotlib.lines import Line2D
        from matplotlib.patheffects import withStroke
        rim = [withStroke(linewidth=2.6, foreground='k')]  # for lines as bright as the background
        if self.outlines:
            ax.add_collection(PolyCollection(self.outlines, facecolors=self._colours['outline'],
                                             edgecolors='k', linewidths=.6, zorder=.9), autolim=False)
        if self.lines:
            ax.add_collection(LineCollection(self.lines, colors=self._colours['line'], linewidths=1.6,
                                             path_effects=rim, zorder=2), autolim=False)
        for (axis, place), colour in zip(self.walls, self._colours['wall']):
            along = [place, place], [0, 1]  # across the axes, for any limits
            onto = (ax.get_xaxis_transform, ax.get_yaxis_transform)[axis]('grid')
            ax.add_artist(Line2D(*along[::(1, -1)[axis]], transform=onto, color=colour, linewidth=1.6,
                                 path_effects=rim, zorder=2))


_SCALE = ('#ffd21f', '#ff6a00', '#d4001a', '#7a0019')  # no damage to all of it
_OPEN = 'black'
_WIDTH = .12, 1.4  # of a crack's line: of the mean side of a crack on the paper, but at most these points


def _crackLines(sides, **settings):
    """A LineCollection whose width follows the scale of the picture: cracks do not hide what they divide."""
    from matplotlib.collections import LineCollection

    class Lines(LineCollection):
        def draw(self, renderer):
            (left, _), (right, _) = self.axes.transData.transform([(0, 0), (side, 0)])
            self.set_linewidth(min(_WIDTH[0] * 72 * abs(right - left) / self.figure.dpi, _WIDTH[1]))
            super().draw(renderer)

    side = numpy.linalg.norm(sides[:, 1] - sides[:, 0], axis=1).mean()
    return Lines(sides, **settings)


class CrackLines:
    """Lines of the cracks at positions of the nodes (n, 2). Must be created between two steps."""

    def __init__(self, fe: FESolver, places: numpy.ndarray) -> None:
        cracks = fe._cracks()
        held, sides = cracks['held'], places[cracks['nodes']].reshape(-1, 4, 2)
        # A cohesive crack has hardly any width: one line between its two sides.
        self.held = (sides[held, :2] + sides[held, 2:]) / 2
        self.damage = cracks['damage'][held]
        self.open = sides[~held].reshape(-1, 2, 2)  # both faces

    def draw(self, ax: Axes) -> Any:
        """Draws all; returns the lines with a colour scale, None without any."""
        from matplotlib.colors import LinearSegmentedColormap, Normalize
        scaled = None
        if len(self.held):
            colours = LinearSegmentedColormap.from_list('damage', _SCALE)
            scaled = _crackLines(self.held, cmap=colours, norm=Normalize(0, 1), zorder=3, label='held')
            scaled.set_array(self.damage)
            ax.add_collection(scaled, autolim=False)
        if len(self.open):
            ax.add_collection(_crackLines(self.open, colors=_OPEN, zorder=4, label='open'), autolim=False)
        return scaled


def damageBar(panels: Sequence[Axes], lines: Sequence[Any]) -> None:
    """One bar for the damage in all panels, if one of them has lines with a scale."""
    scaled = next((one for one in lines if one is not None), None)
    if scaled is not None:
        panels[0].figure.colorbar(scaled, ax=panels, location='bottom', shrink=.5, aspect=40, pad=.02,
                                  label='damage of cracks that hold; open ones are black')
