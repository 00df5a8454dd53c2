"""Contours of a silhouette, by scikit-image: in pixels from the lower left corner, y upwards."""

import numpy

from yadefrag.io.readers import Found, needed, refuseFile, requireTolerance

_PACKAGE = 'python3-skimage'
_LEVEL = .5  # between white (0) and black (1)
_SIXTEEN_BITS = 16
_TIFF_BITS, _TIFF_GREY = 258, 262  # tags: bits of a value; 0: the value 0 is white
ENDINGS = ('.png', '.jpg', '.jpeg', '.bmp', '.tif', '.tiff')


def read(name: str, tolerance: float | None) -> Found:
    """Contours of the areas darker than middle grey; transparent areas count as white."""
    requireTolerance(tolerance, name, 'is a picture')
    image = needed('PIL.Image', 'python3-pil', name)
    operations = needed('PIL.ImageOps', 'python3-pil', name)
    measure = needed('skimage.measure', _PACKAGE, name)
    try:
        with image.open(name) as picture:
            tags = dict(getattr(picture, 'tag_v2', {}))
            key = picture.info.get('transparency')
            others = getattr(picture, 'n_frames', 1) - 1
            # Pillow 11 and 12 map the values of a TIFF that is stored on its side into memory with the sizes
            # of the turned picture. They do not if they know no file of this name.
            picture.filename = ''
            picture.load()  # turns a TIFF, which exif_transpose would turn once more
            upright = picture if picture.format == 'TIFF' else operations.exif_transpose(picture)
            dark = _darkness(image, upright, tags, key)
    except Exception as error:  # of the library
        refuseFile(name, 'picture', error)
    height = len(dark)
    contours = measure.find_contours(numpy.pad(dark, 1), _LEVEL)
    # The middle of pixel (row 0, column 0) is at (1, 1) in the padded array.
    found = Found([numpy.stack([c[:, 1] - .5, height + .5 - c[:, 0]], axis=1) for c in contours])
    if others:
        found.leftOut['further pictures of the file'] += others
    return found


def _darkness(image, picture, tags, key):
    """(rows, columns) from 0, white, to 1, black. `tags` are those of a TIFF, `key` is the value that
    is transparent or None."""
    if not picture.mode.startswith(('I', 'F')):
        if isinstance(key, tuple) and max(key) > 255:  # PIL keeps the upper eight bits of colours
            picture.info['transparency'] = tuple(value >> 8 for value in key)
        colours = picture.convert('RGBA')
        paper = image.new('RGBA', colours.size, 'white')
        return 1 - numpy.asarray(image.alpha_composite(paper, colours).convert('L')) / 255
    bits = numpy.max(tags.get(_TIFF_BITS, _SIXTEEN_BITS))
    grey = numpy.asarray(picture).astype(float)
    if picture.mode == 'F' or bits > _SIXTEEN_BITS or grey.min() < 0:
        raise ValueError('its grey values do not have 8 or 16 bits')
    grey /= 2**int(bits) - 1
    if tags.get(_TIFF_GREY) == 0:
        grey = 1 - grey
    if key is not None:
        grey[numpy.asarray(picture) == key] = 1
    return 1 - grey
