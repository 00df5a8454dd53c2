#!/usr/bin/env python3
"""check_virtuals.py VERSION DUMP STAMP: checks the order of the virtual functions in pkg/yade.

DUMP is the output of g++ -fdump-lang-class for the declarations. The functions of each class must be
the first ones of YADE's class, in its order; for a class from which this project derives, all of
them. Writes STAMP if so; otherwise prints one line per difference and exits with 1.

A table is a list of function names in YADE's order, without classes and arguments; '~' is a
destructor, which has two entries. A class with a second base class has a second table; tables are
named by the byte at which their base begins: {'0': [...], '24': [...]}.
"""

import pathlib
import re
import sys

import versions

ARCHIVES = versions.FOLDER.parent / 'archives.hpp'


def readTables(dump):
    """{class: {byte: [name, ...]}} for the classes of namespace yade in the text of a dump."""
    tables, current = {}, None
    for line in dump.splitlines():
        title = re.match(r'Vtable for yade::(\w+)$', line)
        if title:
            current = tables.setdefault(title.group(1), {})
            continue
        entry = re.match(r'\d+\s+(.*)$', line)
        if current is None or line.startswith('yade::'):
            continue
        if entry:
            addSlot(current, entry.group(1))
        else:
            current = None
    return tables


def addSlot(table, text):
    text = re.sub(r'^\(int \(\*\)\(\.\.\.\)\)', '', text)
    if re.fullmatch(r'-?\d+', text):  # offset of the object's begin from this base, unsigned
        number = int(text)
        offset = 2**64 - number if number >= 2**63 else -number
        table[str(offset)] = []
    elif not text.startswith('(& _ZTI'):
        table[list(table)[-1]].append(functionName(text))


def functionName(text):
    """'getClassIndex' of 'yade::Shape::getClassIndex' or of the mangled name of its thunk."""
    thunk = re.search(r'_ZThn\d+_NK?(\w+)$', text)
    if thunk:
        return lastMangled(thunk.group(1))
    text = re.sub(r' ?\[with .*', '', text)
    while re.search(r'<[^<>]*>', text):
        text = re.sub(r'<[^<>]*>', '', text)
    name = text.rsplit('::', 1)[-1]
    if '~' in name:
        return '~'
    # A call table has one function for each number of arguments; pkg/yade names them by that number.
    return re.sub(r'^(go|goReverse)\d$', r'\1', name)


def lastMangled(rest):
    """'getVolume' of '4yade5Shape9getVolumeEv'; '~' of '4yade5ShapeD1Ev'."""
    name = ''
    while rest and rest[0].isdigit():
        length = re.match(r'\d+', rest).group()
        begin = len(length)
        name, rest = rest[begin:begin + int(length)], rest[begin + int(length):]
    return '~' if re.match(r'D[012]E', rest) else re.sub(r'^(go|goReverse)\d$', r'\1', name)


def derivedFrom():
    """YADE's classes from which classes of this project are derived."""
    return set(re.findall(r'ARCHIVES\(yade::(\w+)\)', ARCHIVES.read_text()))


def firstDifference(functions, there):
    """Index of the first function that differs from the measured one; None if there is none. A pure function has no
    name in the dump; its place follows from the classes that override it."""
    return next((i for i, function in enumerate(functions)
                 if i >= len(there) or function not in (there[i], '__cxa_pure_virtual')), None)


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
    declared = readTables(pathlib.Path(dump).read_text())
    found = list(differences(declared, versions.read(version)['classes'], derivedFrom()))
    for line in found:
        print('pkg/yade differs from YADE %s: %s' % (version, line))
    if not found:
        pathlib.Path(stamp).touch()
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
