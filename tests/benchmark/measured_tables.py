"""Figures of the pages, each from one source: a file in docs/data, which a command writes.

    python3 tests/benchmark/measured_tables.py      fills all pages anew; the benchmarks do so with --readme

docs/data/NAME.csv begins with a line '# machine, date, commit, command'. On a page a table stands between
`<!-- table: NAME -->` and `<!-- end of table -->`, a figure between `<!-- figure: NAME -->` and `<!-- end -->`. TABLES and
FIGURES below make their text. tests/docs_test.py compares the pages with it.
"""
import argparse
import csv
import functools
import json
import math
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'examples'))
import origin  # noqa: E402

DATA = ROOT / 'docs' / 'data'
TABLE = re.compile(r'(<!-- table: (.*?) -->\n).*?(<!-- end of table -->)', re.S)
FIGURE = re.compile(r'(<!-- figure: (.*?) -->)[^<]*(<!-- end -->)')


# --- files ----------------------------------------------------------------------------------------
def read(name):
    """(line about it, rows as dicts) of docs/data/NAME.csv."""
    about, *lines = (DATA / f'{name}.csv').read_text().splitlines()
    return about.lstrip('# '), list(csv.DictReader(lines))


def write(name, about, rows):
    """Stores rows, dicts with the same keys, and fills the pages anew.

    ValueError if the sources differed from the commit: such figures cannot be measured again.
    """
    if '-dirty' in about:
        raise ValueError(f'the figures are of sources that are not committed: {about}')
    with open(DATA / f'{name}.csv', 'w', newline='') as file:
        file.write(f'# {about}\n')
        out = csv.DictWriter(file, list(rows[0]), lineterminator='\n')
        out.writeheader()
        out.writerows(rows)
    fillPages()


def pages():
    """All pages that may show figures."""
    return [ROOT / 'README.md', ROOT / 'CONTRIBUTING.md', *sorted((ROOT / 'docs').glob('*.md')),
            *sorted((ROOT / 'examples').glob('*/README.md')), ROOT / 'lib' / 'README.md', ROOT / 'pkg' / 'README.md']


def filled(text):
    """A page with its tables and figures."""
    text = TABLE.sub(lambda match: match[1] + TABLES[match[2]]() + '\n' + match[3], text)
    return FIGURE.sub(lambda match: match[1] + FIGURES[match[2]]() + match[3], text)


def fillPages():
    """Write those that change."""
    for page in pages():
        text = page.read_text()
        if filled(text) != text:
            page.write_text(filled(text))


def parser(name, doc):
    """The options of a benchmark `scripts/bench NAME` whose table goes into the manual."""
    found = argparse.ArgumentParser(prog=f'scripts/bench {name}', description=doc,
                                    formatter_class=argparse.RawDescriptionHelpFormatter)
    found.add_argument('--readme', action='store_true', help='write the table into docs/data and the pages')
    found.add_argument('--out', default=str(ROOT / 'out' / 'bench'))
    found.add_argument('--yade', default=str(ROOT / 'scripts' / 'yade'))
    return found


def publish(options, name, rows, about):
    """Write NAME.md to the folder of the options, print it, and store the rows if requested."""
    text = markdown(rows, about)
    folder = pathlib.Path(options.out)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f'{name}.md').write_text(text + '\n')
    print(text)
    if options.readme:
        write(name, about, rows)


# --- measurements -----------------------------------------------------------------------------------
def measuredBy(options, script, *arguments, threads=1, limit=None):
    """The line of JSON that a script of this folder prints in a yade of its own; RuntimeError without one."""
    command = [options.yade, '-n', '-x', f'-j{threads}', str(pathlib.Path(__file__).with_name(script)), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=limit, check=False)
    rows = [line for line in done.stdout.splitlines() if line[:1] in ('{', '[')]
    if not rows:
        said = [line for line in done.stderr.splitlines() if line.strip()] or ['no message']
        raise RuntimeError(f'yade ended with status {done.returncode}: {said[-1]}')
    return json.loads(rows[-1])


def machineOf(rows):
    """Machine, date, versions."""
    return dict(machine=origin.machine(), date=origin.date(), commit=origin.commit(),
                yade=next((row['yade'] for row in rows if 'yade' in row), 'unknown'))


def line(machine, used='one used'):
    """The machine in one line."""
    return f"{machine['machine']} ({used}), {machine['date']}, YADE {machine['yade']}, commit {machine['commit']}"


