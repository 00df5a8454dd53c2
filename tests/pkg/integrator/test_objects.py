"""Objects of YADE, and what a script may do with them: with CurveLoop and CurveIntegrator every bit is that of
YADE's engines, objects of a script's own classes and those that it keeps stay in the scene, and a run goes on where
YADE's does."""
import gc
import operator
import os

import numpy as np
import pytest
import yade.wrapper as w
import yadefrag  # noqa: F401  adds CurveLoop
from yade import utils
from yade.minieigenHP import Vector3

import scenes
from scenes import O, state


class Grain(w.Body):
    def volume(self):
        return self.shape.radius ** 3


class Tracked(w.State):
    def speed(self):
        return self.vel.norm()


class Ball(w.Sphere):
    def area(self):
        return self.radius ** 2


class Bond(w.FrictPhys):
    def isPulled(self):
        return self.kn < 0


def fresh(cls, former):
    made = cls()
    for name in 'mass', 'inertia', 'pos', 'vel', 'angVel', 'refPos', 'ori':
        setattr(made, name, getattr(former, name))
    return made


def properties(cls, former, factor=1.):
    return cls(kn=former.kn * factor, ks=former.ks, tangensOfFrictionAngle=former.tangensOfFrictionAngle)


def here(number, name):
    """What the scene has: of a body, or of a contact of two."""
    owner = O.interactions[number] if isinstance(number, tuple) else O.bodies[number]
    return operator.attrgetter(name)(owner) if name else owner


class Script:
    """What a script does: `draw` chooses the objects, `kept` has those that it keeps and where they belong, `places`
    where those of its own classes are, `physics` what it has made: the last reference to it may not end in O.run,
    without Python's lock (YADE's loop ends the process)."""

    def __init__(self, seed):
        self.draw = np.random.default_rng(seed)
        self.kept, self.places, self.physics = [], [], []

    def body(self):
        found = None
        while found is None:
            found = O.bodies[int(self.draw.integers(len(O.bodies)))]
        return found

    def lonely(self):
        """A body whose contacts are potential."""
        for _ in range(200):
            body = self.body()
            if not any(i.isReal for i in body.intrs()):
                return body
        pytest.skip('no such body')

    def contact(self):
        real = list(O.interactions)
        return real[int(self.draw.integers(len(real)))]

    def keep(self, number, name=''):
        self.kept.append((number, name, here(number, name)))

    def keepOfContact(self, name=''):
        contact = self.contact()
        self.keep((contact.id1, contact.id2), name)

    def ownClass(self, cls, make, owner, name):
        setattr(owner, name, make)
        self.places.append((owner.id, name, cls))

    def newPhysics(self, cls, factor=1.):
        contact = self.contact()
        self.physics.append(properties(cls, contact.phys, factor))
        contact.phys = self.physics[-1]
        if cls is Bond:
            self.places.append(((contact.id1, contact.id2), 'phys', cls))

    def append(self, cls=w.Body, number=None):
        body = utils.sphere(Vector3(*self.draw.uniform(2, 5, 2), 30 + .5 * len(O.bodies) % 7), .5)
        if cls is not w.Body:
            other = cls()
            other.shape, other.material, other.state = body.shape, body.material, fresh(w.State, body.state)
            body = other
        body.state.vel = (0, 0, -9)
        return O.bodies.append(body) if number is None else O.bodies.insertAtId(body, number)

    def reuse(self):
        number = self.body().id
        O.bodies.erase(number)
        self.append(number=number)

    def clump(self):
        a, b = (x for x in (self.lonely(), self.lonely()))
        if a.id != b.id and a.isStandalone and b.isStandalone:
            O.bodies.clump([a.id, b.id])

    def touch(self):
        """A contact of two bodies, however far they are."""
        a, b = self.body().id, self.body().id
        if a != b and not (O.interactions.has(a, b) and O.interactions[a, b].isReal):
            utils.createInteraction(a, b)

    def engine(self, cls, make):
        O.engines = [make(e) if isinstance(e, cls) else e for e in O.engines]

    def again(self):
        O.saveTmp('here', quiet=True)
        O.loadTmp('here', quiet=True)


def loopLike(old):
    return type(old)(old.geomDispatcher.functors, old.physDispatcher.functors, old.lawDispatcher.functors)


