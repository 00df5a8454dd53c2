"""Public functions and methods have type hints, which mypy checks (scripts/check types), and which a user sees."""

import ast
import inspect
import pathlib

import pytest

import yadefrag
from yade import wrapper

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
