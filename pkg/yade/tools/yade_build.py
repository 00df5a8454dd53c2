#!/usr/bin/env python3
"""yade_build.py LIBRARIES [SOURCE]: what a YADE says of its own build, and the flags that its headers need.

LIBRARIES is the folder of its libraries, which has py/yade/config.py. Prints, line by line: version, source
tree (SOURCE, or where it was built from), features, name of the command, then a flag of the compiler in each line. Exit code 2
and one sentence: no plugin can be built against the headers of this YADE.
"""

import pathlib
import re
import subprocess
import sys

# Macros that YADE's CMakeLists.txt defines for a feature; other features do not change the headers.
DEFINES = {
    'LOGGER': ['YADE_BOOST_LOG', 'BOOST_LOG_DYN_LINK'], 'COMPLEX_MP': ['YADE_COMPLEX_MP'],
    'MPFR': ['YADE_MPFR'], 'VTK': ['YADE_VTK'], 'OPENMP': ['YADE_OPENMP'], 'GTS': ['YADE_GTS'],
    'QT5': ['YADE_OPENGL', 'YADE_QT5', 'QT_NO_KEYWORDS'], 'CGAL': ['YADE_CGAL'],
    'PFVFLOW': ['FLOW_ENGINE'], 'LINSOLV': ['LINSOLV'], 'MPI': ['YADE_MPI'],
    'TWOPHASEFLOW': ['TWOPHASEFLOW'], 'LS_DEM': ['YADE_LS_DEM'], 'FEMLIKE': ['YADE_FEM'],
    'GL2PS': ['YADE_GL2PS'], 'LBMFLOW': ['LBM_ENGINE'], 'THERMAL': ['THERMAL'],
    'PARTIALSAT': ['PARTIALSAT'], 'POTENTIAL_PARTICLES': ['YADE_POTENTIAL_PARTICLES'],
    'POTENTIAL_BLOCKS': ['YADE_POTENTIAL_BLOCKS'], 'SPH': ['YADE_SPH'],
    'DEFORM': ['YADE_DEFORM'], 'LIQMIGRATION': ['YADE_LIQMIGRATION'],
    'PROFILING': ['USE_TIMING_DELTAS', 'ISC_TIMING'], 'BODY_CALLBACK': ['YADE_BODY_CALLBACK'],
    'MASK_ARBITRARY': ['YADE_MASK_ARBITRARY', 'YADE_MASK_ARBITRARY_SIZE=256'],
}
# With these YADE's numbers or masks have other types, or are aligned by options that config.py does not
# list.
REFUSED = ('MASK_ARBITRARY', 'VECTORIZE')


def readConfig(libraries):
    """The build's features and version, the size of its floating-point numbers, its source tree."""
    text = (pathlib.Path(libraries) / 'py' / 'yade' / 'config.py').read_text()

    def value(name, otherwise=None):
        found = re.search(r"^%s\s*=\s*'?([^'\n]*)" % name, text, re.M)
        if not found and otherwise is None:
            raise ValueError('no %s in %s/py/yade/config.py' % (name, libraries))
        return found.group(1) if found else otherwise

    return {'version': value('version'), 'features': value('features').split(),
            'bits': int(value('highPrecisionBits')),
            'decimals': int(value('highPrecisionDecimalPlaces')), 'source': value('sourceRoot', ''),
            'command': 'yade' + value('suffix', '')}


def compilerFlags(config):
    """Flags that give YADE's headers the layout of this build."""
    defines = ['YADE_REAL_BIT=%d' % config['bits'], 'YADE_REAL_DEC=%d' % config['decimals'],
               'YADE_ODEINT', 'MAX_LOG_LEVEL=5', 'BOOST_BIND_GLOBAL_PLACEHOLDERS']
    for feature in config['features']:
        defines += DEFINES.get(feature, [])
    if 'VECTORIZE' not in config['features']:
        defines += ['EIGEN_DONT_VECTORIZE', 'EIGEN_DONT_ALIGN',
                    'EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT']
    flags = ['-D' + define for define in dict.fromkeys(defines)]
    if 'OPENMP' in config['features']:
        flags.append('-fopenmp')
    return flags


def headOf(source):
    """The commit of a Git checkout; '' if there is no Git or no checkout."""
    try:
        done = subprocess.run(['git', '-c', 'safe.directory=*', '-C', str(source), 'rev-parse', 'HEAD'],
                              capture_output=True, text=True, check=False)
    except OSError:
        return ''
    return done.stdout.strip() if done.returncode == 0 else ''


def problemOf(config, libraries, source):
    """'' or the reason why no plugin can be built against the headers of this YADE."""
    if config['bits'] != 64:
        return 'the YADE in %s has numbers of %d bits, and yadefrag needs 64 (double).' % (
            libraries, config['bits'])
    refused = [feature for feature in REFUSED if feature in config['features']]
    if refused:
        return 'the YADE in %s was built with %s, with which yadefrag does not work.' % (
            libraries, ' and '.join(refused))
    if 'OPENMP' not in config['features']:
        return 'the YADE in %s was built without OPENMP, which yadefrag needs.' % libraries
    if not (pathlib.Path(source) / 'core' / 'Scene.hpp').exists():
        return '%s is no source tree of YADE: it has no core/Scene.hpp; give it as YADE_SOURCE.' % (source or "''")
    commit = re.search(r'git-([0-9a-f]+)', config['version'])
    there = headOf(source) if commit else ''
    if there and not there.startswith(commit.group(1)):
        return ('the sources in %s are at the commit %s, and the YADE in %s was built from %s: build YADE again, or '
                'check out that commit.' % (source, there[:len(commit.group(1))], libraries, commit.group(1)))
    release = pathlib.Path(source) / 'RELEASE'
    given = release.read_text().strip() if release.exists() else ''
    if given and re.fullmatch(r'[\w.]+', config['version']) and given != config['version']:
        return 'the sources in %s are those of YADE %s, and the YADE in %s is %s.' % (
            source, given, libraries, config['version'])
    return ''


def main(libraries, source=''):
    try:
        config = readConfig(libraries)
    except (OSError, ValueError) as error:
        print('no YADE in %s: %s' % (libraries, error))
        return 2
    source = source or config['source']
    problem = problemOf(config, libraries, source)
    if problem:
        print(problem)
        return 2
    # RealHP's other precisions are not used here; without them the headers are compiled faster.
    print('\n'.join([config['version'], source, ' '.join(config['features']), config['command'],
                     '-DYADE_DISABLE_REAL_MULTI_HP',
                     *compilerFlags(config)]))
    return 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