ACTIONS = {
    'shape None': lambda s: setattr(s.lonely(), 'shape', None),
    'shape replaced': lambda s: setattr(s.body(), 'shape', w.Sphere(radius=.48)),
    'shape of a class': lambda s: (b := s.body()) and setattr(b, 'shape', Ball(radius=.49)),
    'shape kept': lambda s: s.keep(s.body().id, 'shape'),
    'shape resized': lambda s: setattr(s.body().shape or w.Sphere(), 'radius', .47),
    'state replaced': lambda s: (b := s.body()) and setattr(b, 'state', fresh(w.State, b.state)),
    'state of a class': lambda s: (b := s.body()) and s.ownClass(Tracked, fresh(Tracked, b.state), b, 'state'),
    'state kept': lambda s: s.keep(s.body().id, 'state'),
    'state with an attribute': lambda s: setattr(s.body().state, 'remark', 3),
    'material replaced': lambda s: setattr(s.body(), 'material', w.FrictMat(young=2e7, density=2000)),
    'bound kept': lambda s: s.keep(s.body().id, 'bound'),
    'body erased': lambda s: O.bodies.erase(s.body().id),
    'body kept': lambda s: s.keep(s.body().id),
    'body kept and erased': lambda s: (b := s.body()) and s.keep(b.id) or O.bodies.erase(b.id),
    'body appended': lambda s: s.append(),
    'body of a class': lambda s: s.places.append((s.append(Grain), '', Grain)),
    'body with an attribute': lambda s: setattr(s.body(), 'remark', 4),
    'id used again': lambda s: s.reuse(),
    'clump': lambda s: s.clump(),
    'fixed': lambda s: setattr(s.body(), 'dynamic', False),
    'moved': lambda s: setattr(s.body().state, 'pos', s.body().state.pos + Vector3(0, 0, .01)),
    'geometry None': lambda s: setattr(s.contact(), 'geom', None),
    'physics None': lambda s: setattr(s.contact(), 'phys', None),
    'geometry kept': lambda s: s.keepOfContact('geom'),
    'physics kept': lambda s: s.keepOfContact('phys'),
    'physics replaced': lambda s: s.newPhysics(w.FrictPhys, 1.1),
    'physics of a class': lambda s: s.newPhysics(Bond),
    'contact kept': lambda s: s.keepOfContact(),
    'contact erased': lambda s: (c := s.contact()) and O.interactions.erase(c.id1, c.id2),
    'contacts cleared': lambda s: O.interactions.clear(),
    'potential contacts erased': lambda s: O.interactions.eraseNonReal(),
    'new collider': lambda s: s.engine(w.Collider, lambda e: type(e)([w.Bo1_Sphere_Aabb()])),
    'new loop': lambda s: s.engine(w.InteractionLoop, loopLike),
    'new integrator': lambda s: s.engine(w.NewtonIntegrator, lambda e: type(e)(damping=e.damping, gravity=e.gravity)),
    'saved and loaded': lambda s: s.again(),
    'other scene': lambda s: (O.switchScene(), O.switchScene()),
    'forces for ever': lambda s: (b := s.body()) and (O.forces.setPermF(b.id, (3000, 0, 9000)),
                                                      O.forces.setPermT(b.id, (300, 500, 900))),
    'aspherical': lambda s: setattr(s.lonely(), 'aspherical', True),
    'other mask': lambda s: setattr(s.body(), 'mask', 3),
    'spinning': lambda s: setattr(s.body().state, 'angVel', (50, 0, 9)),
    'gravity and damping': lambda s: (setattr(O.engines[-1], 'gravity', (0, 0, 5)), setattr(O.engines[-1], 'damping', .3)),
    'shorter step': lambda s: setattr(O, 'dt', .5 * O.dt),
    'stiffer contacts': lambda s: [setattr(c.phys, 'kn', 1.5 * c.phys.kn) for c in O.interactions],
    'contact made': lambda s: s.touch(),
}
KINDS = {'rows': (6, 0), 'in place': (6, 900), 'moved in memory': (14, 0)}


