#!/usr/bin/env python3
"""check_source.py VERSION [SOURCE]: compares the declarations of pkg/yade with YADE's own headers.
check_source.py --versions: prints the versions whose sources Debian has.
check_source.py --prefix FOLDER VERSION FEATURES: makes a YADE_PREFIX with empty libraries and the fetched sources.

One file is compiled against both: its assertions of sizes and offsets hold for pkg/yade in each
build, and here for the headers of SOURCE, a source tree of that version. The order of the virtual functions
in these headers must be that of versions/VERSION.json, with which each build compares pkg/yade. Without
SOURCE, the sources are fetched from Debian once, into ~/.cache/yadefrag. The features are those of Debian's
packages that move members. Exit code 1: something differs; 75: the sources cannot be fetched.
"""

import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import urllib.request

import check_virtuals
import make_table
import versions
import yade_build

POOL = 'http://deb.debian.org/debian/pool/main/y/yade/'
CACHE = pathlib.Path(os.environ.get('YADEFRAG_ROOTS', pathlib.Path.home() / '.cache' / 'yadefrag'))
# Those of the packages that move members: support.NEEDED.
FEATURES = ['OPENMP', 'MPI', 'QT5', 'FEMLIKE']
PKG = versions.FOLDER.parent.parent


def fetch(version):
    """Folder of the sources; raises OSError if they cannot be fetched, ValueError if they are others."""
    name, digest = versions.read(version)['sources']
    folder = CACHE / ('yade-' + version)
    if not folder.exists():
        with urllib.request.urlopen(POOL + name, timeout=120) as answer:
            packed = answer.read()
        if hashlib.sha256(packed).hexdigest() != digest:
            raise ValueError('%s is not the file whose SHA-256 is in versions/%s.json' % (name, version))
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent) as place:
            file = pathlib.Path(place) / name
            file.write_bytes(packed)
            with tarfile.open(file) as archive:
                archive.extractall(place, filter='data') if hasattr(tarfile, 'data_filter') else \
                    archive.extractall(place)
            top = next(path for path in pathlib.Path(place).iterdir() if path.is_dir())
            top.rename(folder)
    return folder


def compiled(version, source, folder):
    """The compiler's tables of virtual functions; ends with its messages if an assertion does not hold."""
    make_table.main(version, '0', folder / 'yade', folder / '_built.py')
    config = {'features': FEATURES, 'bits': 64, 'decimals': 15}
    mpi = subprocess.run(['mpicxx', '--showme:incdirs'], capture_output=True, text=True, check=True).stdout.split()
    systems = [source, '/usr/include/eigen3', sysconfig.get_paths()['include'], *mpi]
    done = subprocess.run(
        # Private members are checked, too.
        ['g++', '-std=c++20', '-w', '-fsyntax-only', '-fno-access-control', '-DYADEFRAG_YADE_SOURCE',
         '-fdump-lang-class=%s' % (folder / 'classes.txt'), '-DYADE_DISABLE_REAL_MULTI_HP',
         *yade_build.compilerFlags(config), '-I%s' % PKG, '-I%s' % folder,
         *['-isystem%s' % system for system in systems], str(PKG / 'yade' / 'layout_checks.cpp')],
        capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(done.stderr)
    return check_virtuals.readTables((folder / 'classes.txt').read_text())


def main(version, source=None):
    if source is None:
        try:
            source = fetch(version)
        except OSError as error:
            print('the sources of YADE %s cannot be fetched: %s' % (version, error))
            return 75
    with tempfile.TemporaryDirectory() as folder:
        tables = compiled(version, pathlib.Path(source).resolve(), pathlib.Path(folder))
    measured = versions.read(version)['classes']
    known = {name: table for name, table in tables.items() if name in measured}
    found = list(check_virtuals.differences(known, measured, check_virtuals.derivedFrom()))
    for line in found:
        print("YADE's headers differ from versions/%s.json: %s" % (version, line))
    if not found:
        print("YADE %s: pkg/yade has the layout and the functions of YADE's headers, %d classes compared"
              % (version, len(known)))
    return 1 if found else 0


def makePrefix(prefix, version, features):
    """What CMake needs to know of an installed YADE: its config.py; its libraries are empty."""
    libraries = pathlib.Path(prefix) / 'lib' / ('yade-' + version)
    (libraries / 'py' / 'yade').mkdir(parents=True, exist_ok=True)
    (libraries / 'py' / 'yade' / 'config.py').write_text(
        "version='%s'\nfeatures='%s'.split()\nhighPrecisionBits=64\nhighPrecisionDecimalPlaces=15\nsourceRoot='%s'\n"
        % (version, features, fetch(version)))
    for name in ('yade', 'pkg_common', 'pkg_dem'):
        (libraries / ('lib%s.so' % name)).touch()
    return 0


if __name__ == '__main__':
    if sys.argv[1] == '--versions':
        print('\n'.join(version for version, facts in versions.known().items() if 'sources' in facts))
    elif sys.argv[1] == '--prefix':
        sys.exit(makePrefix(*sys.argv[2:]))
    else:
        sys.exit(main(*sys.argv[1:]))
