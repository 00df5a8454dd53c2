"""Calls of all that is public, with values that are wrong: `yade -n -x api_calls.py SEED CALLS LOG`.

The callables are taken from the package: its functions, classes, their attributes and methods.
Each call must succeed, or be refused in a sentence and change nothing. LOG has the call that is
under way, and `FOUND` before a line for each that did neither.
"""
import builtins
import hashlib
import inspect
import os
import pathlib
import random
import re
import sys
import tempfile
import threading
import time
import types

kHere = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [kHere, os.path.join(kHere, '..', 'helpers')]

import api_values  # noqa: E402
import yadefrag  # noqa: E402
from yade import wrapper as w  # noqa: E402
from yadefrag.arguments import real, shown  # noqa: E402
from yadefrag.studies import ensemble_runs, scene_choices, tradeoff_grid, tradeoff_table  # noqa: E402

O = builtins.O
kLongest = 300  # characters of a sentence
# Those are the sentences' classes; OSError names a file; AttributeError is Python's for an attribute
# that is not there or cannot be set.
kRefusals = (ValueError, TypeError, RuntimeError, OSError, AttributeError)
kInternal = (r"object has no attribute|unsupported operand|not iterable|not subscriptable|not callable|"
             r"indices must be|cannot unpack|to unpack|has no len|out of range|not supported between|"
             r"truth value of")
kMoments = ('before', 'between', 'between', 'inside', 'thread', 'running')


def scene(moment):
    """Two bodies in contact, one that cracks, and spheres; returns the solver."""
    O.reset()
    O.materials.append(w.FEMat(young=1e7, poisson=.3, density=1000, frictionAngle=.2, label='m'))
    O.materials.append(w.BrittleFEMat(young=1e7, poisson=.3, density=1000, tensileStrength=1e4, label='b'))
    fe = w.FESolver()
    fe.addPolygon(yadefrag.rectangle((0, 0), (1, 1)), size=.5, material='m', velocity=(1, 0), name='first')
    fe.addPolygon(yadefrag.rectangle((1, 0), (2, 1)), size=.5, material='b', name='second')
    for x in range(3):
        body = w.Body()
        body.shape, body.material = w.Sphere(radius=.2), O.materials[0]
        body.state.pos, body.state.mass, body.state.inertia = (x, 1.2, 0), 1, (1, 1, 1)
        O.bodies.append(body)
    collider = w.LebesgueCollider([w.Bo1_Sphere_Aabb(), w.Bo1_SurfaceSegment_Aabb()])
    O.engines = [w.ForceResetter(), collider, w.InteractionLoop(
        [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Sphere_SurfaceSegment_ScGeom()], [w.Ip2_FrictMat_FrictMat_FrictPhys()],
        [w.Law2_ScGeom_FrictPhys_CundallStrack()]), fe, w.NewtonIntegrator()]
    O.dt = .5 * fe.criticalTimeStep()
    if moment != 'before':
        for _ in range(3):
            O.step()
    return fe


def state(fe):
    """A hash of all that a refused call must leave as it was."""
    digest = hashlib.sha256()
    for array in (fe.nodes, fe.velocities, fe.triangles, fe.loads, fe._reference, fe.components, fe.masses,
                  fe.fragmentOf, fe.contactForces, *fe.surfaces):
        digest.update(array.tobytes())
    bodies = [b and (tuple(b.state.pos), tuple(b.state.vel), repr(b.shape.dict()), b.groupMask) for b in O.bodies]
    engines = [(type(e).__name__, repr({n: v for n, v in e.dict().items() if ' at 0x' not in repr(v)}))
               for e in O.engines if not isinstance(e, w.PyRunner)]
    materials = [repr(m.dict()) for m in O.materials]
    digest.update(repr((fe.energy, fe.warnings, fe.dropped, fe.numSearches, bodies, engines, materials,
                        O.dt, O.iter, len(O.interactions))).encode())
    return digest.hexdigest()


# --- what can be called

def exampleFiles(folder):
    table = yadefrag.TradeoffTable([tradeoff_table.TradeoffRow({'k': 1}, 'ok', 1., 1., .1, .1, 10, [1.], [1.]),
                                    tradeoff_table.TradeoffRow({'k': 2}, 'ok', 2., 2., .01, .1, 10, [2.], [2.])])
    table.csv(folder + '/table.csv')
    for name, text in (('plate', '0 0\n1 0\n1 1\n'), ('plate.csv', '0, 0\n1, 0\n1, 1\n'),
                       ('mesh.inp', '*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n')):
        pathlib.Path(folder, name).write_text(text)
    return table


