"""Runs pytest inside the running yade: `scripts/yade -n -x tests/pkg/inside.py [pytest args]`.

Exits with pytest's code. Arguments that name tests are relative to tests/pkg.
"""
import os
import signal
import sys

import pytest


def main():
    here = os.path.dirname(os.path.abspath(sys.argv[0]))
    arguments = sys.argv[1:]
    os.chdir(here)
    # A shell starts background jobs with interrupts ignored: tests of Ctrl-C would wait for ever.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    if not any(os.path.exists(a.split('::')[0]) for a in arguments if not a.startswith('-')):
        arguments.append(here)
    code = int(pytest.main(['-q', '-p', 'no:cacheprovider', '--rootdir', here, *arguments]))
    sys.stdout.flush()
    sys.stderr.flush()
    return code


sys.exit(main())
