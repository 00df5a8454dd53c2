"""yade.mpy with YADE's collider and ours: scripts/bench mpi [--bodies 20000] [--ranks 1,2,4] ...

Every measurement is a run of its own (mpi.py run COLLIDER BODIES STEPS, one thread in each process): the gas of
scenes.py above a plate of the master, in slices along x of equal numbers of spheres. The colliders take turns within a
repeat, and a ratio is formed within a repeat, so that a slow minute of the machine falls on both. Shown are medians over
the repeats. The processes share the machine's cores, and one of them, the master, has no spheres. Writes mpi.md to
out/bench; with --readme the table goes into docs/data and the pages.
"""
import json
import os
import statistics
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import measured_tables  # noqa: E402

sys.path.append(str(measured_tables.ROOT / 'tests' / 'pkg' / 'helpers'))
import mpi_processes  # noqa: E402

COLLIDERS = ['InsertionSortCollider', 'LebesgueCollider']


# --- one process of one measurement -----------------------------------------------------------------
def run(collider, n, steps):
    """The master prints times of all steps after the first (s), and the searches in them."""
    from yade import O, config
    from yade import mpy as mp

    engine = build(collider, n)

    def go(count):
        if mp.numThreads > 1:
            mp.mpirun(count)
        else:
            O.timingEnabled = True
            O.run(count, True)
    go(1)
    before, start = (engine().execTime, engine().numAction), time.perf_counter()
    go(steps)
    row = dict(step=(time.perf_counter() - start) / steps, search=(engine().execTime - before[0]) / 1e9 / steps,
               searches=(engine().numAction - before[1]) / steps, yade=config.version)
    if mp.rank == 0:
        print(json.dumps(row), flush=True)


def build(collider, n):
    """The scene; a function that finds its collider."""
    import scenes
    import yadefrag  # noqa: F401
    from yade import O, utils
    from yade import mpy as mp
    from yade import wrapper as w

    parts = scenes.gas(n, 1)
    spheres = sorted((b.state.pos[0], b.id) for b in O.bodies)
    workers = mp.numThreads - 1
    for place, (_, body) in enumerate(spheres if workers else ()):
        O.bodies[body].subdomain = 1 + place * workers // len(spheres)
    low = min(b.state.pos[2] for b in O.bodies) - 2 * scenes.RADIUS
    wide = spheres[-1][0] - spheres[0][0]
    O.bodies.append(utils.box((spheres[0][0] + wide / 2, 0, low), (wide, wide, 0), fixed=True, material=O.bodies[0].mat))
    # A negative verletDist would make YADE's master search at every step.
    O.engines = [w.ForceResetter(),
                 getattr(w, collider)([*parts['bound'], w.Bo1_Box_Aabb()], label='collider', verletDist=.5 * scenes.RADIUS),
                 w.InteractionLoop([*parts['geom'], w.Ig2_Box_Sphere_ScGeom()], parts['phys'], parts['law']),
                 w.NewtonIntegrator(**parts['newton'])]
    O.dt = parts['dt']
    return lambda: next(e for e in O.engines if isinstance(e, w.Collider))


# --- the comparison ---------------------------------------------------------------------------------
def measure(collider, ranks, options):
    """What the master prints; RuntimeError with its last lines otherwise."""
    command = [options.yade, '-n', '-x', os.path.abspath(__file__), 'run', collider, str(options.bodies), str(options.steps)]
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        _, output = mpi_processes.run(ranks, command, folder, options.limit)
    rows = [line for line in output.splitlines() if line.startswith('{')]
    if not rows:
        raise RuntimeError(f'{collider} in {ranks} processes: {output[-1000:]}')
    return json.loads(rows[-1])


def table(rows, ranks):
    """A row of the page's table; `rows` are pairs of what both colliders gave."""
    middle = lambda key: ' → '.join(f'{statistics.median(1e3 * pair[k][key] for pair in rows):.1f}' for k in (0, 1))  # noqa: E731
    # mpy runs a collider twice for one search.
    parts = ' → '.join(f'{100 * rows[0][k]["searches"] / (2 if ranks > 1 else 1):.1f}' for k in (0, 1))
    return {'processes': str(ranks), "step with YADE's collider → ours, ms": middle('step'),
            '×': f'{statistics.median(pair[0]["step"] / pair[1]["step"] for pair in rows):.1f}',
            'of it, searches with their messages, ms': middle('search'), 'steps with a search': f'{parts} %'}


def main(arguments):
    """Parse, measure, report."""
    parser = measured_tables.parser('mpi', __doc__)
    parser.add_argument('--bodies', type=int, default=20000, help='default: 20000')
    parser.add_argument('--steps', type=int, default=200, help='default: 200')
    parser.add_argument('--ranks', type=lambda t: [int(x) for x in t.split(',')], default=[1, 2, 4], help='default: 1,2,4')
    parser.add_argument('--repeat', type=int, default=3, help='default: 3')
    parser.add_argument('--limit', type=float, default=300, help='s per run; default: 300')
    options = parser.parse_args(arguments)
    found = {ranks: [] for ranks in options.ranks}
    for repeat in range(options.repeat):
        for ranks, rows in found.items():
            rows.append([measure(name, ranks, options) for name in COLLIDERS])
            print(f'repeat {repeat + 1}, {ranks} processes', file=sys.stderr, flush=True)
    about = (f'{options.bodies:,} spheres of a gas above a plate, {options.steps} steps, medians of {options.repeat} runs, '
             f'{measured_tables.origin.line()}, `scripts/bench mpi`')
    measured_tables.publish(options, 'mpi', [table(rows, ranks) for ranks, rows in found.items()], about)


if __name__ == '__main__':
    if sys.argv[1:2] == ['run']:
        run(sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
    else:
        main(sys.argv[1:])