def right(fe, folder):
    """For each function the arguments of a call that succeeds."""
    square = yadefrag.rectangle((5, 5), (6, 6))
    csv = folder + '/run.csv'
    yadefrag.recordFracture(fe, csv)
    job = dict(scene=trialScene, vary={'passes': [1]}, measure=trialMeasure, duration=1., repeats=1)
    return dict(
        rectangle=dict(low=(0, 0), high=(1, 1)), circle=dict(centre=(0, 0), radius=1, n=8),
        ring=dict(centre=(0, 0), inner=1, outer=2, n=8), readPolygon=dict(file=folder + '/plate'),
        readOutline=dict(file=folder + '/plate.csv', tolerance=None, scale=1., gap=1e-6, simplify=1e-3, leastArea=0.),
        readMesh=dict(file=folder + '/mesh.inp', scale=1.),
        outlineReport=dict(outline=square, holes=(), size=.5, material='b', simplify=.01),
        voronoi=dict(outline=square, n=3, seed=1, rounds=1, shortest=.01), grainJoints=dict(grains=[square, square[::-1]]),
        snapOutlines=dict(shapes=[square, square[::-1]], tolerance=1e-3),
        polygonMesh=dict(outline=square, holes=(), size=.5, mesh='regular', meshSeed=1, smooth=False, simplify=.1,
                         joints=[((5.2, 5.2), (5.8, 5.7))], jointTolerance=.01),
        rectangleMesh=dict(low=(0, 0), high=(1, 1), nx=2, ny=2, crossed=False),
        plotMesh=dict(fe=fe, field='mises', file=folder + '/a.png', ax=None, limits=(0, 1), xlim=(0, 3), ylim=(0, 2.), spheres=True),
        animate=dict(fe=fe, file=folder + '/a.gif', steps=1, every=1, field=None, limits=None, window=None,
                     rate=20),
        exportVTK=dict(fe=fe, file=folder + '/a.vtu', fields=['stress', 'velocity']), runSteps=dict(steps=2, every=1, call=lambda: None),
        fragmentTable=dict(fe=fe, file=folder + '/b.csv'),
        plotFragmentSizes=dict(fe=fe, file=folder + '/c.png', ax=None, components=[0, 1]),
        recordFracture=dict(fe=fe, file=csv, append=True), plotFracture=dict(file=csv, picture=None),
        tradeoff=dict(job, reference=0., watch=None, every=0., limit=60., files=folder + '/t', title='', executor=None, resume=None),
        ensemble=dict(scene=trialScene, runs=[1, 2], measure=trialMeasure, duration=1., watch=None, every=0., limit=60.,
                      executor=None, workers=1, resume=folder + '/done.jsonl', files=None, title=''),
        addPolygon=dict(outline=square, holes=(), size=.5, material='b', smooth=False, velocity=(0, 0), spin=0,
                        displacement=None, fixed=None, thickness=1, selfContact=True, simplify=.1,
                        strength=lambda x, y: 1e4, fractureEnergy=lambda x, y: 0., name='new', snap=.01,
                        joints=[((5.2, 5.2), (5.8, 5.7))], jointStrength=[0.], jointEnergy=1.),
        addMesh=dict(mesh=yadefrag.rectangleMesh((5, 5), (6, 6), 1, 1), material='b', smooth=None, velocity=(0, 0), spin=0,
                     displacement=None, stress=(0, 0, 0), fixed=None, thickness=1, strength=[1e4, 1e4], element='linear'),
        addTriangles=dict(nodes=[(5, 5), (6, 5), (6, 6)], triangles=[(0, 1, 2)], material='b', smooth=False,
                          velocity=(0, 0), spin=0, displacement=None, fixed=None, thickness=1,
                          selfContact=True, strength=[1e4], fractureEnergy=[0.]),
        bond=dict(a=0, b=1, strength=1e6, energy=1e3), bondAll=dict(tolerance=1e-3, strength=1e6, energy=1e3),
        prescribe=dict(nodes=[0], vx=[(0, 0.), (1, 1.)], vy=None), removeBody=dict(component=0), fragments=dict(held=False),
        about=dict(show=str), inCurveOrder=dict(bodies=[(0, 0, 0), ((1, 1, 0), .5)]),
        crackTable=dict(fe=fe, file=folder + '/d.csv'), engines=dict(fe=fe, gravity=(0, -1), spheres=True),
        FERecorder=dict(iterPeriod=5, file=folder + '/e', fields=['stress']),
        rotate=dict(nodes=0, omega=[(0, 0), (1, 2.)], centre=(0, 0)), nodesOf=dict(component=0),
        pressure=dict(nodes=lambda x, y: x < .1, p=[(0, 1.), (1, 2.)]), absorb=dict(nodes=lambda x, y: x < .1),
        relax=dict(tolerance=1e9, most=30), reaction=dict(nodes=[0]), contactForce=dict(a=0, b=1),
        updateAttrs=dict(attributes={'label': 'x'}))


