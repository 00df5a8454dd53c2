"""Pictures, films and ParaView files of a solver, here a stand-in with two triangles."""
import ast
import pathlib
import types

import meshio
import numpy
from PIL import Image
import pytest

import scenes
from fe_scene import block, fe as solver
from outline_files import written
from project import inYade
from yade import utils, wrapper
from yade.minieigenHP import Quaternion
from yadefrag import FERecorder
from yadefrag.fe.fields import FIELDS
from yadefrag.io import recorder
from yadefrag.plots import pictures

O = scenes.O


def makeSolver():
    noCracks = dict(held=numpy.empty(0, dtype=bool), nodes=numpy.empty((0, 4), dtype=int), triangle=numpy.empty(0, dtype=int),
                    damage=numpy.empty(0))
    return types.SimpleNamespace(
        _lock=lambda: None, _unlock=lambda: None, _cracks=lambda: noCracks, axisymmetric=False,
        nodes=numpy.array([[0, 0], [1, 0], [1, 1], [0, 1.]]),
        displacements=numpy.array([[0, 0], [.1, 0], [.1, .2], [0, .2]]),
        velocities=numpy.array([[3., 4], [0, 0], [1, 0], [0, 2]]),
        contactForces=numpy.array([[0., 0], [0, 5], [0, 0], [-1, 0]]),
        reactions=numpy.array([[0., 1], [0, 0], [2, 0], [0, 0]]),
        _reference=numpy.array([[0, 0], [1, 0], [1, 1], [0, 1.]]),
        triangles=numpy.array([[0, 1, 2], [0, 2, 3]]), strain=numpy.array([[1e-3, 0, 2e-3], [0, 0, 0]]),
        stress=numpy.array([[1e6, 2e6, 3e6], [-1e6, 0, 0]]), stressZ=numpy.array([0, 1e6]),
        components=numpy.array([0, 1]), fragmentOf=numpy.array([0, 1]),
        dropped=dict(count=0))


def shown(ax):
    """The values behind the colours of an axes' triangles."""
    return [c.get_array() for c in ax.collections if c.get_array() is not None][-1]


@pytest.mark.parametrize('field, values', [
    ('xx', [1e6, -1e6]), ('yy', [2e6, 0]), ('xy', [3e6, 0]),
    ('zz', [0, 1e6]), ('mises', [numpy.sqrt(30) * 1e6, numpy.sqrt(3) * 1e6]), ('component', [0, 1]), ('speed', [5, 0, 1, 2]),
    (numpy.array([7, 8]), [7, 8]), ([1, 2, 3, 4], [1, 2, 3, 4]),
])
def test_fieldIsShown(field, values):
    ax = pictures.plotMesh(makeSolver(), field)
    assert numpy.allclose(shown(ax), values)


@pytest.mark.parametrize('name', FIELDS)
def test_allFieldsAreAcceptedEverywhere(folder, name):
    """By their name, and by the words on the axis: 'plasticStrain' is 'plastic strain'."""
    zero = numpy.zeros(2)
    fe = makeSolver()
    fe.plasticStrain, fe.temperature, fe.damage, fe._yields, fe._fails = zero, zero + 300, zero, True, True
    fe.principalStress = numpy.array([[2., 1], [3, 1]])
    both = [name, FIELDS[name].label.partition(' (')[0]]
    drawn = [shown(pictures.plotMesh(fe, one)) for one in both]
    assert numpy.array_equal(*drawn) and pictures.plotMesh(fe, fields=both)
    recorder.exportVTK(fe, folder + '/out.vtu', both)
    mesh = meshio.read(folder + '/out.vtu')
    assert set(both) == {*mesh.point_data, *mesh.cell_data}
    assert FERecorder(10, folder + '/run', fields=both).command.endswith('%r)' % (tuple(both),))


def boxes(figure):
    """{text or axes: its box in pixels}, of all that is shown."""
    figure.canvas.draw()
    return {one: one.get_tightbbox() for ax in figure.axes for one in (ax.xaxis.label, ax.yaxis.label, ax.title, ax)
            if one.get_tightbbox() is not None and one.get_tightbbox().width > 0}


def requireInside(every, figure):
    assert all(0 <= box.x0 and box.x1 <= figure.bbox.width and 0 <= box.y0 and box.y1 <= figure.bbox.height
               for box in every.values())


def panel(low, high, **settings):
    fe = solver()
    block(fe, low, high, .01, velocity=(0, 1))
    return pictures.plotMesh(fe, **settings)


