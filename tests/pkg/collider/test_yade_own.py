"""YADE's own check scripts, unit tests and shipped examples, with a collider put in the place of
YADE's (yade_scripts.py): the quick checks with the loop and the integrator, too; the collider alone, and all others, in
the long tests."""
import json
import os
import pathlib
import tempfile
from xml.etree import ElementTree

import pytest
import yade.config

import test_lifecycle
from project import inYade

kHere = pathlib.Path(__file__).resolve().parent
kExampleFolder = '/usr/share/doc/yade/examples'
kCheckFolder = os.path.join(os.path.dirname(yade.__file__), 'tests', 'checks')

# Not here: checkList.py runs the others; the MPI scripts start other programs;
# checkColliderConstantness.py reads the rival's sort lists (test_lifecycle.py stands for it);
# checkVTKRecorder.py compares interactions in the order of YADE's collider (testRecordedContacts stands for it);
# YADE itself skips checkCapillaryEngineStandalone.py, which fails with its own collider, and
# DEM-PFV-check.py, which fails with its own collider as soon as that searches in every step, and
# checkPolyhedraDrum.py.
kQuickChecks = [
    'checkBlockGen.py',
    'checkCapillaryModels.py', 'checkColliderCorrectness.py', 'checkFlipCell.py',
    'checkGravity.py', 'checkGravityRungeKuttaCashKarp54.py', 'checkHertzExtended.py',
    'checkLiquidMigration.py', 'checkLubrication.py', 'checkLubricationWithRoughness.py',
    'checkPolyhedraCrush.py', 'checkPotentialParticles.py', 'checkPotentialVTKRecorders.py',
    'checkTestTriax.py', 'checkViscElEng.py', 'checkViscElPM.py',
    'checkViscElPM2.py', 'checkWeight.py', 'checkWirePM.py',
    # of YADE 2025.2.0
    'checkCohesiveFrictionalLaw.py', 'checkKineticEnergy.py', 'checkMultiScGeom.py',
    'checkRotAlgorithmNonSpherical.py', 'checkSetPerm.py', 'checkTesselationWrapper.py',
    'checkViscElBC.py',
    # of YADE 2026.1.0
    'checkCoatingOfSegBodies.py', 'checkLS_DEM_viscoelastic.py', 'checkPeriodicThermalConduction.py',
    'checkPolyhedra_shearForce.py', 'checkShapeVolume.py']
kLongChecks = [
    'checkAlpha.py', 'checkAvoidSelfInteractionMask.py', 'checkClumpHopper.py', 'checkDEM-PFVPressureInjection.py',
    'checkFlipSpheres.py', 'checkJCFpm.py', 'checkLS_DEM.py', 'checkLS_DEM_pbc.py',
    'checkPotentialBlocks.py', 'checkSaveLoadClumps.py', 'checkTestDummy.py',
    'checkThermalEngine.py', 'check_TwoPhaseFlowEngine_PressureInjection.py',
    'checkbf_simple.py', 'checkbf_unixial_clump.py', 'colliderTorture.py']
# They do nothing in a YADE that is built without the feature, as those of Debian 13 and 14.
kNeeds = {
    'checkHertzExtended.py': 'CGAL', 'checkPolyhedraCrush.py': 'CGAL', 'checkPolyhedra_shearForce.py': 'CGAL',
    'checkTesselationWrapper.py': 'CGAL', 'checkPeriodicThermalConduction.py': 'THERMAL',
    'checkDEM-PFVPressureInjection.py': 'PFVFLOW', 'checkSetPerm.py': 'PFVFLOW',
    'checkThermalEngine.py': 'THERMAL', 'check_TwoPhaseFlowEngine_PressureInjection.py': 'TWOPHASEFLOW'}
# No collider runs in these; the last three need a feature that Debian's YADE is built without.
kNoCollider = {'checkAlpha.py', 'checkShapeVolume.py', 'checkTestDummy.py', 'checkPotentialBlocks.py',
               'checkBlockGen.py', 'checkLiquidMigration.py'}
# The collider is never among O.engines in a run: called by hand, or inside an integrator.
kNoRun = {'checkAvoidSelfInteractionMask.py', 'checkFlipCell.py', 'checkGravityRungeKuttaCashKarp54.py'}
kFoundChecks = {'checkTestTriax.py'}    # here the collider comes out of C++, not by name

kUnit = ['dummyTest', 'wrapper', 'core', 'pbc', 'clump', 'cohesive-chain', 'engines', 'utilsModule']
kUnitWithCollider = {'wrapper', 'core', 'cohesive-chain', 'engines', 'utilsModule'}

kResults = {}


def outcome(collider, kind, names):
    """{name: dict} as yade_scripts.py reports it; one process for all, another one for the rest
    if a script takes it down."""
    key = (collider, kind, *names)
    if key not in kResults:
        results, left = {}, list(names)
        while left:
            with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
                done = inYade(kHere / 'yade_scripts.py', collider, kind, *left, cwd=folder, timeout=400,
                              errors='replace')
            lines = [x[4:] for x in done.stdout.splitlines() if x.startswith('@@@ {')]
            results.update((r['name'], r) for r in map(json.loads, lines))
            left = [n for n in left if n not in results]
            if left:
                results[left.pop(0)] = dict(error=f'ended yade ({done.returncode}): {done.stdout[-1500:]}')
        kResults[key] = results
    return kResults[key]


def checkResult(collider, result):
    assert result['error'] is None, result['error']
    assert result['rivals'] == 0, "YADE's own collider was still there"


