"""Pictures, films and ParaView files of a solver, here a stand-in with two triangles."""

import subprocess
import types

import numpy
import pytest

import scenes
from test_threads import yadeCommand
from yadefrag import export, pictures

O = scenes.O


def standIn(**values):
    return types.SimpleNamespace(_lock=lambda: None, _unlock=lambda: None, **values)


def makeSolver():
    return standIn(
        nodes=numpy.array([[0, 0], [1, 0], [1, 1], [0, 1.]]),
        displacements=numpy.array([[0, 0], [.1, 0], [.1, .2], [0, .2]]),
        velocities=numpy.array([[3., 4], [0, 0], [1, 0], [0, 2]]),
        contactForces=numpy.array([[0., 0], [0, 5], [0, 0], [-1, 0]]),
        reactions=numpy.array([[0., 1], [0, 0], [2, 0], [0, 0]]),
        triangles=numpy.array([[0, 1, 2], [0, 2, 3]]), strain=numpy.array([[1e-3, 0, 2e-3], [0, 0, 0]]),
        stress=numpy.array([[1e6, 2e6, 3e6], [-1e6, 0, 0]]),
        components=numpy.array([0, 1]), fragmentOf=numpy.array([0, 1]),
        dropped=dict(count=0))


def makeEmpty():
    return standIn(
        nodes=numpy.empty((0, 2)), displacements=numpy.empty((0, 2)),
        velocities=numpy.empty((0, 2)), contactForces=numpy.empty((0, 2)),
        reactions=numpy.empty((0, 2)), strain=numpy.empty((0, 3)),
        triangles=numpy.empty((0, 3), dtype=int), stress=numpy.empty((0, 3)),
        components=numpy.empty(0, dtype=int), fragmentOf=numpy.empty(0, dtype=int),
        dropped=dict(count=0))


def test_vtkFileHoldsEverything(folder):
    meshio = pytest.importorskip('meshio')
    fe = makeSolver()
    export.exportVTK(fe, folder + '/out.vtu')
    mesh = meshio.read(folder + '/out.vtu')
    assert numpy.array_equal(mesh.points[:, :2], fe.nodes) and not mesh.points[:, 2].any()
    assert numpy.array_equal(mesh.cells_dict['triangle'], fe.triangles)
    for name, values in (('displacement', fe.displacements), ('velocity', fe.velocities),
                         ('contact force', fe.contactForces), ('reaction', fe.reactions)):
        assert numpy.array_equal(mesh.point_data[name][:, :2], values), name
        assert not mesh.point_data[name][:, 2].any()
    assert numpy.array_equal(mesh.cell_data['stress'][0], fe.stress)
    assert numpy.array_equal(mesh.cell_data['strain'][0], fe.strain)
    assert numpy.array_equal(mesh.cell_data['component'][0], fe.components)
    assert numpy.array_equal(mesh.cell_data['fragment'][0], fe.fragmentOf)


def test_vtkFileIsRefusedInOneSentence(folder):
    with pytest.raises(ValueError, match=r"out\.vtk', its name must end with '\.vtu'"):
        export.exportVTK(makeSolver(), folder + '/out.vtk')
    with pytest.raises(ValueError, match='no bodies'):
        export.exportVTK(makeEmpty(), folder + '/out.vtu')


def shown(ax):
    """The values behind the colours of an axes' triangles."""
    return [c.get_array() for c in ax.collections if c.get_array() is not None][-1]


@pytest.mark.parametrize('field, values', [
    ('xx', [1e6, -1e6]), ('yy', [2e6, 0]), ('xy', [3e6, 0]),
    ('mises', [numpy.sqrt(30) * 1e6, 1e6]), ('component', [0, 1]), ('speed', [5, 0, 1, 2]),
    (numpy.array([7, 8]), [7, 8]), ([1, 2, 3, 4], [1, 2, 3, 4]),
])
def test_fieldIsShown(field, values):
    ax = pictures.plotMesh(makeSolver(), field)
    assert numpy.allclose(shown(ax), values)


def test_pictureIsWritten(folder):
    image = pytest.importorskip('PIL.Image')
    for field in (None, 'mises', 'speed'):
        path = '%s/%s.png' % (folder, field)
        pictures.plotMesh(makeSolver(), field, path)
        with image.open(path) as picture:
            assert len(picture.getcolors(1 << 24)) > 10


def test_badFieldIsRefused():
    with pytest.raises(ValueError, match="field is 'stress', it must be one of 'xx'"):
        pictures.plotMesh(makeSolver(), 'stress')
    with pytest.raises(ValueError, match=r'shape \(3,\).*2 triangles or of the 4 nodes\.'):
        pictures.plotMesh(makeSolver(), [1, 2, 3])
    with pytest.raises(ValueError, match='no bodies'):
        pictures.plotMesh(makeEmpty())


class Mover:
    """A solver whose body goes right by 0.1 m a step, by YADE's loop."""

    def __init__(self):
        self.fe = makeSolver()

    def __call__(self):
        self.fe.nodes = self.fe.nodes + [.1, 0]


def test_filmRunsTheScene(folder):
    image = pytest.importorskip('PIL.Image')
    from yade import utils, wrapper
    mover = Mover()
    utils.mover = mover
    O.engines = [wrapper.PyRunner(command='__import__("yade.utils").utils.mover()', iterPeriod=1,
                                  initRun=True)]
    O.dt = 1
    frames = pictures.animate(mover.fe, folder + '/out.gif', steps=7, every=3, field='mises')
    del utils.mover
    assert O.iter == 7 and frames == 4
    assert mover.fe.nodes[0, 0] == pytest.approx(.7)
    with image.open(folder + '/out.gif') as film:
        assert film.n_frames == 4


@pytest.mark.parametrize('change, word', [
    ({'steps': 0}, 'steps is 0'), ({'every': -1}, 'every is -1'), ({'rate': 0}, 'rate is 0'),
    ({'file': 'out.avi'}, "must end with '.gif'"), ({'field': 'none'}, "field is 'none'"),
    ({'field': [1, 2]}, 'field is an array'),
])
def test_filmIsRefusedBeforeTheFirstStep(change, word):
    arguments = {'file': 'out.gif', 'steps': 10, 'every': 5, **change}
    with pytest.raises(ValueError) as error:
        pictures.animate(makeSolver(), **arguments)
    assert word in str(error.value) and O.iter == 0


def test_importCostsNoPlotting(folder):
    """Scripts that draw nothing do not wait for Matplotlib and meshio."""
    with open(folder + '/script.py', 'w') as script:
        script.write('import sys\n'
                     'before = set(sys.modules)\n'
                     'import yadefrag\n'
                     'new = {name.partition(".")[0] for name in set(sys.modules) - before}\n'
                     'print("@", sorted({"matplotlib", "meshio", "PIL"} & new))\n')
    done = subprocess.run([*yadeCommand(), folder + '/script.py'], capture_output=True, text=True,
                          check=True)
    assert '@ []' in done.stdout
