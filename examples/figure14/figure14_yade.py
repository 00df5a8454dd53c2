"""Figure 14 with YADE's colliders: run inside yade, prints one line of JSON.

    scripts/yade -n -x -j1 examples/figure14/figure14_yade.py FRAMES SEGMENTS COLLIDER

FRAMES is a file of 64-bit floats, (searches, SEGMENTS, 4): the low and high corners of the boxes of
all segments, half a halo around each, written by bench.cpp. Each segment is a body with a
`Box` shape of just that size, which is moved and turned into the next frame by hand; there are no
contacts and no motion of YADE's own. Every frame is one search: `verletDist` is 0.

Printed are the mean time of a search after the first (s, YADE's own counter of the engine: bounds,
sorting, interactions; with `searches` how many) and the mean number of interactions.
"""
import json
import sys

import numpy as np
import yade.wrapper
from yade import Body, Box, O, Vector3, config


def main(file, segments, collider):
    """Measure and print; raises ValueError where the file does not fit."""
    frames = np.fromfile(file).reshape(-1, int(segments), 4)
    addBodies(frames[0])
    O.engines = [makeCollider(collider)]
    O.timingEnabled = True
    O.step()
    engine = O.engines[0]
    start, pairs = engine.execTime, 0
    for frame in frames[1:]:
        move(frame)
        O.step()
        pairs += len(O.interactions)
    searches = len(frames) - 1
    print(json.dumps(dict(time=(engine.execTime - start) * 1e-9 / searches, searches=searches,
                          pairs=pairs / searches, yade=config.version)), flush=True)


def makeCollider(name):
    """The collider of this name, from yadefrag or from YADE, that searches in every step."""
    import yadefrag
    found = getattr(yadefrag, name, None) or getattr(yade.wrapper, name)
    return found([yade.wrapper.Bo1_Box_Aabb()], verletDist=0)


def addBodies(boxes):
    """One body for each row of (n, 4) corners (m)."""
    for x, y, hx, hy in rows(boxes):
        body = Body()
        body.shape = Box(extents=Vector3(hx, hy, .5))
        body.state.pos = Vector3(x, y, 0)
        O.bodies.append(body)


def move(boxes):
    """Give the bodies the centres and half sides of (n, 4) corners (m)."""
    for body, (x, y, hx, hy) in zip(O.bodies, rows(boxes)):
        body.shape.extents = Vector3(hx, hy, .5)
        body.state.pos = Vector3(x, y, 0)


def rows(boxes):
    """Centres and half sides, as a list of n lists of 4."""
    low, high = boxes[:, :2], boxes[:, 2:]
    return np.hstack([.5 * (low + high), .5 * (high - low)]).tolist()


main(*sys.argv[1:])