def reasonToSkip(script):
    if not os.path.exists(os.path.join(kCheckFolder, script)):
        return f'this YADE has no {script}'
    needed = kNeeds.get(script)
    return needed and needed not in yade.config.features and f'this YADE is built without {needed}'


def checked(script, scripts, collider):
    """What a check script has reported, which succeeds; the others of the list are run in the same process."""
    if why := reasonToSkip(script):
        pytest.skip(why)
    result = outcome(collider, 'checks', [x for x in scripts if not reasonToSkip(x)])[script]
    assert result['error'] is None, result['error']
    return result


@pytest.mark.long
@pytest.mark.parametrize('script', kQuickChecks + kLongChecks)
def testCheckScript(collider, script):
    result = checked(script, kQuickChecks + kLongChecks, collider.name)
    assert result['rivals'] == 0, "YADE's own collider was still there"
    if script not in kNoCollider:
        assert result['made'] + result['found'] > 0
        assert (result['runs'] > 0) != (script in kNoRun)
    if script in kFoundChecks:
        assert result['found'] > 0


@pytest.mark.parametrize('script', kQuickChecks)
def testCheckScriptWithLoopAndIntegrator(script):
    """The same with CurveLoop and CurveIntegrator in the place of YADE's, too."""
    result = checked(script, kQuickChecks, 'LebesgueCollider+all')
    if script not in {*kNoCollider, *kNoRun, *kFoundChecks}:
        assert result['loops'] == result['runs'] > 0


def recorded(maker, folder):
    """{array: values} of the contacts of the scene of YADE's checkVTKRecorder.py."""
    os.mkdir(folder)
    engine = test_lifecycle.build(maker, periodic=False)
    # As in the check; without multiblock, VTK's writer aborts with any collider.
    yade.wrapper.O.engines = yade.wrapper.O.engines + [yade.wrapper.VTKRecorder(
        fileName=folder + '/', recorders=['all'], firstIterRun=10, iterPeriod=2000, ascii=True, multiblock=True)]
    yade.wrapper.O.run(20, True)
    root = ElementTree.parse(f'{folder}/10/10_2.vtp').getroot()
    assert engine in yade.wrapper.O.engines
    return {a.get('Name'): [float(x) for x in a.text.split()] for a in root.iter('DataArray')}


def testRecordedContacts(collider, folder):
    """A recorder writes the same contacts, in whatever order."""
    ours, theirs = (recorded(m, os.path.join(folder, n)) for m, n in ((collider, 'ours'), (collider.rival, 'theirs')))
    assert ours.keys() == theirs.keys() and len(ours['forceN']) > 20
    for name, values in ours.items():
        assert sorted(values) == pytest.approx(sorted(theirs[name]), rel=1e-12, abs=1e-15), name


@pytest.mark.parametrize('module', kUnit)
def testUnit(collider, module):
    result = outcome(collider.name, 'unit', kUnit)[module]
    checkResult(collider, result)
    assert result['tests'] > 0
    if module in kUnitWithCollider:
        assert result['made'] > 0


kShortExamples = [
    'billiard.py', 'test/facet-sphere.py', 'test/clump.py',
    'test/facet-sphere-ViscElBasic-peri.py', 'PeriodicBoundaries/periodic-simple.py']
kLongExamples = [
    'PeriodicBoundaries/cellFlipping.py', 'PeriodicBoundaries/periodic-simple-shear.py',
    'PeriodicBoundaries/periodic-triax.py', 'PeriodicBoundaries/periodicSandPile.py', 'test/collider-stride-triax.py',
    'test/triax-basic-without-plots.py', 'timeStepperUsage.py']


@pytest.mark.skipif(not os.path.isdir(kExampleFolder), reason="YADE's examples are not installed")
@pytest.mark.parametrize('script', [*kShortExamples, *(pytest.param(e, marks=pytest.mark.long) for e in kLongExamples)])
def testExample(collider, script):
    """The contacts are those that YADE's collider has when it searches in every step.

    With its strides on it loses floor contacts in periodicSandPile.py and so is no yardstick."""
    every = [os.path.join(kExampleFolder, s) for s in (kLongExamples if script in kLongExamples else kShortExamples)]
    path = os.path.join(kExampleFolder, script)
    expected = outcome('InsertionSortCollider', 'reference', every)[path]
    assert expected['error'] is None, expected['error']
    result = outcome(collider.name, 'examples', every)[path]
    checkResult(collider, result)
    assert result['runs'] > 0
    compared = compareMoments(expected['moments'], result['moments'], result['radius'])
    assert compared > 0


def compareMoments(expected, found, radius):
    """Compares the contacts while positions agree to a millionth of a radius; how many it saw."""
    total = 0
    assert [m['step'] for m in expected] == [m['step'] for m in found]
    for a, b in zip(expected, found):
        missing, extra = (differences(x['contacts'], y['contacts'], 1e-5 * radius) for x, y in ((a, b), (b, a)))
        assert not missing and not extra, f'at step {a["step"]}'
        total += len(a['contacts'])
        if apart(a['positions'], b['positions']) > 1e-6 * radius:
            assert a['step'] >= 20, 'the runs parted at once'     # rounding takes longer
            break
    return total


def differences(these, others, depth):
    """Pairs that only `these` have, apart from those that barely touch (rounding)."""
    return {tuple(c[:2]) for c in these if c[2] is None or c[2] > depth} \
        - {tuple(c[:2]) for c in others}


def apart(these, others):
    assert len(these) == len(others)
    return max(abs(x - y) for p, q in zip(these, others) for x, y in zip(p, q))
