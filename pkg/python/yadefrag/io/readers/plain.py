"""Contents of files without curves: CSV, GeoJSON, WKT; contours of a silhouette, by scikit-image."""

import json
import math
import re
from collections.abc import Callable

import numpy

from yadefrag.arguments import Loop, shown, shownPath
from yadefrag.io.readers import Found, needed, readable, requireTolerance
from yadefrag.io.readers.loops import regionOf

_SHAPELY = 'python3-shapely'
_BETWEEN = str.maketrans(',;"', '   ')
_WKT_SYSTEM = re.compile(r'SRID\s*=\s*\d+\s*;', re.IGNORECASE)
_WKT_ENDS = re.compile(r'(?:(?<=\))|(?<=EMPTY))[\s;]*(?=[^\s;,)])', re.IGNORECASE)  # between two geometries
_LEVEL = .5  # between white (0) and black (1)
_SIXTEEN_BITS = 16
_TIFF_BITS, _TIFF_GREY = 258, 262  # tags: bits of a value; 0: the value 0 is white
ENDINGS = ('.png', '.jpg', '.jpeg', '.bmp', '.tif', '.tiff')


def _contents(name):
    """The text, in UTF-8, or in UTF-16 as of spreadsheets."""
    with open(name, 'rb') as file:
        data = file.read()
    return data.decode('utf-16' if data[:2] in (b'\xff\xfe', b'\xfe\xff') else 'utf-8-sig', errors='replace')


def loopsOf(name: str, cellsOf: Callable[[str], list[str]], mayBeHeading: bool) -> list[Loop]:
    """Loops of points from a text: two numbers on each line, an empty line between two loops, # before a comment.
    ValueError with the file and the line for anything else.

    cellsOf       function that divides a line
    mayBeHeading  True: the first line may have no numbers
    """
    loops: list[Loop] = [[]]
    for number, row in enumerate(_contents(name).splitlines(), 1):
        words = row.partition('#')[0].strip()
        if not words:
            if not row.strip():
                loops.append([])
            continue
        numbers = list(map(_number, cellsOf(words)))
        if len(numbers) == 2 and all(map(math.isfinite, numbers)):
            loops[-1].append((numbers[0], numbers[1]))
        elif not mayBeHeading or not all(map(math.isnan, numbers)):
            raise ValueError('%s, line %d: %s, it must be two finite numbers x, y.' %
                             (shownPath(name), number, shown(words)))
        mayBeHeading = False
    return [loop for loop in loops if loop]


def readCsv(name: str, tolerance: float | None) -> Found:
    """`x, y` on each line, with one heading without numbers. Numbers may be quoted; those with a decimal comma are
    separated by semicolons."""
    return Found([numpy.array(loop + loop[:1]) for loop in loopsOf(name, _cells, True)])


def _cells(words):
    if ';' in words and re.search(r'\d,\d', words):
        words = words.replace(',', '.')
    return words.translate(_BETWEEN).split()


def _number(cell):
    """nan for no number."""
    try:
        return float(cell)
    except ValueError:
        return math.nan


def readGeoJson(name: str, tolerance: float | None) -> Found:
    """One GeoJSON text, or one on each line."""
    geometry = needed('shapely.geometry', _SHAPELY, name)
    found = Found()
    with readable(name, 'GeoJSON file'):
        for data in _texts(_contents(name)):
            for one in _geometries(data, found.leftOut):
                _add(found, geometry.shape(one))
    return found


def _texts(text):
    """All JSON values of a text; RFC 8142 separates them by the character 30."""
    decoder, place, values = json.JSONDecoder(), 0, []
    text = text.replace('\x1e', ' ').strip()
    while place < len(text) or not values:
        value, place = decoder.raw_decode(text, place)
        values += value if isinstance(value, list) else [value]
        while place < len(text) and text[place].isspace():
            place += 1
    return values


def _geometries(data, leftOut):
    """The geometries of a collection of features, of one feature, or of a geometry itself."""
    kind = data['type']
    if kind == 'FeatureCollection':
        return [one for feature in data['features'] for one in _geometries(feature, leftOut)]
    if kind == 'Feature':
        if data['geometry'] is None:
            leftOut['features without geometry'] += 1
            return []
        data = data['geometry']
    return [data]


def readWkt(name: str, tolerance: float | None) -> Found:
    """Geometries one after another, e.g. one on each line."""
    wkt = needed('shapely.wkt', _SHAPELY, name)
    found = Found()
    with readable(name, 'WKT file'):
        for one in _WKT_ENDS.split(_WKT_SYSTEM.sub('', _contents(name)).strip(' \t\r\n;,')):
            _add(found, wkt.loads(one))
    return found


def _add(found, shape):
    """Adds shapely's shapes; points are left out."""
    if hasattr(shape, 'geoms'):
        for part in shape.geoms:
            _add(found, part)
    elif shape.is_empty:
        found.leftOut['empty geometries'] += 1
    elif shape.geom_type == 'Polygon':
        found.regions.append(regionOf(shape))
    elif shape.geom_type in ('LineString', 'LinearRing'):
        found.lines.append(numpy.array(shape.coords)[:, :2])
    else:
        found.leftOut['points'] += 1


def readPicture(name: str, tolerance: float | None) -> Found:
    """Contours of the areas darker than middle grey, in pixels from the lower left corner, y upwards; transparent areas
    count as white."""
    requireTolerance(tolerance, name, 'is a picture')
    image = needed('PIL.Image', 'python3-pil', name)
    operations = needed('PIL.ImageOps', 'python3-pil', name)
    measure = needed('skimage.measure', 'python3-skimage', name)
    with readable(name, 'picture'), image.open(name) as picture:
        tags = dict(getattr(picture, 'tag_v2', {}))
        key = picture.info.get('transparency')
        others = getattr(picture, 'n_frames', 1) - 1
        # Pillow 11 and 12 map the values of a TIFF that is stored on its side into memory with the sizes
        # of the turned picture. They do not if they know no file of this name.
        picture.filename = ''
        picture.load()  # turns a TIFF, which exif_transpose would turn once more
        upright = picture if picture.format == 'TIFF' else operations.exif_transpose(picture)
        dark = _darkness(image, upright, tags, key)
    height = len(dark)
    contours = measure.find_contours(numpy.pad(dark, 1), _LEVEL)
    # The middle of pixel (row 0, column 0) is at (1, 1) in the padded array.
    found = Found([numpy.stack([c[:, 1] - .5, height + .5 - c[:, 0]], axis=1) for c in contours])
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