@pytest.mark.parametrize('high', [(.5, .02), (.02, .5), (.3, .1), (.1, .1), (.1, .06)])
def test_colourBarIsLongAndThePageFull(folder, high):
    ax = panel((0, 0), high, field='sigma1', file=folder + '/a.png')
    figure = ax.figure
    every = boxes(figure)
    bar, = [one for one in figure.axes if one is not ax]
    frame, its = ax.get_window_extent(), bar.get_window_extent()
    long, short, beside = (its.width, its.height, frame.width) if its.width > its.height else \
        (its.height, its.width, frame.height)
    assert long > 300 and 5 < short < 40 and long > .8 * beside
    requireInside(every, figure)
    with Image.open(folder + '/a.png') as picture:
        dark = (numpy.asarray(picture.convert('L')) < 250)
    rows, columns = dark.any(axis=1), dark.any(axis=0)
    assert min(rows.argmax(), rows[::-1].argmax(), columns.argmax(), columns[::-1].argmax()) > 0
    # No white page beside the axes: what is outside of them is labels and the bar.
    assert dark.shape[0] < 1.5 * (ax.get_window_extent().height + 160) and \
        dark.shape[1] < 1.5 * (ax.get_window_extent().width + 200)


def test_labelsOfStackedFieldsAreWhole():
    axes = panel((0, 0), (.5, .03), fields=['sigma1', 'plasticStrain', 'displacement', 'fragment'])
    figure = axes[0].figure
    every = boxes(figure)
    texts = [box for one, box in every.items() if one not in figure.axes]
    frames = [ax.get_window_extent() for ax in figure.axes]
    assert not any(text.overlaps(frame) for text in texts for frame in frames)
    requireInside(every, figure)
    assert axes[3].get_title() == 'fragment' and len(figure.axes) == 7


def test_linesOfCracksFollowTheScale():
    """On the paper they are an eighth of a triangle's side wide, and at most 1.4 points."""
    cracks = dict(held=numpy.array([False]), nodes=numpy.array([[0, 1, 2, 3]]), triangle=numpy.array([0]),
                  damage=numpy.array([1.]))
    fe = makeSolver()
    fe._cracks = lambda: cracks

    def width(xlim):
        ax = pictures.plotMesh(fe, xlim=xlim, ylim=xlim)
        ax.figure.canvas.draw()
        lines, = [one for one in ax.collections if one.get_label() == 'open']
        return lines.get_linewidth()[0], 72 / ax.figure.dpi * ax.get_window_extent().width / (xlim[1] - xlim[0])
    assert width((0, 1))[0] == 1.4
    points, side = width((0, 100))
    assert points == pytest.approx(.12 * side)


def test_elasticBodiesHaveNoTemperature():
    fe = makeSolver()
    fe.temperature = numpy.array([0, 300.])
    values = shown(pictures.plotMesh(fe, 'temperature'))
    assert values.mask.tolist() == [True, False] and values[1] == 300
    fe.temperature = numpy.zeros(2)
    assert len(pictures.plotMesh(fe, 'temperature').figure.axes) == 1  # no colour bar


def squareBody():
    fe = solver()
    block(fe, (0, 0), (1, 1), .5)
    return fe


def scenePicture(**settings):
    """Axes of a square body, two spheres, and a clump of two, in a scene of YADE."""
    fe = squareBody()
    O.bodies.append([utils.sphere((2, 0, 0), .5, color=(1, 0, 0)), utils.sphere((0, -3, 7), .25, color=(0, 0, 1))])
    O.bodies.appendClumped([utils.sphere((4, 1, 0), .3), utils.sphere((4.2, 1, 0), .2)])
    return pictures.plotMesh(fe, **settings)


def drawnSpheres(ax):
    """[(x, y, radius)] of what is drawn."""
    from matplotlib.collections import EllipseCollection
    return [(*place, width) for c in ax.collections if isinstance(c, EllipseCollection)
            for place, width in zip(c.get_offsets().tolist(), c._widths)]


