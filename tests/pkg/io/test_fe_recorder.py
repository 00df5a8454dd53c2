"""FERecorder, the ready set of engines, and runs that call something every few steps."""
import csv
import os
import pathlib
import shutil
import xml.etree.ElementTree as tree

import meshio
import numpy as np
import pytest

import yadefrag
from fe_scene import fe, O, ready, solverOfScene, steps
from yade import wrapper as w

kOfNodes = {'displacement': 'displacements', 'velocity': 'velocities', 'contact force': 'contactForces',
            'reaction': 'reactions'}
kOfTriangles = {'stress': 'stress', 'stress zz': 'stressZ', 'strain': 'strain', 'component': 'components',
                'fragment': 'fragmentOf'}


def scene(file, **settings):
    """A block that falls onto a floor, with a recorder."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((-1, -1), (2, 0)), size=.5, material='m', name='floor, low',
                      fixed=lambda x, y: True)
    solver.addPolygon(yadefrag.rectangle((0, .001), (1, 1)), size=.5, material='m', velocity=(0, -1))
    ready(solver, .8, gravity=(0, -9.81))
    O.engines = O.engines + [yadefrag.FERecorder(iterPeriod=10, file=file, **settings)]
    return solver


def table(file):
    with open(file + '.csv') as lines:
        return list(csv.DictReader(lines))


def series(file):
    sets = tree.parse(file + '.pvd').getroot().iter('DataSet')
    return [(float(one.get('timestep')), one.get('file')) for one in sets]


def told(capfd):
    """Lines of FERecorder's warnings."""
    return [line for line in capfd.readouterr().err.splitlines() if line.startswith('WARN  FERecorder')]


def test_recordsAreTheSolversValues(folder):
    file = folder + '/a run & more'
    solver = scene(file)
    wanted = []
    for _ in range(45):
        O.step()
        if (O.iter - 1) % 10 == 0:
            wanted.append((O.iter - 1, solver.time, solver.energy, solver.nodes, solver.reaction('floor, low'),
                           {name: getattr(solver, array) for name, array in {**kOfNodes, **kOfTriangles}.items()}))
    rows, pictures = table(file), series(file)
    assert [int(row['step']) for row in rows] == [one[0] for one in wanted] == [0, 10, 20, 30, 40]
    for row, (time, picture), (_, when, energy, nodes, force, arrays) in zip(rows, pictures, wanted):
        assert float(row['time (s)']) == time == when
        assert all(float(row['%s (J)' % name]) == energy[name]
                   for name in ('kinetic', 'strain', 'contact', 'outside', 'total'))
        assert float(row['reaction y of floor  low (N)']) == force[1] == float(row['reaction y (N)'])
        mesh = meshio.read(os.path.join(folder, picture))
        assert (mesh.points == np.pad(nodes, ((0, 0), (0, 1)))).all() and (mesh.cells_dict['triangle'] == solver.triangles).all()
        assert set(mesh.point_data) == set(kOfNodes) and set(mesh.cell_data) == set(kOfTriangles)
        for name in kOfNodes:
            assert (mesh.point_data[name] == np.pad(arrays[name], ((0, 0), (0, 1)))).all()
        for name in kOfTriangles:
            assert (mesh.cell_data[name][0] == arrays[name]).all()
    assert all(any(np.any(one[-1][name]) for one in wanted) for name in wanted[0][-1])  # none is zero everywhere


def test_fieldsAreChosen(folder):
    scene(folder + '/few', fields=['stress'])
    steps(1)
    mesh = meshio.read(folder + '/few_000000.vtu')
    assert not mesh.point_data and list(mesh.cell_data) == ['stress']
    O.reset()
    scene(folder + '/none', fields=())
    steps(1)
    assert len(table(folder + '/none')) == 1 and not os.path.exists(folder + '/none.pvd')


