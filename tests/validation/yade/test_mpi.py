"""yade.mpy, YADE's MPI engine, with LebesgueCollider: the same bodies and contacts as in one process
and as with YADE's collider; what it cannot split is refused. Each run starts and ends its own
processes (mpi_scene.py)."""
import json
import os
import re
import subprocess
import tempfile

import pytest
import yade

import project
from project import ROOT, yadeCommand

kHere = os.path.dirname(os.path.abspath(__file__))
kChecks = os.path.join(os.path.dirname(yade.__file__), 'tests', 'checks')
kExamples = '/usr/share/doc/yade/examples/mpi'
kRadius = .5
kLimit = 120        # s, for one run; a few seconds on an idle machine
# Forces of a body are added in another order, since its contacts are: rounding, of 17 m positions,
# amplified by some collisions.
kRounding = 1e-12 * kRadius
# YADE's examples run for 1000 or 2000 steps. In testMPI_2D_MergeCPP.py two colliders in one process,
# both with a search at every step, differ by 4·10⁻⁹ m.
kParted = 1e-7 * kRadius

pytestmark = pytest.mark.skipif('MPI' not in yade.config.features, reason='this YADE is built without MPI')


def run(ranks, collider, scene, *arguments):
    """What each process reports, by rank."""
    script = [*yadeCommand(), os.path.join(kHere, 'mpi_scene.py')]
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        code, output = project.runMpi(
            ranks, [*script, collider, folder, scene, *arguments], folder, kLimit)
        reports = []
        for name in sorted(n for n in os.listdir(folder) if n[:-5].isdigit()):
            with open(os.path.join(folder, name)) as file:
                reports.append(json.load(file))
    for report in reports:
        assert report['error'] is None, report['error']
    assert code == 0 and reports, output[-3000:]
    return reports


def merged(reports):
    """(bodies, contacts) of the master's merged scene."""
    return moment(reports[0])


def moment(report):
    return report['bodies'], {(a, b): depth for a, b, depth in report['contacts']}


def united(reports):
    """(bodies, contacts) that the processes have among them; both of a contact's have it."""
    bodies, contacts = {}, {}
    for report in reports:
        assert not bodies.keys() & report['bodies'].keys(), 'a body that belongs to two processes'
        bodies.update(report['bodies'])
        contacts.update(moment(report)[1])
    return bodies, contacts


def compare(expected, found, tolerance=kRounding):
    """Positions, and the contacts except those that hardly touch."""
    assert expected[0].keys() == found[0].keys()
    for body, values in expected[0].items():
        assert found[0][body][:3] == pytest.approx(values[:3], rel=0, abs=tolerance), body
    sets = [{pair for pair, depth in contacts.items() if depth > tolerance} for _, contacts in (expected, found)]
    assert sets[0] - found[1].keys() == set() and sets[1] - expected[1].keys() == set()
    assert len(sets[0]) > 50


@pytest.fixture(scope='module')
def once():
    """`run`, with the reports of earlier calls."""
    kept = {}

    def reports(*call):
        if call not in kept:
            kept[call] = run(*call)
        return kept[call]
    return reports


@pytest.fixture
def alone(once):
    """(bodies, contacts) of a scene in one process."""
    return lambda scene: merged(once(1, 'LebesgueCollider', scene))


@pytest.mark.parametrize('ranks', [2, 3])
def test_sameAsInOneProcess(once, ranks):
    same(once, 'columnsRun', ranks)


def test_sameAsYadesCollider(once):
    """With as few searches: all processes search when a body of one has left its box, and none of them
    again at the next step."""
    yades, ours = (once(3, name, 'columnsRun') for name in ('InsertionSortCollider', 'LebesgueCollider'))
    compare(merged(yades), merged(ours))
    assert [r['searches'] for r in ours] == [r['searches'] for r in yades]


def test_contactsOfProcessesBeforeTheMerge(once):
    """Both processes have a contact between their bodies."""
    parts = [r['apart'] for r in once(3, 'LebesgueCollider', 'columnsRun')]
    owner = {int(body): rank for rank, part in enumerate(parts) for body in part['bodies']}
    between = [{(a, b) for a, b, _ in part['contacts'] if {owner[a], owner[b]} == {1, 2}} for part in parts]
    assert between[1] == between[2] != set()


