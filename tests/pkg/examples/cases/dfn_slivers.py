"""Fracture traces as a geologist maps them: ends that miss or cross another trace by a hair (here 10^-5 of the size).
Expected: near ends are joined within a tolerance, or the message names a remedy that works. Once seen: a triangle of that height,
a critical step thousands of times shorter; the message advises simplify=, which has no effect on joints.
    scripts/yade -n -x tests/pkg/examples/cases/dfn_slivers.py"""
import warnings
from yadefrag import *

joints = [((0, .5), (1, .52)), ((.3, 0), (.3, .50601)), ((.6, 1), (.6, .51199)), ((.1, .9), (.9, .9)), ((.1, .90001), (.9, .9))]
steps = []
for simplify in (None, .01):
    O.reset()
    O.materials.append(BrittleFEMat(young=30e9, poisson=.25, density=2600, frictionAngle=.5, tensileStrength=5e6, label='rock'))
    fe = FESolver()
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter('always')
        fe.addPolygon(rectangle((0, 0), (1, 1)), size=.05, material='rock', joints=joints, jointStrength=0, simplify=simplify)
    steps.append(fe.criticalTimeStep())
    print('simplify %s: critical step %.3g s; %s' % (simplify, steps[-1], [str(w.message) for w in seen]))
assert steps[1] > 100 * steps[0] or 'simplify' not in str(seen[0].message)
