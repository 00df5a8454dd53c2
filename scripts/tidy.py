"""clang-tidy on the sources named as arguments: python3 scripts/tidy.py FOLDER JOBS FILE...

FOLDER has compile_commands.json. Several sources are checked as one unit that includes all of them
(units.py), and if there is any finding, each of its sources is checked alone: only these findings
count. A unit without findings is not checked again until a file of this project in it, its command,
the checks or clang-tidy change.
"""
import collections
import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys

from units import ROOT, headersOf, textOf, unitsOf

MOST = 16  # sources in a unit: the checks spend most of their time on the headers


def byCommand(commands):
    """Lists of sources with the same compile command, each one unit."""
    groups = collections.defaultdict(list)
    for path in commands:
        groups[re.sub(r' -o \S+ -c \S+', '', commands[path]['command'])].append(path)
    return [sources for paths in groups.values() for sources in unitsOf(paths, MOST)]


def tidy(folder, path):
    """(fine, output) of clang-tidy on one file."""
    command = ['clang-tidy', '--quiet', '--warnings-as-errors=*', '-p', folder, path]
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return run.returncode == 0, run.stdout


def digestOf(sources, command):
    """Of all that the findings in a unit depend on, but for the headers of the system."""
    paths = sorted(set(sources).union(*map(headersOf, sources), [os.path.join(ROOT, '.clang-tidy')]))
    texts = [command, subprocess.run(['clang-tidy', '--version'], stdout=subprocess.PIPE, text=True).stdout]
    return hashlib.sha1('\0'.join(texts + paths + list(map(textOf, paths))).encode()).hexdigest()


def checkUnit(number, sources, folder, units, command):
    """Outputs of the sources with findings."""
    fine = os.path.join(units, digestOf(sources, command) + '.fine')
    path = os.path.join(units, f'{number}.cpp')
    if os.path.exists(fine):
        return []
    results = []
    if len(sources) == 1 or not tidy(units, path)[0]:
        results = [tidy(folder, source) for source in sources]
    found = [output for good, output in results if not good]
    if not found:
        open(fine, 'w').close()
    return found


def writeUnits(groups, commands, units):
    """The units, and their compile commands."""
    os.makedirs(units, exist_ok=True)
    entries = []
    for number, sources in enumerate(groups):
        path = os.path.join(units, f'{number}.cpp')
        with open(path, 'w') as file:
            file.writelines(f'#include "{source}"  // NOLINT\n' for source in sources)
        first = commands[sources[0]]
        entries.append(dict(directory=first['directory'], file=path,
                            command=first['command'].replace(sources[0], path)))
    with open(os.path.join(units, 'compile_commands.json'), 'w') as file:
        json.dump(entries, file)


def main(folder, jobs, *wanted):
    """Exit status: 1 if there is a finding."""
    with open(os.path.join(folder, 'compile_commands.json')) as file:
        known = {entry['file']: entry for entry in json.load(file)}
    # A source without a compile command (pkg/ where there is no yade) cannot be checked.
    commands = {path: known[path] for path in map(os.path.abspath, wanted) if path in known}
    groups = byCommand(commands)
    units = os.path.join(folder, 'tidy')
    writeUnits(groups, commands, units)
    # YADE's headers take longest: first.
    order = sorted(range(len(groups)), key=lambda n: '/pkg/' not in groups[n][0])
    with concurrent.futures.ThreadPoolExecutor(int(jobs)) as pool:
        found = list(pool.map(
            lambda n: checkUnit(n, groups[n], folder, units, commands[groups[n][0]]['command']), order))
    for outputs in found:
        print(''.join(outputs), end='')
    return int(any(found))


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