def test_spheresAndMembersOfClumpsAreDrawn(folder):
    ax = scenePicture(file=folder + '/a.png')
    # Matplotlib keeps half the widths.
    assert sorted(drawnSpheres(ax)) == [(0, -3, .25), (2, 0, .5), (4, 1, .3), (4.2, 1, .2)]
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    assert left < -.25 and right > 4.4 and bottom < -3.25 and top > 1.3
    with Image.open(folder + '/a.png') as picture:
        pixels = numpy.asarray(picture.convert('RGB')).reshape(-1, 3)
    for colour, radius in (((255, 0, 0), .5), ((0, 0, 255), .25)):
        count = (pixels == colour).all(axis=1).sum()
        scale = ax.get_window_extent().width * 150 / ax.figure.dpi / (right - left)  # pixels per m
        assert count == pytest.approx(numpy.pi * (radius * scale)**2, rel=.1)


def rigidScene():
    """A square body of 1 m on a turned box, between a wall and a facet, and what is not in the plane."""
    fe = squareBody()
    O.bodies.append([
        utils.box((.5, -.3, 0), (.1, .3, 5), orientation=Quaternion((0, 0, 1), numpy.pi / 2), color=(1, 0, 0)),
        # Its corners are at z = -1 and 3: it cuts the plane at a quarter of two of its sides.
        utils.facet([(1.2, 0, -1), (1.2, .8, 3), (1.6, 0, 3)], color=(0, 0, 1)),
        utils.wall(-.25, axis=0, color=(0, 1, 0)), utils.wall(-90, axis=1, color=(1, 1, 0)),
        utils.box((0, 0, 3), (1, 1, 1)), utils.facet([(0, 2, 0), (1, 2, 0), (0, 3, 0)])])
    return fe


def drawnRigid(ax):
    """(corners of outlines, ends of lines, {axis and place of walls}) of what is drawn."""
    from matplotlib.collections import LineCollection, PolyCollection
    outlines = [path.vertices[:-1] for c in ax.collections if type(c) is PolyCollection and c.zorder < 1
                for path in c.get_paths()]
    lines = [part for c in ax.collections if isinstance(c, LineCollection) for part in c.get_segments()]
    walls = {(axis, data[0]) for line in ax.lines for axis, data in enumerate(line.get_data())
             if line.get_path_effects() and data[0] == data[1]}
    return outlines, lines, walls


def test_sectionsOfWallsBoxesAndFacetsAreDrawn(folder):
    ax = pictures.plotMesh(rigidScene(), 'component', file=folder + '/a.png')
    (box,), (facet,), walls = drawnRigid(ax)
    assert sorted(box.round(9).tolist()) == [[.2, -.4], [.2, -.2], [.8, -.4], [.8, -.2]]
    assert sorted(facet.round(9).tolist()) == [[1.2, .2], [1.3, 0]]
    assert walls == {(0, -.25), (1, -90)}
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    assert -.5 < left < -.25 and 1.3 < right < 1.5 and -.6 < bottom < -.4 and 1 < top < 1.2
    with Image.open(folder + '/a.png') as picture:
        pixels = numpy.asarray(picture.convert('RGB'))
    scale = ax.get_window_extent().width * 150 / ax.figure.dpi / (right - left)  # pixels per m
    red = (pixels == (255, 0, 0)).all(axis=2).sum()
    assert red == pytest.approx(.6 * .2 * scale**2, rel=.05)
    green = numpy.nonzero((pixels == (0, 255, 0)).all(axis=2))
    assert len(set(green[0])) > .9 * (top - bottom) * scale and len(set(green[1])) <= 4  # one upright line
    assert (pixels == (0, 0, 255)).all(axis=2).any() and not (pixels == (255, 255, 0)).all(axis=2).any()


def test_spheresAndRigidBodiesAreOmittedIfRequested():
    ax = scenePicture(spheres=False)
    assert drawnSpheres(ax) == [] and ax.get_xlim()[1] < 1.2
    scenes.clear()
    ax = pictures.plotMesh(rigidScene(), rigidBodies=False)
    assert drawnRigid(ax) == ([], [], set()) and ax.get_xlim()[0] > -.2 and ax.get_xlim()[1] < 1.2


def test_longFloorsDoNotMakeBodiesSmall():
    """Of what is drawn, bodies and spheres take at least half: the box is seen as far as that goes."""
    fe = rigidScene()
    O.bodies.append(utils.box((0, -20.5, 0), (1000, 20, 1)))
    ax = pictures.plotMesh(fe)
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    assert -.6 <= left < -.5 and 1.5 < right <= 1.6 and -.6 <= bottom < -.5 and 1 < top < 1.1
    tall, wide = [pictures.plotMesh(fe, fields=[None, None], **window)[0].figure.get_size_inches()
                  for window in ({}, dict(xlim=(0, 1), ylim=(0, .1)))]
    assert tall[0] > tall[1] and wide[1] < wide[0] / 2


