"""The files of pkg/yade/versions: layouts of YADE's classes, one file per version.

version     as in yade.config
system      the distribution of the package
sources     its source archive in Debian's pool, and the SHA-256 of that; not every version has it
run         true if this project has been tested with it; otherwise `import yadefrag` refuses it
classes     name: size and offsets in bytes, members as [name, type, offset], virtual functions as in
            check_virtuals.py
"""

import json
import pathlib
import re

FOLDER = pathlib.Path(__file__).resolve().parent.parent / 'versions'


def read(version):
    return json.loads((FOLDER / (version + '.json')).read_text())


def known():
    """{version: contents of its file}"""
    return {path.stem: read(path.stem) for path in sorted(FOLDER.glob('*.json'))}


def number(version):
    """202302 of '2023.02a': the number for the preprocessor."""
    year, month = re.match(r'(\d+)\.(\d+)', version).groups()
    return 100 * int(year) + int(month)


def write(facts):
    """One line per member and table, so that diff compares two versions."""
    blocks = []
    for name, entry in sorted(facts['classes'].items()):
        members = ',\n'.join('   ' + json.dumps(row) for row in entry['members'])
        tables = ',\n'.join('   %s: [%s]' % (json.dumps(at), ',\n    '.join(map(json.dumps, names)))
                            for at, names in entry['virtuals'].items())
        blocks.append('  %s: {"size": %d,\n   "members": [%s],\n   "virtuals": {%s}}' % (
            json.dumps(name), entry['size'], '\n' + members if members else '',
            '\n' + tables if tables else ''))
    head = ',\n '.join('%s: %s' % (json.dumps(key), json.dumps(facts[key]))
                       for key in ('version', 'system', 'sources', 'run') if key in facts)
    path = FOLDER / (facts['version'] + '.json')
    path.write_text('{%s,\n "classes": {\n%s}}\n' % (head, ',\n'.join(blocks)))
    return path
