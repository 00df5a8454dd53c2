"""tradeoff(): grids of short runs, each in a yade of its own; the table, its front, its files."""
import importlib
import os
import random
import types
from pathlib import Path

import numpy as np
import pytest

import study_scenes as scenes
from project import inYade, ROOT
from yadefrag import TradeoffTable
from yadefrag.studies import tradeoff_grid as tool
from yadefrag.studies import run_process, scene_choices
from yadefrag.studies.tradeoff_table import TradeoffRow

kDuration = .05  # s


def trade(scene, vary, measure=scenes.way, **more):
    return tool.tradeoff(scene, vary, measure, **dict(dict(duration=kDuration, repeats=1), **more))


def rows(*points, **more):
    """Rows of a table from (wall, error)."""
    return [TradeoffRow(dict(k=k), 'ok', error, 10, wall, cpu=wall / 2, error=error, walls=[wall], cpus=[wall / 2], **more)
            for k, (wall, error) in enumerate(points)]


def test_errorsAndTimes():
    table = trade(scenes.block, [{}, {'timeStep': [.4]}], reference=scenes.SPEED * kDuration)
    coarse, fine = table.rows
    assert [row.result for row in table.rows] == ['ok', 'ok'] and fine.steps >= 2 * coarse.steps
    for row in table.rows:
        assert row.error == pytest.approx(abs(row.value / (scenes.SPEED * kDuration) - 1))
        # No more than half a step is missing.
        assert row.error <= .5 / row.steps * 1.2
        assert row.wall > 0 and row.cpu > 0 and row.walls == [row.wall]
    assert coarse.settings['timeStep'] == .8 and coarse.settings['collider'] == 'LebesgueCollider'
    assert table.label(coarse) == 'row 1' and table.label(fine) == 'timeStep=0.4'


def test_knownChoicesComeThrough():
    chosen = dict(passes=2, contactTolerance='fine', halo=.25, bulkViscosity=.5, plane='stress',
                  collider='none', size=.5, threads=2 if os.cpu_count() > 1 else 1, timeStep=.5)
    table = trade(scenes.block, {name: [value] for name, value in chosen.items()}, scenes.whole)
    row, = table.rows
    assert row.result == 'ok', row.message
    assert row.value == [2, 1e-4, .25, .03, .6, 1, chosen['threads'], 2, 8]
    assert {**row.settings, **chosen} == row.settings


@pytest.mark.long
def test_fractureByName():
    table = trade(scenes.brittle, {'fracture': ['none', 'instant', 'cohesive']}, scenes.kind)
    assert [row.value for row in table.rows] == [0, 1, 2]
    table = trade(scenes.brittle, {'fracture': ['cohesive'], 'energy': [0]}, scenes.kind)
    assert table.rows[0].result == 'refused' and 'no fractureEnergy' in table.rows[0].message


def test_colliderAndItsDistance():
    chosen = {'collider': ['InsertionSortCollider'], 'verletDist': [.02, -.2]}
    table = trade(scenes.spheres, chosen, scenes.place)
    # It bounces between the two at 1e-3 m.
    assert all(row.result == 'ok' and .94 < row.value < 1.01 for row in table.rows)
    assert table.label(table.rows[1]) == 'verletDist=-0.2'


@pytest.mark.long
def test_watched():
    table = trade(scenes.block, {'timeStep': [.1]}, scenes.seen, watch=scenes.way)
    row, = table.rows
    assert row.value == [row.steps, pytest.approx(scenes.SPEED * kDuration, rel=.5 / row.steps)]
    table = trade(scenes.block, {'timeStep': [.1]}, scenes.seen, watch=scenes.way, every=kDuration / 4)
    assert table.rows[0].value[0] == 4


def test_blowUpIsARow():
    table = trade(scenes.spheres, {'young': [1e6, 1e10]}, scenes.place, reference=.97)
    good, bad = table.rows
    assert good.result == 'ok' and good.error < .05
    assert bad.result == 'blew up' and 'of its radii in one step' in bad.message
    assert bad.wall is None and bad.error is None and bad not in table.front()
    assert '| blew up: body 2 moves by' in table.markdown()


