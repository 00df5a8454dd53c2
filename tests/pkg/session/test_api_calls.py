"""Thousands of calls of all that is public with wrong values, seeded, each batch in a yade of its own.

YADEFRAG_API_SECONDS: for how long (30).
"""
import os
import re
import subprocess
import time

import pytest

from project import yadeCommand

kSeconds = float(os.environ.get('YADEFRAG_API_SECONDS', '30'))
kCalls = 200  # of a batch
kLimit = 300  # s for a batch


def batch(seed, log):
    """(numbers of calls that succeeded and were refused, list of what was found)."""
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'api_calls.py')
    ended = 'it hung'
    try:
        run = subprocess.run([*yadeCommand(), script, str(seed), str(kCalls), log], capture_output=True,
                             timeout=kLimit, text=True, errors='replace')
        ended = 'the process ended with %d: %s' % (run.returncode, run.stderr[-500:])
    except subprocess.TimeoutExpired:
        pass
    with open(log, errors='replace') as file:
        lines = file.read().splitlines()
    found = ['%s -> %s' % (call, line) for call, line in zip(lines, lines[2:])
             if line.startswith('FOUND')]
    end = re.fullmatch(r'END (\d+) succeeded, (\d+) refused', lines[-1] if lines else '')
    if not end:
        found.append('%s -> %s' % (lines[-1] if lines else 'no call', ended))
    return ([int(n) for n in end.groups()] if end else [0, 0]), ['seed %d: %s' % (seed, f) for f in found]


@pytest.mark.long
def test_everyCallIsAnsweredBySuccessOrASentence(folder):
    end, seed, found, counts = time.monotonic() + kSeconds, 1, [], [0, 0]
    while time.monotonic() < end:
        done, wrong = batch(seed, folder + '/log')
        counts = [a + b for a, b in zip(counts, done)]
        found += wrong
        seed += 1
    print('%d calls succeeded, %d were refused, in %d batches' % (*counts, seed - 1))
    assert not found, '\n'.join(found)
    assert counts[1] > counts[0] / 4 > 0
