#!/usr/bin/env python3
"""make_table.py VERSION OWN HEADER MODULE: what the build needs of pkg/abi/versions/VERSION.json.

HEADER gets sizes and offsets, for the compiler; MODULE which YADE the extension is built for, and
OWN, the version of yadefrag, for Python. Exit code 2, and one sentence: that YADE is not known.
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

MODULE = '''"""What this build of yadefrag is, and which YADE it is for. Made by pkg/abi/tools/make_table.py."""

YADEFRAG = %(own)r
VERSION = %(version)r
SYSTEM = %(system)r
# Was this project run with it?
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
        print('yadefrag knows YADE %s, and not %s; "How to move to another YADE" in pkg/README.md '
              'says what to do.' % (', '.join(known), version or 'an unknown version'))
        return 2
    facts = known[version]
    writeIfNew(header, HEADER % {**facts, 'number': versions.number(version),
                                 'rows': '\n'.join(rows(facts['classes']))})
    accepted = {name: other['system'] for name, other in known.items() if other['run']}
    writeIfNew(module, MODULE % {**facts, 'own': own, 'accepted': accepted})
    return 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
