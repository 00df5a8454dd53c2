"""Each argument accepts every form that its docstring states, with the same result, and refuses what is none.
Thousands of calls of all that is public with wrong values, seeded, each batch in a yade of its own
(YADEFRAG_API_SECONDS: for how long, 30).

api_values.py has the forms; a call of api_calls.py that succeeds has the other arguments."""
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import time
import warnings

import numpy as np
import pytest

import api_calls
import api_values as forms
import yadefrag
from api_calls import O
from project import yadeCommand
from yade import wrapper as w
from yadefrag.arguments import shown
from yadefrag.studies import ensemble_runs, tradeoff_grid

def made(name, folder):
    """(solver, the call, groups of forms by argument, its right arguments) in a new scene and folder."""
    shutil.rmtree(folder, ignore_errors=True)
    os.mkdir(folder)
    fe = api_calls.scene('between')
    api_calls.exampleFiles(fe, folder)
    pathlib.Path(folder, 'numbers').write_text('1 2\n')
    O.dt *= .2  # for bonds and joints
    return fe, *api_calls.calls(fe, folder)[name]


def told(value):
    """The result of a call as text."""
    if isinstance(value, np.ndarray):
        return repr(value.tolist())
    if isinstance(value, yadefrag.Mesh):
        return told([value.nodes, value.triangles, value.joints, *value.loops, value.smooth])
    if isinstance(value, (list, tuple)):
        return '[%s]' % ', '.join(map(told, value))
    if isinstance(value, dict):
        return told(list(value.items()))
    if isinstance(value, (yadefrag.TradeoffTable, yadefrag.EnsembleTable)):
        return repr([row.settings for row in value.rows])
    if hasattr(value, 'get_xlim'):  # axes
        return told([value.get_xlim(), value.get_ylim(), *((one.get_array(), one.get_clim()) for one in value.collections)])
    if isinstance(value, w.Serializable):
        return type(value).__name__ + told([one for one in value.dict().items() if one[0] not in ('realLast', 'virtLast')])
    return re.sub(' at 0x[0-9a-f]*', '', repr(value))


def outcome(name, argument, place, folder):
    """All that a call with one form has done: its result, the scene after two steps, and files."""
    _, call, groups, right = made(name, folder)
    value = groups[argument][place[0]][place[1]]
    jobs = []
    tradeoff_grid._runAll = lambda rows, settings, job, *others: jobs.append([settings, sorted(job.items()), others[0]])
    ensemble_runs._run = lambda rows, job, finished, executor, workers: jobs.append([sorted(job.items()), workers])
    before = set(os.listdir(folder))
    try:
        result = told(call(**{**right, argument: value}))
    except Exception as error:
        pytest.fail('%s(%s=%s) is refused: %s' % (name, argument, shown(value), error))
    if hasattr(w.FESolver, forms.VARIANTS.get(name, name)):
        O.step()
        O.save(folder + '/state.xml')
    seen = [result, repr(jobs)]
    for file in sorted(os.listdir(folder)):
        if file not in before or file == 'run.csv':
            content = pathlib.Path(folder, file).read_bytes()
            seen.append(re.sub(rb'<item>(isoTime|id|d.id|id.d)=.*|<speed>.*', b'', content))
    return seen


def cases():
    """(function, argument) of all."""
    known = api_calls.calls(api_calls.scene('between'), '/')
    return [(name, argument) for name, (_, groups, _) in known.items() for argument in groups]


@pytest.fixture(autouse=True)
def restored(monkeypatch):
    monkeypatch.setattr(tradeoff_grid, '_runAll', None)
    monkeypatch.setattr(ensemble_runs, '_run', None)
    with warnings.catch_warnings(action='ignore'):
        yield


everyArgument = pytest.mark.parametrize('name, argument', cases(), ids=lambda v: v)


@everyArgument
def test_everyFormIsAccepted(name, argument, folder):
    folder += '/own'
    sizes = [len(group) for group in made(name, folder)[2][argument]]
    for group, size in enumerate(sizes):
        first = outcome(name, argument, (group, 0), folder)
        for k in range(1, size):
            assert outcome(name, argument, (group, k), folder) == first, 'form %d of group %d' % (k, group)


# Their sentence names another argument, or what is in the value.
kOtherSentence = [('readOutline', 'layers'), ('animate', 'field'), ('tradeoff', 'reference'),
                  ('severalFields', 'fields'), ('addMesh', 'mesh'), ('tradeoff', 'vary'), ('plotFragmentSizes', 'components'), ('runSteps', 'every'),
                  ('rotate', 'nodes'), ('reaction', 'nodes')]


