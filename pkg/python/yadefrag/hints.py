"""Names for the types of arguments, for hints."""

import os
from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from yade.wrapper import FEMat, FESolver
from yadefrag._yadefrag import Mesh

__all__ = ['ArrayLike', 'ByPlace', 'FEMat', 'FESolver', 'File', 'Loop', 'Mesh', 'Nodes', 'Shape']

File = str | os.PathLike[str]
Loop = list[tuple[float, float]]  # points (x, y) in m
Shape = tuple[Loop, list[Loop]]  # an outline and its holes
ByPlace = Callable[[float, float], Any]  # a function of (x, y) in m
Nodes = ArrayLike | ByPlace  # numbers or flags, a function that selects nodes, or a body's name
