"""The project's folder, the yade that runs the tests, and commands in several MPI processes, all of which are ended."""
import os
import pathlib
import signal
import subprocess
import sys
import uuid


ROOT = pathlib.Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / 'examples'


def yadeCommand():
    """The yade that runs these tests; its PYTHONPATH is inherited."""
    return [getattr(sys, 'yade_argv', ['/usr/bin/yade'])[0], '-n', '-x']


kMark = 'YADEFRAG_MPI_RUN'
# Processes that share two cores, as root in a container.
kMpi = dict(OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1', OMP_NUM_THREADS='1',
            OMPI_MCA_rmaps_base_oversubscribe='1', OMPI_MCA_mpi_yield_when_idle='1',
            OMPI_MCA_btl_vader_single_copy_mechanism='none',
            # From Open MPI 5 on; processes that a process starts reach each other by the network only.
            PRTE_ALLOW_RUN_AS_ROOT='1', PRTE_ALLOW_RUN_AS_ROOT_CONFIRM='1', OMPI_MCA_btl_tcp_if_include='lo',
            PRTE_MCA_rmaps_default_mapping_policy=':oversubscribe')


def environment(mark):
    """Without what an MPI of this process itself has set."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(('OMPI_', 'PMIX_', 'ORTE_', 'PRTE_'))}
    return {**kept, **kMpi, kMark: mark}


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
    process = subprocess.Popen((['mpiexec', '-n', str(ranks)] if ranks > 1 else []) + command,
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
