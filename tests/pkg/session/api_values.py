"""For each argument of what is public the forms that its docstring states: groups of values with the same result; and
values that a script may pass by mistake, for the generator of calls in api_calls.py.

A group is made of one value by a kind: R real, W whole, F flag, P pair, L points, EACH numbers, TABLE pairs, TEXT,
PATH, FN function of a script; LIST has its items in any sequence."""
import datetime
import decimal
import fractions
import math
import pathlib

import numpy as np

import yadefrag
from yade import wrapper as w
from yade.minieigenHP import Vector2, Vector3

kSquare = [(5, 5), (6, 5), (6, 6), (5, 6)]
kHole = [(5.3, 5.3), (5.6, 5.3), (5.5, 5.6)]
NONE = [None]


def R(value):
    return [value, np.float64(value), np.array(value, dtype=np.float32)]


def W(value):
    return [value, np.uint8(value), np.array(value)]


def F(value):
    return [value, np.bool_(value)]


def P(*pair):
    return [pair, list(map(np.float32, pair)), np.array(pair), Vector2(pair)]


def LIST(values):
    return [list(values), tuple(values)]


def EACH(values):
    return LIST(values) + [np.array(values), list(np.array(values))]


def TABLE(rows):
    return [rows, tuple(map(list, rows)), np.array(rows)]


def L(points):
    return TABLE(points) + [list(map(Vector2, points)), np.array(points, dtype=np.float32), (p for p in points)]


def TEXT(value):
    return [value, np.str_(value)]


def PATH(value):
    return [value, pathlib.Path(value)]


def FN(function):
    """Of a script: also one whose values are NumPy's, and an object that can be called."""
    class Callable:
        def __call__(self, *given):
            return function(*given)

    return [function, lambda *given: plainly(function(*given)), Callable()]


def plainly(value):
    return value if isinstance(value, (str, w.Material, type(None))) else np.array(value)


def strain(x, y):
    return 1e4


def others(groups):
    """What is wrong for an argument with these forms: values of no kind that it has."""
    forms = [form for group in groups for form in group]
    first = next((one for one in forms if one is not None), None)
    wrong = [object(), {'x': {1}}, b'\xff', 1j, [[1], [2, 3]]] + [None] * all(one is not None for one in forms)
    wrong += ['much', 'much' * 10**4] * (not any(isinstance(one, (str, pathlib.Path)) for one in forms))
    if isinstance(first, bool):
        wrong += [2, 1]
    elif any(isinstance(one, np.uint8) for one in forms):
        wrong += [1.5, True, -1, 10**5000]
    elif isinstance(first, (int, float)):
        wrong += [math.nan, 10**400] + [True] * (len(groups) == 1)
    elif isinstance(first, tuple) and len(first) == 2:
        wrong += [1, (1, 2, 3), (1, math.nan), (10**400, 0)]
    return wrong


def loads(fe):
    return [[0, 1]] * len(fe.nodes)


def attribute(cls, name, value):
    """Groups of an attribute: of its preset, and of points where these are accepted."""
    points = dict(softening=[(0, 1), (.5, .25), (1, 0)], rateEffect=[(1, 1), (100, 2)], speedEffect=[(1, 1), (100, 2)], hardeningTable=[(0, 1e6), (.125, 2e6)])
    if isinstance(value, bool):
        return [F(value)]
    if isinstance(value, int):
        return [[value, np.int64(value), np.array(value), *([np.uint8(value)] if 0 <= value < 256 else [])]]
    if isinstance(value, float):
        return [[value, np.float64(value), np.longdouble(value), np.array(value)]]
    if isinstance(value, str):
        return [TEXT(value)] + [L(points[name])[:-1] for one in points if one == name]
    if isinstance(value, Vector3):
        return [[value, tuple(value), list(value), np.array(value)]] + [P(1, 2)] * (name == 'gravity' and cls is w.FESolver)
    return []


