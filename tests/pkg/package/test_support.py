"""The check at `import yadefrag`: which YADE is refused, and with what words. What is known of YADE's classes
(pkg/yade/versions): by the declarations, and by the running yade."""
import copy
import ctypes
import json
import os
import pathlib
import re
import sys
import sysconfig
import types

import pytest
import yade
from yade import config, wrapper
from yadefrag import _yadefrag, support
from project import ran, ROOT

ABI = ROOT / 'pkg' / 'yade'
sys.path.insert(0, str(ABI / 'tools'))

import check_virtuals  # noqa: E402
import make_table  # noqa: E402
import versions  # noqa: E402

KNOWN = versions.known()


@pytest.fixture(autouse=True)
def packaged(monkeypatch):
    """Words about a build for a package, also where these tests run in a YADE that its user built."""
    monkeypatch.setattr(support, 'FEATURES', None)


STOCK = ['OPENMP', 'MPI', 'QT5', 'FEMLIKE', 'VTK', 'CGAL']


@pytest.mark.parametrize('version, precision, features, found, needed', [
    ('2022.01a', 'PrecisionDouble', STOCK, 'version 2022.01a', 'version ' + support.VERSION),
    (support.VERSION, 'PrecisionLongDouble', STOCK, 'PrecisionLongDouble', 'PrecisionDouble'),
    (support.VERSION, 'PrecisionDouble', STOCK + ['VECTORIZE'], 'has VECTORIZE', 'no VECTORIZE'),
    (support.VERSION, 'PrecisionDouble', STOCK + ['MASK_ARBITRARY'], 'has MASK_ARB', 'no MASK_ARB'),
    (support.VERSION, 'PrecisionDouble', STOCK + ['SPH'], 'has SPH', 'no SPH'),
    (support.VERSION, 'PrecisionDouble', ['OPENMP', 'QT5', 'FEMLIKE'], 'has no MPI', 'with MPI'),
])
def test_otherYadeIsNamedInOneSentence(version, precision, features, found, needed):
    sentence = support.describeMismatch(version, precision, features)
    assert found in sentence and needed in sentence
    assert sentence.count('. ') == 0 and sentence.endswith('.') and '\n' not in sentence


def test_everyDifferenceIsNamed(monkeypatch):
    """None for the stock YADE; a version for which there are other builds as such; config.py without the fields."""
    assert support.describeMismatch(support.VERSION, 'PrecisionDouble', STOCK) == ''
    others = [version for version in support.ACCEPTED if version != support.VERSION]
    assert others
    for version in others:
        sentence = support.describeMismatch(version, 'PrecisionDouble', STOCK)
        assert sentence.endswith('for which yadefrag must be built or installed again.')
    sentence = support.describeMismatch('1.0', 'PrecisionFloat', ['SPH'])
    assert all(word in sentence for word in ('1.0', 'PrecisionFloat', 'no OPENMP', 'no MPI', 'has', 'SPH'))
    modules = {'yade.wrapper': None, 'yade.config': types.SimpleNamespace()}
    assert 'unknown' in support.describeSurroundings(modules)
    # A build for a YADE whose layout is known, but without a test run.
    monkeypatch.setattr(support, 'VERSION', '2027.1.0')
    sentence = support.describeMismatch('2027.1.0', 'PrecisionDouble', STOCK)
    assert 'never tested with it' in sentence and '2023.02a' in sentence
    assert sentence.endswith('.') and '\n' not in sentence


def test_plainPythonIsReferredToYade():
    package = pathlib.Path(support.__file__).parent.parent
    done = ran(sys.executable, '-c', 'import yadefrag', env={**os.environ, 'PYTHONPATH': str(package)})
    assert done.returncode == 1
    last = done.stderr.strip().splitlines()[-1]
    assert last.startswith('ImportError: ') and 'run by the command `yade`' in last


def test_anotherBuildOfTheSameVersionIsRefusedInOneSentence(tmp_path):
    library = tmp_path / 'libyade.so'
    sentence = support.describeOtherBuild(str(tmp_path))
    assert sentence.endswith('has none: yadefrag must be built or installed again.')
    library.write_bytes(b'\x7fELF' + b'\x04\0\0\0\x14\0\0\0\x03\0\0\0GNU\0' + bytes(range(20)))
    sentence = support.describeOtherBuild(str(tmp_path))
    assert 'has 000102030405060708090a0b0c0d0e0f10111213:' in sentence and '\n' not in sentence
    assert support.describeOtherBuild(config.libDir) == ''


