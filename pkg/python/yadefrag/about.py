"""Report on the installation: versions, interface checks, folders."""

import os
import pathlib
import platform
from collections.abc import Callable
from typing import Any

from yade import config

from yadefrag import _built, _yadefrag, support
from yadefrag.arguments import refuse

_OWN = pathlib.Path(__file__).resolve().parent
# Folders of a source tree (by links in its build folder) and of installations: below /usr, /usr/local, or in the
# folder of a YADE that its user built.
_PLACES = tuple((_OWN / place).resolve() for place in
                ('../../..', '../../../../share/doc/yadefrag', '../../../../../share/doc/yadefrag'))


def about(show: Callable[[str], Any] = print) -> bool:
    """Prints what is installed and whether it works; returns True if all checks succeed.

    Versions of yadefrag, YADE and Python; whether YADE's classes have the layout for which the
    extension was built; instruction set and threads of the finite elements; folders
    of examples and manual. `python3 -m yadefrag`, outside YADE, prints the same; its exit code is 0 if all checks
    succeed, else 1.

    show  called with each line (default: print)
    """
    if not callable(show):
        refuse('show', show, 'a function that takes a line')
    well = True
    for name, text, good in _rows():
        show('%-12s %s%s' % (name, text, '' if good else '   <- not as it should be'))
        well = well and good
    show('All is well.' if well else 'Not all is well: see above.')
    return well


def _rows():
    """(name, text, True if it is correct), line by line."""
    yield 'yadefrag', '%s in %s' % (support.YADEFRAG, _OWN), True
    yield 'YADE', '%s in %s; built for %s as %s' % (config.version, config.libDir, _built.VERSION, _built.BUILD), (
        config.version == _built.VERSION)
    yield 'built with', ("the declarations of pkg/abi, for a YADE package without headers" if _built.FEATURES is None
                         else "YADE's own headers, for its features " + ', '.join(_built.FEATURES)), True
    yield 'Python', platform.python_version(), True
    problem = support.describeSurroundings()
    yield 'interface', problem or "YADE's classes have the expected layout", not problem
    yield 'instructions', _yadefrag.instructionSet(), True
    yield 'threads', _threads(), True
    examples, manual = _place('examples'), _place('docs') or _place('README.md')
    yield 'examples', str(examples or 'not found'), examples is not None
    yield 'manual', str(manual or 'not found'), manual is not None


def _threads():
    limit = os.environ.get('OMP_NUM_THREADS')
    return '%s of %d (yade -j N)' % (limit or 1, len(os.sched_getaffinity(0)))


def _place(name):
    """Path of the first of the folders that contains `name`; None if none does."""
    return next((place / name for place in _PLACES if (place / name).exists()), None)
