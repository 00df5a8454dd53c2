"""scripts/bench codes: LAMMPS, LIGGGHTS and YADE with our engines compute the same motion from the same scene."""
import sys

import pytest

from project import ROOT

# Last: its modules have names that other folders have, too.
sys.path.append(str(ROOT / 'tests' / 'benchmark'))
import codes  # noqa: E402

kSteps = 30


@pytest.fixture(scope='module')
def rows(tmp_path_factory):
    """Rows of 500 spheres without friction, where only the order of summation differs."""
    options = codes.parse(['--scenes', 'packing,stirred', '--sizes', '500', '--codes', 'loop,LIGGGHTS,LAMMPS',
                           '--friction', '0', '--warm', '5', '--steps', str(kSteps), '--repeat', '1'])
    options.codes = codes.installed(options.codes)
    return options, codes.measured(options, lambda text: None)


def test_positionsAreThose(rows):
    options, found = rows
    assert [(row['scene'], row['code']) for row in found] == [
        (scene, name) for scene in ('packing', 'stirred') for name in options.codes]
    assert max(row['deviation'] for row in found) < 1e-9


def test_partsAreNoMoreThanTheStep(rows):
    for row in rows[1]:
        assert 0 <= row['search'] and 0 < row['forces'] and 0 < row['integration']
        assert row['search'] + row['forces'] + row['integration'] < 1.02 * row['step']


def test_tableAndPlot(rows, tmp_path):
    options, found = rows
    medians = codes.summary(found)
    table = codes.rows(medians)
    assert [(row['scene'], row['code']) for row in table] == [
        (scene, name) for scene in ('packing', 'stirred') for name in options.codes]
    codes.plot(str(tmp_path / 'codes.png'), medians, 'here')
    assert (tmp_path / 'codes.png').stat().st_size > 10000


def test_otherMotionIsAnError(monkeypatch):
    """A code that leaves its spheres where they were is found."""
    class Still:
        exists = staticmethod(lambda: True)
        measure = staticmethod(lambda folder, warm, steps, threads, limit: {})

    monkeypatch.setitem(codes.OTHERS, 'LAMMPS', Still)
    monkeypatch.setattr(codes.codes_lammps, 'ended', lambda folder: codes.codes_lammps.start(folder)[0]['places'])
    options = codes.parse(['--scenes', 'gas', '--sizes', '500', '--codes', 'loop,LAMMPS', '--warm', '5', '--steps', '5'])
    with pytest.raises(RuntimeError, match='positions of LAMMPS differ by 1 of'):
        codes.measured(options, lambda text: None)


def test_missingCodesAreNamed(monkeypatch, capsys):
    for module in codes.OTHERS.values():
        monkeypatch.setattr(module, 'exists', lambda: False)
    assert codes.installed(['YADE', 'LIGGGHTS', 'LAMMPS']) == ['YADE']
    assert capsys.readouterr().err.strip() == (
        'not compared with LIGGGHTS and LAMMPS: not installed (sudo apt-get install liggghts lammps).')
