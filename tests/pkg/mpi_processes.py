"""Runs a command in several MPI processes, and ends all of them. Without YADE: a benchmark uses it, too."""
import functools
import os
import signal
import subprocess
import uuid

kMark = 'YADEFRAG_MPI_RUN'
# Processes that share two cores, as root in a container.
kMpi = dict(OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1', OMP_NUM_THREADS='1',
            OMPI_MCA_rmaps_base_oversubscribe='1', OMPI_MCA_mpi_yield_when_idle='1',
            OMPI_MCA_btl_vader_single_copy_mechanism='none',
            PRTE_MCA_rmaps_default_mapping_policy=':oversubscribe')    # from Open MPI 5 on


def environment(mark):
    """Without what an MPI of this process itself has set."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(('OMPI_', 'PMIX_', 'ORTE_', 'PRTE_'))}
    return {**kept, **kMpi, kMark: mark}


# Starts one more process of itself, which ends at once.
kSpawn = '''import sys
from mpi4py import MPI
parent = MPI.Comm.Get_parent()
if parent == MPI.COMM_NULL:
    parent = MPI.COMM_SELF.Spawn(sys.executable, args=['-c', sys.argv[1], sys.argv[1]], maxprocs=1)
parent.Disconnect()
'''


@functools.cache
def starter():
    """What comes before the command of one process that starts others: mpiexec, where a process without
    it cannot start any (Debian 13's Open MPI 5)."""
    done = subprocess.run(['/usr/bin/python3', '-c', kSpawn, kSpawn], env=environment('probe'),
                          stdin=subprocess.DEVNULL, capture_output=True, timeout=60, check=False)
    return ['mpiexec', '-n', '1'] if done.returncode else []


def end(mark):
    """Ends all processes of one run, by their numbers: MPI puts them into groups of their own, and
    those whose parent has ended are no descendants any more."""
    for name in filter(str.isdigit, os.listdir('/proc')):
        try:
            with open('/proc/%s/environ' % name, 'rb') as file:
                isOne = ('%s=%s' % (kMark, mark)).encode() in file.read().split(b'\0')
            if isOne:
                os.kill(int(name), signal.SIGKILL)
        except OSError:
            continue    # ended meanwhile, or of another user


def run(ranks, command, folder, limit):
    """(exit code, output) of `command` in `ranks` processes; code None: no end within `limit` s."""
    mark = str(uuid.uuid4())
    start = ['mpiexec', '-n', str(ranks)] if ranks > 1 else starter()
    process = subprocess.Popen(start + command,
                               cwd=folder, env=environment(mark), stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        output = process.communicate(timeout=limit)[0].decode(errors='replace')
    except subprocess.TimeoutExpired:
        end(mark)
        process.communicate()
        return None, 'no end within %d s' % limit
    finally:
        end(mark)
    return process.returncode, output
