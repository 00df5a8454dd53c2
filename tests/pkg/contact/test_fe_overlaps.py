"""Overlaps of elastic bodies by brute force, from their triangles: with two passes none is deeper than
fe.maxPenetration says, for elements of 1:1 to 1:5, turned bodies, regular and irregular meshes."""

import builtins
import math

import numpy as np
import pytest

import yade.wrapper as w
import yadefrag
from scenes import clear
from yadefrag import runSteps

O = builtins.O
SIZE = 3.49e-3  # m


def overlap(own, others):
    """(m) The deepest overlap of two bodies' triangles (n, 3, 2): the least translation along the normal of a side."""
    near = (own.min(1)[:, None] < others.max(1)).all(2) & (others.min(1) < own.max(1)[:, None]).all(2)
    deepest = 0.
    for i, j in zip(*np.nonzero(near)):
        least = math.inf
        for a, b in (own[i], others[j]), (others[j], own[i]):
            along = np.roll(a, -1, axis=0) - a
            off = b[None] - a[:, None]
            inside = along[:, None, 0] * off[..., 1] - along[:, None, 1] * off[..., 0]
            least = min(least, (inside.max(1) / np.hypot(*along.T)).min())
        deepest = max(deepest, least)
    return deepest


def disc(x, y, radius, size):
    return yadefrag.circle((x, y), radius, math.ceil(2 * math.pi * radius / size))


OUTLINES = dict(
    blocks=lambda fine: (yadefrag.rectangle((-.02, -.0305), (.02, -.0002)),
                         yadefrag.rectangle((-.0153, .0002), (.0171, .02))),
    discs=lambda fine: (disc(0, -.0205, .02, SIZE), disc(.003, .0155, .015, fine)),
    discOnBlock=lambda fine: (yadefrag.rectangle((-.02, -.0305), (.02, -.0002)), disc(.002, .0155, .015, fine)))


def deepestOfImpact(kind, ratio, mesh, angle, **settings):
    """(overlap by brute force, maxPenetration), the deepest of an impact at 10 m/s (m)."""
    clear()
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.3, label='m'))
    fe = w.FESolver(**settings)
    up = np.array([-math.sin(angle), math.cos(angle)])
    turn = np.array([[up[1], up[0]], [-up[0], up[1]]])
    for sense, outline, size in zip((1, -1), OUTLINES[kind](SIZE / ratio), (SIZE, SIZE / ratio)):
        fe.addPolygon((turn @ np.transpose(outline)).T, size=size, material='m', mesh=mesh,
                      velocity=tuple(5 * sense * up))
    O.engines = yadefrag.engines(fe)
    O.dt = .5 * fe.criticalTimeStep()
    found = told = 0
    for _ in range(15):
        runSteps(math.ceil(2e-5 / O.dt))
        corners = np.asarray(fe.nodes)[np.asarray(fe.triangles)]
        body = np.asarray(fe.components)[np.asarray(fe.triangles)[:, 0]]
        found = max(found, overlap(corners[body == 0], corners[body == 1]))
        told = max(told, fe.maxPenetration)
    assert fe.numActives > 0
    return found, told


@pytest.mark.parametrize('ratio', [1, 1.5, 3.26, 5])
@pytest.mark.parametrize('kind', OUTLINES)
def test_noneIsDeeperThanTold(kind, ratio):
    for mesh, angle in ('regular', .3), ('irregular', 1.7):
        found, told = deepestOfImpact(kind, ratio, mesh, angle, passes=2)
        # An element's shape turns by less than a tenth between the surface's normal and its side.
        assert found < 1.1 * told + 1e-12
        assert found < 1e-3 * SIZE / ratio


def test_onePassOverlapsUnseen():
    """Only the triangles show it, as fe.deepestOverlap() does."""
    found, told = deepestOfImpact('discs', 3.26, 'regular', .3, passes=1)
    assert found > .005 * SIZE and told < 1e-5 * SIZE


@pytest.mark.parametrize('passes', [None, 2])
def test_deepOverlapsOfOnePassAreTold(passes):
    """A corner of fine elements beside a corner of coarse ones: with the default the coarse points enter; the
    message's advice prevents it."""
    clear()
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.3, label='m'))
    fe = w.FESolver(**({} if passes is None else dict(passes=passes)))
    fe.addPolygon(disc(0, -.0205, .02, SIZE), size=SIZE, material='m', velocity=(0, 30))
    fe.addPolygon(disc(.003, .0155, .015, SIZE / 3.26), size=SIZE / 3.26, material='m', velocity=(0, -30))
    O.engines = yadefrag.engines(fe)
    # Elements at the corner are pressed to a sixth of their area: larger steps are refused.
    O.dt = .06 * fe.criticalTimeStep()
    deepest = 0
    for _ in range(60):
        runSteps(133)
        deepest = max(deepest, fe.deepestOverlap())
    told = [one for one in fe.warnings if 'passes=2' in one]
    if passes == 2:
        assert not fe.warnings and deepest < 1e-3 * SIZE / 3.26
    else:
        assert told and deepest > .1 * SIZE / 3.26
