"""The picture of a TradeoffTable."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

from yadefrag.arguments import File
from yadefrag.files import savePicture
from yadefrag.plots.axes import axesOf

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_FRONT, _OTHER = '#d1495b', '#3d8fb5'
# Possible positions of a point's text: offset in points, alignment.
_SIDES = [(6, 0, 'left', 'center'), (0, 6, 'center', 'bottom'), (0, -6, 'center', 'top'), (-6, 0, 'right', 'center'),
          (5, 5, 'left', 'bottom'), (-5, 5, 'right', 'bottom'), (5, -5, 'left', 'top'), (-5, -5, 'right', 'top'),
          (0, 16, 'center', 'bottom'), (0, -16, 'center', 'top')]


def plot(table: Any, file: File | None, ax: Axes | None, time: str, label: str | None, names: bool) -> Axes:
    """See TradeoffTable.plot, whose table this is."""
    front = table.front(time)
    shown: list[Any] = [row for row in table.rows if row.error is not None and not table.isReference(row)]
    if not shown:
        raise ValueError('no row of the table has an error to show.')
    isNew, ax = ax is None, axesOf(ax)
    if isNew:
        ax.figure.set_size_inches(11, max(4.8, .235 * max(len(table.rows), 12) + 1.2))
    # An error of 0 cannot be shown on a logarithmic axis: it is drawn at a tenth of the smallest
    # other one.
    floor = min((row.error for row in shown if row.error > 0), default=1e-16) / 10
    at = {id(row): (getattr(row, time), max(row.error, floor)) for row in shown}
    for _, rows in table.cases():
        line = [at[id(row)] for row in front if any(row is one for one in rows)]
        if line:
            ax.step(*zip(*line), where='post', color=_FRONT, lw=1.2, alpha=.6, zorder=1)
    for row in shown:
        colour = _FRONT if row in front else _OTHER
        ax.plot(*at[id(row)], 'o', color=colour, ms=6, zorder=2)
    ax.set(xscale='log', yscale='log', xlabel=label, ylabel='error')
    ax.margins(.08)
    for axis in (ax.xaxis, ax.yaxis):
        _plainTicks(axis)
    ax.grid(color='.9', lw=.6, zorder=0)
    ax.spines[['top', 'right']].set_visible(False)
    ax.set_title(table.title, loc='left', fontsize=11)
    # The most important texts are placed first.
    shown.sort(key=lambda row: (row not in front, row is not table.rows[0]))
    if names:
        _legend(ax, table, front)
        _marks(ax, [(at[id(row)], str(table.rows.index(row) + 1), row in front) for row in shown], isNeeded=True)
    else:
        _marks(ax, [(at[id(row)], table.label(row), row in front) for row in shown], isNeeded=False)
    savePicture(ax.figure, file, dpi=110)
    return ax


def _marks(ax, points, isNeeded):
    """Texts beside the points (position, text, bold), where they cover nothing.

    A text without such a position is left out; if it `isNeeded`, it is drawn anyway.
    """
    from matplotlib.patheffects import withStroke
    from matplotlib.transforms import Bbox
    ax.figure.canvas.draw()
    bounds = ax.get_window_extent()
    places = [ax.transData.transform(at) for at, _, _ in points]
    taken = [Bbox([place - 4, place + 4]) for place in places]
    for at, text, isBold in points:
        mark = ax.annotate(text, at, (0, 0), textcoords='offset points', fontsize=8,
                           weight='bold' if isBold else 'normal',
                           # The line of the front does not strike the text through.
                           path_effects=[withStroke(linewidth=3, foreground='w')])
        mark.set_in_layout(False)
        for dx, dy, ha, va in _SIDES:
            mark.xyann = (dx, dy)
            mark.set(ha=ha, va=va)
            box = mark.get_window_extent()
            isInside = all(bounds.contains(*corner) for corner in box.corners())
            if isInside and not any(box.overlaps(other) for other in taken):
                break
        else:
            if not isNeeded:
                mark.remove()
                continue
        taken.append(box)


def _plainTicks(axis):
    from matplotlib.ticker import FuncFormatter, NullFormatter
    low, high = axis.get_view_interval()
    axis.set_major_formatter(FuncFormatter(lambda v, _: '%g' % v))
    few = high / low < 30
    axis.set_minor_formatter(FuncFormatter(lambda v, _: '%g' % v if ('%e' % v)[0] in '25' else '')
                             if few else NullFormatter())


def _legend(ax, table, front):
    """All rows at the side, with the result of those that are not points."""
    height = 1 / max(len(table.rows), 12)
    for i, row in enumerate(table.rows):
        note = '' if row.result == 'ok' else ': ' + row.result
        note += ' (reference)' if table.isReference(row) else ''
        text = textwrap.shorten('%d  %s%s' % (i + 1, table.label(row), note), 62, placeholder=' …')
        ax.annotate(text, (1.03, 1 - (i + .5) * height), xycoords='axes fraction', fontsize=8.5,
                    va='center', color=_FRONT if row in front else '.15' if note == '' else '.5',
                    weight='bold' if row in front else 'normal')
