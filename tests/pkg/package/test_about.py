"""What the package tells about itself: yadefrag.about() and python3 -m yadefrag; what YADE's Python, class lists
and archives know of a class that this project adds; type hints, which mypy checks (scripts/check types), and which
a user sees."""
import ast
import builtins
import inspect
import os
import pathlib
import re
import sys

import pytest
import yadefrag
from project import ran
from yade import config, system, wrapper
from yadefrag import support

O = builtins.O
PACKAGE = pathlib.Path(yadefrag.__file__).absolute().parent.parent


def report():
    lines = []
    return yadefrag.about(lines.append), lines


def byName(lines):
    return dict(re.match(r'(\S+) +(.*)', line).groups() for line in lines[:-1])


def test_allIsWellHere():
    well, lines = report()
    assert well and lines[-1] == 'All is well.'
    rows = byName(lines)
    assert yadefrag.__version__ in rows['yadefrag'] and config.version in rows['YADE']
    # Of git, or of the project.
    assert re.fullmatch(r'\d+\.\d+\.\d+(\+(\d+\.)?g[0-9a-f]{7})?', yadefrag.__version__)
    flags = pathlib.Path('/proc/cpuinfo').read_text()
    assert rows['instructions'] == ('AVX2' if re.search(r'\bavx2\b', flags) else 'SSE2')
    assert pathlib.Path(rows['examples'], 'README.md').exists()
    assert pathlib.Path(rows['manual']).exists()


def test_whatIsWrongIsNamed(monkeypatch):
    monkeypatch.setattr(support, 'VERSION', '2031.1')
    well, lines = report()
    assert not well and 'Not all is well' in lines[-1]
    assert byName(lines)['interface'].endswith('not as it should be')


def asked(**more):
    return ran(sys.executable, '-m', 'yadefrag', env={**os.environ, 'PYTHONPATH': str(PACKAGE), **more})


def test_plainPythonStartsAYade():
    done = asked()
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[-1] == 'All is well.' and support.VERSION in byName(lines)['YADE']


@pytest.mark.skipif(support.FEATURES is not None, reason='the path of its YADE is known')
def test_yadeThatDoesNotWorkIsReported(tmp_path):
    """In place of yade: a program that fails before any report."""
    program = tmp_path / 'yade'
    program.write_text('#!/bin/sh\necho "ImportError: a library is missing" >&2\nexit 1\n')
    program.chmod(0o755)
    done = asked(PATH='%s:%s' % (tmp_path, os.environ['PATH']))
    assert done.returncode == 1 and done.stdout == ''
    assert done.stderr.strip().endswith('a library is missing')


NAMES = [n for n in yadefrag.__all__ if isinstance(getattr(yadefrag, n), type)
         and n not in ('TradeoffTable', 'EnsembleTable', 'Mesh')]  # no part of a scene


@pytest.mark.parametrize('name', NAMES)
def test_classesAreAsYades(name):
    """They are where scripts look for them, with YADE's errors, and their dict makes the object anew."""
    assert len(NAMES) > 10 and sum(name.endswith('Collider') for name in NAMES) == 3
    made = getattr(wrapper, name)
    assert getattr(yadefrag, name) is made is getattr(builtins, name) and made.__doc__
    isCollider = name.endswith('Collider')
    assert name in system.childClasses('Serializable') and (name in system.childClasses('Collider')) == isCollider
    assert issubclass(made, wrapper.Collider) == O.isChildClassOf(name, 'Collider') == isCollider
    with pytest.raises(AttributeError) as ours:
        made(noSuchAttribute=1)
    with pytest.raises(AttributeError) as yades:
        wrapper.InsertionSortCollider(noSuchAttribute=1)
    assert str(ours.value) == str(yades.value)
    with pytest.raises(AttributeError):
        made().updateAttrs({'noSuchAttribute': 1})
    with pytest.raises((TypeError, ValueError, RuntimeError)):
        made(1, 2)
    one, other = made(), made()
    other.updateAttrs(one.dict())
    assert other.dict().keys() == one.dict().keys()
    assert repr(one).startswith('<%s instance' % name)


@pytest.mark.parametrize('name', [name for name in NAMES if name.endswith('Collider')])
@pytest.mark.parametrize('ending', ['.xml', '.xml.bz2', '.yade', '.yade.gz'])
def test_keywordsAreAttributesAlsoWhenLoaded(name, ending, folder):
    one = getattr(wrapper, name)([wrapper.Bo1_Sphere_Aabb()], verletDist=.25, label='finder', avoidSelfInteractionMask=2)
    assert (one.verletDist, one.label, one.avoidSelfInteractionMask) == (.25, 'finder', 2)
    one.updateAttrs({'verletDist': .5})
    assert one.verletDist == .5
    O.engines = [wrapper.ForceResetter(), one]
    wanted = {name: value for name, value in one.dict().items() if isinstance(value, (bool, int, float, str))}
    assert wanted['verletDist'] == .5
    path = os.path.join(folder, 'scene' + ending)
    O.save(path)
    O.reset()
    O.load(path)
    loaded = O.engines[1]
    assert type(loaded) is type(one) and [type(f) for f in loaded.boundDispatcher.functors] == [wrapper.Bo1_Sphere_Aabb]
    assert {name: loaded.dict()[name] for name in wanted} == wanted


# --- type hints

SOURCES = sorted(pathlib.Path(yadefrag.__file__).parent.rglob('*.py'))


def functions(body, isPublic=True, isMethod=False):
    """(function, True if its first argument is the object) of all public ones, also of public classes."""
    for one in body:
        isShown = isPublic and (not one.name.startswith('_') or one.name.startswith('__')) \
            if isinstance(one, (ast.ClassDef, ast.FunctionDef)) else False
        if isShown and isinstance(one, ast.ClassDef):
            yield from functions(one.body, isMethod=True)
        elif isShown:
            isStatic = any(ast.unparse(d) == 'staticmethod' for d in one.decorator_list)
            yield one, isMethod and not isStatic


def lacking(function, isMethod):
    """Names of the arguments without a type, and 'return'."""
    of = function.args
    arguments = [*of.posonlyargs, *of.args, *of.kwonlyargs, *filter(None, [of.vararg, of.kwarg])][isMethod:]
    return [one.arg for one in arguments if one.annotation is None] + ['return'] * (function.returns is None)


@pytest.mark.parametrize('file', SOURCES, ids=lambda file: file.stem)
def test_publicFunctionsHaveHints(file):
    found = {one.name: lacking(one, isMethod) for one, isMethod in functions(ast.parse(file.read_text()).body)}
    assert {name: those for name, those in found.items() if those} == {}


def test_hintsAreShown():
    """Also of functions that are called through another one, and of FESolver's methods."""
    assert len(SOURCES) > 50
    for function in (yadefrag.plotMesh, yadefrag.tradeoff, yadefrag.FESolver.addPolygon):
        found = inspect.signature(function)
        assert found.return_annotation is not found.empty
        assert all(one.annotation is not one.empty for one in found.parameters.values())


def test_classesForCheckersAreThoseThatArePublished():
    tree = ast.parse(pathlib.Path(yadefrag.__file__).read_text())
    named = [one.name for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module == 'yade.wrapper'
             for one in node.names]
    assert named == sorted(name for name in yadefrag.__all__ if hasattr(wrapper, name))
