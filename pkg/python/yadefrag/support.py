"""Is the YADE around us the one that yadefrag was built for?

Asked in Python, before the extension is loaded: another YADE may lack what it links to.
"""

import sys

VERSION = '2023.02a'
PRECISION = 'PrecisionDouble'
# Features that move members of YADE's classes: these make members that the extension knows ...
NEEDED = ('OPENMP', 'MPI', 'QT5', 'FEMLIKE')
# ... and these make, widen or align some that it does not.
REFUSED = ('VECTORIZE', 'MASK_ARBITRARY', 'SPH', 'LIQMIGRATION', 'DEFORM', 'BODY_CALLBACK')


def describeMismatch(version, precision, features):
    """'' for the supported YADE, else one sentence with what was found and what is needed.

    All three as in yade.config: `version`, `highPrecisionName`, `features` (strings, list of str).
    """
    found, needed = [], []
    if version != VERSION:
        found.append('version %s' % version)
        needed.append('version %s' % VERSION)
    if precision != PRECISION:
        found.append('numbers of %s' % precision)
        needed.append('numbers of %s' % PRECISION)
    for feature in NEEDED:
        if feature not in features:
            found.append('no %s' % feature)
            needed.append('%s' % feature)
    for feature in REFUSED:
        if feature in features:
            found.append('%s' % feature)
            needed.append('no %s' % feature)
    if not found:
        return ''
    return ('yadefrag needs YADE %s as Debian 12 packages it, with %s; the running yade has %s.' %
            (VERSION, ', '.join(needed), ', '.join(found)))


def describeSurroundings(modules=None):
    """As describeMismatch, for the YADE in `modules` (default: of this process)."""
    modules = sys.modules if modules is None else modules
    if 'yade.wrapper' not in modules or 'yade.config' not in modules:
        return ('yadefrag is a plugin of YADE and no YADE is loaded in this Python: '
                'use it in a script that is run by the command `yade`.')
    config = modules['yade.config']
    return describeMismatch(getattr(config, 'version', 'unknown'),
                            getattr(config, 'highPrecisionName', 'unknown precision'),
                            getattr(config, 'features', []))


def require():
    """Raises ImportError with one sentence unless the YADE around us is supported."""
    problem = describeSurroundings()
    if problem:
        raise ImportError(problem)
