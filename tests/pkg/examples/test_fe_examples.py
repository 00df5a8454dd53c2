"""The finite-element examples, short, each in a yade of its own: they run, and the physics is right."""
import os
import pty
import re
import select
import signal
import subprocess
import termios
import time

import numpy as np
import pytest

from project import ROOT, yadeCommand

kExamples = os.path.join(ROOT, 'examples')
# (s) Each takes seconds; on a machine that does much else besides, minutes.
kHanging = 600
kColliders = ('Lebesgue', 'LinearCode', 'Hierarchy', 'InsertionSort')
kShort = {
    'squares': ['--n', '3', '--steps', '3000'],
    'rings': ['--n', '3', '--steps', '2000'],
    'bars': ['--n', '3', '--steps', '2000'],
    'cylinder': ['--size', '1e-3', '--steps', '400'],
    'rolling': ['--segments', '32', '--block', '.5', '--steps', '4000'],
    'impact': ['--size', '1e-3', '--steps', '400'],
}
kPictures = {
    'squares': ['squares.png'],
    'rings': ['rings.png'],
    'bars': ['bars.png'],
    'cylinder': ['cylinder.gif', 'cylinder.png', 'cylinder_force.png', 'state.vtu'],
    'rolling': ['rolling.png'],
    'impact': ['course.csv', 'fragments.csv', 'impact.png', 'impact_course.png',
               'impact_fragments.png', 'impact_sizes.png'],
}


def start(name, *options, stderr=subprocess.PIPE):
    # One thread: what OMP leaves behind must not slow down the tests.
    return subprocess.Popen(
        [*yadeCommand(), '-j1', os.path.join(kExamples, name, name + '.py'), *options],
        stdout=subprocess.PIPE, stderr=stderr, text=True)


def run(name, *options, status=0):
    """(standard output, standard error) of an example."""
    done = start(name, *options)
    try:
        out, complaints = done.communicate(timeout=kHanging)
    finally:
        done.kill()
    assert done.returncode == status, out[-1500:] + complaints[-1500:]
    return out, complaints


def rows(text):
    """The lines 'name: value' of all reports in `text`, as a list of dicts, one per report."""
    reports, found = [], {}
    for line in text.splitlines():
        match = re.match(r'(\w[^:]*):\s+(\S.*)', line)
        if match:
            found[match[1]] = match[2]
            if match[1] == 'positions (md5)':
                reports.append(found)
                found = {}
    return reports


def cells(text):
    """The table in `text` without the line below its head, as lists of texts."""
    lines = [line for line in text.splitlines() if line.startswith('|') and '--:' not in line]
    return [[cell.strip() for cell in line.strip('|').split('|')] for line in lines]


def numbers(text):
    return [float(n) for n in re.findall(r'[+-]?\d+\.?\d*(?:e[+-]?\d+)?', text.replace(',', ''))]


@pytest.mark.parametrize('passes', ['1', '2'])
@pytest.mark.parametrize('name', kShort)
def test_physicsOfTheExample(name, passes):
    out, _ = run(name, *kShort[name], '--passes', passes, '--no-pictures')
    reports = rows(out)
    assert len(reports) == (2 if name == 'rolling' else 1)
    for report in reports:
        atEnd, atMost = numbers(report['energy drift'])
        assert abs(atEnd) < 5e-3 and atMost < 5e-3
        assert numbers(report['dissipated by contact'])[0] > -.5
        assert numbers(report['actives, last and most'])[1] > 0
        assert 0 < numbers(report['searches'])[0] < numbers(report['steps'])[0]
        if passes == '2':
            assert numbers(report['deepest penetration'])[0] < 1e-3


@pytest.mark.parametrize('name', kShort)
def test_collidersGiveTheSameRun(name):
    found = {}
    for collider in kColliders:
        out, _ = run(name, *kShort[name], '--collider', collider, '--no-pictures')
        keys = ('searches', 'actives, last and most', 'positions (md5)')
        found[collider] = [[report[key] for key in keys] for report in rows(out)]
    assert all(values == found['Lebesgue'] for values in found.values()), found


