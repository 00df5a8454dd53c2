"""PlasticFEMat that fails: damage, cracks, files, refused constants."""
import builtins
import math
import re

import numpy
import pytest
import yadefrag
from yadefrag import FEMat, FESolver, PlasticFEMat, rectangle

O = builtins.O

STEEL = dict(young=200e9, poisson=.29, density=7830, yieldStress=792e6, hardening=510e6, hardeningExponent=.26,
             rateFactor=.014, thermalExponent=1.03, meltTemperature=1793, heatCapacity=477)
FAILS = dict(failureD1=.05, failureD2=3.44, failureD3=-2.12, failureD4=.002, failureD5=.61, fractureEnergy=2e4)


def plate(speed=500, **material):
    """A plate of 2 mm, held at both ends, that a harder bar plugs."""
    O.materials.append(PlasticFEMat(**{**STEEL, **FAILS, **material}))
    O.materials.append(FEMat(young=600e9, poisson=.22, density=15000))
    fe = FESolver(passes=2)
    fe.addPolygon(rectangle((-.012, 0), (.012, .002)), size=5e-4, material=0,
                  fixed=lambda x, y: abs(x) > .0119)
    fe.addPolygon(rectangle((-.003, .002), (.003, .006)), size=1e-3, material=1, velocity=(0, -speed))
    O.engines = yadefrag.engines(fe)
    O.dt = .7 * fe.criticalTimeStep()
    return fe


def solverOfScene():
    return next(engine for engine in O.engines if isinstance(engine, FESolver))


def test_aPlateIsPlugged():
    fe = plate()
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
    fe = plate()
    O.engines = O.engines + [yadefrag.FERecorder(100, str(tmp_path / 'run'))]
    O.run(401, True)
    assert fe.damage.max() == 1
    shown = yadefrag.plotMesh(fe, 'damage').collections[0].get_array()
    assert numpy.array_equal(shown, fe.damage)
    meshio = pytest.importorskip('meshio')
    file = str(tmp_path / 'plate.vtu')
    yadefrag.exportVTK(fe, file)
    mesh = meshio.read(file)
    assert numpy.array_equal(mesh.cell_data['damage'][0], fe.damage)
    yadefrag.exportVTK(fe, file, ['damage'])
    assert list(meshio.read(file).cell_data) == ['damage']
    with open(tmp_path / 'run.csv', encoding='utf-8') as table:
        head, *lines = [line.rstrip().split(',') for line in table]
    last = dict(zip(head, lines[-1]))
    assert float(last['largest damage']) == 1
    assert int(last['failed triangles']) == (fe.damage >= 1).sum() > 0


@pytest.mark.parametrize('ending', ['.yade.gz', '.xml'])
def test_continuesFromAFileWithTheSameBits(tmp_path, ending):
    plate()
    O.run(100, True)
    file = str(tmp_path / ('half' + ending))
    O.save(file)

    def end():
        O.run(200, True)
        fe = solverOfScene()
        return [fe.nodes.tobytes(), fe.plasticStrain.tobytes(), fe.damage.tobytes(), fe.numCracks, repr(fe.energy)]

    whole = end()
    assert whole[3] > 0
    O.load(file)
    assert end() == whole


