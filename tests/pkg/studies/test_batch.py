"""scripts/yade-batch: jobs of a table find the plugin, whatever folder they are started from."""
import os
import subprocess

from project import ROOT

kBatch = str(ROOT / 'scripts' / 'yade-batch')
kScript = '''
from yade import utils
utils.readParamsFromTable(speed=1., noTableOk=False)
from yade.params.table import speed
import yadefrag
from yade.wrapper import FESolver
O.materials.append(FEMat(young=1e7, poisson=.3, density=1000, label='m'))
fe = FESolver()
fe.addPolygon([(0, 0), (1, 0), (1, 1), (0, 1)], size=.5, material='m', velocity=(speed, 0))
O.engines = yadefrag.engines(fe)
O.dt = .5 * fe.criticalTimeStep()
start = fe.nodes[:, 0].mean()
O.run(20, True)
with open('%g.txt' % speed, 'w') as out:
    out.write(repr(float((fe.nodes[:, 0].mean() - start) / (speed * 20 * O.dt))))
'''


def test_jobsOfATableFindThePlugin(folder):
    for name, text in (('scene.py', kScript), ('table.txt', 'speed\n1.5\n-3\n')):
        with open(os.path.join(folder, name), 'w') as out:
            out.write(text)
    environment = {k: v for k, v in os.environ.items() if k != 'PYTHONPATH'}
    done = subprocess.run([kBatch, '-j1', '--disable-pynotify', '--plot-update=0', 'table.txt',
                           'scene.py'], cwd=folder, env=environment, capture_output=True, text=True,
                          timeout=300)
    logs = [open(os.path.join(folder, f)).read()[-800:] for f in os.listdir(folder)
            if f.endswith('.log')]
    assert done.returncode == 0, done.stdout + done.stderr + '\n'.join(logs)
    moved = [float(open(os.path.join(folder, name + '.txt')).read()) for name in ('1.5', '-3')]
    assert all(abs(one - 1) < 1e-12 for one in moved)


def test_batchRequiresOnlyWhatExists(folder):
    """A script that is not there is yade-batch's own complaint, not ours."""
    done = subprocess.run([kBatch, '--version'], cwd=folder, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and 'Yade version' in done.stdout
