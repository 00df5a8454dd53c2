"""Files that cannot be written: reported before a run, with their names, and the old file stays as it was."""
import os
import random
import signal
import stat
import time
from pathlib import Path

import pytest

import study_scenes
import yadefrag
from fe_scene import impact, O
from yade import utils
from yadefrag import files
from yadefrag.studies import tradeoff_grid
from yadefrag.studies.tradeoff_table import TradeoffRow

kNowhere, kFolder = ['/nowhere/run', '/proc/run', '{folder}/file/run'], '{folder}/run'


def table():
    return yadefrag.TradeoffTable([
        TradeoffRow({'k': k, 'n': 'x' * 3000}, 'ok', 0, 9, k, cpu=k, error=1 / k, walls=[k], cpus=[k])
        for k in (1, 2, 3)])


def traded(**more):
    return yadefrag.tradeoff(study_scenes.block, {'passes': [1]}, study_scenes.way, duration=1., **more)


def fill(name, count):
    with open(name, 'wb', buffering=0) as rest:
        rest.write(b'x' * count)


def writers(solver):
    """ending: what writes such a file."""
    return {'.vtu': lambda f: yadefrag.exportVTK(solver, f),
            '.png': lambda f: yadefrag.plotMesh(solver, 'mises', file=f),
            '.gif': lambda f: yadefrag.animate(solver, f, 1, 1),
            '.csv': lambda f: table().csv(f), '.md': lambda f: table().markdown(f)}


def test_anOldFileIsNotLostToAFullDisk(small):
    for ending, write in writers(impact()).items():
        name = small + '/run' + ending
        Path(name).write_text('what was there')
        fill(small + '/rest', 4096)
        with pytest.raises(OSError, match='No space left') as error:
            write(name)
        assert error.value.filename == name and Path(name).read_text() == 'what was there'
        assert sorted(os.listdir(small)) == ['rest', 'run' + ending]
        os.remove(name)


def killed(write, seconds):
    """A process that writes on and on, and is ended after this time."""
    writer = os.fork()
    if writer == 0:
        while True:
            write()
    time.sleep(seconds)
    os.kill(writer, signal.SIGKILL)
    os.waitpid(writer, 0)


def test_aKilledWriterLeavesAWholeFile(folder):
    name, solver, draw = folder + '/run.vtu', impact(), random.Random(1)
    yadefrag.exportVTK(solver, name)
    whole = Path(name).read_bytes()
    for _ in range(20):
        killed(lambda: yadefrag.exportVTK(solver, name), draw.uniform(.002, .05))
        assert Path(name).read_bytes() == whole


@pytest.mark.parametrize('where', [*kNowhere, kFolder])
def test_anUnwritablePathIsNamedBeforeARun(where, folder, monkeypatch):
    monkeypatch.setattr(tradeoff_grid, '_runAll', lambda *_: pytest.fail('it has run'))
    Path(folder, 'file').touch()
    for ending, write in [*writers(impact()).items(), ('.csv', lambda f: traded(files=f[:-4])),
                          ('.csv', lambda f: yadefrag.FERecorder(5, f[:-4]))]:
        name = where.format(folder=folder) + ending
        if where == kFolder:
            os.makedirs(name, exist_ok=True)
        with pytest.raises(IsADirectoryError if where == kFolder else OSError) as error:
            write(name)
        assert error.value.filename == name and O.iter == 0
        assert where != kFolder or os.listdir(name) == []


def test_aDeviceStaysOne():
    with pytest.raises(OSError, match='No space left'):
        files.writeText('/dev/full', 'x')
    files.writeText('/dev/null', 'x')
    for device in ('/dev/full', '/dev/null'):
        assert stat.S_ISCHR(os.stat(device).st_mode)
        files.requireWritable(device)


@pytest.mark.parametrize('ending', ['.csv', '.yade.gz'])
def test_aLinkStaysOneAndAModeToo(ending, folder):
    """Of a table, and of YADE's own save, whose file is that of its name."""
    real, link = folder + '/real' + ending, folder + '/link' + ending
    Path(real).touch()
    os.chmod(real, 0o640)
    os.symlink(real, link)
    aSphere(anew=True)
    aSphere()
    (table().csv if ending == '.csv' else O.save)(link)
    assert os.path.islink(link) and os.path.getsize(real) > 0 and sorted(os.listdir(folder)) == ['link' + ending, 'real' + ending]
    assert stat.S_IMODE(os.stat(real).st_mode) == 0o640
    if ending == '.csv':
        assert len(yadefrag.TradeoffTable.read(link).rows) == 3
    else:
        aSphere()
        O.reload()
        assert O.filename == link and len(O.bodies) == 2


