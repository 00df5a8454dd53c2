"""Instructions counted by callgrind, by object, file, line and function.

`count(command, folder)` runs a command and returns one list of `Cost` per dump.
"""
import collections
import glob
import os
import re
import subprocess

Cost = collections.namedtuple('Cost', 'object file line function instructions')

# Python's and OpenMP's ways to differ from run to run are taken away.
kCalm = dict(PYTHONHASHSEED='0', OMP_WAIT_POLICY='passive', OMP_NUM_THREADS='1')


def count(command, folder, timeout=600):
    """(what the command printed, [[Cost]]): its client requests determine what is counted.

    Raises RuntimeError with the end of its output if it fails."""
    out = os.path.join(folder, 'callgrind.out')
    done = subprocess.run(
        ['valgrind', '--tool=callgrind', '--instr-atstart=no', '--compress-strings=no',
         '--compress-pos=no', f'--callgrind-out-file={out}', *command],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=timeout,
        env=dict(os.environ, **kCalm), check=False)
    if done.returncode:
        raise RuntimeError((done.stdout + done.stderr)[-1500:])
    paths = sorted(glob.glob(out + '.*'), key=lambda path: int(path.rsplit('.', 1)[1])) + [out]
    dumps = [costs for costs in map(read, paths) if costs]
    for path in paths:
        os.remove(path)
    return done.stdout, dumps


def read(path):
    """[Cost] of one of callgrind's files: what each line itself cost, not what it called."""
    sums = collections.Counter()
    place = dict(ob='', fl='', fi='', fn='')
    skip = False
    with open(path, encoding='utf-8') as file:
        for text in file:
            if text[0].isdigit():
                if not skip:
                    line, instructions = text.split()[:2]
                    sums[place['ob'], place['fi'], int(line), place['fn']] += int(instructions)
                skip = False
                continue
            key, _, value = text.rstrip('\n').partition('=')
            if key == 'calls':
                skip = True     # the next line is what the call cost
            elif key in ('fl', 'fi', 'fe'):
                place['fi'] = value
            elif key in ('ob', 'fn'):
                place[key] = value
    return [Cost(*where, instructions) for where, instructions in sums.items()]


def total(costs):
    """Instructions in all."""
    return sum(cost.instructions for cost in costs)


class Feature:
    """Code that belongs to something a scene may use: whole files, functions, and lines that name
    it; a line that does counts as a whole.

    files     pattern of paths below lib/
    lines     pattern of source lines below lib/
    within    pattern of the files in which lines are looked at
    functions pattern of functions, wherever they are
    without   pattern of functions that are compiled without the feature
    """

    def __init__(self, root, files='^$', lines='^$', within='.', functions='^$', without='^$'):
        self._lib = os.path.join(root, 'lib') + os.sep
        self._files, self._lines, self._within, self._functions, self._without = map(
            re.compile, (files, lines, within, functions, without))
        self._sources = {}

    def has(self, cost):
        """Does a cost belong to the feature."""
        if self._functions.search(cost.function):
            return True
        if not cost.file.startswith(self._lib) or self._without.search(cost.function):
            return False
        path = cost.file[len(self._lib):]
        if self._files.search(path):
            return True
        return bool(self._within.search(path) and self._lines.search(self._line(cost)))

    def share(self, costs):
        """Its part of all instructions."""
        return total(filter(self.has, costs)) / total(costs)

    def _line(self, cost):
        if cost.file not in self._sources:
            with open(cost.file, encoding='utf-8') as file:
                self._sources[cost.file] = file.read().split('\n')
        lines = self._sources[cost.file]
        return lines[cost.line - 1] if 0 < cost.line <= len(lines) else ''