def test_yadesOwnClassesAreNotReplaced():
    for name in ('Collider', 'InsertionSortCollider', 'Sphere', 'Body'):
        assert getattr(yade, name) is getattr(wrapper, name)
    assert isinstance(wrapper.InsertionSortCollider(), yade.Collider)


def test_ownCopiesOfEigenCgalAndFmtStayInside():
    """YADE's, compiled with other options, would be called instead."""
    lines = ran('nm', '-DC', '--defined-only', _yadefrag.__file__).stdout.splitlines()
    names = [line.split(' ', 2)[2] for line in lines]
    assert 'PyInit__yadefrag' in names
    assert any(name.startswith('typeinfo for yade') for name in names), 'one with YADE\'s'
    # A template of ours, or of std at -O1, may return one of Eigen's types: its name then begins with that type.
    functions = [name for name in names if ' yadefrag::' not in name and re.match(
        r'.*CGAL::|.*fmt::v|(guard variable for |void |)Eigen::(?![^(]*[>&*] std::)', name)]
    assert functions == []


# --- layouts of classes

def compiled(tmp_path, version):
    """The compiler's run on the checks of the layout, for the table of a version; its dump of the classes."""
    assert make_table.main(version, '0', tmp_path / 'yade', tmp_path / '_built.py') == 0
    dump = tmp_path / 'classes.txt'
    folders = ['/usr/include/eigen3', sysconfig.get_paths()['include']]
    return ran('g++', '-std=c++20', '-w', '-fsyntax-only', '-fdump-lang-class=%s' % dump, '-DEIGEN_DONT_VECTORIZE',
               '-DEIGEN_DONT_ALIGN', '-DYADE_MPI', '-DBOOST_BIND_GLOBAL_PLACEHOLDERS', '-I%s' % ABI.parent, '-I%s' % tmp_path,
               *['-isystem' + folder for folder in folders], ABI / 'layout_checks.cpp'), dump


def declared():
    """{(type, member)} of the declarations, but for bytes that stand for what is not touched."""
    text = re.sub(r'//.*', '', '\n'.join(path.read_text() for path in ABI.glob('*.hpp')))
    bodies = re.findall(r'^(?:class|struct) (\w+)\b[^;{]*\{(.*?)^\};', text, re.M | re.S)
    return {(kind, member) for kind, body in bodies for member in re.findall(
        r'^  [\w:<>, *&]+? (\w+)(?:\[\d\])?;$', re.sub(r'\{[^{}]*\}', ';', body), re.M)}


def test_everyDeclaredMemberIsChecked(tmp_path, monkeypatch):
    """The compiler refuses a table in which all sizes and offsets are larger by a byte, and names them."""
    other = copy.deepcopy(KNOWN)
    for facts in other.values():
        for entry in facts['classes'].values():
            entry['size'] += 1
            entry['members'] = [[name, kind, at + 1] for name, kind, at in entry['members']]
    monkeypatch.setattr(versions, 'known', lambda: other)
    done, _ = compiled(tmp_path, config.version)
    refused = set(re.findall(r'static assertion failed: (\w+(?:::\w+)?)$', done.stderr, re.M))
    classes = KNOWN[config.version]['classes']
    measured = {(kind, row[0]) for kind, entry in classes.items() for row in entry['members']}
    seen = declared() & measured
    assert len(seen) > 100, 'the declarations are not read as they are written'
    assert set(classes) <= refused
    # References have no offset: layout_checks.cpp compares what is beside them.
    assert {'%s::%s' % row for row in seen} - refused == {'State::pos', 'State::ori', 'ScGeom::radius1',
                                                          'ScGeom::radius2'}


def test_acceptedVersionsAreThoseThatWereRun():
    assert support.ACCEPTED == {version: facts['system'] for version, facts in KNOWN.items() if facts['run']}
    assert config.version in support.ACCEPTED and support.VERSION == config.version


class Symbol(ctypes.Structure):
    _fields_ = [('file', ctypes.c_char_p), ('begin', ctypes.c_void_p), ('name', ctypes.c_char_p),
                ('address', ctypes.c_void_p)]


def runningTable(name, tables):
    """The mangled names of the functions in a class's tables of the running yade; '' for unnamed."""
    process = ctypes.CDLL(None)
    places = sum(2 + len(functions) for functions in tables.values())
    table = (ctypes.c_void_p * places).in_dll(process, '_ZTVN4yade%d%sE' % (len(name), name))
    found, begin = [], 0
    for functions in tables.values():
        for address in table[begin + 2:begin + 2 + len(functions)]:
            symbol = Symbol()
            known = process.dladdr(ctypes.c_void_p(address), ctypes.byref(symbol))
            found.append(symbol.name.decode() if known and symbol.name else '')
        begin += 2 + len(functions)
    return found


