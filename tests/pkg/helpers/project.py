"""The project's folder, the yade that runs the tests; commands in several MPI processes, all of which are ended; examples."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import uuid

ROOT = pathlib.Path(__file__).resolve().parents[3]


def yadeCommand():
    """The yade that runs these tests; its PYTHONPATH is inherited."""
    return [getattr(sys, 'yade_argv', ['/usr/bin/yade'])[0], '-n', '-x']


def inYade(script, *arguments, timeout=300, options=(), **more):
    """The finished process of a script in a yade of its own; its stdout has stderr, too."""
    return subprocess.run([*yadeCommand(), *options, str(script), *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=timeout, **more)


def ran(*command, **more):
    """The finished process of a command; both of its outputs are texts."""
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, **more)


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


def runMpi(ranks, command, folder, limit):
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


# --- examples in a yade of their own, and the reports that they print

kExamples = os.path.join(ROOT, 'examples')
kSmall = os.path.join(kExamples, 'small')
# (s) Each takes seconds; on a machine that does much else besides, minutes.
kHanging = 600
kShort = {
    'squares': ['--n', '3', '--steps', '3000'],
    'rings': ['--n', '3', '--steps', '2000'],
    'bars': ['--n', '3', '--steps', '2000'],
    'cylinder': ['--size', '1e-3', '--steps', '400'],
    'rolling': ['--segments', '32', '--block', '.5', '--steps', '4000'],
    'impact': ['--size', '1e-3', '--steps', '400'],
}


def start(name, *options, stderr=subprocess.PIPE):
    # One thread: what OMP leaves behind must not slow down the tests.
    return subprocess.Popen(
        [*yadeCommand(), '-j1', os.path.join(kExamples, name, name + '.py'), *options],
        stdout=subprocess.PIPE, stderr=stderr, text=True)


def run(name, *options, status=0):
    """(standard output, standard error) of an example."""
    done = start(name, *options)
    try:
        out, complaints = done.communicate(timeout=kHanging)
    finally:
        done.kill()
    assert done.returncode == status, out[-1500:] + complaints[-1500:]
    return out, complaints


def rows(text):
    """The lines 'name: value' of all reports in `text`, as a list of dicts, one per report."""
    reports, found = [], {}
    for line in text.splitlines():
        match = re.match(r'(\w[^:]*):\s+(\S.*)', line)
        if match:
            found[match[1]] = match[2]
            if match[1] == 'positions (md5)':
                reports.append(found)
                found = {}
    return reports


def cells(text):
    """The table in `text` without the line below its head, as lists of texts."""
    lines = [line for line in text.splitlines() if line.startswith('|') and '--:' not in line]
    return [[cell.strip() for cell in line.strip('|').split('|')] for line in lines]


def numbers(text):
    return [float(n) for n in re.findall(r'[+-]?\d+\.?\d*(?:e[+-]?\d+)?', text.replace(',', ''))]


def checkReports(name, out):
    """Energy, contact and searches in the report of an example of kShort."""
    reports = rows(out)
    assert len(reports) == (2 if name == 'rolling' else 1)
    for report in reports:
        atEnd, atMost = numbers(report['energy drift'])
        assert abs(atEnd) < 5e-3 and atMost < 5e-3
        assert numbers(report['dissipated by contact'])[0] > -.5
        assert numbers(report['actives, last and most'])[1] > 0
        assert 0 < numbers(report['searches'])[0] < numbers(report['steps'])[0]
    return reports


def figures(name, folder, *options):
    """{what: [numbers]} of the lines 'what: words and numbers' that an example prints."""
    done = subprocess.run([*yadeCommand(), '-j1', os.path.join(kSmall, name + '.py'), folder, *options],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=kHanging)
    assert done.returncode == 0, done.stdout[-1500:] + done.stderr[-1500:]
    assert os.path.getsize(os.path.join(folder, name + '.png')) > 10000
    lines = [line.split(': ', 1) for line in done.stdout.splitlines() if ': ' in line]
    return {what: [float(n) for n in re.findall(r'(?<![\w.])-?\d+\.?\d*(?:e[+-]?\d+)?', rest)] for what, rest in lines}
