"""scripts/gallery: its makers are those of the pictures and tables that the pages show; a maker that fails
changes nothing."""
import importlib.util
import re
import subprocess

import pytest

from project import ROOT

PAGES = [ROOT / 'README.md', *(ROOT / 'docs').glob('*.md'), *(ROOT / 'examples').glob('**/README.md')]
SCRIPT = '''
import pathlib, sys
out = pathlib.Path(sys.argv[1])
print('Using python version: 3')
print('size:  1.20e-05 of 7, at least -3')
print('speed: %s' % (' '.join(sys.argv[2:]) or 'none'))
if 'fail' in sys.argv:
    sys.exit('no room')
if 'forget' not in sys.argv:
    (out / 'x.png').write_text('new')
'''
README = 'before\n\n<!-- figures: x -->\nold\n<!-- end of figures -->\n\nafter\n'


@pytest.fixture
def gallery():
    spec = importlib.util.spec_from_file_location('gallery', ROOT / 'scripts' / 'gallery.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def project(gallery, tmp_path, monkeypatch):
    """A root folder with one example, x."""
    folder = tmp_path / 'examples' / 'x'
    folder.mkdir(parents=True)
    (tmp_path / 'x.py').write_text(SCRIPT)
    (folder / 'README.md').write_text(README)
    (folder / 'x.png').write_text('old')
    monkeypatch.setattr(gallery, 'ROOT', tmp_path)
    return folder


def maker(gallery, *runs, **more):
    return gallery.Maker('x', 'x', ('x.png',), '/usr/bin/python3 x.py {out}', runs, **more)


def shown():
    """Paths of the pictures on all pages, from the root folder."""
    return {str((page.parent / target).resolve().relative_to(ROOT))
            for page in PAGES for target in re.findall(r'!\[[^\]]*\]\(([^)]+)\)', page.read_text())}


def test_eachPictureThatAPageShowsHasItsMaker(gallery):
    made = [place for m in gallery.MAKERS for place in m.places() if place.endswith(('.png', '.gif'))]
    assert len(made) == len(set(made)) > 30
    assert set(made) == shown()
    assert all((ROOT / place).is_file() for m in gallery.MAKERS for place in m.places())


def test_eachTableHasItsMakerMachineDateAndCommit(gallery):
    found = {}
    for page in PAGES:
        for name, table in re.findall(r'<!-- figures: (\S+) -->\n(.*?)<!-- end of figures -->', page.read_text(), re.S):
            found[name] = page.parent.name, table
    assert {name: folder for name, (folder, _) in found.items()} == {
        m.name: m.folder for m in gallery.MAKERS if m.table}
    for name, (_, table) in found.items():
        origin = rf'`scripts/gallery {name}`: .*, \d+ cores, \d+ \w+ \d{{4}}, commit [0-9a-f]{{7,}}(-dirty)?\.'
        assert table.startswith('|') and re.search(origin, table), name


def test_theListShowsEachMaker(gallery):
    done = subprocess.run([ROOT / 'scripts' / 'gallery', '--list'], capture_output=True, text=True, check=True)
    assert [line.split()[0] for line in done.stdout.splitlines()] == [m.name for m in gallery.MAKERS]


def test_anUnknownMakerIsNamed():
    done = subprocess.run([ROOT / 'scripts' / 'gallery', 'impct'], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and "no maker 'impct'; there are impact, " in done.stderr


def test_pictureAndTableAreReplaced(gallery, project):
    gallery.make(maker(gallery, '', 'fast'), 'a machine, today')
    assert (project / 'x.png').read_text() == 'new'
    assert (project / 'README.md').read_text() == README.replace('old', '''|  | default | `fast` |
|---|--:|--:|
| size | 1.20·10⁻⁵ of 7, at least −3 | 1.20·10⁻⁵ of 7, at least −3 |
| speed | none | fast |

`scripts/gallery x`: a machine, today.''')


def test_manyRunsAreRows(gallery, project):
    gallery.make(maker(gallery, 'a', 'b', 'c', 'd', rows=('speed',)), 'here')
    table = '|  | speed |\n|---|--:|\n' + ''.join(f'| `{run}` | {run} |\n' for run in 'abcd')
    assert table in (project / 'README.md').read_text()


@pytest.mark.parametrize('runs, more, reason', [
    (('', 'fail'), {}, 'no room'), (('forget',), {}, 'did not write x.png'),
    (('',), {'rows': ('weight',)}, "does not print 'weight'")])
def test_aMakerThatFailsChangesNothing(gallery, project, runs, more, reason):
    with pytest.raises(gallery.Failed, match=reason):
        gallery.make(maker(gallery, *runs, **more), 'here')
    assert (project / 'README.md').read_text() == README and (project / 'x.png').read_text() == 'old'


def test_aPageWithoutMarksIsNotChanged(gallery, project):
    (project / 'README.md').write_text('before\n')
    with pytest.raises(gallery.Failed, match='no <!-- figures: x -->'):
        gallery.make(maker(gallery, ''), 'here')
    assert (project / 'README.md').read_text() == 'before\n' and (project / 'x.png').read_text() == 'old'


def test_zeroAndRangesAreReadable(gallery):
    assert gallery.readable('+0.0e+00 at most, -1.9e-04 m, a-b 3-4, 5%') == '0 at most, −1.9·10⁻⁴ m, a-b 3-4, 5 %'
