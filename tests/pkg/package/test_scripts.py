"""The scripts of scripts/: which systems and arguments they refuse, each in one sentence. A plugin for a YADE that
its user built: flags from its config.py, refusals, what the import compares."""
import os
import subprocess

import pytest
from yadefrag import support
import project
from project import ROOT


def ask(*command, **more):
    return subprocess.run([str(ROOT / 'scripts' / command[0]), *command[1:]], text=True, cwd=ROOT,
                          capture_output=True, stdin=subprocess.DEVNULL, env={**os.environ, **more},
                          check=False)


def system(folder, name, version):
    """A description of a system; a version without digits stands for one that is not released yet."""
    path = folder / 'os-release'
    kind = 'ID' if version[0].isdigit() else 'CODENAME'
    path.write_text('ID=%s\nVERSION_%s="%s"\nPRETTY_NAME="%s %s"\n' % (name, kind, version, name, version))
    return str(path)


@pytest.mark.parametrize('version', ['12', '13', '14', 'forky'])
def test_setUpAcceptsTheReleases(version, tmp_path):
    """With everything installed: only the system is looked at."""
    done = ask('setup', 'plugin', YADEFRAG_OS_RELEASE=system(tmp_path, 'debian', version))
    assert (done.returncode, done.stdout, done.stderr) == (0, '', '')


@pytest.mark.parametrize('name, version', [('debian', '11'), ('debian', '15'), ('debian', 'duke'), ('ubuntu', '24.04')])
def test_setUpRefusesOtherSystems(name, version, tmp_path):
    done = ask('setup', YADEFRAG_OS_RELEASE=system(tmp_path, name, version))
    assert done.returncode == 1 and done.stderr.count('\n') == 1
    for word in (name + ' ' + version, '2023.02a', '2025.2.0', '2026.1.0'):
        assert word in done.stderr


@pytest.mark.parametrize('command, words', [
    (('setup', 'everything'), "takes nothing, 'compile' or 'plugin'"),
    (('build', 'fast'), "no preset 'fast'"),
    (('test', 'yode'), "no tests called 'yode'"),
    (('test', 'lib', 'one'), 'after yade only'),
    (('test', 'long', 'chalk'), "no part 'chalk'"),
    (('test', '--release'), 'takes the name'),
    (('in-release', 'potato', 'true'), "no release 'potato'"),
    (('package', 'now'), 'takes no arguments'),
    (('try-package', 'nowhere.deb'), "no file 'nowhere.deb'"),
    (('try-package', 'README.md'), 'scripts/in-release --clean'),
    (('release', 'new'), "'new' is not a version"),
])
def test_wrongArgumentsAreNamed(command, words):
    done = ask(*command, CLEAN_LAYER='')
    assert done.returncode == 1 and done.stdout == ''
    assert done.stderr.count('\n') == 1 and words in done.stderr


def test_anInstalledPluginIsNotTestedInsteadOfTheBuiltOne(tmp_path):
    """A YADE that its user built finds it before the built one."""
    installed = tmp_path / 'lib' / 'x86_64-linux-gnu' / 'yade-mine' / 'py' / 'yadefrag'
    installed.mkdir(parents=True)
    (tmp_path / 'bin').mkdir()
    (tmp_path / 'bin' / 'yade-mine').touch()
    done = ask('test', 'yade', YADE_PREFIX=str(tmp_path))
    assert done.returncode == 1 and done.stdout == ''
    assert done.stderr.count('\n') == 1 and 'installed in %s,' % installed in done.stderr


def test_anUnreachableServerHasACodeOfItsOwn(tmp_path):
    """CI goes on then; here a debootstrap that fails stands for it."""
    (tmp_path / 'bin').mkdir()
    for name in ('debootstrap', 'id'):
        program = tmp_path / 'bin' / name
        program.write_text('#!/bin/sh\n%s\n' % ('echo 0' if name == 'id' else 'exit 1'))
        program.chmod(0o755)
    script = (ROOT / 'scripts' / 'in-release').read_text()
    # Debian's tools come first on the path of the scripts.
    changed = script.replace('[ "$(id -u)" -eq 0 ]', 'PATH="%s:$PATH"\n[ "$(id -u)" -eq 0 ]' %
                             (tmp_path / 'bin'), 1)
    assert changed != script
    (tmp_path / 'scripts').mkdir()
    (tmp_path / 'scripts' / 'in-release').write_text(changed)
    (tmp_path / 'scripts' / 'common.sh').write_text((ROOT / 'scripts' / 'common.sh').read_text())
    done = subprocess.run(['bash', str(tmp_path / 'scripts' / 'in-release'), 'trixie', 'true'],
                          capture_output=True, text=True, check=False,
                          env={**os.environ, 'YADEFRAG_ROOTS': str(tmp_path / 'roots')})
    if 'lets no file system be mounted' in done.stderr:
        pytest.skip('this machine permits no mounts: the server is not asked')
    assert done.returncode == 75 and 'cannot be fetched' in done.stderr


@pytest.fixture
def turn(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / 'scripts'))
    import tidy_turn
    return tidy_turn


SOURCES = sorted(map(str, (ROOT / 'lib').rglob('*.cpp')))


def test_theTurnsOfClangTidyAreAllSourcesOnce(turn):
    turns = [set(turn.chosen(SOURCES, set(), number)) for number in range(turn.TURNS)]
    assert set().union(*turns) == set(SOURCES) and sum(map(len, turns)) == len(SOURCES)
    assert max(map(len, turns)) < len(SOURCES) / 2


@pytest.mark.parametrize('number', range(3))
def test_whatHasChangedIsInEachTurn(turn, number):
    header = str(ROOT / 'lib' / 'core' / 'work_list.hpp')
    found = turn.chosen(SOURCES, {SOURCES[0], SOURCES[-1], header}, number)
    assert SOURCES[0] in found and SOURCES[-1] in found
    assert any(header in turn.headersOf(path) for path in found)


def test_allAreCheckedWhereTheHistoryIsUnknown(turn, monkeypatch, tmp_path, capsys):
    """Outside git, in a shallow clone, and before the first commits."""
    monkeypatch.setattr(turn, 'ROOT', str(tmp_path))
    turn.main('60', *SOURCES)
    assert capsys.readouterr().out.split() == SOURCES
    monkeypatch.setattr(turn, 'git', lambda *arguments: ['true'])
    assert turn.history('1') == (None, 0)


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
