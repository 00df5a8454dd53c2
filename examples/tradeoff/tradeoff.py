"""Speed against accuracy in five problems with known solutions.

    scripts/bench tradeoff [--problems bars,hertz,rolling,ring,compression] [--repeats 3]
        [--time wall|cpu] [--draw] [--out FOLDER]

For each problem a table of choices (NAME.csv, and in tables.md) with times and errors, and a plot with the
Pareto front (NAME.png), by yadefrag.tradeoff; tradeoff.png has all of them. README.md discusses the
results.
"""
import argparse
import importlib
import os
import sys

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [HERE, os.path.join(HERE, '..')]
import origin  # noqa: E402

PROBLEMS = 'bars', 'hertz', 'rolling', 'ring', 'compression'
MODULES = {'compression': 'compressed_rock'}  # Python 3.14 has a module `compression`


def parse():
    """The options, checked."""
    parser = argparse.ArgumentParser(prog='scripts/bench tradeoff',
                                     description=__doc__.split('\n')[0])
    parser.add_argument('--problems', type=known, default=PROBLEMS,
                        help='of %s, default: all' % ','.join(PROBLEMS))
    parser.add_argument('--repeats', type=int, default=3, help='of each run; default: 3')
    parser.add_argument('--limit', type=float, default=120, help='s for each run; default: 120')
    parser.add_argument('--time', choices=('wall', 'cpu'), default='wall',
                        help='which one the plots show; cpu for a machine that is not free')
    parser.add_argument('--draw', action='store_true',
                        help='draws the pictures of the tables in --out, without runs')
    parser.add_argument('--out', default=HERE, help='folder; default: that of the script')
    return parser.parse_args(sys.argv[1:])


def known(text):
    """The names in a list with commas."""
    names = text.split(',')
    for name in names:
        if name not in PROBLEMS:
            raise argparse.ArgumentTypeError(f'{name!r} is not one of {", ".join(PROBLEMS)}')
    return names


def together(tables, file, time):
    """The plots of all tables in one picture, with the names at the points."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    figure = Figure(figsize=(18, 9), layout='constrained')
    FigureCanvasAgg(figure)
    places = [figure.add_subplot(2, 3, i + 1) for i in range(len(tables))]
    for table, place in zip(tables, places):
        table.plot(ax=place, time=time, names=False)
    figure.savefig(file, dpi=100)


def sections(page):
    """{title: text} of the tables in tables.md, if it exists."""
    if not os.path.exists(page):
        return {}
    with open(page, encoding='utf-8') as f:
        parts = ('\n' + f.read().rstrip()).split('\n# ')[1:]
    return {part.split('\n')[0]: '# ' + part.rstrip() + '\n' for part in parts}


def measure(problem, options):
    """The table of new runs; load, machine, date, commit and repeats as text."""
    from yadefrag import tradeoff
    about = 'Load %.1f before the run; %s. Medians of %d runs.\n' % (
        os.getloadavg()[0], origin.line(), options.repeats)
    return tradeoff(problem.scene, problem.VARY, problem.measure, repeats=options.repeats,
                    limit=options.limit, **problem.ARGUMENTS), about


def earlier(where, title, texts):
    """The table of earlier runs, and the last line of its section."""
    from yadefrag import TradeoffTable
    return TradeoffTable.read(where + '.csv', title), texts[title].splitlines()[-1] + '\n'


def main():
    options = parse()
    os.makedirs(options.out, exist_ok=True)
    page = os.path.join(options.out, 'tables.md')
    tables, texts = [], sections(page)
    for name in options.problems:
        problem = importlib.import_module(MODULES.get(name, name))
        where, title = os.path.join(options.out, name), problem.ARGUMENTS['title']
        table, about = earlier(where, title, texts) if options.draw else measure(problem, options)
        table.csv(where + '.csv')
        if table.front(options.time):
            table.plot(where + '.png', time=options.time)
        texts[title] = table.markdown(time=options.time) + '\n' + about
        with open(page, 'w', encoding='utf-8') as f:
            f.write('\n'.join(texts.values()))
        tables.append(table)
        print(table.markdown(time=options.time))
    together(tables, os.path.join(options.out, 'tradeoff.png'), options.time)


if __name__ == '__main__':
    main()
