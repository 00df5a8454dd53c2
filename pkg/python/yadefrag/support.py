"""Checks that the running YADE is the one for which this build of yadefrag was made; a report on the installation.

The check is in Python, before the extension is loaded: another YADE may lack symbols that it needs.
"""

import os
import pathlib
import platform
import sys
from collections.abc import Callable, Collection, Mapping
from typing import Any

# VERSION: the extension is built for the layout of one YADE, that which was installed at the build. With YADE's own
# headers the layout is that of exactly the FEATURES. ACCEPTED: every version of a package for which a build can be
# made, with its system.
from yadefrag._built import ACCEPTED, BUILD, BUILD_ID, FEATURES, VERSION, YADEFRAG
from yadefrag.build_id import buildId

_OWN = pathlib.Path(__file__).resolve().parent
# Folders of a source tree (by links in its build folder) and of installations: below /usr, /usr/local, or in the
# folder of a YADE that its user built.
_PLACES = tuple((_OWN / place).resolve() for place in
                ('../../..', '../../../../share/doc/yadefrag', '../../../../../share/doc/yadefrag'))
PRECISION = 'PrecisionDouble'
# With the declarations of pkg/yade: features that add members of YADE's classes that the extension expects ...
NEEDED = ('OPENMP', 'MPI', 'QT5', 'FEMLIKE')
# ... and these add, widen or align members that it does not expect.
REFUSED = ('VECTORIZE', 'MASK_ARBITRARY', 'SPH', 'LIQMIGRATION', 'DEFORM', 'BODY_CALLBACK')


def describeMismatch(version: str, precision: str, features: Collection[str]) -> str:
    """'' for the supported YADE, else one sentence with the found and the needed configuration.

    All three as in yade.config: `version`, `highPrecisionName`, `features` (strings, list of str).
    """
    wrong = [('%s%s' % (what, found), '%s%s' % (what, needed)) for what, found, needed in (
        ('version ', version, VERSION), ('numbers of ', precision, PRECISION)) if found != needed]
    expected: Collection[str] = NEEDED
    unexpected: Collection[str] = REFUSED
    if FEATURES is not None:
        expected, unexpected = FEATURES, sorted(set(features) - set(FEATURES))
    wrong += [('no ' + one, one) for one in expected if one not in features]
    wrong += [(one, 'no ' + one) for one in unexpected if one in features]
    if wrong:
        found, needed = map(', '.join, zip(*wrong))
        return ('this build of yadefrag needs YADE %s as %s, with %s; the running yade '
                'has %s%s.' % (VERSION, BUILD, needed, found, describeRemedy(version)))
    if version in ACCEPTED or FEATURES is not None:
        return ''
    return ('yadefrag is prepared for YADE %s, but was never tested with it and therefore refuses it; '
            'it accepts %s.' % (version, ' and '.join(sorted(ACCEPTED))))


def describeRemedy(version: str) -> str:
    """The remedy for a version: for the end of a sentence."""
    if FEATURES is not None:
        return ', for which yadefrag must be built again'
    if version == VERSION:
        return '; one that is built from its sources needs a plugin that is built with them'
    if version in ACCEPTED:
        return ', for which yadefrag must be built or installed again'
    return '; builds can be for %s' % ' and '.join('YADE %s (%s)' % item for item in sorted(ACCEPTED.items()))


def describeSurroundings(modules: Mapping[str, Any] | None = None) -> str:
    """As describeMismatch, for the YADE in `modules` (default: of this process)."""
    modules = sys.modules if modules is None else modules
    if 'yade.wrapper' not in modules or 'yade.config' not in modules:
        return ('yadefrag is a plugin of YADE and no YADE is loaded in this Python: '
                'use it in a script that is run by the command `yade`.')
    config = modules['yade.config']
    return describeMismatch(getattr(config, 'version', 'unknown'),
                            getattr(config, 'highPrecisionName', 'unknown precision'),
                            getattr(config, 'features', [])) or describeOtherBuild(config.libDir)


def describeOtherBuild(libraries: str) -> str:
    """'' unless the library in the folder `libraries` is another build of the same version."""
    found = buildId(libraries)
    if found == BUILD_ID:
        return ''
    return ('this build of yadefrag needs the YADE %s with the build id %s, and the running yade in %s has %s: '
            'yadefrag must be built or installed again.' % (VERSION, BUILD_ID or '(none)', libraries, found or 'none'))


def isReportAsked() -> bool:
    """True for `python3 -m yadefrag`."""
    begin = getattr(sys, 'orig_argv', [])
    return 'yade' not in sys.modules and '-m' in begin[:-1] and (begin[begin.index('-m') + 1] == 'yadefrag')


def require() -> None:
    """Raises ImportError with one sentence unless the running YADE is supported."""
    problem = describeSurroundings()
    if problem:
        raise ImportError(problem)


# --- the report

def about(show: Callable[[str], Any] = print) -> bool:
    """Prints what is installed and whether it works; returns True if all checks succeed.

    Versions of yadefrag, YADE and Python; whether YADE's classes have the layout for which the
    extension was built; instruction set and threads of the finite elements; folders
    of examples and manual. `python3 -m yadefrag`, outside YADE, prints the same; its exit code is 0 if all checks
    succeed, else 1.

    show  called with each line (default: print)
    """
    from yadefrag.arguments import refuse
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
    from yade import config

    from yadefrag import _yadefrag
    yield 'yadefrag', '%s in %s' % (YADEFRAG, _OWN), True
    yield 'YADE', '%s in %s; built for %s as %s' % (config.version, config.libDir, VERSION, BUILD), (
        config.version == VERSION)
    yield 'built with', ("the declarations of pkg/yade, for a YADE package without headers" if FEATURES is None
                         else "YADE's own headers, for its features " + ', '.join(FEATURES)), True
    yield 'Python', platform.python_version(), True
    problem = describeSurroundings()
    yield 'interface', problem or "YADE's classes have the expected layout", not problem
    yield 'instructions', _yadefrag.instructionSet(), True
    threads = os.environ.get('OMP_NUM_THREADS') or 1
    yield 'threads', '%s of %d (yade -j N)' % (threads, len(os.sched_getaffinity(0))), True
    examples, manual = _place('examples'), _place('docs') or _place('README.md')
    yield 'examples', str(examples or 'not found'), examples is not None
    yield 'manual', str(manual or 'not found'), manual is not None


def _place(name):
    """Path of the first of the folders that contains `name`; None if none does."""
    return next((place / name for place in _PLACES if (place / name).exists()), None)
