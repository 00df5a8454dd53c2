"""Files of this package: each is written as a new file next to the old one, so that a failure does
not change the old file."""

import contextlib
import os
import secrets
import shutil
import stat
from collections.abc import Iterable, Iterator
from typing import Any

import numpy

from yadefrag.arguments import path

_BLOCK = 4096  # bytes, of a disk


@contextlib.contextmanager
def replacing(name: str) -> Iterator[str]:
    """For `with`: the name of a file to write, with the ending of `name`; it replaces the file `name`
    after everything was written.

    After an exception it is removed, and the old file is unchanged. OSError names `name`. A device
    or a pipe is written directly, and a symbolic link is kept.
    """
    target = os.path.realpath(name)
    if os.path.exists(target) and not os.path.isfile(target):
        with _named(name):
            yield _special(target)
        return
    part = None
    try:
        with _named(name):
            part = _newBeside(target)
            yield part
            if os.path.exists(target):
                shutil.copymode(target, part)
            os.replace(part, target)
    finally:
        if part:
            with contextlib.suppress(OSError):
                os.remove(part)


@contextlib.contextmanager
def keptAside(name: str) -> Iterator[None]:
    """For `with`: the block writes the file `name` itself.

    After an exception the former file is there again. Meanwhile it is beside the new one, with `.part.` in its name:
    also after the end of a process that was killed. A device or a pipe is left as it is, and a symbolic link is kept.
    """
    target, former = os.path.realpath(name), None
    if os.path.exists(target):
        if not os.path.isfile(target):
            yield
            return
        former = _newBeside(target)
        os.replace(target, former)
    try:
        yield
        if former:
            shutil.copymode(former, target)
            with open(target, 'rb') as written:
                os.fsync(written.fileno())
            os.remove(former)
    except BaseException:
        with contextlib.suppress(OSError):
            os.replace(former, target) if former else os.remove(target)
        raise


def requireWritable(name: str) -> None:
    """OSError that names `name` if it cannot be written; no file is left over."""
    with _named(name):
        target = os.path.realpath(name)
        if os.path.exists(target) and not os.path.isfile(target):
            with open(_special(target), 'ab'):
                return
        if os.path.exists(target):
            with open(target, 'ab'):
                pass
        part = _newBeside(target)
        try:
            with open(part, 'wb') as file:
                file.write(bytes(_BLOCK))
        finally:
            os.remove(part)


def writeText(name: str, text: str) -> None:
    """Writes `text` as the whole contents of the file `name`, in UTF-8."""
    with replacing(name) as part, open(part, 'w', encoding='utf-8', newline='') as out:
        out.write(text)


def writeColumns(name: str, columns: Iterable[tuple[str, str, type]], table: numpy.ndarray) -> None:
    """Writes an array with named columns, each (name, unit, type), as CSV: names and units are its first line."""
    heading = ','.join('%s (%s)' % (column, unit) if unit else column for column, unit, _ in columns)
    lines = [','.join(repr(int(v)) if isinstance(v, bool) else repr(v) for v in row) for row in table.tolist()]
    writeText(name, '\n'.join([heading, *lines, '']))


def appendText(name: str, text: str) -> None:
    """Appends `text` to the file `name`: all of it, or nothing with an OSError."""
    with open(name, 'ab', buffering=0) as out:
        size = os.fstat(out.fileno()).st_size
        try:
            data = text.encode()
            while data:
                data = data[out.write(data):]
        except OSError as error:
            with contextlib.suppress(OSError):
                out.truncate(size)
            raise OSError(error.errno, error.strerror, name) from None


def savePicture(figure: Any, file: Any, dpi: float, argument: str = 'file', **settings: Any) -> None:
    """Saves Matplotlib's `figure` in `file`: an open file, or a path, whose ending determines the format, by default
    that of Matplotlib; not for None. ValueError, with the name of the argument, for an unknown ending."""
    if file is None:
        return
    if hasattr(file, 'write'):
        figure.savefig(file, dpi=dpi, **settings)
        return
    name = path(argument, file)
    ending = os.path.splitext(name)[1]
    known = sorted(figure.canvas.get_supported_filetypes())
    if ending and ending[1:].lower() not in known:
        raise ValueError('%s ends with %r, a picture must end with one of .%s.' %
                         (argument, ending[:20], ', .'.join(known)))
    with replacing(name if ending else name + '.' + figure.canvas.get_default_filetype()) as part:
        figure.savefig(part, dpi=dpi, **settings)


def _newBeside(target):
    """The name of a new, empty file in the same folder. Nobody can guess it, and no file or link of that
    name existed; its mode is that of any new file of the process."""
    folder, base = os.path.split(target)
    while True:
        part = os.path.join(folder, '.%s.part.%s' % (secrets.token_hex(8), base[-40:]))
        with contextlib.suppress(FileExistsError):
            os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
            return part


def _special(target):
    """The name of a device or a pipe; IsADirectoryError for a folder."""
    if stat.S_ISDIR(os.stat(target).st_mode):
        raise IsADirectoryError(21, os.strerror(21), target)
    return target


@contextlib.contextmanager
def _named(name):
    """OSErrors name the requested file, not the temporary one next to it."""
    try:
        yield
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, os.strerror(error.errno), name) from None
