"""An elastic cylinder of 10 mm hits a block of 40 × 20 mm at 20 m/s: CalculiX beside ours.

    tests/benchmark/fe_ccx.py [--program build/release/tests/yadefrag_bench] [--across 10]

CalculiX (Debian: apt-get install calculix-ccx) steps the same triangles explicitly. Its plane
elements do not take an initial velocity together with explicit contact (the velocity of the
cylinder is spoiled in the first increment), so each triangle becomes a wedge C3D6 between two layers
of nodes that are held in z, which is plane strain with twice the nodes. Contact is its penalty
contact NODE TO SURFACE, ours without penetration. It chooses its own increment (DIRECT stops it).
Its explicit contact stays soft with any stiffness (10¹⁴ to 10¹⁶ Pa/m give the same
contact of 15 µs instead of 11): a plain explicit code of 50 lines on the same mesh gave our course
with springs of 10¹² N/m a node and CalculiX's with 10¹¹ N/m. So the answers differ by that.
"""
import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
UNTIL = 20e-6  # s, as in fe_impact_bench.cpp
DEPTH = 1e-3  # m, of a wedge
STIFFNESS = 1e15  # Pa/m, of the penalty contact
EVERY = 10  # increments between two records
TIMEOUT = 600  # s, for one run of ccx


def main(arguments):
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument('--program', default=os.path.join(ROOT, 'build/release/tests/yadefrag_bench'))
    parser.add_argument('--across', type=int, default=10, choices=(10, 20))
    parser.add_argument('--repeat', type=int, default=3)
    options = parser.parse_args(arguments)
    print('\n'.join(compare(options.program, options.across, options.repeat)[0]))


def compare(program, across, repeat):
    """(lines of Markdown, figures for measured_tables or None).

    The lines report what is missing if ccx is not installed or fails.
    """
    if not shutil.which('ccx'):
        return ['CalculiX is not installed: `apt-get install calculix-ccx`, then run this again.'], None
    with tempfile.TemporaryDirectory() as folder:
        ours = runOurs(program, across, repeat, folder)
        mesh = readMesh(os.path.join(folder, 'mesh.txt'))
        with open(os.path.join(folder, 'impact.inp'), 'w') as f:
            f.write(deck(mesh))
        theirs = runTheirs(folder, repeat)
        if isinstance(theirs, str):
            return [theirs], None
        theirs['course'] = readCourse(os.path.join(folder, 'impact.dat'), mesh)
    return table(ours, theirs), figures(ours, theirs)


