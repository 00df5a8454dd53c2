"""The tables of README.md, from docs/data/measured.json, which the benchmarks write.

    measured_tables.keep('calculix', value)    stores the figures of one benchmark, and makes the tables anew

`figures` come from `scripts/bench figures`, `colliders` from `scripts/bench colliders --readme`,
`calculix` from `scripts/bench fe --readme`. Each has `about`: machine, date, commit.
"""
import argparse
import json
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILE = ROOT / 'docs' / 'data' / 'measured.json'
README = ROOT / 'README.md'
MANUAL = ROOT / 'docs' / 'measured.md'
SOURCES = ('colliders', 'figures', 'calculix')
MARKS = ('<!-- measured -->\n', '<!-- end of measured -->')
RIVAL, OURS = 'InsertionSortCollider', 'LebesgueCollider'


def keep(key, value):
    """Store the figures of one benchmark, and make the tables of the README anew once all three are there."""
    data = load()
    data[key] = value
    FILE.write_text(json.dumps(data, indent=1, ensure_ascii=False) + '\n')
    if all(source in data for source in SOURCES):
        fill(README, MARKS, tables(data))


def load():
    """All stored figures."""
    return json.loads(FILE.read_text()) if FILE.exists() else {}


def fill(page, marks, text):
    """Replace the text between two marks of a page."""
    whole = page.read_text()
    if whole.count(marks[0]) != 1 or whole.count(marks[1]) != 1:
        raise ValueError(f'{page} has no {marks[0].strip()} with {marks[1]}')
    before, rest = whole.split(marks[0])
    page.write_text(f'{before}{marks[0]}{text}{marks[1]}{rest.split(marks[1])[1]}')


def parser(name, doc):
    """The options of a benchmark `scripts/bench NAME` whose table goes into the manual."""
    found = argparse.ArgumentParser(prog=f'scripts/bench {name}', description=doc,
                                    formatter_class=argparse.RawDescriptionHelpFormatter)
    found.add_argument('--readme', action='store_true', help='write the table into docs/measured.md')
    found.add_argument('--out', default=str(ROOT / 'out' / 'bench'))
    found.add_argument('--yade', default=str(ROOT / 'scripts' / 'yade'))
    return found


def publish(options, name, text, marks):
    """Write NAME.md to the folder of the options, print it, and fill it into the manual if requested."""
    folder = pathlib.Path(options.out)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f'{name}.md').write_text(text)
    print(text)
    if options.readme:
        fill(MANUAL, marks, text)


def tables(data):
    """The three tables, as Markdown."""
    parts = [colliderTable(data['colliders']), elementTable(data['figures']['values'], data['calculix']),
             fractureTable(data['figures']['values'])]
    keys = {}
    for key in SOURCES:
        keys.setdefault(data[key]['about'], []).append(key)
    origin = '; '.join(f'{", ".join(names)}: {about}' for about, names in keys.items())
    return '\n\n'.join(parts) + f'\n\n`scripts/bench`: {origin}.\n'


# --- colliders ------------------------------------------------------------------------------------
def colliderTable(colliders):
    """Milliseconds per step of YADE's collider, default and tuned, and ours."""
    lines = [f'| colliders, {colliders["n"]:,} bodies, ms per step (collider, loop, integrator) | '
             'YADE\'s default, tuned | ours | × |', '|---|--:|--:|--:|']
    for scene, entry in colliders['scenes'].items():
        lines.append(f'| {scene} | {digits(entry["default"])}, {digits(entry["tuned"])} | '
                     f'{digits(entry["ours"])} | {ratio(entry["x"])}, {ratio(entry["t"])} |')
    return '\n'.join(lines)


def colliders(summary, n, about):
    """What is kept of a summary of report.summarise."""
    scenes = {}
    for scene in dict.fromkeys(key[0] for key in summary if key[1] == n):
        rows = {label: summary.get((scene, n, label), {}) for label in (RIVAL, 'tuned', OURS)}
        if not all('sumPerStep' in row for row in rows.values()):
            continue
        ours = rows[OURS]
        scenes[scene] = dict(default=1e3 * rows[RIVAL]['sumPerStep'], tuned=1e3 * rows['tuned']['sumPerStep'],
                             ours=1e3 * ours['sumPerStep'], x=ours['xsumPerStep'], t=ours['tsumPerStep'])
    return dict(about=about, n=n, scenes=scenes)


