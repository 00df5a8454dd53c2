"""yade -j1 and -j2: the same interactions in the same order, and the same positions."""
import functools
import json
import os
import subprocess

import pytest

from project import yadeCommand

kHere = os.path.dirname(os.path.abspath(__file__))


kScenes = 'gas', 'mixed', 'periodic'


@functools.cache
def dump(name, threads, scenes=kScenes):
    """What threads_scene.py prints: {scene: {'interactions': [...], 'positions': [...]} per moment}."""
    done = subprocess.run(
        yadeCommand() + [f'-j{threads}', os.path.join(kHere, 'threads_scene.py'), name, *scenes],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600)
    lines = [x[4:] for x in done.stdout.splitlines() if x.startswith('@@@ ')]
    assert done.returncode == 0 and len(lines) == len(scenes), done.stdout[-1500:] + done.stderr[-1500:]
    return dict(zip(scenes, map(json.loads, lines)))


@pytest.mark.rivalFails('its parallel sort makes interactions in another order')
@pytest.mark.parametrize('scene', kScenes)
def testThreads(collider, scene):
    one, two = (dump(collider.name, threads)[scene] for threads in (1, 2))
    assert two['threads'] == 2
    for a, b in zip(one['moments'], two['moments']):
        assert a['interactions'] == b['interactions']
        assert a['positions'] == b['positions']
    assert len(one['moments'][-1]['interactions']) > 500


def testTwoProcesses(collider):
    """Nothing depends on addresses: two runs of one scene are the same, order included."""
    assert dump(collider.name, 1)['mixed'] == dump.__wrapped__(collider.name, 1, ('mixed',))['mixed']
