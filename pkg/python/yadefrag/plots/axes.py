"""Matplotlib axes for the pictures of this package."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

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
