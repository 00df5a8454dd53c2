"""PlasticFEMat: bodies that yield, their fields, energies and files."""
import builtins
import math
import os

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


@pytest.mark.parametrize('speed, element', [(10, 'linear'), (100, 'linear'), (400, 'linear'), (100, 'smoothed')])
def test_flowOfFrictionDissipates(speed, element):
    """A block with hardly any cohesion, of which nothing is dissipated, on a held base."""
    O.materials.append(FrictionalFEMat(young=30e9, poisson=.2, density=2400, cohesion=1e4, internalFriction=.5,
                                       dilationAngle=.5, tensionLimit=1e4))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (.008, .012)), size=3e-3, material=0, velocity=(0, -speed), element=element)
    fe.prescribe(lambda x, y: y < 1e-9, vx=0, vy=0)
    O.engines = yadefrag.engines(fe)
    O.dt = .3 * fe.criticalTimeStep()
    start = .5 * 2400 * .008 * .012 * speed**2
    for _ in range(400):
        O.run(1, True)
        energy = fe.energy
        assert energy['plastic'] >= 0 and energy['strain'] < start
        assert energy['total'] == pytest.approx(start, rel=2e-3)
    assert not fe.warnings


def test_cohesionStaysAsSoilDilates():
    """Biaxial test, shortened by a tenth: the limit load is that of Mohr and Coulomb although the volume grows."""
    angle, cohesion, side = .5, 10e3, 5e3
    O.materials.append(FrictionalFEMat(young=20e6, poisson=.3, density=1800, cohesion=cohesion, internalFriction=angle,
                                       dilationAngle=angle))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (.1, .2)), size=.04, material=0, stress=(-side, -side, 0, -side),
                  fixed=lambda x, y: 'y' if y < 1e-9 else False)
    x, y = fe.nodes.T
    top = numpy.flatnonzero(y > .2 - 1e-9)
    for at in (x < 1e-9, x > .1 - 1e-9):
        fe.pressure(numpy.flatnonzero(at), side)
    fe.prescribe(top, vy=lambda x, y, t: -.1 * min(t / .01, 1))
    fe.damping = 50
    O.engines = yadefrag.engines(fe)
    O.dt = .5 * fe.criticalTimeStep()
    slope = math.tan(math.pi / 4 + angle / 2)**2
    for part in (.5, 1):
        while fe.time < .2 * part:
            O.run(100, True)
        xx, yy, _ = fe.stress.mean(axis=0)
        assert yy / (xx * slope - 2 * cohesion * math.sqrt(slope)) == pytest.approx(1, abs=.01)
    assert -fe.displacements[top, 1].mean() > .018


def test_drySandIsAccepted():
    O.materials.append(FrictionalFEMat(young=2e7, poisson=.3, density=1700, cohesion=0, internalFriction=.6,
                                       dilationAngle=.07))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (1, .5)), size=.1, material=0, fixed=lambda x, y: y < 1e-9)
    fe.gravity = (0, -9.81)
    O.engines = yadefrag.engines(fe)
    O.dt = .5 * fe.criticalTimeStep()
    O.run(300, True)
    assert numpy.isfinite(fe.stress).all() and fe.energy['plastic'] >= 0
    # Volumes are averaged again after the flow, which leaves some tension.
    mean = fe.stress[:, :2].sum(axis=1) + fe.stressZ
    assert mean.max() < .1 * -mean.min()


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
