"""Where figures come from: machine, date and commit, to be written beside them."""
import os
import platform
import subprocess
import time

HERE = os.path.dirname(os.path.abspath(__file__))


def machine():
    """Processor and number of cores, as text."""
    with open('/proc/cpuinfo', encoding='utf-8') as info:
        names = [line.split(':')[1].strip() for line in info if line.startswith('model name')]
    return f'{names[0] if names else platform.machine()}, {os.cpu_count()} cores'


def date():
    """Today, e.g. '3 May 2026'."""
    return time.strftime('%-d %B %Y')


def commit():
    """Abbreviated hash of the commit, with '-dirty' if sources differ from it; 'unknown' without git."""
    try:
        # Pages and pictures are what scripts write: new ones do not make others dirty.
        written = [f':(top,exclude)*.{ending}' for ending in ('md', 'png', 'gif', 'csv')]
        changed = _git('diff', '--name-only', 'HEAD', '--', ':/', *written)
        return _git('rev-parse', '--short', 'HEAD') + '-dirty' * bool(changed)
    except (OSError, subprocess.CalledProcessError):
        return 'unknown'


def _git(*arguments):
    command = ['git', '-C', HERE, '-c', 'safe.directory=*', *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def line():
    """Machine, date and commit as text."""
    return f'{machine()}, {date()}, commit {commit()}'