def test_windowIsWhatIsDrawn():
    ax = scenePicture(xlim=(-1, 3), ylim=(.2, .6))
    assert ax.get_xlim() == (-1, 3) and ax.get_ylim() == (.2, .6)
    scenes.clear()
    ax = scenePicture(ylim=(0, 2))
    assert ax.get_ylim() == (0, 2) and ax.get_xlim()[1] > 4.4


def test_severalFieldsSideBySide(folder):
    axes = pictures.plotMesh(makeSolver(), fields=['xx', 'speed', None, [7, 8]], ylim=(0, 1),
                             limits=[None, (0, 9), None, (1, 2)], file=folder + '/a.png')
    assert [shown(ax).tolist() for ax in axes[:2] + axes[3:]] == [[1e6, -1e6], [5, 0, 1, 2], [7, 8]]
    scales = [ax.collections[-1].get_clim() for ax in axes[:2] + axes[3:]]
    assert scales == [(-1e6, 1e6), (0, 9), (1, 2)]
    assert all(ax.get_ylim() == (0, 1) and ax.figure is axes[0].figure for ax in axes)
    axes[0].figure.canvas.draw()
    places = [ax.get_position() for ax in axes]
    assert all(a.x1 < b.x0 for a, b in zip(places, places[1:]))
    wide = pictures.plotMesh(makeSolver(), fields=['xx', 'yy'], xlim=(0, 5), ylim=(0, 1), limits=(0, 1))
    wide[0].figure.canvas.draw()
    assert wide[0].get_position().y0 > wide[1].get_position().y1
    assert [ax.collections[-1].get_clim() for ax in wide] == [(0, 1)] * 2


def test_curvesOfFractureAreDistinguishable(folder):
    """Colours of both axes: red, green and blue of any two differ by 0.25 and more together; open cracks
    are a dashed line of the colour of all cracks."""
    from matplotlib import colors
    from yadefrag.plots import fragments
    rows = [','.join(map(str, range(step, step + 17))) for step in range(2)]
    file = written(folder, 'run.csv', '\n'.join([fragments._RECORDED, *rows, '']))
    lines = [line for ax in fragments.plotFracture(file, folder + '/a.png') for line in ax.lines]
    labels = [line.get_label() for line in lines]
    assert len(set(labels)) == len(labels) == 13
    lines = [line for line in lines if line.get_linestyle() == '-']
    shades = numpy.array([colors.to_rgb(line.get_color()) for line in lines])
    assert len(shades) == 12
    distances = numpy.linalg.norm(shades[:, None] - shades, axis=2) + numpy.eye(12)
    assert distances.min() >= .25


def imports(module):
    """Names of the package's modules that a module imports, at its top or in a function."""
    tree = ast.parse(pathlib.Path(module.__file__).read_text())
    return {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}


def test_picturesAndFragmentsDoNotImportEachOther():
    from yadefrag.plots import axes, fragments
    assert 'yadefrag.plots.fragments' not in imports(pictures)
    assert 'yadefrag.plots.pictures' not in imports(fragments)
    assert not {'yadefrag.plots.pictures', 'yadefrag.plots.fragments'} & imports(axes)


def test_filmRunsTheScene(folder):
    """Its body goes right by 0.1 m a step, by YADE's loop."""
    fe = makeSolver()
    utils.mover = lambda: setattr(fe, 'nodes', fe.nodes + [.1, 0])
    O.engines = [wrapper.PyRunner(command='__import__("yade.utils").utils.mover()', iterPeriod=1, initRun=True)]
    O.dt = 1
    frames = pictures.animate(fe, folder + '/out.gif', steps=7, every=3, field='mises')
    del utils.mover
    assert O.iter == 7 and frames == 4
    assert fe.nodes[0, 0] == pytest.approx(.7)
    with Image.open(folder + '/out.gif') as film:
        assert film.n_frames == 4


def test_importNeedsNoLibraries(folder):
    """Scripts that draw and read nothing neither wait for them nor need their packages."""
    script = written(folder, 'script.py', '''import sys
before = set(sys.modules)
import yadefrag
new = {name.partition(".")[0] for name in set(sys.modules) - before}
print("@", sorted({"matplotlib", "meshio", "PIL", "scipy", "shapely", "tqdm"} & new))
''')
    assert '@ []' in inYade(script).stdout
