"""The table that ensemble() returns: rows, means with confidence bands, CSV, plot."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy

from yadefrag.arguments import ArrayLike, File, array, number, real, refuse, text
from yadefrag.files import savePicture
from yadefrag.messages import needed
from yadefrag.plots.axes import DISTINCT, axesOf
from yadefrag.studies.table import EnsembleRow, Table, describe, grouped, samples, varying

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_PLACES = 200  # points of a curve


class EnsembleTable(Table):
    """rows (list of EnsembleRow), title; rows without a value are not part of means.

    A band is the confidence band of the mean at each point separately: if the values of the runs are
    approximately normal, it contains the mean of all possible runs with the stated confidence
    (Student's t distribution). Numbers measured in one run may depend on each other; runs do not.
    """

    _ROW, _ENDINGS = EnsembleRow, ('.csv', '.png')

    def __str__(self) -> str:
        """A line for each row, and the means of the runs that differ in nothing but seeds and samples."""
        lines = [self.title] * bool(self.title) + [
            '%s: %s' % (describe(row.settings), _found(row)) for row in self.rows]
        among = samples(self.rows)
        for name in self.quantities() or ['']:
            table = self.of(name).statistics() if name else self.statistics()
            for (settings, _), line in zip(grouped(self.rows, varying(self.rows)), table):
                if line['runs']:
                    before = [name] * bool(name) + [describe(settings)] * bool(settings)
                    lines.append(': '.join([*before, _meanText(line, among)]))
        return '\n'.join(lines)

    def good(self) -> list[EnsembleRow]:
        """Rows with a value."""
        return [row for row in self.rows if row.result == 'ok']

    def quantities(self) -> list[str]:
        """Names of the quantities, if measure returned several."""
        return list(dict.fromkeys(name for row in self.good() if isinstance(row.value, dict) for name in row.value))

    def of(self, quantity: str) -> EnsembleTable:
        """The table of one of several quantities. ValueError for another name."""
        if quantity not in self.quantities():
            refuse('quantity', quantity, 'one of %s' % (', '.join(map(repr, self.quantities())) or 'none'))
        rows = [dataclasses.replace(row, value=row.value[quantity])
                if isinstance(row.value, dict) and quantity in row.value else
                dataclasses.replace(row, value=None, result='failed' if row.result == 'ok' else row.result)
                for row in self.rows]
        return EnsembleTable(rows, self.title)

    def _requireOne(self):
        names = self.quantities()
        if names:
            raise ValueError('the runs have several quantities, %s: table.of(%r) is the table of one.' %
                             (', '.join(names), names[0]))

    def statistics(self, by: str | None = None, reduce: Callable[[numpy.ndarray], Any] = numpy.mean,
                   confidence: float = .95) -> numpy.ndarray:
        """Means of the measured values, with their confidence bands, as a NumPy array with named
        columns (k): one row for the runs that differ only in the seed, or in a number that is another one
        in each run.

        by      None, or the name of a setting: rows by its values, ascending; if others vary, too, one
                row for each of their combinations
        reduce  function of a run's numbers (n) → one number; default: their mean; numpy.median, len, ...
        Columns: by (value of that setting, or of the only one that varies; otherwise nan), runs, failed
        (their number), mean, deviation (of single runs), low, high (band of the mean; nan for less than
        two runs), settings (text: what the runs of the row have in common). ValueError for an unknown
        name, and for several quantities, of which table.of('name') has one.
        """
        self._requireOne()
        confidence = _share(confidence)
        if not callable(reduce):
            refuse('reduce', reduce, 'a function')
        lines = []
        for settings, value, rows in self._groups(by):
            good = [float(reduce(numpy.atleast_1d(row.value))) for row in rows if row.result == 'ok']
            mean, deviation, half = _meanOf(numpy.array(good)[:, None], confidence)
            lines.append((value, len(good), len(rows) - len(good), mean[0], deviation[0],
                          mean[0] - half[0], mean[0] + half[0], describe(settings) if settings else ''))
        names = ('by', 'runs', 'failed', 'mean', 'deviation', 'low', 'high', 'settings')
        text = 'U%d' % max((len(line[-1]) for line in lines), default=1)
        kinds = (float, int, int, float, float, float, float, text)
        return numpy.array(lines, dtype=list(zip(names, kinds)))

    def _groups(self, by):
        """[(settings, value of `by`, rows)] by all that varies, in the order of the values."""
        names = varying(self.rows)
        if by is None:
            groups = grouped(self.rows, names)
            values = [of.get(names[0]) if len(names) == 1 else None for of, _ in groups]
            values = [math.nan if real(value) is None else value for value in values]
            return [(of, value, rows) for (of, rows), value in zip(groups, values)]
        if not self.rows or not isinstance(by, str) or None in [real(row.settings.get(by)) for row in self.rows]:
            refuse('by', by, 'the name of a setting that is a number in all rows')
        names = [name for name in names if name != by] + [by]
        return sorted(((of, of[by], rows) for of, rows in grouped(self.rows, names)), key=lambda one: one[1])

    def shares(self, places: ArrayLike | None = None, confidence: float = .95) -> numpy.ndarray:
        """Fraction of a run's numbers that are at least as large as a given value, over all runs.

        places  values (k), or None: 200 from the smallest measured number to the largest, in equal
                ratios if all are positive
        Returns a NumPy array with named columns (k): place, mean (fraction of a run's numbers,
        averaged over the runs), low, high (band of that mean, within 0 and 1). ValueError without a
        run that has numbers.
        """
        self._requireOne()
        confidence = _share(confidence)
        runs = [numpy.sort(numpy.atleast_1d(row.value)) for row in self.good()]
        if not runs:
            raise ValueError('no run has a value: there is nothing to draw or to average.')
        places = _places(runs) if places is None else array(places, float)
        if places is None or places.ndim != 1 or not numpy.isfinite(places).all():
            refuse('places', places, 'a list of finite numbers')
        table = numpy.array([1 - numpy.searchsorted(run, places, 'left') / len(run) for run in runs])
        mean, _, half = _meanOf(table, confidence)
        half = numpy.nan_to_num(half, nan=1)  # unknown for a single run
        columns = places, mean, numpy.clip(mean - half, 0, 1), numpy.clip(mean + half, 0, 1)
        names = ('place', 'mean', 'low', 'high')
        return numpy.array(list(zip(*columns)), dtype=[(name, float) for name in names])

    def plot(self, file: File | None = None, ax: Axes | None = None, by: str | None = None,
             confidence: float = .95, label: str = 'measured value') -> Axes:
        """Draws the table; returns Matplotlib's axes.

        by     None: the fraction of numbers at least as large as a value, each run in grey, and the
               mean with its band; or the name of a setting: each run's mean over it, and their mean
               with its band
        label  of the axis of the measured value
        """
        label, ax = text('label', label), axesOf(ax)
        (self._plotShares if by is None else self._plotBy)(ax, by, confidence, label)
        ax.set_title(self.title)
        ax.grid(True, linewidth=.3)
        ax.legend()
        savePicture(ax.figure, file, dpi=150)
        return ax

    def _plotShares(self, ax, _, confidence, label):
        self.shares()  # refuses a table without values
        lowest = min(numpy.min(row.value) for row in self.good())
        groups = [(of, EnsembleTable(rows)) for of, rows in grouped(self.good(), varying(self.rows))]
        for (of, group), colour in zip(groups, itertools.cycle(DISTINCT)):
            band = group.shares(confidence=confidence)
            for row in group.rows:
                values = numpy.sort(numpy.atleast_1d(row.value))
                ax.step(values, 1 - numpy.arange(len(values)) / len(values), where='pre', color='.75',
                        linewidth=.6, zorder=1)
            _drawBand(ax, band['place'], band, [len(group.rows)], confidence, colour=colour, of=of)
        if lowest > 0:
            ax.set_xscale('log')
        ax.set(xlabel=label, ylabel='fraction at least as large', ylim=(0, 1.02))

    def _plotBy(self, ax, by, confidence, label):
        self.statistics(by)  # refuses an unknown name
        others = [name for name in varying(self.rows) if name != by]
        for row in self.good():
            ax.plot(row.settings[by], numpy.mean(row.value), '.', color='.6', zorder=1)
        for (of, rows), colour in zip(grouped(self.rows, others), itertools.cycle(DISTINCT)):
            group = EnsembleTable(rows)
            table = group.statistics(by, confidence=confidence)
            _drawBand(ax, table['by'], table, table['runs'], confidence, 'o-', colour, of)
        ax.set(xlabel=by, ylabel=label)

    def write(self, files: File) -> None:
        """Writes files.csv and, if a run has a value, files.png: of several quantities the first."""
        table, picture = self.namesOfFiles(files)
        self.csv(table)
        names = self.quantities()
        if self.good():
            (self.of(names[0]) if names else self).plot(picture, label=names[0] if names else 'measured value')


def _meanText(line, among):
    """A line of `statistics` as text; among: names of settings that are another one in each run."""
    sentence = 'Mean of %d run%s%s: %.6g' % (
        line['runs'], 's' if line['runs'] > 1 else '',
        ', each with another ' + ' and '.join(among) if among and line['runs'] > 1 else '', line['mean'])
    if math.isfinite(line['low']):
        sentence += ', with 95 %% confidence between %.6g and %.6g' % (line['low'], line['high'])
    return sentence + ('; %d have no value.' % line['failed'] if line['failed'] else '.')


def _found(row):
    """What a run gave, as text."""
    said = '; %d message%s' % (len(row.warnings), 's' * (len(row.warnings) > 1)) if row.warnings else ''
    if row.seconds is not None:
        said = '; %.3g s, %.4g s per simulated second' % (row.seconds, row.wall) + said
    return _measured(row) + said


def _measured(row):
    if row.result != 'ok':
        return '%s, %s' % (row.result, row.message) if row.message else row.result
    if isinstance(row.value, dict):
        return ', '.join('%s %s' % (name, _numbersText(one)) for name, one in row.value.items())
    return _numbersText(row.value)


def _numbersText(value):
    values = numpy.atleast_1d(value)
    if len(values) == 1:
        return '%.6g' % values[0]
    return '%.6g on average of %d' % (values.mean(), len(values)) if len(values) else 'no numbers'


def _drawBand(ax, x, table, counts, confidence, style='-', colour=DISTINCT[0], of=()):
    """counts: of the runs of each mean; of: settings of these runs, if others have other ones."""
    least, most = min(counts), max(counts)
    ax.fill_between(x, table['low'], table['high'], color=colour, alpha=.3, linewidth=0,
                    label=None if of else '%g %% band of the mean' % (100 * confidence))
    ax.plot(x, table['mean'], style, color=colour, label='%smean of %s runs' %
            (describe(of) + ': ' if of else '', least if least == most else '%d to %d' % (least, most)))


def _share(confidence):
    return number('confidence', confidence, lambda v: 0 < v < 1, 'above 0 and below 1')


def _meanOf(table, confidence):
    """(mean, deviation, half of the band) of each column of an array (runs, k); nan for too few runs."""
    count, unknown = len(table), numpy.full(table.shape[1], numpy.nan)
    mean = table.mean(axis=0) if count else unknown
    if count < 2:
        return mean, unknown, unknown
    deviation = table.std(axis=0, ddof=1)
    statistics = needed('scipy.stats', 'python3-scipy', 'confidence bands work')
    most = statistics.t.ppf((1 + confidence) / 2, count - 1)  # values are from -most to most with that probability
    return mean, deviation, most * deviation / math.sqrt(count)


def _places(runs):
    low, high = min(run[0] for run in runs), max(run[-1] for run in runs)
    return numpy.geomspace(low, high, _PLACES) if low > 0 else numpy.linspace(low, high, _PLACES)
