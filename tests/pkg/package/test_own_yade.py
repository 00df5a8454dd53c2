"""A plugin for a YADE that its user built: flags from its config.py, refusals, what the import compares."""

import subprocess

import pytest

import project
from yadefrag import support

TOOL = project.ROOT / 'pkg' / 'abi' / 'tools' / 'yade_build.py'
CONFIG = """suffix='-mine'
highPrecisionBits         =%(bits)d
highPrecisionDecimalPlaces=15
features=' %(features)s'.split(' ')
version='%(version)s'
sourceRoot='%(source)s'
"""


def installed(folder, features='LOGGER OPENMP LIQMIGRATION', bits=64, version='2031.1', release=None):
    """The folder of libraries of a YADE without libraries, with the sources that it was built from."""
    libraries, source = folder / 'lib' / 'yade-mine', folder / 'trunk'
    (libraries / 'py' / 'yade').mkdir(parents=True)
    (source / 'core').mkdir(parents=True)
    (source / 'core' / 'Scene.hpp').touch()
    (source / 'RELEASE').write_text((version if release is None else release) + '\n')
    (libraries / 'py' / 'yade' / 'config.py').write_text(CONFIG % {
        'bits': bits, 'features': features, 'version': version, 'source': source})
    return libraries


def asked(*arguments):
    return subprocess.run(['/usr/bin/python3', str(TOOL), *map(str, arguments)], capture_output=True, text=True,
                          check=False)


def test_flagsFollowFromTheFeatures(tmp_path):
    libraries = installed(tmp_path)
    done = asked(libraries)
    assert done.returncode == 0, done.stdout
    version, source, features, command, *flags = done.stdout.splitlines()
    assert (version, source, features, command) == (
        '2031.1', str(tmp_path / 'trunk'), 'LOGGER OPENMP LIQMIGRATION', 'yade-mine')
    for flag in ('-DYADE_OPENMP', '-DYADE_LIQMIGRATION', '-DYADE_REAL_BIT=64', '-DEIGEN_DONT_ALIGN', '-fopenmp'):
        assert flag in flags
    assert not any('YADE_MPI' in flag or 'YADE_OPENGL' in flag for flag in flags)


@pytest.mark.parametrize('change, words', [
    ({'bits': 80}, 'numbers of 80 bits'),
    ({'features': 'OPENMP MASK_ARBITRARY'}, 'MASK_ARBITRARY'),
    ({'features': 'OPENMP VECTORIZE'}, 'VECTORIZE'),
    ({'features': 'LOGGER'}, 'without OPENMP'),
    ({'release': '2030.9'}, 'those of YADE 2030.9'),
])
def test_otherBuildsAreRefusedInOneSentence(tmp_path, change, words):
    done = asked(installed(tmp_path, **change))
    assert done.returncode == 2 and words in done.stdout
    assert done.stdout.count('\n') == 1 and done.stdout.endswith('.\n')


def test_checkoutMustBeAtTheCommitOfTheBuild(tmp_path):
    """config.py of a YADE from a Git checkout names the commit."""
    def git(*arguments):
        return subprocess.run(['git', '-c', 'user.name=a', '-c', 'user.email=a@b', '-C', str(tmp_path / 'trunk'),
                               *arguments], capture_output=True, text=True, check=True).stdout.strip()

    libraries = installed(tmp_path, version='VERSION', release='')
    git('init', '-q')
    git('commit', '-q', '--allow-empty', '-m', 'one')
    config = libraries / 'py' / 'yade' / 'config.py'
    config.write_text(config.read_text().replace('VERSION', '2031-01-02.git-' + git('rev-parse', '--short', 'HEAD')))
    assert asked(libraries).returncode == 0
    git('commit', '-q', '--allow-empty', '-m', 'two')
    done = asked(libraries)
    assert done.returncode == 2 and 'was built from' in done.stdout and done.stdout.count('\n') == 1


def test_sourcesThatHaveMovedAreAskedFor(tmp_path):
    libraries = installed(tmp_path)
    moved = (tmp_path / 'trunk').rename(tmp_path / 'elsewhere')
    assert 'YADE_SOURCE' in asked(libraries).stdout
    assert asked(libraries, moved).returncode == 0


def found(**given):
    """CMake's search for the folder of libraries."""
    return subprocess.run(['cmake', *['-D%s=%s' % item for item in given.items()], '-P',
                           str(project.ROOT / 'cmake' / 'yade_folder.cmake')], capture_output=True, text=True, check=False)


def test_wrongPrefixIsNamed(tmp_path):
    assert 'has 0 installed YADEs' in ' '.join(found(YADE_PREFIX=tmp_path).stderr.split())
    installed(tmp_path)
    assert found(YADE_PREFIX=tmp_path).returncode == 0
    (tmp_path / 'lib' / 'yade-other' / 'py' / 'yade').mkdir(parents=True)
    (tmp_path / 'lib' / 'yade-other' / 'py' / 'yade' / 'config.py').touch()
    assert 'has 2 installed YADEs' in ' '.join(found(YADE_PREFIX=tmp_path).stderr.split())
    assert 'needs YADE_PREFIX' in ' '.join(found(YADE_SOURCE=tmp_path).stderr.split())


def test_headersAreComparedWithTheFeaturesOfThePackages(monkeypatch):
    monkeypatch.syspath_prepend(str(TOOL.parent))
    import check_source
    assert check_source.FEATURES == list(support.NEEDED)


def test_theRunningYadeIsAccepted():
    assert support.describeSurroundings() == ''


def test_importComparesAllFeatures(monkeypatch):
    monkeypatch.setattr(support, 'FEATURES', ['LIQMIGRATION', 'OPENMP'])
    assert support.describeMismatch(support.VERSION, 'PrecisionDouble', ['OPENMP', 'LIQMIGRATION']) == ''
    sentence = support.describeMismatch(support.VERSION, 'PrecisionDouble', ['OPENMP', 'SPH'])
    assert 'has no LIQMIGRATION, SPH' in sentence and 'with LIQMIGRATION, no SPH' in sentence
    assert sentence.endswith('must be built again.') and sentence.count('. ') == 0
