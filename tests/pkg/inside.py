"""Runs pytest inside the running yade: `scripts/yade -n -x tests/pkg/inside.py [pytest args]`.

Exits with pytest's code. Arguments that name tests are relative to tests/pkg; the folder of a file, also
those of ../validation, may be left out. Without names, all that take long are left out: those marked `long`. With `--long`
only they are run, and tests/validation/yade. With `--shared FOLDER`, processes that are started with the same empty
folder run each file once. YADEFRAG_SHARE=2/3 runs the second of three shares of the tests.
"""
import glob
import os
import signal
import sys

import pytest
from _pytest.runner import runtestprotocol


# They take half a minute or more: begun last, one of them would run alone.
kLongest = ['test_long_examples.py', 'test_axisymmetric_theory.py', 'test_taylor.py', 'test_yade_own.py', 'test_memory.py',
            'test_mpi.py', 'test_same_bits.py', 'test_laws.py', 'test_tradeoff.py', 'test_forms.py', 'test_fe_examples.py']


class Shared:
    """Pytest plugin: of the files that several processes collect, each runs those that it takes first.

    A file that is taken has an empty file of its name, which no other file of tests has, in `folder`. A file
    is taken as a whole, since its tests share fixtures.
    """

    def __init__(self, folder):
        self.folder = folder
        self.mine = {}

    def take(self, file):
        try:
            os.close(os.open(os.path.join(self.folder, file.name), os.O_CREAT | os.O_EXCL))
        except FileExistsError:
            return False
        return True

    def pytest_collection_modifyitems(self, items):
        """The files of kLongest first, in its order."""
        rank = {name: number for number, name in enumerate(kLongest)}
        items.sort(key=lambda item: rank.get(item.path.name, len(rank)))

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item, nextitem):
        if item.path not in self.mine:
            self.mine[item.path] = self.take(item.path)
        if not self.mine[item.path]:
            return True  # nothing else has to be done for this test
        if nextitem is None or nextitem.path == item.path:
            return None
        # The next item may be another process's: this one leaves nothing set up for it.
        item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
        runtestprotocol(item, nextitem=None)
        item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
        return True


class Long:
    """Pytest plugin: of the tests that are collected those that take long, or the others."""

    def __init__(self, only):
        self.only = only

    def pytest_collection_modifyitems(self, config, items):
        parts = {True: [], False: []}
        for item in items:
            parts[item.get_closest_marker('long') is not None or 'validation' in item.path.parts].append(item)
        config.hook.pytest_deselected(items=parts[not self.only])
        items[:] = parts[self.only]


class Share:
    """Pytest plugin: of the tests that are left the share `2/3`."""

    def __init__(self, share):
        self.number, self.count = map(int, share.split('/'))

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, config, items):
        mine = items[self.number - 1::self.count]
        config.hook.pytest_deselected(items=[item for item in items if item not in mine])
        items[:] = mine


def located(argument):
    """The argument, with the folder of the file of tests that it names."""
    file, *test = argument.split('::')
    found = []
    if file.endswith('.py') and not os.path.exists(file):
        found = glob.glob('*/' + file) + glob.glob('../validation/*/' + file)
    return '::'.join(found + test) if found else argument


def main():
    here = os.path.dirname(os.path.abspath(sys.argv[0]))
    arguments = sys.argv[1:]
    os.chdir(here)
    plugins = []
    if '--shared' in arguments:
        at = arguments.index('--shared')
        plugins.append(Shared(arguments[at + 1]))
        del arguments[at:at + 2]
    # A shell starts background jobs with interrupts ignored: tests of Ctrl-C would wait for ever.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    arguments = [located(argument) for argument in arguments]
    only = '--long' in arguments
    if only:
        arguments.remove('--long')
        arguments += [here, '../validation/yade']
    named = any(os.path.exists(a.split('::')[0]) for a in arguments if not a.startswith('-'))
    if only or not named:
        plugins.append(Long(only))
    if not named:
        arguments.append(here)
    if 'YADEFRAG_SHARE' in os.environ:
        plugins.append(Share(os.environ['YADEFRAG_SHARE']))
    options = ['-q', '-o', 'markers=long: takes long', '-p', 'no:cacheprovider', '--rootdir', os.path.dirname(here), '--durations=20',
               '--durations-min=10',
               # A test that hangs ends the process with the stacks of its threads.
               '--timeout=1200', '--timeout-method=thread']
    code = int(pytest.main([*options, *arguments], plugins=plugins))
    sys.stdout.flush()
    sys.stderr.flush()
    return code


sys.exit(main())
