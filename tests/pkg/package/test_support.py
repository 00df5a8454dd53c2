"""The check at `import yadefrag`: which YADE is refused, and with what words."""

import os
import pathlib
import re
import subprocess
import sys
import types

import pytest

import yade
from yade import config, wrapper
from yadefrag import _yadefrag, support


@pytest.fixture(autouse=True)
def packaged(monkeypatch):
    """Words about a build for a package, also where these tests run in a YADE that its user built."""
    monkeypatch.setattr(support, 'FEATURES', None)


STOCK = ['OPENMP', 'MPI', 'QT5', 'FEMLIKE', 'VTK', 'CGAL']


def test_stockYadeIsAccepted():
    assert support.describeMismatch(support.VERSION, 'PrecisionDouble', STOCK) == ''


@pytest.mark.parametrize('version, precision, features, found, needed', [
    ('2022.01a', 'PrecisionDouble', STOCK, 'version 2022.01a', 'version ' + support.VERSION),
    (support.VERSION, 'PrecisionLongDouble', STOCK, 'PrecisionLongDouble', 'PrecisionDouble'),
    (support.VERSION, 'PrecisionDouble', STOCK + ['VECTORIZE'], 'has VECTORIZE', 'no VECTORIZE'),
    (support.VERSION, 'PrecisionDouble', STOCK + ['MASK_ARBITRARY'], 'has MASK_ARB', 'no MASK_ARB'),
    (support.VERSION, 'PrecisionDouble', STOCK + ['SPH'], 'has SPH', 'no SPH'),
    (support.VERSION, 'PrecisionDouble', ['OPENMP', 'QT5', 'FEMLIKE'], 'has no MPI', 'with MPI'),
])
def test_otherYadeIsNamedInOneSentence(version, precision, features, found, needed):
    sentence = support.describeMismatch(version, precision, features)
    assert found in sentence and needed in sentence
    assert sentence.count('. ') == 0 and sentence.endswith('.') and '\n' not in sentence


def test_versionOfAnotherBuildIsNamedAsSuch():
    others = [version for version in support.ACCEPTED if version != support.VERSION]
    assert others
    for version in others:
        sentence = support.describeMismatch(version, 'PrecisionDouble', STOCK)
        assert sentence.endswith('for which yadefrag must be built or installed again.')


def test_untriedVersionIsRefusedInOneSentence(monkeypatch):
    """A build for a YADE whose layout is known, but without a test run."""
    monkeypatch.setattr(support, 'VERSION', '2027.1.0')
    sentence = support.describeMismatch('2027.1.0', 'PrecisionDouble', STOCK)
    assert 'never tested with it' in sentence and '2023.02a' in sentence
    assert sentence.endswith('.') and '\n' not in sentence


def test_everyDifferenceIsNamed():
    sentence = support.describeMismatch('1.0', 'PrecisionFloat', ['SPH'])
    for word in ('1.0', 'PrecisionFloat', 'no OPENMP', 'no MPI', 'has', 'SPH'):
        assert word in sentence


def test_configWithoutTheFieldsIsRefused():
    modules = {'yade.wrapper': None, 'yade.config': types.SimpleNamespace()}
    assert 'unknown' in support.describeSurroundings(modules)


def test_plainPythonIsReferredToYade():
    package = pathlib.Path(support.__file__).parent.parent
    done = subprocess.run([sys.executable, '-c', 'import yadefrag'], capture_output=True, text=True,
                          env={**os.environ, 'PYTHONPATH': str(package)}, check=False)
    assert done.returncode == 1
    last = done.stderr.strip().splitlines()[-1]
    assert last.startswith('ImportError: ') and 'run by the command `yade`' in last


def test_anotherBuildOfTheSameVersionIsRefusedInOneSentence(tmp_path):
    library = tmp_path / 'libyade.so'
    sentence = support.describeOtherBuild(str(tmp_path))
    assert sentence.endswith('has none: yadefrag must be built or installed again.')
    library.write_bytes(b'\x7fELF' + b'\x04\0\0\0\x14\0\0\0\x03\0\0\0GNU\0' + bytes(range(20)))
    sentence = support.describeOtherBuild(str(tmp_path))
    assert 'has 000102030405060708090a0b0c0d0e0f10111213:' in sentence and '\n' not in sentence
    assert support.describeOtherBuild(config.libDir) == ''


def test_yadesOwnClassesAreNotReplaced():
    for name in ('Collider', 'InsertionSortCollider', 'Sphere', 'Body'):
        assert getattr(yade, name) is getattr(wrapper, name)
    assert isinstance(wrapper.InsertionSortCollider(), yade.Collider)


def test_ownCopiesOfEigenCgalAndFmtStayInside():
    """YADE's, compiled with other options, would be called instead."""
    names = subprocess.run(['nm', '-DC', '--defined-only', _yadefrag.__file__], check=True,
                           capture_output=True, text=True).stdout.splitlines()
    names = [line.split(' ', 2)[2] for line in names]
    assert 'PyInit__yadefrag' in names
    assert any(name.startswith('typeinfo for yade') for name in names), 'one with YADE\'s'
    # A template of ours, or of std at -O1, may return one of Eigen's types: its name then begins with that type.
    functions = [name for name in names if ' yadefrag::' not in name and re.match(
        r'.*CGAL::|.*fmt::v|(guard variable for |void |)Eigen::(?![^(]*[>&*] std::)', name)]
    assert functions == []
