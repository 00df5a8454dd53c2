"""For the pictures of this package: Matplotlib axes; distinct colours, for curves and for adjacent fragments; YADE's own
bodies, and cracks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy

from yade import wrapper
from yadefrag import _yadefrag
from yadefrag.arguments import FESolver, refuse

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_PANELS = 12  # in one picture
# Twelve for curves in one picture. Any two differ by at least 0.25 in red, green and blue together.
DISTINCT: tuple[str, ...] = ('#1f77b4', '#d62728', '#2ca02c', '#ff7f0e', '#9467bd', '#17becf', '#8c564b', '#e377c2',
            '#000000', '#bcbd22', '#7f7f7f', '#005a1e')

_MOST_PARTS = 100  # of a side
_SATURATED = 10  # first colours of the palette, used before the pale ones
WIDENING = .5  # of the other contents: largest enlargement of a picture by rigid bodies, per side


def axesOf(ax: object) -> Axes:
    """`ax`, or, for None, axes of a new figure; ValueError if it is not an Axes of Matplotlib."""
    from matplotlib.axes import Axes
    if ax is None:
        return newFigure(8, 6).add_subplot()
    if not isinstance(ax, Axes):
        refuse('ax', ax, "Matplotlib's axes")
    return ax


def _isWide(width, height):
    return height < .5 * width


def barSettings(width: float, height: float) -> dict[str, Any]:
    """Of a colour bar that is as long as the longer side of contents of `width` by `height`."""
    if _isWide(width, height):
        return dict(location='bottom', aspect=90, fraction=.5)
    return dict(location='right', aspect=60, fraction=.5) if height > 2 * width else dict(location='right')


def panelSize(width: float, height: float, largest: float = 9) -> tuple[float, float]:
    """(inches) Axes for contents of `width` by `height`, with room for labels and a colour bar."""
    shape = min(max(height / width if width > 0 else 1, .02), 2)
    if _isWide(1, shape):
        return largest + .8, largest * shape + 1.4
    across = min(largest / 1.6, largest / 1.6 / shape)
    return across + 1.7, across * shape + .8


def newPanels(count: int, width: float, height: float) -> list[Axes]:
    """A list of `count` axes in a new figure, for contents of `width` by `height`: side by side, or
    below each other if the contents are more than twice as wide as high."""
    across, high = panelSize(width, height, 9 if count == 1 or _isWide(width, height) else 7.2)
    rows, columns = (count, 1) if _isWide(width, height) else (1, count)
    # Compressed axes below each other would cover the labels of the bars between them.
    figure = newFigure(across * columns, high * rows, 'constrained' if rows > 1 else 'compressed')
    return list(figure.subplots(rows, columns, squeeze=False).flat)


def newFigure(width: float, height: float, layout: str = 'compressed') -> Figure:
    """Of (inches), without pyplot: a picture for a file must not need, or open, a window."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    # Both leave labels room; the compressed one also moves axes of a fixed ratio together.
    figure = Figure(figsize=(width, height), layout=layout)
    figure.get_layout_engine().set(w_pad=.08, h_pad=.08)
    FigureCanvasAgg(figure)
    return figure


def palette() -> list[tuple[float, float, float]]:
    """Twenty colours, the ten saturated ones first."""
    from matplotlib import colormaps
    pairs = colormaps['tab20'].colors
    return [*pairs[::2], *pairs[1::2]]


