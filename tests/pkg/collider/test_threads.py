"""yade -j1, -j2, -j3: collider, loop and integrator give the same interactions in the same order, and the same motion."""
import functools
import json
import os
import subprocess

import pytest

from project import yadeCommand

kHere = os.path.dirname(os.path.abspath(__file__))
# Scenes of threads_scene.py: the least number of interactions, or of contacts where bodies are stirred.
kScenes = dict(gas=500, mixed=500, periodic=500, stirred=1600, NewtonIntegrator=0, CurveIntegrator=0)


@functools.cache
def dump(name, threads, scenes=tuple(kScenes)):
    """What threads_scene.py prints: {scene: {'threads': number, 'moments': [{'interactions': number, 'bits': text}]}}."""
    done = subprocess.run(
        yadeCommand() + [f'-j{threads}', os.path.join(kHere, 'threads_scene.py'), name, *scenes],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600)
    lines = [x[4:] for x in done.stdout.splitlines() if x.startswith('@@@ ')]
    assert done.returncode == 0 and len(lines) == len(scenes), done.stdout[-1500:] + done.stderr[-1500:]
    return dict(zip(scenes, map(json.loads, lines)))


@pytest.mark.rivalFails('its parallel sort makes interactions in another order')
@pytest.mark.parametrize('scene', kScenes)
def testThreads(collider, scene):
    one, two, three = (dump(collider.name, threads)[scene] for threads in (1, 2, 3))
    assert [found['threads'] for found in (one, two, three)] == [1, 2, 3]
    assert one['moments'] == two['moments'] == three['moments']
    counts = [moment['contacts' if scene == 'stirred' else 'interactions'] for moment in one['moments']]
    assert min(counts) >= kScenes[scene]


def testIntegratorsAgree(collider):
    found = dump(collider.name, 1)
    assert found['NewtonIntegrator']['moments'] == found['CurveIntegrator']['moments']


def testTwoProcesses(collider):
    """Nothing depends on addresses: two runs of one scene are the same, order included."""
    assert dump(collider.name, 1)['mixed'] == dump.__wrapped__(collider.name, 1, ('mixed',))['mixed']