def test_facetsAndSizes(once, alone):
    """verletDist is a multiple of the smallest radius of all processes. (With YADE's collider each
    uses its own bodies, and the master, without spheres, searches at every step.)"""
    reports = once(4, 'LebesgueCollider', 'gasRun')
    compare(alone('gasRun'), merged(reports))
    assert {r['verletDist'] for r in once(1, 'LebesgueCollider', 'gasRun') + reports} == {
        reports[0]['verletDist']}
    assert max(r['searches'] for r in reports) < 200     # steps


def test_bodiesThatChangeTheirProcess(once, alone):
    reports = once(3, 'LebesgueCollider', 'changing')
    assert {r['changed'] for r in reports} == {reports[0]['changed']}
    assert reports[0]['changed'] > 5
    compare(alone('gasRun'), merged(reports))


def test_mergeSplitAndErase(once, alone):
    one, three = (once(ranks, 'LebesgueCollider', 'mergeAndSplit')[0] for ranks in (1, 3))
    for expected, found in zip(one['moments'], three['moments'], strict=True):
        compare(moment(expected), moment(found))
    assert not {str(k) for k in three['gone']} & three['bodies'].keys()
    compare(moment(one), moment(three))
    assert re.fullmatch(r'Body #\d+ is not the same in the merged scene and in the process that owns it: .*',
                        three['message'])


def same(once, scene, ranks):
    """A scene in `ranks` processes is that in one, before and after it is merged; what each reports."""
    alone, reports = merged(once(1, 'LebesgueCollider', scene)), once(ranks, 'LebesgueCollider', scene)
    assert len(reports) == ranks
    compare(alone, united([r['apart'] for r in reports]))
    compare(alone, merged(reports))
    return reports


@pytest.mark.parametrize('ranks', [2, 4])
def test_clumps(once, ranks):
    """A clump remains in its process, in which mpy has put all of its members."""
    reports = same(once, 'clumps', ranks)
    assert (reports[0]['changed'] > 0) == (ranks > 2)
    assert [reports[0][name] for name in ('divided', 'materials')] == [0, 0]


@pytest.mark.parametrize('ranks', [2, 4])
def test_bodiesInsertedAndErased(once, ranks):
    reports = same(once, 'inserted', ranks)
    ids = {int(k) for k in reports[0]['bodies']}
    assert any(1000 < k < 2000 for k in ids) and any(k > 2000 for k in ids) and 30 not in ids


@pytest.mark.parametrize('ranks', [2, 4])
def test_periodicCell(once, ranks):
    reports = same(once, 'periodic', ranks)
    cells = [r['cell'] for r in once(1, 'LebesgueCollider', 'periodic') + reports]
    assert all(cell == cells[0] for cell in cells)
    positions = [body[:3] for body in reports[0]['bodies'].values()]
    for axis in range(3):
        places = [p[axis] for p in positions]
        assert min(places) < 0 and max(places) > cells[0][axis][axis]


def test_processWithoutBodies(once, alone):
    """Its integrator reports no motion, which is no reason to search."""
    reports = once(3, 'LebesgueCollider', 'emptyRank')
    compare(alone('columnsRun'), merged(reports))
    assert max(r['searches'] for r in reports) < 20


def ordersStartedProcesses():
    """Before its version 5, Open MPI put the process that starts others first, though MPI does not ask for
    that; YADE relies on it, and does not end, or reports bounds that are not numbers, with any collider."""
    found = subprocess.run(['mpiexec', '--version'], stdout=subprocess.PIPE, text=True, check=True).stdout
    return int(re.search(r' (\d+)\.', found)[1]) < 5


@pytest.mark.skipif(not ordersStartedProcesses(), reason='Open MPI 5 orders them arbitrarily')
def test_processesThatMpirunStarts(once, alone):
    """They run the script that called it, not a file of ours."""
    reports = once(1, 'LebesgueCollider', 'spawned')
    assert [r['rank'] for r in reports] == [0, 1, 2]
    compare(alone('columnsRun'), merged(reports))


