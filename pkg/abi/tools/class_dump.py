"""Reads the output of g++ -fdump-lang-class: the tables of virtual functions, by class.

A table is a list of function names in YADE's order, without classes and arguments; '~' is a
destructor, which has two entries. A class with a second base class has a second table; tables are
named by the byte at which their base begins: {'0': [...], '24': [...]}.
"""

import re


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
    # A call table has one function for each number of arguments; pkg/abi names them by that number.
    return re.sub(r'^(go|goReverse)\d$', r'\1', name)


def lastMangled(rest):
    """'getVolume' of '4yade5Shape9getVolumeEv'; '~' of '4yade5ShapeD1Ev'."""
    name = ''
    while rest and rest[0].isdigit():
        length = re.match(r'\d+', rest).group()
        begin = len(length)
        name, rest = rest[begin:begin + int(length)], rest[begin + int(length):]
    return '~' if re.match(r'D[012]E', rest) else re.sub(r'^(go|goReverse)\d$', r'\1', name)
