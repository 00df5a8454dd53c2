"""times.py NAME COMMAND...: runs a command, and stores its seconds in docs/data/times.csv and on the pages.

    python3 tests/benchmark/times.py impact scripts/impact

NAME is one of TIMES in measured_tables.py. For a true figure: an idle machine, a fresh clone and CCACHE_DISABLE=1.
R is the processor time of a file that includes Boost.Python, Boost's serialization and Eigen: the unit of processor times.
"""
import resource
import subprocess
import sys
import time

import measured_tables

UNIT = '#include <boost/python.hpp>\n#include <boost/serialization/vector.hpp>\n#include <Eigen/Dense>\n'


def run(command, **more):
    """(wall, processor) seconds of a command with all its processes."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, check=True, **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.monotonic() - start, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def unit():
    """Processor seconds of one unit R."""
    python = f'-I/usr/include/python3.{sys.version_info[1]}'
    command = ['/usr/bin/g++', '-std=c++20', '-O1', '-c', '-x', 'c++', '-', '-o', '/dev/null', python, '-I/usr/include/eigen3']
    return run(command, input=UNIT, text=True)[1]


def main(name, *command):
    if name not in measured_tables.TIMES:
        sys.exit(f'times.py: no name {name!r}; there are {", ".join(measured_tables.TIMES)}.')
    wall, processor = run(command)
    row = {'command': name, 'wall': f'{wall:.0f}', 'processor': f'{processor:.0f}', 'R': f'{processor / unit():.0f}'}
    others = {one['command']: one for one in measured_tables.read('times')[1]}
    rows = [row if other == name else one for other, one in others.items()]
    measured_tables.write('times', f'{measured_tables.origin.line()}, `tests/benchmark/times.py`', rows)


if __name__ == '__main__':
    main(*sys.argv[1:])
