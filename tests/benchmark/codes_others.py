"""LAMMPS and LIGGGHTS, Debian's, for codes.py: the scene that codes_yade.py wrote, as their input; times and positions.

YADE's laws in the words of LAMMPS: gran/hooke/history, gran/hertz/history with the same stiffness along and across a
contact, no damping, and the same coefficient of friction. Debian's LAMMPS has no OPENMP package: threads are MPI
processes. LIGGGHTS's models hooke/stiffness and hertz with the tangential model history are YADE's laws. Facets are a
mesh in an STL file.
"""
import json
import math
import os
import re
import subprocess
import tempfile

import numpy as np

SKIN = .4  # radii of the smallest sphere


def start(folder):
    """(arrays, numbers) that codes_yade.py wrote."""
    with open(os.path.join(folder, 'start.json')) as file:
        about = json.load(file)
    return dict(np.load(os.path.join(folder, 'start.npz'))), about


def kinds(arrays, about):
    """(n) numbers from 1, two octaves of radii each, for searches of each size in a grid of its own: of one, two,
    three and four octaves and fractions of one, this is the fastest in the scene `polydisperse`."""
    return 1 + np.floor(.5 * np.log2(arrays['radii'] / about['radius']) + 1e-9).astype(int)


def writeData(path, arrays, about, margin=1):
    """The file of read_data: box, spheres, velocities."""
    n, places = len(arrays['radii']), arrays['places']
    room = arrays['radii'].max() + margin * about['radius']
    ids = np.arange(1, n + 1)
    types = kinds(arrays, about)
    with open(path, 'w') as out:
        out.write(f'spheres of YADE\n\n{n} atoms\n{types.max()} atom types\n\n')
        for axis, low, high in zip('xyz', places.min(0) - room, places.max(0) + room):
            out.write(f'{low:.17g} {high:.17g} {axis}lo {axis}hi\n')
        out.write('\nAtoms\n\n')
        np.savetxt(out, np.column_stack([ids, types, 2 * arrays['radii'], np.full(n, about['density']), places]),
                   fmt='%d %d %.17g %.17g %.17g %.17g %.17g')
        out.write('\nVelocities\n\n')
        np.savetxt(out, np.column_stack([ids, arrays['velocities'], arrays['spins']]), fmt='%d' + ' %.17g' * 6)


def groups(arrays):
    """Commands for the groups `held`, `bar` (if there are any) and `moved`, by forces: ids in lines of 200."""
    lines = []
    for name, members in (('held', arrays['fixed']), ('bar', arrays['bar'])):
        ids = np.flatnonzero(members) + 1
        lines += [f'group {name} id ' + ' '.join(map(str, ids[k:k + 200])) for k in range(0, len(ids), 200)]
    return [*lines, 'group moved subtract all held' if lines else 'group moved union all']


def motion(arrays, about):
    """Commands for the integration, gravity and the bar."""
    lines = ['fix integration moved nve/sphere']
    if about['gravity']:
        lines.append(f'fix gravity moved gravity {about["gravity"]!r} vector 0 0 -1')
    if arrays['bar'].any():
        lines.append(f'fix turning bar move rotate 0 0 0 0 0 1 {2 * math.pi / about["turn"]!r}')
    return lines


def lammpsScript(arrays, about, warm, steps):
    """LAMMPS's input."""
    most = int(kinds(arrays, about).max())
    law = f'{about["kn"]!r} {about["kt"]!r} 0 0 {about["friction"]!r} 0'
    lines = ['units si', 'atom_style sphere', 'newton on', 'boundary s s s', 'read_data data', *groups(arrays),
             f'pair_style gran/{about["law"]}/history {law}', 'pair_coeff * *',
             f'neighbor {SKIN * about["radius"]!r} ' + ('multi' if most > 1 else 'bin'),
             'comm_modify vel yes' + ' mode multi' * (most > 1),
             'neigh_modify delay 0 every 1 check yes page 1000000 one 100000', f'timestep {about["dt"]!r}',
             *motion(arrays, about)]
    for number, (point, normal) in enumerate(zip(*about.get('walls', ((), ())))):
        place = ' '.join(repr(x) for x in (*point, *normal))
        lines += [f'region wall{number} plane {place}',
                  f'fix wall{number} moved wall/gran/region hooke/history {law} region wall{number}']
    return '\n'.join(lines + ['thermo 1000000', f'run {warm}', f'run {steps} pre no',
                              'write_dump all custom end id x y z modify sort id format float %.17g']) + '\n'


def command(program, processes, *arguments):
    """The command line for so many processes."""
    if processes == 1:
        return [program, *arguments]
    # Without these options Open MPI does not run as root, nor more processes than there are cores.
    return ['mpirun', '--allow-run-as-root', '--oversubscribe', '-np', str(processes), program, *arguments]


def ended(folder):
    """(n, 3): the positions that were dumped, by id."""
    return np.loadtxt(os.path.join(folder, 'end'), skiprows=9)[:, 1:4]