def body(fe):
    """addPolygon, addMesh and addTriangles."""
    b, m = w.Omega().materials['b'], w.Omega().materials['m']
    return dict(
        velocity=[P(1., .5), FN(lambda x, y: (x, y))], spin=[R(.5)], displacement=[NONE, FN(lambda x, y: (0, .01 * (y - 5)))],
        stress=[NONE, EACH([1e3, 2e3, 5e2]), EACH([1e3, 2e3, 5e2, 1e3]), FN(lambda x, y: (1e3, 0, y))],
        fixed=[NONE, FN(lambda x, y: x < 5.1), FN(lambda x, y: 'x' if x < 5.1 else False), FN(lambda x, y: 'y')],
        thickness=[R(.5)], selfContact=[F(True)], element=[NONE, TEXT('linear'), TEXT('smoothed')],
        material=[[b, 'b', 1, np.int32(1), np.str_('b'), lambda x, y: b, lambda x, y: 'b', lambda x, y: 1],
                  FN(lambda x, y: b if x < 5.5 else m)],
        strength=[NONE, FN(lambda x, y: 1e4 * x)], fractureEnergy=[NONE, FN(lambda x, y: 1.)],
        name=[NONE, TEXT('new')])


def mesh(fe):
    return dict(
        outline=[L(kSquare)], holes=[[(), []], LIST([kHole]) + [[np.array(kHole)], iter([kHole]), np.array([kHole])]],
        size=[R(.5), FN(lambda x, y: .5)], smooth=[F(False), F(True), EACH([True, False, True, True]) + [[1, 0, 1, 1]]],
        meshSeed=[W(3)], simplify=[NONE, R(.125)],
        joints=[[(), []], LIST([((5.2, 5.2), (5.8, 5.7))]) + [np.array([[(5.2, 5.2), (5.8, 5.7)]]),
                iter([[Vector2(5.2, 5.2), Vector2(5.8, 5.7)]])]])


def nodes(fe, name='first'):
    chosen = [i for i, (x, y) in enumerate(fe.nodes) if x < .1]
    flags = [x < .1 for x, _ in fe.nodes]
    return [EACH(chosen) + [np.array(chosen, dtype=np.uint8), flags, tuple(flags), np.array(flags), lambda x, y: x < .1,
                            lambda x, y: np.bool_(x < .1)], [name]]


def whole(fe):
    return nodes(fe) + [W(0) + ['first']]


def choices(trial):
    return dict(scene=[[trial[0]]], measure=[[trial[1]]], watch=[NONE, [trial[1]]], duration=[R(1.)], every=[R(.5)],
                limit=[R(8.)], title=[TEXT('t')], executor=[NONE])


JOINTS = [((5.2, 5.2), (5.8, 5.7)), ((5.2, 5.8), (5.4, 5.8))]
# Calls of the same function with arguments that need others; and those that are needed, where they have a default.
VARIANTS = dict(severalFields='plotMesh', twoJoints='addPolygon', twoMaterials='addMesh')
NEEDED = dict(
    polygonMesh=dict(joints=JOINTS[:1]), addPolygon=dict(joints=JOINTS[:1], jointEnergy=1.),
    twoJoints=dict(joints=JOINTS, jointEnergy=1.),
    twoMaterials=dict(material=['b', 'm']), plotMesh=dict(field='mises'), severalFields=dict(fields=['xx', 'speed']),
    plotFragmentSizes=dict(components=[0, 1]), runSteps=dict(every=1, call=float), relax=dict(most=30))


