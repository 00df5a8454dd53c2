"""yade -j1 and -j2: the same interactions in the same order, and the same positions."""
import functools
import json
import os
import subprocess

import pytest

from project import yadeCommand

kHere = os.path.dirname(os.path.abspath(__file__))


@functools.cache
def dump(name, scene, threads):
    """What threads_scene.py prints: {'interactions': [...], 'positions': [...]} per moment."""
    done = subprocess.run(
        yadeCommand() + [f'-j{threads}', os.path.join(kHere, 'threads_scene.py'), name, scene],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600)
    lines = [x for x in done.stdout.splitlines() if x.startswith('@@@ ')]
    assert done.returncode == 0 and lines, done.stdout[-1500:] + done.stderr[-1500:]
    return json.loads(lines[-1][4:])


@pytest.mark.rivalFails('its parallel sort makes interactions in another order')
@pytest.mark.parametrize('scene', ['gas', 'mixed', 'periodic'])
def testThreads(collider, scene):
    one = dump(collider.name, scene, 1)
    for threads in (2,):
        many = dump(collider.name, scene, threads)
        assert many['threads'] == threads
        for a, b in zip(one['moments'], many['moments']):
            assert a['interactions'] == b['interactions']
            assert a['positions'] == b['positions']
    assert len(one['moments'][-1]['interactions']) > 500


def testTwoProcesses(collider):
    """Nothing depends on addresses: two runs of one scene are the same, order included."""
    assert dump(collider.name, 'mixed', 1) == dump.__wrapped__(collider.name, 'mixed', 1)
