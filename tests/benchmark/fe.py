"""Finite-element bodies: scripts/bench fe [--repeat 5] [--out FOLDER]

Three tables. The step without contact, ns per triangle, at 10⁴ to 10⁶ triangles on one thread and
two; where the time of a step with contact goes, in rings, squares, an impact and walls of blocks;
blocks that touch exactly beside the same blocks apart. The scenes and our measurements are in fe_bench.cpp and
fe_contact_bench.cpp.
Medians over the repeats. Writes fe.json (raw) and fe.md (tables) to the folder, by default
out/bench.
"""
import argparse
import collections
import json
import os
import statistics
import subprocess
import sys

import report

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
COUNTERS = ['triangles', 'entries', 'candidates', 'rows', 'searches', 'forces', 'search', 'local',
            'correction', 'share']


def main(arguments):
    """Run all, write all; exits with one sentence where a run fails."""
    options = _parse(arguments)
    os.makedirs(options.out, exist_ok=True)
    steps = _bench(options, '^step')
    contact = _bench(options, '^contact/')
    machine = report._machine([])
    text = '\n'.join(
        ['# Finite elements', '', _line(machine) + f'; medians of {options.repeat} runs.', '']
        + stepTable(steps) + [''] + contactTable(contact) + [''] + blockTable(contact))
    with open(os.path.join(options.out, 'fe.json'), 'w') as f:
        json.dump(dict(machine=machine, repeat=options.repeat, rows=steps + contact), f, indent=1)
    with open(os.path.join(options.out, 'fe.md'), 'w') as f:
        f.write(text + '\n')
    print(text)
    print('written to', options.out)


def _line(machine):
    return f"{machine['machine']}, {machine['date']}, commit {machine['commit']}"


def _parse(arguments):
    parser = argparse.ArgumentParser(description='Times of finite-element bodies.')
    parser.add_argument('--repeat', type=int, default=5, help='runs of each')
    parser.add_argument('--out', default=os.path.join(ROOT, 'out', 'bench'))
    parser.add_argument('--program',
                        default=os.path.join(ROOT, 'build', 'release', 'tests', 'yadefrag_bench'))
    return parser.parse_args(arguments)


def _bench(options, which):
    """[dict], one a benchmark: name and the median of each of its figures over the repeats."""
    command = [options.program, f'--benchmark_filter={which}', '--benchmark_format=json',
               f'--benchmark_repetitions={options.repeat}',
               '--benchmark_enable_random_interleaving=true']
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode:
        sys.exit(f'{options.program} ended with status {done.returncode}: {done.stderr[-300:]}')
    runs = collections.OrderedDict()
    for b in json.loads(done.stdout)['benchmarks']:
        if b['run_type'] == 'iteration':
            runs.setdefault(b['run_name'], []).append(b)
    print(f'{len(runs)} of {which} measured', file=sys.stderr, flush=True)
    rows = []
    for name, several in sorted(runs.items(), key=lambda item: _registered(item[1])):
        figures = {key: statistics.median(b[key] for b in several) for key, value
                   in several[0].items() if isinstance(value, float)}
        rows.append(dict(figures, name=name))
    return rows


def _registered(several):
    """The order in which the benchmarks are registered."""
    return several[0]['family_index'], several[0]['per_family_instance_index']


def stepTable(rows):
    """Markdown: ns per triangle and step, threads side by side."""
    times = collections.OrderedDict()
    for row in rows:
        kind, triangles, threads = row['name'].removesuffix('/real_time').split('/')
        times.setdefault((kind, int(triangles)), {})[int(threads)] = 1e9 * row['time/element']
    out = ['## Without contact', '', '| | triangles | one thread, ns | two threads, ns | × |',
           '|---|--:|--:|--:|--:|']
    for (kind, triangles), of in times.items():
        two = f'{of[2]:.2f} | {of[1] / of[2]:.2f}' if 2 in of else ' | '
        out.append(f'| {kind} | {triangles} | {of[1]:.1f} | {two} |')
    return out


def contactTable(rows):
    """Markdown: where the time of a step goes."""
    out = ['## With contact', '', '`forces`: ns per triangle and step; `search`, `local`, '
           '`correction`: ns per surface entry and step; `share`: of contact in the step; rows of '
           'the contact groups, of each step; searches in 300 steps.', '',
           '| scene | size | threads | ' + ' | '.join(COUNTERS) + ' | step, ms |',
           '|---|--:|--:|' + '--:|' * (len(COUNTERS) + 1)]
    for row in rows:
        words = row['name'].split('/')
        cells = words[1:4] + [_digits(key, row[key]) for key in COUNTERS]
        out.append('| ' + ' | '.join(cells + [f"{row['real_time']:.3f}"]) + ' |')
    return out


def blockTable(rows):
    """Markdown: a step of blocks that touch exactly, over one of the same blocks apart."""
    times = {tuple(row['name'].split('/')[1:4]): row['real_time'] for row in rows}
    out = ['## Blocks that touch exactly', '', 'Blocks on a floor, with friction and gravity; the '
           'first 300 steps.', '', '| blocks | threads | apart, ms a step | touching, ms | × |',
           '|--:|--:|--:|--:|--:|']
    for (scene, size, threads), touching in times.items():
        if scene == 'touching blocks':
            apart = times['blocks apart', size, threads]
            out.append(f'| {int(size) ** 2} | {threads} | {apart:.3f} | {touching:.3f} | '
                       f'{touching / apart:.1f} |')
    return out


def _digits(key, value):
    if key == 'share':
        return f'{100 * value:.1f} %'
    return f'{value:.0f}' if value >= 100 or key in ('rows', 'searches') else f'{value:.1f}'


if __name__ == '__main__':
    main(sys.argv[1:])
