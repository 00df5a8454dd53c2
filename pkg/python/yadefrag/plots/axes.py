"""Matplotlib axes for the pictures of this package; distinct colours, for curves and for adjacent fragments."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy

from yadefrag.arguments import FESolver, refuse

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_PANELS = 12  # in one picture
# Twelve for curves in one picture. Any two differ by at least 0.25 in red, green and blue together.
DISTINCT = ('#1f77b4', '#d62728', '#2ca02c', '#ff7f0e', '#9467bd', '#17becf', '#8c564b', '#e377c2',
            '#000000', '#bcbd22', '#7f7f7f', '#005a1e')

_MOST_PARTS = 100  # of a side
_SATURATED = 10  # first colours of the palette, used before the pale ones


def requireAxes(ax: object) -> Axes:
    """`ax`; ValueError if it is not an Axes of Matplotlib."""
    from matplotlib.axes import Axes
    if not isinstance(ax, Axes):
        refuse('ax', ax, "Matplotlib's axes")
    return ax


def newAxes() -> Axes:
    """Axes of a new figure. Without pyplot: a picture for a file must not need, or open, a window."""
    return _figure(8, 6).add_subplot()


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
    figure = _figure(across * columns, high * rows, 'constrained' if rows > 1 else 'compressed')
    return list(figure.subplots(rows, columns, squeeze=False).flat)


def _figure(width, height, layout='compressed'):
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
