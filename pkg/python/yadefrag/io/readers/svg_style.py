"""Style of SVG elements: attributes, style sheets, inheritance; which paint can be seen."""

import re
from collections import Counter
from collections.abc import Mapping
from xml.etree.ElementTree import Element

INITIAL = {'fill': 'black', 'stroke': 'none', 'fill-rule': 'nonzero', 'clip-rule': 'nonzero', 'visibility': 'visible',
           'fill-opacity': '1', 'stroke-opacity': '1', 'stroke-width': '1', 'color': 'black', 'marker-start': 'none',
           'marker-mid': 'none', 'marker-end': 'none', 'stroke-dasharray': 'none', 'font-size': '16'}
_OWN = {'display': 'inline', 'opacity': '1', 'clip-path': 'none', 'mask': 'none', 'filter': 'none',
        'transform': '', 'transform-origin': '', 'transform-box': 'view-box', 'overflow': 'hidden'}
_PAINTS = ('fill', 'stroke')
_SERVERS = ('linearGradient', 'radialGradient', 'pattern')
_HREFS = ('href', '{http://www.w3.org/1999/xlink}href')
_WHITE = 0xffffffff
_NAME = r'[\w\u0080-\uffff-]+'
# A type, or *, with ids and classes.
_COMPOUND = re.compile(r'(%s|\*)?((?:[.#]%s)*)$' % (_NAME, _NAME))


def tagOf(element: Element) -> str:
    """The name without SVG's namespace; '' for comments and elements of other namespaces."""
    if not isinstance(element.tag, str):
        return ''
    space, _, tag = element.tag.rpartition('}')
    return tag if space in ('', '{http://www.w3.org/2000/svg') else ''


def declarations(text: str) -> list[tuple[str, str, bool]]:
    """[(property, value, is important)]."""
    found = []
    for one in re.sub(r'/\*.*?\*/', '', text, flags=re.DOTALL).split(';'):
        key, colon, value = one.partition(':')
        value, important, _ = value.partition('!')
        if colon:
            found.append((key.strip().lower(), value.strip(), bool(important)))
    return found


class Sheets:
    """The style sheets of a document."""

    def __init__(self, root: Element, leftOut: Counter[str]) -> None:
        self.parents = {child: parent for parent in root.iter() for child in parent}
        self._rules, self._leftOut = [], leftOut
        for element in root.iter():
            if tagOf(element) == 'style' and element.get('type', 'text/css') in ('text/css', ''):
                self._read(''.join(element.itertext()))
        self._rules.sort(key=lambda rule: rule[0])  # stable: of equal ones, the last one holds

    def _read(self, text):
        text = re.sub(r'/\*.*?\*/|<!--|-->', '', text, flags=re.DOTALL)
        imports = re.findall(r'@import[^;]*;?', text)
        if imports:
            self._leftOut['imported style sheets'] += len(imports)
        text = re.sub(r'@(import|charset|namespace)[^;]*;', '', text)
        # Of blocks of rules only those for a screen; of other blocks, such as fonts, none.
        text = re.sub(r'@media\b([^{]*)\{((?:[^{}]*\{[^{}]*\})*)[^{}]*\}', lambda found: found[2] if re.search(
            r'^\s*$|\b(all|screen)\b', found[1]) else '', text)
        text = re.sub(r'@[^{]*\{(?:[^{}]*\{[^{}]*\})*[^{}]*\}', '', text)
        for selectors, block in re.findall(r'([^{}]+)\{([^{}]*)\}', text):
            for selector in selectors.split(','):
                steps = _steps(selector.strip())
                if steps is None:
                    self._leftOut['style rules with an unusual selector'] += 1
                else:
                    self._rules.append((_specificity(steps), steps, declarations(block)))

    def own(self, element: Element) -> dict[str, str]:
        """{property: value} of the element itself."""
        cascade = [(key, value, 0) for key, value in element.attrib.items()]
        cascade += [(key, value, 2 * isImportant + 1) for _, steps, block in self._rules
                    if self._matches(element, steps) for key, value, isImportant in block]
        cascade += [(key, value, 2 * isImportant + 1)
                    for key, value, isImportant in declarations(element.get('style', ''))]
        cascade.sort(key=lambda one: one[2])
        found = {}
        for key, value, _ in cascade:
            value = value.strip()
            for one in ('marker-start', 'marker-mid', 'marker-end') if key == 'marker' else (key,):
                if one not in _PAINTS or value == 'inherit' or isPaint(value):
                    found[one] = value
        return found

    def computed(self, element: Element, parent: Mapping[str, str]) -> dict[str, str]:
        """{property: value} with what the element inherits from `parent`, a dict like it."""
        style = {**_OWN, **{key: parent[key] for key in INITIAL}}
        for key, value in self.own(element).items():
            style[key] = parent.get(key, '') if value == 'inherit' else value
        for key in _PAINTS:
            style[key] = re.sub(r'\bcurrentcolor$', style['color'], style[key], flags=re.IGNORECASE)
        return style

    def around(self, element: Element) -> dict[str, str]:
        """What the element inherits from its own parents."""
        parent = self.parents.get(element)
        return INITIAL if parent is None else self.computed(parent, self.around(parent))

    def _matches(self, element, steps):
        """True if the element matches the last of the steps, and elements around it those before."""
        *before, (isChild, kind, ids, classes) = steps
        own = element.get('class', '').split()
        if kind not in ('', '*', tagOf(element)) or any(element.get('id') != one for one in ids) \
                or not all(one in own for one in classes):
            return False
        parent = self.parents.get(element)
        while before and parent is not None:
            if self._matches(parent, before):
                return True
            parent = None if isChild else self.parents.get(parent)
        return not before


