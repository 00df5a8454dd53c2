"""What a scene does not use costs nothing, in instructions counted by callgrind: at most 1 %.

The bytes are in tests/step/unused_test.cpp; scripts/bench unused makes a table of both.
"""
import os
import sys

import pytest

import yadefrag
from project import ROOT

# Last: its modules have names that this folder has, too.
sys.path.append(str(ROOT / 'tests' / 'benchmark'))
import unused  # noqa: E402

kTests = os.path.join(os.path.dirname(yadefrag.__file__), '..', '..', 'tests')
kProgram = os.path.join(kTests, 'yadefrag_unused')
kCounting = os.path.join(kTests, 'yadefrag_counting.so')
kMost = .01

pytestmark = pytest.mark.skipif(not os.path.exists(kProgram) or not os.path.exists(kCounting),
                                reason='needs yadefrag_unused and yadefrag_counting, which scripts/build makes')


@pytest.fixture(scope='module')
def rings(tmp_path_factory):
    return unused.unusedShares(kProgram, str(tmp_path_factory.mktemp('rings')))


@pytest.mark.parametrize('feature', unused.features())
def testFeatureThatIsNotUsedTakesNoTime(rings, feature):
    shares, printed = rings
    assert printed['rows'] > 100 and printed['searches'] > 2      # contact and search are there
    assert shares[feature] <= kMost


@pytest.mark.parametrize('feature', ['fracture', 'friction', 'smooth', 'viscosity', 'loads'])
def testFeatureThatIsUsedIsSeen(folder, feature):
    """The pattern of a feature's code finds what it costs: the test above can fail."""
    _, costs = unused.counted(kProgram, folder, 'rings', 4, 10, feature)
    assert unused.features()[feature].share(costs) > .3 * kMost


@pytest.mark.parametrize('scene', unused.FAR)
def testBodiesThatAreNeverNearTakeNoContact(folder, scene):
    assert unused.farShare(kProgram, folder, scene) <= kMost


def testBodiesThatAreNearTakeContact(folder):
    """The pattern of contact's code finds it: the test above can fail."""
    _, costs = unused.counted(kProgram, folder, 'rings', 4, 10)
    assert unused.contactCode().share(costs) > 10 * kMost


def testSpheresDoNotPayForThePlugin(folder):
    costs, printed = unused.countSpheres(kCounting, folder, 200, 30)
    assert [row['way'] for row in printed] == ['absent', *unused.WAYS] and printed[0]['real'] > 50
    # Boost.Python searches every module in each call from Python: nothing to do with the step.
    ours = {cost.function for cost in costs['imported'] if cost.object.endswith('_yadefrag.so')}
    assert all('translate_exception' in name for name in ours), ours
    absent, imported, used = map(unused.byObject, costs.values())
    assert imported['_yadefrag.so'] < 1e-4 * sum(imported.values())
    for library in ('libyade.so', 'libpkg_dem.so'):
        assert imported[library] == absent[library] > 0
    assert abs(sum(imported.values()) / sum(absent.values()) - 1) <= kMost
    # The collider is independent of finite elements.
    assert not {cost.function for cost in costs['used'] if any(
        name in cost.function for name in ('FESolver', 'EntryBodies', 'World', 'ContactSurfaces'))}


def testAddingABodyDoesNotGoThroughAllOthers(folder):
    """But for a look whether their bodies are still there."""
    assert unused.addingPerEntry(kCounting, folder) < 100
