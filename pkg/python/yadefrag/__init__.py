"""Contact search and finite-element bodies for YADE.

`import yadefrag` in a script run by `yade` adds the classes to yade.wrapper, as YADE does with its
own classes, and to the names that every script can use. In any other YADE it raises ImportError
with one sentence.

Subpackages by what is sought: studies (many runs of a scene), io (readers and exporters of files), plots
(pictures), fe (FESolver's bodies), scene (colliders, engines and runs of YADE's scene).
"""

import builtins
import sys
from typing import TYPE_CHECKING

from yadefrag import support

if support.isReportAsked():  # python3 -m yadefrag: in a Python without YADE nothing else can be imported
    from yadefrag import __main__ as report
    sys.exit(report.main())

support.require()

# Only after the check: without the right YADE these may not exist, or may not load.
from yade import wrapper  # noqa: E402
from yadefrag import _yadefrag  # noqa: E402

if TYPE_CHECKING:  # what publish() adds
    from yade.wrapper import (Bo1_SurfaceSegment_Aabb, BrittleFEMat, CurveIntegrator, CurveLoop, FEMat, FESolver,
                              FrictionalFEMat, Gl1_SurfaceSegment, HierarchyCollider, Ig2_Sphere_SurfaceSegment_ScGeom,
                              LebesgueCollider, LinearCodeCollider, PlasticFEMat, SurfaceSegment)
    __all__ = ['Bo1_SurfaceSegment_Aabb', 'BrittleFEMat', 'CurveIntegrator', 'CurveLoop', 'FEMat', 'FESolver',
               'FrictionalFEMat', 'Gl1_SurfaceSegment', 'HierarchyCollider', 'Ig2_Sphere_SurfaceSegment_ScGeom',
               'LebesgueCollider', 'LinearCodeCollider', 'PlasticFEMat', 'SurfaceSegment']
else:
    __all__ = list(_yadefrag.publish())

# Only now, because these need FESolver.
from yadefrag import io, plots, studies  # noqa: E402
from yadefrag.fe import solver  # noqa: E402
from yadefrag.fe.fields import crackTable  # noqa: E402
from yadefrag.fe.geometry import circle, grainJoints, rectangle, ring, voronoi  # noqa: E402
from yadefrag.fe.mesh import Mesh, polygonMesh, rectangleMesh
from yadefrag.fe.neighbours import snapOutlines  # noqa: E402
from yadefrag.io import FERecorder, exportVTK, outlineReport, readMesh, readOutline, readPolygon  # noqa: E402
from yadefrag.messages import checkedCall  # noqa: E402
from yadefrag.plots import animate, plotFracture, plotFragmentSizes, plotMesh  # noqa: E402
from yadefrag.plots.fragments import fragmentTable, recordFracture  # noqa: E402
from yadefrag.scene import guards, lifecycle, mpy  # noqa: E402
from yadefrag.scene.engines import engines, inCurveOrder, installColliders
from yadefrag.scene.lifecycle import runSteps  # noqa: E402
from yadefrag.support import about  # noqa: E402
from yadefrag.studies import EnsembleTable, TradeoffTable, ensemble, tradeoff  # noqa: E402


def _renewDispatchers():
    """Dispatchers created before the import have no entries for the new shapes and materials."""
    for engine in wrapper.Omega().engines:
        for holder in ('boundDispatcher', 'geomDispatcher', 'physDispatcher', 'lawDispatcher'):
            dispatcher = getattr(engine, holder, None)
            if dispatcher is not None:
                dispatcher.functors = dispatcher.functors
    viewer = sys.modules.get('yade.qt._GLViewer')
    if viewer:
        _yadefrag.renewRenderer(viewer.Renderer())


solver.install()
guards.guardBodies()
lifecycle.install()
mpy.install()
installColliders([name for name in __all__ if name.endswith('Collider')])
_renewDispatchers()
for _name in __all__:
    globals()[_name] = getattr(wrapper, _name)
    setattr(builtins, _name, globals()[_name])
    guards.guardAttributes(globals()[_name])

__all__ += ['rectangle', 'circle', 'ring', 'readPolygon', 'readOutline', 'readMesh', 'outlineReport', 'snapOutlines',
            'voronoi', 'grainJoints', 'Mesh', 'polygonMesh', 'rectangleMesh', 'plotMesh', 'animate', 'exportVTK',
            'runSteps', 'fragmentTable', 'plotFragmentSizes', 'recordFracture', 'plotFracture', 'crackTable',
            'engines', 'FERecorder', 'tradeoff', 'TradeoffTable', 'ensemble', 'EnsembleTable', 'inCurveOrder', 'about']
for _name in __all__:
    if type(globals()[_name]) is type(checkedCall):
        _function = checkedCall(globals()[_name])
        for _part in (sys.modules[__name__], io, plots, studies):
            if hasattr(_part, _name):
                setattr(_part, _name, _function)
__version__ = support.YADEFRAG
