"""YADE's InteractionLoop and NewtonIntegrator against CurveLoop and CurveIntegrator:
scripts/bench loops [--scenes a,b] [--sizes 1000,10000] [--threads 1,2]

Plain Python; every measurement is a process of its own (measure.py inside yade), with LebesgueCollider. The
engines take turns within every repeat, and ratios are formed within a repeat. Shown are medians over the repeats.
Writes loops.json (raw) and loops.md (the table) to out/bench.
"""
import argparse
import json
import os
import statistics

import colliders
import report

ENGINES = [('InteractionLoop', 'NewtonIntegrator'), ('CurveLoop', 'CurveIntegrator')]
# Steps before the measured ones: data are moved together after 32.
WARM = 40
SCENES = ['gas', 'packing', 'polydisperse', 'clusters']


def parse(arguments):
    parser = argparse.ArgumentParser(prog='scripts/bench loops', description=__doc__.split('\n')[0])
    parser.add_argument('--scenes', default=','.join(SCENES), help='default: %(default)s')
    parser.add_argument('--sizes', default='10000,100000', help='default: %(default)s')
    parser.add_argument('--threads', default='1', help='default: %(default)s')
    parser.add_argument('--repeat', type=int, default=3, help='default: 3')
    parser.add_argument('--budget', type=float, default=8., help='s of measured steps; default: 8')
    parser.add_argument('--limit', type=float, default=180., help='s per process; default: 180')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--out', default=os.path.join(colliders.ROOT, 'out', 'bench'))
    parser.add_argument('--yade', default=os.path.join(colliders.ROOT, 'scripts', 'yade'))
    options = parser.parse_args(arguments)
    options.scenes = options.scenes.split(',')
    options.sizes, options.threads = ([int(float(x)) for x in text.split(',')]
                                      for text in (options.sizes, options.threads))
    return options


def measured(options):
    """A row for each scene, size, number of threads, engines and repeat; raises RuntimeError if one fails."""
    runner, rows = colliders.Runner(options), []
    for scene in options.scenes:
        for n in options.sizes:
            for threads in options.threads:
                for repeat in range(options.repeat):
                    for loop, integrator in ENGINES:
                        row = runner.measure('LebesgueCollider', scene, n, options.budget, threads=threads, loop=loop,
                                             integrator=integrator, warm=WARM)
                        if 'error' in row:
                            raise RuntimeError(f'{scene}, {n} bodies, {loop}: {row["error"]}')
                        rows.append(dict(row, threads=threads, loop=loop, repeat=repeat))
    return rows


def table(options, rows):
    """Lines of Markdown."""
    lines = ['| scene | bodies | contacts | threads | loop, ms: YADE | ours | times faster | integrator, ms: YADE | ours '
             '| times faster | step, ms: YADE | ours | times faster |', '|---|' + '--:|' * 12]
    for scene in options.scenes:
        for n in options.sizes:
            for threads in options.threads:
                of = {loop: [r for r in rows if (r['scene'], r['n'], r['threads'], r['loop']) ==
                             (scene, n, threads, loop)] for loop, _ in ENGINES}
                cells = [scene, f'{n:,}', f'{of["CurveLoop"][0]["real"]:,}', str(threads)]
                for key in ('loopPerStep', 'integratorPerStep', 'sumPerStep'):
                    both = [[r[key] for r in of[loop]] for loop, _ in ENGINES]
                    cells += [f'{1e3 * statistics.median(one):.3g}' for one in both]
                    cells.append(f'{statistics.median(a / b for a, b in zip(*both)):.2f}')
                lines.append('| ' + ' | '.join(cells) + ' |')
    return lines


def main(arguments):
    options = parse(arguments)
    rows = measured(options)
    machine = report.machineOf(rows)
    os.makedirs(options.out, exist_ok=True)
    with open(os.path.join(options.out, 'loops.json'), 'w') as out:
        json.dump(dict(machine=machine, rows=rows), out, indent=1)
    text = '\n'.join(table(options, rows)) + f'\n\n{report.line(machine, "threads as shown")}\n'
    with open(os.path.join(options.out, 'loops.md'), 'w') as out:
        out.write(text)
    print(text)


if __name__ == '__main__':
    import sys
    main(sys.argv[1:])