def forms(fe, folder, trial):
    """{function, or variant: {argument: groups}} of everything public; the first form of an argument without a default is
    part of all calls."""
    count = len(fe.triangles)
    pictures = dict(file=[NONE, PATH(folder + '/p.png')], limits=[NONE, P(0, 1)], spheres=[F(True), F(False)],
                    rigidBodies=[F(True)], scale=[R(2), R(0)])
    tables = dict(fe=[[fe]], file=[NONE, PATH(folder + '/f.csv')])
    fields = [NONE, LIST(['stress', 'velocity']), LIST([]), LIST(['plasticStrain', 'plastic strain'])]
    triangles = dict(body(fe), strength=[NONE, FN(strain), EACH([1e4, 2e4])], fractureEnergy=[NONE, FN(strain), EACH([1., 0])])
    return dict(
        rectangle=dict(low=[P(0, 0)], high=[P(1, 2)]), circle=dict(centre=[P(0, 1)], radius=[R(1)], n=[NONE + W(64)]),
        ring=dict(centre=[P(0, 1)], inner=[R(1)], outer=[R(2)], n=[NONE + W(64)]),
        readPolygon=dict(file=[PATH(folder + '/plate')]),
        readOutline=dict(file=[PATH(folder + '/plate.csv')], tolerance=[NONE, R(.125)], scale=[R(2)], gap=[NONE, R(.125)],
                         simplify=[NONE, R(.125)], leastArea=[R(.125)], layers=[NONE], byLayer=[F(False)]),
        readMesh=dict(file=[PATH(folder + '/mesh.inp')], scale=[R(2)]),
        outlineReport=dict(outline=[L(kSquare), PATH(folder + '/plate.csv')], holes=mesh(fe)['holes'], size=[R(.5)],
                           material=[['b', 1, np.int64(1), w.Omega().materials['b']]], simplify=[NONE, R(.125)]),
        voronoi=dict(outline=[L(kSquare)], n=[W(3)], seed=[W(1)], rounds=[W(1)], shortest=[R(0)]),
        grainJoints=dict(grains=[LIST([kSquare, kSquare[::-1]]) + [list(map(np.array, [kSquare, kSquare[::-1]]))]]),
        snapOutlines=dict(shapes=[LIST([kSquare]), LIST([(kSquare, [kHole])]), LIST([[kSquare, ()]])], tolerance=[R(.125)]),
        polygonMesh=dict(mesh(fe), mesh=[TEXT('irregular'), TEXT('regular') + NONE], jointTolerance=[NONE, R(.125), R(0)]),
        rectangleMesh=dict(low=[P(0, 0)], high=[P(1, 2)], nx=[W(2)], ny=[W(3)], crossed=[F(True), F(False)]),
        plotMesh=dict(pictures, fe=[[fe]], field=[NONE] + [TEXT(one) for one in (
            'xx', 'zz', 'mises', 'sigma1', 'strain', 'fragment', 'plastic strain')] + [EACH([.5] * count), EACH([.5] * len(fe.nodes))],
            xlim=[NONE, P(0, 3)], ylim=[NONE, P(0, 2)], ax=[NONE], mirror=[F(False)]),
        severalFields=dict(fields=[NONE, LIST(['xx', None]), LIST([[.5] * count, 'speed'])],
                           limits=[NONE + LIST([None, None]), P(0, 1) + LIST([(0, 1), [0., 1]]), LIST([None, (0, 1)])]),
        animate=dict({**pictures, 'file': [PATH(folder + '/a.gif')]}, fe=[[fe]], steps=[W(2)], every=[W(1)], rate=[R(20)],
                     field=[NONE, TEXT('speed')], window=[NONE, [((0, 0), (1, 1)), [[0, 0], (1, 1)], np.array([[0, 0], [1, 1]])]]),
        exportVTK=dict(fe=[[fe]], file=[PATH(folder + '/a.vtu')], fields=fields),
        runSteps=dict(steps=[W(2)], every=[W(1)], call=[FN(lambda: None)]),
        fragmentTable=tables, crackTable=tables,
        plotFragmentSizes=dict(fe=[[fe]], file=[NONE, PATH(folder + '/p.png')], ax=[NONE],
                               components=[EACH([0, 1]) + [['first', 1], range(2), ('first', np.str_('second'))], ['first', ['first']]]),
        recordFracture=dict(fe=[[fe]], file=[PATH(folder + '/run.csv')], append=[F(True)]),
        plotFracture=dict(file=[PATH(folder + '/run.csv')], picture=[NONE, PATH(folder + '/p.png')]),
        tradeoff=dict(choices(trial), vary=[
            [{'passes': [1, 2]}, [{'passes': [1]}, {'passes': (2,)}], ({'passes': np.array([1, 2])},), {'passes': range(1, 3)}], [[{}, {'passes': [2]}]]],
            reference=[R(0.), EACH([1., 2.]), TEXT('finest'), [{'passes': 1}, {'passes': np.int64(1)}], PATH(folder + '/numbers')],
            repeats=[W(2)], files=[NONE, PATH(folder + '/t')], resume=[NONE, PATH(folder + '/new.jsonl')], by=[[(), []], TEXT('passes') + LIST(['passes'])]),
        ensemble=dict(choices(trial), runs=[W(2) + EACH([0, 1]) + [range(2), [{'seed': 0}, {'seed': np.int64(1)}], {'seed': [0, 1]}, {'seed': np.arange(2)}]],
                      workers=[NONE, W(1)], files=[NONE, PATH(folder + '/t')], resume=[NONE, PATH(folder + '/new.jsonl')]),
        addPolygon=dict(body(fe), **mesh(fe), mesh=[NONE, TEXT('irregular'), TEXT('regular')], snap=[NONE, R(.125), R(0)],
                        jointStrength=[NONE + LIST([None]), R(0) + EACH([0])], jointEnergy=[NONE + LIST([None]), R(1.) + EACH([1.])]),
        twoJoints=dict(joints=[LIST(JOINTS)], jointStrength=[NONE + LIST([None, None]), R(2e4) + EACH([2e4, 2e4]), LIST([None, 0.])],
                       jointEnergy=[NONE + LIST([None, None]), R(1.) + EACH([1., 1.]), LIST([1., None])]),
        twoMaterials=dict(interfaceStrength=[NONE + [{('m', 'b'): None}, {}, lambda x, y: None], R(2e4) + FN(lambda x, y: 2e4) + [{('m', 'b'): 2e4}, {(1, 0): 2e4}]],
                          interfaceEnergy=[NONE + [{('m', 'b'): None}, {}, lambda x, y: None], R(2) + FN(lambda x, y: 2) + [{('b', 'm'): 2}]]),
        addMesh=dict(triangles, mesh=[[yadefrag.rectangleMesh((5, 5), (6, 6), 1, 1), tuple(yadefrag.rectangleMesh((5, 5), (6, 6), 1, 1)),
                                       list(yadefrag.rectangleMesh((5, 5), (6, 6), 1, 1))]], smooth=[NONE + F(False), F(True)]),
        addTriangles=dict(body(fe), nodes=[TABLE([(5, 5), (6, 5), (6, 6)]) + [[(5, 5, 1), (6, 5, 1), (6, 6, 1)]]],
                          triangles=[TABLE([(0, 1, 2)])], smooth=[F(True)], strength=[NONE, FN(strain), EACH([1e4])],
                          fractureEnergy=[NONE, FN(strain), EACH([1.])]),
        bond=dict(a=[W(0) + ['first', np.str_('first')]], b=[W(1) + ['second']], strength=[R(1e6)], energy=[R(1e3)]),
        bondAll=dict(tolerance=[R(.125)], strength=[R(1e6)], energy=[R(1e3)]),
        prescribe=dict(nodes=nodes(fe), vx=[NONE, R(1.), TABLE([(0, 0.), (1, 2.)]), FN(lambda x, y, t: x)], vy=[NONE, R(1.)]),
        rotate=dict(nodes=whole(fe), omega=[R(1.), TABLE([(0, 0.), (1, 2.)])], centre=[P(0, 0)]),
        pressure=dict(nodes=nodes(fe), p=[R(1.), TABLE([(0, 0.), (1, 2.)]), FN(lambda t: t)], intoCracks=[F(True)]),
        absorb=dict(nodes=nodes(fe)), reaction=dict(nodes=whole(fe)), nodesOf=dict(component=[W(0) + ['first']]),
        componentOf=dict(name=[TEXT('first')]), removeBody=dict(component=[W(0) + ['first']]), fragments=dict(held=[F(True), F(False)]),
        contactForce=dict(a=[W(0) + ['first']], b=[NONE, W(1) + ['second']]),
        meshQuality=dict(component=[W(0) + ['first']]),
        relax=dict(tolerance=[R(2.**30)], most=[W(30)]), about=dict(show=[FN(lambda line: None)]),
        inCurveOrder=dict(bodies=[LIST([(0, 0, 0), (1, 1, 0)]) + [np.array([(0, 0, 0), (1, 1, 0)])], LIST([((1, 1, 0), .5)])]),
        engines=dict(fe=[[fe]], gravity=[NONE, P(0, -1) + [(0, -1, 0), np.array([0, -1, 0])]], spheres=[F(True), F(False)], damping=[R(.25)],
                     collider=[NONE + [w.LebesgueCollider]], moving=[F(True)], loop=[NONE + [w.CurveLoop], [w.InteractionLoop]],
                     integrator=[NONE + [w.CurveIntegrator], [w.NewtonIntegrator]]),
        FERecorder=dict(iterPeriod=[W(5)], file=[PATH(folder + '/e')], fields=fields),
        setLoads=dict(loads=[NONE, TABLE(loads(fe))]))