def test_noLinkOfATemporaryNameIsFollowed(folder, monkeypatch):
    """Not even one whose name was guessed."""
    victim, name = folder + '/victim', folder + '/t.csv'
    Path(victim).write_text('kept')
    drawn = ['a' * 16, 'b' * 16]
    monkeypatch.setattr(files.secrets, 'token_hex', lambda count: drawn.pop(0))
    os.symlink(victim, folder + '/.%s.part.t.csv' % drawn[0])
    table().csv(name)
    assert drawn == [] and len(yadefrag.TradeoffTable.read(name).rows) == 3
    assert Path(victim).read_text() == 'kept'
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
    text = Path(name).read_text()
    assert text.endswith('\n') and len({line.count(',') for line in text.splitlines()}) == 1
    yadefrag.plotFracture(name)


def test_tradeoffReturnsItsTableFromAFullDisk(small, monkeypatch):
    """It was writable before, and is full after the runs."""
    monkeypatch.setattr(tradeoff_grid, '_runAll', lambda *_: fill(small + '/rest', 8192))
    with pytest.warns(UserWarning, match='the table could not be written: .*No space left'):
        assert len(traded(files=small + '/t').rows) == 1


# --- files that are read

@pytest.mark.parametrize('text', ['', '\n', 'step\n', 'a,b\n1,2\n', '\ufeff', '\xff\xfe'])
def test_aFileOfOtherColumnsIsNoRecord(text, folder):
    name = folder + '/run.csv'
    Path(name).write_text(text, encoding='latin-1' if text == '\xff\xfe' else 'utf-8')
    with pytest.raises(ValueError, match='run.csv has no lines of recordFracture'):
        yadefrag.plotFracture(name)
    with pytest.raises(ValueError, match='is without the columns'):
        yadefrag.TradeoffTable.read(name)


def test_damagedRecordsAndTablesAreRefused(folder):
    name = folder + '/run.csv'
    for write, read, damage, words in (
            (lambda: yadefrag.recordFracture(impact(), name), yadefrag.plotFracture,
             lambda good: (good.replace('0.0', 'x'), good.splitlines()[0] + '\n'),
             'no lines of recordFracture|damaged one'),
            (lambda: table().csv(name), yadefrag.TradeoffTable.read,
             lambda good: (good.replace('[1]', '[[1]]'), good.replace('ok,0,9,1', 'ok,0,9,fast')), 'has a damaged row')):
        write()
        good = Path(name).read_text()
        for bad in (good + '1,2,3\n', *damage(good)):
            assert bad != good
            Path(name).write_text(bad)
            with pytest.raises(ValueError, match=words):
                read(name)


def test_aByteOrderMarkIsSkipped(folder):
    Path(folder, 'plate').write_text('0 0\n1 0\n1 1\n')
    table().csv(folder + '/t.csv')
    yadefrag.recordFracture(impact(), folder + '/r.csv')
    for path in Path(folder).iterdir():
        path.write_bytes('\ufeff'.encode() + path.read_bytes())
    assert yadefrag.readPolygon(folder + '/plate') == ([(0, 0), (1, 0), (1, 1)], [])
    assert len(yadefrag.TradeoffTable.read(folder + '/t.csv').rows) == 3
    yadefrag.plotFracture(folder + '/r.csv')


# --- YADE's own save

def aSphere(anew=False):
    if anew:
        O.reset()
    O.bodies.append(utils.sphere((0, 0, 0), 1))


@pytest.mark.parametrize('ending', ['.yade', '.xml', '.yade.gz', '.yade.bz2', '.xml.gz', '.xml.bz2'])
@pytest.mark.parametrize('where', ['/nowhere/x', '/proc/x', '{folder}/file/x', '{folder}/deep'])
def test_aSceneThatCannotBeSavedIsReportedFirst(where, ending, folder):
    """YADE alone never ends for compressed files, and does not tell for others of a small scene."""
    aSphere(anew=True)
    Path(folder, 'file').touch()
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
    aSphere(anew=True)
    Path(small + '/x.yade').write_text('what was there')
    fill(small + '/rest', 8192)
    for ending in ('.yade', '.yade.gz', '.xml.bz2'):
        with pytest.raises(RuntimeError, match='could not be saved: its file cannot be opened or the disk is full'):
            O.save(small + '/x' + ending)
    fill(small + '/rest', 4096)
    O.bodies.append([utils.sphere((i, 0, 0), 1) for i in range(20)])  # of 5 KB, for which YADE raises nothing
    with pytest.raises(RuntimeError, match='could not be saved: its file cannot be opened or the disk is full'):
        O.save(small + '/x.yade')
    assert Path(small + '/x.yade').read_text() == 'what was there' and sorted(os.listdir(small)) == ['rest', 'x.yade']


def test_aSaveThatIsKilledLeavesTheOldFile(folder):
    """Under its name, or beside the new one."""
    O.reset()
    O.bodies.append([utils.sphere((i, 0, 0), 1) for i in range(1500)])
    name = folder + '/x.xml.gz'
    O.save(name)
    for moment in range(8):
        killed(lambda: O.save(name, quiet=True), .03 + .017 * moment)
        for part in Path(folder).glob('.*.part.x.xml.gz'):
            os.replace(part, name) if part.stat().st_size else part.unlink()
        O.load(name, quiet=True)
        assert len(O.bodies) == 1500
