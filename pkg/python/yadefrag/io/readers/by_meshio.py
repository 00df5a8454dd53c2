"""Meshes of all other formats that the library meshio reads."""

import contextlib
import ctypes
import io
import os
import re
import threading

import numpy

from yadefrag.io.readers import Elements, needed

_PACKAGE = 'python3-meshio'
_LONGEST = 30, 3e-5  # s, and s for each byte: some of meshio's readers never end for an incomplete file


def read(name: str) -> Elements:
    """Elements; ImportError without the library, ValueError for a file that it cannot read."""
    meshio = needed('meshio', _PACKAGE, name)
    told = io.StringIO()
    try:
        # meshio prints why it cannot read a file, and ends the process.
        with contextlib.redirect_stdout(told), contextlib.redirect_stderr(told):
            mesh = _inTime(lambda: meshio.read(name), _LONGEST[0] + _LONGEST[1] * os.path.getsize(name))
    except KeyError as error:
        raise ValueError(_cause(told) or 'it has %s, which meshio does not know' % error) from None
    except SystemExit:
        raise ValueError(_cause(told) or 'its contents do not match its ending') from None
    except Exception as error:
        raise ValueError(_cause(told) or str(error) or type(error).__name__) from None
    blocks, count = [], 0
    for cells in mesh.cells:
        kind = cells.type + str(len(cells.data[0])) if cells.type == 'polygon' else cells.type
        blocks.append((kind, cells.data, numpy.arange(count, count + len(cells.data))))
        count += len(cells.data)
    starts = numpy.cumsum([0] + [len(cells.data) for cells in mesh.cells])
    groups = {}
    for group, parts in mesh.cell_sets.items():
        groups[group] = numpy.concatenate([start + numpy.asarray(part, dtype=int) for start, part in
                                           zip(starts, parts) if part is not None] or [[]]).astype(int)
    sets = {key: numpy.asarray(nodes, dtype=int).ravel() for key, nodes in mesh.point_sets.items()}
    return Elements(mesh.points, blocks, list(range(count)), groups, nodeSets=sets, leftOut=_told(told))


def _inTime(function, seconds):
    """What `function()` returns or raises; TimeoutError if it takes longer, and then it is ended."""
    result: list = []

    def work():
        try:
            result.append((function(), None))
        except BaseException as error:
            result.append((None, error))

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    try:
        thread.join(seconds)
    finally:
        if thread.is_alive():
            ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident or 0), ctypes.py_object(SystemExit))
    if not result:
        raise TimeoutError('reading did not end within %.0f s, the file may be incomplete' % seconds)
    found, error = result[0]
    if error is not None:
        raise error
    return found


def _told(text):
    """What meshio printed, without colours and marks; one line for each message."""
    plain = re.sub(r'\x1b\[[\d;]*m', '', text.getvalue())
    found = []
    for part in re.split(r'^(?:Warning|Info|Error):', plain, flags=re.MULTILINE):
        if part.strip():
            found.append(' '.join(part.split()).rstrip('.'))
    return found


def _cause(text):
    told = [one for one in _told(text) if not one.startswith("Couldn't read file")]
    return told[0].split(" Couldn't read file")[0] if told else ''
