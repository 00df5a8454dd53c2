"""Shapes of an SVG file that a viewer shows: in units of the viewBox, y upwards.

svgelements parses paths, matrices, lengths and colours, cssselect2 style sheets. svg_style.py is the cascade,
svg_shapes.py makes lines and regions of what is found here.
"""

import dataclasses
import math
import re
from xml.etree import ElementTree

import numpy

from yadefrag.io.readers import Found, needed, readable
from yadefrag.io.readers.svg_shapes import Item, appended
from yadefrag.io.readers.svg_style import (INITIAL, Sheets, fraction, hrefOf, isPattern, isSeen, isWhite, tagOf, urlOf)

_PIXELS_PER_INCH = 96
_SHAPES = {'path', 'rect', 'circle', 'ellipse', 'line', 'polyline', 'polygon'}
_WITH_MARKERS = {'path', 'line', 'polyline', 'polygon'}
_OTHERS = {'text': 'texts', 'image': 'images', 'foreignObject': 'foreign objects'}
_GROUPS = {'g', 'a', 'switch', 'svg', 'use'}
_LANGUAGE = 'en'  # of a viewer, for systemLanguage
_UNIT = re.compile(r'[-+]?[\d.]+(?:[eE][-+]?\d+)?([a-zA-Z]+|%)?$')
_UNITS = {None, '', '%', 'px', 'pt', 'pc', 'mm', 'cm', 'in', 'em', 'Q'}


def read(name: str, tolerance: float | None) -> Found:
    svg, _ = (needed(one, 'python3-' + one, name) for one in ('svgelements', 'cssselect2'))
    found = Found()
    with readable(name, 'SVG file'):
        root = ElementTree.parse(name).getroot()
        if tagOf(root) != 'svg':
            raise ValueError('its root element is not svg')
        with open(name, 'rb') as file:
            found.leftOut['external style sheets'] += file.read().count(b'<?xml-stylesheet')
        walk = _Walk(svg, root, found.leftOut)
        items = walk.items()
    appended(found, items, walk.page, tolerance, name)
    return found


@dataclasses.dataclass(frozen=True)
class _Place:
    """What an element inherits."""
    style: dict
    matrix: numpy.ndarray  # (3, 3), to the units of the root's viewBox
    view: tuple            # width and height, for percentages
    clips: tuple = ()      # as those of an Item
    uses: tuple = ()       # elements that refer to each other
    isClip: bool = False   # within a clipPath, where paint has no effect


