"""The table that tradeoff() returns: rows, Pareto front, Markdown, plot."""

from __future__ import annotations

import csv
import dataclasses
import statistics
import textwrap
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from yadefrag.arguments import File, path, real, refuse, shownPath
from yadefrag.files import savePicture, writeText
from yadefrag.plots.axes import axesOf
from yadefrag.studies.table import SEED, EnsembleRow, Table, columnsOf, decode, describe, encode, grouped, namesOf

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_TIMES = {'wall': 'wall-clock time over simulated time (s/s)', 'cpu': 'processor time over simulated time (s/s)'}
_LATER = 'seconds', 'warnings'  # columns that older files do not have
_FRONT, _OTHER = '#d1495b', '#3d8fb5'
# Possible positions of a point's text: offset in points, alignment.
_SIDES = [(6, 0, 'left', 'center'), (0, 6, 'center', 'bottom'), (0, -6, 'center', 'top'), (-6, 0, 'right', 'center'),
          (5, 5, 'left', 'bottom'), (-5, 5, 'right', 'bottom'), (5, -5, 'left', 'top'), (-5, -5, 'right', 'top'),
          (0, 16, 'center', 'bottom'), (0, -16, 'center', 'top')]


@dataclasses.dataclass
class TradeoffRow(EnsembleRow):
    """One setting and the result of its runs, as in an EnsembleRow; times are medians.

    settings    those varied, and the scene's own ones that it used
    cpu         processor time over simulated time (s/s)
    error       relative to the reference (absolute if that is 0); None without any
    walls, cpus of the single runs (s/s), in their order
    """

    cpu: float | None = None
    error: float | None = None
    walls: list = dataclasses.field(default_factory=list)
    cpus: list = dataclasses.field(default_factory=list)

    def take(self, found: dict[str, Any]) -> None:
        """Stores the result of one run."""
        said = self.warnings
        super().take(found)
        self.warnings = list(dict.fromkeys([*said, *self.warnings]))
        for name, value in found.get('used', {}).items():  # the scene's own choices, unless varied
            if value is not None:
                self.settings.setdefault(name, value)
        if self.result != 'ok':
            self.walls, self.cpus, self.cpu = [], [], None
            return
        self.walls.append(found['wall'])
        self.cpus.append(found['cpu'])
        self.wall, self.cpu = statistics.median(self.walls), statistics.median(self.cpus)
        self.seconds = found['seconds'] * self.wall / found['wall']


