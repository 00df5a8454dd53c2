"""Outlines from DXF: lines that meet, arcs, bulges, splines, blocks, layers."""
import math
import os

import numpy as np
import pytest

from outline_files import area, offEllipse, offLine, written
from yadefrag import readOutline


def dxf(folder, draw, name='a.dxf'):
    import ezdxf
    document = ezdxf.new('R2010')
    draw(document)
    document.saveas(os.path.join(folder, name))
    return os.path.join(folder, name)


def test_dxfLinesAndArcsThatMeet(folder):
    """A slot: two lines and two half circles, in any order and direction."""
    def draw(document):
        space = document.modelspace()
        space.add_line((0, 0), (10, 0))
        space.add_arc((0, 2), 2, 90, 270)
        space.add_line((0, 4), (10, 4))
        space.add_arc((10, 2), 2, 270, 90)
        space.add_circle((5, 2), 1)
        space.add_text('a note')
    (outline, (hole,)), = readOutline(dxf(folder, draw), 1e-3, scale=.1)
    assert area(outline) == pytest.approx(.4 + math.pi * .04, abs=1e-3 * 2 * math.pi * .2)
    assert area(outline) < .4 + math.pi * .04
    assert max(offEllipse(hole, (.5, .2), .1, .1)) <= 1e-3


def test_dxfPolylineWithBulges(folder):
    """tan(90°/4) is a quarter circle, 1 a half one; clockwise ones are negative."""
    quarter = math.tan(math.pi / 8)

    def draw(document):
        document.modelspace().add_lwpolyline(
            [(0, 0, 0), (4, 0, 1), (4, 4, 0), (0, 4, -quarter)], format='xyb', close=True)
    (outline, holes), = readOutline(dxf(folder, draw), 1e-5)
    segment = math.pi * 8 / 4 - 4  # of the quarter circle with the chord 4: r² = 8
    assert area(outline) == pytest.approx(16 + math.pi * 2 - segment, rel=2e-5) and holes == []
    points = np.array(outline)
    right = points[points[:, 0] > 4 + 1e-9]
    assert np.allclose(np.linalg.norm(right - (4, 2), axis=1), 2)
    assert points[:, 0].max() == pytest.approx(6, abs=1e-5) and (points[:, 0] > -1e-12).all()


def test_dxfOldPolylinesEllipsesBlocksAndMirrors(folder):
    def draw(document):
        space = document.modelspace()
        space.add_polyline2d([(0, 0, 0), (4, 0, 1), (4, 4, 0), (0, 4, 0)], format='xyb', close=True)
        space.add_ellipse((20, 0), (0, 6), .5)
        block = document.blocks.new('hole')
        block.add_circle((0, 0), 1)
        space.add_blockref('hole', (20, 1), dxfattribs=dict(xscale=.5, yscale=.5))
        # Seen from below: x is mirrored.
        space.add_lwpolyline([(10, 0, 0), (14, 0, 1), (14, 4, 0), (10, 4, 0)], format='xyb',
                             close=True, dxfattribs=dict(extrusion=(0, 0, -1)))
    old, ellipse, mirrored = readOutline(dxf(folder, draw), 1e-4)
    assert area(old[0]) == pytest.approx(16 + 2 * math.pi, rel=1e-3)
    assert max(offEllipse(ellipse[0], (20, 0), 3, 6)) <= 1e-4
    assert max(offEllipse(ellipse[1][0], (20, 1), .5, .5)) <= 1e-4
    assert area(mirrored[0]) == pytest.approx(area(old[0]))
    assert min(x for x, _ in mirrored[0]) == pytest.approx(-16, abs=1e-3)


@pytest.mark.parametrize('tolerance', [.1, 1e-3])
def test_dxfSpline(folder, tolerance):
    controls = [(0, 0), (10, -4), (14, 8), (2, 6), (6, 14), (-3, 10)]

    def draw(document):
        document.modelspace().add_open_spline(controls + controls[:1], degree=3)
        document.modelspace().add_line((30, 0), (30, 0))
    file = dxf(folder, draw)
    (outline, holes), = readOutline(file, tolerance)
    import ezdxf
    spline, = ezdxf.readfile(file).modelspace().query('SPLINE')
    curve = np.array([(p.x, p.y) for p in spline.construction_tool().approximate(3000)])
    assert offLine(curve[::7], np.array(outline)) <= tolerance
    assert holes == []


def layered(document):
    """A plate, its bore and the pins, each on its layer; one pin in a block, whose lines are on layer 0."""
    space = document.modelspace()
    for name in ('Plate', 'bore', 'pins'):
        document.layers.add(name)
    square = [(0, 0), (10, 0), (10, 10), (0, 10)]
    space.add_lwpolyline(square, close=True, dxfattribs={'layer': 'Plate'})
    space.add_circle((5, 5), 2, dxfattribs={'layer': 'bore'})
    space.add_circle((5, 5), 1, dxfattribs={'layer': 'pins'})
    block = document.blocks.new('pin')
    block.add_circle((0, 0), .5)
    space.add_blockref('pin', (2, 2), dxfattribs={'layer': 'pins'})


def test_dxfLayersAreChosenByName(folder):
    file = dxf(folder, layered)
    assert [len(holes) for _, holes in readOutline(file, .01)] == [2, 0]  # the plate, the pin in its bore
    [(plate, holes)] = readOutline(file, .01, layers='plate')  # capitals do not count
    assert area(plate) == pytest.approx(100) and holes == []
    [(plate, [bore])] = readOutline(file, .01, layers=['bore', 'Plate'])
    assert abs(area(bore)) == pytest.approx(math.pi * 4, rel=.01)
    pins = readOutline(file, .01, layers='pins')
    assert sorted(area(pin) for pin, _ in pins) == [pytest.approx(math.pi * r**2, rel=.03) for r in (.5, 1)]
    with pytest.raises(ValueError, match="^layers has 'bores', but the layers with lines of .* are "
                                         "'Plate', 'bore', 'pins'.$"):
        readOutline(file, .01, layers=['bores'])
    for wrong in (3, [], [1], b'Plate'):
        with pytest.raises(ValueError, match='^layers is .*the name of a layer, or a list of names'):
            readOutline(file, .01, layers=wrong)
    with pytest.raises(ValueError, match='^layers or byLayer is given, but .*a.csv.* has no layers'):
        readOutline(written(folder, 'a.csv', '0,0\n1,0\n0,1\n'), byLayer=True)


def test_dxfByLayer(folder):
    """A circle on a layer of its own is no hole of what is around it on another one."""
    found = readOutline(dxf(folder, layered), .01, byLayer=True)
    assert list(found) == ['Plate', 'bore', 'pins']
    assert [len(shapes) for shapes in found.values()] == [1, 1, 2]
    assert all(holes == [] for shapes in found.values() for _, holes in shapes)
    few = readOutline(dxf(folder, layered), .01, layers='bore', byLayer=True)
    assert few == {'bore': found['bore']}
