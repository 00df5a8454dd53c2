"""What there is to draw and to write of an FESolver: all but dropped fragments."""

import contextlib

import numpy

from yadefrag.values import refuse


@contextlib.contextmanager
def betweenSteps(fe):
    """Keeps the steps of a run in another thread off: all reads in the block see one state.

    A block within a block of the same thread is fine. It must not wait for the run.
    """
    fe._lock()
    try:
        yield
    finally:
        fe._unlock()


def requireSolver(fe):
    """ValueError for what has no triangles to show: not an FESolver."""
    if not hasattr(fe, 'triangles'):
        refuse('fe', fe, 'an FESolver')


def shownTriangles(fe):
    """Numbers (k) of the triangles that were not dropped. To be called between two steps."""
    if fe.dropped['count'] == 0:
        return numpy.arange(len(fe.triangles))
    return numpy.nonzero(fe.fragmentOf >= 0)[0]


def heldCracks(fe):
    """(nodes (k, 4), triangles (k), damage (k)) of the cracks that cohesion holds: the two nodes of
    the first side, then those opposite; the triangle beside it. To be called between two steps."""
    cracks = fe._cracks()
    held = cracks['held']
    return cracks['nodes'][held], cracks['triangle'][held], cracks['damage'][held]


def shownMesh(fe):
    """(nodes (n), triangles (k), corners (k, 3)): which nodes and triangles there are, and the
    triangles' corners as places among these nodes. To be called between two steps."""
    corners = numpy.asarray(fe.triangles)
    triangles = shownTriangles(fe)
    if len(triangles) == len(corners):
        return numpy.arange(len(fe.nodes)), triangles, corners
    nodes, places = numpy.unique(corners[triangles], return_inverse=True)
    return nodes, triangles, places.reshape(-1, 3)