# --- by mistake

class FromScript(Exception):
    """What a script's own function raises: it must arrive at the caller as it is."""


def raising(*_, **__):
    raise FromScript('raised in the script')


class Hostile:
    """An object none of whose special methods works."""

    def __getattr__(self, name):
        raise FromScript('no attribute ' + name)

    __repr__ = __len__ = __iter__ = __float__ = __index__ = __array__ = __bool__ = raising
    __eq__ = __hash__ = __fspath__ = __getitem__ = __call__ = raising


class Unprintable:
    def __repr__(self):
        raise FromScript('no text')


class Wordy:
    def __repr__(self):
        return 'a line\nand another ' * 1000


def numpys(random):
    kinds = ['bool', 'int8', 'uint8', 'int16', 'int32', 'uint32', 'int64', 'uint64', 'float16', 'float32',
             'float64', 'longdouble', 'complex64', 'complex128', 'U3', 'S3', 'O', 'datetime64[s]',
             'timedelta64[s]', 'V4', [('a', 'f8'), ('b', 'i4')]]
    kind = np.dtype(random.choice(kinds))
    shape = random.choice([(), (), (0,), (1,), (2,), (3,), (4,), (2, 2), (4, 2), (0, 2), (3, 3), (2, 2, 2)])
    array = np.zeros(shape, kind)
    if kind.kind in 'iufc' and array.size:
        array[...] = random.choice([0, 1, 2, 100])
        if kind.kind == 'f':
            array.flat[random.randrange(array.size)] = random.choice([0, .5, np.nan, np.inf, -1])
    if not array.flags.writeable or random.random() < .3:
        array = array[::-1] if array.ndim else array
    return array[()] if shape == () and random.random() < .7 else array


