"""The table "against theory" of docs/measured.md, from docs/data/figures.csv, which `scripts/bench figures` writes.

    validation_table.py TESTS...    runs the tests of these programs that record figures, and stores these

Only suites whose sources record a figure are run. If a test fails, all is left as it is.

A row: what is compared, a pattern of its figures ('test.figure', as a regular expression), the values that are
wanted.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import measured_tables

# (what, figures, lowest, highest). With a lowest of None the wanted value is 0 and the highest a bound of the magnitude.
ROWS = (
    ('two bars: contact stress over ρcv/2', r'Bars\.Equal.*\.mean_over_closed_form', .995, 1.005),
    ('two bars: duration over 2L/c', r'Bars\.Equal.*\.duration_over_2L_c', .99, 1.01),
    ('bars of other impedance: reflected and transmitted stress, over theory', r'Bars\.Stress.*\.(reflected|transmitted)', .99, 1.01),
    ('patch of two meshes, two passes: largest error of the stress', r'PatchTest\.Meshes\d+And\d+(Jittered)?\.stress_error', None, .005),
    ('cylinder on a block: largest pressure over that of Hertz', r'HertzContact\.(Smooth|Straight)\.p0_over_hertz', .96, 1.04),
    ('block that slides: acceleration, error over g sin θ', r'Incline\.SlidesAbove.*\.error_over_g_sin', None, .01),
    ('collisions, 36 and 80 random: change of linear momentum over the impulse', r'(Collisions/)?Momentum.*\.linear_over_impulse', None,
     1e-12),
    ('the same: change of angular momentum over impulse × length', r'(Collisions/)?Momentum.*\.angular_over_impulse_length', None, 1e-5),
    ('strip with a crack: released energy over Gc when it runs', r'Strip\.CrackRuns.*\.release.*', .95, 1.05),
    ('the same, sheared, 4, 6, 16 elements in the zone', r'Strip\.Sliding.*\.release.*', .9, 1.1),
    ('notched beam, 4 elements in the zone: load over the fictitious crack model', r'NotchedBeam\..*\.(four.*|rows|smoothed)', .95, 1.05),
    ('the same, 6 and 8 elements', r'NotchedBeam\..*\.(six|eight).*', .95, 1.05),
    ('rock, uniaxial: load over Mohr and Coulomb', r'.*Uniaxial(Mesh)?.*\.peak', .95, 1.05),
    ('rock, lateral pressure of .2, .5, 1 tensile strengths', r'.*BiaxialPressure.*\.peak', .95, 1.05),
    ('the same, 3 tensile strengths', r'Biaxial\.UnderHighPressure.*\.(first_crack|peak|last)', .95, 1.05),
    ('Brazilian disc between plates: load over theory', r'Sizes/Brazilian\..*\.load', .97, 1.03),
    ('Brazilian disc, pressure on arcs: load over that of Hondros', r'.*BrazilianArcs.*\.(load.*|smoothed|rows)', .95, 1.05),
    ('the same: first crack, distance from the middle over the radius', r'.*BrazilianArcs\..*\.from_the_middle.*', None, .15),
    ('notched plate, turned meshes: angle of the crack, °', r'TurnedPlate\..*\.steepest', None, 3),
    ('the same: largest load over the least', r'TurnedPlate\..*\.most_over_least', 1, 1.03),
    ('plate with a running crack: time of the start over Freund', r'Branching\.Starts.*\.start_over_theory', .95, 1.05),
    ('Kalthoff and Winkler, twelve meshes: angle of the crack, °', r'KalthoffWinkler\..*\.mean_angle', 67, 72),
    ('spall: distance of the first crack from theory, in elements', r'.*SpallOf.*\.place_in_elements', None, 1),
    ('bars at strain rates: strength over that of the rate', r'RateBar\..*\.(over_factor|turned_by|mesh_).*', .994, 1.006),
    ('expanding ring, rows, 10⁴ /s: size of fragments over Zhou, Molinari and Ramesh', r'Ring\.PiecesAreAsLargeAsTheory\.size_over_theory',
     .75, 1.25),
    ('the same on meshes of `addPolygon`, 10⁴ and 10⁵ /s: fragments over the formula', r'Ring\.OnTheMeshOfAPolygon\.pieces_.*', .92, 1.08),
    ('the same, three materials, rates and widths', r'Ring\.ThreeMaterials.*', .8, 1.2),
    ('expanding ring of metal: fragments over Mott', r'ExpandingRing\..*\.(fragments_over_mott|finer|turned|seed_.*)', .7, 1.3),
    ('impact with fragments: change of the mass', r'(Blocks/)?Impact\..*\.mass_error', None, 1e-12),
    ('the same: change of the total energy, of the impact', r'(Blocks/)?Impact\..*\.energy_drift', None, .01),
    ('the same: deepest overlap of two triangles, of the shortest side', r'(Blocks/)?Impact\..*\.deepest_triangles_in_segments', None, 1e-4),
)


def of(pattern, stored):
    """The values of the figures of a row."""
    return [float(row['value']) for row in stored if re.fullmatch(pattern, f'{row["test"]}.{row["figure"]}')]


def require(stored):
    """ValueError if a row has no figure."""
    for _, pattern, *_ in ROWS:
        if not of(pattern, stored):
            raise ValueError(f'no figure {pattern!r}')


def rows():
    """Rows of the table, of which there are figures."""
    stored = measured_tables.read('figures')[1]
    found = []
    for what, pattern, low, high in ROWS:
        values = of(pattern, stored)
        if not values:
            continue
        if low is None:
            wanted, text = f'at most {short(high)}', short(max(map(abs, values)))
            isKept = max(map(abs, values)) <= high
        else:
            wanted, text = f'{low:g} to {high:g}', span(values)
            isKept = low <= min(values) and max(values) <= high
        found.append({'against theory': what, 'wanted': wanted, 'measured': text if isKept else f'**{text}**'})
    return found


def short(value):
    """Two digits."""
    return f'{value:.2g}' if value == 0 or .001 <= abs(value) < 1000 else measured_tables.power(value)


def span(values):
    """'0.998 to 1.012'."""
    low, high = f'{min(values):.3f}', f'{max(values):.3f}'
    if min(values) > 10:
        low, high = f'{min(values):.1f}', f'{max(values):.1f}'
    return low if low == high else f'{low} to {high}'


ROOT = pathlib.Path(__file__).resolve().parents[2]


def suites():
    """Names of the suites in the sources that record figures."""
    sources = [path.read_text() for path in (ROOT / 'tests').rglob('*.cpp')]
    recording = [text for text in sources if re.search(r'\b(figure|record|RecordProperty)\(', text)]
    return sorted({name for text in recording for name in re.findall(r'^TEST(?:_P|_F)?\((\w+)', text, re.M)})


def recorded(file):
    """A row for each figure in GoogleTest's XML."""
    for case in xml.etree.ElementTree.parse(file).iter('testcase'):
        for figure in case.iter('property'):
            yield {'test': f'{case.get("classname")}.{case.get("name")}', 'figure': figure.get('name'),
                   'value': figure.get('value')}


def main(*programs):
    where = measured_tables.origin.line()
    patterns = ':'.join(f'{name}.*:*/{name}.*' for name in suites())
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, 'figures.xml')
        for program in programs:
            command = [program, f'--gtest_filter={patterns}', f'--gtest_output=xml:{file}', '--gtest_brief=1']
            subprocess.run(command, check=True)
            rows += recorded(file)
    require(rows)
    measured_tables.write('figures', f'{where}, `scripts/bench figures`', rows)
    print(f'docs/data/figures.csv has {len(rows)} figures.')


if __name__ == '__main__':
    main(*sys.argv[1:])
