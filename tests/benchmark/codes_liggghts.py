"""LIGGGHTS, Debian's, for codes.py; see codes_lammps.py, whose files it takes.

Its model hooke/stiffness with the tangential model history is YADE's law. Facets are a mesh in an STL file.
"""
import os
import re
import shutil

import codes_lammps as lammps


def script(arrays, about, warm, steps):
    """LIGGGHTS's input."""
    most = int(lammps.kinds(arrays, about).max())
    of = lambda value: f'peratomtypepair {most} ' + ' '.join([repr(value)] * most ** 2)  # noqa: E731
    model = 'model hooke/stiffness tangential history'
    lines = ['units si', 'atom_style granular', 'atom_modify map array', 'newton off', 'communicate single vel yes',
             'boundary s s s', 'read_data data', *lammps.groups(arrays),
             f'neighbor {lammps.SKIN * about["radius"]!r} bin',  # `multi` misses contacts of spheres of two types
             'neigh_modify delay 0 every 1 check yes page 1000000 one 100000',
             f'fix kn all property/global kn {of(about["kn"])}', f'fix kt all property/global kt {of(about["kt"])}',
             f'fix gamman all property/global gamman {of(0.)}', f'fix gammat all property/global gammat {of(0.)}',
             f'fix friction all property/global coefficientFriction {of(about["friction"])}',
             f'pair_style gran {model}', 'pair_coeff * *', f'timestep {about["dt"]!r}']
    if 'facets' in about:
        lines += ['fix hopper all mesh/surface file facets.stl type 1',
                  f'fix walls all wall/gran {model} mesh n_meshes 1 meshes hopper']
    lines += lammps.motion(arrays, about)
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


def measure(folder, warm, steps, processes, limit):
    """As codes_lammps.measure."""
    arrays, about = lammps.start(folder)
    lammps.writeData(os.path.join(folder, 'data'), arrays, about)
    if 'facets' in about:
        writeFacets(os.path.join(folder, 'facets.stl'), about['facets'])
    with open(os.path.join(folder, 'in.liggghts'), 'w') as out:
        out.write(script(arrays, about, warm, steps))
    text = lammps.run('liggghts', folder, processes, limit, '-in', 'in.liggghts', '-log', 'none')
    # The fixes, integration among them, are in `Other`.
    mean = lambda name: float(re.findall(rf'^{name} +time \(%\) = (\S+)', text, re.M)[1]) / steps  # noqa: E731
    return dict(search=mean('Neigh'), forces=mean('Pair'), integration=mean('Other'), **lammps.common(text, steps))


def exists():
    """True if it is installed."""
    return bool(shutil.which('liggghts'))
