"""All Python of the manual and the README runs, as it is printed there; so do the cases of tests/pkg/examples/cases."""
import importlib.util
import pathlib
import re
import subprocess

import pytest

import yadefrag
from project import ROOT, yadeCommand

BLOCKS = {f'{page.name}-{number}': block
          for page in (ROOT / 'README.md', *sorted((ROOT / 'docs').glob('*.md')))
          for number, block in enumerate(re.findall(r'^```python\n(.*?)^```', page.read_text(), re.S | re.M))}
CASES = pathlib.Path(__file__).resolve().parent / 'cases'
kCases = sorted(case.name for case in CASES.glob('*.py'))
kLong = 'concrete_softening.py', 'crushed_rock_ledger.py'
# What a recipe prints beside a closed form; 15 %: coarse meshes, the disc has 10 % too much.
BY_HAND = r': ([-+.e\d]+) \S+, by hand ([-+.e\d]+) \S+'


@pytest.mark.parametrize('name', [name if name.startswith(('README', 'getting_started'))
                                  else pytest.param(name, marks=pytest.mark.long) for name in sorted(BLOCKS)])
def test_blockRuns(folder, name):
    script = pathlib.Path(folder) / 'block.py'
    script.write_text(BLOCKS[name] + "\nprint('ran to its end')\n")
    done = subprocess.run([*yadeCommand(), str(script)], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=600)
    assert done.returncode == 0 and 'ran to its end' in done.stdout, done.stdout
    assert 'Traceback' not in done.stdout and 'yadefrag:' not in done.stdout, done.stdout
    for found, right in re.findall(BY_HAND, done.stdout):
        assert float(found) == pytest.approx(float(right), rel=.15), done.stdout
    assert len(re.findall(BY_HAND, done.stdout)) == BLOCKS[name].count(', by hand '), done.stdout


def test_thereAreBlocksAndCases():
    assert set(kLong) < set(kCases)
    assert len(BLOCKS) >= 12 and any(name.startswith('getting_started') for name in BLOCKS)


def test_referenceHasTheDocstrings():
    """docs/make_reference.py, which scripts/docs runs."""
    spec = importlib.util.spec_from_file_location('make_reference', ROOT / 'docs' / 'make_reference.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    found = module.page()
    assert [name for name in yadefrag.__all__ if not re.search(rf'^### `{name}\b', found, re.M)] == []
    for words in ('### `plotMesh(fe,', '`addPolygon(self, outline,', '- `size`: length of the triangles', '`fractureEnergy`'):
        assert words in found


@pytest.mark.parametrize('name', [pytest.param(name, marks=[pytest.mark.long] * (name in kLong)) for name in kCases])
def test_caseHolds(name, folder):
    """Scenes and files as users bring them, which once failed; each in a yade of its own. A case says at its top what is
    expected, computes it apart from the engine, and exits with 0 if it holds."""
    done = subprocess.run([*yadeCommand(), '-j1', str(CASES / name)], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=900)
    # YADE's own exit code of a script that ends with an exception is 1 as well.
    assert done.returncode == 0, done.stdout[-3000:]
