"""PlasticFEMat: bodies that yield, their fields, energies and files."""
import builtins
import math
import os
import re

import numpy
import pytest
import yadefrag
from yadefrag import BrittleFEMat, FEMat, FESolver, FrictionalFEMat, PlasticFEMat, rectangle

O = builtins.O

COPPER = dict(young=117e9, poisson=.34, density=8930, yieldStress=90e6, hardening=292e6, hardeningExponent=.31,
              rateFactor=.025, thermalExponent=1.09, meltTemperature=1356, heatCapacity=383)


def bar(speed=100, **material):
    """A copper bar of 8 × 24 mm that hits a block that is held everywhere."""
    O.materials.append(PlasticFEMat(**{**COPPER, **material}))
    solver = FESolver()
    solver.addPolygon(rectangle((0, 0), (.008, .024)), size=1e-3, material=0, velocity=(0, -speed))
    solver.addPolygon(rectangle((-.01, -.004), (.018, 0)), size=2e-3, material=steel(),
                      fixed=lambda x, y: True)
    O.engines = yadefrag.engines(solver)
    O.dt = .5 * solver.criticalTimeStep()
    return solver


def steel():
    return FEMat(young=210e9, poisson=.3, density=7800)


def solverOfScene():
    return next(engine for engine in O.engines if isinstance(engine, FESolver))


def test_barIsUpsetAndHeated():
    fe = bar()
    start = fe.energy['total']
    O.run(600, True)
    strain, heat = fe.plasticStrain, fe.temperature
    own = fe.components == 0
    assert strain.shape == heat.shape == (len(fe.triangles),)
    assert .1 < strain[own].max() < 1 and (strain[~own] == 0).all() and (heat[~own] == 0).all()
    # The mean temperature is the part of the plastic work that becomes heat.
    area = numpy.abs(numpy.cross(*(fe._reference[fe.triangles][:, [1, 2]] - fe._reference[fe.triangles][:, [0]])
                                 .transpose(1, 0, 2))) / 2
    warmed = (area * (heat - 293))[own].sum() * 8930 * 383
    energy = fe.energy
    assert warmed == pytest.approx(.9 * energy['plastic'], rel=.01)
    assert energy['plastic'] > .3 * start
    assert energy['total'] == pytest.approx(start, rel=1e-4)
    assert not fe.warnings


def test_fieldsArePlottedExportedAndRecorded(tmp_path):
    fe = bar()
    O.engines = O.engines + [yadefrag.FERecorder(100, str(tmp_path / 'run'))]
    O.run(301, True)
    shown = yadefrag.plotMesh(fe, 'plasticStrain').collections[0].get_array()
    assert numpy.array_equal(shown, fe.plasticStrain)
    assert yadefrag.plotMesh(fe, 'temperature') is not None
    meshio = pytest.importorskip('meshio')
    file = str(tmp_path / 'bar.vtu')
    yadefrag.exportVTK(fe, file)
    mesh = meshio.read(file)
    assert numpy.array_equal(mesh.cell_data['plastic strain'][0], fe.plasticStrain)
    assert numpy.array_equal(mesh.cell_data['temperature'][0], fe.temperature)
    with open(tmp_path / 'run.csv', encoding='utf-8') as table:
        head, *lines = [line.rstrip().split(',') for line in table]
    last = dict(zip(head, lines[-1]))
    assert len(lines) == 4 and float(last['plastic (J)']) > 0
    assert float(last['largest plastic strain']) > .05 and float(last['highest temperature (K)']) > 300


@pytest.mark.parametrize('ending', ['.yade.gz', '.xml'])
def test_continuesFromAFileWithTheSameBits(tmp_path, ending):
    bar()
    O.run(200, True)
    file = str(tmp_path / ('half' + ending))
    O.save(file)

    def end():
        O.run(200, True)
        fe = solverOfScene()
        return [fe.nodes.tobytes(), fe.plasticStrain.tobytes(), fe.temperature.tobytes(), repr(fe.energy)]

    whole = end()
    O.load(file)
    assert end() == whole


def test_smoothedIsTheDefaultAndLinearTrianglesLock():
    ends = {}
    for element in (None, 'smoothed', 'linear'):
        O.reset()
        O.materials.append(PlasticFEMat(**COPPER))
        fe = FESolver()
        fe.addPolygon(rectangle((0, 0), (.008, .024)), size=1e-3, material=0, element=element,
                      velocity=lambda x, y: (0, -4000 * y), fixed=lambda x, y: 'y' if y < 1e-9 else False)
        O.engines = yadefrag.engines(fe)
        O.dt = .5 * fe.criticalTimeStep()
        O.run(300, True)
        ends[element] = fe.nodes.copy()
    assert numpy.array_equal(ends[None], ends['smoothed'])
    assert not numpy.array_equal(ends[None], ends['linear'])


