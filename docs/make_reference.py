"""Writes docs/reference.md from the docstrings; run inside YADE by scripts/docs."""

import inspect
import os
import sys

import yadefrag
from yade import wrapper

GROUPS = (
    ('Solver', ('FESolver', 'engines', 'runSteps', 'FERecorder')),
    ('Materials', ('FEMat', 'BrittleFEMat')),
    ('Geometry', ('rectangle', 'circle', 'ring', 'voronoi', 'grainJoints', 'rectangleMesh', 'readPolygon',
                  'readOutline', 'readMesh', 'outlineReport')),
    ('Results and pictures', ('plotMesh', 'animate', 'exportVTK', 'crackTable', 'fragmentTable', 'plotFragmentSizes',
                              'recordFracture', 'plotFracture')),
    ('Many runs', ('tradeoff', 'TradeoffTable', 'ensemble', 'EnsembleTable')),
    ('Colliders', ('LebesgueCollider', 'LinearCodeCollider', 'HierarchyCollider', 'inCurveOrder')),
)


def text(of):
    return inspect.cleandoc(getattr(of, '__doc__', None) or '').replace('<', '&lt;')


def ownMembers(of):
    """Public members that are not those of YADE's base classes."""
    known = set()
    for base in of.__mro__[1:]:
        known.update(vars(base))
    return sorted(name for name in vars(of) if not name.startswith('_') and name not in known)


def describe(name, of):
    try:
        signature = str(inspect.signature(of)) if not inspect.isclass(of) else ''
    except ValueError:
        signature = ''
    yield f'### `{name}{signature}`\n\n{text(of)}\n'
    if not inspect.isclass(of):
        return
    for member in ownMembers(of):
        what = vars(of)[member]
        try:
            call = str(inspect.signature(what)) if callable(what) else ''
        except ValueError:
            call = '(…)'
        doc = text(what)
        if doc:
            lines = doc.replace('\n', '\n  ')
            yield f'`{member}{call}`\n: {lines}\n'


def main(path):
    named = set()
    lines = ['# Reference\n', 'Generated from the docstrings. Units are SI. `help(name)` shows the same in YADE.\n']
    for title, names in GROUPS:
        lines.append(f'## {title}\n')
        for name in names:
            lines += describe(name, getattr(yadefrag, name))
            named.add(name)
    lines.append('## Classes for YADE\'s engines\n')
    for name in sorted(set(yadefrag.__all__) - named):
        lines += describe(name, getattr(yadefrag, name, None) or getattr(wrapper, name))
    with open(path, 'w') as file:
        file.write('\n'.join(lines))


main(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), 'reference.md'))
