#!/usr/bin/env python3
"""make_table.py VERSION OWN FOLDER MODULE LIBRARIES: generates files of the build from
pkg/yade/versions/VERSION.json.
make_table.py --source SOURCE FEATURES YADE VERSION OWN FOLDER MODULE LIBRARIES: those of a build with YADE's
own headers; YADE is its command.

FOLDER gets layout_table.hpp, sizes and offsets for the compiler. MODULE describes this build and the YADE in
LIBRARIES for Python, with the version of yadefrag, OWN. Exit code 2 and one sentence: this version of YADE is
unknown.
"""

import pathlib
import sys

import versions

sys.path.append(str(pathlib.Path(__file__).parents[2] / 'python' / 'yadefrag'))
from build_id import buildId  # noqa: E402

TABLE = '''#pragma once
// Made by pkg/yade/tools/make_table.py from pkg/yade/versions/%(version)s.json.

#define YADEFRAG_YADE %(number)d

// SIZE(class, bytes), MEMBER(class, member, offset in bytes)
#define YADEFRAG_LAYOUT(SIZE, MEMBER) \\
%(rows)s
'''

MODULE = '''"""This build of yadefrag and its YADE. Made by pkg/yade/tools/make_table.py."""

YADEFRAG = %(own)r
VERSION = %(version)r
# For messages: "YADE <version> as ...".
BUILD = %(build)r
# Of its libyade.so; '' for one without.
BUILD_ID = %(id)r
# Features of a YADE whose own headers were used; None with the declarations of pkg/yade.
FEATURES = %(features)r
# The command of that YADE.
COMMAND = %(command)r
# Every version of a package for which a build can be made, with its system.
ACCEPTED = %(accepted)r
'''


def rows(classes):
    for name, entry in sorted(classes.items()):
        yield '  SIZE(%s, %d)' % (name, entry['size'])
        for member, _type, offset in entry['members']:
            if member.isidentifier():  # the others are tables of virtual functions
                yield '  MEMBER(%s, %s, %d)' % (name, member, offset)


def writeIfNew(path, text):
    path = pathlib.Path(path)
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def main(version, own, folder, module, libraries='', source=None, features=None, command='yade'):
    known = versions.known()
    if source is None and version not in known:
        print('yadefrag supports the packages of YADE %s, and not %s; a YADE that you build can have any version: '
              'see "With a YADE that you have built" in docs/getting_started.md.' % (
                  ', '.join(known), version or 'an unknown version'))
        return 2
    folder = pathlib.Path(folder)
    if source is None:
        facts = known[version]
        writeIfNew(folder / 'layout_table.hpp', TABLE % {
            'version': version, 'number': versions.number(version), 'rows': ' \\\n'.join(rows(facts['classes']))})
        build = '%s packages it' % facts['system']
    else:
        build = 'built from %s' % source
    accepted = {name: other['system'] for name, other in known.items() if other['run']}
    writeIfNew(module, MODULE % {
        'version': version, 'own': own, 'build': build, 'id': buildId(libraries), 'command': command, 'accepted': accepted,
        'features': None if features is None else sorted(features.split())})
    return 0


if __name__ == '__main__':
    if sys.argv[1:2] == ['--source']:
        sys.exit(main(*sys.argv[5:], source=sys.argv[2], features=sys.argv[3], command=sys.argv[4]))
    sys.exit(main(*sys.argv[1:]))
