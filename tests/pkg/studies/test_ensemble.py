"""ensemble(): many runs in processes, by MPI and by Dask; what fails, what goes on; the statistics. scripts/yade-batch:
jobs of a table find the plugin, whatever folder they are started from."""
import concurrent.futures
import json
import math
import os
import subprocess
import types
from pathlib import Path

import numpy as np
import pytest

import study_scenes as scenes
import project
import yadefrag
from project import inYade, ROOT
from yadefrag import EnsembleTable
from yadefrag.studies import ensemble_runs as tool
from yadefrag.studies import run_in_yade, runs
from yadefrag.studies.ensemble_table import EnsembleRow

kBatch = str(ROOT / 'scripts' / 'yade-batch')
kBatchScript = '''
from yade import utils
utils.readParamsFromTable(speed=1., noTableOk=False)
from yade.params.table import speed
import yadefrag
from yade.wrapper import FESolver
O.materials.append(FEMat(young=1e7, poisson=.3, density=1000, label='m'))
fe = FESolver()
fe.addPolygon([(0, 0), (1, 0), (1, 1), (0, 1)], size=.5, material='m', velocity=(speed, 0))
O.engines = yadefrag.engines(fe)
O.dt = .5 * fe.criticalTimeStep()
start = fe.nodes[:, 0].mean()
O.run(20, True)
with open('%g.txt' % speed, 'w') as out:
    out.write(repr(float((fe.nodes[:, 0].mean() - start) / (speed * 20 * O.dt))))
'''


def withoutPath():
    return {k: v for k, v in os.environ.items() if k != 'PYTHONPATH'}


def together(scene, wanted, measure=scenes.draw, **more):
    return tool.ensemble(scene, wanted, measure, **{**dict(duration=scenes.DURATION, workers=2), **more})


def drawn(seed, strength=5.):
    return scenes.draw((None, seed, strength))


# --- runs

def test_runsOfSeedsAndTables(folder):
    table = together(scenes.flight, 3, files=folder + '/a', title='Draws')
    assert [row.settings for row in table.rows] == [dict(seed=k) for k in range(3)]
    assert [row.value for row in table.rows] == [drawn(k) for k in range(3)]
    assert all(row.result == 'ok' and row.steps > 0 and row.wall > 0 for row in table.rows)
    assert sorted(os.listdir(folder)) == ['a.csv', 'a.png']
    lines = Path(folder, 'a.csv').read_text().splitlines()
    assert lines[0] == 'seed,result,value,steps,wall,message,seconds,warnings'
    assert lines[1].startswith('0,ok,"[%r' % drawn(0)[0])
    assert str(table).splitlines()[:3] == ['Draws'] + [
        'seed=%d: %.6g on average of %d; %.3g s, %.4g s per simulated second' % (
            k, np.mean(drawn(k)), len(drawn(k)), table.rows[k].seconds, table.rows[k].wall) for k in range(2)]
    assert all(row.seconds == pytest.approx(row.wall * scenes.DURATION, rel=.5) for row in table.rows)
    for wanted in (dict(seed=[7, 8], strength=np.array([1., 2.])),
                   [dict(seed=7, strength=1.), dict(seed=8, strength=2.)]):
        values = [row.value for row in together(scenes.flight, wanted).rows]
        assert values == [drawn(7, 1.), drawn(8, 2.)]


@pytest.mark.long
def test_whatFailsIsARow():
    found = together(scenes.oddSeed, range(5), scenes.seedValue, limit=8.).rows
    assert [row.result for row in found] == ['ok', 'failed', 'refused', 'too long', 'blew up']
    words = ('', 'yade ended with status -6', 'this choice makes no sense.', 'no result within 8 s.', 'not finite')
    assert all(word in row.message for word, row in zip(words, found))
    assert [row.value for row in found] == [0, None, None, None, None]
    table = EnsembleTable(found)
    assert str(table).splitlines()[0].startswith('seed=0: 0')  # and its time, if the machine is slow
    assert str(table).splitlines()[2] == 'seed=2: refused, this choice makes no sense.'
    assert str(table).splitlines()[-1] == 'Mean of 1 run: 0; 4 have no value.'
    line, = table.statistics()
    assert line['runs'] == 1 and line['failed'] == 4 and math.isnan(line['low'])


def ended(how):
    future = concurrent.futures.Future()
    how(future)
    return future


