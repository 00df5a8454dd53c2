"""Makes the pictures of README, docs and examples, and the tables of figures beside them: scripts/gallery.

A maker runs scripts in a temporary folder. If all of them succeed, its pictures replace those of its
example, and its table, with machine, date and commit, replaces the one between the marks
`<!-- figures: NAME -->` and `<!-- end of figures -->` of the example's README.md.
"""
import argparse
import dataclasses
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'examples'))
import origin  # noqa: E402

END = '<!-- end of figures -->'
# Times, and what YADE itself prints.
NOT_SHOWN = ('positions (md5)', 'CPU time', 'written', 'Using python version')


@dataclasses.dataclass
class Maker:
    """Runs of one script, their pictures and their table.

    name      of the maker
    folder    of the pictures and of the README, in examples
    files     pictures and tables that the first run writes
    command   of a run, from the root folder; {out} stands for the folder of the pictures
    runs      options of each run
    rows      names of the figures that the table shows; None: all
    table     False: the README has no table of this maker
    timed     True: the pictures show times, for which the machine has to be idle
    """
    name: str
    folder: str
    files: tuple
    command: str
    runs: tuple = ('',)
    rows: tuple = None
    table: bool = True
    timed: bool = False

    def places(self):
        return [f'examples/{self.folder}/{file}' for file in self.files]


def example(name, pictures=None, runs=('',), **more):
    """Maker of examples/NAME/NAME.py."""
    command = f'scripts/yade -n -x examples/{name}/{name}.py --out {{out}}'
    return Maker(name, name, tuple(pictures or [f'{name}.png']), command, runs, **more)


def small(name):
    """Maker of examples/small/NAME.py."""
    return Maker(name, 'small', (f'{name}.png',), f'scripts/yade -n -x examples/small/{name}.py {{out}}')


MAKERS = (
    example('impact', ['impact.png', 'impact_fragments.png', 'impact_course.png', 'impact_sizes.png'],
            runs=('', '--seed 2', '--seed 3', '--size 4e-4 --steps 5000', '--fracture-energy 500', '--speed 100'),
            rows=('surface segments', 'cracks', 'fragments', 'cylinder at the end', 'dissipated by friction',
                  'dissipated by contact', 'dissipated by cracks', 'energy drift', 'deepest penetration')),
    example('ring_fragments', ['ring_sizes.png', 'ring_pieces.png']),
    example('compression', ['compression.png']),
    Maker('compression_held', 'compression', ('compression_held.png',),
          'scripts/yade -n -x examples/compression/compression.py --held --pressures 0 --out {out}'),
    example('aggregates'),
    Maker('armour', 'armour', ('armour.png',), 'scripts/yade -n -x examples/armour/armour.py {out}', table=False),
    example('cylinder', ['cylinder.png', 'cylinder_force.png', 'cylinder.gif'],
            runs=('--gif', '--passes 2', '--size 2.5e-4 --steps 1000')),
    example('squares', runs=('', '--passes 2')),
    example('rings', runs=('', '--passes 2')),
    example('bars', runs=('', '--passes 2')),
    example('rolling', runs=('', '--passes 1', '--block .5', '--block .5 --passes 1', '--block 1.25 --passes 1'),
            rows=('ripple, straight', 'ripple, smooth', 'straight / smooth')),
    example('spheres', timed=True),
    *map(small, ('column', 'bending', 'drum', 'blast', 'glass', 'spheres_on_beam', 'crusher', 'monte_carlo',
                 'taylor', 'spall')),
    Maker('codes', 'spheres', ('codes.png',), 'scripts/bench codes --out {out}', table=False, timed=True),
    Maker('figure14', 'figure14', ('figure14.png',), 'scripts/bench figure14 --out {out}', table=False, timed=True),
    Maker('tradeoff', 'tradeoff',
          ('tradeoff.png', 'tables.md', *(f'{problem}.{ending}' for ending in ('png', 'csv') for problem in (
              'bars', 'hertz', 'rolling', 'ring', 'compression'))),
          'scripts/bench tradeoff --time cpu --out {out}', table=False, timed=True),
)


class Failed(Exception):
    """A run failed or did not write a picture."""


