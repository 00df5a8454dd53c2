"""PlasticFEMat that fails: damage, cracks, files."""
import builtins
import math

import numpy
import pytest
import yadefrag
from fe_impact import FAILS, STEEL, plate
from yadefrag import FESolver, FrictionalFEMat, PlasticFEMat, rectangle

O = builtins.O

def test_aPlateIsPlugged():
    fe = plate(**FAILS)
    start = fe.energy['total']
    assert (fe.damage == 0).all()
    while fe.time < 30e-6:
        O.run(200, True)
    own, damage = fe.components == 0, fe.damage
    assert damage.shape == (len(fe.triangles),) and damage.max() == 1 and damage.min() == 0
    assert (damage[~own] == 0).all()
    energy = fe.energy
    assert energy['total'] == pytest.approx(start, rel=1.2e-4)  # 10 % of strain in the shock; half the step: 2e-5
    # Both ends are still held; the plug, as wide as the bar, has left before it.
    held = fe._reference[:, 0]
    ends = [fe.fragmentOf[numpy.isin(fe.triangles, numpy.flatnonzero(at)).any(axis=1) & own]
            for at in (held < -.0119, held > .0119)]
    assert all((numbers == numbers[0]).all() for numbers in ends) and ends[0][0] != ends[1][0]
    plug = max((piece for number, piece in enumerate(fe.fragments()) if (fe.fragmentOf == number)[own].any()
                and number not in (ends[0][0], ends[1][0])), key=lambda piece: piece['mass'])
    assert .4 < plug['mass'] / (7830 * .006 * .002) < 1.1
    assert plug['velocity'][1] < -300


def test_fieldsArePlottedExportedAndRecorded(tmp_path):
    fe = plate(**FAILS)
    O.engines = O.engines + [yadefrag.FERecorder(100, str(tmp_path / 'run'))]
    O.run(401, True)
    assert fe.damage.max() == 1
    own = fe.components == 0  # the bar has no temperature
    meshio = pytest.importorskip('meshio')
    file = str(tmp_path / 'plate.vtu')
    yadefrag.exportVTK(fe, file)
    mesh = meshio.read(file)
    for name, written in (('plasticStrain', 'plastic strain'), ('temperature', 'temperature'), ('damage', 'damage')):
        field = getattr(fe, name)
        shown = yadefrag.plotMesh(fe, name).collections[0].get_array()
        assert len(shown) == len(field) and numpy.array_equal(shown[own], field[own])
        assert numpy.array_equal(mesh.cell_data[written][0], field)
    yadefrag.exportVTK(fe, file, ['damage'])
    assert list(meshio.read(file).cell_data) == ['damage']
    with open(tmp_path / 'run.csv', encoding='utf-8') as table:
        head, *lines = [line.rstrip().split(',') for line in table]
    last = dict(zip(head, lines[-1]))
    assert len(lines) == 5 and float(last['plastic (J)']) > 0
    assert float(last['largest plastic strain']) > .05 and float(last['highest temperature (K)']) > 300
    assert float(last['largest damage']) == 1
    assert int(last['failed triangles']) == (fe.damage >= 1).sum() > 0


def bar(**settings):
    """A bar that is pulled until triangles fail: (solver, damage)."""
    O.reset()
    material = {**STEEL, 'failureStrain': .05, 'fractureEnergy': 2e4, **settings.pop('material', {})}
    O.materials.append(PlasticFEMat(**material))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (.02, .004)), size=1e-3, material=0, velocity=lambda x, y: (4e3 * x, 0),
                  fixed=lambda x, y: not 1e-9 < x < .02 - 1e-9, **settings)
    O.engines = yadefrag.engines(fe)
    O.dt = .7 * fe.criticalTimeStep()
    O.run(200, True)
    return fe, fe.damage


