"""Contours of a silhouette, by scikit-image: in pixels from the lower left corner, y upwards."""

import numpy

from yadefrag.readers import needed, refuseFile, requireTolerance

_PACKAGE = 'python3-skimage'
_LEVEL = .5  # between white (0) and black (1)
_SIXTEEN_BITS = 65535
ENDINGS = ('.png', '.jpg', '.jpeg', '.bmp', '.tif', '.tiff')


def lines(name, tolerance):
    """Contours of the areas darker than middle grey; transparent areas count as white."""
    requireTolerance(tolerance, name, 'is a picture')
    image = needed('PIL.Image', 'python3-pil', name)
    measure = needed('skimage.measure', _PACKAGE, name)
    try:
        with image.open(name) as picture:
            dark = _darkness(image, picture)
    except Exception as error:  # of the library
        refuseFile(name, 'picture', error)
    height = len(dark)
    contours = measure.find_contours(numpy.pad(dark, 1), _LEVEL)
    # The middle of pixel (row 0, column 0) is at (1, 1) in the padded array.
    return [numpy.stack([c[:, 1] - .5, height + .5 - c[:, 0]], axis=1) for c in contours]


def _darkness(image, picture):
    """(rows, columns) from 0, white, to 1, black."""
    if picture.mode.startswith(('I', 'F')):  # more than eight bits, which PIL would clip
        grey = numpy.asarray(picture).astype(float)
        if picture.mode == 'F' or grey.min() < 0 or grey.max() > _SIXTEEN_BITS:
            raise ValueError('its grey values do not have 8 or 16 bits')
        return 1 - grey / _SIXTEEN_BITS
    colours = picture.convert('RGBA')
    paper = image.new('RGBA', colours.size, 'white')
    return 1 - numpy.asarray(image.alpha_composite(paper, colours).convert('L')) / 255
