"""Runs the commands of README.md literally: python3 scripts/readme.py [--list] [--without WORDS]...

These are the lines of its code blocks that begin with `scripts/`, in the order of the page, each once. --list prints
them with what is not run: commands that install something, change the folder, or fetch the project. --without leaves
out those that begin with these words. Exits with 1 if a command fails, and prints the time of each.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
SHELL = ('', 'sh', 'bash', 'shell', 'console')  # languages of blocks with commands


def commands(text):
    """Commands in the code blocks of a page, each once; an indented line is one, too."""
    found, language = [], None
    for line in text.splitlines():
        if line.startswith('```'):
            language = line[3:].strip() if language is None else None
        elif language in SHELL or (language is None and line.startswith('    ')):
            found.append(re.sub(r'(^|\s+)#.*', '', line).strip().removeprefix('$ '))
    return list(dict.fromkeys(filter(None, found)))


def isOurs(command):
    """Is it one of the project's own, which is run here."""
    return command.startswith('scripts/')


def main():
    """Run or list them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--list', action='store_true')
    parser.add_argument('--without', action='append', default=[], metavar='WORDS')
    options = parser.parse_args()
    found = commands((ROOT / 'README.md').read_text())
    chosen = [one for one in found if isOurs(one) and not one.startswith(tuple(options.without) or '\n')]
    if options.list:
        print(*(('' if one in chosen else '# ') + one for one in found), sep='\n')
        return 0
    results = []
    for command in chosen:
        print('==', command, flush=True)
        start = time.monotonic()
        done = subprocess.run(['bash', '-c', command], cwd=ROOT, check=False)
        results.append((command, done.returncode, time.monotonic() - start))
    print('== commands of README.md')
    for command, code, seconds in results:
        print(f'{command} : {"fine" if code == 0 else "FAILED"}, {seconds:.0f} s')
    return int(not results or any(code for _, code, _ in results))


if __name__ == '__main__':
    sys.exit(main())