@pytest.mark.parametrize('constants, sentence', [
    (dict(yieldStress=0), 'yieldStress is 0 Pa; it must be positive and finite.'),
    (dict(hardening=-1e6), r'hardening is -1e\+06 Pa; it must be 0 or positive, and finite.'),
    (dict(hardeningExponent=0), 'hardeningExponent is 0; it must be above 0 and at most 1.'),
    (dict(meltTemperature=200), 'meltTemperature is 200 K; it must be above startTemperature, and finite.'),
    (dict(rateFactor=math.nan), 'rateFactor is nan; it must be 0 or positive, and finite.'),
    (dict(heatShare=1.5), 'heatShare is 1.5; it must be from 0 to 1.')])
def test_wrongConstantsAreRefused(constants, sentence):
    O.materials.append(PlasticFEMat(**{**COPPER, **constants}))
    fe = FESolver()
    with pytest.raises(ValueError, match=sentence):
        fe.addPolygon(rectangle((0, 0), (.008, .024)), size=1e-3, material=0)
    assert len(fe.nodes) == 0


@pytest.mark.parametrize('constants, sentence', [
    (dict(cohesion=0), 'cohesion is 0 Pa; it must be positive and finite.'),
    (dict(internalFriction=1.6), 'internalFriction is 1.6; it must be at least 0 and below π/2'),
    (dict(dilationAngle=.6), 'dilationAngle is 0.6; it must be at least 0 and at most internalFriction.'),
    (dict(tensionLimit=-1), 'tensionLimit is -1 Pa; it must be 0 or positive.'),
    (dict(planeStress=True), 'planeStress is True, but the material is frictional; it must be False.')])
def test_wrongConstantsOfFrictionAreRefused(constants, sentence):
    soil = dict(young=1e8, poisson=.3, density=2000, cohesion=1e4, internalFriction=.5)
    O.materials.append(FrictionalFEMat(**{**soil, **constants}))
    with pytest.raises(ValueError, match=re.escape(sentence)):
        FESolver().addPolygon(rectangle((0, 0), (.1, .1)), size=1e-2, material=0)


def test_aBlockOfSoilIsCrushed():
    """Between a floor and a plate that comes down; the stress is that of Mohr and Coulomb in plane strain."""
    O.materials.append(FrictionalFEMat(young=1e8, poisson=.3, density=2000, cohesion=1e5, internalFriction=.5,
                                       dilationAngle=.5))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (1, 1)), size=.1, material=0,
                  fixed=lambda x, y: 'y' if y < 1e-9 or y > 1 - 1e-9 else False)
    fe.prescribe(lambda x, y: y > 1 - 1e-9, vy=-.05)
    fe.damping = 40
    O.engines = yadefrag.engines(fe)
    O.dt = .6 * fe.criticalTimeStep()
    O.run(int(.008 / .05 / O.dt), True)
    top = fe._reference[:, 1] > 1 - 1e-9
    strength = 2e5 * math.cos(.5) / (1 - math.sin(.5))
    width = numpy.ptp(fe.nodes[top, 0])
    assert -fe.reactions[top, 1].sum() / width == pytest.approx(strength, rel=.03)
    assert fe.plasticStrain.min() > 0 and fe.energy['plastic'] > 0


def test_hardeningTable():
    table = [(0, 1e8), (.1, 2e8)]
    assert PlasticFEMat(hardeningTable=table).hardeningTable == table
    assert PlasticFEMat().hardeningTable == 'none'
    with pytest.raises(ValueError, match='stresses must not decrease'):
        PlasticFEMat(hardeningTable=[(0, 2e8), (.1, 1e8)])
    with pytest.raises(TypeError, match='hardeningTable is'):
        PlasticFEMat(hardeningTable=7)


def test_severalMaterialsMustNotYield():
    O.materials.append(PlasticFEMat(**COPPER))
    O.materials.append(steel())
    with pytest.raises(ValueError, match='several materials, one of which yields'):
        FESolver().addPolygon(rectangle((0, 0), (.008, .024)), size=1e-3,
                              material=lambda x, y: 0 if y < .01 else 1)


def test_aScenesFilesWithoutYieldingHaveNoNewColumns(tmp_path):
    O.materials.append(BrittleFEMat(young=70e9, poisson=.2, density=2500, tensileStrength=6e6))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (.008, .024)), size=2e-3, material=0, velocity=(0, -1))
    O.engines = yadefrag.engines(fe) + [yadefrag.FERecorder(1, str(tmp_path / 'run'), fields=())]
    O.dt = .5 * fe.criticalTimeStep()
    O.run(2, True)
    assert 'plastic' not in fe.energy and (fe.plasticStrain == 0).all()
    with open(tmp_path / 'run.csv', encoding='utf-8') as lines:
        assert 'plastic' not in lines.readline()
    assert os.listdir(tmp_path) == ['run.csv']