@pytest.mark.parametrize('ranks', [1, 3])
@pytest.mark.parametrize('case, message', [
    ('elements', 'FESolver and its bodies work in one process only: yade.mpy cannot split this '
                 'scene; run it with O.run.'),
    ('unlabelled', "yade.mpy finds its collider by the label 'collider', but this one has no label: "
                   "write LebesgueCollider([...], label='collider')."),
    ('divided', 'Clump #241 and its members belong to different processes of yade.mpy: give them the same '
                'body.subdomain.'),
    ('factory', 'BoxFactory would insert other bodies in each process of yade.mpy: insert them by a PyRunner '
                'that does the same in all.'),
    ('controller', 'PeriTriaxController would move the cell by the contacts of one process of yade.mpy only: '
                   'run this scene with O.run.')])
def test_refused(once, ranks, case, message):
    """Before processes are started, or in all processes that run already; the scene of each still runs
    alone."""
    for report in once(ranks, 'LebesgueCollider', 'refused'):
        found = report[case]
        assert found['ranks'] == ranks and found['message'] == message
        assert found['isUnchanged'] and found['steps'] == 2


def test_processesThatContradictEachOther(once):
    """All of them raise, before the master merges their bodies."""
    for report in once(3, 'LebesgueCollider', 'contradicting'):
        assert re.fullmatch(r'Body #\d+ was inserted without body.subdomain, the process of yade.mpy that '
                            r'moves it\.', report['unassigned'])
        assert report['twins'] == ('Two processes of yade.mpy have inserted different bodies with the number 500.')
        assert 'The periodic cell is not the same in all processes of yade.mpy: ' in report['cell']


def test_manual():
    """The script of docs/colliders.md, which lets mpy distribute the bodies."""
    text = (ROOT / 'docs' / 'colliders.md').read_text()
    script = next(b for b in re.findall(r'^```python\n(.*?)^```', text, re.S | re.M) if 'mpy' in b)
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        path = os.path.join(folder, 'script.py')
        with open(path, 'w') as out:
            out.write(script)
        one, three = (run(ranks, 'LebesgueCollider', path) for ranks in (1, 3))
    compare(merged(one), merged(three))


def test_yadesCheck():
    """checkMPI.py compares energy and force with its own figures, to 1e-10."""
    reports = run(4, 'LebesgueCollider', os.path.join(kChecks, 'checkMPI.py'))
    assert [r['isIn'] for r in reports] == [['LebesgueCollider']] * 4
    assert len(reports[0]['bodies']) == 7501


# The others need more processes than fit here (testMPI_3D_bisection.py, six), are written in Python 2
# (testMPI_3D.py), call mpy without an argument that it requires (testMPI_2D_interactive.py), have no
# contact (reallocateBodies.py) or no collider (helloMPY.py).
kNoExamples = pytest.mark.skipif(not os.path.isdir(kExamples), reason="YADE's examples are not installed")


@kNoExamples
@pytest.mark.parametrize('script', ['testMPI_2D.py', 'testMPI_2D_MergeCPP.py'])
def test_yadesExamples(script):
    """The third argument is the number of processes, for a run of the same scene in one."""
    path = os.path.join(kExamples, script)
    one, three = (run(ranks, 'LebesgueCollider', path, '8', '8', '3') for ranks in (1, 3))
    assert [r['isIn'] for r in three] == [['LebesgueCollider']] * 3
    whole = united if script == 'testMPI_2D.py' else merged
    compare(merged(one), whole(three), kParted)


@kNoExamples
def test_bodiesInsertedByEachProcess():
    """parallelBodyInsert3D.py cannot run in one process."""
    path = os.path.join(kExamples, 'parallelBodyInsert3D.py')
    yades, ours = (run(3, name, path) for name in ('InsertionSortCollider', 'LebesgueCollider'))
    assert [r['isIn'] for r in ours] == [['LebesgueCollider']] * 3
    compare(merged(yades), merged(ours), kParted)
