"""Memory stays as it is over scenes that crack, are saved, loaded and changed, one after another. The plugin under
valgrind's memcheck: no wrong access with the plugin in its stack; findings of YADE and Python themselves are not
judged."""
import json
import os
import pathlib
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest
from project import inYade, yadeCommand

kScenes = pathlib.Path(__file__).with_name('memory_scene.py')


def test_memoryStays():
    done = inYade(kScenes, 'soak', '20', timeout=640)
    lines = [line for line in done.stdout.splitlines() if line.startswith('@@@ ')]
    assert done.returncode == 0 and lines, done.stdout[-3000:]
    result = json.loads(lines[-1][4:])
    assert min(result['cracks']) > 0
    used = result['memory']
    # The first third fills what is kept permanently: imports, pools of threads, tables of classes.
    warm = max(used[:len(used) // 3])
    print('%d rounds, %d kB after the first third, %d kB at the end' % (len(used), warm, used[-1]))
    assert used[-1] < 1.01 * warm


kPlugin = '_yadefrag.so'
kValgrind = ['valgrind', '--tool=memcheck', '--xml=yes', '--show-leak-kinds=none', '--num-callers=40',
             '--error-limit=no', '--fair-sched=yes']


def isOurs(frame):
    """True for a function of the plugin; not for its exception translator, through which every call from Python into
    YADE goes."""
    return kPlugin in (frame.findtext('obj') or '') and 'translate_exception' not in (frame.findtext('fn') or '')


def isOfCompression(functions):
    """True for what a compressor finds in its buffer: YADE's uninitialised bytes, which it meets
    whenever the buffer is full, be it in a write of ours. A value of ours that is not initialised
    shows where it is formatted for XML, without a compressor."""
    return any('boost::iostreams::' in name or name == 'deflate' for name in functions[:8])


def findings(report):
    """Findings of memcheck with the plugin in a stack: [(kind, text, functions innermost first)].

    With XML it looks for leaks with any options; those are left out: Python and YADE keep their
    classes, and the last scene, to the end."""
    found = []
    for error in ElementTree.parse(report).getroot().iter('error'):
        kind = error.findtext('kind')
        functions = [frame.findtext('fn') or '?' for frame in error.find('stack').iter('frame')]
        if not kind.startswith('Leak_') and any(map(isOurs, error.iter('frame'))) and not isOfCompression(functions):
            found.append((kind, error.findtext('what'), functions[:12]))
    return found


def runUnderValgrind(folder, *arguments):
    """(the finished process, findings) of memory_scene.py: one process, which takes long to start."""
    report = os.path.join(folder, 'memcheck.xml')
    # Other allocators, Python's own among them, would hide what is freed; Python's reads what memcheck takes for freed.
    done = subprocess.run(
        [*kValgrind, f'--xml-file={report}', sys.executable, *yadeCommand(), '-j2', str(kScenes), 'all', *arguments],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=900,
        env=dict(os.environ, LD_PRELOAD='', PYTHONMALLOC='malloc', PYTHONHASHSEED='0', OMP_WAIT_POLICY='passive'))
    return done, findings(report)


def testNoWrongAccess(folder):
    names = ['LebesgueCollider']
    done, found = runUnderValgrind(folder, *names)
    scenesRun = [x.split() for x in done.stdout.splitlines() if x.startswith('@@@ ')]
    assert done.returncode == 0 and scenesRun[-1:] == [['@@@', 'done']], \
        done.stdout[-1500:] + done.stderr[-1500:]
    assert len(scenesRun) == 2 * len(names) + 1
    assert all(int(x[3]) > 30 for x in scenesRun[:-1]), scenesRun
    if found:
        pytest.fail('\n'.join(f'{kind}: {text}\n    in ' + '\n    by '.join(functions)
                              for kind, text, functions in found))
