"""Taylor's bar of copper, 227 m/s, in plane strain: final length and foot, beside CalculiX's explicit dynamics.

CalculiX (Debian: apt-get install calculix-ccx) steps the same triangles: as wedges C3D6 between two layers of nodes
that are held in z, which are as stiff against changes of volume as our 'linear' triangles. The yield stress is the
same table. The wall: the foot's nodes do not move along the bar.
"""
import builtins
import os
import shutil
import subprocess

import numpy
import pytest
import yadefrag
from yadefrag import FESolver, PlasticFEMat, rectangle

O = builtins.O

WIDTH, LENGTH, SIZE, SPEED, UNTIL = 6.4e-3, 32.4e-3, 8e-4, 227, 80e-6  # m, m/s, s
YOUNG, POISSON, DENSITY = 124e9, .34, 8960
TABLE = [(p, 90e6 + 292e6 * p**.31) for p in [0] + [.002 * 1.35**i for i in range(22)]]
DEPTH = 1e-3  # m, of a wedge


def bar(element):
    O.reset()
    O.materials.append(PlasticFEMat(young=YOUNG, poisson=POISSON, density=DENSITY, hardeningTable=TABLE))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (WIDTH, LENGTH)), size=SIZE, material=0, element=element,
                  velocity=lambda x, y: (0, -SPEED if y > 1e-9 else 0), fixed=lambda x, y: 'y' if y < 1e-9 else False)
    O.engines = yadefrag.engines(fe)
    O.dt = .6 * fe.criticalTimeStep()
    return fe


def measure(places, reference):
    """Length and foot (m)."""
    foot = places[reference[:, 1] < 1e-9, 0]
    return places[:, 1].max(), numpy.ptp(foot)


def ours(element):
    fe = bar(element)
    reference = fe.nodes.copy()
    while fe.time < UNTIL:
        O.run(100, True)
    assert not [one for one in fe.warnings if 'energy' in one]
    return measure(fe.nodes, reference)


def test_lengthAndFootAreThoseOfCalculiX(tmp_path):
    if not shutil.which('ccx'):
        pytest.skip('CalculiX is not installed: apt-get install calculix-ccx')
    fe = bar('linear')
    nodes, triangles = fe.nodes.copy(), fe.triangles.copy()
    (tmp_path / 'bar.inp').write_text(deck(nodes, triangles))
    done = subprocess.run(['ccx', 'bar'], cwd=tmp_path, env=dict(os.environ, OMP_NUM_THREADS='1'), check=False,
                          timeout=300, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0 and '*ERROR' not in done.stdout, done.stdout[-300:]
    theirs = measure(nodes + displacements(tmp_path / 'bar.dat', len(nodes)), nodes)
    length, foot = ours('linear')
    
    assert length == pytest.approx(theirs[0], rel=.03)
    assert foot == pytest.approx(theirs[1], rel=.03)


def test_lockingMakesTheBarLonger():
    """What CalculiX's wedges share with linear triangles: less flow than with the default."""
    assert ours('smoothed')[0] < ours('linear')[0]


def deck(nodes, triangles):
    """CalculiX's input: two layers of nodes, wedges."""
    count = len(nodes)
    out = ['*NODE, NSET=ALL']
    out += ['%d, %.12e, %.12e, %g' % (k * count + n + 1, x, y, k * DEPTH) for k in (0, 1)
            for n, (x, y) in enumerate(nodes)]
    out.append('*ELEMENT, TYPE=C3D6, ELSET=BAR')
    out += ['%d, %s' % (e + 1, ', '.join(str(k * count + n + 1) for k in (0, 1) for n in corners))
            for e, corners in enumerate(triangles)]
    atFoot = nodes[:, 1] < 1e-9
    for name, chosen in (('FOOT', atFoot), ('FREE', ~atFoot)):
        out.append('*NSET, NSET=' + name)
        out += ['%d,' % (k * count + n + 1) for k in (0, 1) for n in numpy.flatnonzero(chosen)]
    out += ['*MATERIAL, NAME=COPPER', '*ELASTIC', '%g, %g' % (YOUNG, POISSON), '*DENSITY', '%g' % DENSITY, '*PLASTIC']
    out += ['%.10g, %.10g' % (stress, strain) for strain, stress in TABLE]
    out += ['*SOLID SECTION, ELSET=BAR, MATERIAL=COPPER', '*BOUNDARY', 'FOOT, 2, 2', 'ALL, 3, 3',
            '*INITIAL CONDITIONS, TYPE=VELOCITY', 'FREE, 2, %g' % -SPEED,
            '*STEP, INC=1000000, NLGEOM', '*DYNAMIC, EXPLICIT', '1e-8, %g' % UNTIL,
            '*NODE PRINT, NSET=ALL, FREQUENCY=500', 'U', '*END STEP', '']
    return '\n'.join(out)


def displacements(file, count):
    """(n, 2) of the first layer, in the last record."""
    moved = numpy.zeros((count, 2))
    with open(file, encoding='utf-8') as lines:
        for line in lines:
            words = line.split()
            if len(words) == 4 and words[0].isdigit() and int(words[0]) <= count:
                moved[int(words[0]) - 1] = float(words[1]), float(words[2])
    return moved
