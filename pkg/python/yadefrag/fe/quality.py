"""Quality of a body's mesh, in numbers and in a picture."""

import math
from typing import Any

import numpy

from yadefrag.arguments import isWhole, plain, refuse
from yadefrag.fe.between_steps import betweenSteps
from yadefrag.fe.contents import existingBody, requireSolver
from yadefrag.hints import FESolver, File
from yadefrag.io.files import savePicture


def _component(fe, component):
    """The number of the body that `component` refers to; None: the only one."""
    there = sorted(set(int(c) for c in fe.components))
    if isinstance(component, str):
        return existingBody(fe, component)
    if component is None:
        if len(there) != 1:
            raise ValueError('component is None, but there are %d bodies; it must be one of %s.' %
                             (len(there), there))
        return there[0]
    if not isWhole(component) or plain(component) not in there:
        refuse('component', component, 'the number of a body, one of %s' % there)
    return int(component)


def meshQuality(self: FESolver, component: int | str | None = None,
                plot: File | None = None) -> dict[str, Any]:
    """Directional bias of the stress-free mesh of a body, and the shape of its triangles.

    component  the body's number or name; None if there is only one
    plot       file for a picture of edges and paths by direction; its ending determines the format
    A dict:
    pathRatio             mean length of the shortest path along edges, over the straight line
    pathSpread            largest minus smallest of pathRatioByDirection
    pathRatioByDirection  array (36): the mean for lines of each 5° from 0 to 180°
    edgeDeviation         largest |edgesByDirection - 1|
    edgesByDirection      array (36): inner edges in each 5°, relative to a uniform distribution
    minAngle              smallest angle of a triangle (rad)
    size                  edges of an even lattice with as many triangles in the area (m)
    timeStepRatio         critical time step, over that of this lattice
    shortestEdge          m
    numTriangles          without those of removed fragments
    Paths connect 200 nodes with nodes at a distance of 30 to 50 edges (or of 0.3 to 0.5 of √area if
    that is less), along lines that stay inside the body; NaN if there are none. Cracks count as
    closed. ValueError for a component that does not exist.
    """
    requireSolver(self)
    with betweenSteps(self):
        number = _component(self, component)
        quality = dict(self._meshQuality(number))
    if plot is not None:
        _plot(quality, number, plot)
    return quality


def _plot(quality, number, file):
    from yadefrag.plots.axes import newAxes
    figure = newAxes().figure
    figure.clear()
    figure.set_size_inches(9, 4.8)
    figure.suptitle('body %d: %d triangles of %.4g m, smallest angle %.1f°, time step %.2f of the '
                    "lattice's" % (number, quality['numTriangles'], quality['size'],
                                   math.degrees(quality['minAngle']), quality['timeStepRatio']))
    panels = (('edgesByDirection', 'inner edges over a uniform distribution', 1, 0,
               'largest deviation %.3f' % quality['edgeDeviation']),
              ('pathRatioByDirection', 'path along edges over straight line', quality['pathRatio'],
               1, 'mean %.4f, spread %.4f' % (quality['pathRatio'], quality['pathSpread'])))
    for i, (name, title, even, origin, words) in enumerate(panels):
        values = quality[name]
        axes = figure.add_subplot(1, 2, i + 1, projection='polar')
        angles = (numpy.arange(2 * len(values)) + .5) * math.pi / len(values)
        axes.plot(numpy.append(angles, angles[:1]), numpy.append(numpy.tile(values, 2), values[:1]))
        axes.plot(numpy.linspace(0, 2 * math.pi, 181), numpy.full(181, even), ':', color='grey')
        top = numpy.nanmax(values) if numpy.isfinite(values).any() else 2
        axes.set_ylim(origin, origin + 1.1 * (top - origin))
        axes.set_title(title + '\n' + words, fontsize='medium')
    savePicture(figure, file, dpi=150)
