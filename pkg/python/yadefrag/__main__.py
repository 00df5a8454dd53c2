"""`python3 -m yadefrag`: runs a separate yade, since this Python does not have YADE."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from yadefrag._built import COMMAND

_PROGRAM = """
import sys
import yadefrag
with open(%r, 'w', encoding='utf-8') as report:
    well = yadefrag.about(lambda line: print(line, file=report))
sys.exit(0 if well else 1)
"""

def main() -> int:
    """Prints the report of yadefrag.about() in a new yade; returns 0 if all checks succeed, else 1."""
    yade = shutil.which(COMMAND) or '/usr/bin/yade'
    if not os.path.exists(yade):
        print('yadefrag: there is no command `yade` on this system; install the package yade.', file=sys.stderr)
        return 1
    package = str(pathlib.Path(__file__).absolute().parent.parent)
    path = os.pathsep.join(filter(None, [package, os.environ.get('PYTHONPATH')]))
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        program, report = (os.path.join(folder, name) for name in ('program.py', 'report'))
        pathlib.Path(program).write_text(_PROGRAM % report, encoding='utf-8')
        done = subprocess.run([yade, '-n', '-x', program], cwd=folder, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, env={**os.environ, 'PYTHONPATH': path}, check=False)
        if os.path.exists(report):
            print(pathlib.Path(report).read_text(encoding='utf-8'), end='')
        else:
            lines = [line for line in (done.stdout + done.stderr).splitlines() if line.strip()]
            print('yadefrag does not load in %s: %s' % (yade, lines[-1] if lines else 'no output'), file=sys.stderr)
    return 0 if done.returncode == 0 else 1


if __name__ == '__main__':  # the package was imported before
    sys.exit(main())
