"""The manual against the code: the sentences that it quotes exist, its links have targets.

Run by scripts/docs, without YADE; the code of the pages is run by tests/pkg/examples/test_fe_examples.py.
"""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'tests' / 'benchmark'))
import measured_tables  # noqa: E402
import validation_table  # noqa: E402

PAGES = sorted((ROOT / 'docs').glob('*.md')) + [ROOT / 'README.md']


def sources():
    """All sources as one text, in which neighbouring string literals are one."""
    files = [path for folder in ('lib', 'pkg') for path in (ROOT / folder).rglob('*')
             if path.suffix in ('.cpp', '.hpp', '.py')]
    text = '\n'.join(path.read_text() for path in files)
    text = re.sub(r'"\s*\n\s*"', '', text)
    return re.sub(r"'\s*\n\s*f?'", '', text)


class Manual(unittest.TestCase):

    def test_quotedSentencesExist(self):
        text = sources()
        page = (ROOT / 'docs' / 'checked.md').read_text()
        rows = re.findall(r'^\| (.*?) \|', page, re.M)
        quoted = [sentence for row in rows for sentence in re.findall(r'\*(.*?)\*', row)]
        self.assertGreater(len(quoted), 40)
        for sentence in quoted:
            for part in sentence.split('…'):
                part = part.strip(' .')
                if len(part) > 3 and 'unregistered class' not in part:  # YADE's
                    with self.subTest(part=part):
                        self.assertTrue(part in text)

    def test_foldersIncludeOnlyThoseBefore(self):
        before = []
        for part in ('lib', 'pkg'):
            page = (ROOT / part / 'README.md').read_text()
            for folder in re.findall(r'^\| `(\w+)/?` \|', page, re.M):
                if not (ROOT / part / folder).is_dir():
                    continue
                before.append(folder)
                for file in (ROOT / part / folder).rglob('*.[ch]pp'):
                    for used in re.findall(r'^#include "(\w+)/', file.read_text(), re.M):
                        with self.subTest(file=file.name, used=used):
                            self.assertIn(used, before)
        self.assertEqual(len(before), len(set(before)))
        self.assertGreater(len(before), 15)

    def test_linksLeadSomewhere(self):
        count = 0
        for page in PAGES:
            for target in re.findall(r'\]\(([^)#]+)(?:#[^)]*)?\)', page.read_text()):
                if '://' in target:
                    continue
                count += 1
                with self.subTest(page=page.name, target=target):
                    self.assertTrue((page.parent / target).exists())
        self.assertGreater(count, 20)

    def test_chaptersAreInTheTable(self):
        index = (ROOT / 'docs' / 'index.md').read_text()
        for page in (ROOT / 'docs').glob('*.md'):
            if page.stem != 'index':
                self.assertIn('\n' + page.stem + '\n', index)

    def test_galleryHasAllExamples(self):
        gallery = (ROOT / 'examples' / 'README.md').read_text()
        for page in (ROOT / 'examples').glob('*/README.md'):
            with self.subTest(page=page.parent.name):
                self.assertIn(f']({page.parent.name}/README.md', gallery)

    def test_ciRunsTheReadmesCommands(self):
        """.ci/run finds them in this way, and would run no tests without one."""
        readme = (ROOT / 'README.md').read_text()
        self.assertEqual(re.findall(r'^    (scripts/[a-z]*) ', readme, re.M), ['scripts/impact', 'scripts/test'])

    def test_noFiguresOfUncommittedSources(self):
        for page in PAGES + sorted((ROOT / 'examples').rglob('*.md')) + sorted(measured_tables.DATA.glob('*.csv')):
            with self.subTest(page=page.name):
                self.assertNotIn('-dirty', page.read_text())


class Figures(unittest.TestCase):
    """Each figure has one source, docs/data, from which the pages are filled."""

    def test_pagesAreThoseOfTheData(self):
        """Otherwise: python3 tests/benchmark/measured_tables.py"""
        count = 0
        for page in measured_tables.pages():
            text = page.read_text()
            count += len(measured_tables.TABLE.findall(text)) + len(measured_tables.FIGURE.findall(text))
            with self.subTest(page=page.name):
                self.assertEqual(text, measured_tables.filled(text))
                self.assertEqual(text.count('<!-- table: '), text.count('<!-- end of table -->'))
                self.assertEqual(text.count('<!-- figure: '), text.count('<!-- end -->'))
        self.assertGreater(count, 20)

    def test_whatMissesIsBold(self):
        rows = {row['against theory']: row['measured'] for row in validation_table.rows()}
        deepest = next(text for what, text in rows.items() if 'deepest overlap' in what)
        self.assertTrue(deepest.startswith('**'), deepest)

    def test_numbers(self):
        self.assertEqual(measured_tables.power(6.42e-5), '6.4·10⁻⁵')
        self.assertEqual(measured_tables.span([1.04, 2.96]), '1.0 to 3.0')


if __name__ == '__main__':
    unittest.main()
