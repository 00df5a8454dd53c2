"""Fragments of an FESolver's bodies: tables, pictures of their sizes, a record over time."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

import numpy

from yade.wrapper import Omega
from yadefrag.arguments import FESolver, File, flag, isWhole, path, plain, refuse, shownPath
from yadefrag.fe.contents import betweenSteps, existingBody, requireSolver
from yadefrag.files import appendText, savePicture, writeColumns, writeText
from yadefrag.plots.axes import DISTINCT, axesOf, newFigure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_COLUMNS = (('fragment', '', int), ('component', '', int), ('triangles', '', int),
            ('mass', 'kg', float), ('area', 'm²', float), ('size', 'm', float), ('x', 'm', float),
            ('y', 'm', float), ('vx', 'm/s', float), ('vy', 'm/s', float), ('spin', 'rad/s', float))
_ENERGIES = ('kinetic', 'strain', 'contact', 'friction', 'fracture', 'damping', 'dropped', 'external', 'total')
_COUNTS = ('step', 'time (s)', 'cracks', 'segments', 'fragments')
_STATES = ('open', 'damaged', 'whole')
_RECORD = _COUNTS + tuple('%s (J)' % e for e in _ENERGIES) + tuple('%s cracks' % s for s in _STATES)
_RECORDED = ','.join(_RECORD)


def fragmentTable(fe: FESolver, file: File | None = None) -> numpy.ndarray:
    """All fragments, the largest area first, as a NumPy array with named columns (k). What cohesion or a
    bond still holds together is one fragment.

    Columns: fragment (its index in fe.fragments(), the number in fe.fragmentOf), component (of its
    first triangle), triangles (their number), mass (kg), area (m², in the plane), size (√area, m), x, y (centroid, m),
    vx, vy (m/s), spin (rad/s).
    file  path of a .csv to write as well, with the units in its first line
    ValueError for another ending, before anything is written.
    """
    requireSolver(fe)
    name = None if file is None else path('file', file, '.csv')
    rows = [(number, f['component'], f['triangles'], f['mass'], f['area'], numpy.sqrt(max(f['area'], 0)),
             *f['centroid'], *f['velocity'], f['spin']) for number, f in enumerate(fe.fragments())]
    table = numpy.array(rows, dtype=[(name, kind) for name, _, kind in _COLUMNS])
    table = table[numpy.argsort(-table['area'], kind='stable')]
    if name is not None:
        writeColumns(name, _COLUMNS, table)
    return table


def plotFragmentSizes(fe: FESolver, file: File | None = None, ax: Axes | None = None,
                      components: str | Iterable[int | str] | None = None) -> Axes:
    """Draws the number of fragments that are at least as large as a size, with logarithmic axes; returns
    Matplotlib's axes.

    file        path of the picture; its ending determines the format (.png, .pdf, .svg ...)
    ax          axes to draw in; default: new ones
    components  numbers or names of the bodies whose fragments are counted; default: all broken ones, and
                bonded ones that have come apart
    ValueError if there is no such body.
    """
    requireSolver(fe)
    if components is not None:
        components = _componentNumbers(fe, components)
    with betweenSteps(fe):
        table, of = fragmentTable(fe), fe.fragmentOf
        bodies = _brokenBodies(fe, of) if components is None else components
        chosen = table[numpy.isin(table['fragment'], of[numpy.isin(fe.components, bodies)])]
    if len(chosen) == 0:
        raise ValueError('fe has no broken body: there are no sizes to draw.')
    ax = axesOf(ax)
    # The curve falls after each size: the point (size, number) is the last one on its level.
    sizes = chosen['size'][::-1]
    ax.step(sizes, numpy.arange(len(sizes), 0, -1), where='pre', marker='.', markersize=4, linewidth=1)
    ax.set(xscale='log', yscale='log', xlabel='size of a fragment, √area (m)', ylabel='fragments at least as large')
    ax.grid(True, which='both', linewidth=.3)
    savePicture(ax.figure, file, dpi=150)
    return ax


def _brokenBodies(fe, of):
    """Numbers of the bodies that have come apart, from their own other parts or from those that they
    were bonded to."""
    isThere = of >= 0
    fragments, bodies = numpy.unique(numpy.stack([of, fe.components])[:, isThere], axis=1)
    cracks = fe._cracks()
    # Bodies belong together if a fragment has both, or a crack is between them.
    firsts = bodies[numpy.searchsorted(fragments, fragments)]
    ends = numpy.concatenate([[firsts, bodies], [cracks['component'], cracks['other']]], axis=1).astype(int)
    group = numpy.arange(ends.max(initial=0) + 1)
    while (group[ends[0]] != group[ends[1]]).any():
        least = group[ends].min(axis=0)
        for end in ends:
            numpy.minimum.at(group, end, least)
    parts = numpy.unique(numpy.stack([group[bodies], fragments]), axis=1)[0]
    return bodies[numpy.bincount(parts, minlength=len(group))[group[bodies]] > 1]


def _componentNumbers(fe, components):
    """A list of int from a list of body numbers and names."""
    try:
        listed = [components] if isinstance(components, str) else components
        found = [existingBody(fe, one) if isinstance(one, str) else plain(one) for one in listed]
    except TypeError:
        found = [None]
    if not all(map(isWhole, found)):
        refuse('components', components, 'a list of numbers or names of bodies')
    return found


def recordFracture(fe: FESolver, file: File, append: bool = False) -> Callable[[], None]:
    """Returns a function that appends a line to `file` (.csv) at each call; writes a first line at
    once.

    For runSteps, `runSteps(5000, every=100, call=recordFracture(fe, 'run.csv'))`, and for a
    PyRunner, `record = recordFracture(fe, 'run.csv')` and
    `PyRunner(command='record()', iterPeriod=100)`. A line has the step, the time (s), the numbers
    of cracks, surface segments and fragments, all of fe.energy (J), and the cracks by state as in
    fe.crackCounts. It is in the file when the call returns. append=True continues an existing file, for a run that was loaded. ValueError for
    another ending, and for an existing file with other columns.
    """
    requireSolver(fe)
    name = path('file', file, '.csv')
    if flag('append', append) and os.path.exists(name) and os.path.getsize(name):
        if _linesOf(name)[:1] != [_RECORDED]:
            raise ValueError('%s has other columns than those of recordFracture: use another '
                             'file, or append=False to overwrite it.' % shownPath(name))
    else:
        writeText(name, _RECORDED + '\n')

    def record():
        scene = Omega()
        with betweenSteps(fe):
            energy = fe.energy
            row = (scene.iter, scene.time, fe.numCracks, fe.numSegments, len(fe.fragments()),
                   *(energy.get(e, 0.) for e in _ENERGIES), *fe.crackCounts.values())
        appendText(name, ','.join(map(repr, row)) + '\n')

    record()
    return record


def _linesOf(name):
    """The lines of a file of recordFracture, with the heading; none if the file is of another kind."""
    with open(name, encoding='utf-8-sig', errors='replace') as file:
        lines = file.read().splitlines()
    return lines if lines and lines[0] == _RECORDED else []


def _recorded(file):
    """{column: floats} from a file of recordFracture."""
    name = path('file', file, '.csv')
    try:
        rows = [[float(cell) for cell in line.split(',')] for line in _linesOf(name)[1:]]
        data = numpy.array(rows, dtype=float)
    except ValueError:
        data = numpy.empty(0)
    if data.ndim != 2 or data.shape[1] != len(_RECORD):
        raise ValueError('%s has no lines of recordFracture, or a damaged one.' % shownPath(name))
    return dict(zip(_RECORD, data.T))


def plotFracture(file: File, picture: File | None = None) -> tuple[Axes, Axes]:
    """Draws a file of recordFracture: counts and energies over time; returns both axes.

    picture  path of the picture; its ending determines the format (.png, .pdf, .svg ...)
    ValueError for a file with other columns or without a line.
    """
    data = _recorded(file)
    time = 1e6 * data['time (s)']
    figure = newFigure(8, 6)
    upper, lower = figure.subplots(2, 1, sharex=True)
    for name, colour, style in zip(('cracks', 'segments', 'fragments', 'open cracks'),
                                   DISTINCT[len(_ENERGIES):] + DISTINCT[len(_ENERGIES):], ('-', '-', '-', '--')):
        upper.plot(time, data[name], style, label=name, color=colour)
    upper.set(ylabel='number', ylim=(0, None))
    for name, colour in zip(_ENERGIES, DISTINCT):
        lower.plot(time, data[name + ' (J)'], label=name, color=colour)
    lower.set(xlabel='time (µs)', ylabel='energy (J)')
    for ax in (upper, lower):
        ax.legend(loc='center left', bbox_to_anchor=(1, .5))
        ax.grid(True, linewidth=.3)
    savePicture(figure, picture, 150, 'picture')
    return upper, lower
