"""Running bond, turned by an angle, with the coordinates that a file has (rounded to so many digits): each brick's corner
lies on the middle of a side of another one, so rounding makes overlaps of 10^-digits m.
Expected: touching bodies from a file can be added, or the message states the overlap and the remedy. Once seen: refused in
18 to 20 of 20 angles for 2 to 10 digits; the message has neither; no argument permits it.
    scripts/yade -n -x tests/pkg/examples/cases/masonry_rounded.py"""
import numpy as np
from yadefrag import *

worst = 0
for digits in (3, 6, 8, 10):
    refused, words = 0, ''
    for angle in np.linspace(.03, 1.5, 20):
        O.reset()
        O.materials.append(FEMat(young=1e9, poisson=.2, density=2000, frictionAngle=.5, label='brick'))
        fe = FESolver()
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        try:
            for row in range(4):
                for k in range(3):
                    x, y = .25 * k + .125 * (row % 2), .065 * row
                    corners = np.round(np.array(rectangle((x, y), (x + .25, y + .065))) @ turn, digits)
                    fe.addPolygon([tuple(c) for c in corners.tolist()], size=.0325, material='brick')
        except ValueError as error:
            refused, words = refused + 1, str(error)
    print('%d digits: refused %d of 20: %s' % (digits, refused, words))
    worst = max(worst, refused)
assert not worst
