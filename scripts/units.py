"""Sources that can be compiled as one unit: python3 scripts/units.py MOST FILE..., one unit of at most MOST sources a
line, by `;`.

Most of the time of a file is spent on the headers that it includes. Several sources in one unit read
them once. They must not have private names in common.
"""
import functools
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FOLDERS = ('lib', 'pkg', 'tests')
PRIVATE = re.compile(r'^namespace \{\n(.*?)^\}  // namespace\n', re.M | re.S)
# What a line at the left margin defines: a type, a function, constants. Several sources may name the same
# `using yade::Vector3r;` or alias of a namespace.
DEFINITIONS = [re.compile(pattern, re.M) for pattern in (
    r'^(?:struct|class|enum class|enum) (\w+)', r'^using (\w+) =',
    r'^(?!using|return|namespace|[A-Z_]+\()\w[^(=\n]*?\b(\w+)\(',
    r'^(?=\w)(?!using |namespace )[^(;\n]*?\b(\w+)(?=(?:\[.*\])?(?: =|\{|;))',
    r'\b(k[A-Z]\w*)(?=(?:\[.*\])?(?: =|\{))')]
# The same alias may be defined twice.
ALIAS = re.compile(r'^using (\w+) =([^;]*);', re.M)
STATIC = re.compile(r'^(?:static .*?|int (?=main))(\w+)\(', re.M)
INCLUDE = re.compile(r'^#include "(.*)"', re.M)


def definedIn(text):
    """Names that the text defines at the left margin."""
    return {name for pattern in DEFINITIONS for name in pattern.findall(text)}


@functools.cache
def textOf(path):
    """The whole file."""
    with open(path) as file:
        return file.read()


def headersOf(path):
    """This project's headers that a file includes, and those that they include."""
    found, open_ = set(), [path]
    while open_:
        names = INCLUDE.findall(textOf(open_.pop()))
        paths = {os.path.join(ROOT, folder, name) for name in names for folder in FOLDERS}
        new = {path for path in paths - found if os.path.exists(path)}
        found |= new
        open_ += new
    return found


class Unit:
    """Sources with no private name that another source or its headers define, too."""

    def __init__(self, path=None):
        self.sources, self.private, self.own, self.seen, self.aliases = [], set(), set(), set(), {}
        if path:
            self.sources = [path]
            blocks = PRIVATE.findall(textOf(path))
            self.private = set(STATIC.findall(textOf(path))).union(*map(definedIn, blocks))
            self.aliases = dict(alias for block in blocks for alias in ALIAS.findall(block))
            self.seen = set().union(*(definedIn(textOf(header)) for header in headersOf(path)))
            self.own = self.private - self.seen  # the others are none: the source compiles alone

    def accepts(self, other):
        """True if both can be one unit."""
        equal = {name for name, meaning in self.aliases.items() if other.aliases.get(name) == meaning}
        return not ((self.private & other.private) - equal
                    or self.own & other.seen or other.own & self.seen)

    def add(self, other):
        """Take the sources of another unit."""
        self.sources += other.sources
        self.private |= other.private
        self.own |= other.own
        self.seen |= other.seen
        self.aliases.update(other.aliases)


def unitsOf(paths, most):
    """Lists of `most` sources or fewer."""
    units = []
    for path in sorted(paths):
        new = Unit(path)
        for unit in units:
            if len(unit.sources) < most and unit.accepts(new):
                unit.add(new)
                break
        else:
            units.append(new)
    return [unit.sources for unit in units]


if __name__ == '__main__':
    print('\n'.join(';'.join(sources) for sources in unitsOf(map(os.path.abspath, sys.argv[2:]), int(sys.argv[1]))))
