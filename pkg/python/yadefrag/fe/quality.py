"""Quality of a body's mesh."""

from typing import Any

from yadefrag.arguments import isWhole, plain, refuse
from yadefrag.fe.between_steps import betweenSteps
from yadefrag.fe.contents import existingBody, requireSolver
from yadefrag.hints import FESolver


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


def meshQuality(self: FESolver, component: int | str | None = None) -> dict[str, Any]:
    """The shape of the triangles in the stress-free mesh of a body.

    component  the body's number or name; None if there is only one
    A dict:
    minAngle       smallest angle of a triangle (rad)
    size           edges of an even lattice with as many triangles in the area (m)
    timeStepRatio  critical time step, over that of this lattice
    shortestEdge   m
    numTriangles   without those of removed fragments
    ValueError for a component that does not exist.
    """
    requireSolver(self)
    with betweenSteps(self):
        return dict(self._meshQuality(_component(self, component)))
