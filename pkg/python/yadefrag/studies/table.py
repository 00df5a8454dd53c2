"""What the tables of tradeoff() and ensemble() have in common: rows, CSV, files, rows by what varies between them."""

from __future__ import annotations

import csv
import dataclasses
import io
import json
from collections.abc import Iterable, Sequence
from typing import Any, TypeVar

from yadefrag.arguments import File, listOf, path, real, refuse, text
from yadefrag.files import writeText

Row = TypeVar('Row', bound=Any)
SEED = 'seed'  # runs that differ in it only are repetitions


@dataclasses.dataclass
class EnsembleRow:
    """One run and its result.

    settings  dict of the scene's choices
    result    'ok'; 'refused', 'blew up', 'too long', 'failed' with the reason in `message`; or 'not
              run'
    value     the measured value, a number or a list, or a dict of these by quantity; None without
    steps     number of steps
    wall      wall-clock time of the steps over simulated time (s/s), large for short scenes
    seconds   wall-clock time of the steps (s)
    warnings  messages of the run: those of fe.warnings, and Python's of the script
    """

    settings: dict
    result: str = 'not run'
    value: Any = None
    steps: int | None = None
    wall: float | None = None
    message: str = ''
    seconds: float | None = None
    warnings: list = dataclasses.field(default_factory=list)

    def take(self, found: dict[str, Any]) -> None:
        """Stores the result of a run."""
        for name in columnsOf(EnsembleRow):
            setattr(self, name, found.get(name, [] if name == 'warnings' else None))


class Table:
    """rows (list of _ROW) and title, of tradeoff() or ensemble()."""

    _ROW: type[Any]
    _ENDINGS: tuple[str, ...]  # of the files that `write` writes

    def __init__(self, rows: Iterable[Any], title: str = '') -> None:
        self.rows = listOf('rows', rows, 'a list of %s' % self._ROW.__name__)
        for i, row in enumerate(self.rows):
            self._requireRow(row, 'rows[%d]' % i)
        self.title = text('title', title)

    def _requireRow(self, row, name='row'):
        if not isinstance(row, self._ROW):
            refuse(name, row, 'of the class %s' % self._ROW.__name__)

    def csv(self, file: File) -> None:
        """Writes all rows: the settings, then what is known of each run; values as JSON, an empty cell for None."""
        names, columns = namesOf(self.rows), columnsOf(self._ROW)
        out = io.StringIO(newline='')
        writer = csv.writer(out)
        writer.writerow([*names, *columns])
        for row in self.rows:
            cells = [*map(row.settings.get, names), *(getattr(row, column) for column in columns)]
            writer.writerow(map(encode, cells))
        writeText(path('file', file), out.getvalue())

    @classmethod
    def namesOfFiles(cls, files: File) -> list[str]:
        """Names of the files that `write` writes."""
        return [path('files', files) + ending for ending in cls._ENDINGS]


def columnsOf(kind: type[Any]) -> tuple[str, ...]:
    """Names of what a row of this class has beside its settings."""
    return tuple(one.name for one in dataclasses.fields(kind)[1:])


def namesOf(rows: Iterable[Any]) -> list[str]:
    """Names of all choices, in the order in which they first occur."""
    return list(dict.fromkeys(name for row in rows for name in row.settings))


def describe(settings: dict[str, Any]) -> str:
    """'passes=2, size=0.001'; 'as the scene is' for no choices."""
    return ', '.join('%s=%s' % (n, '%.6g' % v if isinstance(v, float) else v)
                     for n, v in settings.items()) or 'as the scene is'


def encode(value: Any) -> str:
    """A cell: JSON, except for texts that cannot be mistaken for JSON."""
    if value is None:
        return ''
    if isinstance(value, str) and value and decode(value) is value:
        return value
    return json.dumps(value)


def decode(cell: str) -> Any:
    """The value of a cell by `encode`; other texts are themselves."""
    if cell == '':
        return None
    try:
        return json.loads(cell)
    except (ValueError, RecursionError):
        return cell


def varying(rows: Sequence[Any]) -> list[str]:
    """Names of the settings that vary and are neither a seed nor a sample, in their order.

    A sample is a number that is another one in each of several runs, as drawn from a distribution.
    """
    return [name for name in namesOf(rows) if name != SEED and not _isSample(rows, name)
            and len({repr(row.settings.get(name)) for row in rows}) > 1]


def samples(rows: Sequence[Any]) -> list[str]:
    """Names of the settings that are another number in each run, without the seed."""
    return [name for name in namesOf(rows) if name != SEED and _isSample(rows, name)]


def grouped(rows: Sequence[Row], names: Iterable[str]) -> list[tuple[dict[str, Any], list[Row]]]:
    """[(dict of the settings `names`, rows)] in the order of their first rows."""
    groups = {}
    for row in rows:
        of = {name: row.settings[name] for name in names if name in row.settings}
        groups.setdefault(repr(of), (of, []))[1].append(row)
    return list(groups.values())


def _isSample(rows, name):
    values = [row.settings.get(name) for row in rows]
    return None not in map(real, values) and 1 < len(rows) == len(set(values))