def engines(ours, collider):
    loop, integrator = (w.CurveLoop, w.CurveIntegrator) if ours else (w.InteractionLoop, w.NewtonIntegrator)
    O.engines = [w.ForceResetter(), scenes.makeCollider(collider, [w.Bo1_Sphere_Aabb()]),
                 loop([w.Ig2_Sphere_Sphere_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
                      [w.Law2_ScGeom_FrictPhys_CundallStrack()]), integrator(damping=.1, gravity=(0, 0, -10))]
    O.dt = 2e-4


def build(ours, kind, collider):
    side, others = KINDS[kind]
    scenes.clear()
    chance = np.random.default_rng(3)
    O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    places = np.array(list(np.ndindex(side, side, side))) * .985 + chance.uniform(-.02, .02, (side ** 3, 3))
    chance.shuffle(places)
    scenes.addSpheres(places, [.5] * len(places), chance.normal(0, 2, (len(places), 3)), dynamic=True)
    # With few contacts per body the loop reads bodies in place.
    for number in range(others):
        O.bodies.append(utils.sphere((100 + 3 * (number % 30), 3 * (number // 30), 0), 1, fixed=True))
    engines(ours, collider)


def run(ours, kind, collider, actions, seed):
    """States after each action; asserts that objects of a script are still those of the scene."""
    build(ours, kind, collider)
    script, found = Script(seed), []
    O.run(3, True)
    for name in actions:
        ACTIONS[name](script)
        gc.collect()
        O.run(35, True)
        found.append(state())
        if name == actions[1] == 'moved' and 'erased' not in actions[0]:
            assert all(thing == here(*place) for *place, thing in script.kept)
        for number, attribute, cls in script.places:
            if attribute == 'phys':
                if not O.interactions.has(*number) or not O.interactions[number].isReal:
                    continue
                thing = O.interactions[number].phys
            else:
                body = O.bodies[number] if number < len(O.bodies) else None
                if body is None:
                    continue
                thing = body.state if attribute else body
            isOwn = type(thing) is cls
            assert isOwn or name in ('saved and loaded', 'state replaced', 'id used again'), (name, cls)
            if not isOwn:
                script.places.remove((number, attribute, cls))
    return found


def requireSame(*arguments):
    expected, found = run(False, *arguments), run(True, *arguments)
    assert [a == b for a, b in zip(expected, found)] == [True] * len(expected)


@pytest.mark.parametrize('kind', ['rows', *(pytest.param(kind, marks=pytest.mark.long) for kind in list(KINDS)[1:])])
@pytest.mark.parametrize('name', ACTIONS)
def test_oneAction(name, kind):
    requireSame(kind, 'InsertionSortCollider', [name, 'moved', name], 1)


@pytest.mark.long
@pytest.mark.parametrize('seed', range(12))
def test_severalActions(seed):
    draw = np.random.default_rng(seed)
    actions = [str(name) for name in draw.choice(list(ACTIONS), 6)]
    requireSame(list(KINDS)[seed % 3], ['LebesgueCollider', 'InsertionSortCollider'][seed % 2], actions, seed)


@pytest.mark.parametrize('kind', KINDS)
def test_noBodies(kind):
    """Interactions that are left of bodies that were cleared."""
    build(True, kind, 'InsertionSortCollider')
    O.run(3, True)
    O.bodies.clear()
    O.engines = O.engines[:1] + O.engines[2:]
    O.run(3, True)
    assert O.interactions.countReal() == 0


@pytest.mark.parametrize('kind', ['rows', 'in place'])
@pytest.mark.parametrize('shape', [None, w.Box(extents=(.5, .5, .5)), w.Facet(), w.Wall()], ids=str)
def test_aTakenShapeEndsContacts(shape, kind):
    """YADE's loop ends the process, or computes with the functor of the former shape."""
    build(True, kind, 'InsertionSortCollider')
    O.run(3, True)
    body = max((b for b in O.bodies), key=lambda b: sum(i.isReal for i in b.intrs()))
    assert any(i.isReal for i in body.intrs())
    body.shape = shape
    O.run(2, True)
    assert not any(i.isReal for i in body.intrs())
    O.run(40, True)
    assert np.isfinite([b.state.pos for b in O.bodies]).all() and O.interactions.countReal() > 50


def test_objectsOfAScriptStayWhenOthersAreMovedInMemory():
    """Bodies and states that a script has made and refers to, or has given attributes of its own."""
    scenes.clear()
    O.materials.append(w.FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.4))
    states, kept = {}, {}
    for number, place in enumerate(np.array(list(np.ndindex(14, 14, 14))) * .97):
        ball = utils.sphere(Vector3(*place), .5)
        if number % 500 == 7:
            ball.state = states[number] = fresh(w.State, ball.state)
        if number % 500 == 8:
            kept[number] = ball
        if number % 500 == 9:
            ball.state.remark = ball.remark = number
        O.bodies.append(ball)
    del ball
    engines(True, 'LebesgueCollider')
    O.run(300, True)
    assert O.engines[-1].fastBodies == number + 1 and len(states) == len(kept) == 6
    for number, one in states.items():
        assert one.pos == O.bodies[number].state.pos != one.refPos
        assert O.bodies[number + 2].remark == O.bodies[number + 2].state.remark == number + 2
    for number, ball in kept.items():
        assert ball.state.vel == O.bodies[number].state.vel
        ball.state.vel = (1, 2, 3)
        assert tuple(O.bodies[number].state.vel) == (1, 2, 3)


def test_propertiesOfAScriptAreTheScenesAndOutliveIt():
    build(True, 'moved in memory', 'LebesgueCollider')
    O.run(3, True)
    made = {}
    for contact in list(O.interactions)[::200]:
        contact.phys = made[contact.id1, contact.id2] = properties(w.FrictPhys, contact.phys)
    del contact
    O.run(100, True)
    lasting = [ids for ids in made if O.interactions.has(*ids) and O.interactions[ids].isReal
               and O.interactions[ids].iterMadeReal < 3]  # the others have ended, and begun anew
    assert len(lasting) > 5
    for ids in lasting:
        made[ids].kn = 0
        assert O.interactions[ids].phys.kn == 0
    former = [made[ids].normalForce for ids in lasting]
    O.reset()
    assert [made[ids].normalForce for ids in lasting] == former


def test_thePageHasTheExceptions():
    """docs/colliders.md, of the same bits: where the test of each is."""
    from project import ROOT
    with open(os.path.join(ROOT, 'docs', 'colliders.md')) as page:
        table = page.read().partition('| exception | what it changes |')[2].partition('\n\n')[0]
    assert [line.split('|')[1].strip() for line in table.splitlines()[2:]] == [
        'several threads, with laws of YADE',                      # test_lifecycle.py
        'a law that adds forces to bodies without a contact of its own, as for grids, beside forces of `CurveLoop`',
        'a law that moves bodies, as none of YADE\'s for spheres does',
        'a shape that a script takes from a body in contact, or replaces by one of another class',  # above
        'no functor for a contact or its materials']               # test_missingFunctorsAreReported