@everyArgument
def test_whatIsNoFormIsRefused(name, argument, folder):
    """With one sentence that names argument and value; nothing changes."""
    fe, call, groups, right = made(name, folder + '/own')
    before = api_calls.state(fe)
    for wrong in forms.others(groups[argument]):
        with pytest.raises((ValueError, TypeError, RuntimeError, OSError)) as error:
            call(**{**right, argument: wrong})
        text, named = str(error.value), '%s is %s' % (argument, shown(wrong))
        assert not api_calls.whatIsWrong(error.value) and api_calls.state(fe) == before, (named, text)
        assert named in text or re.search(r'\b%s\S* (has|must|is) ' % argument, text) or (name, argument) in kOtherSentence, (named, text)


def test_everyArgumentHasForms():
    table = {name: set(groups) for name, (_, groups, _) in api_calls.calls(api_calls.scene('between'), '/').items()}
    for variant, function in forms.VARIANTS.items():
        table[function] |= table[variant]
    bodies = {argument for name in table if name.startswith('add') for argument in table[name]}
    # Of attributes, updateAttrs among them: test_refused_values.py.
    methods = [name for name in vars(w.FESolver) if name[0] != '_' and name != 'updateAttrs' and callable(getattr(w.FESolver, name))]
    missing = []
    for name in api_calls.ownFunctions() + methods:
        function = getattr(yadefrag, name, None) or getattr(w.FESolver, name)
        for argument, parameter in inspect.signature(function).parameters.items():
            known = bodies if name.startswith('add') else table.get(name, ())
            if argument not in known and argument != 'self' and parameter.kind != parameter.VAR_KEYWORD:
                missing.append('%s(%s)' % (name, argument))
    assert not missing


@pytest.mark.parametrize('cls', [one for one in api_calls.ownClasses() if issubclass(one, w.Serializable)])
def test_everyAttributeAcceptsItsForms(cls):
    for name, preset in cls().dict().items():
        for group in forms.attribute(cls, name, preset) if name in api_calls.settable(cls) else ():
            found = []
            for form in group:
                one, other = cls(**{name: form}), cls()
                setattr(other, name, form)
                found += [getattr(one, name), getattr(other, name)]
            assert all(value == found[0] for value in found), '%s: %s' % (name, found)
            for wrong in [object()] + [(1, 2)] * (name == 'gravity' and cls is not w.FESolver):
                with pytest.raises(TypeError, match='it must be (?!two)' if wrong == (1, 2) else 'it must be'):
                    setattr(other, name, wrong)


# --- random calls

kSeconds = float(os.environ.get('YADEFRAG_API_SECONDS', '30'))
kCalls = 200  # of a batch
kLimit = 300  # s for a batch


def batch(seed, log):
    """(numbers of calls that succeeded and were refused, list of what was found)."""
    script = pathlib.Path(__file__).with_name('api_calls.py')
    ended = 'it hung'
    try:
        run = subprocess.run([*yadeCommand(), str(script), str(seed), str(kCalls), log], capture_output=True,
                             timeout=kLimit, text=True, errors='replace')
        ended = 'the process ended with %d: %s' % (run.returncode, run.stderr[-500:])
    except subprocess.TimeoutExpired:
        pass
    lines = pathlib.Path(log).read_text(errors='replace').splitlines()
    found = ['%s -> %s' % (call, line) for call, line in zip(lines, lines[2:]) if line.startswith('FOUND')]
    end = re.fullmatch(r'END (\d+) succeeded, (\d+) refused', lines[-1] if lines else '')
    if not end:
        found.append('%s -> %s' % (lines[-1] if lines else 'no call', ended))
    return ([int(n) for n in end.groups()] if end else [0, 0]), ['seed %d: %s' % (seed, f) for f in found]


@pytest.mark.long
def test_everyCallIsAnsweredBySuccessOrASentence(folder):
    end, seed, found, counts = time.monotonic() + kSeconds, 1, [], [0, 0]
    while time.monotonic() < end:
        done, wrong = batch(seed, folder + '/log')
        counts = [a + b for a, b in zip(counts, done)]
        found += wrong
        seed += 1
    print('%d calls succeeded, %d were refused, in %d batches' % (*counts, seed - 1))
    assert not found, '\n'.join(found)
    assert counts[1] > counts[0] / 4 > 0
