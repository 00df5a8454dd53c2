"""Calls by position, messages that many bodies have, and what is written about a refused step."""
import builtins
import subprocess
import warnings

import pytest

import yadefrag
from project import yadeCommand
from yade import wrapper as w

O = builtins.O
kSquare = yadefrag.rectangle((0, 0), (1, 1))


def solver(**settings):
    O.materials.append(w.BrittleFEMat(young=70e9, poisson=.2, density=2500, tensileStrength=6e6, label='s',
                                      **settings))
    return w.FESolver()


@pytest.mark.parametrize('arguments', [(kSquare, .5, 's'), (kSquare, (), .5, 's'), (kSquare, lambda x, y: .5, 's'),
                                       (kSquare, [[(.2, .2), (.4, .2), (.3, .4)]], .5, 's')])
def test_polygonsByPosition(arguments):
    found = solver()
    found.addPolygon(*arguments)
    by = ('size', 'material') if len(arguments) == 3 else ('holes', 'size', 'material')
    nodes = found.nodes
    O.reset()
    other = solver()
    other.addPolygon(arguments[0], **dict(zip(by, arguments[1:])))
    assert (nodes == other.nodes).all() and len(nodes) > 4


def test_trianglesByPosition():
    found = solver()
    assert found.addTriangles(*yadefrag.rectangleMesh((0, 0), (1, 1), 2, 2), 's') == 0


def wall(count, fe):
    """`count` bricks with a mesh too coarse for their fracture energy."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always')
        for k in range(count):
            fe.addPolygon(yadefrag.rectangle((2 * k, 0), (2 * k + 1, 1)), .3 + .001 * k, 's')
        O.engines, O.dt = [fe], 1e-9
        O.step()
        O.run(2, True)
    return [str(one.message) for one in caught], [one.filename for one in caught]


def test_aMessageOfManyBodiesIsGivenOnceWithTheirNumber():
    said, files = wall(27, solver(fractureEnergy=1))
    assert len(said) == 2 and set(files) == {__file__}
    assert 'component 0' in said[0] and 'less than four elements' in said[0]
    assert said[1].startswith('27 bodies have this message') and said[1].endswith('the bodies 0 to 26.')
    O.reset()
    said, _ = wall(1, solver(fractureEnergy=1))  # another scene: from the beginning
    assert len(said) == 1 and 'component 0' in said[0]


def test_aMessageOfManyBondsIsGivenOnceWithTheirNumber():
    """Four strips side by side: three bonds too weak for their sides."""
    O.materials.append(w.FEMat(young=1e9, poisson=0, density=1000, label='m'))
    fe = w.FESolver()
    for k in range(4):
        fe.addPolygon(yadefrag.rectangle((k, 0), (k + 1, 1)), .5, 'm')
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always')
        for k in range(3):
            assert fe.bond(k, k + 1, 5e6, 100) == 2
        O.engines, O.dt = [fe], 1e-7
        yadefrag.runSteps(1)
    said = [str(one.message) for one in caught]
    assert len(said) == 2 and said[0].startswith('bond: energy is 100 J/m² of the bond between the bodies 0 and 1 at')
    assert said[1].startswith('3 bonds have this message') and said[1].endswith('the bonds 0-1, 1-2, 2-3.')


def test_relaxEndsWithoutLoads():
    fe = w.FESolver()
    O.materials.append(w.FEMat(young=5e9, poisson=.25, density=2500, label='g'))
    fe.addPolygon(kSquare, .4, 'g')
    O.engines, O.dt = [fe], .5 * fe.criticalTimeStep()
    assert fe.relax(most=500) < 200


# The last one is a run in the background.
kRefused = """
from yadefrag import *
O.materials.append(FEMat(young=1e9, poisson=.2, density=1000, label='s'))
fe = FESolver()
fe.addPolygon(rectangle((0, 0), (1, 1)), .5, 's')
O.engines, O.dt = engines(fe), 1.
for run in (lambda: O.run(3, True), lambda: runSteps(3), lambda: O.run(3, True)):
    try:
        run()
    except RuntimeError as error:
        print('caught', error)
O.run()
O.wait()
"""


def test_aRefusedStepIsToldOnce(folder):
    """Only a run in the background, whose error nobody gets, has YADE's own lines."""
    script = folder + '/refused.py'
    with open(script, 'w') as out:
        out.write(kRefused)
    done = subprocess.run([*yadeCommand(), script], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=120)
    foreground, _, _ = done.stdout.partition('FATAL')
    lines = [line for line in foreground.splitlines() if 'time step' in line]
    assert len(lines) == 3 and all(line.startswith('caught') for line in lines), done.stdout
    assert 'ERROR' not in foreground.replace('<', '').split('caught')[0] and done.stdout.count('FATAL') == 1


def test_aWarningOfAFileIsAtTheLineOfTheScript(tmp_path):
    square = '0, 0\n1, 0\n1, 1\n0, 1\n'
    (tmp_path / 'twice.csv').write_text(square + '\n' + square)
    with pytest.warns(UserWarning, match='second copies of a line') as caught:
        assert len(yadefrag.readOutline(tmp_path / 'twice.csv')) == 1
    assert caught[0].filename == __file__