@pytest.mark.parametrize('constants, sentence', [
    (dict(failureStrain=0), 'failureStrain is 0; it must be positive, or infinite for none.'),
    (dict(failureStrain=-.1), 'failureStrain is -0.1; it must be positive, or infinite for none.'),
    (dict(failureStrain=math.nan), 'failureStrain is nan; it must be positive, or infinite for none.'),
    (dict(failureD1=-.3), 'failureD1, failureD2 and failureD3 give the failure strain -0.156945 where the mean stress '
                          "is 1.5 times von Mises' stress; it must be positive there, or failureStrain given as the "
                          'least one.'),
    (dict(failureD3=2.12), 'failureD3 is 2.12; it must be 0 or negative, since tension reduces the failure strain.'),
    (dict(failureD4=-.1), 'failureD4 is -0.1; it must be at least -0.04, for a positive failure strain at any rate.'),
    (dict(failureD5=-2), 'failureD5 is -2; it must be above -1, for a positive failure strain up to melting.'),
    (dict(thermalExponent=0, meltTemperature=0), 'failureD5 is 0.61; it must be 0, or meltTemperature above'),
    (dict(failureD1=0, failureD2=0, failureStrain=.3),
     'failureD3 is -2.12; it must be 0 unless failureD1 or failureD2 is given.'),
    (dict(spallStress=-1), 'spallStress is -1 Pa; it must be positive, or infinite for none.'),
    (dict(spallStress=3e9, fractureEnergy=0), 'fractureEnergy is 0 J/m²; it must be positive if spallStress is given'),
    (dict(fractureEnergy=-1), 'fractureEnergy is -1 J/m²; it must be 0 or positive, and finite.')])
def test_wrongConstantsAreRefused(constants, sentence):
    O.materials.append(PlasticFEMat(**{**STEEL, **FAILS, **constants}))
    fe = FESolver()
    with pytest.raises(ValueError, match=re.escape(sentence)):
        fe.addPolygon(rectangle((0, 0), (.008, .024)), size=2e-3, material=0)
    assert len(fe.nodes) == 0


def test_whatWouldBeIgnoredIsRefused():
    O.materials.append(PlasticFEMat(**STEEL, fractureEnergy=1e4))
    O.materials.append(PlasticFEMat(**STEEL, **FAILS))
    outline = rectangle((0, 0), (.008, .024))
    with pytest.raises(ValueError, match='fractureEnergy is 10000 J/m²; it must be 0 unless failureStrain'):
        FESolver().addPolygon(outline, size=2e-3, material=0)
    with pytest.raises(ValueError, match='selfContact is False'):
        FESolver().addPolygon(outline, size=2e-3, material=1, selfContact=False)
    joint = dict(joints=[((0, .01), (.008, .01))], jointStrength=0)
    for settings in (dict(strength=1e9), dict(fractureEnergy=1e3), joint):
        with pytest.raises(ValueError, match='BrittleFEMat'):
            FESolver().addPolygon(outline, size=2e-3, material=1, **settings)


def test_anUnresolvedFractureEnergyIsRefused():
    """At the step after the material has failed, with the step that would be sufficient."""
    fe = plate(fractureEnergy=1e-3)
    with pytest.raises(RuntimeError, match='fractureEnergy is 0.001 J/m² in component 0 at .* does not resolve'):
        O.run(2000, True)
    assert fe.damage.max() == 1


def test_aMaterialThatDoesNotFailHasNoDamage(tmp_path):
    O.materials.append(PlasticFEMat(**STEEL))
    fe = FESolver()
    fe.addPolygon(rectangle((0, 0), (.008, .024)), size=2e-3, material=0, velocity=lambda x, y: (0, -4000 * y))
    O.engines = yadefrag.engines(fe) + [yadefrag.FERecorder(10, str(tmp_path / 'run'), fields=())]
    O.dt = .5 * fe.criticalTimeStep()
    O.run(11, True)
    assert (fe.damage == 0).all() and fe.damage.shape == (len(fe.triangles),)
    with open(tmp_path / 'run.csv', encoding='utf-8') as lines:
        assert 'damage' not in lines.readline()


def test_theDefaultMeshOfAMaterialThatFailsIsIrregular():
    nodes = []
    for mesh in (None, 'irregular', 'regular'):
        O.reset()
        O.materials.append(PlasticFEMat(**STEEL, failureStrain=.3))
        fe = FESolver()
        fe.addPolygon(rectangle((0, 0), (.008, .024)), size=2e-3, material=0, mesh=mesh)
        nodes.append(fe.nodes.copy())
    assert numpy.array_equal(nodes[0], nodes[1]) and nodes[0].shape != nodes[2].shape
