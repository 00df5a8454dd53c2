"""Bodies around an axis beside closed forms: cavities that expand, a punch, Hertz's sphere."""
import math

import numpy
import pytest
from yade import utils
from yadefrag import FEMat, PlasticFEMat, rectangle
from axis_scene import arc, BAR, body, O, POISSON, STEEL, untilTime, YOUNG
from fe_scene import ready

PLANE = YOUNG / (1 - POISSON**2)


# --- cavities in an ideally plastic body (Bishop, Hill and Mott 1945; Hill 1950, ch. V)

CAVITY, YIELD = 1e-3, 400e6  # m, Pa


def plasticCavity(growth, order):
    """Pressure (Pa) in a sphere (order n = 3) or a tube (2) in an infinite body, whose radius has grown by `growth`.

    The plastic front is at c with (c/a)ⁿ = N (1 − growth⁻ⁿ) + growth⁻ⁿ, N = E/(3 (1 − ν) Y) or √3 E/((5 − 4ν) Y). This
    counts the change of volume in the plastic zone and neglects squares of Y/E. p = 2Y'/n + 2Y' ln c/a, with Y' = Y or
    Y/√3. For a large growth this is the limit 2Y/3 (1 + ln N) or Y/√3 (1 + ln N).
    """
    shear = YIELD if order == 3 else YIELD / math.sqrt(3)
    factor = YOUNG / (3 * (1 - POISSON) * YIELD) if order == 3 else math.sqrt(3) * YOUNG / ((5 - 4 * POISSON) * YIELD)
    front = factor * (1 - growth**-order) + growth**-order
    return 2 * shear / order * (1 + math.log(front))


def cavity(order, part, step, growth=2.5, speed=20.):
    """Pressure over that of `plasticCavity`, in a body of 100 radii whose outer side absorbs waves. Triangles have
    `part` of their distance from the centre. The inertia of 20 m/s adds 3/2 ρv², .3 %."""
    far, high = 100 * CAVITY, .5 * CAVITY
    angles = numpy.linspace(math.pi / 2, 0, round(math.pi / 2 / part) + 1)
    outline = rectangle((CAVITY, 0), (far, high)) if order == 2 else \
        [(x, -y) for x, y in (*arc(far, angles), *arc(CAVITY, angles[::-1]))]
    distance = (lambda x, y: x) if order == 2 else (lambda x, y: math.hypot(x, y))
    fe = body(PlasticFEMat(**STEEL, yieldStress=YIELD), outline, lambda x, y: part * max(CAVITY, distance(x, y)),
              fixed=lambda x, y: 'y' if abs(y) < 1e-9 or order == 2 and y > high - 1e-9 else False)
    radii = fe.nodes[:, 0] if order == 2 else numpy.hypot(*fe.nodes.T)
    bore = numpy.flatnonzero(radii < 1.0001 * CAVITY)
    along = fe.nodes[bore] / radii[bore, None]
    fe.prescribe(bore, **{name: speed * along[:, i] for i, name in enumerate(('vx', 'vy')[:order - 1])})
    fe.absorb(numpy.flatnonzero(radii > far * math.cos(part / 2) * .9999))
    ready(fe, step)
    over = []
    while (now := 1 + speed * fe.time / CAVITY) < growth:
        O.run(20, True)
        if now > growth - .1:
            push = abs(fe.reaction(bore)[order - 2]) / (math.pi * (now * CAVITY)**2)
            over.append(push / plasticCavity(now, order) * (1 if order == 3 else now * CAVITY / (2 * high)))
    return numpy.mean(over)


@pytest.mark.parametrize('order, part, step', [(3, .15, .5), (3, .1, .5), (2, .1, .5), (2, .1, .25)])
def test_cavityExpandsAtThePressureOfHill(order, part, step):
    """Integrated along the radius, with all large strains, the exact pressure in the sphere is 1.0053 times Hill's.
    Measured +1.4, +.7 % of it, and +.5 % in the tube; +.8 % with triangles of .05."""
    assert cavity(order, part, step) == pytest.approx(1.0053 if order == 3 else 1, rel=.02)


# --- a rigid flat punch on an elastic half-space (Boussinesq 1885)

PUNCH, SUNK = .01, 1e-5  # m


def punchedForce(far, part, element='linear', step=.8):
    """Force of a rigid cylinder on a hemisphere of `far` radii whose outer side is held, over 2E/(1 − ν²) times its
    radius and its way; stress at the centre over F/(2π radius²). Triangles have a 40th of the radius at the punch's
    edge, and grow by `part` of the distance from it."""
    outline = [(0, 0), *arc(far * PUNCH, numpy.linspace(0, math.pi / 2, 12)), (PUNCH, 0)]
    fe = body(FEMat(**STEEL), outline, element=element, fixed=lambda x, y: math.hypot(x, y) > .98 * far * PUNCH,
              size=lambda x, y: min(PUNCH / 40 + part * math.hypot(x - PUNCH, y),
                                    part * max(PUNCH / 2, math.hypot(x, y))))
    duration = 6 * far * PUNCH / BAR
    fe.damping = 2 * BAR / (far * PUNCH)
    box = utils.box((0, PUNCH / 2, 0), (PUNCH, PUNCH / 2, PUNCH), fixed=True)
    O.bodies.append(box)
    box.state.vel = (0, -SUNK / duration, 0)
    ready(fe, step, moving=True)
    untilTime(fe, duration)
    box.state.vel = (0, 0, 0)
    way = PUNCH / 2 - box.state.pos[1]
    untilTime(fe, 1.5 * duration)
    assert fe.energy['kinetic'] < 1e-5 * fe.energy['strain']
    force = O.forces.f(box.id)[1]
    inside = numpy.hypot(*fe.nodes[fe.triangles].mean(axis=1).T) < .2 * PUNCH
    return force / (2 * PLANE * PUNCH * way), -fe.stress[inside, 1].mean() * 2 * math.pi * PUNCH**2 / force


