"""Pictures of the bodies of an FESolver, with Matplotlib."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy

from yade.wrapper import Omega
from yadefrag.arguments import ArrayLike, FESolver, File, flag, number, numbersOf, path, refuse, whole
from yadefrag.fe.contents import betweenSteps, requireSolver, shownMesh
from yadefrag.fe.fields import FIELDS, fieldValues, nameOf
from yadefrag.files import replacing, requireWritable, savePicture
from yadefrag.plots.axes import (MOST_PANELS, CrackLines, YadeBodies, axesOf, barSettings, damageBar, fragmentColours,
                                 newFigure, newPanels, palette, panelSize)
from yadefrag.scene.lifecycle import requireNoStep, runPart

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_NO_VALUE = '.8'  # grey of triangles without a value


def plotMesh(fe: FESolver, field: str | ArrayLike | None = None, file: File | None = None, ax: Axes | None = None,
             limits: Sequence | None = None, *, fields: Sequence[str | ArrayLike | None] | None = None,
             xlim: ArrayLike | None = None, ylim: ArrayLike | None = None, spheres: bool = True,
             rigidBodies: bool = True, scale: float = 1, mirror: bool = False) -> Axes | list[Axes]:
    """Draws the triangles of an FESolver at their present positions, without removed fragments; cracks
    that cohesion holds, coloured by their damage, and open ones black, above them; and YADE's spheres,
    walls, boxes and facets. Returns Matplotlib's axes.

    field   None (no colours), 'xx', 'yy', 'xy', 'zz' (Pa), 'mises' (Pa, from these four; 'stress' is the
            same), 'sigma1', 'sigma2' (Pa, larger and smaller principal stress in the plane; 'principal1', 'principal2' are the same), 'strain' (√(xx² + yy² + 2xy²)), 'plasticStrain',
            'temperature' (K; grey without one), 'damage', 'speed' or 'velocity' (m/s), 'displacement' (m),
            'contactForce', 'reaction' (N; lengths of the vectors), 'component', 'fragment' (arbitrary
            colours, different for adjacent fragments), the names of exportVTK ('plastic strain'), or an
            array with one number for each triangle or each node
    file    path of the picture; its ending determines the format (.png, .pdf, .svg ...)
    ax      axes to draw in; default: new ones
    limits  (lowest, highest) value of the colour scale; default: those of the field
    fields  instead of `field`, a list of several: drawn for the same moment, side by side, or below
            each other if the contents are more than twice as wide as high; `limits` is then one
            pair for all, or a list with a pair or None for each. Returns a list of axes
    xlim    (left, right) in m of the drawn region; default: all
    ylim    (bottom, top) in m, likewise
    spheres True: draws YADE's spheres, also members of clumps, in their colours, with their full
            radius at any distance from the plane
    rigidBodies True: draws the sections of YADE's Wall, Box and Facet with the plane z = 0, in their
            colours. They widen the drawn region by at most half of the size of bodies and spheres
    scale   factor of the displacements from the stress-free shape in the drawn positions of nodes; 0
            draws that shape. Spheres and rigid bodies are drawn where they are
    mirror  True: draws both sides of the axis of an axisymmetric solver
    ValueError for any other field or limits, and for a solver without bodies.
    """
    _requireBodies(fe)
    asked = flag('spheres', spheres), flag('rigidBodies', rigidBodies)
    chosen = [field] if fields is None else _severalFields(field, fields, ax)
    limits = _limitsOfAll(limits, len(chosen)) if fields is not None else [_limits(limits)]
    window = _range('xlim', xlim), _range('ylim', ylim)
    scale = _scale(scale)
    if flag('mirror', mirror) and not fe.axisymmetric:
        refuse('mirror', mirror, 'False, since fe is not axisymmetric')
    with betweenSteps(fe):
        pictures = [_Picture(fe, one, scale=scale, mirror=mirror) for one in chosen]
        others = YadeBodies(*asked)
    if ax is not None:
        panels = [axesOf(ax)]
    else:
        panels = newPanels(len(chosen), *_extent(pictures[0], others, window))
    lines = []
    for one, picture, ends in zip(panels, pictures, limits):
        lines.append(_draw(one, picture, ends, others, _extent(picture, others, window)))
        if len(panels) > 1 and picture.isOfFragments:  # it has no colour bar
            one.set_title('fragment')
        one.set(**{name: ends for name, ends in zip(('xlim', 'ylim'), window) if ends})
    damageBar(panels, lines)
    # Nothing is cut off, and no margin remains beside axes of a fixed ratio.
    savePicture(panels[0].figure, file, 150, **({} if ax is not None else dict(bbox_inches='tight')))
    return panels[0] if fields is None else panels


def _severalFields(field, fields, ax):
    """A list of fields, checked as far as possible without the solver."""
    if field is not None or ax is not None:
        raise ValueError('fields comes with field or ax, it must be given without them.')
    if not isinstance(fields, (list, tuple)) or not 0 < len(fields) <= MOST_PANELS:
        refuse('fields', fields, 'a list of 1 to %d fields' % MOST_PANELS)
    return list(fields)


def _limitsOfAll(limits, count):
    """A list of `count` pairs."""
    if limits is None or numbersOf(limits, 2) is not None:
        return [_limits(limits)] * count
    if not isinstance(limits, (list, tuple)) or len(limits) != count:
        refuse('limits', limits, 'a pair of numbers, or a list with a pair or None for each of the '
               '%d fields' % count)
    return [_limits(one) for one in limits]


def _range(name, value):
    """A pair of floats; None for none."""
    ends = _finitePair(value)
    if value is not None and (ends is None or not ends[0] < ends[1]):
        refuse(name, value, 'a pair of numbers (m), the lower one first')
    return ends


def _scale(value):
    return number('scale', value, lambda v: 0 <= v < math.inf, 'a positive number, or 0')


def _extent(picture, others, window):
    """(width, height) in m of the drawn region."""
    low, high = others.extent(*picture.box())
    return [ends[1] - ends[0] if ends else side for ends, side in zip(window, high - low)]


class _Picture:
    """Data of one picture: x, y of the nodes, triangles, values of triangles or nodes.

    former  as in fragmentColours, which determines the colours
    scale   factor of the displacements
    mirror  adds the other side of the axis
    """

    def __init__(self, fe, field, former=None, scale=1, mirror=False):
        self.field = field = nameOf(field)
        values: Any
        perNode: bool | None
        with betweenSteps(fe):
            self.isOfFragments: bool = isinstance(field, str) and field == 'fragment'
            if self.isOfFragments:
                self.colours = fragmentColours(fe, former)
                values, perNode = self.colours % 20, False
            else:
                values, perNode = fieldValues(fe, field)
            nodes, shown, self.triangles = shownMesh(fe)
            places = numpy.asarray(fe.nodes, dtype=float)
            if scale != 1:
                places = places + (scale - 1) * fe.displacements
            self.cracks = CrackLines(fe, places)
            self.x, self.y = places[nodes].T
        self.perNode = perNode
        self.values = None if values is None else values[nodes if perNode else shown]
        if mirror:
            self._mirror()

    def _mirror(self):
        self.triangles = numpy.concatenate([self.triangles, self.triangles[:, ::-1] + len(self.x)])
        self.x, self.y = numpy.concatenate([self.x, -self.x]), numpy.tile(self.y, 2)
        self.values = None if self.values is None else numpy.tile(self.values, 2)
        self.cracks.mirror()

    def box(self):
        """(low, high) of the nodes, each (2) in m."""
        places = numpy.stack([self.x, self.y], axis=1)
        return places.min(axis=0), places.max(axis=0)


def _requireBodies(fe):
    requireSolver(fe)
    with betweenSteps(fe):
        isEmpty = len(shownMesh(fe)[1]) == 0
    if isEmpty:
        raise ValueError('fe has no bodies to draw, add one with fe.addPolygon first.')


def _limits(limits):
    """A pair of floats; a pair of None for no limits."""
    if limits is None:
        return None, None
    ends = _finitePair(limits)
    if ends is None or ends[0] > ends[1]:
        refuse('limits', limits, 'a pair of numbers (lowest, highest)')
    return ends


def _finitePair(value):
    """A pair of floats; None for other values."""
    found = numbersOf(value, 2)
    return found if found is not None and all(map(math.isfinite, found)) else None


def _corners(window):
    """((left, bottom), (right, top)) of floats."""
    try:
        low, high = map(_finitePair, window)
    except (TypeError, ValueError):
        low = high = None
    if low is None or high is None:
        refuse('window', window, '((left, bottom), (right, top)) in m')
    return low, high


def _draw(ax, picture, limits, others, sides):
    """Returns the lines of cracks that have a colour scale, or None. sides: (width, height) of the contents."""
    _drawTriangles(ax, picture, limits, sides)
    lines = picture.cracks.draw(ax)
    others.draw(ax, *picture.box())
    return lines


def _drawTriangles(ax, picture, limits, sides):
    x, y, triangles = picture.x, picture.y, picture.triangles
    field, values = picture.field, picture.values
    lines = .5 if len(triangles) < 2000 else .1
    ax.set_aspect('equal')
    ax.set_xlabel('x (m)')
    ax.set_ylabel('y (m)')
    if sides[1] > sides[0]:
        ax.locator_params(axis='x', nbins=5)  # more labels would cover each other
    if sides[1] > 4 * sides[0]:
        ax.tick_params('x', rotation=90)
    if values is None or not numpy.isfinite(values).any():
        ax.triplot(x, y, triangles, color='.3', linewidth=lines)
        return
    if picture.isOfFragments:
        from matplotlib.colors import ListedColormap, NoNorm
        ax.tripcolor(x, y, triangles=triangles, facecolors=values, norm=NoNorm(),
                     cmap=ListedColormap(palette()), edgecolors='k', linewidth=lines / 3)
        return
    from matplotlib import colormaps
    colours = colormaps['viridis'].with_extremes(bad=_NO_VALUE)
    scale = dict(zip(('vmin', 'vmax'), limits), cmap=colours)
    if picture.perNode:
        drawn = ax.tripcolor(x, y, values, triangles=triangles, shading='gouraud', **scale)
    else:
        drawn = ax.tripcolor(x, y, triangles=triangles, facecolors=numpy.ma.masked_invalid(values),
                             edgecolors='k', linewidth=lines / 3, **scale)
    label = FIELDS[field].label if isinstance(field, str) else ''
    ax.figure.colorbar(drawn, ax=ax, label=label, **barSettings(*sides))


def animate(fe: FESolver, file: File, steps: int, every: int, field: str | None = None,
            limits: ArrayLike | None = None, window: Sequence[ArrayLike] | None = None, rate: float = 20,
            spheres: bool = True, rigidBodies: bool = True, scale: float = 1) -> int:
    """Runs the scene for `steps` steps and writes a GIF with a frame at the start and after each
    `every` steps; returns the number of frames.

    field, limits  as in plotMesh, but no arrays; without limits each frame has its own colour scale
    window         ((left, bottom), (right, top)) in m; default: all nodes of the first frame and a
                   quarter more on each side
    rate           frames per second
    spheres, rigidBodies, scale  as in plotMesh
    If the run is interrupted, paused or fails, the frames so far are written. ValueError, before any
    step, for counts that are not positive, a field or limits as in plotMesh, a file that is no
    .gif, an invalid window; OSError for a file that cannot be written.
    """
    from matplotlib.animation import PillowWriter

    _requireBodies(fe)
    if field is not None and not isinstance(field, str):
        raise ValueError('field is an array, which does not change during the run; it must be a name or None.')
    start = _Picture(fe, field)
    scale = _scale(scale)
    steps, every = whole('steps', steps), whole('every', every)
    rate = number('rate', rate, lambda r: .01 <= r <= 1000, 'a number of frames per second from 0.01 to 1000')
    limits, asked = _limits(limits), (flag('spheres', spheres), flag('rigidBodies', rigidBodies))
    low, high = start.box() if window is None else _corners(window)
    if window is None:
        margin = (high - low).max() / 4
        low, high = low - margin, high + margin
    name = path('file', file, '.gif')
    requireNoStep('animate')
    requireWritable(name)
    sides = high[0] - low[0], high[1] - low[1]
    figure = newFigure(*panelSize(*sides), 'constrained')
    writer = PillowWriter(fps=rate)
    writer.setup(figure, name, dpi=80)
    frames, colours = 0, None
    try:
        for done in _runInParts(steps, every):
            figure.clear()
            ax = figure.add_subplot()
            with betweenSteps(fe):
                picture = _Picture(fe, field, colours, scale)
                others = YadeBodies(*asked)
            if field == 'fragment':  # a fragment keeps its colour from frame to frame
                colours = picture.colours
            damageBar([ax], [_draw(ax, picture, limits, others, sides)])
            ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), title='step %d' % done)
            writer.grab_frame()
            frames += 1
    finally:
        if frames > 0:
            with replacing(name) as writer.outfile:
                writer.finish()
    return frames


def _runInParts(steps, every):
    """Runs YADE's scene in parts; yields its step number before the first part and after each."""
    scene, done, isPaused = Omega(), 0, False
    yield scene.iter
    while done < steps and not isPaused:
        part, isPaused = runPart(min(every, steps - done))
        done += part
        yield scene.iter
