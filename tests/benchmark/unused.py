"""What a scene does not use costs nothing: paired runs, one process each, and instructions counted.

Run by scripts/bench unused. Writes unused.json and unused.md into the output folder.

Spheres in yade: without the plugin, with it imported, and with its collider. Finite elements: rings
in contact, which use nothing else: how many instructions belong to the code of each feature, how
many bytes to its arrays, and what it costs the same scene to use it.
"""
import argparse
import collections
import json
import os
import statistics
import subprocess
import sys
import tempfile

import instructions
from instructions import Feature

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(ROOT, 'examples'))
import origin  # noqa: E402

RINGS, STEPS = 8, 100
# Scenes of bodies far from each other: steps, enough to look whether they still are.
FAR = dict(blocks=100, squares=400, farRings=400)
WAYS = ('absent', 'imported', 'used')
YADE = getattr(sys, 'yade_argv', ['/usr/bin/yade'])[0]  # the one that runs the tests


def features(root=ROOT):
    """{name: Feature}: as yadefrag_unused calls them, and two that a scene uses by its shape."""
    return dict(
        fracture=Feature(root, r'^fracture/|world_(fracture|drop)|crack_candidates|relink',
                         r'[fF]racture|[cC]rack|[cC]ohe|stressed|squaredLook|watching'),
        friction=Feature(root, lines=r'[fF]riction|tangent|slip',
                         within=r'^contact/(contact|row_)|^step/'),
        smooth=Feature(root, r'bezier_arc', r'\b[aA]rc|[a-z]Arc|bulg|[sS]mooth(?!>)|Half',
                       without=r'Of<false>'),
        # All that becomes of pairs, though most are of two bodies.
        selfContact=Feature(root, r'entry_pairs|code_search_pairs', r'selfContact|mayTouch'),
        viscosity=Feature(root, lines=r'[vV]iscosity|[vV]iscous'),
        loads=Feature(root, lines=r'[lL]oads?\b|outer[F.]', within=r'^(dynamics|step)/'),
        space=Feature(root, functions=r'(Numbering|Code|Ranges)<3>|3, yadefrag::Count'))


def contactCode(root=ROOT):
    """What bodies that are far from each other could do without."""
    return Feature(root, r'^(contact|search|curve)/|world_(contact|watch)|entry_pairs|apart_bodies')


def run(program, *arguments):
    """Output of yadefrag_unused: a dict."""
    done = subprocess.run([program, *map(str, arguments)], stdout=subprocess.PIPE, text=True,
                          check=True, env=dict(os.environ, **instructions.kCalm))
    return json.loads(done.stdout)


def counted(program, folder, *arguments):
    """The same under callgrind: (dict, [Cost])."""
    text, dumps = instructions.count([program, *map(str, arguments)], folder)
    return json.loads(text), dumps[0]


def unusedShares(program, folder, root=ROOT):
    """({feature: share of the instructions of a scene that does not use it}, output of the run)."""
    printed, costs = counted(program, folder, 'rings', RINGS, STEPS)
    return {name: feature.share(costs) for name, feature in features(root).items()}, printed


def farShare(program, folder, scene, root=ROOT):
    """The share of contact where no body is ever near another; `scene`: one of FAR."""
    _, costs = counted(program, folder, scene, 2, FAR[scene])
    return contactCode(root).share(costs)


def spheres(ways, counting, number, steps, yade=YADE):
    """The command that runs unused_spheres.py; `counting`: path of yadefrag_counting.so."""
    return ['/usr/bin/python3', yade, '-n', '-x', '-j1', os.path.join(HERE, 'unused_spheres.py'),
            counting, str(number), str(steps), *ways]


def printed(text):
    """[dict], one a way."""
    return [json.loads(line[4:]) for line in text.splitlines() if line.startswith('@@@ ')]


def countSpheres(counting, folder, number, steps):
    """({way: [Cost]}, output); without the plugin twice, and the second time taken."""
    text, dumps = instructions.count(spheres(('absent', *WAYS), counting, number, steps), folder)
    return dict(zip(WAYS, dumps[1:])), printed(text)


def addingPerEntry(counting, folder, few=20, many=420, counted=4, yade=YADE):
    """Instructions that adding a body takes for each entry that was there before."""
    command = ['/usr/bin/python3', yade, '-n', '-x', '-j1', os.path.join(HERE, 'unused_adding.py'),
               counting, str(few), str(many), str(counted)]
    text, dumps = instructions.count(command, folder)
    before = [row['entries'] for row in printed(text)]
    costs = [byObject(dump)['_yadefrag.so'] / counted for dump in dumps]
    return (costs[1] - costs[0]) / (before[1] - before[0])