def run(program, folder, processes, limit, *arguments):
    """(what a code printed, peak memory of its largest process in bytes); RuntimeError if it failed."""
    with tempfile.TemporaryFile('w+') as out:
        # wait4, since the resources of all children together do not tell the memory of one.
        code = subprocess.Popen(['timeout', str(limit), *command(program, processes, *arguments)], cwd=folder, stdout=out,
                                stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, env=dict(os.environ, OMP_NUM_THREADS='1'))
        _, status, used = os.wait4(code.pid, 0)
        code.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read()
    found = re.findall(r'ERROR.*', text)
    if code.returncode or found:
        raise RuntimeError(f'{program} ended with status {code.returncode}: {found[0] if found else text[-300:]}')
    return text, used.ru_maxrss * 1024


def measureLammps(folder, warm, steps, processes, limit):
    """{search, forces, integration, step: s per step; searches: number; memory: bytes} of one run; positions go to `end`."""
    arrays, about = start(folder)
    writeData(os.path.join(folder, 'data'), arrays, about)
    with open(os.path.join(folder, 'in.lammps'), 'w') as out:
        out.write(lammpsScript(arrays, about, warm, steps))
    text, memory = run('lmp', folder, processes, limit, '-in', 'in.lammps', '-log', 'none')
    # The second run is measured; the means over the processes.
    mean = lambda name: float(re.findall(rf'^{name} +\|[^|]*\| *(\S+)', text, re.M)[1]) / steps  # noqa: E731
    return dict(search=mean('Neigh'), forces=mean('Pair'), integration=mean('Modify'), memory=memory, **common(text, steps))


def common(text, steps):
    """What both codes print alike."""
    loops = re.findall(r'Loop time of (\S+)', text)
    builds = re.findall(r'Neighbor list builds = (\d+)', text)
    return dict(step=float(loops[1]) / steps, searches=int(builds[1]))


# --- LIGGGHTS

def liggghtsScript(arrays, about, warm, steps):
    """LIGGGHTS's input."""
    most = int(kinds(arrays, about).max())
    of = lambda value: f'peratomtypepair {most} ' + ' '.join([repr(value)] * most ** 2)  # noqa: E731
    isHertz = about['law'] == 'hertz'
    model = f'model {"hertz" if isHertz else "hooke/stiffness"} tangential history'
    # Restitution 1: no damping.
    constants = [f'fix kn all property/global kn {of(about["kn"])}', f'fix kt all property/global kt {of(about["kt"])}',
                 f'fix gamman all property/global gamman {of(0.)}', f'fix gammat all property/global gammat {of(0.)}']
    if isHertz:
        constants = [f'fix young all property/global youngsModulus peratomtype {about["young"]!r}',
                     f'fix poisson all property/global poissonsRatio peratomtype {about["poisson"]!r}',
                     f'fix restitution all property/global coefficientRestitution {of(1.)}']
    lines = ['units si', 'atom_style granular', 'atom_modify map array', 'newton off', 'communicate single vel yes',
             'boundary s s s', 'read_data data', *groups(arrays),
             f'neighbor {SKIN * about["radius"]!r} bin',  # `multi` misses contacts of spheres of two types
             'neigh_modify delay 0 every 1 check yes page 1000000 one 100000',
             *constants, f'fix friction all property/global coefficientFriction {of(about["friction"])}',
             f'pair_style gran {model}', 'pair_coeff * *', f'timestep {about["dt"]!r}']
    if 'facets' in about:
        lines += ['fix hopper all mesh/surface file facets.stl type 1',
                  f'fix walls all wall/gran {model} mesh n_meshes 1 meshes hopper']
    lines += motion(arrays, about)
    return '\n'.join(lines + ['thermo 1000000', f'run {warm}', f'run {steps} pre no',
                              'dump end all custom 1 end id x y z', 'dump_modify end sort id format "%d %.17g %.17g %.17g"',
                              'run 0 post no']) + '\n'


def writeFacets(path, facets):
    """An STL file."""
    with open(path, 'w') as out:
        out.write('solid hopper\n')
        for corners in facets:
            out.write('facet normal 0 0 0\nouter loop\n')
            out.writelines('vertex {:.17g} {:.17g} {:.17g}\n'.format(*corner) for corner in corners)
            out.write('endloop\nendfacet\n')
        out.write('endsolid hopper\n')


def measureLiggghts(folder, warm, steps, processes, limit):
    """As measureLammps."""
    arrays, about = start(folder)
    writeData(os.path.join(folder, 'data'), arrays, about)
    if 'facets' in about:
        writeFacets(os.path.join(folder, 'facets.stl'), about['facets'])
    with open(os.path.join(folder, 'in.liggghts'), 'w') as out:
        out.write(liggghtsScript(arrays, about, warm, steps))
    text, memory = run('liggghts', folder, processes, limit, '-in', 'in.liggghts', '-log', 'none')
    # The fixes, integration among them, are in `Other`.
    mean = lambda name: float(re.findall(rf'^{name} +time \(%\) = (\S+)', text, re.M)[1]) / steps  # noqa: E731
    return dict(search=mean('Neigh'), forces=mean('Pair'), integration=mean('Other'), memory=memory, **common(text, steps))