def manualTable(summary, n, about):
    """All scenes of a size, for the manual: searches and steps in ms, with ratios."""
    lines = ['| scene | first search: default → ours | × | later search: default → ours | × | '
             'step: default, tuned → ours | × default | × tuned |', '|---|--:|--:|--:|--:|--:|--:|--:|']
    for scene in dict.fromkeys(key[0] for key in summary if key[1] == n):
        theirs, tuned, ours = (summary.get((scene, n, label), {}) for label in (RIVAL, 'tuned', OURS))
        if not all('sumPerStep' in row for row in (theirs, ours)):
            continue
        ms = [[digits(1e3 * row[key]) for row in (theirs, ours)] for key in ('first', 'perActivation')]
        step = [digits(1e3 * row['sumPerStep']) if row else '–' for row in (theirs, tuned, ours)]
        overTuned = f'{ratio(ours["tsumPerStep"])}' if tuned else '–'
        lines.append(f'| {scene} | {ms[0][0]} → {ms[0][1]} | {ratio(ours["xfirst"])} | '
                     f'{ms[1][0]} → {ms[1][1]} | {ratio(ours["xperActivation"])} | {step[0]}, {step[1]} → {step[2]} | '
                     f'{ratio(ours["xsumPerStep"])} | {overTuned} |')
    return '\n'.join(lines) + f'\n\n{n:,} bodies, {about}, `scripts/bench colliders`.\n'


# --- finite elements, fracture --------------------------------------------------------------------
FIGURES = {  # what the tables need: test and name of figures, as regular expressions
    'hertz': (r'HertzContact\.(Smooth|Straight)', 'p0 over hertz'),
    'angular': (r'Collisions/Momentum.*', 'angular over impulse length'),
    'release': (r'Strip\.CrackRunsAtTheFractureEnergy', 'release .*'),
    'peak': (r'.*Uniaxial(Mesh)?\..*', 'peak'),
    'ring': (r'Ring\.PiecesAreAsLargeAsTheory', 'size over theory'),
    'deepest': (r'Impact\..*', 'deepest triangles in segments'),
}


def used(rows):
    """{name: values} of (test, figure, value); ValueError if a figure is missing."""
    values = {}
    for name, (test, figure) in FIGURES.items():
        values[name] = [float(row[2]) for row in rows if re.fullmatch(test, row[0])
                        and re.fullmatch(figure, row[1].replace('_', ' '))]
        if not values[name]:
            raise ValueError(f'no figure {figure!r} of {test!r}')
    return values


def elementTable(figures, calculix):
    """Finite elements against CalculiX and theory."""
    angular = figures['angular']
    return '\n'.join([
        '| finite elements | reference | ours |', '|---|--:|--:|',
        f'| impact, {calculix["triangles"]} triangles, ms per step | CalculiX {calculix["theirs"]:.2g} | '
        f'{calculix["ours"]:.2g}, with a step {calculix["dtRatio"]:.2g} times as long |',
        f'| pressure of Hertz\' contact, smooth and straight surfaces | theory | '
        f'{percents(figures["hertz"])} |',
        f'| angular momentum, of impulse × length, {len(angular)} collisions | 0 | '
        f'at most {power(max(angular))} |'])


def fractureTable(figures):
    """Fracture against theory."""
    release, peak, deepest = (figures[name] for name in ('release', 'peak', 'deepest'))
    return '\n'.join([
        '| fracture | theory | ours |', '|---|--:|--:|',
        f'| energy release rate at first break, {number(release)} meshes | Gc | {percents(release)} |',
        f'| load in compression, {number(peak)} meshes | Mohr and Coulomb | {percents(peak)} |',
        f'| fragments of a ring, 10⁴ s⁻¹ | Zhou\'s fit | {percents(figures["ring"])} |',
        f'| overlap in rubble, of the shortest segment, {number(deepest)} impacts | 0 | '
        f'at most {power(max(deepest))} |'])


def percents(ratios):
    """'+1.2 to +3.4 %' of ratios to a reference."""
    low, high = (f'{100 * (ratio - 1):+.1f}' for ratio in (min(ratios), max(ratios)))
    return f'{low} %' if low == high else f'{low} to {high} %'


def number(values):
    """A small count in words."""
    words = 'no one two three four five six seven eight nine ten eleven twelve'.split()
    return words[len(values)] if len(values) < len(words) else str(len(values))


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
