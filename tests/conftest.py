"""Shared set-up of the tests that run inside yade: scripts/yade -n -x tests/pkg/inside.py.

A test with the argument `collider` runs with LebesgueCollider, or with each class of YADEFRAG_COLLIDERS (comma
separated), so that another one can be put through the same tests.
"""
import os
import subprocess
import sys
import tempfile

import pytest

# What tests of several folders share.
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), 'pkg', 'helpers'))

import scenes  # noqa: E402

kColliders = os.environ.get('YADEFRAG_COLLIDERS', 'LebesgueCollider').split(',')


class ColliderMaker:
    """Makes colliders of one class: `maker(functors=None, **attributes)`."""

    def __init__(self, name):
        self.name = name

    def __call__(self, functors=None, **attributes):
        return scenes.makeCollider(self.name, functors, **attributes)

    def rival(self, functors=None, **attributes):
        return scenes.makeCollider('InsertionSortCollider', functors, **attributes)


def pytest_generate_tests(metafunc):
    if 'colliderName' in metafunc.fixturenames:
        metafunc.parametrize('colliderName', kColliders)


@pytest.fixture
def collider(colliderName):
    return ColliderMaker(colliderName)


@pytest.fixture(autouse=True)
def freshScene(request):
    """Every test starts from, and leaves behind, an empty scene."""
    scenes.clear()
    yield
    scenes.clear()


@pytest.fixture
def folder():
    with tempfile.TemporaryDirectory(prefix='yadefrag') as path:
        yield path


@pytest.fixture(params=['8k'])
def small(folder, request):
    """A disk of 8 KB, or of another size."""
    disk = folder + '/disk'
    os.mkdir(disk)
    if subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=' + request.param, 'none', disk],
                      capture_output=True).returncode:
        pytest.skip('no disk can be mounted here')
    yield disk
    subprocess.run(['umount', disk], check=True)