def test_impulseOnTheCylinder():
    out, _ = run('cylinder', '--no-pictures')
    report = rows(out)[0]
    back, ratio = numbers(report['cylinder at the end'])
    assert 150 < back < 200 and ratio == pytest.approx(1, abs=1e-5)
    assert 8 < numbers(report['contact'])[1] < 11
    assert 40 < numbers(report['largest force'])[0] < 48


@pytest.mark.parametrize('energy', [0, 500])
def test_impactShatters(energy, folder):
    options = ['--fracture-energy', str(energy), '--size', str(6e-4), '--steps', '600']
    out, _ = run('impact', *options, '--out', folder)
    report = rows(out)[0]
    before, after = numbers(report['surface segments'])
    cracks, first = numbers(report['cracks'])[0], numbers(report['first crack'])[0]
    assert before == 252 and after > 1000
    # A crack has two faces; where it leaves a surface or meets an arc nothing is added.
    assert after - before <= 2 * cracks and cracks > 400
    assert .4 < first < 1.5
    # With cohesion, parts that it still holds together count as one.
    assert numbers(report['fragments'])[0] > (25 if energy else 50)
    assert abs(numbers(report['mass'])[0]) < 1e-12
    assert (numbers(report['dissipated by cracks'])[0] > 0) == (energy > 0)
    course = np.genfromtxt(os.path.join(folder, 'course.csv'), delimiter=',', skip_header=1)
    assert course[0, 3] == before and course[-1, 2:4].tolist() == [cracks, after]
    assert (np.diff(course[:, 2:4], axis=0) >= 0).all()
    table = np.genfromtxt(os.path.join(folder, 'fragments.csv'), delimiter=',', skip_header=1)
    assert table[:, 4].sum() == pytest.approx(.04 * .02 + np.pi * .005**2, rel=.01)


def test_ringBreaksAsInTheory(folder):
    """One ring of each kind at 10⁴ per second: 40 % for a single seed."""
    out, _ = run('ring_fragments', '--seeds', '1', '--rates', '1e4', '--moduli', '0', '20', '--out',
                 folder)
    plain, scattered = (row for row in cells(out) if row[1] == '10000')
    assert float(plain[-2]) == pytest.approx(1, abs=.4)
    # Edges that break early unload the others: fewer and larger pieces.
    assert float(scattered[-2]) > 1.1 * float(plain[-2])
    assert abs(float(plain[-1])) < 1e-3 and abs(float(scattered[-1])) < 1e-3
    assert sorted(os.listdir(folder)) == ['ring_pieces.png', 'ring_sizes.png']
    assert all(os.path.getsize(os.path.join(folder, f)) > 5000 for f in os.listdir(folder))


@pytest.mark.parametrize('held', [False, True])
def test_compressedBlocksBreakAtTheMohrCoulombLoad(held, folder):
    """5 %: measured +0.2, +1.4 %; with held ends, whose corners bear more, −2.8, −2.4 %. The load then falls
    to .50 of it with held ends, where it depends on the rubble."""
    options = ['--size', '2e-3', '--pressures', '0', '2.5', '--scatter', '0', '--fracture-energy', '0',
               '--out', folder]
    out, _ = run('compression', *options, *['--held'] * held)
    table = np.array(cells(out)[1:], dtype=float)
    assert table[:, 1] == pytest.approx([56.87, 65.86], rel=1e-3)
    assert table[:, 3] == pytest.approx(1, abs=.05)
    assert table[0, 4] < .6 and (table[:, 5] > 50).all() and (abs(table[:, 7]) < 1e-3).all()
    assert os.listdir(folder) == ['compression_held.png' if held else 'compression.png']
    assert os.path.getsize(os.path.join(folder, os.listdir(folder)[0])) > 5000