def runOurs(program, across, repeat, folder):
    """dict: triangles, steps, dt (s), seconds (median), course [(time, velocity)]."""
    command = [program, f'--benchmark_filter=^impact-course/{across}/', '--benchmark_format=json',
               f'--benchmark_repetitions={repeat}']
    done = subprocess.run(command, env=dict(os.environ, FE_IMPACT=folder), check=True, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    rows = [b for b in json.loads(done.stdout)['benchmarks'] if b['run_type'] == 'iteration']
    with open(os.path.join(folder, 'course.txt')) as f:
        course = [tuple(map(float, line.split())) for line in f]
    return dict(triangles=int(rows[0]['triangles']), steps=int(rows[0]['steps']), dt=rows[0]['dt'],
                seconds=statistics.median(b['real_time'] for b in rows) / 1e3, course=course)


def runTheirs(folder, repeat):
    """dict: seconds (median, without ccx's start); or a sentence with the error."""
    times = []
    for _ in range(repeat):
        start = time.perf_counter()
        try:
            done = subprocess.run(['ccx', 'impact'], cwd=folder, timeout=TIMEOUT, text=True,
                                  env=dict(os.environ, OMP_NUM_THREADS='1'), check=False,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        except subprocess.TimeoutExpired:
            return f'ccx was stopped after {TIMEOUT} s.'
        times.append(time.perf_counter() - start)
        if done.returncode or '*ERROR' in done.stdout:
            return 'ccx failed: ' + ' '.join(done.stdout.split())[-300:]
    return dict(seconds=statistics.median(times))


# --- CalculiX's files -----------------------------------------------------------------------------
def readMesh(file):
    """dict of lists: node (x, y, held, component, mass), triangle (a, b, c, component), boundary."""
    mesh = dict(node=[], triangle=[], boundary=[])
    with open(file) as f:
        for line in f:
            kind, *values = line.split()
            numbers = [float(v) if kind == 'node' and i in (0, 1, 4) else int(v)
                       for i, v in enumerate(values)]
            mesh[kind].append(numbers)
    return mesh


def deck(mesh):
    """The input file: two layers of nodes, wedges, contact near the first touch."""
    nodes, layer = mesh['node'], len(mesh['node'])
    faces = {}  # boundary edge → element, face of the wedge
    for e, (a, b, c, _) in enumerate(mesh['triangle'], 1):
        faces.update({(a, b): (e, 3), (b, c): (e, 4), (c, a): (e, 5)})
    out = ['*NODE, NSET=ALL']
    out += [f'{n + 1 + k * layer}, {x:.12e}, {y:.12e}, {k * DEPTH}'
            for k in (0, 1) for n, (x, y, *_) in enumerate(nodes)]
    for body in (0, 1):
        out.append(f'*ELEMENT, TYPE=C3D6, ELSET=BODY{body}')
        for e, (*corners, component) in enumerate(mesh['triangle'], 1):
            if component == body:
                wedge = [n + 1 + k * layer for k in (0, 1) for n in corners]
                out.append(', '.join(map(str, [e] + wedge)))
    inBoth = lambda chosen: [n + 1 + k * layer for k in (0, 1) for n in chosen]
    out += _set('HELD', inBoth(n for n in range(layer) if nodes[n][2]))
    out += _set('CYLINDER', inBoth(n for n in range(layer) if nodes[n][3] == 1))
    out += _set('FRONT', [n + 1 for n in range(layer) if nodes[n][3] == 1])
    out += ['*MATERIAL, NAME=STEEL', '*ELASTIC', '210e9, .3', '*DENSITY', '7800.']
    out += [f'*SOLID SECTION, ELSET=BODY{body}, MATERIAL=STEEL' for body in (0, 1)]
    out += ['*BOUNDARY', 'HELD, 1, 2', 'ALL, 3, 3',
            '*INITIAL CONDITIONS, TYPE=VELOCITY', 'CYLINDER, 2, -20.']
    near = [(a, b, body) for a, b, body in mesh['boundary'] if _isNear(nodes[a], nodes[b], body)]
    slaves = sorted({n for a, b, body in near if body == 1 for n in (a, b)})
    out += ['*SURFACE, NAME=SLAVES, TYPE=NODE'] + [f'{n},' for n in inBoth(slaves)]
    out += ['*SURFACE, NAME=MASTERS']
    out += ['{}, S{}'.format(*faces[a, b]) for a, b, body in near if body == 0]
    out += ['*SURFACE INTERACTION, NAME=TOUCH',
            '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR', f'{STIFFNESS:g},',
            '*CONTACT PAIR, INTERACTION=TOUCH, TYPE=NODE TO SURFACE', 'SLAVES, MASTERS',
            '*STEP, INC=1000000, NLGEOM', '*DYNAMIC, EXPLICIT', f'5e-8, {UNTIL:g}',
            f'*NODE PRINT, NSET=FRONT, FREQUENCY={EVERY}', 'V', '*END STEP', '']
    return '\n'.join(out)


def _isNear(a, b, body):
    """May an edge of the boundary touch: the block's upper side, the cylinder's lower quarter."""
    if body == 0:
        return max(abs(a[1]), abs(b[1])) < 1e-9 and abs(a[0]) < 5e-3
    return max(a[1], b[1]) < 2.5e-3


def _set(name, numbers):
    return [f'*NSET, NSET={name}'] + [', '.join(map(str, numbers[i:i + 12])) + ','
                                      for i in range(0, len(numbers), 12)]


def readCourse(file, mesh):
    """[(time, mean velocity of the cylinder)] from ccx's table of velocities."""
    masses = [node[4] for node in mesh['node']]
    total = sum(node[4] for node in mesh['node'] if node[3] == 1)
    course = []
    with open(file) as f:
        for line in f:
            words = line.split()
            if 'time' in words:
                course.append([float(words[-1]), 0.])
            elif words:
                course[-1][1] += masses[int(words[0]) - 1] * float(words[2]) / total
    return [tuple(row) for row in course]


# --- the table ------------------------------------------------------------------------------------
def figures(ours, theirs):
    """Triangles, ms per step of CalculiX and of yadefrag, ratio of the lengths of the steps."""
    increments = EVERY * len(theirs['course'])
    return dict(triangles=ours['triangles'], theirs=1e3 * theirs['seconds'] / increments,
                ours=1e3 * ours['seconds'] / ours['steps'], dtRatio=ours['dt'] * increments / UNTIL)


def table(ours, theirs):
    """Markdown lines."""
    increments = EVERY * len(theirs['course'])
    rows = [('steps to 20 µs', f"{ours['steps']}", f'about {increments}'),
            ('Δt, ns', f"{1e9 * ours['dt']:.1f}", f'{1e9 * UNTIL / increments:.1f}'),
            ('time per step, µs', f"{1e6 * ours['seconds'] / ours['steps']:.1f}",
             f"{1e6 * theirs['seconds'] / increments:.0f}"),
            ('time for all, s', f"{ours['seconds']:.4f}", f"{theirs['seconds']:.2f}")]
    for moment in (2e-6, 4e-6, 6e-6, 8e-6, 10e-6):
        rows.append((f'cylinder at {1e6 * moment:.0f} µs, m/s', f"{_at(ours['course'], moment):.2f}",
                     f"{_at(theirs['course'], moment):.2f}"))
    rows.append(('after rebound, m/s', f"{ours['course'][-1][1]:.2f}",
                 f"{theirs['course'][-1][1]:.2f}"))
    furthest = max(abs(_at(ours['course'], t) - v) for t, v in theirs['course'])
    return ([f"Impact, {ours['triangles']} triangles, one thread, CalculiX with start and input.", '',
             '| | yadefrag | CalculiX |', '|---|---|---|']
            + ['| ' + ' | '.join(row) + ' |' for row in rows]
            + ['', f'Largest difference of the velocities: {furthest:.2f} m/s of 20.'])


def _at(course, moment):
    """Velocity at a moment, between two records."""
    for (t0, v0), (t1, v1) in zip(course, course[1:]):
        if t0 <= moment <= t1:
            return v0 + (v1 - v0) * (moment - t0) / (t1 - t0)
    return course[0][1] if moment < course[0][0] else course[-1][1]


if __name__ == '__main__':
    main(sys.argv[1:])