@pytest.mark.parametrize('ending', ['.yade', '.xml'])
def test_takenUpAgainWithoutDoubles(folder, ending):
    """Other files of this name are replaced."""
    file = folder + '/run'
    for old in ('.csv', '.pvd'):
        pathlib.Path(file + old).write_text('something else\n1,2\n')
    scene(file)
    O.run(25, True)
    O.save(folder + '/scene' + ending)
    O.run(30, True)
    rows, pictures, nodes = table(file), series(file), solverOfScene().nodes
    assert len(rows) == len(pictures) == 6
    O.load(folder + '/scene' + ending)
    O.run(30, True)
    assert (solverOfScene().nodes == nodes).all()
    assert table(file) == rows and series(file) == pictures
    # A new run under the same name begins anew.
    O.reset()
    scene(file)
    O.run(15, True)
    assert len(table(file)) == len(series(file)) == 2


def test_recordsOfBodiesThatComeAndGoStay(folder):
    file = folder + '/run'
    solver = scene(file, fields=['velocity'])
    solver.addPolygon(yadefrag.rectangle((3, 0), (4, 1)), size=.5, material='m', name='first')
    O.run(20, True)
    solver.addPolygon(yadefrag.rectangle((5, 0), (6, 1)), size=.5, material='m', name='second')
    O.run(20, True)
    before = table(file)
    solver.removeBody('first')
    O.run(20, True)
    rows = table(file)
    assert [int(row['step']) for row in rows] == [0, 10, 20, 30, 40, 50]
    assert rows[:4] == before
    column = 'reaction x of %s (N)'
    assert [row[column % 'first'] == 'nan' for row in rows] == [False] * 4 + [True] * 2
    assert [row[column % 'second'] == 'nan' for row in rows] == [True] * 2 + [False] * 4
    for body in (0, 1, 'second'):  # no body is left to draw, and fe.time stands
        solver.removeBody(body)
    O.run(20, True)
    assert table(file)[-1]['step'] == '70' and len(table(file)) == 7 and len(series(file)) == 6


@pytest.mark.parametrize('small', ['32k'], indirect=True)
def test_aFullDiskIsASentenceAndTheRunGoesOn(small, capfd):
    file = small + '/run'
    scene(file)
    assert yadefrag.runSteps(400) == 400
    written = told(capfd)
    assert 1 <= len(written) <= 2 and all('No space left on device' in one for one in written)
    # What is there is whole.
    rows, pictures = table(file), series(file)
    assert 0 < len(pictures) <= len(rows) < 40
    assert all(None not in row and None not in row.values() for row in rows)
    for _, picture in pictures:
        assert len(meshio.read(os.path.join(small, picture)).points)
    assert not [name for name in os.listdir(small) if 'part' in name]


def test_aFolderThatGoesIsASentence(folder, capfd):
    os.mkdir(folder + '/deep')
    scene(folder + '/deep/run')
    steps(1)
    shutil.rmtree(folder + '/deep')
    steps(30)
    written = told(capfd)
    assert len(written) == 2 and all('No such file or directory' in one for one in written)


# --- engines

def test_enginesTakeTheSolversGravity():
    solver = fe(gravity=(1, -2))
    first, last = yadefrag.engines(solver), yadefrag.engines(solver, spheres=True, damping=.3)
    assert [type(one).__name__ for one in first] == ['ForceResetter', 'FESolver']
    assert tuple(last[-1].gravity) == (1, -2, 0) and last[-1].damping == .3
    assert tuple(solver.gravity) == (1, -2, 0)


# --- calls between steps

def test_callsDoNotWaitForYadesPolling(monkeypatch):
    """YADE's O.wait() looks every 40 ms whether a run is over: it is not used."""
    solver = fe()
    solver.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m')
    ready(solver, .5)
    waited, called = [], []
    monkeypatch.setattr(w.Omega, 'wait', lambda self: waited.append(O.iter))
    assert yadefrag.runSteps(200, every=1, call=lambda: called.append(O.iter)) == 200
    assert called == list(range(1, 201)) and waited == []