def test_mortarCracksAroundItsStones(folder):
    out, _ = run('aggregates', '--steps', '400', '--out', folder)
    report = rows(out)[0]
    assert max(map(abs, numbers(report['energy drift']))) < 1e-3
    # Each crack that has opened has two entries more than the outline had.
    assert numbers(report['surface entries'])[0] > 300
    assert numbers(report['deepest penetration'])[0] < 1e-3
    assert os.path.getsize(os.path.join(folder, 'aggregates.png')) > 10000


def test_smoothCylinderRollsMoreEvenly():
    out, _ = run('rolling', '--no-pictures')
    ripples = [numbers(report['ripple'])[0] for report in rows(out)]
    assert ripples[0] > 2 * ripples[1]
    for report in rows(out):
        assert numbers(report['mean force / weight'])[0] == pytest.approx(1, abs=.01)
        speed, surface = numbers(report['rolls at'])
        assert speed == pytest.approx(surface, rel=.03) and speed == pytest.approx(.25, rel=.1)


@pytest.mark.parametrize('name', kShort)
def test_picturesAreWritten(name, folder):
    options = ['--out', folder]
    if name == 'cylinder':
        options += ['--gif', '--vtk', os.path.join(folder, 'state.vtu')]
    run(name, *kShort[name], *options)
    assert sorted(os.listdir(folder)) == kPictures[name]
    assert all(os.path.getsize(os.path.join(folder, f)) > 5000 for f in kPictures[name])


@pytest.mark.parametrize('name, options, sentence', [
    ('squares', ['--n', '0'], 'whole number of at least 1'),
    ('rings', ['--steps', 'many'], "it is 'many', it must be a whole number of at least 1"),
    ('bars', ['--collider', 'Sweep'], "invalid choice: 'Sweep'"),
    ('bars', ['--passes', '3'], '--passes: invalid choice'),
    ('cylinder', ['--size', '-1'], "it is '-1', it must be a positive number"),
    ('cylinder', ['--size', '1'], '--size is 1 m, it must be at most 0.0025 m'),
    ('cylinder', ['--vtk', 'a.txt'], "its name must end with '.vtu'"),
    ('impact', ['--size', '1'], '--size is 1 m, it must be at most 0.0025 m'),
    ('impact', ['--speed', '0'], "it is '0', it must be a positive number"),
    ('impact', ['--fracture-energy', '-1'], "it is '-1', it must be a number of at least 0"),
    ('rolling', ['--out', '/dev/null/x'], "--out is '/dev/null/x', which is no folder"),
    ('compression', ['--scatter', '1'], "it is '1', it must be at least 0 and below 1"),
    ('compression', ['--size', '1'], "it is '1', it must be from 0.0002 to 0.005 m"),
    ('ring_fragments', ['--rates', '1e7'], "it is '1e7', it must be from 500 to 200,000"),
    ('ring_fragments', ['--out', '/dev/null/x'], "--out is '/dev/null/x', which is no folder"),
])
def test_wrongOptions(name, options, sentence):
    _, complaints = run(name, *options, status=2)
    assert sentence in complaints


def test_interruptedRunStillReports(folder):
    # On a terminal a bar shows that the run has started: an interrupt before that ends the script. It
    # has to be read, too, and one that Python loses while it writes the bar has to be sent again.
    terminal, its = pty.openpty()
    termios.tcsetwinsize(its, (24, 80))     # tqdm 4.70 shows no bar in a terminal without a width
    running = start('squares', '--n', '4', '--steps', '10000000', '--out', folder, stderr=its)
    shown, sent, end = b'', -kHanging, time.monotonic() + kHanging
    try:
        while running.poll() is None and time.monotonic() < end:
            if select.select([terminal], [], [], 1)[0]:
                shown += os.read(terminal, 4096)
            if shown.count(b'\r') > 3 and time.monotonic() - sent > 60:
                running.send_signal(signal.SIGINT)
                sent = time.monotonic()
    finally:
        running.kill()
        os.close(terminal)
        os.close(its)
    out = running.communicate()[0]
    assert running.returncode == 0, shown[-1500:]
    assert 'Interrupted after' in out and rows(out)
    assert os.listdir(folder) == ['squares.png']
