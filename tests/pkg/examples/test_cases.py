"""tests/pkg/examples/cases: scenes and files as users bring them, which once failed; each in a yade of its own.

A case says at its top what is expected, computes it apart from the engine, and exits with 0 if it holds.
"""
import os
import subprocess

import pytest

from project import yadeCommand

kFolder = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'cases')
kHanging = 900  # s
kLong = 'concrete_softening.py', 'crushed_rock_ledger.py'


@pytest.mark.parametrize('name', [pytest.param(f, marks=[pytest.mark.long] * (f in kLong))
                                  for f in sorted(os.listdir(kFolder)) if f.endswith('.py')])
def test_caseHolds(name, folder):
    done = subprocess.run([*yadeCommand(), '-j1', os.path.join(kFolder, name)], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=kHanging)
    # YADE's own exit code of a script that ends with an exception is 1 as well.
    assert done.returncode == 0, done.stdout[-3000:]
