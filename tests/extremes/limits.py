"""limits.py TESTS VALIDATION ARGS: runs the tests of the extremes in both programs, ARGS as GoogleTest takes them, and
writes the limits that they measure into docs/limits.md."""

import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'examples'))
import origin  # noqa: E402

BEGIN, END = '<!-- limits', '<!-- end of limits -->'


def name(line):
    return line.split('|')[1].strip()


def measured(programs, arguments):
    """Rows by name."""
    with tempfile.TemporaryDirectory() as folder:
        for program in programs:
            subprocess.run([program, '--gtest_filter=Extreme*:*/Extreme*:Limits*-LimitsTable*', *arguments],
                           env={**os.environ, 'YADEFRAG_LIMITS': folder, 'YADEFRAG_LONG': '1'}, check=True)
        lines = [path.read_text() for path in sorted(pathlib.Path(folder).glob('*.row'))]
    return {name(line): line for line in lines}


def rewrite(text, rows, where):
    """The page with these rows in place of those of the same names; new ones come last. `where` is
    written below the table."""
    before, rest = text.split(BEGIN, 1)
    table, after = rest.split(END, 1)
    lines = table.splitlines(keepends=True)
    known = [i for i, line in enumerate(lines) if line.startswith('|')][2:]
    for i in known:
        lines[i] = rows.pop(name(lines[i]), lines[i])
    end = known[-1] + 1 if known else len(lines)
    lines[end:] = [*rows.values(), f'\n`scripts/bench limits`: {where}.\n']
    return before + BEGIN + ''.join(lines) + END + after


if __name__ == '__main__':
    readme = ROOT / 'docs' / 'limits.md'
    rows = measured(sys.argv[1:3], sys.argv[3:])
    readme.write_text(rewrite(readme.read_text(), rows, origin.line()))
    print('docs/limits.md is rewritten.')