def test_energyOutOfNothingIsABlowUp():
    from yadefrag.studies import run_in_yade

    class FESolver:
        pass

    class Scene:
        engines, bodies, dt = [FESolver()], [], 1

    def balance(values):
        return types.SimpleNamespace(**dict(zip(('excess', 'most', 'rounding'), values)))

    for values in ((.9, 1., 0.), (6e-20, 0., 1e-18)):
        FESolver._energyBalance = balance(values)
        run_in_yade.requireSane(Scene)
    for values, sentence in (((1.1, 1., 0.), 'grew by 1.1 J'), ((float('nan'), 1., 0.), 'nan J'),
                             ((1e-3, 0., 1e-18), 'the bodies had 0 J')):
        FESolver._energyBalance = balance(values)
        with pytest.raises(run_in_yade.BlewUp, match=sentence):
            run_in_yade.requireSane(Scene)


def test_aSceneAtRestDoesNotBlowUp():
    row, = trade(scenes.rest, {'timeStep': [.8]}, scenes.place0).rows
    assert row.result == 'ok', row.message


def test_refusedRows():
    table = trade(scenes.block, [{'timeStep': [1.5]}, {'nonsense': [1]}])
    assert [row.result for row in table.rows] == ['refused', 'refused']
    assert 'at most' in table.rows[0].message and 'critical step' in table.rows[0].message
    assert table.rows[1].message == "the scene never used the choice 'nonsense'."
    short, = trade(scenes.block, {}, duration=1e-12).rows
    assert short.result == 'refused' and 'at most half of the scene\'s step' in short.message


@pytest.mark.parametrize('fault, result, sentence', [
    ('sentence', 'refused', 'this choice makes no sense.'),
    ('step', 'refused', 'O.dt is 0'),
    ('bug', 'failed', "NameError: name 'nowhere' is not defined"),
    ('crash', 'failed', 'yade ended with status -6'),
    ('nan', 'blew up', 'the measured value is not finite.'),
    ('sleep', 'too long', 'no result within 3 s.'),
])
def test_faultsAreRows(fault, result, sentence):
    table = trade(scenes.odd, {'fault': [fault]}, scenes.oddWay, repeats=2, limit=3. if fault == 'sleep' else 60.)
    assert table.rows[0].result == result and sentence in table.rows[0].message
    assert table.front() == []


@pytest.mark.long
def test_againstAReferenceThatIsRun(folder):
    finest = trade(scenes.block, {'timeStep': [.8, .4]}, reference='finest')
    assert finest.reference is finest.rows[1] and finest.rows[1].error == 0
    assert finest.front() == [finest.rows[0]]
    added = trade(scenes.block, {'timeStep': [.8]}, reference={'timeStep': .4})
    assert len(added.rows) == 2 and added.reference is added.rows[1]
    assert added.rows[0].error == pytest.approx(finest.rows[0].error)


def test_againstNumbersAndFiles(folder):
    file = os.path.join(folder, 'right.txt')
    np.savetxt(file, [3., 4.])
    row = TradeoffRow({}, 'ok', [3., 5.], wall=1., cpu=1.)
    short = TradeoffRow({'a': 1}, 'ok', [3.], wall=1., cpu=1.)
    tool._setErrors(TradeoffTable([row, short]), tool._reference(file), [{}, {'a': 1}])
    assert row.error == pytest.approx(.2)
    assert short.error is None
    assert short.message == 'measured are 1 numbers, the reference has 2.'
    tool._setErrors(TradeoffTable([row]), tool._reference([0., 0.]), [{}])
    assert row.error == pytest.approx(np.sqrt((9 + 25) / 2))
    # A reference without a value.
    good, bad = TradeoffRow({}, 'ok', 1., wall=1., cpu=1.), TradeoffRow({'a': 1}, 'refused')
    tool._setErrors(TradeoffTable([good, bad]), {'a': 1}, [{}, {'a': 1}])
    assert good.error is None and good.message == 'the reference (a=1) has no value.'


@pytest.mark.parametrize('seed', range(20))
def test_frontByBruteForce(seed):
    draw = random.Random(seed)
    table = TradeoffTable(rows(*((draw.randint(1, 9), draw.randint(0, 9)) for _ in range(25))))
    table.rows[3].error = None

    def beats(a, b):
        return a.wall <= b.wall and a.error <= b.error and (a.wall, a.error) != (b.wall, b.error)

    good = [row for row in table.rows if row.error is not None]
    expected = [row for row in good if not any(beats(other, row) for other in good)]
    front = table.front()
    assert sorted(row.settings['k'] for row in front) == [row.settings['k'] for row in expected]
    assert [row.wall for row in front] == sorted(row.wall for row in front)
    table.references = [front[0]]
    assert front[0] not in table.front()


