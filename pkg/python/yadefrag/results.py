"""What FESolver's bodies feel: reactions, forces of contact, principal stresses, cracks."""

import numpy

from yadefrag.files import writeText
from yadefrag.motions import chosenNodes
from yadefrag.names import existingBody, isBody
from yadefrag.shown import betweenSteps, requireSolver
from yadefrag.values import path

_CRACKS = (('component', '', int), ('other', '', int), ('x', 'm', float), ('y', 'm', float),
           ('nx', '', float), ('ny', '', float), ('opening', 'm', float), ('slip', 'm', float),
           ('damage', '', float), ('held', '', bool), ('start', 's', float))


def reaction(self, nodes):
    """(x, y) in N: the sum of `reactions` over nodes, in the last step.

    nodes  as in `prescribe`, or a body's number or name: all of it
    """
    with betweenSteps(self):
        chosen = self.nodesOf(nodes) if isBody(nodes) else chosenNodes(self, nodes)
        return tuple(self.reactions[chosen].sum(axis=0).tolist())


def contactForce(self, a, b=None):
    """(x, y) in N: what contact did to body a in the last step, by body b, or by all bodies.

    a, b  numbers or names of bodies of this engine; spheres do not count. 0 after O.load, until the
          next step. ValueError for no such body.
    """
    with betweenSteps(self):
        first = existingBody(self, a, 'a')
        if b is None:
            return tuple(self.contactForces[self.nodesOf(first)].sum(axis=0).tolist())
        second = existingBody(self, b, 'b')
        return (0., 0.) if first == second else self._pairForce(first, second)


def principalStress(self):
    """Larger and smaller principal stress in the plane (Pa), and the angle of the larger one's
    direction from the x axis (rad, above -π/2 and up to π/2), of the triangles, array (m, 3)."""
    xx, yy, xy = self.stress.T
    mean, half = (xx + yy) / 2, (xx - yy) / 2
    radius = numpy.hypot(half, xy)
    return numpy.stack([mean + radius, mean - radius, numpy.arctan2(xy, half) / 2], axis=1)


def crackTable(fe, file=None):
    """All cracked edges, as a NumPy array with named columns (k); bonds and open joints, too.

    Columns: component, other (the bodies on both sides), x, y (m, its middle now), nx, ny (normal,
    from the first side to the other), opening, slip (m, of the middles of both sides, across and along,
    the other one's along (-ny, nx) positive), damage (part of its fracture energy that is spent, 1 where
    nothing holds any more), held (does cohesion still hold it), start (s of fe.time; nan: there from
    the beginning). Those of dropped fragments are left out.
    file  where to write it besides, a .csv with the units in its first line
    ValueError for another ending, before anything is written.
    """
    requireSolver(fe)
    name = None if file is None else path('file', file, '.csv')
    columns = fe._cracks()
    table = numpy.empty(len(columns['x']), dtype=[(column, kind) for column, _, kind in _CRACKS])
    for column, _, _ in _CRACKS:
        table[column] = columns[column]
    if name is not None:
        heading = ','.join('%s (%s)' % (n, unit) if unit else n for n, unit, _ in _CRACKS)
        lines = [','.join(repr(int(v)) if isinstance(v, bool) else repr(v) for v in row)
                 for row in table.tolist()]
        writeText(name, '\n'.join([heading, *lines, '']))
    return table