# --- tables ---------------------------------------------------------------------------------------
def markdown(rows, about):
    """A table; columns of numbers are right-aligned."""
    head = list(rows[0])
    isNumber = [all(re.match(r'[\d.+−–-]', row.get(name) or '–') for row in rows) for name in head]
    lines = ['| ' + ' | '.join(head) + ' |', '|' + '|'.join('--:' if one else '---' for one in isNumber) + '|']
    lines += ['| ' + ' | '.join(row.get(name) or '–' for name in head) + ' |' for row in rows]
    return '\n'.join(lines) + f'\n\n{about[0].upper()}{about[1:]}.'


def whole(name):
    """The table of a file as it is."""
    about, rows = read(name)
    return markdown(rows, about)


CODES = {'YADE': 'YADE', 'collider': '+ `LebesgueCollider`', 'loop': '+ `CurveLoop`', 'integrator': '+ `CurveLoop`, `CurveIntegrator`',
         'LIGGGHTS': 'LIGGGHTS', 'LAMMPS': 'LAMMPS'}
SCENES = {'gas': 'gas of equal spheres', 'packing': 'dense packing', 'polydisperse': 'gas, radii 1 : 20',
          'stirred': 'packing that a bar stirs', 'hopper': 'hopper of facets'}
SIZE = '100000'


def steps(scene, size=SIZE, threads='1'):
    """{code: ms per step}."""
    return {row['code']: float(row['step']) for row in read('codes')[1]
            if (row['scene'], row['spheres'], row['threads']) == (scene, size, threads)}


def codesInShort():
    """One line for each scene: ms per step."""
    about = read('codes')[0]
    rows = []
    for scene, name in SCENES.items():
        ms = steps(scene)
        rows.append({f'ms per step of {int(SIZE):,} spheres': name, 'YADE': digits(ms['YADE']),
                     'YADE with our engines': digits(ms['integrator']), 'times faster': f'{ms["YADE"] / ms["integrator"]:.1f}',
                     'LIGGGHTS': digits(ms['LIGGGHTS']), 'LAMMPS': digits(ms['LAMMPS'])})
    return markdown(rows, 'one thread, ' + re.sub(r' \(as .*?\)|; .*', '', about))


def codes():
    """All of 100,000 spheres: a step with one and with two threads."""
    about, stored = read('codes')
    rows = {}
    for row in stored:
        if row['spheres'] == SIZE:
            line = rows.setdefault(row['scene'], {'scene': row['scene'], 'contacts': f'{int(row["contacts"]):,}'})
            name = CODES[row['code']]
            line[name] = f'{line[name]}, {row["step"]}' if name in line else row['step']
    return markdown(list(rows.values()), f'milliseconds per step of {int(SIZE):,} spheres with one thread, with two. {about}')


def codesOfOtherSizes():
    """Ten thousand and a million, one thread: a step and memory."""
    about, stored = read('codes_sizes')
    rows = {}
    for row in stored:
        if row['threads'] == '1':
            line = rows.setdefault((row['scene'], row['spheres']),
                                   {'scene': SCENES[row['scene']], 'spheres': f'{int(row["spheres"]):,}'})
            line[CODES[row['code']]] = f'{row["step"]}; {row["memory"]}'
    return markdown(list(rows.values()), f'milliseconds per step; MB. {about}')


def searchesOfColliders():
    """First and later searches of both colliders."""
    about, stored = read('colliders')
    rows = [{'scene': row['scene'],
             'first search, ms': f'{row["first YADE"]} → {row["first"]}', '×': ratio(float(row['first YADE']) / float(row['first'])),
             'later search, ms': f'{row["later YADE"]} → {row["later"]}', '× ': ratio(float(row['later YADE']) / float(row['later']))}
            for row in stored]
    return markdown(rows, about)


def validation():
    """Tests against theory: what was required and what they recorded."""
    about, _ = read('figures')
    import validation_table  # which imports this module
    return markdown(validation_table.rows(), f'bold: misses what is required. {about}')


TIMES = {'plugin': "the plugin's build", 'all': 'build of all', 'impact': '`scripts/impact`', 'spheres': '`scripts/spheres`',
         'test': '`scripts/test`', 'edit': 'an edit of one source of `lib`, with its test'}


