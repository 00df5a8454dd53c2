"""Files that cannot be written: reported before a run, with their names, and the old file stays as it was."""
import builtins
import os
import random
import signal
import stat
import time

import pytest

import study_scenes
import yadefrag
from fe_scene import impact
from yade import utils
from yadefrag import files
from yadefrag.studies import tradeoff_grid
from yadefrag.studies.tradeoff_table import TradeoffRow

O = builtins.O
kNowhere = ['/nowhere/run', '/proc/run', '{folder}/file/run']


def table():
    return yadefrag.TradeoffTable([
        TradeoffRow({'k': k, 'n': 'x' * 3000}, 'ok', k, k, 1 / k, 0, 9, [k], [k])
        for k in (1, 2, 3)])


def writers(solver):
    """ending: what writes such a file."""
    return {'.vtu': lambda f: yadefrag.exportVTK(solver, f),
            '.png': lambda f: yadefrag.plotMesh(solver, 'mises', file=f),
            '.gif': lambda f: yadefrag.animate(solver, f, 1, 1),
            '.csv': lambda f: table().csv(f), '.md': lambda f: table().markdown(f)}


def test_anOldFileIsNotLostToAFullDisk(small):
    for ending, write in writers(impact()).items():
        name = small + '/run' + ending
        with open(name, 'w') as old:
            old.write('what was there')
        with open(small + '/rest', 'wb') as rest:
            rest.write(b'x' * 4096)
        with pytest.raises(OSError, match='No space left') as error:
            write(name)
        assert error.value.filename == name
        with open(name) as old:
            assert old.read() == 'what was there'
        assert sorted(os.listdir(small)) == ['rest', 'run' + ending]
        os.remove(name)


def test_aKilledWriterLeavesAWholeFile(folder):
    name, solver, draw = folder + '/run.vtu', impact(), random.Random(1)
    yadefrag.exportVTK(solver, name)
    with open(name, 'rb') as file:
        whole = file.read()
    for _ in range(20):
        writer = os.fork()
        if writer == 0:
            while True:
                yadefrag.exportVTK(solver, name)
        time.sleep(draw.uniform(.002, .05))
        os.kill(writer, signal.SIGKILL)
        os.waitpid(writer, 0)
        with open(name, 'rb') as file:
            assert file.read() == whole


@pytest.mark.parametrize('where', kNowhere)
def test_anUnwritablePathIsNamedBeforeARun(where, folder):
    open(folder + '/file', 'w').close()
    solver = impact()
    for ending, write in writers(solver).items():
        name = where.format(folder=folder) + ending
        with pytest.raises(OSError) as error:
            write(name)
        assert error.value.filename == name and O.iter == 0


def test_aFolderIsNoFile(folder):
    for ending, write in writers(impact()).items():
        name = folder + '/run' + ending
        os.mkdir(name)
        with pytest.raises(IsADirectoryError) as error:
            write(name)
        assert error.value.filename == name and O.iter == 0 and os.path.isdir(name)
        assert os.listdir(name) == []


def test_aDeviceStaysOne():
    with pytest.raises(OSError, match='No space left'):
        files.writeText('/dev/full', 'x')
    files.writeText('/dev/null', 'x')
    for device in ('/dev/full', '/dev/null'):
        assert stat.S_ISCHR(os.stat(device).st_mode)
        files.requireWritable(device)


def test_aLinkStaysOneAndAModeToo(folder):
    real, link = folder + '/real.csv', folder + '/link.csv'
    open(real, 'w').close()
    os.chmod(real, 0o640)
    os.symlink(real, link)
    table().csv(link)
    assert os.path.islink(link) and os.path.getsize(real) > 0
    assert stat.S_IMODE(os.stat(real).st_mode) == 0o640
    assert len(yadefrag.TradeoffTable.read(link).rows) == 3


def test_noLinkOfATemporaryNameIsFollowed(folder, monkeypatch):
    """Not even one whose name was guessed."""
    victim, name = folder + '/victim', folder + '/t.csv'
    with open(victim, 'w') as file:
        file.write('kept')
    drawn = ['a' * 16, 'b' * 16]
    monkeypatch.setattr(files.secrets, 'token_hex', lambda count: drawn.pop(0))
    os.symlink(victim, folder + '/.%s.part.t.csv' % drawn[0])
    table().csv(name)
    assert drawn == [] and len(yadefrag.TradeoffTable.read(name).rows) == 3
    with open(victim) as file:
        assert file.read() == 'kept'
    assert sorted(os.listdir(folder)) == ['.%s.part.t.csv' % ('a' * 16), 't.csv', 'victim']


