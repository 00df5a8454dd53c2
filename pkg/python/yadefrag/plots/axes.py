"""Matplotlib axes for the pictures of this package."""

from __future__ import annotations

from typing import TYPE_CHECKING

from yadefrag.arguments import refuse

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_PANELS = 12  # in one picture


def requireAxes(ax: object) -> Axes:
    """`ax`; ValueError if it is not an Axes of Matplotlib."""
    from matplotlib.axes import Axes
    if not isinstance(ax, Axes):
        refuse('ax', ax, "Matplotlib's axes")
    return ax


def newAxes() -> Axes:
    """Axes of a new figure. Without pyplot: a picture for a file must not need, or open, a window."""
    return _figure(8, 6).add_subplot()


def newPanels(count: int, width: float, height: float) -> list[Axes]:
    """A list of `count` axes in a new figure, for contents of `width` by `height`: side by side, or
    below each other if the contents are more than twice as wide as high."""
    shape = min(max(height / width if width > 0 else 1, .12), 2)
    isWide = shape < .5
    across = 9 if isWide else 4.5  # inches per axes, including the colour bar
    size = across + 1.5, across * shape + .9
    figure = _figure(size[0] * (1 if isWide else count), size[1] * (count if isWide else 1))
    rows, columns = (count, 1) if isWide else (1, count)
    return list(figure.subplots(rows, columns, squeeze=False).flat)


def _figure(width, height):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    figure = Figure(figsize=(width, height), layout='compressed')  # leaves labels room beside axes of a fixed ratio
    FigureCanvasAgg(figure)
    return figure