def test_csvComesBack(folder):
    file = os.path.join(folder, 'a.csv')
    table = TradeoffTable(rows((1.5, .1), (2., 1 / 3)) + [
        TradeoffRow({'k': True, 'name': 'a, "b"\n|1', 'text': '1'}, 'refused', message='"no", so.'),
        TradeoffRow({'k': '', 'name': 'NaN', 'text': 'true'}, 'ok', [1., 2.], 7, 1e-300, cpu=2., error=3., walls=[1.],
                    cpus=[2.])])
    table.csv(file)
    assert TradeoffTable.read(file).rows == table.rows
    assert TradeoffTable.read(kExamples / 'bars.csv').front()  # an older file, without seconds and warnings


def test_markdown(folder):
    table = TradeoffTable(rows((2., .5), (1., .5), (4., .25)), 'Title')
    table.rows[2].seconds = .3
    table.rows.append(TradeoffRow({'k': 'a|b'}, 'too long', message='no result within 3 s.'))
    text = table.markdown(os.path.join(folder, 'a.md'))
    assert Path(folder, 'a.md').read_text() == text
    lines = text.splitlines()
    assert lines[0] == '# Title' and lines[8:] == [
        '| 1 | row 1 |  | 2 | 1 | 1.00 | 10 | 0.5 |', '| 2 | **k=1** |  | 1 | 0.5 | 0.50 | 10 | 0.5 |',
        '| 3 | **k=2** | 0.3 | 4 | 2 | 2.00 | 10 | 0.25 |',
        '| 4 | k=a\\|b |  |  |  |  |  | too long: no result within 3 s. |']


def test_problemsHaveTheirOwnReferenceAndFront():
    """Two rates, two sizes, two seeds: the finest of each rate and seed is the reference for the other one."""
    settings = [dict(rate=rate, size=size, seed=seed) for rate in (1, 2) for size in (.2, .1) for seed in (0, 1)]
    found = [TradeoffRow(dict(of), 'ok', 100. * of['rate'] + 10 * of['size'] + of['seed'], 10, .1 / of['size'], cpu=1.,
                         walls=[1.], cpus=[1.]) for of in settings]
    table = TradeoffTable(found, by='rate')
    tool._setErrors(table, 'finest', settings)
    assert all(row.error == 0 for row in table.references) and len(table.references) == 4
    coarse = [row for row in found if row.settings['size'] == .2]
    assert [row.error for row in coarse] == pytest.approx([1 / 101, 1 / 102, 1 / 201, 1 / 202])
    assert table.front() == coarse
    means = table.means()
    assert [(row.settings, row.message) for row in means.rows][1] == (dict(rate=1, size=.1), '2 of 2 seeds')
    assert means.rows[0].error == pytest.approx((1 / 101 + 1 / 102) / 2)
    assert '| rate=1, size=0.2 | 2 of 2 seeds | 0.5 | 0.00985 |' in table.markdown()
    assert tool._withReferences(settings[:4], dict(size=.05), ('rate',))[4:] == [
        dict(rate=1, seed=0, size=.05), dict(rate=1, seed=1, size=.05)]


def test_files(folder):
    table = TradeoffTable(rows((2., .5), (1., 0.), (4., .25)), 'Title')
    table.write(os.path.join(folder, 'a'))
    assert sorted(os.listdir(folder)) == ['a.csv', 'a.md', 'a.png']
    assert os.path.getsize(os.path.join(folder, 'a.png')) > 5000
    axes = table.plot(time='cpu')
    # An error of 0 is drawn below all others.
    points = sorted(line.get_xydata()[0].tolist() for line in axes.lines[1:])
    assert points == [[.5, pytest.approx(.025)], [1., .5], [2., .25]]
    with pytest.raises(ValueError, match='no row of the table has an error'):
        TradeoffTable([TradeoffRow({})]).plot()
    with pytest.raises(ValueError, match="time is 'clock'"):
        table.front('clock')


