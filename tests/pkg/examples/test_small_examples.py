"""examples/small: each in a yade of its own, its figures beside those by hand; others: tests/validation/yade."""
import os

import pytest

from example_runs import figures, kSmall

kScenes = ('column', 'bending', 'drum', 'blast', 'glass', 'spheres_on_beam', 'crusher',
           'monte_carlo')


def test_columnCarriesItsWeight(folder):
    found = figures('column', folder)
    for k in range(5):
        below = 'floor' if k == 0 else 'block %d' % (k - 1)
        force, weight, sideways = found['block %d on %s' % (k, below)]
        assert weight == pytest.approx((5 - k) * 2500 * .01 * 9.81)
        assert force == pytest.approx(weight, rel=1e-4) and abs(sideways) < 1e-4 * weight
    assert found['reaction of the floor'][0] == pytest.approx(found['reaction of the floor'][1], rel=1e-4)


def test_beamBendsAsInTimoshenkosTheory(folder):
    """Eight triangles high: 1 %; what is left of the motion is 10⁻⁵ of the load."""
    found = figures('bending', folder)
    measured, theory = found['deflection']
    assert measured == pytest.approx(theory, rel=.01) and theory == pytest.approx(1.28825e-4, rel=1e-4)
    for side in ('left', 'right'):
        assert found['reaction ' + side] == [pytest.approx(500, rel=1e-4), 500]
    # Of the lowest triangles the middles are a twelfth of the height above the surface at most.
    tension = found['largest tension in a quarter of the span']
    assert .85 < tension[0] / tension[1] < 1.05


def test_drumStaysRoundForTenTurns(folder):
    found = figures('drum', folder)
    off, turns = found['radius']
    assert off < 1e-9 and turns == pytest.approx(10, rel=1e-3)
    assert found['places'][0] < 1e-9
    lean, farthest = found['stones lean by']
    assert 5 < lean < 60 and farthest < 1.001  # carried up on the side to which the wall goes, and inside
    work, friction, change = found['energy']
    assert 0 < friction < work and change < 2e-3


def test_crusherKeepsMomentum(folder):
    """The sums of YADE's forces × step and of masses × velocities: five of the six digits printed."""
    found = figures('crusher', folder)
    x, y, changeX, changeY = found['momentum']
    size = abs(x) + abs(y)
    assert size > .1 and abs(x - changeX) < 1e-5 * size and abs(y - changeY) < 1e-5 * size
    # More than a disc at rest between plates bears, which inertia and the second contact raise.
    largest, static = found['largest force']
    assert .7 * static < largest < 3 * static
    pieces, cracks, change = found['pieces']
    # 18 pieces: shear counts at the tips of cracks; with opening alone there are some 30.
    assert pieces > 10 and cracks > 100 and change < 1e-3


@pytest.mark.parametrize('name', kScenes)
def test_scriptsAreShort(name):
    with open(os.path.join(kSmall, name + '.py')) as script:
        assert len(script.read().splitlines()) < 60
    assert os.path.exists(os.path.join(kSmall, name + '.png'))
