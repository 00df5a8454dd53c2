#!/usr/bin/env python3
"""Measures YADE's classes for pkg/yade/versions: sizes, members, order of the virtual functions.

    measure.py SOURCE SYSTEM [--libraries FOLDER] [--flags FLAGS]

SOURCE is a YADE source tree. Only one file is compiled, which includes the headers that define the
classes. Run it on the system whose package is measured: compiler, Boost, Eigen and MPI must be those
of that system. SYSTEM is its name, e.g. 'Debian 13'. Needed: g++, gdb (with Python) and the -dev
packages of the included headers: Python, Boost, Eigen, and, by feature, CGAL, MPI, mpi4py, Qt 5,
GL, MPFR, MPC.

The options that change layouts are read from the installed package: yade/config.py below the folder
of the libraries lists its features. --flags adds compiler flags (e.g. -I for headers elsewhere). The
new file has `"run": false`: change that after the tests have passed with this YADE.
"""

import argparse
import json
import pathlib
import re
import shlex
import subprocess
import sys
import sysconfig
import tempfile

import check_virtuals
import versions
import yade_build

LIBRARIES = '/usr/lib/x86_64-linux-gnu/yade-double'

# Run by gdb: {class: size, members}, as JSON.
IN_GDB = r'''
import gdb, json, re

def spell(kind):
    if kind.code in (gdb.TYPE_CODE_PTR, gdb.TYPE_CODE_REF, gdb.TYPE_CODE_FUNC):
        if kind.code == gdb.TYPE_CODE_FUNC: return 'subroutine_type'
        return spell(kind.target()) + ('*' if kind.code == gdb.TYPE_CODE_PTR else '&')
    if kind.code == gdb.TYPE_CODE_ARRAY and not kind.name:
        first, last = kind.range()
        return '%%s[%%d]' %% (spell(kind.target()), last - first + 1)
    plain = kind.unqualified()
    name = plain.name or 'structure_type'
    depth, start = 0, 0
    for at, sign in enumerate(name):  # the name without its enclosing scopes
        depth += {'<': 1, '>': -1}.get(sign, 0)
        if sign == ':' and depth == 0: start = at + 1
    name = re.sub(r'\bunsigned long\b(?! long)', 'long unsigned int', name[start:])
    name = re.sub(r'(?<!long )\blong\b(?! (?:int|unsigned|long|double)\b)', 'long int', name)
    constant = str(kind).startswith('const ') and not str(plain).startswith('const ')
    return ('const ' if constant else '') + name

found = {}
for name in %r:
    try:
        kind = gdb.lookup_type('yade::' + name).strip_typedefs()
    except gdb.error as error:
        found[name] = {'error': str(error)}
        continue
    fields = [f for f in kind.fields() if hasattr(f, 'bitpos')]  # no static ones
    found[name] = {
        'size': kind.sizeof,
        'members': [[f.name or '', spell(f.type), f.bitpos // 8] for f in fields
                    if not f.is_base_class]}
with open(%r, 'w') as out:
    json.dump(found, out)
'''


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode:
        sys.exit('%s failed:\n%s' % (command[0], done.stderr[-4000:]))
    return done.stdout


def allFlags(config):
    qt = '/usr/include/x86_64-linux-gnu/qt5'
    folders = [sysconfig.get_paths()['include'], '/usr/include/eigen3', qt, qt + '/QtGui',
               qt + '/QtCore', '/usr/lib/python3/dist-packages/mpi4py/include',
               '/usr/lib/x86_64-linux-gnu/openmpi/include']
    return yade_build.compilerFlags(config) + ['-isystem' + folder for folder in folders]


def definingHeaders(source, classes):
    """The header of each class, with its include path; complete, or an error."""
    texts = {path: path.read_text(errors='replace')
             for folder in ('core', 'lib', 'pkg') for path in sorted((source / folder).rglob('*.hpp'))}
    headers, missing = [], []
    for name in classes:
        begin = re.compile(r'^[ \t]*(?:class|struct)\s+(?:\w+\s+)?%s\b(?!\s*;)[^;{]*\{' % name, re.M)
        # `namespace forCtags` has empty classes of the same names.
        found = [path for path, text in texts.items()
                 if begin.search(re.sub(r'namespace forCtags.*?\n\}', '', text, flags=re.S))]
        if not found:
            missing.append(name)
        headers += [str(path.relative_to(source)) for path in found]
    return list(dict.fromkeys(headers)), missing


def shortType(spelled):
    """A type without the default allocators and orders."""
    spelled = re.sub(r'std::__cxx11::basic_string<char, std::char_traits<char>, '
                     r'std::allocator<char> >', 'string', spelled)
    before = None
    while spelled != before:
        before = spelled
        spelled = re.sub(r', std::(?:allocator|less)<[^<>]*(?:<[^<>]*>[^<>]*)*>', '', spelled)
    return spelled


def measure(source, classes, flags):
    """{class: size, members, virtuals}, and the classes that were not found in the headers."""
    headers, missing = definingHeaders(source, classes)
    names = [name for name in classes if name not in missing]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        # A class must be used to be in the debug information.
        uses = ['extern const unsigned long sizes[];', 'const unsigned long sizes[] = {']
        uses += ['sizeof(yade::%s),' % name for name in names] + ['};']
        uses += ['yade::%s* use_%s;' % (name, name) for name in names]
        lines = ['#include <%s>' % header for header in headers] + uses
        (folder / 'unit.cpp').write_text('\n'.join(lines) + '\n')
        run('g++', '-std=c++17', '-O0', '-g', '-gdwarf-4', '-fPIC', '-w', '-c', '-fdump-lang-class',
            '-femit-class-debug-always', '-fno-eliminate-unused-debug-types', '-I' + str(source),
            *flags, 'unit.cpp', '-o', 'unit.o', cwd=folder)
        tables = check_virtuals.readTables(next(folder.glob('*.class')).read_text())
        (folder / 'read.py').write_text(IN_GDB % (names, str(folder / 'found.json')))
        run('gdb', '-batch', '-nx', '-x', str(folder / 'read.py'), str(folder / 'unit.o'))
        found = json.loads((folder / 'found.json').read_text())
    missing += [name for name in names if 'error' in found[name]]
    return {name: {'size': found[name]['size'],
                   'members': [[member, shortType(kind), at]
                               for member, kind, at in found[name]['members']],
                   'virtuals': tables.get(name, {})}
            for name in names if name not in missing}, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n\n')[0])
    parser.add_argument('source', type=pathlib.Path)
    parser.add_argument('system')
    parser.add_argument('--libraries', type=pathlib.Path, default=pathlib.Path(LIBRARIES))
    parser.add_argument('--flags', default='', help='more options for g++')
    given = parser.parse_args()
    # The classes that pkg/yade declares: those of every existing file.
    classes = sorted(next(iter(versions.known().values()))['classes'])
    config = yade_build.readConfig(given.libraries)
    found, missing = measure(given.source.resolve(), classes,
                             allFlags(config) + shlex.split(given.flags))
    if missing:
        sys.exit('not found: %s' % ', '.join(missing))
    former = versions.known().get(config['version'], {})
    kept = {'sources': former['sources']} if 'sources' in former else {}
    written = versions.write({'version': config['version'], 'system': given.system, **kept, 'run': False,
                              'classes': found})
    print('YADE %s: %d classes in %s' % (config['version'], len(found), written))


if __name__ == '__main__':
    main()
