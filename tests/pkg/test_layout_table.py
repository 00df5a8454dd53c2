"""The layout table of pkg/abi against the measured facts, where those are at hand."""

import json
import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = ROOT / 'pkg' / 'abi' / 'layout.hpp'
CHECKS = ROOT / 'pkg' / 'abi' / 'layout_checks.cpp'
FACTS = ROOT.parent / 'shared' / 'yade-abi' / 'layout.json'


def table():
    """{(type, member): bytes}; an empty member stands for the size of the type."""
    rows = re.findall(r'\{"(\w+)", "(\w*)", (\d+)\}', TABLE.read_text())
    found = {(kind, member): int(size) for kind, member, size in rows}
    assert len(found) == len(rows), 'an entry stands twice'
    return found


def test_everyEntryIsCheckedByTheCompiler():
    text = CHECKS.read_text()
    checked = {(kind, '') for kind in re.findall(r'CHECK_SIZE\((\w+)\);', text)}
    checked |= set(re.findall(r'CHECK_MEMBER\((\w+), (\w+)\);', text))
    assert checked == set(table())


@pytest.mark.skipif(not FACTS.exists(), reason='no ../shared/yade-abi/layout.json')
def test_everyEntryIsTheMeasuredOne():
    facts = json.loads(FACTS.read_text())
    for (kind, member), size in table().items():
        if member:
            offsets = {name: offset for name, _type, offset in facts[kind]['members']}
            assert offsets[member] == size, (kind, member)
        else:
            assert facts[kind]['size'] == size, kind
