"""The scripts of scripts/: which systems and arguments they refuse, each in one sentence. A plugin for a YADE that its
user built: flags from its config.py, refusals, what the import compares. scripts/bench codes: LAMMPS, LIGGGHTS and
YADE with our engines compute the same motion from the same scene."""
import os
import subprocess
import sys

import pytest
from yadefrag import support
from project import ran, ROOT

# Last: its modules have names that other folders have, too.
sys.path.append(str(ROOT / 'tests' / 'benchmark'))
import codes  # noqa: E402


def ask(*command, **more):
    return ran(ROOT / 'scripts' / command[0], *command[1:], cwd=ROOT, stdin=subprocess.DEVNULL, env={**os.environ, **more})


def requireRefused(done, *words):
    """In one line, which has these words."""
    assert (done.returncode, done.stdout, done.stderr.count('\n')) == (1, '', 1)
    assert all(word in done.stderr for word in words)


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
    requireRefused(ask('setup', YADEFRAG_OS_RELEASE=system(tmp_path, name, version)),
                   name + ' ' + version, '2023.02a', '2025.2.0', '2026.1.0')


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
    requireRefused(ask(*command, CLEAN_LAYER=''), words)


def test_anInstalledPluginIsNotTestedInsteadOfTheBuiltOne(tmp_path):
    """A YADE that its user built finds it before the built one."""
    installed = tmp_path / 'lib' / 'x86_64-linux-gnu' / 'yade-mine' / 'py' / 'yadefrag'
    installed.mkdir(parents=True)
    (tmp_path / 'bin').mkdir()
    (tmp_path / 'bin' / 'yade-mine').touch()
    requireRefused(ask('test', 'yade', YADE_PREFIX=str(tmp_path)), 'installed in %s,' % installed)


def test_anUnreachableServerHasACodeOfItsOwn(tmp_path):
    """CI goes on then; here a debootstrap that fails stands for it."""
    (tmp_path / 'bin').mkdir()
    for name in ('debootstrap', 'id'):
        program = tmp_path / 'bin' / name
        program.write_text('#!/bin/sh\n%s\n' % ('echo 0' if name == 'id' else 'exit 1'))
        program.chmod(0o755)
    script = (ROOT / 'scripts' / 'in-release').read_text()
    # Debian's tools come first on the path of the scripts.
    changed = script.replace('[ "$(id -u)" -eq 0 ]', 'PATH="%s:$PATH"\n[ "$(id -u)" -eq 0 ]' % (tmp_path / 'bin'), 1)
    assert changed != script
    (tmp_path / 'scripts').mkdir()
    (tmp_path / 'scripts' / 'in-release').write_text(changed)
    (tmp_path / 'scripts' / 'common.sh').write_text((ROOT / 'scripts' / 'common.sh').read_text())
    done = ran('bash', tmp_path / 'scripts' / 'in-release', 'trixie', 'true',
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


TOOL = ROOT / 'pkg' / 'yade' / 'tools' / 'yade_build.py'
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
    return ran('/usr/bin/python3', TOOL, *arguments)


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
        return ran('git', '-c', 'user.name=a', '-c', 'user.email=a@b', '-C', tmp_path / 'trunk', *arguments).stdout.strip()

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


def complaint(**given):
    """Of CMake's search for the folder of libraries."""
    done = ran('cmake', *['-D%s=%s' % item for item in given.items()], '-P', ROOT / 'cmake' / 'yade_folder.cmake')
    return ' '.join(done.stderr.split()) if done.returncode else ''


def test_wrongPrefixIsNamed(tmp_path):
    assert 'has 0 installed YADEs' in complaint(YADE_PREFIX=tmp_path)
    installed(tmp_path)
    assert complaint(YADE_PREFIX=tmp_path) == ''
    (tmp_path / 'lib' / 'yade-other' / 'py' / 'yade').mkdir(parents=True)
    (tmp_path / 'lib' / 'yade-other' / 'py' / 'yade' / 'config.py').touch()
    assert 'has 2 installed YADEs' in complaint(YADE_PREFIX=tmp_path)
    assert 'needs YADE_PREFIX' in complaint(YADE_SOURCE=tmp_path)


def test_headersAreComparedWithTheFeaturesOfThePackages(monkeypatch):
    monkeypatch.syspath_prepend(str(TOOL.parent))
    import check_source
    assert check_source.FEATURES == list(support.NEEDED)


def test_importComparesAllFeatures(monkeypatch):
    assert support.describeSurroundings() == ''
    monkeypatch.setattr(support, 'FEATURES', ['LIQMIGRATION', 'OPENMP'])
    assert support.describeMismatch(support.VERSION, 'PrecisionDouble', ['OPENMP', 'LIQMIGRATION']) == ''
    sentence = support.describeMismatch(support.VERSION, 'PrecisionDouble', ['OPENMP', 'SPH'])
    assert 'has no LIQMIGRATION, SPH' in sentence and 'with LIQMIGRATION, no SPH' in sentence
    assert sentence.endswith('must be built again.') and sentence.count('. ') == 0


# --- codes

@pytest.fixture(scope='module')
def rows():
    """Rows of 500 spheres without friction, where only the order of summation differs."""
    options = codes.parse(['--scenes', 'packing,stirred', '--sizes', '500', '--codes', 'loop,LIGGGHTS,LAMMPS',
                           '--friction', '0', '--warm', '5', '--steps', '30', '--repeat', '1'])
    options.codes = codes.installed(options.codes)
    return options, codes.measured(options, lambda text: None)


def test_positionsAreThoseAndPartsNoMoreThanTheStep(rows, tmp_path):
    options, found = rows
    medians = codes.summary(found)
    for table in (found, codes.rows(medians)):
        assert [(row['scene'], row['code']) for row in table] == [
            (scene, name) for scene in ('packing', 'stirred') for name in options.codes]
    assert max(row['deviation'] for row in found) < 1e-9 and min(row['memory'] for row in found) > 10 * 2**20
    for row in found:
        assert 0 <= row['search'] and 0 < row['forces'] and 0 < row['integration']
        assert row['search'] + row['forces'] + row['integration'] < 1.02 * row['step']
    codes.plot(str(tmp_path / 'codes.png'), medians, 'here')
    assert (tmp_path / 'codes.png').stat().st_size > 10000


def test_otherMotionIsAnError(monkeypatch):
    """A code that leaves its spheres where they were is found."""
    monkeypatch.setitem(codes.OTHERS, 'LAMMPS', lambda *_, **__: {})
    monkeypatch.setattr(codes.shutil, 'which', lambda program: program)
    monkeypatch.setattr(codes.codes_others, 'ended', lambda folder: codes.codes_others.start(folder)[0]['places'])
    options = codes.parse('--scenes gas --sizes 500 --codes loop,LAMMPS --warm 5 --steps 5'.split())
    with pytest.raises(RuntimeError, match='positions of LAMMPS differ by 1 of'):
        codes.measured(options, lambda text: None)


def test_missingCodesAreNamed(monkeypatch, capsys):
    monkeypatch.setattr(codes.shutil, 'which', lambda program: None)
    assert codes.installed(['YADE', 'LIGGGHTS', 'LAMMPS']) == ['YADE']
    assert capsys.readouterr().err.strip() == (
        'not compared with LIGGGHTS and LAMMPS: not installed (sudo apt-get install liggghts lammps).')