def times():
    """Commands from an empty folder."""
    about, stored = read('times')
    rows = [{'from an empty folder': TIMES[row['command']], 'wall, s': row['wall'], 'processor, s': row['processor'], 'R': row['R']}
            for row in stored]
    return markdown(rows, about)


def taylor():
    """Cylinders on a wall: measured and computed. Bold: misses 5 % of the length, 10 % of the foot with friction."""
    about, stored = read('taylor')

    def beside(row, name, wanted, allowed=math.inf):
        off = float(row[name]) / float(row[wanted]) - 1
        text = f'{row[name]}, {100 * off:+.1f} %'.replace('-', '−')
        return f'**{text}**' if abs(off) > allowed else text

    rows = [{'material': row['material'], 'measured by': row['source'], 'mm': f'{row["length"]} × {row["diameter"]}',
             'm/s': row['speed'], 'length, mm': row['final'], 'computed': beside(row, 'computed final', 'final', .05),
             'foot, mm': row['foot'], 'computed, no friction': beside(row, 'computed foot', 'foot'),
             'friction .1': beside(row, 'foot with friction', 'foot', .1)} for row in stored]
    return markdown(rows, about)


TABLES = {'codes in short': codesInShort, 'codes': codes, 'codes of other sizes': codesOfOtherSizes,
          'searches of colliders': searchesOfColliders, 'times': times,
          'validation': validation, 'taylor': taylor,
          **{name: functools.partial(whole, name) for name in ('intervals', 'stirred', 'advice', 'mpi', 'sizes', 'small', 'cracks', 'bodies')}}


# --- figures --------------------------------------------------------------------------------------
def minutes(command):
    """'4 minutes' that a command takes."""
    seconds = float(next(row['wall'] for row in read('times')[1] if row['command'] == command))
    return f'{max(1, round(seconds / 60))} minutes' if seconds >= 90 else f'{seconds:.0f} s'


def gain(*scenes, to='integrator', of='YADE'):
    """'1.9 to 6.2' times faster, of one thread and 100,000 spheres."""
    found = sorted(ms[of] / ms[to] for ms in map(steps, scenes))
    return span(found)


def span(found):
    """'1.9 to 6.2', or one number."""
    low, high = (f'{value:.1f}' if value < 100 else f'{value:.0f}' for value in (found[0], found[-1]))
    return low if low == high else f'{low} to {high}'


FIGURES = {
    **{f'minutes of {command}': functools.partial(minutes, command) for command in TIMES},
    **{f'gain in {scene}': functools.partial(gain, scene) for scene in SCENES},
    'gain': functools.partial(gain, *SCENES),
    'gain of the collider': functools.partial(gain, *SCENES, to='collider'),
    'gain of loop and integrator': functools.partial(gain, *SCENES, of='collider'),
    'gain of two threads': lambda: span(sorted(steps(scene)['integrator'] / steps(scene, threads='2')['integrator']
                                               for scene in SCENES)),
    'over LAMMPS': lambda: span(sorted(steps(scene)['integrator'] / steps(scene)['LAMMPS'] for scene in SCENES)),
    'gain of searches': lambda: span(sorted(float(row['later YADE']) / float(row['later']) for row in read('colliders')[1])),
    'gain of tuning': lambda: span(sorted(float(row['step YADE']) / float(row['step tuned'])
                                          for row in read('colliders')[1] if row['step tuned'])),
    'chosen intervals': lambda: span(sorted(float(row['chosen over the best']) for row in read('intervals')[1])),
    'gain of order': lambda: span(sorted(float(row['×']) for row in read('stirred')[1])),
    **{name: functools.partial(lambda name: next(row['×'] for row in read('advice')[1] if row['a step'] == name), name)
       for name in ('O.trackEnergy', 'PyRunner, every step, through all bodies', 'PyRunner, every step, utils.kineticEnergy')},
}


# --- numbers --------------------------------------------------------------------------------------
def power(value):
    """'6.4·10⁻⁵'."""
    first, exponent = f'{value:.1e}'.split('e')
    raised = str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹')
    return f'{first}·10' + str(int(exponent)).translate(raised)


def ratio(value):
    """Two digits, or all before the point."""
    return f'{value:.2g}' if value < 10 else f'{value:.0f}'


def digits(value):
    """Three digits."""
    return f'{value:.0f}' if abs(value) >= 100 else f'{value:.3g}'


if __name__ == '__main__':
    fillPages()
