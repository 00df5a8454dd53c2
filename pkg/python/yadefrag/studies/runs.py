"""Many runs of a scene, each in a separate yade, on this machine or by an executor."""

from __future__ import annotations

import concurrent.futures
import contextlib
import inspect
import json
import math
import os
import sys
from collections.abc import Callable, Iterator
from typing import Any

from yadefrag.arguments import File, number, path, positive, refuse, shown, shownPath
from yadefrag.files import appendText, requireWritable, writeText
from yadefrag.studies import run_process
from yadefrag.studies.table import describe

INSIDE = 'YADEFRAG_TRADEOFF'  # set in the environment of a run
_HERE = os.path.dirname(os.path.realpath(run_process.__file__))
_MOST_SECONDS = 1e9  # longest time limit of a process
# Workers are plain Python, which cannot import this package without YADE.
_BY_PATH = "__import__('runpy').run_path(program)['perform'](job)"


def jobOf(name: str, scene: Callable, measure: Callable, watch: Callable | None, duration: float, every: float,
          limit: float, executor: Any) -> dict[str, Any]:
    """The job of every run: functions and their file, times. ValueError for functions without a file, and for an
    executor without a method submit; RuntimeError in a run that loads the script, which calls the function `name`,
    again."""
    if os.environ.get(INSIDE):
        raise RuntimeError('%s is called while one of its runs loads the script; put the call '
                           "after `if __name__ == '__main__':`." % name)
    if executor is not None and not callable(getattr(executor, 'submit', None)):
        refuse('executor', executor, 'None, or an executor with a method submit')
    functions: list[Any] = [scene, measure] + [watch] * (watch is not None)
    for argument, function in zip(('scene', 'measure', 'watch'), functions):
        module = sys.modules.get(getattr(function, '__module__', ''))
        found: Any = vars(module or os).get(getattr(function, '__name__', ''))
        if not callable(function) or not hasattr(function, '__code__') \
                or inspect.unwrap(found) is not inspect.unwrap(function):
            refuse(argument, function, 'a function at the top level of a file, which each run loads')
    modules = {function.__module__ for function in functions}
    if len(modules) > 1:
        raise ValueError('scene, measure and watch are in the modules %s, they must be in one '
                         'file.' % ', '.join(sorted(modules)))
    file = os.path.abspath(scene.__code__.co_filename)
    if not os.path.isfile(file):
        raise ValueError('scene is of %s, which is not a file that a run can load.' %
                         shown(scene.__code__.co_filename))
    names = [function.__name__ for function in functions]
    package = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    return dict(file=file, module=modules.pop(), functions=names + [None] * (3 - len(names)),
                path=[os.path.abspath(p) for p in sys.path], inside=INSIDE, package=package,
                yade=getattr(sys, 'yade_argv', ['/usr/bin/yade'])[0],
                program=os.path.join(_HERE, 'run_in_yade.py'), duration=positive('duration', duration, 's'),
                every=number('every', every, lambda v: 0 <= v < math.inf, 'a positive number (s), or 0'),
                limit=min(positive('limit', limit, 's'), _MOST_SECONDS))


@contextlib.contextmanager
def counted(total: int, done: Callable[[], int]) -> Iterator[Any]:
    """The block has a progress bar for `total` runs. Ctrl-C ends it, with a line about the number of runs that are
    `done`."""
    import tqdm  # only if something runs
    try:
        with tqdm.tqdm(total=total, unit='run', disable=None) as bar:
            yield bar
    except KeyboardInterrupt:
        print('Stopped after %d of %d runs.' % (done(), total), file=sys.stderr)


def runAll(rows: list[tuple[Any, dict[str, Any]]], job: dict[str, Any], finished: Finished, bar: Any,
           executor: Any = None, workers: int = 1) -> None:
    """Gives the row of each pair (row, key in `finished`, with its `setting`) the result of its run; does the runs that
    are not finished.

    executor  None: on this machine, `workers` at a time; or one with `submit`, whose futures are those of
              concurrent.futures. A lost worker's run has failed, with the reason.
              KeyboardInterrupt cancels the runs that have not begun, and ends those on this machine
    """
    due = []
    for row, key in rows:
        known = finished.get(key)
        if known is None:
            due.append((row, key))
        else:
            row.take(known)
            bar.update()

    def take(place, found):
        row, key = due[place]
        if found['result'] == 'unloadable':
            raise RuntimeError('a run cannot load the scene: %s' % found['message'])
        row.take(found)
        finished.add(key, found)
        bar.update()

    bar.set_postfix_str(describe(due[0][1]['setting']) if len(due) == 1 else '', refresh=False)
    jobs = [dict(job, settings=key['setting']) for _, key in due]
    if executor is not None:
        program = os.path.join(_HERE, 'run_process.py')
        _take([executor.submit(eval, _BY_PATH, dict(program=program, job=job)) for job in jobs], take)
        return
    with concurrent.futures.ThreadPoolExecutor(workers) as own:
        try:
            _take([own.submit(run_process.perform, job) for job in jobs], take)
        except BaseException:
            own.shutdown(wait=False, cancel_futures=True)
            run_process.endAll()
            raise


def _take(futures, take):
    """Results as they come."""
    places = {future: place for place, future in enumerate(futures)}
    try:
        for future in concurrent.futures.as_completed(places):
            try:
                found = future.result()
            except Exception as error:  # of the executor, or of a lost worker
                found = dict(result='failed', isLost=True, message='%s: %s' % (
                    type(error).__name__, ' '.join(str(error).split())[:200]))
            take(places[future], found)
    finally:
        for future in futures:
            future.cancel()


class Finished:
    """Results of runs in a file, one line of JSON each: a later call need not repeat these runs."""

    def __init__(self, file: File | None, job: dict[str, Any]) -> None:
        """file: a path that ends with .jsonl, or None; job: that of the runs, which identifies them."""
        self.name = '' if file is None else path('resume', file, '.jsonl')  # '': none
        self._known, of = {}, {key: job[key] for key in ('file', 'functions', 'duration', 'every')}
        if not self.name:
            return
        requireWritable(self.name)
        lines = self._lines()
        if lines and lines[0] != of:
            raise ValueError('%s has runs of another scene, file, duration or measure; use another '
                             'file, or remove it.' % shownPath(self.name))
        for line in lines[1:]:
            self._known[keyOf(line['of'])] = line['result']
        # An incomplete line, written during an interrupt, is left out.
        writeText(self.name, ''.join(json.dumps(line) + '\n' for line in lines or [of]))

    def _lines(self):
        if not os.path.exists(self.name):
            return []
        with open(self.name, encoding='utf-8', errors='replace') as file:
            texts = file.read().splitlines()
        lines = []
        for text in texts:
            with contextlib.suppress(ValueError):
                line = json.loads(text)
                if isinstance(line, dict) and (not lines or {'of', 'result'} <= set(line)):
                    lines.append(line)
        if texts and not lines:
            raise ValueError('%s has no runs that can be continued.' % shownPath(self.name))
        return lines

    def get(self, of: dict[str, Any]) -> dict[str, Any] | None:
        """The result of a run; None if it has not been done."""
        return self._known.get(keyOf(of))

    def add(self, of: dict[str, Any], result: dict[str, Any]) -> None:
        if self.name and not result.get('isLost'):
            appendText(self.name, json.dumps(dict(of=of, result=result)) + '\n')


def keyOf(of: dict[str, Any]) -> str:
    """Of a dict, with the types of its values: True is not 1."""
    return json.dumps(of, sort_keys=True)