def fragmentColours(fe: FESolver, former: numpy.ndarray | None = None) -> numpy.ndarray:
    """(m) a small number for each triangle: the same within a fragment, different in adjacent ones;
    0 for removed triangles. Must be called between two steps.

    former  result of an earlier call: a fragment keeps its colour if possible
    """
    ofAll = numpy.asarray(fe.fragmentOf, dtype=int)
    shown = numpy.nonzero(ofAll >= 0)[0]
    of = ofAll[shown]
    count = int(of.max()) + 1 if len(of) else 0
    beside = _neighbours(fe, shown, of, count)
    sizes = numpy.bincount(of, minlength=count)
    firsts = numpy.full(count, len(ofAll))
    numpy.minimum.at(firsts, of, shown)
    colours, used = numpy.full(count, -1), [0] * _SATURATED
    for fragment in numpy.argsort(-sizes, kind='stable'):
        taken = {colours[other] for other in beside[fragment]}
        wanted = -1 if former is None else int(former[firsts[fragment]])
        if wanted < 0 or wanted in taken:
            free = [c for c in range(_SATURATED) if c not in taken]
            wanted = min(free, key=used.__getitem__) if free else \
                next(c for c in range(_SATURATED, count + 1 + _SATURATED) if c not in taken)
        if wanted < _SATURATED:
            used[wanted] += 1
        colours[fragment] = wanted
    result = numpy.zeros(len(ofAll), dtype=int)
    result[shown] = colours[of]
    return result


def _neighbours(fe, shown, of, count):
    """For each fragment the set of fragments that share a point of the stress-free shape with it, or
    whose boundary is within about half the mean length of a side."""
    triangles = numpy.asarray(fe.triangles, dtype=int)[shown]
    corners, reference = numpy.asarray(fe.nodes)[triangles], numpy.asarray(fe._reference)[triangles]
    points, fragments, length = _pointsOfSides(corners, of)
    cells = [numpy.floor(points / length + (x, y)) for x in (0, .5) for y in (0, .5)]
    beside = [set() for _ in range(count)]
    for places, owners in [(reference.reshape(-1, 2), numpy.repeat(of, 3)), *((c, fragments) for c in cells)]:
        _, place = numpy.unique(places, axis=0, return_inverse=True)
        pairs = numpy.unique(numpy.stack([place.ravel(), owners], axis=1), axis=0)
        ends = numpy.nonzero(numpy.diff(pairs[:, 0]))[0] + 1
        for group in numpy.split(pairs[:, 1], ends):
            if len(group) > 1:
                for fragment in group:
                    beside[fragment].update(group)
    for fragment, others in enumerate(beside):
        others.discard(fragment)
    return beside


def _pointsOfSides(corners, of):
    """(points (k, 2) along the triangles' sides, their fragments (k), mean length of a side): the points
    are at most half of that apart, also where one body is coarser than others."""
    begins, ends = corners.reshape(-1, 2), numpy.roll(corners, -1, axis=1).reshape(-1, 2)
    lengths = numpy.linalg.norm(ends - begins, axis=1)
    mean = lengths.mean() if len(lengths) and lengths.mean() > 0 else 1.
    parts = numpy.clip(numpy.ceil(2 * lengths / mean), 1, _MOST_PARTS).astype(int)
    side = numpy.repeat(numpy.arange(len(parts)), parts)
    share = (numpy.arange(len(side)) - numpy.repeat(numpy.cumsum(parts) - parts, parts)) / parts[side]
    points = begins[side] + share[:, None] * (ends - begins)[side]
    return points, numpy.repeat(of, 3)[side], mean


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
        for section in sections:
            kind, points = section.kind, numpy.array(section.points)
            if not numpy.isfinite(points).all():
                continue
            if kind == 'wall':
                axis = int(points[0, 0] != points[1, 0])
                self.walls.append((axis, points[0, axis]))
            else:
                (self.outlines if kind == 'outline' else self.lines).append(points)
            colour = wrapper.Omega().bodies[section.body].shape.color
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
            sides, sides, numpy.zeros(len(sides)), units='xy', offsets=self.places, offset_transform=ax.transData,
            facecolors=self._shades, edgecolors='k', linewidths=.3, zorder=2), autolim=False)

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

    def mirror(self) -> None:
        """Adds those on the other side of x = 0."""
        self.held, self.open = (numpy.concatenate([lines, lines * (-1, 1)]) for lines in (self.held, self.open))
        self.damage = numpy.tile(self.damage, 2)

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
