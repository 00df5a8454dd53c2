"""The sources of a turn of clang-tidy: python3 scripts/tidy_turn.py COMMITS FILE..., one path a line.

These are the sources that have changed in the last COMMITS commits or in the work tree; for each header that
has changed, and that none of these includes, one source that includes it; and a sixth of the others, which
take turns by the number of commits. All sources, where the history is too short (a shallow clone), git
fails, or the checks themselves have changed.
"""
import os
import subprocess
import sys
import zlib

from units import ROOT, headersOf

TURNS = 6


def git(*arguments):
    """Lines that git prints; CalledProcessError if it fails."""
    command = ['git', '-c', 'safe.directory=*', '-C', ROOT, *arguments]
    run = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return run.stdout.splitlines()


def history(commits):
    """(paths that have changed in the last commits, number of all commits); (None, 0) if it is not known."""
    try:
        if git('rev-parse', '--is-shallow-repository') != ['false']:
            return None, 0
        changed = git('diff', '--name-only', '--no-renames', f'HEAD~{commits}')
        return {os.path.join(ROOT, path) for path in changed}, int(git('rev-list', '--count', 'HEAD')[0])
    except (OSError, subprocess.CalledProcessError):
        return None, 0


def chosen(sources, changed, number):
    """The sources of this turn, in their order."""
    headers = {source: headersOf(source) for source in sources}
    taken = {source for source in sources
             if source in changed or zlib.crc32(os.path.relpath(source, ROOT).encode()) % TURNS == number % TURNS}
    open_ = (changed & set().union(*headers.values())).difference(*(headers[source] for source in taken))
    # The source that covers most of the changed headers first.
    while open_:
        best = max(sources, key=lambda source: len(headers[source] & open_))
        taken.add(best)
        open_ -= headers[best]
    return [source for source in sources if source in taken]


def main(commits, *names):
    sources = list(map(os.path.abspath, names))
    changed, number = history(commits)
    if changed is None or os.path.join(ROOT, '.clang-tidy') in changed:
        found = sources
    else:
        found = chosen(sources, changed, number)
    print(f'clang-tidy: {len(found)} of {len(sources)} sources, turn {number % TURNS + 1} of {TURNS}', file=sys.stderr)
    print('\n'.join(found))


if __name__ == '__main__':
    main(*sys.argv[1:])
