"""Outlines from pictures: silhouettes with holes, formats, specks, edges."""
import math
import os

import numpy as np
import pytest

from outline_files import area, offEllipse
from yadefrag import readOutline


def silhouette(folder, inside, size=(120, 100), mode='L'):
    from PIL import Image
    y, x = np.mgrid[size[1] - .5:-.5:-1, .5:size[0]]
    isDark = inside(x, y)
    if mode == 'L':
        picture = Image.fromarray(np.where(isDark, 0, 255).astype(np.uint8))
    else:  # black everywhere, and transparent outside
        pixels = np.zeros(isDark.shape + (4,), dtype=np.uint8)
        pixels[isDark, 3] = 255
        picture = Image.fromarray(pixels, 'RGBA')
    file = os.path.join(folder, mode + '.png')
    picture.save(file)
    return file


@pytest.mark.parametrize('mode', ['L', 'RGBA'])
def test_silhouetteWithAHole(folder, mode):
    def inside(x, y):
        return (np.hypot(x - 60, y - 40) < 35) & (np.hypot(x - 70, y - 45) > 10)
    (outline, (hole,)), = readOutline(silhouette(folder, inside, mode=mode), 1e-3, scale=1e-3)
    # A pixel's half from the grid, and the tolerance of one pixel.
    for loop, centre, radius in ((outline, (.06, .04), .035), (hole, (.07, .045), .01)):
        radii = np.hypot(*(np.array(loop) - centre).T)
        assert abs(radii - radius).max() < 1e-3
        assert max(offEllipse(loop, centre, radius, radius)) < 1.75e-3
        assert area(loop) == pytest.approx(math.pi * radius**2, rel=.03 if radius > .02 else .1)
    assert len(outline) < 40 < len(readOutline(silhouette(folder, inside), 1e-4, scale=1e-3)[0][0])


@pytest.mark.parametrize('ending', ['jpg', 'jpeg', 'bmp', 'tif', 'tiff', 'png'])
@pytest.mark.parametrize('bits', [8, 16])
def test_silhouetteInOtherFormats(folder, ending, bits):
    """A disc of 40 pixels on paper that is not quite white; 0.5 %: JPEG blurs the edge."""
    from PIL import Image
    if bits == 16 and ending in ('jpg', 'jpeg', 'bmp'):
        pytest.skip('the format has 8 bits')
    y, x = np.mgrid[99.5:-.5:-1, .5:120]
    grey = np.where(np.hypot(x - 60, y - 50) < 40, .1, .9)
    file = os.path.join(folder, 'disc.' + ending)
    Image.fromarray((grey * (2**bits - 1)).astype(np.uint8 if bits == 8 else np.uint16)).save(file)
    [(outline, holes)] = readOutline(file, .25)
    assert area(outline) == pytest.approx(math.pi * 40**2, rel=.005) and holes == []
    assert np.mean(outline, axis=0) == pytest.approx((60, 50), abs=1)


def test_greysWithoutARangeAreRefused(folder):
    from PIL import Image
    file = os.path.join(folder, 'float.tif')
    Image.fromarray(np.ones((9, 9), dtype=np.float32)).save(file)
    with pytest.raises(ValueError, match='float.tif is not a readable picture: its grey values do not have 8 or 16'):
        readOutline(file, 1)


def test_specksAreOmittedIfRequested(folder):
    def inside(x, y):
        return (abs(x - 60) < 30) & (abs(y - 50) < 20) | (np.hypot(x - 10, y - 10) < 2)
    file = silhouette(folder, inside)
    (outline, _), = readOutline(file, .1, leastArea=50)
    # The contour cuts a corner at half a pixel.
    assert area(outline) == pytest.approx(60 * 40, rel=1e-3)
    with pytest.raises(ValueError, match='L.png, tolerance: simplify is 1 m, .*could vanish'):
        readOutline(file, 1)


def test_silhouetteAtTheEdgeOfThePicture(folder):
    (outline, _), = readOutline(silhouette(folder, lambda x, y: x < 60), .1)
    assert area(outline) == pytest.approx(60 * 100, rel=1e-3)
