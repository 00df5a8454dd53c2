"""Speed against accuracy: one scene, run over a grid of choices (tradeoff).

scene_choices.py contains the known choices, runs.py the runs, run_in_yade.py a single run in its yade,
tradeoff_table.py the table.
"""

from __future__ import annotations

import itertools
import math
import os
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy

from yadefrag.arguments import ArrayLike, File, array, listOf, path, plain, refuse, shown, shownPath, text, whole
from yadefrag.files import requireWritable
from yadefrag.messages import passOn, warn
from yadefrag.studies import scene_choices as known
from yadefrag.studies.runs import Finished, counted, jobOf, keyOf, runAll
from yadefrag.studies.table import SEED, Table, columnsOf, describe
from yadefrag.studies.tradeoff_table import TradeoffRow, TradeoffTable, namesOfCases

_REPEATABLE = ('not run', 'ok')


def tradeoff(scene: Callable[[known.Choices], Any], vary: dict[str, Sequence] | Sequence[dict[str, Sequence]],
             measure: Callable[..., Any], *, duration: float, reference: ArrayLike | File | dict[str, Any] = 0.,
             watch: Callable[[Any], Any] | None = None, every: float = 0., repeats: int = 3, limit: float = 60.,
             files: File | None = None, title: str = '', executor: Any = None, resume: File | None = None,
             by: str | Sequence[str] = ()) -> TradeoffTable:
    """Runs `scene` over a grid of choices; returns a TradeoffTable of times and errors.

    scene      function (choices) that builds the scene in O and sets O.engines and O.dt, with the
               helpers of yadefrag.studies.Choices where they apply; its return value is passed to
               `measure`
    vary       dict {name: [values]}: all combinations are run; or a list of such dicts, whose grids
               are run one after the other ([{}, {'passes': [1, 2]}]: the scene's own choices,
               then the varied ones). Known names: passes, smooth, size, timeStep, halo, collider,
               verletDist, plane, bulkViscosity, fracture, threads; others are passed on.
    measure    function (built) of the scene's return value → number or numbers (n), after the run
    duration   s, simulated
    reference  the correct result: a number or numbers (n), in the unit of `measure`; a file of numbers
               for numpy.loadtxt; 'finest': the setting with the smallest size, then the smallest time
               step, then the longest time; or a dict of choices, a setting that is run as well. The
               error is relative to it (root mean square for several numbers), and absolute if it is 0.
    watch      function (built), called after each `every` s of simulated time (0: each step, for at
               least one step); the list of its return values is then passed to `measure` as well
    repeats    runs of each setting, alternating with the others; times are their medians
    limit      s, wall-clock time of a run including its set-up
    files      path without ending: writes .csv, .md and .png
    title      of the plot
    executor   None: one run after the other, here; or an executor as for ensemble. Times are meaningful
               only if each run has a separate core
    resume     None, or a file of finished runs, as for ensemble
    by         name or names of choices that make another problem, with another correct result, e.g. a
               rate of loading: each of its values has its own reference ('finest', or the dict of
               choices) and its own Pareto front; so has each 'seed'. The table also has the means of
               rows that differ in the seed only

    Each run is a separate `yade -n -x`. Times are those of steps only: wall-clock and processor
    time over simulated time. A setting that the scene or an engine refuses, that blows up, fails or
    takes too long is a row with that result. What runs warn of is in `warnings` of their rows, and is
    passed on as a warning of this call, once for each kind. Ctrl-C ends the runs; the table then has the finished
    ones. Functions must be at the top level of a file, and the call of tradeoff in a script after
    `if __name__ == '__main__':`, since each run loads the file again. ValueError, before anything
    runs, for bad arguments, OSError for files that cannot be written; RuntimeError if the file
    cannot be loaded again.
    """
    job = jobOf('tradeoff', scene, measure, watch, duration, every, limit, executor)
    settings, repeats = _grid(vary), whole('repeats', repeats)
    title, by = text('title', title), namesOfCases(by)
    right = _reference(reference)
    if isinstance(right, dict):
        settings = _withReferences(settings, right, by)
    table = TradeoffTable([TradeoffRow(settings=dict(setting)) for setting in settings], title, by)
    requireFiles(table, files)
    _runAll(table.rows, settings, job, repeats, executor, Finished(resume, job))
    _setErrors(table, right, settings)
    passOn('tradeoff', table.rows)
    writeTable(table, files)
    return table


def requireFiles(table: Table, files: File | None) -> None:
    """OSError for a file that the table could not write after the runs."""
    for name in () if files is None else table.namesOfFiles(files):
        requireWritable(name)


def writeTable(table: Any, files: File | None) -> None:
    """A full disk must not cost the results of the runs: the table is returned in any case."""
    try:
        if files is not None:
            table.write(files)
    except OSError as error:
        warn('the table could not be written: %s.' % error)


