"""figures.py TESTS: runs the tests that record figures, and writes these to out/bench/figures.md.

Only suites whose sources record a figure are run. Those in the tables of README.md go there. If a test
fails, all is left as it is.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'examples'))
import origin  # noqa: E402

import measured_tables  # noqa: E402

PAGE = ROOT / 'out' / 'bench' / 'figures.md'
HEAD = '''# Figures

Values that the tests of `lib/` record; the tests, below `tests/`, explain each of them and its tolerance.

'''


def suites():
    """Names of the suites in the sources that record figures."""
    sources = [path.read_text() for path in (ROOT / 'tests').rglob('*.cpp')]
    recording = [text for text in sources if re.search(r'\b(figure|record|RecordProperty)\(', text)]
    return sorted({name for text in recording for name in re.findall(r'^TEST(?:_P|_F)?\((\w+)', text, re.M)})


def recorded(file):
    """(test, figure, value) of each figure in GoogleTest's XML."""
    for case in xml.etree.ElementTree.parse(file).iter('testcase'):
        for figure in case.iter('property'):
            yield f'{case.get("classname")}.{case.get("name")}', figure.get('name'), figure.get('value')


def page(rows, where):
    """The page, with the name of each test once."""
    lines, last = ['| test | figure | value |', '|---|---|--:|'], None
    for test, figure, value in rows:
        lines.append(f'| {test if test != last else ""} | {figure.replace("_", " ")} | {value} |')
        last = test
    return HEAD + '\n'.join(lines) + f'\n\n`scripts/bench figures`: {where}.\n'


def main(tests):
    where = origin.line()
    patterns = ':'.join(f'{name}.*:*/{name}.*' for name in suites())
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, 'figures.xml')
        command = [tests, f'--gtest_filter={patterns}', f'--gtest_output=xml:{file}', '--gtest_brief=1']
        subprocess.run(command, check=True)
        rows = list(recorded(file))
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(page(rows, where))
    measured_tables.keep('figures', dict(about=where, values=measured_tables.used(rows)))
    print(f'{PAGE.relative_to(ROOT)} has {len(rows)} figures.')


if __name__ == '__main__':
    main(sys.argv[1])