class _Walk:
    def __init__(self, svg, root, leftOut):
        self.svg, self.root, self.leftOut = svg, root, leftOut
        self.sheets = Sheets(root, leftOut)
        self.ids = {}
        for element in root.iter():
            if element.get('id'):
                self.ids.setdefault(element.get('id'), element)
        self.found = []
        self.page = None  # (left, top, right, bottom) in units of the viewBox

    def items(self):
        """[Item], in the order of painting."""
        box, style = _box(self.root), self.sheets.computed(self.root, INITIAL)
        size = [None if (text := style.get(side, '100%')).endswith('%') else
                self._length(text, 0, style) for side in ('width', 'height')]
        if box and 0 not in box[2:] and 0 not in size:
            width, height = (mine or whole for mine, whole in zip(size, box[2:]))
            across, down = _ratios(box, width, height, self.root.get('preserveAspectRatio', ''))
            self.page = (box[0] - across[1] / across[0], box[1] - down[1] / down[0],
                         box[0] + (width - across[1]) / across[0], box[1] + (height - down[1]) / down[0])
        elif not box and None not in size:
            self.page = (0, 0, *size)
        view = box[2:] if box else tuple(side or 100. for side in size)
        if 0 in size or box and 0 in box[2:]:
            self._hide(self.root, 'shapes on a page without extent')
        else:
            self._visit(self.root, _Place(INITIAL, numpy.eye(3), view))
        return self.found

    def _visit(self, element, place):
        tag = tagOf(element)
        if tag not in _SHAPES | _GROUPS and tag not in _OTHERS:
            return
        style = self.sheets.computed(element, place.style)
        if style['display'] == 'none' or not _applies(element):
            return self._hide(element, 'hidden shapes')
        if fraction(style['opacity']) <= 0 and not place.isClip:
            return self._hide(element, 'shapes with opacity 0')
        for key in ('mask', 'filter'):
            self.leftOut[key + 's'] += urlOf(style[key]) in self.ids
        matrix = place.matrix @ self._transform(style, place.view)
        place = dataclasses.replace(place, style=style, matrix=matrix)
        if tag in _SHAPES:
            return self._shape(tag, place)
        if tag in _OTHERS:
            self.leftOut[_OTHERS[tag]] += style['visibility'] == 'visible'
            return None
        place = dataclasses.replace(place, clips=place.clips + self._clips(style, place, None))
        return self._group(element, tag, place)

    def _group(self, element, tag, place):
        if tag == 'use':
            self._use(element, place)
        elif tag == 'svg' and element is not self.root:
            self._viewport(element, place, {})
        elif tag == 'switch':
            those = [child for child in element if tagOf(child) in _SHAPES | _GROUPS or tagOf(child) in _OTHERS]
            chosen = next((child for child in those if _applies(child)), None)
            for child in those:
                if child is chosen:
                    self._visit(child, place)
                else:
                    self._hide(child, 'alternatives of a switch')
        else:
            for child in element:
                self._visit(child, place)

    def _hide(self, element, what):
        self.leftOut[what] += sum(tagOf(one) in _SHAPES | {'use'} or tagOf(one) in _OTHERS for one in element.iter())

    def _use(self, element, place):
        target = hrefOf(element)
        if not target.startswith('#'):
            self.leftOut['references to other files'] += bool(target)
            return
        one = self.ids.get(target[1:])
        if one is None or one in place.uses:
            self.leftOut['references to missing or surrounding elements'] += 1
            return
        if place.isClip and tagOf(one) not in _SHAPES:
            return
        style, (width, height) = place.style, place.view
        shift = _shift(self._length(style.get('x', '0'), width, style),
                       self._length(style.get('y', '0'), height, style))
        place = dataclasses.replace(place, matrix=place.matrix @ shift, uses=place.uses + (one,))
        if tagOf(one) in ('symbol', 'svg'):
            mine = self.sheets.computed(one, style)
            if mine['display'] == 'none':
                return
            matrix = place.matrix @ self._transform(mine, place.view)
            size = {key: style[key] for key in ('width', 'height') if key in element.attrib}
            self._viewport(one, dataclasses.replace(place, style=mine, matrix=matrix), size)
        else:
            self._visit(one, place)

    def _viewport(self, element, place, size):
        """The contents of an inner svg or of a symbol; `size` replaces its own width and height."""
        style, view = {**place.style, **size}, place.view
        x, y = (self._length(style.get(key, '0'), whole, style) for key, whole in zip('xy', view))
        width, height = (self._length(style.get(key, '100%').replace('auto', '100%'), whole, style)
                         for key, whole in zip(('width', 'height'), view))
        box = _box(element)
        if width <= 0 or height <= 0 or box and 0 in box[2:]:
            return
        matrix, clips = place.matrix @ _shift(x, y), place.clips
        if style['overflow'] in ('hidden', 'scroll'):
            edge = self.svg.Path(self.svg.Rect(0, 0, width, height))
            clips += ((Item(edge, matrix, True, False, 'nonzero'),),)
        if box:
            (across, right), (down, low) = _ratios(box, width, height, element.get('preserveAspectRatio', ''))
            matrix = matrix @ _shift(right, low) @ numpy.diag([across, down, 1]) @ _shift(-box[0], -box[1])
            width, height = box[2:]
        place = dataclasses.replace(place, matrix=matrix, view=(width, height), clips=clips)
        for child in element:
            self._visit(child, place)

    def _shape(self, tag, place):
        style = place.style
        if style['visibility'] != 'visible':
            self.leftOut['hidden shapes'] += 1
            return
        isFilled = tag != 'line' and isSeen(style['fill'], style['fill-opacity'], self.ids)
        isStroked = isSeen(style['stroke'], style['stroke-opacity'], self.ids) and \
            self._length(style['stroke-width'], math.hypot(*place.view) / math.sqrt(2), style) > 0
        path = self._path(tag, style, place.view)
        if place.isClip:
            isFilled, isStroked = True, False
        if path is None or not (isFilled or isStroked):
            self.leftOut['shapes that are not painted'] += 1
            return
        self.leftOut['patterns of shapes'] += isFilled and isPattern(style['fill'], self.ids)
        self.leftOut['markers of shapes'] += tag in _WITH_MARKERS and any(
            urlOf(style[key]) in self.ids for key in style if key.startswith('marker-'))
        clips = place.clips + self._clips(style, place, path)
        rule = style['clip-rule' if place.isClip else 'fill-rule']
        self.found.append(Item(path, place.matrix, isFilled, isStroked, rule, clips,
                               isWhite(style['fill']) and not isStroked))

    def _clips(self, style, place, path):
        """What the property clip-path adds to the clips."""
        if style['clip-path'] == 'none':
            return ()
        element = self.ids.get(urlOf(style['clip-path']))
        if element is None or tagOf(element) != 'clipPath' or element in place.uses:
            self.leftOut['clip paths'] += 1
            return ()
        own = self.sheets.computed(element, self.sheets.around(element))
        matrix = place.matrix @ self._transform(own, place.view)
        view = place.view
        if element.get('clipPathUnits') == 'objectBoundingBox':
            box = None if path is None else path.bbox()
            if box is None:  # of a group
                self.leftOut['clip paths'] += 1
                return ()
            matrix = matrix @ _shift(*box[:2]) @ numpy.diag([box[2] - box[0], box[3] - box[1], 1])
            view = (1, 1)
        whole, self.found = self.found, []
        hidden, self.leftOut = self.leftOut, Found().leftOut  # only what is drawn is counted
        inner = _Place(own, matrix, view, uses=place.uses + (element,), isClip=True)
        for child in element:
            if tagOf(child) in _SHAPES | {'use'}:
                self._visit(child, inner)
            elif tagOf(child) == 'text':
                hidden['texts of clip paths'] += 1
        items, self.found, self.leftOut = self.found, whole, hidden
        return (tuple(items), *self._clips(own, inner, None))

    def _path(self, tag, style, view):
        """svgelements' path of a shape, before its transform; None if it has no extent."""
        def length(key, default='0'):
            part = view[0] if key[-1] == 'x' or key in ('width', 'x1', 'x2') else \
                view[1] if key != 'r' else math.hypot(*view) / math.sqrt(2)
            return self._length(style.get(key, default), part, style)
        if tag == 'path':
            return self._parsed(style.get('d', ''))
        if tag == 'line':
            return self._polyline([length(key) for key in ('x1', 'y1', 'x2', 'y2')], False)
        if tag in ('polyline', 'polygon'):
            numbers = re.findall(r'[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?', style.get('points', ''))
            return self._polyline(list(map(float, numbers)), tag == 'polygon')
        radii = [length(key, 'auto' if tag != 'circle' else '0') if style.get(key, 'auto') != 'auto'
                 else None for key in ('rx', 'ry')]
        radii = [None if radius is None or radius < 0 else radius for radius in radii]
        radii = [one if one is not None else other or 0. for one, other in (radii, radii[::-1])]
        if tag == 'rect':
            width, height = length('width'), length('height')
            return self.svg.Path(self.svg.Rect(length('x'), length('y'), width, height, *radii)) \
                if width > 0 and height > 0 else None
        radii = [length('r')] * 2 if tag == 'circle' else radii
        return self.svg.Path(self.svg.Ellipse(length('cx'), length('cy'), *radii)) if min(radii) > 0 else None

    def _parsed(self, text):
        """The path up to its first error, as viewers draw it."""
        path = self.svg.Path()
        try:
            path.parse(text)
        except (ValueError, IndexError, TypeError):
            self.leftOut['ends of paths, from an error on'] += 1
        isRight = len(path) > 1 and isinstance(path[0], self.svg.Move)
        return path if isRight else None

    def _polyline(self, numbers, isClosed):
        points = list(zip(numbers[::2], numbers[1::2]))
        return self.svg.Path((self.svg.Polygon if isClosed else self.svg.Polyline)(*points)) \
            if len(points) > 1 else None

    def _length(self, text, whole, style):
        """In pixels; 0 for units that depend on a font or a window."""
        unit = _UNIT.match(text)
        if unit and unit[1] not in _UNITS:
            self.leftOut['lengths in the unit %s' % unit[1]] += 1
            return 0.
        if unit and unit[1] == 'Q':
            text = '%fmm' % (float(text[:-1]) / 4)
        size = self.svg.Length(style['font-size']).value(ppi=_PIXELS_PER_INCH, font_size=16.)
        value = self.svg.Length(text).value(ppi=_PIXELS_PER_INCH, relative_length=whole,
                                            font_size=size if isinstance(size, float) else 16.)
        return float(value)

    def _transform(self, style, view):
        """(3, 3) of the properties transform and transform-origin."""
        if style['transform'] in ('', 'none'):
            return numpy.eye(3)
        try:
            parsed = self.svg.Matrix(style['transform'])
            parsed.render(ppi=_PIXELS_PER_INCH, width=view[0], height=view[1])
            matrix = numpy.array([[parsed.a, parsed.c, parsed.e], [parsed.b, parsed.d, parsed.f],
                                  [0, 0, 1]], dtype=float)
        except (ValueError, IndexError, TypeError):
            self.leftOut['transforms with an error'] += 1
            return numpy.eye(3)
        if style['transform-box'] not in ('view-box', ''):
            self.leftOut['boxes of transforms'] += 1
        origin = self._origin(style, view)
        return _shift(*origin) @ matrix @ _shift(*-origin)

    def _origin(self, style, view):
        words = style['transform-origin'].replace(',', ' ').split() or ['0', '0']
        if words[0] in ('top', 'bottom') or words[-1] in ('left', 'right') and len(words) > 1:
            words = (words[1:2] or ['center']) + words[:1]
        words = (words + ['center'])[:2]
        named = dict(left='0%', top='0%', center='50%', right='100%', bottom='100%')
        return numpy.array([self._length(named.get(word, word), whole, style) for word, whole in zip(words, view)])


