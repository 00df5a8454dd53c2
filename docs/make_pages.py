"""Copies all pages of the manual, as Sphinx reads them, into a folder: make_pages.py FOLDER (scripts/docs calls it).

Chapters, examples and the maps of lib/ and pkg/ side by side, their links changed accordingly; the tables of
examples/README.md become a gallery of thumbnails.
"""
import os
import pathlib
import re
import shutil
import sys

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[1]
MOVED = {'README.md': 'index.md', 'CONTRIBUTING.md': 'contributing.md', 'lib/README.md': 'method.md', 'pkg/README.md': 'interface.md'}
# A row of the gallery: | [title](page) | text ![](picture) |
ROW = re.compile(r'\| \[(.*?)\]\((.*?)\) \| (.*?) ?!\[.*?\]\((.*?)\) \|')
WIDTH = 360  # px of a thumbnail, twice what a page shows


def place(path):
    """Where a file of the project is in the manual, both from the root folder; None if it is not there."""
    name = path.as_posix()
    if name in MOVED:
        return pathlib.Path(MOVED[name])
    if path.parts[0] == 'docs':
        return pathlib.Path(*path.parts[1:])
    return path if path.parts[0] == 'examples' and path.suffix in ('.md', '.png', '.gif', '.py') else None


def link(source, target):
    """A Markdown target as it is in the manual, or None for a file that the manual does not have."""
    path, _, part = target.partition('#')
    file = (ROOT / source).parent / path
    if '://' in target or not path or not file.exists():  # tests/docs_test.py checks them
        return target
    found = place(file.resolve().relative_to(ROOT))
    if found is None:
        return None
    return os.path.relpath(found, place(source).parent) + ('#' + part if part else '')


def page(source):
    """The text of a page, from the root folder, with the links that it has in the manual."""
    # A link in a link is a picture, which is always there.
    text = re.sub(r'\]\(([^()\s]+)\)', lambda match: f']({link(source, match[1]) or "nowhere"})', (ROOT / source).read_text())
    return re.sub(r'\[([^\[\]]*)\]\(nowhere\)', r'\1', text)


def gallery(text, thumbnails):
    """The page of the examples, with a grid of thumbnails for each table."""
    def cards(match):
        rows = [ROW.fullmatch(line) for line in match[0].strip().splitlines()[2:]]
        return '\n<div class="gallery">\n' + '\n'.join(card(*row.groups()) for row in rows) + '\n</div>\n'

    def card(title, target, about, picture):
        name = picture.replace('/', '_')
        thumbnail(ROOT / 'examples' / picture, thumbnails / name)
        about = re.sub(r' \(scripts/.*?\)', '', about.replace('`', ''))
        return (f'<a href="{target.replace(".md", ".html")}"><img src="../_static/thumbnails/{name}" alt="">'
                f'<strong>{title}</strong><span>{about}</span></a>')
    return re.sub(r'\n(\|.*\|\n)+', cards, text)


def thumbnail(picture, file):
    """A small copy on white, 3 : 2."""
    with Image.open(picture) as whole:
        small = whole.convert('RGBA')
    small.thumbnail((WIDTH, WIDTH * 2 // 3))
    paper = Image.new('RGB', (WIDTH, WIDTH * 2 // 3), 'white')
    paper.paste(small, ((WIDTH - small.width) // 2, (paper.height - small.height) // 2), small)
    file.parent.mkdir(parents=True, exist_ok=True)
    paper.save(file)


def main(folder):
    """Writes all."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / 'docs', folder)
    for path in sorted((ROOT / 'examples').rglob('*')):
        if path.suffix in ('.png', '.gif', '.py') and not path.is_symlink():
            file = folder / path.relative_to(ROOT)
            file.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, file)
    sources = [*(ROOT / 'docs').glob('*.md'), *(ROOT / 'examples').rglob('*.md'), *(ROOT / name for name in MOVED)]
    for source in sorted(path.relative_to(ROOT) for path in sources):
        if source.as_posix() == 'README.md':  # docs/index.md is the first page
            continue
        text = page(source)
        if source.as_posix() == 'examples/README.md':
            text = gallery(text, folder / 'static' / 'thumbnails')
        if source.parts[:2] == ('examples', 'tradeoff') and source.name != 'README.md':  # that page links to it
            text = '---\norphan: true\n---\n' + text
        (folder / place(source)).write_text(text)


if __name__ == '__main__':
    main(pathlib.Path(sys.argv[1]).resolve())