def trialScene(_):
    """Never run here: tradeoff's runs are left out."""


def trialMeasure(_):
    """Likewise."""


def ownFunctions():
    return [name for name in yadefrag.__all__ if inspect.isfunction(getattr(yadefrag, name))]


def ownClasses():
    return [getattr(yadefrag, name) for name in yadefrag.__all__ if inspect.isclass(getattr(yadefrag, name))]


def settable(cls):
    return [name for name, value in inspect.getmembers(cls) if isinstance(value, property) and value.fset is not None]


def presets(cls):
    """What the attributes of a new object are."""
    return cls().dict() if issubclass(cls, w.Serializable) else {}


def methods(cls):
    return [name for name, value in inspect.getmembers(cls) if callable(value) and not name.startswith('_')]


def targets(fe, table):
    """Live objects of all classes."""
    pieces = [b.shape for b in O.bodies if b and isinstance(b.shape, w.SurfaceSegment)]
    return [fe, fe, fe, O.engines[1], O.materials[0], O.materials[1], pieces[0], pieces[-1],
            w.Bo1_SurfaceSegment_Aabb(), w.Ig2_Sphere_SurfaceSegment_ScGeom(), w.HierarchyCollider(),
            w.LinearCodeCollider(), table, scene_choices.Choices({'passes': 1})]


# --- one call

class Call:
    """A drawn call: what it is as text, and the function that does it."""

    def __init__(self, draw, fe, folder, table):
        self.draw, self.fe, self.folder, self.table = draw, fe, folder, table
        # Not all kinds are as rich.
        kind = draw.choice([self.ofFunction, self.ofFunction, self.ofMethod, self.ofAttribute, self.ofClass])
        self.mayStep = False  # it runs the scene before a function of the script is called
        self.text, self.function = kind()

    def wrong(self, right=None):
        if self.draw.random() < .6:
            return api_values.alike(self.draw, self.fe, right)
        return api_values.anything(self.draw, self.fe)

    def spoilt(self, known):
        """Of right arguments one or two replaced, left out or added."""
        args = dict(known)
        for _ in range(self.draw.choice([1, 1, 1, 2])):
            if not args or self.draw.random() < .02:
                args[self.draw.choice(['nope', 'fe', 'size'])] = self.wrong()
                continue
            name = self.draw.choice(list(args))
            if self.draw.random() < .05:
                del args[name]
            else:
                args[name] = self.wrong(known.get(name))
        return args

    def withKeywords(self, name, function, known):
        args = self.spoilt(known)
        for many in ('steps', 'every', 'repeats', 'most'):  # right, but for ever
            if (real(args.get(many)) or 0) > 100:
                args[many] = 10**400
        self.mayStep = callable(args.get('call')) or name.endswith('relax')
        return '%s(%s)' % (name, ', '.join('%s=%s' % (n, shown(v)) for n, v in args.items())), \
            lambda: function(**args)

    def ofFunction(self):
        name = self.draw.choice(ownFunctions() + ['addPolygon', 'addMesh', 'addTriangles', 'bond', 'bondAll', 'prescribe', 'rotate', 'pressure', 'absorb'])
        function = getattr(yadefrag, name, None) or getattr(self.fe, name)
        return self.withKeywords(name, function, right(self.fe, self.folder)[name])

    def ofMethod(self):
        target = self.draw.choice(targets(self.fe, self.table))
        name = self.draw.choice(methods(type(target)))
        known = right(self.fe, self.folder)
        label = '%s.%s' % (type(target).__name__, name)
        if name in known:
            return self.withKeywords(label, getattr(target, name), known[name])
        args = [self.wrong() for _ in range(self.draw.choice([0, 1, 1, 2, 3]))]
        return '%s(%s)' % (label, ', '.join(map(shown, args))), lambda: getattr(target, name)(*args)

    def ofAttribute(self):
        target = self.draw.choice(targets(self.fe, self.table)[:11])
        name = self.draw.choice(settable(type(target)))
        value = self.wrong(getattr(target, name))
        return '%s.%s = %s' % (type(target).__name__, name, shown(value)), lambda: setattr(target, name, value)

    def ofClass(self):
        cls = self.draw.choice(ownClasses() + [scene_choices.Choices])
        names = list(presets(cls)) or ['rows', 'title', 'settings']
        args = {}
        for name in self.draw.choices(names, k=self.draw.choice([0, 1, 2])):
            args[name] = self.wrong(presets(cls).get(name))
        listed = [self.wrong() for _ in range(self.draw.choice([0, 0, 1, 2]))]
        return '%s(*%s, **%s)' % (cls.__name__, shown(listed), shown(args)), lambda: cls(*listed, **args)


