"""Calls of all that is public, with values that are wrong: `yade -n -x api_calls.py SEED CALLS LOG`.

The callables are taken from the package: its functions, classes, their attributes and methods.
Each call must succeed, or be refused in a sentence and change nothing. LOG has the call that is
under way, and `FOUND` before a line for each that did neither.
"""
import builtins
import concurrent.futures
import hashlib
import inspect
import os
import pathlib
import random
import re
import sys
import tempfile
import time

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

def exampleFiles(fe, folder):
    yadefrag.recordFracture(fe, folder + '/run.csv')
    table = yadefrag.TradeoffTable([tradeoff_table.TradeoffRow({'k': 1}, 'ok', .1, 10, 1., cpu=1., error=.1, walls=[1.], cpus=[1.]),
                                    tradeoff_table.TradeoffRow({'k': 2}, 'ok', .1, 10, 2., cpu=2., error=.01, walls=[2.], cpus=[2.])])
    table.csv(folder + '/table.csv')
    for name, text in (('plate', '0 0\n1 0\n1 1\n'), ('plate.csv', '0, 0\n1, 0\n1, 1\n'),
                       ('mesh.inp', '*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n')):
        pathlib.Path(folder, name).write_text(text)
    return table


def trialScene(_):
    """Never run here: tradeoff's runs are left out."""


def trialMeasure(_):
    """Likewise."""


def calls(fe, folder):
    """{function, or variant: (what is called, forms of its arguments, arguments of a call that succeeds)}"""
    found, table = {}, api_values.forms(fe, folder, (trialScene, trialMeasure))
    for name, groups in table.items():
        function = api_values.VARIANTS.get(name, name)
        call = getattr(yadefrag, function, None) or getattr(fe, function, None) or (lambda loads: setattr(fe, 'loads', loads))
        needed = [one.name for one in inspect.signature(call).parameters.values() if one.default is one.empty]
        right = {one: table[function][one][0][0] for one in needed if one in table[function]}
        found[name] = call, groups, {**right, **api_values.NEEDED.get(name, {})}
    return found


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

def drawn(draw, fe, folder, table):
    """(a call as text, the function that does it, does it run the scene before a function of the script is called?)"""
    def wrong(right=None):
        if draw.random() < .6:
            return api_values.alike(draw, fe, right)
        return api_values.anything(draw, fe)

    known, target, listed, args = calls(fe, folder), draw.choice(targets(fe, table)), [], {}
    label = type(target).__name__ + '.'
    # Not all kinds are as rich.
    kind = draw.choice(['function', 'function', 'function', 'method', 'attribute', 'class'])
    if kind == 'function':
        label = draw.choice(list(known))
        function, groups, args = known[label]
        replace(draw, groups, args, wrong)
    elif kind == 'method':
        name = draw.choice([one for one in methods(type(target)) if one not in known or target is not fe])
        label, function = label + name, getattr(target, name)
        listed = [wrong() for _ in range(draw.choice([0, 1, 1, 2, 3]))]
    elif kind == 'attribute' and settable(type(target)):
        name = draw.choice(settable(type(target)))
        label, function, listed = label + name, lambda value: setattr(target, name, value), [wrong(getattr(target, name))]
    else:
        function = draw.choice(ownClasses() + [scene_choices.Choices])
        values, label = presets(function), function.__name__
        names = draw.choices(list(values) or ['rows', 'title', 'settings'], k=draw.choice([0, 1, 2]))
        args = {name: wrong(values.get(name)) for name in names}
        listed = [wrong() for _ in range(draw.choice([0, 0, 1, 2]))]
    text = '%s(%s)' % (label, ', '.join([*map(shown, listed), *('%s=%s' % (n, shown(v)) for n, v in args.items())]))
    return text, lambda: function(*listed, **args), callable(args.get('call')) or label == 'relax'


def replace(draw, groups, args, wrong):
    """Of right arguments one or two replaced, left out or added."""
    for _ in range(draw.choice([1, 1, 1, 2])):
        if not groups or draw.random() < .02:
            args[draw.choice(['nope', 'fe', 'size'])] = wrong()
            continue
        name = draw.choice(list(groups))
        if draw.random() < .05:
            args.pop(name, None)
        else:
            args[name] = wrong(draw.choice(groups[name])[0])
    for many in ('steps', 'every', 'repeats', 'most'):  # right, but for ever
        if (real(args.get(many)) or 0) > 100:
            args[many] = 10**400


# --- moments

def atOnce(call):
    try:
        call()
        return None
    except BaseException as error:  # judged below
        return error


def inThread(call):
    """Another thread calls, as this one waits."""
    with concurrent.futures.ThreadPoolExecutor(1) as other:
        return other.submit(atOnce, call).result()


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
    counts = [0, 0]
    with open(logName, 'w', errors='backslashreplace') as log, tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        fe, table = None, None
        for number in range(int(calls)):
            moment = draw.choice(kMoments)
            if fe is None or number % 10 == 0:
                fe = scene(moment)
                table = exampleFiles(fe, folder)
            text, call, mayStep = drawn(draw, fe, folder, table)
            log.write('%d %s: %s\n' % (number, moment, text))
            log.flush()
            before = state(fe)
            error = kHow[moment](call)
            wrong = whatIsWrong(error)
            log.write('    %s\n' % ('ok' if error is None else answer(error)[:200]))
            counts[error is not None] += 1
            isPaused = moment in ('before', 'between', 'thread') and not mayStep
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
        log.write('END %d succeeded, %d refused\n' % tuple(counts))
    O.reset()
    os.chdir('/')


if __name__ == '__main__':
    main(*sys.argv[1:])
