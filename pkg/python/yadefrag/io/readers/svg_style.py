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


def tagOf(element: Element) -> str:
    """The name without SVG's namespace; '' for comments and elements of other namespaces."""
    if not isinstance(element.tag, str):
        return ''
    space, _, tag = element.tag.rpartition('}')
    return tag if space in ('', '{http://www.w3.org/2000/svg') else ''


class Sheets:
    """The style sheets of a document, by tinycss2 and cssselect2."""

    def __init__(self, root: Element, leftOut: Counter[str]) -> None:
        import cssselect2
        import tinycss2
        self._css, self._select = tinycss2, cssselect2
        self._rules, self._leftOut = self._select.Matcher(), leftOut
        self._known = {one.etree_element: one for one in self._select.ElementWrapper.from_xml_root(root).iter_subtree()}
        for element in root.iter():
            if tagOf(element) == 'style' and element.get('type', 'text/css') in ('text/css', ''):
                self._read(self._css.parse_stylesheet(''.join(element.itertext()), skip_comments=True))

    def _read(self, rules):
        for rule in rules:
            if rule.type == 'at-rule' and rule.lower_at_keyword == 'import':
                self._leftOut['imported style sheets'] += 1
            elif rule.type == 'at-rule' and rule.lower_at_keyword == 'media' and rule.content and \
                    re.search(r'^\s*$|\b(all|screen)\b', self._css.serialize(rule.prelude)):
                self._read(self._css.parse_rule_list(rule.content, skip_comments=True))
            elif rule.type == 'qualified-rule':
                try:
                    for selector in self._select.compile_selector_list(rule.prelude):
                        self._rules.add_selector(selector, self._declarations(rule.content))
                except self._select.SelectorError:
                    self._leftOut['style rules with an unusual selector'] += 1

    def _declarations(self, content):
        """[(property, value, level in the cascade)]."""
        return [(one.lower_name, self._css.serialize([part for part in one.value if part.type != 'comment']),
                 2 * one.important + 1) for one in self._css.parse_declaration_list(content) if
                one.type == 'declaration']

    def own(self, element: Element) -> dict[str, str]:
        """{property: value} of the element itself."""
        cascade = [(key, value, 0) for key, value in element.attrib.items()]
        for _, _, pseudo, block in self._rules.match(self._known[element]):
            cascade += block if pseudo is None else []
        cascade += self._declarations(element.get('style', ''))
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
        parent = self._known[element].parent
        return INITIAL if parent is None else self.computed(parent.etree_element, self.around(parent.etree_element))


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
