"""YADE's 3D view shows FE bodies, beside spheres: pictures of it, pixel by pixel."""
import os
import shutil
import subprocess
import tempfile

import numpy as np
import pytest

from project import yadeCommand

kHere = os.path.dirname(os.path.abspath(__file__))
BACK = 51  # the grey that YADE's view has behind the scene


@pytest.fixture(scope='module')
def pictures():
    """{name: array (400, 500, 3) of the window with the view}."""
    image = pytest.importorskip('PIL.Image')
    if not shutil.which('xvfb-run'):
        pytest.skip('no xvfb-run')
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        command = [part for part in yadeCommand() if part != '-n']
        done = subprocess.run(
            ['xvfb-run', '-a', '-s', '-screen 0 600x500x24', *command,
             os.path.join(kHere, 'gl_scene.py'), folder],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
        assert done.returncode == 0, done.stdout[-2000:]
        found = {name[:-4]: np.asarray(image.open(os.path.join(folder, name)).convert('RGB'))[:400, :500]
                 for name in os.listdir(folder) if name.endswith('.png')}
        found['cracks'] = np.load(os.path.join(folder, 'cracks.npy'))
        yield found


def counts(picture):
    """{colour: pixels}, of the scene alone, without the texts in its lower and upper left corner."""
    inside = picture.copy()
    inside[:40, :60] = inside[330:, :120] = BACK
    colours, count = np.unique(inside.reshape(-1, 3), axis=0, return_counts=True)
    return {tuple(c.tolist()): int(n) for c, n in zip(colours, count) if tuple(c) != (BACK,) * 3}


def share(picture, isOne):
    return sum(n for colour, n in counts(picture).items() if isOne(*colour))


def test_bodiesAreFilledBesideSpheres(pictures):
    """The two most frequent colours are a square's and a disc's: areas as 1 : pi/4, to 3 % for the rims,
    over which the black boundary lies. The sphere is a shaded green."""
    (one, large), (other, small) = sorted(counts(pictures['component']).items(), key=lambda item: -item[1])[:2]
    assert large > 10000 and small / large == pytest.approx(np.pi / 4, rel=.03)
    rows = {colour: np.argwhere((pictures['component'] == colour).all(axis=2)).mean(axis=0)
            for colour in (one, other)}
    assert rows[one][1] < 200 < 300 < rows[other][1]  # the square is on the left, the disc on the right
    assert rows[one][0] == pytest.approx(rows[other][0], abs=3)
    green = share(pictures['component'], lambda r, g, b: g > 100 and r < .6 * g and b < .6 * g)
    assert green == pytest.approx(np.pi * .3**2 * large, rel=.2)
    black = share(pictures['component'], lambda r, g, b: (r, g, b) == (0, 0, 0))
    assert 400 < black < 3000


def test_wireIsEdgesOnly(pictures):
    filled, wire = counts(pictures['component']), counts(pictures['wire'])
    for colour, count in sorted(filled.items(), key=lambda item: -item[1])[:2]:
        assert .02 * count < wire.get(colour, 0) < .5 * count


def test_stressIsBlueToRed(pictures):
    """Three fifths without stress are blue, two fifths with the largest one red; a column of triangles
    between may have another one."""
    found = pictures['mises']
    blue = share(found, lambda r, g, b: b > 250 and r < 5 and g < 5)
    red = share(found, lambda r, g, b: r > 250 and g < 5 and b < 5)
    assert blue > 5000 and red > 2500 and 1 < blue / red < 2.2


def test_fragmentsHaveColoursOfTheirOwn(pictures):
    (_, large), (_, small) = sorted(counts(pictures['fragment']).items(), key=lambda item: -item[1])[:2]
    assert small > 5000 and small / large == pytest.approx(1, rel=.05)


def test_cracksThatHoldAreRed(pictures):
    """A line between the two squares, all along the side."""
    places = np.argwhere((pictures['held'] == (255, 0, 0)).all(axis=2))
    assert len(places) > 100
    assert np.ptp(places[:, 0]) > 100 and np.ptp(places[:, 1]) <= 3


def test_aRunIsDrawnWhileItGoesOn(pictures):
    cracks, fragments = pictures['cracks']
    assert cracks > 20 and fragments > 3
    assert sum(n > 200 for n in counts(pictures['running']).values()) >= 3


def test_nothingOfOpenGLIsLinked():
    """A yade without a window must load the module."""
    from yadefrag import _yadefrag
    shown = subprocess.run(['readelf', '-W', '--dyn-syms', '-d', _yadefrag.__file__], stdout=subprocess.PIPE,
                           text=True, check=True).stdout
    assert 'libyade.so' in shown and 'dlsym' in shown
    assert 'libGL' not in shown and ' glBegin' not in shown
