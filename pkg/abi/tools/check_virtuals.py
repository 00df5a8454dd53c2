#!/usr/bin/env python3
"""check_virtuals.py VERSION DUMP STAMP: checks the order of the virtual functions in pkg/abi.

DUMP is the output of g++ -fdump-lang-class for the declarations. The functions of each class must be
the first ones of YADE's class, in its order; for a class from which this project derives, all of
them. Writes STAMP if so; otherwise prints one line per difference and exits with 1.
"""

import pathlib
import re
import sys

import class_dump
import versions

ARCHIVES = versions.FOLDER.parent.parent / 'publish' / 'archives.hpp'


def derivedFrom():
    """YADE's classes from which classes of this project are derived."""
    return set(re.findall(r'ARCHIVES\(yade::(\w+)\)', ARCHIVES.read_text()))


def isSame(declared, measured):
    """A pure function has no name in the dump; its place follows from the classes that override
    it."""
    return declared in (measured, '__cxa_pure_virtual')


def firstDifference(functions, there):
    """Index of the first function that differs from the measured one; None if there is none."""
    return next((i for i, function in enumerate(functions)
                 if i >= len(there) or not isSame(function, there[i])), None)


def differences(declared, measured, complete):
    """One line for each table of `declared` that does not agree with the begin of the measured
    one."""
    for name, tables in sorted(declared.items()):
        wanted = measured.get(name, {}).get('virtuals', {})
        for at, functions in tables.items():
            there = wanted.get(at, [])
            place = firstDifference(functions, there)
            if name in measured and place is not None:
                yield '%s, base at byte %s, virtual function %d: declared %s, YADE has %s' % (
                    name, at, place, functions[place],
                    there[place] if place < len(there) else 'none')
            elif name in complete and len(functions) < len(there):
                yield '%s, base at byte %s: %s is not declared' % (name, at, there[len(functions)])
    for name in sorted(complete & set(measured)):
        if name not in declared:
            yield '%s is not in the dump' % name


def main(version, dump, stamp):
    declared = class_dump.readTables(pathlib.Path(dump).read_text())
    found = list(differences(declared, versions.read(version)['classes'], derivedFrom()))
    for line in found:
        print('pkg/abi differs from YADE %s: %s' % (version, line))
    if not found:
        pathlib.Path(stamp).touch()
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