def test_goesOnWhereItStopped(folder, monkeypatch):
    """The third run is interrupted; later runs do what is missing, and no run twice."""
    monkeypatch.setenv('YADEFRAG_COUNT', folder + '/count')
    file = folder + '/done.jsonl'

    class Impatient:
        """Does two runs, then Ctrl-C."""
        left = 2

        def submit(self, function, *args):
            if not self.left:
                raise KeyboardInterrupt
            self.left -= 1
            return ended(lambda future: future.set_result(function(*args)))

    # What is submitted but not taken counts as not done: runs are taken after the last is submitted.
    first = together(scenes.counted, [0, 1], scenes.same, resume=file, executor=Impatient())
    assert [row.result for row in first.rows] == ['ok', 'ok']
    stopped = together(scenes.counted, [0, 1, 2], scenes.same, resume=file,
                       executor=type('None left', (Impatient,), dict(left=0))())
    assert [row.result for row in stopped.rows] == ['ok', 'ok', 'not run']
    with open(file, 'a') as out:
        out.write('{"of": {"setting"')  # a line that was cut
    last = together(scenes.counted, [0, 1, 2, 1], scenes.same, resume=file)
    assert [round(row.value) for row in last.rows] == [0, 1, 2, 1]
    assert sorted(Path(folder, 'count').read_text().split()) == ['0', '1', '1', '2']
    assert len(list(map(json.loads, Path(file).read_text().splitlines()))) == 5
    with pytest.raises(ValueError, match='done.jsonl has runs of another scene, file, duration'):
        together(scenes.counted, [0], scenes.same, resume=file, duration=1.)


def test_lostWorkersAreRowsThatAreDoneAgain(folder):
    broken = types.SimpleNamespace(submit=lambda *_: ended(lambda future: future.set_exception(OSError('the machine is gone'))))
    file = folder + '/done.jsonl'
    row, = together(scenes.flight, 1, resume=file, executor=broken).rows
    assert row.result == 'failed' and row.message == 'OSError: the machine is gone'
    row, = together(scenes.flight, 1, resume=file).rows
    assert row.result == 'ok'


@pytest.mark.long
def test_tradeoffByAnExecutorAndAgain(folder):
    file = folder + '/done.jsonl'
    arguments = dict(duration=.05, repeats=2, resume=file)
    vary = {'timeStep': [.8, .4], 'fault': ['none']}
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        first = yadefrag.tradeoff(scenes.odd, vary, scenes.oddWay, executor=executor, **arguments)
    assert [(row.result, len(row.walls)) for row in first.rows] == [('ok', 2)] * 2
    again = yadefrag.tradeoff(scenes.odd, vary, scenes.oddWay, **arguments)
    assert again.rows == first.rows  # to the last digit of the times: none was run


def test_fileThatHoldsNoRuns(folder):
    Path(folder, 'a.jsonl').write_text('nothing\n')
    with pytest.raises(ValueError, match='a.jsonl has no runs that can be continued'):
        together(scenes.flight, 1, resume=folder + '/a.jsonl')


kScript = '''
import os, sys
sys.path.insert(0, %r)
import study_scenes as scenes
import project
from yadefrag import ensemble
if __name__ == '__main__':
    %s
        slow = "__import__('time').sleep(.1) or __import__('os').getpid()"
        pids = [executor.submit(eval, slow, {}) for _ in range(20)]
        pids = {pid.result() for pid in pids}
        table = ensemble(scenes.oddSeed, [0, 1, 2, 5], scenes.seedValue, duration=scenes.DURATION, executor=executor)
    print('@@@', len(pids - {os.getpid()}), [(row.result, row.value) for row in table.rows])
'''
kMpi = '''from mpi4py.futures import MPIPoolExecutor
    with MPIPoolExecutor(max_workers=2, main=False) as executor:'''
kDask = '''from distributed import Client
    with Client(scheduler_file=%r, timeout=60) as client:
        executor = client.get_executor(pure=False)
        client.wait_for_workers(2)'''
kFound = "@@@ 2 [('ok', 0.0), ('failed', None), ('refused', None), ('ok', 5.0)]"


def byScript(folder, opening):
    file = Path(folder, 'script.py')
    file.write_text(kScript % (str(ROOT / 'tests' / 'pkg' / 'helpers'), opening))
    done = inYade(file, env=project.environment('ensemble'))
    assert kFound in done.stdout, done.stdout[-3000:]


@pytest.mark.long
def test_twoWorkersOfMpi(folder):
    byScript(folder, kMpi)


@pytest.mark.long
def test_twoWorkersOfDask(folder):
    file = os.path.join(folder, 'scheduler.json')
    # The workers are no yade, and have no plugin on their path.
    quiet = dict(stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=withoutPath(), cwd=folder)
    started = [subprocess.Popen(['/usr/bin/dask-scheduler', '--host', '127.0.0.1', '--port', '0',
                                 '--no-dashboard', '--scheduler-file', file], **quiet)]
    try:
        for number in range(2):
            started.append(subprocess.Popen(
                ['/usr/bin/dask-worker', '--scheduler-file', file, '--nthreads', '1', '--no-nanny',
                 '--no-dashboard', '--local-directory', folder + '/%d' % number], **quiet))
        byScript(folder, kDask % file)
    finally:
        for process in started:
            process.kill()      # Dask 2024.12 with Python 3.13 does not always end when it is asked to
        for process in started:
            process.wait()


