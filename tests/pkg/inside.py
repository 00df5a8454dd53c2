"""Runs pytest inside the running yade: `scripts/yade -n -x tests/pkg/inside.py [pytest args]`.

Exits with pytest's code. Arguments that name tests are relative to tests/pkg. `--part 2/3` runs the
second of three parts of all files; every file is in one of them.
"""
import collections
import os
import signal
import sys

import pytest


class Part:
    """Pytest plugin: leaves the tests of `part` (from 1), of `parts`.

    A file is in one part as a whole, since its tests share fixtures. Files with many tests come
    first, each to the part that has the fewest tests so far.
    """

    def __init__(self, text):
        self.part, self.parts = (int(number) for number in text.split('/'))
        if not 1 <= self.part <= self.parts:
            raise ValueError(f'--part: there is no part {self.part} of {self.parts}.')

    def pytest_collection_modifyitems(self, config, items):
        counts = collections.Counter(str(item.path) for item in items)
        sums = [0] * self.parts
        mine = set()
        for path, count in sorted(counts.items(), key=lambda entry: (-entry[1], entry[0])):
            least = sums.index(min(sums))
            sums[least] += count
            if least == self.part - 1:
                mine.add(path)
        others = [item for item in items if str(item.path) not in mine]
        items[:] = [item for item in items if str(item.path) in mine]
        config.hook.pytest_deselected(items=others)


def main():
    here = os.path.dirname(os.path.abspath(sys.argv[0]))
    arguments = sys.argv[1:]
    os.chdir(here)
    plugins = []
    if '--part' in arguments:
        at = arguments.index('--part')
        plugins.append(Part(arguments[at + 1]))
        del arguments[at:at + 2]
    # A shell starts background jobs with interrupts ignored: tests of Ctrl-C would wait for ever.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    if not any(os.path.exists(a.split('::')[0]) for a in arguments if not a.startswith('-')):
        arguments.append(here)
    options = ['-q', '-p', 'no:cacheprovider', '--rootdir', here]
    code = int(pytest.main([*options, *arguments], plugins=plugins))
    sys.stdout.flush()
    sys.stderr.flush()
    return code


sys.exit(main())
