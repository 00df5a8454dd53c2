"""Values that a script may pass by mistake, for the generator of calls in api_calls.py."""
import datetime
import decimal
import fractions
import math

import numpy as np

from yade import wrapper as w
from yade.minieigenHP import Vector3


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


def numbers():
    return [0, 1, 2, 3, -1, 7, 2**31 - 1, 2**31, -2**31 - 1, 2**63, 10**30, -10**30, 10**400, -10**400,
            0., -0., .5, 1., 2.5, -1., 1e-320, 1e-300, 1e-12, 1e12, 1e100, 1e160, 1e300, -1e300,
            math.nan, math.inf, -math.inf, True, False, 1j, decimal.Decimal('0.5'),
            fractions.Fraction(1, 2), fractions.Fraction(10**400, 3)]


def texts():
    return ['', 'm', 'x', 'none', 'xy', 'mises', 'fragment', 'é', '\ud800', 'a\0b', 'x' * 5000,
            'line\nline', '/nowhere/x.csv', '/nowhere/x', b'', b'\xff\xfe', bytearray(b'm'), '%s', '{}']


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


def collections(random):
    deep = []
    for _ in range(2000):
        deep = [deep]
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return [[], (), {}, set(), [[]], [None], [1], [1, 2], (1, 2), (1, 2, 3), (math.nan, 1), ('a', 'b'),
            [(0, 0), (1, 0)], square, square[::-1], square * 2, [(0, 0), (1, 1), (1, 0), (0, 1)],
            [(x * 1e300, y * 1e300) for x, y in square], [(x + 1e17, y) for x, y in square],
            [(x * 1e-300, y * 1e-300) for x, y in square], [(0, 0), (1, math.inf), (1, 1)],
            [(0, 0), (1, 0), (1,)], [square], {'passes': [1, 2]}, {'passes': 3}, {'a': []}, {1: 2}, deep,
            range(3), iter(square), (p for p in square), (raising() for _ in range(3)), [True] * 4, [True],
            [0, 1, 2], [(0, 1, 2)], [[0, 1, 2], [0, 1]], [-1], [10**30], [1.5], ['a'], frozenset([1]),
            memoryview(b'abc'), 'abcd', {'x': 1}.items(), list(range(1000)), ((0, 0), (1, 1))]


def triples():
    return [(0, 0, 0), (1, 0, 0), (.5, 1, 0), (math.nan, 0, 0), (0, math.inf, 0), (0, 0, 1), (1e300, -1e300, 0),
            (1e160, 0, 0), (1e-320, 0, 0), (1, 2), (1, 2, 3, 4), ('a', 0, 0), (None, 0, 0), (10**400, 0, 0),
            np.zeros(3), np.ones(3, dtype=int), np.zeros((3, 1)), Vector3(1, 1, 1), {1, 2, 3}, (1j, 0, 0)]


def callables():
    return [raising, lambda: None, lambda x, y: True, lambda x, y: None, lambda x, y: 'x', lambda x, y: (x, y),
            lambda x, y: (math.nan, 0), lambda x, y: (1e300, 1e300), lambda x, y: np.bool_(x > .5),
            lambda x, y: 3, lambda *a: (), lambda x, y: Hostile(), int, print, len, Hostile]


def objects(fe):
    scene = w.Omega()
    return [None, object(), Ellipsis, NotImplemented, type, Hostile(), Unprintable(), Wordy(), fe, fe.dict(),
            w.FESolver(), w.FEMat(), w.FrictMat(), w.Body(), w.Sphere(), w.LebesgueCollider(),
            w.Bo1_Sphere_Aabb(), w.NewtonIntegrator(), scene, scene.bodies, scene.materials,
            datetime.datetime(2000, 1, 1), math, open]


def alike(random, fe, right):
    """A value of the kind of `right`, which is mostly the more interesting one."""
    if isinstance(right, (bool, int, float)):
        return random.choice(numbers())
    if isinstance(right, str):
        return random.choice(texts())
    if isinstance(right, (list, tuple, np.ndarray)):
        return random.choice(collections(random)) if random.random() < .7 else numpys(random)
    if isinstance(right, Vector3):
        return random.choice(triples())
    if callable(right):
        return random.choice(callables())
    return anything(random, fe)


def anything(random, fe):
    """Some value, drawn by `random`."""
    kind = random.randrange(12)
    if kind < 3:
        return random.choice(numbers())
    if kind < 5:
        return random.choice(texts())
    if kind < 7:
        return numpys(random)
    if kind < 9:
        return random.choice(collections(random))
    if kind < 10:
        return random.choice(callables())
    return random.choice(objects(fe))
