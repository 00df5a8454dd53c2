"""The finite-element examples, short, each in a yade of its own: they run, and the physics is right.

Other colliders, passes and values: tests/validation/yade/test_long_examples.py.
"""
import os
import pty
import select
import signal
import termios
import time

import numpy as np
import pytest

from example_runs import checkReports, kHanging, kShort, numbers, rows, run, start

kPictures = {
    'squares': ['squares.png'],
    'rings': ['rings.png'],
    'bars': ['bars.png'],
    'cylinder': ['cylinder.gif', 'cylinder.png', 'cylinder_force.png', 'state.vtu'],
    'rolling': ['rolling.png'],
    'impact': ['course.csv', 'fragments.csv', 'impact.png', 'impact_course.png',
               'impact_fragments.png', 'impact_sizes.png'],
}


@pytest.mark.parametrize('name', ['impact', *(pytest.param(n, marks=pytest.mark.long) for n in kShort if n != 'impact')])
def test_physicsAndPicturesOfTheExample(name, folder):
    options = ['--out', folder]
    if name == 'cylinder':
        options += ['--gif', '--vtk', os.path.join(folder, 'state.vtu')]
    out, _ = run(name, *kShort[name], *options)
    checkReports(name, out)
    assert sorted(os.listdir(folder)) == kPictures[name]
    assert all(os.path.getsize(os.path.join(folder, f)) > 5000 for f in kPictures[name])


@pytest.mark.long
def test_impulseOnTheCylinder():
    out, _ = run('cylinder', '--no-pictures')
    report = rows(out)[0]
    back, ratio = numbers(report['cylinder at the end'])
    assert 150 < back < 200 and ratio == pytest.approx(1, abs=1e-5)
    assert 8 < numbers(report['contact'])[1] < 11
    assert 40 < numbers(report['largest force'])[0] < 48


@pytest.mark.parametrize('energy', [0, pytest.param(500, marks=pytest.mark.long)])
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


@pytest.mark.long
def test_mortarCracksAroundItsStones(folder):
    out, _ = run('aggregates', '--steps', '400', '--out', folder)
    report = rows(out)[0]
    assert max(map(abs, numbers(report['energy drift']))) < 1e-3
    # Each crack that has opened has two entries more than the outline had.
    assert numbers(report['surface entries'])[0] > 300
    assert numbers(report['deepest penetration'])[0] < 1e-3
    assert os.path.getsize(os.path.join(folder, 'aggregates.png')) > 10000


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


@pytest.mark.long
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
