#!/usr/bin/env python3
"""make_table.py VERSION OWN HEADER MODULE: generates files of the build from
pkg/abi/versions/VERSION.json.

HEADER: sizes and offsets, for the compiler. MODULE, for Python: the YADE version of this build and
the version of yadefrag, OWN. Exit code 2 and one sentence: this version of YADE is unknown.
"""

import pathlib
import sys

import versions

HEADER = '''#pragma once
// Made by pkg/abi/tools/make_table.py from pkg/abi/versions/%(version)s.json.

#include "abi/layout_entry.hpp"

#define YADEFRAG_YADE %(number)d

namespace yadefrag {

inline constexpr const char* kYadeVersion = "%(version)s";
inline constexpr const char* kYadeSystem = "%(system)s";

inline constexpr LayoutEntry kLayout[] = {
%(rows)s
};

}  // namespace yadefrag
'''

MODULE = '''"""This build of yadefrag and its version of YADE. Made by pkg/abi/tools/make_table.py."""

YADEFRAG = %(own)r
VERSION = %(version)r
SYSTEM = %(system)r
# True if this project has been tested with it.
RUN = %(run)r
# Every version that a build can be for.
ACCEPTED = %(accepted)r
'''


def rows(classes):
    for name, entry in sorted(classes.items()):
        yield '    {"%s", "", %d},' % (name, entry['size'])
        for member, _type, offset in entry['members']:
            yield '    {"%s", "%s", %d},' % (name, member, offset)


def writeIfNew(path, text):
    path = pathlib.Path(path)
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def main(version, own, header, module):
    known = versions.known()
    if version not in known:
        print('yadefrag supports YADE %s, and not %s; see "How to move to another YADE" in '
              'pkg/README.md.' % (', '.join(known), version or 'an unknown version'))
        return 2
    facts = known[version]
    writeIfNew(header, HEADER % {**facts, 'number': versions.number(version),
                                 'rows': '\n'.join(rows(facts['classes']))})
    accepted = {name: other['system'] for name, other in known.items() if other['run']}
    writeIfNew(module, MODULE % {**facts, 'own': own, 'accepted': accepted})
    return 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