def checkChoice(name: Any, value: Any, argument: str = 'vary', row: type[Any] = TradeoffRow) -> Any:
    """`value`, as a plain number or text; ValueError with the argument if it is neither."""
    if not isinstance(name, str) or name in columnsOf(row):
        raise ValueError('%s has the choice %s, a name must be a text that is no other column of '
                         'the table.' % (argument, shown(name)))
    name, value = text('the name of a choice', name), plain(value)
    if not isinstance(value, (str, bool, int, float)):
        raise ValueError('%s has the choice %s=%s, it must be a number, a text, True or False.' %
                         (argument, shownPath(name), shown(value)))
    if isinstance(value, str):
        text(shownPath(name), value)
    known.check(name, value)
    return value


def _grid(vary):
    """List of settings (dicts), each once, all values checked."""
    grids = [vary] if isinstance(vary, dict) else vary
    if not isinstance(grids, (list, tuple)) or not grids or not all(isinstance(grid, dict) for grid in grids):
        refuse('vary', vary, 'a dict {name: [values]} or a list of those')
    settings = []
    for grid in grids:
        lists = [_values(name, values) for name, values in grid.items()]
        for combination in itertools.product(*lists):
            setting = dict(zip(grid, combination))
            if keyOf(setting) not in map(keyOf, settings):  # with the type: True is not 1
                settings.append(setting)
    return settings


def _withReferences(settings, right, by):
    """The settings, and after them those of the reference: `right` in each problem."""
    wanted = [{**{n: s[n] for n in (*by, SEED) if n in s}, **right} for s in settings]
    for one in wanted:
        if keyOf(one) not in map(keyOf, settings):
            settings = settings + [one]
    return settings


def _values(name, values):
    """The checked values of a choice; NumPy's numbers become Python's."""
    what, right = 'vary[%s]' % shown(name), 'a list of values'
    found = listOf(what, values, right) or refuse(what, values, right)
    return [checkChoice(name, value) for value in found]


def _reference(reference):
    """'finest', a checked setting, or an array of numbers."""
    if isinstance(reference, dict):
        return {name: checkChoice(name, value) for name, value in reference.items()}
    if isinstance(reference, str) and reference == 'finest':
        return reference
    numbersRead: numpy.ndarray | None
    if isinstance(reference, (str, os.PathLike)):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter('ignore')  # about a file without numbers, which is refused below
                numbersRead = numpy.loadtxt(path('reference', reference), encoding='utf-8-sig')
        except (OSError, ValueError) as error:
            raise ValueError('reference is %s, which is not a file of numbers: %s.' %
                             (shown(str(reference)), str(error).rstrip('.')[:120])) from None
    else:
        numbersRead = array(reference, float)
    if numbersRead is None or numbersRead.size == 0 or numbersRead.ndim > 1 or not numpy.isfinite(numbersRead).all():
        refuse('reference', reference, "finite numbers, a file of them, 'finest' or a dict of choices")
    return numbersRead


def _runAll(rows, settings, job, repeats, executor, finished):
    """Runs all rows. The settings alternate, so that a slow minute of the machine affects all of them."""
    with counted(repeats * len(rows), lambda: sum(len(row.walls) for row in rows)) as bar:
        for turn in range(repeats):
            due = [(row, dict(setting=setting, turn=turn)) for row, setting in zip(rows, settings)
                   if row.result in _REPEATABLE]
            bar.update(len(rows) - len(due))
            runAll(due, job, finished, bar, executor)


def _setErrors(table, right, settings):
    """Computes the errors of all rows with a value, relative to the reference of their problem."""
    of = {id(row): setting for row, setting in zip(table.rows, settings)}
    for case, rows in table.cases():
        good = [row for row in rows if row.result == 'ok']
        reference: Any = None
        if isinstance(right, str):
            reference = min(good, default=None, key=lambda row: (
                row.settings.get('size', 0), row.settings.get('timeStep', 0), -row.wall))
        elif isinstance(right, dict):
            wanted = keyOf({**case, **right})
            reference = next(row for row in table.rows if keyOf(of[id(row)]) == wanted)
        if isinstance(right, dict) and reference.result != 'ok':
            for other in good:
                other.message = 'the reference (%s) has no value.' % describe(right)
            continue
        if reference is not None and not table.isReference(reference):
            table.references.append(reference)
        value = right if reference is None else numpy.asarray(reference.value)
        for row in good:
            row.error, row.message = _error(numpy.asarray(row.value), value)


def _error(value, right):
    """(error or None, message)."""
    if value.shape != right.shape:
        return None, 'measured are %d numbers, the reference has %d.' % (value.size, right.size)
    scale = numpy.linalg.norm(right)
    off = numpy.linalg.norm(value - right)
    return (float(off / scale) if scale > 0 else float(off / math.sqrt(value.size))), ''