def test_strengthIsAFactorOfTheFailureStrain():
    fe, damage = bar(material=dict(failureStrain=1))
    left = fe._reference[fe.triangles].mean(axis=1)[:, 0] < .01
    strains = fe.plasticStrain
    assert .03 < strains.max() < .1 and damage == pytest.approx(strains, rel=1e-9)
    _, twice = bar(material=dict(failureStrain=1), strength=lambda x, y: .5 if x < .01 else 1)
    assert twice[left] == pytest.approx(2 * damage[left], rel=1e-9)
    assert twice[~left] == pytest.approx(damage[~left], rel=1e-9)
    # A factor by which triangles fail only there.
    fe, _ = bar(strength=lambda x, y: .5 if x < .01 else 10)
    assert fe.numCracks > 0 and (fe.damage >= 1).any() and not (fe.damage[~left] >= 1).any()


def test_theFailureStrainIsScattered():
    fe, plain = bar(material=dict(failureStrain=1))

    def factors(**scatter):
        _, damage = bar(material=dict(failureStrain=1, **scatter))
        return plain / damage

    even = factors(strengthScatter=.2)
    assert .8 < even.min() < .83 and 1.17 < even.max() < 1.2
    assert numpy.array_equal(even, factors(strengthScatter=.2, seed=0))
    assert not numpy.allclose(even, factors(strengthScatter=.2, seed=1))
    weibull = factors(weibullModulus=8)
    # Mean of a Weibull distribution; of some 200 values, whose deviation is 0.14.
    assert weibull.mean() == pytest.approx(math.gamma(1 + 1 / 8), abs=.03)
    # The scale is (V0/V)**(1/m).
    x, y = fe._reference[fe.triangles].transpose(2, 0, 1)
    area = abs((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])) / 2
    sized = factors(weibullModulus=8, referenceVolume=1e-9) / weibull
    assert sized == pytest.approx((1e-9 / area) ** (1 / 8), rel=1e-9)


def test_theFractureEnergyMayVary():
    fe, _ = bar(fractureEnergy=lambda x, y: 5e3)
    plain, _ = bar(material=dict(fractureEnergy=5e3))
    assert fe.numCracks > 0 and fe.nodes.tobytes() == plain.nodes.tobytes()
    # Where it is 0, cracks open at once.
    fe, _ = bar(fractureEnergy=lambda x, y: 0 if x < .01 else 1e6)
    table = yadefrag.crackTable(fe)
    weak = table['x'] < .0095
    assert weak.any() and (table['energy'][weak] == 0).all() and not table['held'][weak].any()
    tough = table['x'] > .0115
    assert tough.any() and (table['energy'][tough] == 1e6).all() and table['held'][tough].all()


CONCRETE = dict(young=30e9, poisson=.2, density=2400, cohesion=5e6, internalFriction=.5, dilationAngle=.5,
                tensionLimit=1.2e6)


def test_aFrictionalMaterialCracksAtItsTensionLimit():
    O.materials.append(FrictionalFEMat(**CONCRETE, fractureEnergy=20))
    fe = FESolver()
    # Thinner in the middle, so that it cracks there.
    fe.addPolygon([(0, 0), (.01, .0004), (.02, 0), (.02, .004), (.01, .0036), (0, .004)], size=1e-3, material=0,
                  fixed=lambda x, y: 'x' if x < 1e-9 or x > .02 - 1e-9 else False)
    O.engines = yadefrag.engines(fe)
    O.dt = .8 * fe.criticalTimeStep()
    fe.prescribe(lambda x, y: x > .02 - 1e-9, vx=.1)
    while fe.time < 350e-6:
        O.run(200, True)
    assert len(fe.fragments()) == 2
    # Of .0032 m, across an irregular mesh, and of edges that opened beside it.
    assert 1 < fe.energy['fracture'] / (20 * .0032) < 1.6


def test_anUnresolvedFractureEnergyIsRefused():
    """At the step after the material has failed, with the step that would be sufficient."""
    fe = plate(**{**FAILS, 'fractureEnergy': 1e-3})
    with pytest.raises(RuntimeError, match='fractureEnergy is 0.001 J/m² in component 0 at .* does not resolve'):
        O.run(2000, True)
    assert fe.damage.max() == 1
