"""The table outline_formats.md: what is read of published test files, where they are on the machine.

YADEFRAG_OUTLINE_FILES is a folder with copies of the repositories in folders of their names: `ezdxf`, `resvg`.
"""
import collections
import logging
import os
import re

import numpy as np
import pytest

from outline_files import read
from yadefrag.io.readers import svg

kTable = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'outline_formats.md')
kFiles = os.environ.get('YADEFRAG_OUTLINE_FILES', '')
kRead = re.compile(r'.* is read without: (.*)[.]$')
# What is told and changes the picture.
kTold = ('texts', 'images', 'masks', 'filters', 'markers', 'patterns', 'clip paths', 'external', 'imported', 'foreign',
         'references', 'lengths', 'unusual', 'errors', 'white')


def rows(heading):
    """Cells of the table below a heading."""
    with open(kTable, encoding='utf-8') as file:
        part = file.read().split('## ' + heading + '\n')[1].split('\n## ')[0]
    lines = [line for line in part.splitlines() if line.startswith('|')][2:]
    return [[cell.strip() for cell in line.strip('|').split('|')] for line in lines]


def outcome(file):
    """'3 outlines, 2 holes, without: texts (1)', or why the file is refused."""
    logging.disable(logging.CRITICAL)  # ezdxf's
    try:
        found, words = read(file, .1)
    except ValueError as error:
        reason = re.sub(r'^\S*\.(dxf|DXF)', '', str(error))  # a long path is shortened
        return re.sub(r' at \(.*?\)|: an outline is closed|It is read without.*|[.]$', '', reason).strip(': ')
    finally:
        logging.disable(logging.NOTSET)
    without = kRead.match(words)
    return '%d outlines, %d holes%s' % (len(found), sum(len(holes) for _, holes in found),
                                        ', without: ' + without[1] if without else '')


def asPainted(file):
    """'same' if the regions of an SVG are where its picture is painted, within 1 % of the picture; else 'told' or
    'other'. None for files without a picture, or without a viewBox. Lines and what is beside them are not compared."""
    from PIL import Image, ImageDraw
    picture = file[:-3] + 'png'
    with open(file, encoding='utf-8', errors='replace') as text:
        box = re.search(r'<svg[^>]*viewBox="([^"]*)"', text.read())
    if not box or not os.path.exists(picture):
        return None
    left, top, width, _ = map(float, re.split(r'[\s,]+', box[1].strip()))
    painted = np.asarray(Image.open(picture).convert('RGBA'))[..., 3] > 0
    try:
        found = svg.read(file, .2)
    except ValueError:
        return 'refused'
    scale = painted.shape[1] / width if width else 1
    size = painted.shape[::-1]

    def drawn(loops, lines=()):
        image = Image.new('1', size)
        draw = ImageDraw.Draw(image)
        for i, loop in enumerate(loops):
            draw.polygon([((x - left) * scale, (-y - top) * scale) for x, y in loop], fill=i == 0)
        for line in lines:
            draw.line([((x - left) * scale, (-y - top) * scale) for x, y in line], fill=1, width=14)
        return np.asarray(image)
    inside = np.zeros_like(painted)
    for outline, holes in found.regions:
        inside |= drawn([outline, *holes])
    if ((inside != painted) & ~drawn([], found.lines)).mean() < .01:
        return 'same'
    return 'told' if any(word in what for what in found.leftOut for word in kTold) else 'other'


def test_theTableIsComplete():
    assert len(rows('DXF files of ezdxf')) > 60 and len(rows('SVG files of resvg')) > 40
    for cells in rows('SVG files of resvg'):
        assert len(cells) == 6 and int(cells[1]) == sum(map(int, cells[2:]))


@pytest.mark.parametrize('name, wanted', rows('DXF files of ezdxf'))
def test_dxfFilesOfEzdxf(name, wanted):
    file = os.path.join(kFiles, 'ezdxf', name)
    if not os.path.exists(file):
        pytest.skip('needs the files of ezdxf')
    assert outcome(file) == wanted


@pytest.mark.parametrize('cells', rows('SVG files of resvg'), ids=lambda cells: cells[0])
def test_svgFilesOfResvg(cells):
    folder = os.path.join(kFiles, 'resvg', 'crates/resvg/tests/tests', cells[0])
    if not os.path.isdir(folder):
        pytest.skip('needs the files of resvg')
    assert countsOf(folder) == list(map(int, cells[1:]))


def countsOf(folder):
    """[files, same, told, other, refused]."""
    counts = collections.Counter(asPainted(os.path.join(folder, name)) for name in sorted(os.listdir(folder))
                                 if name.endswith('.svg'))
    del counts[None]
    return [sum(counts.values()), *(counts[one] for one in ('same', 'told', 'other', 'refused'))]