def _steps(selector):
    """[(is a child of what is before, type, ids, classes)]; None for other selectors than those of types, ids and
    classes within each other."""
    steps, isChild = [], False
    for word in selector.replace('>', ' > ').split():
        if word == '>':
            isChild = True
            continue
        found = _COMPOUND.match(word)
        if not found:
            return None
        ids, classes = ([name[1:] for name in re.findall(r'[.#][^.#]+', found[2]) if name[0] == mark] for mark in '#.')
        steps.append((isChild, found[1] or '', ids, classes))
        isChild = False
    return steps if steps and not isChild else None


def _specificity(steps):
    return (sum(len(ids) for *_, ids, _ in steps), sum(len(classes) for *_, classes in steps),
            sum(kind not in ('', '*') for _, kind, *_ in steps))


def urlOf(value: str) -> str | None:
    """The id in url(#id), or None."""
    found = re.match(r'url\(\s*["\']?#([^"\')]+)["\']?\s*\)', value)
    return found[1].strip() if found else None


def isPaint(value: str) -> bool:
    return value.lower() in ('none', 'transparent', 'currentcolor', 'context-fill', 'context-stroke') \
        or value.startswith('url(') or colour(value) is not None


def colour(value: str) -> int | None:
    """0xrrggbbaa, or None if it is no colour."""
    from svgelements import Color
    value = value.strip().lower().partition(' icc-color')[0]
    try:
        found = Color.parse(value)
    except ValueError:  # svgelements accepts no fractions in rgb()
        found = 255
    black = re.match(r'black$|#0{3,4}$|#0{6}|#000f$|rgba?\(|hsla?\(', value)
    return None if found is None or found == 255 and not black else found & 0xffffffff


def isSeen(paint: str, opacity: str, ids: Mapping[str | None, Element]) -> bool:
    """True if a paint of that opacity leaves a trace."""
    if fraction(opacity) <= 0:
        return False
    if paint.startswith('url('):
        fallback = paint.partition(')')[2].strip()
        server = ids.get(urlOf(paint))
        if server is None or tagOf(server) not in _SERVERS:
            return bool(fallback) and isSeen(fallback, '1', ids)
        return tagOf(server) == 'pattern' or _hasStops(server, ids)
    found = colour(paint)
    return found is not None and found & 0xff > 0


def isPattern(paint: str, ids: Mapping[str | None, Element]) -> bool:
    server = ids.get(urlOf(paint))
    return server is not None and tagOf(server) == 'pattern'


def _hasStops(gradient, ids):
    """A gradient may refer to another one that has its colours."""
    known = []
    while gradient is not None and gradient not in known and tagOf(gradient) in _SERVERS:
        if any(tagOf(child) == 'stop' for child in gradient):
            return True
        known.append(gradient)
        gradient = ids.get(hrefOf(gradient)[1:])
    return False


def hrefOf(element: Element) -> str:
    return next((element.attrib[key] for key in _HREFS if key in element.attrib), '').strip()


def isWhite(paint: str) -> bool:
    return colour(paint) == _WHITE


def fraction(text: str) -> float:
    """An opacity: a number or a percentage; 1 for anything else."""
    try:
        return float(text[:-1]) / 100 if text.endswith('%') else float(text)
    except ValueError:
        return 1.
