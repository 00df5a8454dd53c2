"""One run of tradeoff() or ensemble() as a process: a new yade.

This file needs only Python's standard library: workers of an executor, which have no YADE, load it
by its path.
"""

import json
import os
import signal
import subprocess
import tempfile
from typing import Any

_live = set()  # running processes
# Environment variables of a worker started by MPI: its yade is not part of that MPI job.
_OF_MPI = ('OMPI_', 'PMIX_', 'PMI_', 'MPI_', 'HYDRA_', 'PRTE_')


def perform(job: dict[str, Any]) -> dict[str, Any]:
    """The result of a run, a dict as run_in_yade.perform returns it.

    job  JSON of the input of run_in_yade.py, and `yade`, `program`, `package` (paths), `inside` (name
         of a variable), `limit` (s)
    """
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        jobFile, resultFile, log = (os.path.join(folder, n) for n in ('job', 'result', 'log'))
        with open(jobFile, 'w', encoding='utf-8') as f:
            json.dump(job, f)
        threads = job['settings'].get('threads', 1)
        command = [job['yade'], '-n', '-x', '-j%d' % threads, job['program'], jobFile, resultFile]
        with open(log, 'w', encoding='utf-8') as output:
            process = subprocess.Popen(command, env=_environment(job), stdin=subprocess.DEVNULL,
                                       stdout=output, stderr=output, start_new_session=True)
            _live.add(process)
            try:
                process.wait(timeout=job['limit'])
            except subprocess.TimeoutExpired:
                return dict(result='too long', message='no result within %g s.' % job['limit'])
            finally:
                _end(process)
                _live.discard(process)
        if not os.path.exists(resultFile):
            with open(log, encoding='utf-8', errors='replace') as f:
                last = [line.strip() for line in f if line.strip()][-1:]
            return dict(result='failed', message='yade ended with status %d: %s' %
                        (process.returncode, ''.join(last)[:200]))
        with open(resultFile, encoding='utf-8') as f:
            return json.load(f)


def endAll() -> None:
    """Ends the runs of this process."""
    for process in list(_live):
        _end(process)


def _end(process):
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def _environment(job):
    kept = {k: v for k, v in os.environ.items() if not k.startswith(_OF_MPI)}
    path = os.pathsep.join([job['package']] + kept.get('PYTHONPATH', '').split(os.pathsep))
    return dict(kept, PYTHONPATH=path.rstrip(os.pathsep), **{job['inside']: '1'})
