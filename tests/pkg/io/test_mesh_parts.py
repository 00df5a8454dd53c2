"""Parts of one mesh without common nodes: they may touch, but not overlap."""
import builtins
import math
import random

import numpy as np
import pytest

from fe_scene import fe
from yadefrag import rectangleMesh

O = builtins.O
kSentence = 'two parts of the mesh, without common nodes, overlap at'


def joined(*parts):
    nodes, triangles = [], []
    for own, of in parts:
        triangles.append(np.asarray(of, dtype=np.int64) + sum(map(len, nodes)))
        nodes.append(own)
    return np.concatenate(nodes), np.concatenate(triangles)


def moved(part, shift, angle=0.):
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    return part[0] @ turn + shift, part[1]


kBar = rectangleMesh((0, 0), (4, 1), 8, 2)
kThin = rectangleMesh((0, 0), (4, .2), 4, 1)


@pytest.mark.parametrize('other', [
    moved(kBar, (0, 0)), moved(kBar, (1, 0)), moved(kBar, (.3, .2)), moved(kBar, (3.9, 0)), moved(kBar, (0, .95)),
    moved(kThin, (0, .4)), moved(kThin, (1, -2), 1.5), rectangleMesh((1.1, .3), (1.2, .4), 1, 1),
    rectangleMesh((-1, -1), (5, 2), 1, 1), moved(kBar, (2, .5), .7)])
def test_overlapIsRefused(other):
    for parts in ((kBar, other), (other, kBar)):
        with pytest.raises(ValueError, match=kSentence):
            fe().addTriangles(*joined(*parts), material='m')
    assert len(O.bodies) == 0


@pytest.mark.parametrize('other', [
    moved(kBar, (4, 0)), moved(kBar, (0, 1)), moved(kBar, (.25, 1)), moved(kBar, (4, 1)), moved(kThin, (0, -.2)),
    moved(kBar, (9, 9), .3), moved(rectangleMesh((0, 0), (3, 3), 1, 1), (4, -1))])
def test_partsMayTouch(other):
    solver = fe()
    solver.addTriangles(*joined(kBar, other), material='m')
    assert len(solver.surfaces) == 2


def test_aPartInAHoleIsApart():
    nodes, triangles = rectangleMesh((0, 0), (3, 3), 3, 3)
    middle = nodes[triangles].mean(axis=1)
    ring = triangles[~((abs(middle - 1.5) < .5).all(axis=1))]
    fe().addTriangles(*joined((nodes, ring), rectangleMesh((1.1, 1.1), (1.9, 1.9), 2, 2)), material='m')


def test_randomPlacesAgainstSamples():
    """Overlap by a fine grid of points in both."""
    draw, count = random.Random(3), 0
    for _ in range(60):
        shift, angle = (draw.uniform(-1, 5), draw.uniform(-1, 2)), draw.uniform(0, 2 * math.pi)
        size = draw.choice([.2, 1, 2.5])
        other = moved(rectangleMesh((0, 0), (size, size), 2, 2), shift, angle)
        u = np.stack(np.meshgrid(*[np.linspace(0, size, 81)[1:-1]] * 2), axis=-1).reshape(-1, 2)
        places = moved((u, None), shift, angle)[0]
        depth = np.min([places[:, 0], 4 - places[:, 0], places[:, 1], 1 - places[:, 1]], axis=0).max()
        if abs(depth) < .02:
            continue
        try:
            fe().addTriangles(*joined(kBar, other), material='m')
            found = False
        except ValueError:
            found = True
        O.reset()
        assert found == (depth > 0), (shift, angle, size, depth)
        count += found
    assert 10 < count < 50
