"""figures.py TESTS...: runs the tests of these programs that record figures, and writes these to docs/data/figures.csv.

Only suites whose sources record a figure are run. If a test fails, all is left as it is.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import measured_tables
import validation_table

ROOT = pathlib.Path(__file__).resolve().parents[2]


def suites():
    """Names of the suites in the sources that record figures."""
    sources = [path.read_text() for path in (ROOT / 'tests').rglob('*.cpp')]
    recording = [text for text in sources if re.search(r'\b(figure|record|RecordProperty)\(', text)]
    return sorted({name for text in recording for name in re.findall(r'^TEST(?:_P|_F)?\((\w+)', text, re.M)})


def recorded(file):
    """A row for each figure in GoogleTest's XML."""
    for case in xml.etree.ElementTree.parse(file).iter('testcase'):
        for figure in case.iter('property'):
            yield {'test': f'{case.get("classname")}.{case.get("name")}', 'figure': figure.get('name'),
                   'value': figure.get('value')}


def main(*programs):
    where = measured_tables.origin.line()
    patterns = ':'.join(f'{name}.*:*/{name}.*' for name in suites())
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, 'figures.xml')
        for program in programs:
            command = [program, f'--gtest_filter={patterns}', f'--gtest_output=xml:{file}', '--gtest_brief=1']
            subprocess.run(command, check=True)
            rows += recorded(file)
    validation_table.require(rows)
    measured_tables.write('figures', f'{where}, `scripts/bench figures`', rows)
    print(f'docs/data/figures.csv has {len(rows)} figures.')


if __name__ == '__main__':
    main(*sys.argv[1:])
