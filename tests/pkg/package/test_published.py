"""What YADE's Python, class lists and archives know of a class that this project adds."""

import builtins
import os

import pytest

import yadefrag
from yade import system, wrapper

O = builtins.O
NAMES = [n for n in yadefrag.__all__ if isinstance(getattr(yadefrag, n), type)
         and n not in ('TradeoffTable', 'EnsembleTable', 'Mesh')]  # no part of a scene


@pytest.fixture(params=NAMES)
def made(request):
    """The class under test."""
    return getattr(wrapper, request.param)


def isCollider(made):
    return made.__name__.endswith('Collider')


def test_somethingIsPublished():
    assert NAMES


def test_classIsWhereScriptsLookForIt(made):
    name = made.__name__
    assert getattr(yadefrag, name) is made
    assert getattr(builtins, name) is made
    assert name in system.childClasses('Serializable')


def test_colliderIsAChildOfCollider(made):
    if not isCollider(made):
        pytest.skip('not a collider')
    assert issubclass(made, wrapper.Collider)
    assert O.isChildClassOf(made.__name__, 'Collider')
    assert made.__name__ in system.childClasses('Collider')


def test_keywordsAreAttributes(made):
    if not isCollider(made):
        pytest.skip('not a collider')
    one = made([wrapper.Bo1_Sphere_Aabb()], verletDist=.25, label='scratch', avoidSelfInteractionMask=2)
    assert (one.verletDist, one.label, one.avoidSelfInteractionMask) == (.25, 'scratch', 2)
    assert [type(f) for f in one.boundDispatcher.functors] == [wrapper.Bo1_Sphere_Aabb]
    one.updateAttrs({'verletDist': .5})
    assert one.verletDist == .5 and one.dict()['verletDist'] == .5


def test_errorsAreYades(made):
    with pytest.raises(AttributeError) as ours:
        made(noSuchAttribute=1)
    with pytest.raises(AttributeError) as yades:
        wrapper.InsertionSortCollider(noSuchAttribute=1)
    assert str(ours.value) == str(yades.value)
    settable = next(name for name in made().dict() if getattr(type(made()), name).fset)
    with pytest.raises(TypeError):
        made(**{settable: object()})
    with pytest.raises(AttributeError):
        made().updateAttrs({'noSuchAttribute': 1})
    with pytest.raises((TypeError, ValueError, RuntimeError)):
        made(1, 2)


def test_dictRebuildsTheObject(made):
    one = made()
    other = made()
    other.updateAttrs(one.dict())
    assert other.dict().keys() == one.dict().keys()
    assert repr(one).startswith('<%s instance' % made.__name__)
    assert made.__doc__


@pytest.mark.parametrize('ending', ['.xml', '.xml.bz2', '.yade', '.yade.gz'])
def test_savedAndLoaded(made, ending, folder):
    if not isCollider(made):
        pytest.skip('not an engine')
    path = os.path.join(folder, 'scene' + ending)
    O.engines = [wrapper.ForceResetter(), made([wrapper.Bo1_Sphere_Aabb()], verletDist=.125, label='finder')]
    wanted = O.engines[1].dict()
    O.save(path)
    O.reset()
    O.load(path)
    loaded = O.engines[1]
    assert type(loaded) is made and len(loaded.boundDispatcher.functors) == 1
    values = loaded.dict()
    for name, value in wanted.items():
        if isinstance(value, (bool, int, float, str)):
            assert values[name] == value, name
