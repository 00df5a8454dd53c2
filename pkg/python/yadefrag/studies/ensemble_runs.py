"""Many runs of one scene, by seeds or by a table, and statistics of a measured value."""

import os
from collections.abc import Callable
from typing import Any

from yadefrag.arguments import File, isWhole, listOf, plain, refuse, shown, text, whole
from yadefrag.messages import passOn
from yadefrag.studies.ensemble_table import EnsembleTable
from yadefrag.studies.runs import Finished, counted, jobOf, runAll
from yadefrag.studies.scene_choices import Choices
from yadefrag.studies.table import EnsembleRow
from yadefrag.studies.tradeoff_grid import checkChoice, requireFiles, writeTable

_MOST_RUNS = 10**6


def ensemble(scene: Callable[[Choices], Any], runs: Any, measure: Callable[..., Any], *, duration: float,
             watch: Callable[[Any], Any] | None = None, every: float = 0., limit: float = 600.,
             executor: Any = None, workers: int | None = None, resume: File | None = None,
             files: File | None = None, title: str = '') -> EnsembleTable:
    """Runs `scene` once for each row of a table; returns an EnsembleTable of the measured values.

    scene     function (choices) that builds the scene in O and sets O.engines and O.dt, as for
              tradeoff: choices['seed'] is the run's seed, choices['strength'] a value from the table
    runs      number of runs, with the seeds 0, 1, ...; a list of seeds; or a table, as a list of dicts
              {name: value} or a dict {name: list of values}, all of one length. Names that tradeoff
              knows are checked as there; others are passed on
    measure   function (built) → a number or numbers (n) of one kind, called after the run with the
              scene's return value; n may differ from run to run, e.g. for sizes of fragments; or a dict
              {name: number or numbers} of several quantities, which get a mean each. A tuple of numbers
              is several quantities, too, with the names 'value 0', 'value 1' ...
    duration, watch, every, limit  as in tradeoff
    executor  None: processes on this machine, `workers` at a time (None: as many as processors); or an
              executor as in concurrent.futures. With mpi4py: MPIPoolExecutor(main=False); with Dask:
              Client(...).get_executor(pure=False). Its workers only need Python; they start yade on
              their machines, and must access the same files. It is not shut down
    resume    None, or a file .jsonl of finished runs: an interrupted call continues where it stopped
              if it is repeated with the same arguments, or with more runs. Remove the file if the
              scene has changed
    files     path without ending: writes .csv and, if a run has a value, .png
    title     of the plot

    Runs, their results and warnings, Ctrl-C, and what functions and the call need, are as for tradeoff. The
    table has means of runs that differ in nothing but the seed; print(table) shows them. ValueError, OSError
    and RuntimeError as tradeoff.
    """
    job = dict(jobOf('ensemble', scene, measure, watch, duration, every, limit, executor), isSeveral=True)
    settings = _settings(runs)
    workers = whole('workers', os.cpu_count() if workers is None else workers)
    table = EnsembleTable([EnsembleRow(dict(setting)) for setting in settings], text('title', title))
    requireFiles(table, files)
    _run(table.rows, job, Finished(resume, job), executor, workers)
    passOn('ensemble', table.rows)
    writeTable(table, files)
    return table


def _settings(runs):
    """List of checked dicts."""
    runs, right = plain(runs), 'a number of runs, a list of seeds, a list of dicts or a dict of lists'
    if isWhole(runs):
        runs = range(whole('runs', runs, most=_MOST_RUNS))
    if isinstance(runs, dict):
        columns = [listOf('runs[%s]' % shown(name), values, 'a list of values') for name, values in runs.items()]
        if len(set(map(len, columns))) != 1:
            refuse('runs', runs, 'a dict of lists that have all the same length')
        runs = [dict(zip(runs, row)) for row in zip(*columns)]
    rows = listOf('runs', runs, right)
    if not 0 < len(rows) <= _MOST_RUNS:
        refuse('runs', runs, right)
    return [_setting(row) for row in rows]


def _setting(row):
    if not isinstance(row, dict):
        if not isWhole(row):
            raise ValueError('runs has the seed %s, it must be a whole number, or a dict.' % shown(row))
        row = dict(seed=row)
    return {name: checkChoice(name, value, 'runs', EnsembleRow) for name, value in row.items()}


def _run(rows, job, finished, executor, workers):
    """Runs all rows and stores their results."""
    # Rows may be equal: `turn` tells them apart.
    keys = [dict(setting=row.settings, turn=sum(row.settings == other.settings for other in rows[:place]))
            for place, row in enumerate(rows)]
    with counted(len(rows), lambda: sum(row.result != 'not run' for row in rows)) as bar:
        runAll(list(zip(rows, keys)), job, finished, bar, executor, workers)
