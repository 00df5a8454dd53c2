"""The manual against the code: the sentences that it quotes exist, its links have targets.

Run by scripts/docs, without YADE; the code of the pages is run by tests/pkg/examples/test_docs.py.
"""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'tests' / 'benchmark'))
import measured_tables  # noqa: E402

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
        chapters = re.split(r'^## ', page, flags=re.M)
        rows = [row for chapter in chapters if chapter.startswith(('Bodies', 'Time step', 'Colliders', 'Running'))
                for row in re.findall(r'^\| (.*?) \|', chapter, re.M)]
        quoted = [sentence for row in rows for sentence in re.findall(r'\*(.*?)\*', row)]
        self.assertGreater(len(quoted), 40)
        for sentence in quoted:
            for part in sentence.split('…'):
                part = part.strip(' .')
                if len(part) > 3 and 'unregistered class' not in part:  # YADE's
                    with self.subTest(part=part):
                        self.assertTrue(part in text)

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


    def test_noFiguresOfUncommittedSources(self):
        for page in PAGES + sorted((ROOT / 'examples').rglob('*.md')) + [measured_tables.FILE]:
            with self.subTest(page=page.name):
                self.assertNotIn('-dirty', page.read_text())


class MeasuredTables(unittest.TestCase):
    """The README's tables are those that the benchmarks wrote."""

    def test_theyAreThoseOfTheFile(self):
        data = measured_tables.load()
        text = measured_tables.README.read_text().split(measured_tables.MARKS[0])[1]
        self.assertEqual(text.split(measured_tables.MARKS[1])[0], measured_tables.tables(data))

    def test_percentsAreRatiosToTheReference(self):
        self.assertEqual(measured_tables.percents([1.0217, 1.02, 1.0213]), '+2.0 to +2.2 %')
        self.assertEqual(measured_tables.percents([.9, .9]), '-10.0 %')
        self.assertEqual(measured_tables.power(6.42e-5), '6.4·10⁻⁵')

    def test_aMissingFigureIsNamed(self):
        with self.assertRaisesRegex(ValueError, 'p0 over hertz'):
            measured_tables.used([('HertzContact.Smooth', 'p0_in_MPa', '1')])


if __name__ == '__main__':
    unittest.main()
