"""Libraries that only some functions need."""

import importlib
import warnings
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any


def needed(module: str, package: str, what: str) -> ModuleType:
    """The module of an optional library; ImportError with the name of Debian's package if it is missing.

    what  subject and verb of the sentence: 'voronoi works'
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError('%s only with the Python library %s, which is missing '
                          "(%s): install Debian's package %s." % (what, module, error, package), name=module) from None


def shapely(module: str, what: str) -> ModuleType:
    """A module of shapely, by its name without 'shapely'."""
    return needed('shapely.' + module, 'python3-shapely', what)


def treeOf(shapes: Sequence[Any], search: str, what: str) -> Callable[[Any], Any]:
    """A function of a shape, with the numbers of the `shapes` whose boxes meet its box (search='query'), or that of
    the one at the least distance ('nearest')."""
    with warnings.catch_warnings():  # that it will be another one in 2.0
        warnings.simplefilter('ignore', FutureWarning)
        tree = shapely('strtree', what).STRtree(shapes)
    old = {'query': 'query_items', 'nearest': 'nearest_item'}[search]  # of shapely 1.8
    return getattr(tree, old, None) or getattr(tree, search)
