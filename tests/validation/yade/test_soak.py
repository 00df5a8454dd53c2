"""Memory stays as it is over scenes that crack, are saved, loaded and changed, one after another."""
import json
import os
import subprocess

from project import yadeCommand

kHere = os.path.dirname(os.path.abspath(__file__))


def test_memoryStays():
    done = subprocess.run([*yadeCommand(), os.path.join(kHere, 'soak_scene.py'), '20'],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=640)
    lines = [line for line in done.stdout.splitlines() if line.startswith('@@@ ')]
    assert done.returncode == 0 and lines, done.stdout[-1500:] + done.stderr[-1500:]
    result = json.loads(lines[-1][4:])
    assert min(result['cracks']) > 0
    used = result['memory']
    # The first third fills what is kept permanently: imports, pools of threads, tables of classes.
    warm = max(used[:len(used) // 3])
    print('%d rounds, %d kB after the first third, %d kB at the end' % (len(used), warm, used[-1]))
    assert used[-1] < 1.01 * warm