# --- statistics

def table(values, **settings):
    return EnsembleTable([EnsembleRow(dict(seed=k, **{n: v[k] for n, v in settings.items()}), 'ok',
                                      value=value) for k, value in enumerate(values)])


def test_bandHoldsTheTruthWithItsProbability():
    """2000 ensembles of five normal runs: 90 % ± 2.5 % (3.7 standard deviations)."""
    draw = np.random.default_rng(3)
    bands = [table((3 + 2 * draw.standard_normal(5)).tolist()).statistics(confidence=.9)[0] for _ in range(2000)]
    share = np.mean([band['low'] < 3 < band['high'] for band in bands])
    assert share == pytest.approx(.9, abs=.025)


def test_statisticsByASetting(folder):
    rows = table([[1, 3], [4], [10], [20, 30]], strength=[2., 2., 1., 1.])
    rows.rows.append(EnsembleRow(dict(seed=9, strength=1.), 'failed', message='no.'))
    low, high = rows.statistics('strength')
    assert (low['by'], low['runs'], low['failed'], low['mean']) == (1, 2, 1, 17.5)
    assert (high['by'], high['runs'], high['failed'], high['mean']) == (2, 2, 0, 3)
    assert high['high'] - 3 == pytest.approx(12.7062 * math.sqrt(2) / math.sqrt(2), rel=1e-4)
    assert rows.statistics('strength', reduce=len)['mean'].tolist() == [1.5, 1.5]
    with pytest.raises(ValueError, match="by is 'size', it must be the name of a setting"):
        rows.statistics('size')
    with pytest.raises(ValueError, match='confidence is 1, it must be above 0 and below 1'):
        rows.statistics(confidence=1)
    ax = rows.plot(folder + '/shares.png', label='size (m)')
    assert ax.get_xlabel() == 'size (m)' and ax.get_xscale() == 'log' and len(ax.lines) == 6
    # A mean for each strength.
    assert [line.get_label() for line in (ax.lines[2], ax.lines[5])] == [
        'strength=2: mean of 2 runs', 'strength=1: mean of 2 runs']
    ax = rows.plot(folder + '/by.png', by='strength')
    assert ax.lines[-1].get_xydata().tolist() == [[1, 17.5], [2, 3]]
    assert ax.lines[-1].get_label() == 'mean of 2 runs'  # of four, at two strengths
    assert all(os.path.getsize(folder + name) > 5000 for name in ('/shares.png', '/by.png'))


def test_sharesAtLeastAsLarge():
    """Of exponential numbers exp(-x) are above x; the band of 40 runs holds it nearly everywhere."""
    draw = np.random.default_rng(1)
    rows = table([draw.exponential(size=50).tolist() for _ in range(40)])
    curve = rows.shares(np.linspace(.05, 2.5, 50))
    right = np.exp(-curve['place'])
    assert abs(curve['mean'] - right).max() < .03
    assert ((curve['low'] < right) & (right < curve['high'])).mean() > .8
    exact = table([[1, 2, 2, 4], [3]]).shares([1, 2, 2.5, 4.5])
    assert exact['mean'].tolist() == [1, .875, .625, 0]
    with pytest.raises(ValueError, match='no run has a value'):
        EnsembleTable([]).shares()


def test_meansAreOfRunsThatDifferInSeedsOnly():
    settings = [dict(rate=rate, size=size, seed=seed) for rate in (1, 2) for size in (.1, .2) for seed in range(2)]
    rows = [EnsembleRow(of, 'ok', 100. * of['rate'] + of['size'] + of['seed']) for of in settings]
    eight = EnsembleTable(rows)
    found = eight.statistics()
    assert found['settings'].tolist() == ['rate=%d, size=%g' % one for one in ((1, .1), (1, .2), (2, .1), (2, .2))]
    assert found['runs'].tolist() == [2] * 4 and np.isnan(found['by']).all()
    assert found['mean'] == pytest.approx([100.6, 100.7, 200.6, 200.7])
    # Over one setting: the other is not mixed.
    assert eight.statistics('rate')['settings'].tolist() == ['size=0.1, rate=1', 'size=0.2, rate=1',
                                                             'size=0.1, rate=2', 'size=0.2, rate=2']
    text = str(EnsembleTable(rows[:2] + rows[4:6])).splitlines()
    assert text[4].startswith('rate=1: Mean of 2 runs: 100.6, with') and text[5].startswith('rate=2: Mean of 2 runs')
    assert EnsembleTable(rows[:2] + rows[4:6]).statistics()['by'].tolist() == [1, 2]
    # Another number in each run is a sample: one mean, which says so.
    drawn = [EnsembleRow(dict(strength=1. + k, seed=k), 'ok', 1.) for k in range(8)]
    assert len(EnsembleTable(drawn).statistics()) == 1
    assert str(EnsembleTable(drawn)).splitlines()[-1].startswith('Mean of 8 runs, each with another strength: 1')
    # Kinds are none, also where each is run once.
    kinds = [EnsembleRow(dict(kind=kind), 'ok', 1.) for kind in 'ab']
    assert len(EnsembleTable(kinds).statistics()) == 2


