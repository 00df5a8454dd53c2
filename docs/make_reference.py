"""Writes the manual's reference from the docstrings: scripts/yade -n -x docs/make_reference.py FILE (scripts/docs calls it).

tests/pkg/examples/test_fe_examples.py tests it.
"""

import inspect
import re
import sys

import yadefrag
from yade import wrapper

GROUPS = (
    ('Solver', ('FESolver', 'engines', 'runSteps', 'FERecorder')),
    ('Materials', ('FEMat', 'BrittleFEMat', 'PlasticFEMat', 'FrictionalFEMat')),
    ('Geometry', ('rectangle', 'circle', 'ring', 'voronoi', 'grainJoints', 'snapOutlines', 'Mesh', 'polygonMesh', 'rectangleMesh',
                  'readPolygon', 'readOutline', 'readMesh', 'outlineReport')),
    ('Results and pictures', ('plotMesh', 'animate', 'exportVTK', 'crackTable', 'fragmentTable', 'plotFragmentSizes',
                              'recordFracture', 'plotFracture')),
    ('Many runs', ('tradeoff', 'TradeoffTable', 'ensemble', 'EnsembleTable')),
    ('Colliders', ('LebesgueCollider', 'LinearCodeCollider', 'HierarchyCollider', 'inCurveOrder')),
    ('Interaction loop and integrator', ('CurveLoop', 'CurveIntegrator')),
)


# 'size   length of …' begins an argument; the lines of the same one are indented.
ARGUMENT = re.compile(r'([A-Za-z]\w*(?:, \w+)*)( +)(\S.*)')


def parameters(of):
    try:
        return set(inspect.signature(of).parameters)
    except (TypeError, ValueError):  # a property, or a function of Boost.Python
        return set()


def text(of):
    """A docstring as Markdown: arguments as a list, the rest as paragraphs."""
    known = parameters(of)
    lines = inspect.cleandoc(getattr(of, '__doc__', None) or '').replace('<', '&lt;').splitlines()
    out, isArgument = [], False
    for line in lines:
        match = None if line.startswith(' ') else re.fullmatch(ARGUMENT, line)
        if match and (len(match[2]) > 1 or known.issuperset(match[1].split(', '))):
            out += [''] * (not isArgument and bool(out) and out[-1] != '') + ['- `%s`: %s' % match.group(1, 3)]
            isArgument = True
        elif isArgument and line.startswith(' '):
            out.append('  ' + line.strip())
        else:
            out += [''] * isArgument + [line]
            isArgument = False
    return '\n'.join(out)


def callOf(function):
    """Its arguments, without types, which the text explains; a function as a default value by its name."""
    found = inspect.signature(function)
    plain = [one.replace(annotation=one.empty) for one in found.parameters.values()]
    text = str(found.replace(parameters=plain, return_annotation=found.empty))
    return re.sub(r'<function (\w+) at 0x\w+>', r'\1', text)


def ownMembers(of):
    """{name: member}: public ones that are not those of YADE's base classes."""
    own, known = {}, set()
    for base in of.__mro__[::-1]:
        if base is of or base.__module__.startswith('yadefrag.'):
            own.update(vars(base))
        else:
            known.update(vars(base))
    return {name: own[name] for name in sorted(own) if not name.startswith('_') and name not in known}


def describe(name, of):
    try:
        signature = callOf(of) if not inspect.isclass(of) else ''
    except ValueError:
        signature = ''
    yield f'### `{name}{signature}`\n\n{text(of)}\n'
    if not inspect.isclass(of):
        return
    for member, what in ownMembers(of).items():
        try:
            call = callOf(what) if callable(what) else ''
        except ValueError:
            call = '(…)'
        doc = text(what)
        if doc:
            lines = doc.replace('\n', '\n  ')
            yield f'`{member}{call}`\n: {lines}\n'


def page():
    """The whole text."""
    named = set()
    lines = ['# Reference\n', 'Of all names, with their arguments, from the docstrings by `docs/make_reference.py`. Units are SI. '
             '`help(name)` shows the same in YADE, with the types of arguments.\n',
             'All names are in `yadefrag`; those for many runs are also in `yadefrag.studies`, those that read or write '
             'files in `yadefrag.io`, those that draw in `yadefrag.plots`.\n']
    for title, names in GROUPS:
        lines.append(f'## {title}\n')
        for name in names:
            lines += describe(name, getattr(yadefrag, name))
            named.add(name)
    lines.append('## Classes for YADE\'s engines\n')
    for name in sorted(set(yadefrag.__all__) - named):
        lines += describe(name, getattr(yadefrag, name, None) or getattr(wrapper, name))
    return '\n'.join(line.rstrip() for line in '\n'.join(lines).split('\n')).rstrip() + '\n'


if __name__ == '__main__':
    with open(sys.argv[1], 'w') as file:
        file.write(page())
