"""The report of yadefrag on itself: yadefrag.about() and python3 -m yadefrag."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

import yadefrag
from yade import config
from yadefrag import _yadefrag, support

PACKAGE = pathlib.Path(yadefrag.__file__).absolute().parent.parent


def report():
    lines = []
    return yadefrag.about(lines.append), lines


def byName(lines):
    return dict(re.match(r'(\S+) +(.*)', line).groups() for line in lines[:-1])


def test_allIsWellHere():
    well, lines = report()
    assert well and lines[-1] == 'All is well.'
    rows = byName(lines)
    assert yadefrag.__version__ in rows['yadefrag'] and config.version in rows['YADE']
    flags = pathlib.Path('/proc/cpuinfo').read_text()
    assert rows['instructions'] == ('AVX2' if re.search(r'\bavx2\b', flags) else 'SSE2')
    assert pathlib.Path(rows['examples'], 'README.md').exists()
    assert pathlib.Path(rows['manual']).exists()


def test_versionIsThatOfGitOrOfTheProject():
    assert re.fullmatch(r'\d+\.\d+\.\d+(\+(\d+\.)?g[0-9a-f]{7})?', yadefrag.__version__)


def test_whatIsWrongIsNamed(monkeypatch):
    monkeypatch.setattr(support, 'VERSION', '2031.1')
    well, lines = report()
    assert not well and 'Not all is well' in lines[-1]
    assert byName(lines)['interface'].endswith('not as it should be')


def asked(**more):
    environment = {**os.environ, 'PYTHONPATH': str(PACKAGE), **more}
    return subprocess.run([sys.executable, '-m', 'yadefrag'], capture_output=True, text=True,
                          env=environment, check=False)


def test_plainPythonStartsAYade():
    done = asked()
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[-1] == 'All is well.' and support.VERSION in byName(lines)['YADE']


@pytest.mark.skipif(support.FEATURES is not None, reason='the path of its YADE is known')
def test_yadeThatDoesNotWorkIsReported(tmp_path):
    """In place of yade: a program that fails before any report."""
    program = tmp_path / 'yade'
    program.write_text('#!/bin/sh\necho "ImportError: a library is missing" >&2\nexit 1\n')
    program.chmod(0o755)
    done = asked(PATH='%s:%s' % (tmp_path, os.environ['PATH']))
    assert done.returncode == 1 and done.stdout == ''
    assert done.stderr.strip().endswith('a library is missing')