def test_severalQuantitiesHaveAMeanEach(tmp_path):
    """Forces and numbers of cracks are not averaged together."""
    table = EnsembleTable([EnsembleRow(dict(seed=i), 'ok', dict(force=100. + i, cracks=i, sizes=[1., 2])) for i in range(3)])
    assert table.quantities() == ['force', 'cracks', 'sizes']
    assert table.of('force').statistics()['mean'] == [101] and table.of('cracks').statistics()['mean'] == [1]
    lines = str(table).split('\n')
    assert lines[0].endswith('force 100, cracks 0, sizes 1.5 on average of 2')
    assert lines[3].startswith('force: Mean of 3 runs: 101,') and lines[4].startswith('cracks: Mean of 3 runs: 1,')
    for call in table.statistics, table.shares, table.plot:
        with pytest.raises(ValueError, match=r"several quantities, force, cracks, sizes: table.of\('force'\) is"):
            call()
    with pytest.raises(ValueError, match="quantity is 'mass', it must be one of 'force', 'cracks', 'sizes'"):
        table.of('mass')
    table.write(str(tmp_path / 'a'))
    assert (tmp_path / 'a.png').exists() and '"force": 100.0' in (tmp_path / 'a.csv').read_text().replace('""', '"')


@pytest.mark.parametrize('measure, value', [
    (lambda built: (2, 3.), {'value 0': 2., 'value 1': 3.}), (lambda built: [2, 3.], [2., 3.]),
    (lambda built: dict(force=2, sizes=[1, 2]), dict(force=2., sizes=[1., 2.])), (lambda built: 4, 4.)])
def test_tuplesAndDictsAreSeveralQuantities(measure, value):
    assert run_in_yade.measured(measure, None, None, [], True) == value


def test_warningsOfRunsArePassedOn(capsys):
    with pytest.warns(UserWarning) as caught:
        found = together(scenes.warned, 3, scenes.seedValue).rows
    assert [row.warnings for row in found] == [['no such size, 0', 'bodies lie'], ['no such size, 1', 'bodies lie'],
                                               ['bodies lie']]
    said = [str(one.message) for one in caught]
    assert said == ['ensemble: %s The others are in `warnings` of the rows.' % one for one in (
        '2 of 3 runs gave this message, some with other numbers: "no such size, 0"',
        '3 of 3 runs gave this message: "bodies lie"')]
    assert all(one.filename == tool.__file__ or one.filename == __file__ for one in caught)


def test_namesOfMpiDoNotReachTheRuns(monkeypatch):
    monkeypatch.setenv('OMPI_COMM_WORLD_SIZE', '3')
    environment = runs.run_process._environment(dict(package='/p', inside='X'))
    assert 'OMPI_COMM_WORLD_SIZE' not in environment and environment['X'] == '1'
    assert environment['PYTHONPATH'].split(':')[0] == '/p'


def test_jobsOfATableFindThePlugin(folder):
    folder = Path(folder)
    (folder / 'scene.py').write_text(kBatchScript)
    (folder / 'table.txt').write_text('speed\n1.5\n-3\n')
    done = project.ran(kBatch, '-j1', '--disable-pynotify', '--plot-update=0', 'table.txt', 'scene.py', cwd=folder,
                       env=withoutPath(), timeout=300)
    logs = [log.read_text()[-800:] for log in folder.glob('*.log')]
    assert done.returncode == 0, done.stdout + done.stderr + '\n'.join(logs)
    assert [float((folder / name).read_text()) for name in ('1.5.txt', '-3.txt')] == pytest.approx([1, 1], abs=1e-12)


def test_batchRequiresOnlyWhatExists(folder):
    """A script that is not there is yade-batch's own complaint, not ours."""
    done = project.ran(kBatch, '--version', cwd=folder, timeout=60)
    assert done.returncode == 0 and 'Yade version' in done.stdout
