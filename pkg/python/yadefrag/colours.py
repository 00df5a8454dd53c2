"""Distinct colours: for curves, and for adjacent fragments."""

import numpy

# Twelve for curves in one picture. Any two differ by at least 0.25 in red, green and blue together.
DISTINCT = ('#1f77b4', '#d62728', '#2ca02c', '#ff7f0e', '#9467bd', '#17becf', '#8c564b', '#e377c2',
            '#000000', '#bcbd22', '#7f7f7f', '#005a1e')


def palette():
    """Twenty colours, the ten saturated ones first."""
    from matplotlib import colormaps
    pairs = colormaps['tab20'].colors
    return [*pairs[::2], *pairs[1::2]]


def fragmentColours(fe, former=None):
    """(m) a small number for each triangle: the same within a fragment, different in adjacent ones;
    0 for removed triangles. Must be called between two steps.

    former  result of an earlier call: a fragment keeps its colour if possible
    """
    ofAll = numpy.asarray(fe.fragmentOf, dtype=int)
    shown = numpy.nonzero(ofAll >= 0)[0]
    of = ofAll[shown]
    count = int(of.max()) + 1 if len(of) else 0
    beside = _neighbours(fe, shown, of, count)
    sizes = numpy.bincount(of, minlength=count)
    firsts = numpy.full(count, len(ofAll))
    numpy.minimum.at(firsts, of, shown)
    colours = numpy.full(count, -1)
    for fragment in numpy.argsort(-sizes, kind='stable'):
        taken = {colours[other] for other in beside[fragment]}
        wanted = -1 if former is None else int(former[firsts[fragment]])
        if wanted < 0 or wanted in taken:
            wanted = next(c for c in range(count + 1) if c not in taken)
        colours[fragment] = wanted
    result = numpy.zeros(len(ofAll), dtype=int)
    result[shown] = colours[of]
    return result


def _neighbours(fe, shown, of, count):
    """For each fragment the set of fragments that share a point of the stress-free shape with it,
    or that are at a distance of at most one edge length."""
    triangles = numpy.asarray(fe.triangles, dtype=int)[shown]
    used, places = numpy.unique(triangles, return_inverse=True)
    triangles = places.reshape(-1, 3)
    nodes, reference = numpy.asarray(fe.nodes)[used], numpy.asarray(fe._reference)[used]
    ofNode = numpy.zeros(len(nodes), dtype=int)
    ofNode[triangles] = of[:, None]
    edge = numpy.linalg.norm(reference[triangles[:, 0]] - reference[triangles[:, 1]], axis=1).mean()
    beside = [set() for _ in range(count)]
    for places in (reference, numpy.floor(nodes / edge)):
        _, place = numpy.unique(places, axis=0, return_inverse=True)
        pairs = numpy.unique(numpy.stack([place.ravel(), ofNode], axis=1), axis=0)
        ends = numpy.nonzero(numpy.diff(pairs[:, 0]))[0] + 1
        for group in numpy.split(pairs[:, 1], ends):
            for fragment in group if len(group) > 1 else ():
                beside[fragment].update(group)
    for fragment, others in enumerate(beside):
        others.discard(fragment)
    return beside