def _applies(element):
    """False for an element with conditions that a viewer does not meet."""
    if 'requiredExtensions' in element.attrib:
        return False
    languages = element.get('systemLanguage')
    return languages is None or any(one.strip().lower().partition('-')[0] == _LANGUAGE for one in languages.split(','))


def _box(element):
    """(x, y, width, height) of the viewBox, or None."""
    numbers = re.split(r'[\s,]+', element.get('viewBox', '').strip())
    try:
        box = tuple(map(float, numbers))
    except ValueError:
        return None
    return box if len(box) == 4 and min(box[2:]) >= 0 else None


def _ratios(box, width, height, aspect):
    """((scale, shift), (scale, shift)) in x and y, from a viewBox at 0 to a viewport."""
    scales = width / box[2], height / box[3]
    if aspect.strip().startswith('none'):
        return (scales[0], 0.), (scales[1], 0.)
    scale = max(scales) if 'slice' in aspect else min(scales)
    x, y = (next((part for word, part in (('Min', 0.), ('Max', 1.)) if axis + word in aspect), .5) for axis in 'xY')
    return (scale, x * (width - scale * box[2])), (scale, y * (height - scale * box[3]))


def _shift(x, y):
    return numpy.array([[1., 0, x], [0, 1, y], [0, 0, 1]])
