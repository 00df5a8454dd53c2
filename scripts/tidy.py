"""clang-tidy on the sources named as arguments: python3 scripts/tidy.py FOLDER JOBS FILE...

FOLDER has compile_commands.json. Most of the time of a file is spent on the headers that it
includes. Therefore several sources are checked as one unit that includes all of them, and if there
is any finding, each of its sources is checked alone: only these findings count.
"""
import collections
import concurrent.futures
import functools
import json
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FOLDERS = ('lib', 'pkg', 'tests')
MOST = 8  # sources in a unit: more save little, and both cores should have work to the end
PRIVATE = re.compile(r'^namespace \{\n(.*?)^\}  // namespace\n', re.M | re.S)
# What a line at the left margin defines: a type, a function, constants.
DEFINITIONS = [re.compile(pattern, re.M) for pattern in (
    r'^(?:struct|class|enum class|enum|using) (\w+)',
    r'^(?!using|return|namespace|[A-Z_]+\()\w[^(\n]*?\b(\w+)\(',
    r'^(?=\w)[^(;\n]*?\b(\w+)(?=(?:\[.*\])?(?: =|\{|;))',
    r'\b(k[A-Z]\w*)(?=(?:\[.*\])?(?: =|\{))')]
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
        self.sources, self.private, self.own, self.seen = [], set(), set(), set()
        if path:
            self.sources = [path]
            self.private = set(STATIC.findall(textOf(path))).union(
                *map(definedIn, PRIVATE.findall(textOf(path))))
            self.seen = set().union(*(definedIn(textOf(header)) for header in headersOf(path)))
            self.own = self.private - self.seen  # the others are none: the source compiles alone

    def accepts(self, other):
        """True if both can be one unit."""
        return len(self.sources) < MOST and not (
            self.private & other.private or self.own & other.seen or other.own & self.seen)

    def add(self, other):
        """Take the sources of another unit."""
        self.sources += other.sources
        self.private |= other.private
        self.own |= other.own
        self.seen |= other.seen


def unitsOf(commands):
    """Lists of sources with the same compile command."""
    byCommand = collections.defaultdict(list)
    for path in sorted(commands):
        units = byCommand[re.sub(r' -o \S+ -c \S+', '', commands[path]['command'])]
        new = Unit(path)
        for unit in units:
            if unit.accepts(new):
                unit.add(new)
                break
        else:
            units.append(new)
    return [unit.sources for units in byCommand.values() for unit in units]


def tidy(folder, path):
    """(fine, output) of clang-tidy on one file."""
    command = ['clang-tidy', '--quiet', '--warnings-as-errors=*', '-p', folder, path]
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return run.returncode == 0, run.stdout


def checkUnit(number, sources, folder, units):
    """Outputs of the sources with findings."""
    if len(sources) > 1:
        path = os.path.join(units, f'{number}.cpp')
        if tidy(units, path)[0]:
            return []
    results = [tidy(folder, source) for source in sources]
    return [output for fine, output in results if not fine]


def writeUnits(groups, commands, units):
    """The units, and their compile commands."""
    os.makedirs(units, exist_ok=True)
    entries = []
    for number, sources in enumerate(groups):
        path = os.path.join(units, f'{number}.cpp')
        with open(path, 'w') as file:
            file.writelines(f'#include "{source}"  // NOLINT\n' for source in sources)
        first = commands[sources[0]]
        entries.append(dict(directory=first['directory'], file=path,
                            command=first['command'].replace(sources[0], path)))
    with open(os.path.join(units, 'compile_commands.json'), 'w') as file:
        json.dump(entries, file)


def main(folder, jobs, *wanted):
    """Exit status: 1 if there is a finding."""
    with open(os.path.join(folder, 'compile_commands.json')) as file:
        known = {entry['file']: entry for entry in json.load(file)}
    # A source without a compile command (pkg/ where there is no yade) cannot be checked.
    commands = {path: known[path] for path in map(os.path.abspath, wanted) if path in known}
    groups = unitsOf(commands)
    units = os.path.join(folder, 'tidy')
    writeUnits(groups, commands, units)
    # YADE's headers take longest: first.
    order = sorted(range(len(groups)), key=lambda n: '/pkg/' not in groups[n][0])
    with concurrent.futures.ThreadPoolExecutor(int(jobs)) as pool:
        found = list(pool.map(lambda n: checkUnit(n, groups[n], folder, units), order))
    for outputs in found:
        print(''.join(outputs), end='')
    return int(any(found))


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
