"""What the tests of readOutline and readMesh share: files, and how far loops are from curves."""
import itertools
import pathlib
import warnings

import numpy as np
import pytest

import yadefrag
from yadefrag import readMesh, readOutline
from yadefrag.io.readers import loops

kSquare = [(0, 0), (4, 0), (4, 4), (0, 4)]


def written(folder, name, text):
    file = pathlib.Path(folder, name)
    file.write_text(text, encoding='utf-8')
    return str(file)


def lists(groups):
    """{name: list of numbers} of the groups of a mesh."""
    return {name: list(of) for name, of in groups.items()}


def isOneSentence(error):
    text = str(error.value)
    return text.endswith('.') and text.count('. ') == 0 and '\n' not in text


def refusesMesh(folder, name, text, words):
    """readMesh refuses this file in one sentence with these words (a regular expression)."""
    with pytest.raises(ValueError, match=words) as error:
        readMesh(written(folder, name, text))
    assert isOneSentence(error)


def glued(plane='CPE4', cohesive='COH2D4', n=4, gap=0., order=(0, 1, 2, 3)):
    """Text of an Abaqus file: two blocks, 20 mm by 10 mm, each of n by n/2 quads, between them n cohesive elements of
    3 MPa and 30 J/m², with their nodes in this order."""
    rows, count = n // 2 + 1, itertools.count(1)
    places = [(.02 * i / n, (gap + .01) * upper + .02 * j / n)
              for upper in (0, 1) for j in range(rows) for i in range(n + 1)]

    def quad(upper, j, i):
        low, high = ((n + 1) * (rows * upper + j + k) + i + 1 for k in (0, 1))
        return low, low + 1, high + 1, high
    blocks = [quad(upper, j, i) for upper in (0, 1) for j in range(n // 2) for i in range(n)]
    layer = [[quad(0, rows - 1, i)[k] for k in order] for i in range(n)]
    lines = ['*Part, name=P', '*Node', *('%d, %r, %r' % (next(count), *place) for place in places)]
    for type, of in ((plane + ', elset=bulk', blocks), (cohesive + ', elset=joint', layer)):
        lines += ['*Element, type=' + type, *('%d, %d, %d, %d, %d' % (next(count), *its) for its in of)]
    return '\n'.join([*lines, '*Cohesive Section, elset=joint, material=Glue, response=TRACTION SEPARATION', '*End Part',
                      '*Material, name=Glue', '*Damage Initiation, criterion=QUADS', '3e6, 3e6, 3e6',
                      '*Damage Evolution, type=ENERGY', '30.,', ''])


def svg(folder, body, page='viewBox="0 0 100 50"'):
    return written(folder, 'a.svg', '<svg xmlns="http://www.w3.org/2000/svg" %s>%s</svg>' % (page, body))


def area(loop):
    return loops.area(np.array(loop))


def areas(mesh):
    """Of the triangles of a mesh or of a solver."""
    a, b, c = mesh.nodes[mesh.triangles].transpose(1, 0, 2)
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


def corners(loop):
    """The loop's points, rounded, from the lowest one on."""
    points = [(round(x, 9) + 0., round(y, 9) + 0.) for x, y in loop]
    first = points.index(min(points))
    return points[first:] + points[:first]


def offLine(places, line):
    """Largest distance (m) of places from a closed polyline."""
    starts, sides = line, np.roll(line, -1, axis=0) - line
    squares = (sides**2).sum(1)

    def off(place):
        along = np.clip(((place - starts) * sides).sum(1) / squares, 0, 1)
        return np.linalg.norm(starts + along[:, None] * sides - place, axis=1).min()
    return max(map(off, places))


def offEllipse(loop, centre, a, b):
    """(largest distance of points, of middles of sides) from an ellipse of upright axes, which
    is itself replaced by a polyline, to 10⁻⁸ of a radius."""
    t = np.linspace(0, 2 * np.pi, 20000, endpoint=False)
    curve = np.stack([centre[0] + a * np.cos(t), centre[1] + b * np.sin(t)], axis=1)
    points = np.array(loop)
    return offLine(points, curve), offLine((points + np.roll(points, -1, axis=0)) / 2, curve)


def read(file, tolerance=None, **more):
    """(outlines, words of readOutline's message or '')."""
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter('always')
        warnings.simplefilter('ignore', DeprecationWarning)  # of ezdxf's own code with Debian 14's pyparsing
        found = readOutline(file, tolerance, **more)
    assert len(seen) < 2
    return found, str(seen[0].message) if seen else ''


def net(shapes):
    """Area of outlines without their holes."""
    return sum(area(outline) - sum(map(area, holes)) for outline, holes in shapes)


def contour(count, isInside):
    """Loops around the pixels whose middle is inside, the longest first, with a point at each corner of a pixel."""
    def isIn(i, j):
        return 0 <= i < count and 0 <= j < count and isInside(i + .5, j + .5)
    after = {}
    for i, j in np.ndindex(count, count):
        if isIn(i, j):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            beside = [(i, j - 1), (i + 1, j), (i, j + 1), (i - 1, j)]
            after.update((corners[k], corners[(k + 1) % 4]) for k in range(4) if not isIn(*beside[k]))
    loops = []
    while after:
        at, loop = min(after), []
        while at in after:
            loop.append(at)
            at = after.pop(at)
        loops.append(np.array(loop, dtype=float))
    return sorted(loops, key=len, reverse=True)


# --- outlines that touch, rounded or digitised one by one; networks of traces

def turned(outlines, angle):
    c, s = np.cos(angle), np.sin(angle)
    return [np.array(outline) @ np.array([[c, s], [-s, c]]) for outline in outlines]


def rounded(outlines, digits):
    return [[tuple(p) for p in np.round(outline, digits).tolist()] for outline in outlines]


def digitised(outlines, error, seed):
    """Each outline's vertices with errors of its own (m)."""
    random = np.random.default_rng(seed)
    return [[tuple(p) for p in np.array(outline) + random.uniform(-error, error, (len(outline), 2))]
            for outline in outlines]


def bricks(rows, columns, low=(0, 0)):
    """Running bond of .25 × .065 m: each corner lies on the middle of another one's side."""
    found = []
    for row in range(rows):
        for k in range(columns):
            x, y = low[0] + .25 * k + .125 * (row % 2), low[1] + .065 * row
            found.append(yadefrag.rectangle((x, y), (x + .25, y + .065)))
    return found


def rubbleMasonry(rows, seed):
    """Courses of random height, of stones of random length, 1 m long: T-junctions at random."""
    random = np.random.default_rng(seed)
    found, y = [], 0.
    for _ in range(rows):
        high = y + random.uniform(.05, .12)
        ends = np.concatenate([[0], np.cumsum(random.uniform(.1, .3, 4))])
        ends *= 1 / ends[-1]
        found += [yadefrag.rectangle((a, y), (b, high)) for a, b in zip(ends, ends[1:])]
        y = high
    return found


def traces(count, seed, hair=1e-5):
    """Two sets of traces in the unit square; ends that miss or cross another trace by a hair (m)."""
    random = np.random.default_rng(seed)
    lines = []
    for i in range(count):
        angle = random.normal((.3, 1.9)[i % 2], .25)
        middle, half = random.uniform(0, 1, 2), random.lognormal(-2.2, .5)
        way = half * np.array([np.cos(angle), np.sin(angle)])
        a, b = middle - way, middle + way
        if lines and random.uniform() < .5:  # ends near a trace that is there
            c, d = lines[random.integers(len(lines))]
            b = c + random.uniform(.1, .9) * (d - c) + random.uniform(-hair, hair, 2)
        lines.append((a, b))
        if random.uniform() < .1:  # mapped twice
            lines.append((a + random.uniform(-hair, hair, 2), b + random.uniform(-hair, hair, 2)))
    return [(tuple(a.tolist()), tuple(b.tolist())) for a, b in lines]