def test_virtualFunctionsOfTheRunningYadeAreTheMeasuredOnes():
    wanted, names = [], []
    for name, entry in KNOWN[config.version]['classes'].items():
        try:
            names += runningTable(name, entry['virtuals'])
        except ValueError:  # a class without a table of its own in the libraries
            continue
        wanted += [(name, at, function) for at, functions in entry['virtuals'].items() for function in functions]
    assert len(names) == len(wanted) > 500
    compared = 0
    demangled = ran('c++filt', input='\n'.join(names)).stdout.splitlines()
    for (name, at, function), spelled in zip(wanted, demangled, strict=True):
        # Functions of the same code, e.g. of two empty destructors, may have one symbol's name.
        if not spelled or function == '~':
            continue
        assert re.search(r'\b%s(\[abi:cxx11\])?\(' % function, spelled), (name, at, function, spelled)
        compared += 1
    assert compared > 400


@pytest.mark.long
@pytest.mark.parametrize('version', KNOWN)
def test_theDeclarationsFitEveryVersion(version, tmp_path):
    """Also those whose package is not here: sizes and offsets by the compiler, then the functions."""
    done, dump = compiled(tmp_path, version)
    assert done.returncode == 0, done.stderr[-2000:]
    tables = check_virtuals.readTables(dump.read_text())
    assert list(check_virtuals.differences(tables, KNOWN[version]['classes'], check_virtuals.derivedFrom())) == []


@pytest.mark.parametrize('tables, line', [
    ({'0': ['~', '~', 'getVolume', 'getClassIndex']}, 'Shape, base at byte 0, virtual function 3'),
    ({'0': ['~', '~']}, 'Shape, base at byte 0: getVolume is not declared'),
    ({'0': ['~', '~', 'getVolume', 'getColor', 'more']}, 'YADE has none'),
    ({'8': ['~', '~']}, 'Shape, base at byte 8, virtual function 0: declared ~, YADE has none'),
])
def test_anotherOrderOfVirtualFunctionsIsFound(tables, line):
    measured = {'Shape': {'virtuals': {'0': ['~', '~', 'getVolume', 'getColor']}}}
    assert list(check_virtuals.differences({'Shape': measured['Shape']['virtuals']}, measured, {'Shape'})) == []
    assert any(line in found for found in check_virtuals.differences({'Shape': tables}, measured, {'Shape'}))


def test_theDeclarationsFitTheirOwnVersionAlone():
    """2026 has one virtual function of Shape more: declarations for it do not pass for 2023."""
    newer = {name: entry['virtuals'] for name, entry in KNOWN['2026.1.0']['classes'].items()}
    lines = list(check_virtuals.differences(newer, KNOWN['2023.02a']['classes'], set()))
    assert len(lines) == 6 and all('declared getVolume' in line for line in lines)


def test_aDumpIsReadByClassAndBase():
    dump = '''Vtable for yade::Shape
yade::Shape::_ZTVN4yade5ShapeE: 9 entries
0     (int (*)(...))0
8     (int (*)(...))(& _ZTIN4yade5ShapeE)
16    (int (*)(...))yade::Shape::~Shape
24    (int (*)(...))yade::Shape::getVolume
32    (int (*)(...))-24
40    (int (*)(...))(& _ZTIN4yade5ShapeE)
48    (int (*)(...))yade::Shape::_ZThn24_N4yade5ShapeD0Ev
56    (int (*)(...))yade::Shape::_ZThn24_NK4yade5Shape17getBaseClassIndexEi
64    (int (*)(...))yade::OneShapeCalls<A, B<C>&>::go3 [with Arguments = {A}]

Class yade::Shape
   size=96 align=8
'''
    assert check_virtuals.readTables(dump) == {'Shape': {'0': ['~', 'getVolume'],
                                                     '24': ['~', 'getBaseClassIndex', 'go']}}


def test_anUnknownVersionIsNamedInOneSentence(tmp_path, capsys):
    assert make_table.main('2031.1', '0', tmp_path / 'a.hpp', tmp_path / 'b.py') == 2
    printed = capsys.readouterr().out
    assert '2031.1' in printed and all(version in printed for version in KNOWN)
    assert printed.count('\n') == 1 and not list(tmp_path.iterdir())


def test_filesAreWrittenAsTheyAreRead(tmp_path, monkeypatch):
    monkeypatch.setattr(versions, 'FOLDER', tmp_path)
    for version, facts in KNOWN.items():
        written = versions.write(facts)
        assert written.read_text() == (ABI / 'versions' / written.name).read_text()
        assert json.loads(written.read_text()) == facts and facts['version'] == version