# --- moments

def atOnce(call):
    try:
        call()
        return None
    except BaseException as error:  # judged below
        return error


def inThread(call):
    """Another thread calls, as this one waits."""
    answers = []
    thread = threading.Thread(target=lambda: answers.append(atOnce(call)))
    thread.start()
    thread.join()
    return answers[0]


def insideStep(call):
    """A PyRunner calls."""
    answers = []
    builtins.apiCall = lambda: answers.append(atOnce(call)) if not answers else None
    O.engines = O.engines + [w.PyRunner(command='apiCall()', iterPeriod=1, initRun=True)]
    try:
        O.step()
    except Exception as error:
        return error
    return answers[0] if answers else None


def whileRunning(call):
    O.run()
    try:
        return atOnce(call)
    finally:
        O.pause()
        try:
            O.wait()
        except Exception:  # the run may have been stopped by the call
            pass
        # YADE's O.wait() does not wait for the step that is under way after O.pause().
        for _ in range(500):
            time.sleep(.01)
            if O.subStep < 0:
                break


kHow = dict(before=atOnce, between=atOnce, inside=insideStep, thread=inThread, running=whileRunning)


def whatIsWrong(error):
    """'' for an answer that may be given."""
    if error is None or isinstance(error, api_values.FromScript):
        return ''
    if not isinstance(error, kRefusals):
        return 'it raised %s' % type(error).__name__
    text = str(error)
    # Python's own complaints of code that took a wrong value for a right one are no sentences.
    if re.search(kInternal, text):
        return 'Python itself complained'
    if len(text) > kLongest:
        return 'the sentence has %d characters' % len(text)
    if not text.strip():
        return 'there is no sentence'
    return ''


def answer(error):
    return '%s: %s' % (type(error).__name__, ' '.join(str(error).split()))


def main(seed, calls, logName):
    draw = random.Random(int(seed))
    tradeoff_grid._runAll = ensemble_runs._run = lambda *_: None
    counts = types.SimpleNamespace(done=0, refused=0)
    with open(logName, 'w', errors='backslashreplace') as log, tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        table = exampleFiles(folder)
        fe = None
        for number in range(int(calls)):
            moment = draw.choice(kMoments)
            if fe is None or number % 10 == 0:
                fe = scene(moment)
            call = Call(draw, fe, folder, table)
            log.write('%d %s: %s\n' % (number, moment, call.text))
            log.flush()
            before = state(fe)
            error = kHow[moment](call.function)
            wrong = whatIsWrong(error)
            log.write('    %s\n' % ('ok' if error is None else answer(error)[:200]))
            if error is None:
                counts.done += 1
            else:
                counts.refused += 1
            isPaused = moment in ('before', 'between', 'thread') and not call.mayStep
            if isPaused and error is not None and not wrong and state(fe) != before:
                wrong = 'the scene changed'
            if wrong:
                log.write('FOUND %s; %s\n' % (wrong, answer(error)[:600]))
            # What a call has left behind must be a scene that steps, or reports why it does not.
            if draw.random() < (.1 if error else .7):
                log.write('%d a step\n' % number)
                log.flush()
                wrong = whatIsWrong(atOnce(O.step))
                if wrong:
                    log.write('FOUND %s in the step after\n' % wrong)
            if error is None or not isPaused:
                fe = None
        log.write('END %d succeeded, %d refused\n' % (counts.done, counts.refused))
    O.reset()
    os.chdir('/')


if __name__ == '__main__':
    main(*sys.argv[1:])
