"""Which lines of C++ have run: python3 scripts/coverage.py BUILD FOLDER... [--missed]

BUILD is a build with YADEFRAG_COVERAGE whose programs have run; FOLDER are folders of sources, lib and pkg. A row
for each folder in them and one for their sum; with --missed the lines that have not run, too.
"""
import collections
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def countsOf(data):
    """[(file, line, count)] of this project's sources, as gcov knows them from one file of counts."""
    done = subprocess.run(['gcov', '--json-format', '--stdout', data], stdout=subprocess.PIPE, check=True,
                          cwd=data.parent)
    top = str(ROOT) + '/'
    return [(file['file'][len(top):], line['line_number'], line['count'])
            for text in done.stdout.splitlines() if text for file in json.loads(text)['files']
            if file['file'].startswith(top) for line in file['lines']]


def linesIn(build):
    """{file: {line: how often it ran}}, over all that was compiled."""
    lines = collections.defaultdict(collections.Counter)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for counts in pool.map(countsOf, sorted(pathlib.Path(build).absolute().rglob('*.gcda'))):
            for file, line, count in counts:
                lines[file][line] += count
    return lines


def row(name, counts):
    """A row of the table: lines, those that have run, and their part."""
    ran = sum(count > 0 for count in counts)
    return '%-24s %6d %6d %6.1f %%' % (name, len(counts), ran, 100 * ran / max(len(counts), 1))


def main(build, *more):
    """Print the table."""
    lines = linesIn(build)
    print('%-24s %6s %6s' % ('folder', 'lines', 'ran'))
    for top in (name for name in more if name != '--missed'):
        files = sorted(file for file in lines if file.startswith(top + '/'))
        for folder in sorted({os.path.dirname(file) for file in files}):
            print(row(folder, [c for f in files if os.path.dirname(f) == folder for c in lines[f].values()]))
        print(row(top, [c for f in files for c in lines[f].values()]))
        for file in files if '--missed' in more else ():
            missed = sorted(line for line, count in lines[file].items() if not count)
            if missed:
                print('%s: %s' % (file, ' '.join(map(str, missed))))


if __name__ == '__main__':
    main(*sys.argv[1:])
