"""Contents of an FESolver for pictures and files: everything except removed fragments."""

import numpy

from yadefrag.arguments import refuse
from yadefrag.hints import FESolver


def requireSolver(fe: FESolver) -> None:
    """ValueError unless `fe` is an FESolver."""
    if not hasattr(fe, 'triangles'):
        refuse('fe', fe, 'an FESolver')


def shownTriangles(fe: FESolver) -> numpy.ndarray:
    """Numbers (k) of the triangles that were not removed. Must be called between two steps."""
    if fe.dropped['count'] == 0:
        return numpy.arange(len(fe.triangles))
    return numpy.nonzero(fe.fragmentOf >= 0)[0]


def heldCracks(fe: FESolver) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """(nodes (k, 4), triangles (k), damage (k)) of the cohesive cracks: the two nodes of the first
    side, then the opposite ones; the adjacent triangle. Must be called between two steps."""
    cracks = fe._cracks()
    held = cracks['held']
    return cracks['nodes'][held], cracks['triangle'][held], cracks['damage'][held]


def shownMesh(fe: FESolver) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """(nodes (n), triangles (k), corners (k, 3)): numbers of the existing nodes and triangles, and the
    triangles' corners as indices of these nodes. Must be called between two steps."""
    corners = numpy.asarray(fe.triangles)
    triangles = shownTriangles(fe)
    if len(triangles) == len(corners):
        return numpy.arange(len(fe.nodes)), triangles, corners
    nodes, places = numpy.unique(corners[triangles], return_inverse=True)
    return nodes, triangles, places.reshape(-1, 3)
