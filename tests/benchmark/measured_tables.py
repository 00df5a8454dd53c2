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
SOURCES = ('colliders', 'figures')
MARKS = ('<!-- measured -->\n', '<!-- end of measured -->')
RIVAL, OURS = 'InsertionSortCollider', 'LebesgueCollider'


def keep(key, value):
    """Store the figures of one benchmark, and make the tables of the README anew if all others are there.

    ValueError if the sources differed from the commit: such figures cannot be measured again.
    """
    if value['about'].endswith('-dirty'):
        raise ValueError(f'the figures are of sources that are not committed: {value["about"]}')
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
    """The two tables, as Markdown, and the sentence on CalculiX if there are figures of it."""
    figures = data['figures']
    parts = [colliderTable(data['colliders']),
             accuracyTable(figures['values']) + f'\n\n{figures["about"]}; `scripts/bench figures`.']
    if 'calculix' in data:
        parts.append(calculixSentence(data['calculix']))
    return '\n\n'.join(parts) + '\n'


# --- colliders ------------------------------------------------------------------------------------
SCENES = {  # what the README calls the scenes of scenes.py
    'gas': 'gas of equal spheres', 'packing': 'dense packing, nearly at rest',
    'polydisperse': 'gas of spheres, radii 1 : 20', 'polydisperse50': 'gas of spheres, radii 1 : 50'}


def colliderTable(colliders):
    """Milliseconds per step with YADE's collider, default and tuned, and with ours."""
    lines = [f'Milliseconds for a step (collider, interaction loop and integrator) of {colliders["n"]:,} spheres. "Tuned" is YADE\'s',
             'collider with the best of 15 choices of `verletDist` and `targetInterv` for that scene.', '',
             '| scene | `InsertionSortCollider` | tuned | `LebesgueCollider` | times faster | than the tuned one |',
             '|---|--:|--:|--:|--:|--:|']
    for scene, entry in colliders['scenes'].items():
        lines.append(f'| {SCENES[scene]} | {digits(entry["default"])} | {digits(entry["tuned"])} | '
                     f'{digits(entry["ours"])} | {ratio(entry["x"])} | {ratio(entry["t"])} |')
    return '\n'.join(lines) + f'\n\n{colliders["about"]}; `scripts/bench colliders`.'


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


def accuracyTable(figures):
    """Finite elements, contact and fracture against theory."""
    angular, release, peak, deepest = (figures[name] for name in ('angular', 'release', 'peak', 'deepest'))
    return '\n'.join([
        '| finite elements: what is compared | with | deviation |', '|---|---|--:|',
        '| largest pressure where a cylinder presses on a block, smooth and straight boundaries | formula of Hertz | '
        f'{percents(figures["hertz"])} |',
        f'| angular momentum after a collision, relative to its impulse times length; {len(angular)} collisions | '
        f'conservation | at most {power(max(angular))} |',
        f'| energy released per area when a crack begins to grow, {number(release)} meshes | fracture energy of the '
        f'material | {percents(release)} |',
        f'| load at which a block under compression breaks, {number(peak)} meshes | law of Mohr and Coulomb | '
        f'{percents(peak)} |',
        '| mean size of the fragments of a ring that expands at 10⁴ per second | formula of Zhou, Molinari and Ramesh '
        f'(2006) | {percents(figures["ring"])} |',
        f'| deepest overlap of two triangles, relative to the shortest side; {number(deepest)} impacts with fragments | '
        f'none | at most {power(max(deepest))} |'])


def calculixSentence(calculix):
    """One step of an elastic impact beside CalculiX."""
    return (f'A step of an elastic impact with {calculix["triangles"]:,} triangles takes {calculix["ours"]:.2g} ms, '
            f'with CalculiX\' explicit solver\n{calculix["theirs"]:.2g} ms, and {calculix["dtRatio"]:.2g} times as many '
            f'steps. ({calculix["about"]}; `scripts/bench fe`.)')


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