class TradeoffTable(Table):
    """rows (list of TradeoffRow), title, by (names of choices that make another problem), references (rows
    that are the reference for the others of their problem); reference is the first of these, or None.

    `read` reads a file written by `csv`; the reference's row is not marked there.
    """

    _ROW, _ENDINGS = TradeoffRow, ('.csv', '.md', '.png')

    def __init__(self, rows: Iterable[TradeoffRow], title: str = '', by: str | Sequence[str] = ()) -> None:
        super().__init__(rows, title)
        self.by, self.references = namesOfCases(by), []

    @property
    def reference(self) -> TradeoffRow | None:
        return self.references[0] if self.references else None

    def cases(self) -> list[tuple[dict[str, Any], list[TradeoffRow]]]:
        """[(dict of settings, rows)]: the rows of one problem each, by `by` and the seed."""
        return grouped(self.rows, [*self.by, SEED])

    def means(self) -> TradeoffTable:
        """A table with one row for the rows that differ in the seed only: medians of times, the mean of the
        errors, and in `message` their number; self without seeds."""
        names = [name for name in self.names() if name != SEED]
        if len(names) == len(self.names()):
            return self
        rows = []
        for settings, group in grouped(self.rows, names):
            good: list[Any] = [row for row in group if row.error is not None]
            mean = TradeoffRow(settings, 'ok' if good else group[0].result, message='%d of %d seeds' %
                               (len(good), len(group)))
            for name in ('wall', 'cpu', 'steps', 'seconds') if good else ():
                known = [getattr(row, name) for row in good if getattr(row, name) is not None]
                setattr(mean, name, statistics.median(known) if known else None)
            if good:
                mean.error = statistics.fmean(row.error for row in good)
                mean.walls, mean.cpus = ([t for row in good for t in getattr(row, n)] for n in ('walls', 'cpus'))
            rows.append(mean)
        return TradeoffTable(rows, self.title, self.by)

    def names(self) -> list[str]:
        """Names of all choices, in the order in which they first occur."""
        return namesOf(self.rows)

    def label(self, row: TradeoffRow) -> str:
        """Difference of a row from the first: 'passes=2'; 'row 1' for that one."""
        self._requireRow(row)
        if not self.rows:
            raise ValueError('the table has no rows.')
        first = self.rows[0].settings
        other = {name: value for name, value in row.settings.items() if encode(value) != encode(first.get(name))}
        return describe(other) if other else 'row 1'

    def front(self, time: str = 'wall') -> list[TradeoffRow]:
        """The Pareto front: rows for which no other row of the same problem is at least as fast and as
        accurate and better in one of both.

        `time` is 'wall' or 'cpu'. Problem by problem in order of time; without the references.
        """
        _requireTime(time)
        return [row for _, rows in self.cases() for row in self._front(rows, time)]

    def _front(self, rows, time):
        rows = [row for row in rows if row.error is not None and not self.isReference(row)]

        def point(row):
            return getattr(row, time), row.error

        best, least = [], float('inf')
        for row in sorted(rows, key=point):
            if row.error < least or best and point(row) == point(best[-1]):
                best.append(row)
                least = row.error
        return best

    def isReference(self, row: TradeoffRow) -> bool:
        return any(row is one for one in self.references)

    def ratio(self, row: TradeoffRow, time: str = 'wall') -> float | None:
        """Time over that of the first row, the median of adjacent runs; None without."""
        self._requireRow(row)
        _requireTime(time)
        pairs = [(a, b) for a, b in zip(getattr(row, time + 's'), getattr(self.rows[0], time + 's')) if b > 0]
        return statistics.median(a / b for a, b in pairs) if pairs else None

    @classmethod
    def read(cls, file: File, title: str = '') -> TradeoffTable:
        """The table from a file written by `csv`. ValueError if a column is missing, or for a value
        that `csv` cannot have written."""
        name = path('file', file)
        with open(name, newline='', encoding='utf-8-sig', errors='replace') as f:
            try:
                lines = list(csv.reader(f))
            except csv.Error as error:
                raise ValueError('%s is not a table: %s.' % (shownPath(name), error)) from None
        head = lines[0] if lines else []
        missing = [column for column in columnsOf(TradeoffRow) if column not in (*head, *_LATER)]
        if missing:
            raise ValueError('%s is without the columns %s.' % (shownPath(name), ', '.join(missing)))
        rows = [_row(head, line) for line in lines[1:]]
        if None in rows:
            raise ValueError('%s has a damaged row, the one after %d others.' % (shownPath(name), rows.index(None)))
        return cls(rows, title)

    def __str__(self) -> str:
        """As Markdown."""
        return self.markdown() if self.rows else 'no rows'

    def markdown(self, file: File | None = None, time: str = 'wall') -> str:
        """The table as Markdown text, rows of the front in bold; written to `file` if it is given.

        Times are also shown relative to the first row (ratio), settings by `label`.
        """
        front = self.front(time)
        if not self.rows:
            raise ValueError('the table has no rows.')
        out = ['# %s\n' % self.title] * bool(self.title)
        out += ['Row 1: %s. The others differ from row 1 as stated.\n' % describe(self.rows[0].settings),
                'Times are those of the steps: of a run, and per simulated second.\n',
                '| # | setting | run, s | wall, s/s | cpu, s/s | %s × | steps | error |' % time,
                '|--:|---|--:|--:|--:|--:|--:|--:|']
        row: Any
        for number, row in enumerate(self.rows, 1):
            bold = '**' if row in front else ''
            cells = [str(number), bold + self.label(row) + bold]
            if row.result == 'ok':
                ratio = self.ratio(row, time)
                error = row.message if row.error is None else '%.3g' % row.error
                error += ' (reference)' if self.isReference(row) else ''
                cells += ['' if row.seconds is None else '%.3g' % row.seconds, '%.4g' % row.wall, '%.4g' % row.cpu,
                          '' if ratio is None else '%.2f' % ratio, str(row.steps), error]
            else:
                cells += ['', '', '', '', '', '%s: %s' % (row.result, row.message) if row.message else row.result]
            out.append('| ' + ' | '.join(cell.replace('|', '\\|') for cell in cells) + ' |')
        whole = '\n'.join(out) + '\n' + self._meansText()
        if file is not None:
            writeText(path('file', file), whole)
        return whole

    def _meansText(self):
        """Means over the seeds, as Markdown; '' without seeds."""
        means = self.means()
        if means is self:
            return ''
        lines = ['', 'Means over the seeds:', '', '| setting | seeds | wall, s/s | error |', '|---|--:|--:|--:|']
        row: Any
        for row in means.rows:
            numbers = ['', ''] if row.error is None else ['%.4g' % row.wall, '%.3g' % row.error]
            lines.append('| %s |' % ' | '.join([describe(row.settings), row.message, *numbers]).replace('\n', ' '))
        return '\n'.join(lines) + '\n'

    def plot(self, file: File | None = None, ax: Axes | None = None, time: str = 'wall', names: bool = True) -> Axes:
        """Draws error over time, with the Pareto front as a line; returns Matplotlib's axes.

        Points have the numbers of the Markdown table, explained at the side; without `names` at the
        side, all points with enough room have names. `file` is the path of a picture; its ending
        determines the format. ValueError if no row has an error to show.
        """
        front = self.front(time)
        shown: list[Any] = [row for row in self.rows if row.error is not None and not self.isReference(row)]
        if not shown:
            raise ValueError('no row of the table has an error to show.')
        isNew, ax = ax is None, axesOf(ax)
        if isNew:
            ax.figure.set_size_inches(11, max(4.8, .235 * max(len(self.rows), 12) + 1.2))
        # An error of 0 cannot be shown on a logarithmic axis: it is drawn at a tenth of the smallest
        # other one.
        floor = min((row.error for row in shown if row.error > 0), default=1e-16) / 10
        at = {id(row): (getattr(row, time), max(row.error, floor)) for row in shown}
        for _, rows in self.cases():
            line = [at[id(row)] for row in front if any(row is one for one in rows)]
            if line:
                ax.step(*zip(*line), where='post', color=_FRONT, lw=1.2, alpha=.6, zorder=1)
        for row in shown:
            colour = _FRONT if row in front else _OTHER
            ax.plot(*at[id(row)], 'o', color=colour, ms=6, zorder=2)
        ax.set(xscale='log', yscale='log', xlabel=_TIMES[time], ylabel='error')
        ax.margins(.08)
        for axis in (ax.xaxis, ax.yaxis):
            _plainTicks(axis)
        ax.grid(color='.9', lw=.6, zorder=0)
        ax.spines[['top', 'right']].set_visible(False)
        ax.set_title(self.title, loc='left', fontsize=11)
        # The most important texts are placed first.
        shown.sort(key=lambda row: (row not in front, row is not self.rows[0]))
        if names:
            _legend(ax, self, front)
            _marks(ax, [(at[id(row)], str(self.rows.index(row) + 1), row in front) for row in shown], isNeeded=True)
        else:
            _marks(ax, [(at[id(row)], self.label(row), row in front) for row in shown], isNeeded=False)
        savePicture(ax.figure, file, dpi=110)
        return ax

    def write(self, files: File, time: str = 'wall') -> None:
        """files.csv, files.md and, if there is something to show, files.png."""
        table, readable, picture = self.namesOfFiles(files)
        self.csv(table)
        self.markdown(readable, time)
        if self.front(time):
            self.plot(picture, time=time)