def byObject(costs):
    """{name of the library or program: instructions}"""
    sums = collections.Counter()
    for cost in costs:
        sums[os.path.basename(cost.object)] += cost.instructions
    return sums


def main(arguments):
    options = _parse(arguments)
    program = os.path.join(options.build, 'tests', 'yadefrag_unused')
    counting = os.path.join(options.build, 'tests', 'yadefrag_counting.so')
    os.environ['PYTHONPATH'] = os.path.join(options.build, 'python')
    with tempfile.TemporaryDirectory(prefix='yadefrag') as folder:
        elements = _measureElements(program, folder, options.repeat)
        balls = _measureSpheres(counting, folder, options.repeat)
    machine = origin.line()
    text = '\n'.join(['# What is not used costs nothing', '', machine + '.', '',
                      *_elementTable(elements), '', *_sphereTable(balls)])
    os.makedirs(options.out, exist_ok=True)
    with open(os.path.join(options.out, 'unused.json'), 'w', encoding='utf-8') as file:
        json.dump(dict(machine=machine, elements=elements, spheres=balls), file, indent=1)
    with open(os.path.join(options.out, 'unused.md'), 'w', encoding='utf-8') as file:
        file.write(text + '\n')
    print(text)
    print('written to', options.out)


def _measureElements(program, folder, repeat):
    """{feature: its figures}"""
    shares, without = unusedShares(program, folder)
    _, costs = counted(program, folder, 'rings', RINGS, STEPS)
    rows = {}
    for name in ('fracture', 'friction', 'smooth', 'selfContact', 'viscosity', 'loads'):
        pairs = [(run(program, 'rings', RINGS, STEPS, name), run(program, 'rings', RINGS, STEPS))
                 for _ in range(repeat)]
        _, withIt = counted(program, folder, 'rings', RINGS, STEPS, name)
        rows[name] = dict(
            share=shares[name], bytes=without['bytes'].get(name, 0),
            instructions=instructions.total(withIt) / instructions.total(costs),
            time=statistics.median(a['step'] / b['step'] for a, b in pairs),
            memory=statistics.median(a['peak'] - b['peak'] for a, b in pairs))
        print(name, 'measured', file=sys.stderr, flush=True)
    rows['space'] = dict(share=shares['space'], bytes=0)
    for scene in FAR:
        rows[f'contact, {scene}'] = dict(share=farShare(program, folder, scene),
                                         bytes=run(program, scene, 2, 50)['bytes']['contact'])
    return rows


def _measureSpheres(counting, folder, repeat):
    """{way: its figures}: natively each way in a process of its own."""
    costs, _ = countSpheres(counting, folder, 300, 50)
    base = instructions.total(costs['absent'])
    rows = {}
    for way in WAYS:
        runs = []
        for _ in range(repeat):
            done = subprocess.run(spheres((way,), counting, 3000, 200), stdout=subprocess.PIPE,
                                  text=True, check=True)
            runs += printed(done.stdout)
        rows[way] = {key: statistics.median(r[key] for r in runs)
                     for key in ('importing', 'step', 'peak')}
        rows[way].update(instructions=instructions.total(costs[way]) / base,
                         ours=byObject(costs[way])['_yadefrag.so'])
        print(way, 'measured', file=sys.stderr, flush=True)
    return rows


def _elementTable(rows):
    out = ['| finite elements without | share of instructions | bytes | with it: instructions | time '
           '| peak memory |', '|---|--:|--:|--:|--:|--:|']
    for name, row in rows.items():
        used = ' | | ' if 'time' not in row else (
            f"{row['instructions']:.2f} × | {row['time']:.2f} × | {row['memory'] / 2**20:+.2f} MB")
        out.append(f"| {name} | {100 * row['share']:.2f} % | {row['bytes']} | {used} |")
    return out


def _sphereTable(rows):
    out = ['| spheres, the plugin | instructions of a step | of them ours | import | step, 3000 '
           'spheres | peak memory |', '|---|--:|--:|--:|--:|--:|']
    for way, row in rows.items():
        out.append(f"| {way} | {row['instructions']:.4f} × | {row['ours']} | "
                   f"{1e3 * row['importing']:.0f} ms | {1e3 * row['step']:.2f} ms | "
                   f"{row['peak'] / 2**20:.1f} MB |")
    return out


def _parse(arguments):
    parser = argparse.ArgumentParser(description='What is not used costs nothing.')
    parser.add_argument('--repeat', type=int, default=5, help='runs of each')
    parser.add_argument('--out', default=os.path.join(ROOT, 'out', 'bench'))
    parser.add_argument('--build', default=os.path.join(ROOT, 'build', 'release'))
    return parser.parse_args(arguments)


if __name__ == '__main__':
    main(sys.argv[1:])
