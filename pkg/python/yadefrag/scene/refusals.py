"""A step that FESolver refuses: where a script waits for the run it gets the exception, and YADE's lines about
the same error are not written. Errors of other engines are written as ever."""

import contextlib
from collections.abc import Iterator

_LOGGERS = ('ThreadRunner', 'yadeWrapper.cpp')
_waiting = 0  # runs that a script waits for, one within the other
_former = {}  # {logger: its level}


@contextlib.contextmanager
def raisedHere() -> Iterator[None]:
    """The block waits for a run, and raises the error if FESolver refuses a step."""
    global _waiting
    _waiting += 1
    try:
        yield
    finally:
        _waiting -= 1
        if not _waiting:
            _restore()


def silence() -> None:
    """FESolver calls this in a step that it refuses."""
    if not _waiting:
        return
    from yade import log
    levels = log.getAllLevels()
    for name in _LOGGERS:
        _former.setdefault(name, levels.get(name, -1))
        log.setLevel(name, 0)


def _restore():
    if not _former:
        return
    from yade import log
    while _former:
        name, level = _former.popitem()
        if level < 0:
            log.unsetLevel(name)  # that of the default
        else:
            log.setLevel(name, level)
