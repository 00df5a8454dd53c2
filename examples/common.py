"""Common parts of the finite-element examples: options, engines, the run, the report."""
import argparse
import hashlib
import math
import os
import sys

import numpy as np
import yadefrag
from tqdm import tqdm
from yade import O, wrapper as w

COLLIDERS = dict(Lebesgue='LebesgueCollider', LinearCode='LinearCodeCollider',
                 Hierarchy='HierarchyCollider', InsertionSort='InsertionSortCollider')


def number(isRight, wanted, kind=float):
    """For add_argument(type=...): an option's value as a finite number of the kind for which isRight(value) is true;
    `wanted` describes valid values. argparse reports errors."""
    def read(text):
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not (abs(value) < math.inf and isRight(value)):
            raise argparse.ArgumentTypeError(f'it is {text!r}, it must be {wanted}')
        return value
    return read


def atLeast(least):
    return number(lambda value: value >= least, f'a whole number of at least {least}', int)


wholeNumber = atLeast(1)
positive = number(lambda value: value > 0, 'a positive number')
notNegative = number(lambda value: value >= 0, 'a number of at least 0')


class Options(argparse.ArgumentParser):
    """The options of an example, including the common ones."""

    def __init__(self, doc, steps):
        script = sys.argv[0]
        super().__init__(prog=os.path.basename(script), description=doc.split('\n')[0])
        self.add_argument('--steps', type=wholeNumber, default=steps, help=f'default: {steps}')
        self.add_argument('--out', default=os.path.dirname(os.path.abspath(script)),
                          metavar='FOLDER', help='for the pictures; default: next to the script')
        self.add_argument('--collider', choices=COLLIDERS, default='Lebesgue')
        self.add_argument('--passes', type=int, choices=(1, 2), default=1,
                          help='1: the finer of two surfaces must not penetrate the other; 2: both; '
                               'default: %(default)s')
        self.add_argument('--no-pictures', action='store_true')

    def parse(self):
        options = self.parse_args(sys.argv[1:])
        if not options.no_pictures:
            makeFolder(self, options.out)
        return options


def makeFolder(parser, folder):
    """Creates the folder of --out, if it does not exist; the parser reports errors."""
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        parser.error(f'--out is {folder!r}, which is no folder that can be written to '
                     f'({error.strerror})')


def setEngines(fe, collider):
    """The usual loop with the solver `fe`, and a time step of 0.8 of the critical one."""
    finder = getattr(w, COLLIDERS[collider])
    O.engines = yadefrag.engines(fe, spheres=True, collider=finder)
    O.dt = .8 * fe.criticalTimeStep()
    O.timingEnabled = True


class Run:
    """A run with a record: the deepest penetration of all steps, and the energies over time."""

    def __init__(self, fe):
        self.fe = fe
        self.segment = shortestSegment(fe)  # m
        self.deepest = 0.  # m
        self.mostActives = 0
        self.interrupted = False
        self.history = []
        self.remember()

    def remember(self):
        self.history.append(dict(self.fe.energy, time=O.time, actives=self.fe.numActives))

    def go(self, steps, moments=(), show=None, every=50, each=None):
        """Runs `steps` steps; Ctrl-C ends the run after a step, with all results so far.

        Calls show() before the first step and after each of the steps in `moments`, each() after
        every step, and stores the energies after each `every` steps.
        """
        fe, moments = self.fe, set(moments)
        if show:
            show()
        try:
            # A bar if standard error is a terminal.
            for step in tqdm(range(1, steps + 1), unit='step', disable=None, mininterval=.3):
                O.step()
                self.deepest = max(self.deepest, fe.maxPenetration)
                self.mostActives = max(self.mostActives, fe.numActives)
                if each:
                    each()
                if step % every == 0 or step == steps:
                    self.remember()
                if step in moments and show:
                    show()
        except KeyboardInterrupt:
            self.interrupted = True
            print(f'Interrupted after {O.iter} steps.')
            self.remember()
            if show:
                show()
        return self

    def series(self, name):
        """(n) of one of the stored values: an energy (J), 'time' (s), 'actives'."""
        return np.array([moment[name] for moment in self.history])

    def report(self):
        """Prints the setting and the results of the run; one value per line."""
        fe, total = self.fe, self.series('total')
        lost = self.history[-1]['contact'] - self.history[0]['contact']
        # Where the ends are moved, most of the energy is their work.
        scale = max(abs(total).max(), abs(self.series('outside')).max(), np.finfo(float).tiny)
        rows = [('elements', f'{len(fe.triangles):,}'),
                ('surface entries', f'{sum(map(len, fe.surfaces)):,}'),
                ('steps', f'{O.iter:,} of {1e9 * O.dt:.4g} ns'),
                ('searches', f'{fe.numSearches:,}'),
                ('actives, last and most', f'{fe.numActives:,}, {self.mostActives:,}'),
                ('deepest penetration', f'{self.deepest / self.segment:.2e} of the shortest '
                                        f'segment, {1e3 * self.segment:.3g} mm'),
                ('energy at the start', f'{total[0]:.6g} J'),
                ('energy drift', f'{(total[-1] - total[0]) / scale:+.1e} at the end, '
                                 f'{(total - total[0]).max() / scale:+.1e} at most'),
                ('dissipated by contact', f'{lost / scale:.2%}'),
                ('dissipated by friction', f'{self.history[-1]["friction"] / scale:.2%}'),
                ('positions (md5)', hashlib.md5(fe.nodes.tobytes()).hexdigest())]
        print('\n'.join(f'{name + ":":24}{value}' for name, value in rows))
        print(timeSplit())


def shortestSegment(fe):
    """(m) The shortest segment of all surfaces."""
    nodes = fe.nodes
    return min(np.linalg.norm(nodes[loop] - nodes[np.roll(loop, -1)], axis=1).min()
               for loop in fe.surfaces)


def timeSplit():
    """The engines' fractions of the time, from YADE's timing, as text."""
    seconds = {type(e).__name__: 1e-9 * e.execTime for e in O.engines}
    whole = sum(seconds.values()) or 1
    return '\n'.join(f'{"  " + name:24}{value:7.2f} s  {value / whole:6.1%}'
                     for name, value in seconds.items())


def filmed(fe, options, field, moments, **settings):
    """(Run, Film or None): a run of options.steps steps with the usual engines, and its pictures at the start and at
    steps in a list, or at a number of evenly spaced ones up to the last. The other settings are those of Run.go."""
    setEngines(fe, options.collider)
    film = None
    if not options.no_pictures:
        import pictures
        film = pictures.Film(fe, field)
    if isinstance(moments, int):
        moments = [round(options.steps * (k + 1) / moments) for k in range(moments)]
    return Run(fe).go(options.steps, moments, film and film.take, **settings), film


def tell(options, *names):
    """Prints the names of the written pictures."""
    if not options.no_pictures:
        files = ', '.join(os.path.relpath(os.path.join(options.out, name)) for name in names)
        print(f'{"written:":24}{files}')