def test_temporaryNamesCannotBeGuessed(folder):
    names = set()
    for _ in range(100):
        with files.replacing(folder + '/run.vtu') as part:
            names.add(os.path.basename(part))
            assert stat.S_ISREG(os.lstat(part).st_mode) and part.endswith('.part.run.vtu')
    assert len(names) == 100 and not any(str(os.getpid()) in name.split('.')[1] for name in names)


@pytest.mark.parametrize('mask', [0o022, 0o077, 0o002])
def test_aNewFileHasTheModeOfTheProcess(mask, folder):
    before = os.umask(mask)
    try:
        table().csv(folder + '/t.csv')
    finally:
        os.umask(before)
    assert stat.S_IMODE(os.stat(folder + '/t.csv').st_mode) == 0o666 & ~mask


def test_aLongNameOfWideLettersIsWritten(folder):
    name = folder + '/' + 'ж' * 125 + '.csv'
    table().csv(name)
    assert len(yadefrag.TradeoffTable.read(name).rows) == 3


def test_aRecordGrowsByWholeLines(small):
    solver = impact()
    name = small + '/run.csv'
    record = yadefrag.recordFracture(solver, name)
    with pytest.raises(OSError, match='No space left') as error:
        for _ in range(1000):
            record()
    assert error.value.filename == name
    with open(name) as lines:
        text = lines.read()
    assert text.endswith('\n') and len({line.count(',') for line in text.splitlines()}) == 1
    yadefrag.plotFracture(name)


# --- tradeoff

@pytest.mark.parametrize('where', kNowhere)
def test_tradeoffLooksAtItsFilesFirst(where, folder, monkeypatch):
    open(folder + '/file', 'w').close()
    monkeypatch.setattr(tradeoff_grid, '_runAll', lambda *_: pytest.fail('it has run'))
    with pytest.raises(OSError) as error:
        yadefrag.tradeoff(study_scenes.block, {'passes': [1]}, study_scenes.way, duration=1.,
                          files=where.format(folder=folder))
    assert error.value.filename == where.format(folder=folder) + '.csv'


def test_tradeoffReturnsItsTableFromAFullDisk(small, monkeypatch):
    """It was writable before, and is full after the runs."""

    def fill(*_):
        with open(small + '/rest', 'wb') as rest:
            rest.write(b'x' * 8192)

    monkeypatch.setattr(tradeoff_grid, '_runAll', fill)
    with pytest.warns(UserWarning, match='the table could not be written: .*No space left'):
        found = yadefrag.tradeoff(study_scenes.block, {'passes': [1]}, study_scenes.way,
                                  duration=1., files=small + '/t')
    assert len(found.rows) == 1


def test_aDurationBelowHalfAStepIsRefused():
    found = yadefrag.tradeoff(study_scenes.block, {'passes': [1]}, study_scenes.way,
                              duration=1e-12, repeats=1)
    row, = found.rows
    assert row.result == 'refused' and 'at most half of the scene\'s step' in row.message


# --- files that are read

@pytest.mark.parametrize('text', ['', '\n', 'step\n', 'a,b\n1,2\n', '\ufeff', '\xff\xfe'])
def test_aFileOfOtherColumnsIsNoRecord(text, folder):
    name = folder + '/run.csv'
    with open(name, 'w', encoding='latin-1' if text == '\xff\xfe' else 'utf-8') as file:
        file.write(text)
    with pytest.raises(ValueError, match='run.csv has no lines of recordFracture'):
        yadefrag.plotFracture(name)
    with pytest.raises(ValueError, match='does not end with the columns'):
        yadefrag.TradeoffTable.read(name)


def test_damagedRecordsAndTablesAreRefused(folder):
    name = folder + '/run.csv'
    yadefrag.recordFracture(impact(), name)
    with open(name) as file:
        good = file.read()
    for bad in (good + '1,2,3\n', good.replace('0.0', 'x'), good.splitlines()[0] + '\n'):
        with open(name, 'w') as file:
            file.write(bad)
        with pytest.raises(ValueError, match='no lines of recordFracture|damaged one'):
            yadefrag.plotFracture(name)
    table().csv(name)
    with open(name) as file:
        good = file.read()
    for bad in (good + '1,2,3\n', good.replace('[1]', '[[1]]'), good.replace('ok,1', 'ok,fast')):
        assert bad != good
        with open(name, 'w') as file:
            file.write(bad)
        with pytest.raises(ValueError, match='has a damaged row'):
            yadefrag.TradeoffTable.read(name)


