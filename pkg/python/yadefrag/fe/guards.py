"""Forbidden operations on the bodies of an FESolver, each refused with one sentence."""

import functools
import numbers

from yade import wrapper
from yadefrag.fe.contents import bodyNumber, requireBetweenSteps
from yadefrag.messages import inWords


def _pieceOf(body):
    """The shape of a body that is part of a boundary; None for any other."""
    shape = body.shape if body else None
    return shape if isinstance(shape, wrapper.SurfaceSegment) and shape.entry >= 0 else None


def _refuse(id, piece, words):
    raise ValueError('body #%d is part of the boundary of body %d of FESolver%s.' %
                     (id, piece.component, words.replace('{}', '%d' % piece.component)))


def _requireNoPiece(container, id, words=', it cannot be in a clump'):
    isPlace = isinstance(id, numbers.Integral) and 0 <= int(id) < len(container)
    piece = _pieceOf(container[int(id)]) if isPlace else None
    if piece:
        _refuse(id, piece, words)


def _guardErase(erase):
    """O.bodies.erase that does not erase single pieces of a boundary."""
    @functools.wraps(erase)
    def guarded(self, id, eraseClumpMembers=False):
        _requireNoPiece(self, id, ', it cannot be erased alone; FESolver.removeBody({}) removes the whole body')
        return erase(self, id, eraseClumpMembers)
    return guarded


def _guardInsert(insert):
    """O.bodies.insertAtId that does not replace a piece of a boundary."""
    @functools.wraps(insert)
    def guarded(self, body, id):
        _requireNoPiece(self, id, ', another one cannot replace it')
        return insert(self, body, id)
    return guarded


def _guardClump(clump):
    """A function of O.bodies whose first argument is numbers of bodies: refuses pieces of a boundary,
    for which YADE would end the process."""
    @functools.wraps(clump)
    def guarded(self, ids, *others, **settings):
        ids = list(ids) if hasattr(ids, '__iter__') else ids  # no list: YADE raises the exception
        for id in ids if isinstance(ids, list) else ():
            _requireNoPiece(self, id)
        return clump(self, ids, *others, **settings)
    return guarded


def _guardBodies(function):
    """A function of O.bodies whose arguments are bodies of clumps, likewise."""
    @functools.wraps(function)
    def guarded(self, *bodies):
        for body in bodies:
            if isinstance(body, wrapper.Body) and _pieceOf(body):
                _requireNoPiece(self, body.id)
        return function(self, *bodies)
    return guarded


def _guardPart(name):
    """Body.state or Body.shape of a piece must not be replaced: other engines would end the process."""
    part = getattr(wrapper.Body, name)

    def guarded(self, value):
        piece = _pieceOf(self)
        if piece:
            _refuse(self.id, piece, ': a script must not replace its %s' % name)
        part.fset(self, value)
    return property(part.fget, guarded, doc=part.__doc__)


def _guardRemove(remove):
    """FESolver.removeBody with a message for an invalid number."""
    @functools.wraps(remove)
    def guarded(self, component):
        requireBetweenSteps()
        return remove(self, bodyNumber(self, component))
    return guarded


def _withoutArguments(function):
    @functools.wraps(function)
    def guarded(self):
        return function(self)
    return guarded


def _guardCopy(reduce):
    """For copy and pickle: allowed only for a solver without bodies, since a copy would have none of them."""
    def guarded(self, protocol):
        if len(self.masses) > 0:
            raise TypeError('an FESolver with bodies cannot be copied or pickled, since its '
                            'bodies belong to the scene; O.save keeps them, or create a new one.')
        return reduce(self, protocol)

    return guarded


def install() -> None:
    wrapper.FESolver.removeBody = inWords(_guardRemove(wrapper.FESolver.removeBody))
    for name in ('criticalTimeStep', 'deepestOverlap'):
        setattr(wrapper.FESolver, name, inWords(_withoutArguments(getattr(wrapper.FESolver, name))))
    wrapper.FESolver.__reduce_ex__ = _guardCopy(wrapper.FESolver.__reduce_ex__)
    for name in ('state', 'shape'):
        setattr(wrapper.Body, name, _guardPart(name))
    for guard, names in ((_guardErase, ['erase']), (_guardInsert, ['insertAtId']),
                         (_guardClump, ['clump', 'addToClump']),
                         (_guardBodies, ['deleteClumpMember', 'deleteClumpBody'])):
        for name in names:
            setattr(wrapper.BodyContainer, name, guard(getattr(wrapper.BodyContainer, name)))
