"""FESolver under valgrind's memcheck, judged as in test_valgrind.py."""
import os
import subprocess
import sys

import pytest

from test_threads import yadeCommand
from test_valgrind import findings, kHere, kValgrind


def testNoWrongAccess(folder):
    report = os.path.join(folder, 'memcheck.xml')
    done = subprocess.run(
        [*kValgrind, f'--xml-file={report}', sys.executable, *yadeCommand(), '-j2',
         os.path.join(kHere, 'fe_valgrind_scene.py')],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600,
        env=dict(os.environ, PYTHONMALLOC='malloc', PYTHONHASHSEED='0', OMP_WAIT_POLICY='passive'))
    assert '@@@ done' in done.stdout, done.stdout[-1500:] + done.stderr[-1500:]
    found = findings(report)
    if found:
        pytest.fail('\n'.join(f'{kind}: {text}\n    in ' + '\n    by '.join(functions)
                              for kind, text, functions in found))