def faked(monkeypatch, results):
    """Runs give one after the other of the results, and are remembered."""
    asked = []

    def runOne(job, *_):
        asked.append(job['settings'])
        result = results[len(asked) - 1]
        if isinstance(result, BaseException):
            raise result
        return result

    monkeypatch.setattr(run_process, 'perform', runOne)
    return asked


def ok(wall, value=1.):
    return dict(result='ok', message='', wall=wall, cpu=wall, seconds=wall, steps=1, value=value, used={})


def test_mediansAndRatios(monkeypatch):
    walls = [4, 12, 8, 16, 2, 10]
    asked = faked(monkeypatch, [ok(wall) for wall in walls])
    table = trade(scenes.block, {'passes': [1, 2]}, repeats=3)
    assert [s['passes'] for s in asked] == [1, 2] * 3
    assert [row.wall for row in table.rows] == [4, 12]
    assert table.rows[0].walls == walls[::2] and table.ratio(table.rows[1]) == 3


def test_gridsOfSeveralDicts():
    assert tool._grid([{}, {'passes': [1, 2], 'own': ['a']}, {'passes': [2], 'own': ['a']}]) == [
        {}, dict(passes=1, own='a'), dict(passes=2, own='a')]
    grid = tool._grid({'passes': np.arange(1, 3), 'size': np.array([.5])})
    assert [type(v) for setting in grid for v in setting.values()] == [int, float] * 2


def test_whatIsRefusedIsNotRepeated(monkeypatch):
    refused = dict(result='refused', message='no.', used={'size': 1.})
    asked = faked(monkeypatch, [ok(4), refused, ok(5)])
    table = trade(scenes.block, {'passes': [1, 2]}, repeats=2)
    assert [s['passes'] for s in asked] == [1, 2, 1]
    assert table.rows[1].settings == dict(passes=2, size=1.) and table.rows[1].walls == []


def test_interruptedTableHasWhatWasDone(monkeypatch, capsys):
    faked(monkeypatch, [ok(4), KeyboardInterrupt()])
    table = trade(scenes.block, {'passes': [1, 2]}, repeats=2)
    assert [row.result for row in table.rows] == ['ok', 'not run']
    assert 'Stopped after 1 of 4 runs.' in capsys.readouterr().err


def test_everyKnownNameRefusesSomething():
    for name, (isRight, right) in scene_choices.KNOWN.items():
        for wrong in (None, [], 'x', object(), float('nan')):
            assert not isRight(wrong), (name, wrong)
        assert right


kExamples = ROOT / 'examples' / 'tradeoff'


@pytest.mark.parametrize('name, size, most', [
    ('bars', 2e-3, .08), ('hertz', 2e-3, .06), ('rolling', 2e-3, .03), ('ring', 2e-4, .3),
    ('compressed_rock', 2.5e-3, .1)])
@pytest.mark.long
def test_problemsOfTheBenchmark(monkeypatch, name, size, most):
    monkeypatch.syspath_prepend(str(kExamples))
    problem = importlib.import_module(name)
    assert tool._grid(problem.VARY)[0] == {}
    arguments = dict(problem.ARGUMENTS, repeats=1)
    table = tool.tradeoff(problem.scene, {'size': [size]}, problem.measure, **arguments)
    assert table.rows[0].result == 'ok', table.rows[0].message
    assert table.rows[0].error < most


def test_benchmarkRefusesUnknownProblems():
    done = inYade(kExamples / 'tradeoff.py', '--problems', 'bars,stairs', timeout=120)
    assert done.returncode == 2 and "'stairs' is not one of bars, hertz" in done.stdout


kScript = '''
from yadefrag import *
def scene(choices):
    O.engines, O.dt = [NewtonIntegrator()], .125
def measure(_):
    return O.time
%s
    print('@@@', [row.value for row in tradeoff(scene, {}, measure, duration=1., repeats=1).rows])
'''


@pytest.mark.parametrize('guard', [True, False])
@pytest.mark.long
def test_inAScript(folder, guard):
    file = Path(folder, 'script.py')
    file.write_text(kScript % ("if __name__ == '__main__':" if guard else 'if True:'))
    done = inYade(file, timeout=120)
    if guard:
        assert '@@@ [1.0]' in done.stdout, done.stdout
    else:
        assert 'cannot load the scene' in done.stdout and 'put the call after' in done.stdout
