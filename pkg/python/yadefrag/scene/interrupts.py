"""Ctrl-C: one ends the run that a script waits for, after a whole step, in whichever thread it waits.

Python raises KeyboardInterrupt between any two instructions of the main thread, where code that has to
finish may lose it, and in no other thread. Here a run keeps it until its step is complete, and then raises
it in each thread that waits for a run."""

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from typing import Any

from yade import wrapper
from yadefrag import _yadefrag

_pause = wrapper.Omega.pause  # YADE's own, which does not count as a pause by the script
_identify = threading.get_ident
_LOOK = .05  # s, from one check for signals to the next
_count = 0  # interrupts so far
_seen = threading.local()  # count: those of which the thread knows
_held = {}  # by thread: number of nested held()
_waiting = {}  # by thread: number of nested waiting()


def install() -> None:
    """Replaces Python's own handler; a handler of the script is kept."""
    if threading.current_thread() is threading.main_thread() and \
            signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _note)


def _note(number, frame):
    """Python calls it in the main thread."""
    global _count
    _count += 1
    me = threading.get_ident()
    if me not in _held:
        _seen.count = _count
        _endRun()
        signal.default_int_handler(number, frame)
    elif me in _waiting:
        _endRun()


def _endRun():
    if _waiting:
        _pause(wrapper.Omega())


def _enter():
    """The first run in this thread. Linux may deliver a signal to a thread that creates another one, as runs
    do; the main thread, where Python handles signals, would go on waiting."""
    install()
    _seen.count = _count
    if threading.current_thread() is not threading.main_thread():
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])


def _check():
    if _seen.count != _count:
        _seen.count = _count
        raise KeyboardInterrupt


def _add(depths, me):
    depths[me] = depths.get(me, 0) + 1


def _remove(depths, me):
    depths[me] -= 1
    if not depths[me]:
        del depths[me]


class held:
    """A context: Ctrl-C raises KeyboardInterrupt at its beginning and at its end, nowhere within it."""

    def __enter__(self) -> None:
        if not hasattr(_seen, 'count'):
            _enter()
        _check()
        _add(_held, threading.get_ident())

    def __exit__(self, error: type[BaseException] | None, *details: object) -> None:
        _remove(_held, threading.get_ident())
        if error is None:
            _check()


def during(call: Callable[[Any], object], argument: Any) -> None:
    """`with held(): call(argument)`, in a third of the time: for O.step(), whose steps may be short."""
    if getattr(_seen, 'count', None) != _count:
        with held():
            pass
    me = _identify()
    depth = _held.get(me, 0)
    _held[me] = depth + 1
    try:
        call(argument)
    finally:
        if depth:
            _held[me] = depth
        else:
            del _held[me]
    if _seen.count != _count:
        _check()


@contextlib.contextmanager
def waiting() -> Iterator[None]:
    """held() that also ends the run; for the time between its first step and its end."""
    me = threading.get_ident()
    install()
    try:
        with held():
            _add(_waiting, me)
            try:
                _check()
                yield
                _check()
            finally:
                _remove(_waiting, me)
    except BaseException:  # also that of a script's own handler
        _yadefrag.stopRun()
        raise


def aside(call: Callable[[], object]) -> None:
    """call(), which waits for a run, in another thread: this one waits where Python can handle signals, which
    it cannot while YADE waits."""
    if threading.current_thread() is not threading.main_thread():
        call()
        return
    errors, ended = [], threading.Event()

    def run():
        try:
            call()
        except BaseException as error:
            errors.append(error)
        finally:
            ended.set()

    thread = threading.Thread(target=run, daemon=True)
    try:
        thread.start()
        # Rejected: Thread.join, which takes the thread as ended if a signal's handler raises an exception.
        while not ended.wait(_LOOK):
            pass
    except BaseException:  # of a script's own handler
        if thread.ident is not None:
            _pause(wrapper.Omega())
            ended.wait()  # else it would wait for the next run, and take its error
        raise
    if errors:
        raise errors[0]