@pytest.mark.parametrize('part, element, step, allowed', [
    (.2, 'smoothed', .8, .03), (.2, 'smoothed', .4, .03), (.1, 'linear', .8, .03), (.1, 'smoothed', .8, .01)])
def test_punchSinksAsByBoussinesq(part, element, step, allowed):
    """The compliance of the infinite body is found from two sizes: the rest of it falls with 1/far. The stress at the
    end of the punch is singular: 'linear' triangles are +1.5 %, with part = .2 +3.3 %."""
    (near, _), (wide, centre) = (punchedForce(far, part, element, step) for far in (10, 20))
    assert 1 / (2 / wide - 1 / near) == pytest.approx(1, abs=allowed)
    assert centre == pytest.approx(1, abs=.03)


# --- an elastic sphere on a rigid plane (Hertz 1882)

RADIUS = .01  # m


def pressedSphere(part, across, element='linear', step=.8):
    """Force, radius and largest pressure of a contact over Hertz's. Its radius is `part` of the sphere's, and has
    `across` triangles. Half of the sphere is modelled: its plane of symmetry moves by part² of the radius.

    By Hertz p² is linear in r². A line through the pressures at the nodes, without the first and the last one, gives p₀
    and the radius; they are compared with those of the force that is found."""
    wide = part * RADIUS
    size = lambda x, y: min(wide / across + .2 * max(0, math.hypot(x, y) - 1.5 * wide), RADIUS / 6)  # noqa: E731
    angles = [0.]
    while angles[-1] < math.pi / 2:
        x, y = arc(RADIUS, numpy.array(angles[-1:]))[0]
        angles.append(angles[-1] + size(x, y + RADIUS) / RADIUS)
    side = arc(RADIUS, numpy.array(angles) / angles[-1] * math.pi / 2) + (0, RADIUS)
    fe = body(FEMat(**STEEL), [*side, (0, RADIUS)], size, element=element)
    plane = numpy.flatnonzero(fe.nodes[:, 1] > RADIUS - 1e-9)
    duration, way = 8 * RADIUS / BAR, part**2 * RADIUS
    fe.prescribe(plane, vy=lambda x, y, t: -way / duration * math.pi / 2 * math.sin(math.pi * min(t / duration, 1)))
    fe.damping = 3 * BAR / RADIUS
    O.bodies.append(utils.wall((0, 0, 0), axis=1))
    ready(fe, step)
    untilTime(fe, 2 * duration)
    assert fe.energy['kinetic'] < 1e-5 * fe.energy['strain']
    force = fe.contactForces[:, 1].sum()
    assert fe.reaction(plane)[1] == pytest.approx(-force, rel=1e-3)
    touches = numpy.flatnonzero(fe.contactForces[:, 1] > 0)
    at, own = numpy.array(sorted(zip(fe.nodes[touches, 0], fe.contactForces[touches, 1]))).T
    gap = numpy.diff(at)
    inner, outer = gap * (2 * at[1:] + at[:-1]), gap * (2 * at[:-1] + at[1:])
    pressure = own[1:-1] / (math.pi / 3 * (inner[:-1] + outer[1:]))
    slope, top = numpy.polyfit(at[1:-1]**2, pressure**2, 1)
    hertz = (3 * force * RADIUS / (4 * PLANE))**(1 / 3)
    return (force / (4 / 3 * PLANE * math.sqrt(RADIUS) * way**1.5), math.sqrt(-top / slope) / hertz,
            math.sqrt(top) / (3 * force / (2 * math.pi * hertz**2)))


@pytest.mark.parametrize('across, element, step', [
    (10, 'linear', .8), (10, 'linear', .4), (10, 'smoothed', .8), (20, 'linear', .8)])
def test_sphereTouchesAsByHertz(across, element, step):
    """The force of the half-space is found from two loads: the sphere's size adds a part that falls with the radius of
    contact over that of the sphere, 2 and 4 % here. Measured +.5, +1.6, −1.7 %; 'smoothed' −1.1, +.4, −1.9 %."""
    small, large = (pressedSphere(part, across, element, step) for part in (.05, .1))
    assert 2 * small[0] - large[0] == pytest.approx(1, abs=.03)
    for found in (small, large):
        assert found[1:] == pytest.approx((1, 1), abs=.03)