def test_aByteOrderMarkIsSkipped(folder):
    mark = '\ufeff'.encode()
    for name, data in (('plate', b'0 0\n1 0\n1 1\n'), ('t.csv', None), ('r.csv', None)):
        path = folder + '/' + name
        if name == 't.csv':
            table().csv(path)
        elif name == 'r.csv':
            yadefrag.recordFracture(impact(), path)
        else:
            with open(path, 'wb') as file:
                file.write(data)
        with open(path, 'rb') as file:
            data = file.read()
        with open(path, 'wb') as file:
            file.write(mark + data)
    assert yadefrag.readPolygon(folder + '/plate') == ([(0, 0), (1, 0), (1, 1)], [])
    assert len(yadefrag.TradeoffTable.read(folder + '/t.csv').rows) == 3
    yadefrag.plotFracture(folder + '/r.csv')


# --- YADE's own save

@pytest.mark.parametrize('ending', ['.yade', '.xml', '.yade.gz', '.yade.bz2', '.xml.gz', '.xml.bz2'])
@pytest.mark.parametrize('where', ['/nowhere/x', '/proc/x', '{folder}/file/x', '{folder}/deep'])
def test_aSceneThatCannotBeSavedIsReportedFirst(where, ending, folder):
    """YADE alone never ends for compressed files, and does not tell for others of a small scene."""
    O.reset()
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    open(folder + '/file', 'w').close()
    os.mkdir(folder + '/deep' + ending)
    name = where.format(folder=folder) + ending
    cause = '.*Is a directory' * ('deep' in where)
    with pytest.raises(RuntimeError, match='^%s could not be saved: its file cannot be opened%s' % (name, cause)):
        O.save(file=name, quiet=True)
    assert os.listdir(folder + '/deep' + ending) == []
    O.save(folder + '/whole' + ending)
    O.reset()
    O.load(folder + '/whole' + ending)
    assert len(O.bodies) == 1


def test_aSaveOnAFullDeviceIsReported():
    impact()
    with pytest.raises(RuntimeError, match='could not be saved.*its file cannot be opened or the disk is full'):
        O.save('/dev/full')
    assert len(O.bodies) > 0


def test_aSaveOnAFullDiskIsReported(small):
    """Compressed, too, if nothing is left."""
    O.reset()
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    with open(small + '/rest', 'wb', buffering=0) as rest:
        rest.write(b'x' * 8192)
    for ending in ('.yade', '.yade.gz', '.xml.bz2'):
        with pytest.raises(RuntimeError, match='could not be saved: its file cannot be opened or the disk is full'):
            O.save(small + '/x' + ending)
    with open(small + '/rest', 'wb', buffering=0) as rest:
        rest.write(b'x' * 4096)
    O.bodies.append([utils.sphere((i, 0, 0), 1) for i in range(20)])  # of 5 KB, for which YADE raises nothing
    with pytest.raises(RuntimeError, match='could not be saved: its file cannot be opened or the disk is full'):
        O.save(small + '/x.yade')


@pytest.mark.parametrize('ending', ['.yade', '.xml.gz'])
def test_aSaveThatIsKilledLeavesTheOldFile(ending, folder):
    O.reset()
    O.bodies.append([utils.sphere((i, 0, 0), 1) for i in range(1500)])
    name = folder + '/x' + ending
    O.save(name)
    for moment in range(8):
        child = os.fork()
        if child == 0:
            while True:
                O.save(name, quiet=True)
        time.sleep(.03 + .017 * moment)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        O.load(name, quiet=True)
        assert len(O.bodies) == 1500


def test_aSaveIsTheFileOfItsName(folder):
    """With its mode and its link; O.filename and O.reload know it."""
    O.reset()
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    name, link = folder + '/x.yade.gz', folder + '/link.yade.gz'
    O.save(name)
    os.chmod(name, 0o640)
    os.symlink(name, link)
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    O.save(link)
    assert O.filename == link and os.path.islink(link) and os.stat(name).st_mode & 0o777 == 0o640
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    O.reload()
    assert len(O.bodies) == 2 and O.filename == link
    O.saveTmp('here')
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    O.reload()
    assert len(O.bodies) == 2 and sorted(os.listdir(folder)) == ['link.yade.gz', 'x.yade.gz']