def run(maker, options, out):
    """Standard output of a run."""
    words = [word.format(out=out) for word in f'{maker.command} {options}'.split()]
    done = subprocess.run(words, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode:
        raise Failed(f'{" ".join(words)} ended with {done.returncode}: {(done.stderr or done.stdout).strip()[-600:]}')
    return done.stdout


def make(maker, where):
    """Runs the maker, then replaces its pictures and its table; `where`: machine, date, commit."""
    with tempfile.TemporaryDirectory() as folder:
        outputs = []
        for number, options in enumerate(maker.runs):
            out = pathlib.Path(folder) / str(number)
            out.mkdir()
            outputs.append(run(maker, options, out))
        first = pathlib.Path(folder) / '0'
        for picture in maker.files:
            if not (first / picture).is_file():
                raise Failed(f'{maker.name} did not write {picture}')
        readme = ROOT / 'examples' / maker.folder / 'README.md'
        if maker.table:
            shown = f'{table(maker, outputs)}\n\n`scripts/gallery {maker.name}`: {where}.'
            readme.write_text(replaced(readme.read_text(), maker.name, shown))
        for picture, place in zip(maker.files, maker.places()):
            shutil.copyfile(first / picture, ROOT / place)


def replaced(page, name, figures):
    """The page with new figures between the marks of `name`."""
    mark = f'<!-- figures: {name} -->'
    before, found, rest = page.partition(mark)
    _, ended, after = rest.partition(END)
    if not (found and ended):
        raise Failed(f'a README has no {mark} with {END}')
    return f'{before}{mark}\n{figures}\n{END}{after}'


def table(maker, outputs):
    """Markdown: the table that the script prints, or the figures that it prints as lines 'name: value'.

    A row for each figure and a column for each run; with more than three runs the other way round.
    """
    printed = [line for line in outputs[0].splitlines() if line.startswith('|')]
    if printed:
        return '\n'.join(map(readable, printed))
    reports = [figures(output) for output in outputs]
    rows = maker.rows or [name for name in reports[0] if name not in NOT_SHOWN]
    missing = [name for name in rows for report in reports if name not in report]
    if missing:
        raise Failed(f'{maker.name} does not print {missing[0]!r}')
    # Without the options that concern pictures only.
    runs = [options.replace('--gif', '').strip() for options in maker.runs]
    names = [f'`{options}`' if options else 'default' for options in runs]
    lines = [['', *names], *([name, *(report[name] for report in reports)] for name in rows)]
    if len(runs) > 3:
        lines = [list(line) for line in zip(*lines)]
    if len(runs) == 1:
        lines[0][1] = ''
    head, *rest = ['| ' + ' | '.join(line) + ' |' for line in lines]
    return '\n'.join([head, '|---' + '|--:' * (len(lines[0]) - 1) + '|', *rest])


def figures(output):
    """{name: value} of the lines 'name: value'."""
    found = (re.match(r'(\w[^:]*):\s+(\S.*)', line) for line in output.splitlines())
    return {match[1]: readable(match[2]) for match in found if match}


def readable(text):
    """1.2e-05 as 1.2·10⁻⁵, a typographic minus before numbers, a space before %."""
    def power(match):
        number, exponent = match[1], int(match[2])
        if float(number) == 0:
            return '0'
        return f'{number}·10{str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))}'
    text = re.sub(r'([+-]?\d+(?:\.\d+)?)e([+-]\d+)', power, text)
    return re.sub(r'(?<![\w.)\]-])-(?=\d)', '−', text).replace('%', ' %').replace('  %', ' %')


def main(arguments):
    parser = argparse.ArgumentParser(prog='scripts/gallery', description=__doc__.split('\n\n', maxsplit=1)[0])
    parser.add_argument('names', nargs='*', metavar='NAME', help='makers; default: all')
    parser.add_argument('--list', action='store_true', help='shows the makers and their pictures')
    options = parser.parse_args(arguments)
    makers = {maker.name: maker for maker in MAKERS}
    for name in options.names:
        if name not in makers:
            parser.error(f'no maker {name!r}; there are {", ".join(makers)}')
    if options.list:
        for maker in MAKERS:
            print(f'{maker.name:18}{" (times)" * maker.timed:9}{" ".join(maker.places())}')
        return 0
    for command in (['setup', 'plugin'], ['build', 'release', '_yadefrag']):
        subprocess.run([ROOT / 'scripts' / command[0], *command[1:]], check=True)
    where, failed = origin.line(), 0  # before files change
    for name in options.names or makers:
        print(name, flush=True)
        try:
            make(makers[name], where)
        except Failed as error:
            print(f'scripts/gallery: {error}', file=sys.stderr, flush=True)
            failed = 1
    return failed


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