def namesOfCases(by: str | Sequence[str]) -> tuple[str, ...]:
    """A tuple of names from one or several."""
    names = (by,) if isinstance(by, str) else by
    if not isinstance(names, (list, tuple)) or not all(isinstance(name, str) for name in names):
        refuse('by', by, 'the name of a choice, or a list of names')
    return tuple(names)


def _requireTime(time):
    if not isinstance(time, str) or time not in _TIMES:
        refuse('time', time, "'wall' or 'cpu'")


def _row(head, line):
    """The TradeoffRow of a line below `head`; None for a line that `csv` cannot have written."""
    if len(line) != len(head):
        return None
    cells = dict(zip(head, map(decode, line)))
    known = {name: cells.pop(name) for name in columnsOf(TradeoffRow) if name in cells}
    row = TradeoffRow({name: value for name, value in cells.items() if value is not None}, **known)
    row.message, row.warnings = row.message or '', row.warnings or []
    isRight = (isinstance(row.result, str) and isinstance(row.message, str)
               and all(real(value) is not None or value is None and row.result != 'ok'
                       for value in (row.wall, row.cpu, row.steps))
               and all(one is None or real(one) is not None for one in (row.error, row.seconds))
               and isinstance(row.warnings, list)
               and all(isinstance(times, list) and None not in map(real, times)
                       for times in (row.walls, row.cpus)))
    return row if isRight else None


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