def mistakes(random, fe):
    """{kind: values}"""
    deep = []
    for _ in range(2000):
        deep = [deep]
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    scene = w.Omega()
    return dict(
        numbers=[
            0, 1, 2, 3, -1, 7, 2**31 - 1, 2**31, -2**31 - 1, 2**63, 10**30, -10**30, 10**400, -10**400, 0., -0., .5,
            1., 2.5, -1., 1e-320, 1e-300, 1e-12, 1e12, 1e100, 1e160, 1e300, -1e300, math.nan, math.inf, -math.inf,
            True, False, 1j, decimal.Decimal('0.5'), fractions.Fraction(1, 2), fractions.Fraction(10**400, 3)],
        texts=[
            '', 'm', 'x', 'none', 'fine', 'xy', 'mises', 'fragment', 'é', '\ud800', 'a\0b', 'x' * 5000,
            'line\nline', '/nowhere/x.csv', '/nowhere/x', b'', b'\xff\xfe', bytearray(b'm'), '%s', '{}'],
        collections=[
            [], (), {}, set(), [[]], [None], [1], [1, 2], (1, 2), (1, 2, 3), (math.nan, 1), ('a', 'b'),
            [(0, 0), (1, 0)], square, square[::-1], square * 2, [(0, 0), (1, 1), (1, 0), (0, 1)],
            [(x * 1e300, y * 1e300) for x, y in square], [(x + 1e17, y) for x, y in square],
            [(x * 1e-300, y * 1e-300) for x, y in square], [(0, 0), (1, math.inf), (1, 1)],
            [(0, 0), (1, 0), (1,)], [square], {'passes': [1, 2]}, {'passes': 3}, {'a': []}, {1: 2}, deep,
            range(3), iter(square), (p for p in square), (raising() for _ in range(3)), [True] * 4, [True],
            [0, 1, 2], [(0, 1, 2)], [[0, 1, 2], [0, 1]], [-1], [10**30], [1.5], ['a'], frozenset([1]),
            memoryview(b'abc'), 'abcd', {'x': 1}.items(), list(range(1000)), ((0, 0), (1, 1))],
        triples=[
            (0, 0, 0), (1, 0, 0), (.5, 1, 0), (math.nan, 0, 0), (0, math.inf, 0), (0, 0, 1), (1e300, -1e300, 0),
            (1e160, 0, 0), (1e-320, 0, 0), (1, 2), (1, 2, 3, 4), ('a', 0, 0), (None, 0, 0), (10**400, 0, 0),
            np.zeros(3), np.ones(3, dtype=int), np.zeros((3, 1)), Vector3(1, 1, 1), {1, 2, 3}, (1j, 0, 0)],
        callables=[
            raising, lambda: None, lambda x, y: True, lambda x, y: None, lambda x, y: 'x', lambda x, y: (x, y),
            lambda x, y: (math.nan, 0), lambda x, y: (1e300, 1e300), lambda x, y: np.bool_(x > .5),
            lambda x, y: 3, lambda *a: (), lambda x, y: Hostile(), int, print, len, Hostile],
        objects=[
            None, object(), Ellipsis, NotImplemented, type, Hostile(), Unprintable(), Wordy(), fe, fe.dict(),
            w.FESolver(), w.FEMat(), w.FrictMat(), w.Body(), w.Sphere(), w.LebesgueCollider(), w.Bo1_Sphere_Aabb(),
            w.NewtonIntegrator(), scene, scene.bodies, scene.materials, datetime.datetime(2000, 1, 1), math, open],
        numpys=[numpys(random)])


def anything(random, fe, kinds=('numbers', 'numbers', 'numbers', 'texts', 'texts', 'numpys', 'numpys', 'collections', 'collections',
                                'callables', 'objects', 'objects')):
    """Some value, drawn by `random`."""
    return random.choice(mistakes(random, fe)[random.choice(kinds)])


def alike(random, fe, right):
    """A value of the kind of `right`, which is mostly the more interesting one."""
    for types, kinds in (((bool, int, float), ['numbers']), (str, ['texts']), (Vector3, ['triples']),
                         ((list, tuple, np.ndarray), ['collections', 'collections', 'numpys'])):
        if isinstance(right, types):
            return anything(random, fe, kinds)
    return anything(random, fe, *[['callables']] * callable(right))
