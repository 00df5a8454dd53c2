"""Runs of a table by what varies between them, and what they warn of."""

import re
from collections.abc import Iterable, Sequence
from typing import Any, TypeVar

from yadefrag.messages import warn

Row = TypeVar('Row', bound=Any)
SEED = 'seed'  # runs that differ in it only are repetitions
_NUMBER = re.compile(r'[-+]?[\d.]+(e[-+]?\d+)?')
_SHOWN = 200  # characters of a message


def varying(rows: Sequence[Any]) -> list[str]:
    """Names of the settings that vary and are neither a seed nor a sample, in their order.

    A sample is a number that is another one in each of several runs, as drawn from a distribution.
    """
    names = dict.fromkeys(name for row in rows for name in row.settings)
    return [name for name in names if name != SEED and len(_values(rows, name)) > 1 and not _isSample(rows, name)]


def samples(rows: Sequence[Any]) -> list[str]:
    """Names of the settings that are another number in each run, without the seed."""
    return [name for name in dict.fromkeys(n for row in rows for n in row.settings)
            if name != SEED and _isSample(rows, name)]


def grouped(rows: Sequence[Row], names: Iterable[str]) -> list[tuple[dict[str, Any], list[Row]]]:
    """[(dict of the settings `names`, rows)] in the order of their first rows."""
    groups = {}
    for row in rows:
        of = {name: row.settings[name] for name in names if name in row.settings}
        groups.setdefault(repr(of), (of, []))[1].append(row)
    return list(groups.values())


def passOn(what: str, rows: Sequence[Any]) -> None:
    """Warns once of each kind of message that runs gave, with the number of these runs."""
    kinds = {}
    for row in rows:
        for sentence in {_NUMBER.sub('', s): s for s in row.warnings}.items():
            kinds.setdefault(sentence[0], []).append(sentence[1])
    for sentences in kinds.values():
        first = sentences[0] if len(sentences[0]) <= _SHOWN else sentences[0][:_SHOWN] + '…'
        others = ', some with other numbers' if len(set(sentences)) > 1 else ''
        warn('%s: %d of %d runs gave this message%s: "%s" The others are in `warnings` of the rows.' %
             (what, len(sentences), len(rows), others, first) if len(sentences) > 1 else
             '%s: one of %d runs gave the message: "%s"' % (what, len(rows), first))


def _values(rows, name):
    return {repr(row.settings.get(name)) for row in rows}


def _isSample(rows, name):
    values = [row.settings.get(name) for row in rows]
    areNumbers = all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in values)
    return areNumbers and 1 < len(rows) == len(set(values))
