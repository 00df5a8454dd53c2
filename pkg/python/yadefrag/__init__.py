"""Contact search and finite-element bodies for YADE.

`import yadefrag` in a script run by `yade` adds the classes to yade.wrapper, as YADE does with its
own classes, and to the names that every script can use. In any other YADE it raises ImportError
with one sentence.
"""

import builtins
import sys

from yadefrag import support

if support.isReportAsked():  # python3 -m yadefrag: in a Python without YADE nothing else can be imported
    from yadefrag import about_run
    sys.exit(about_run.main())

support.require()

# Only after the check: without the right YADE these may not exist, or may not load.
from yade import wrapper  # noqa: E402
from yadefrag import _yadefrag  # noqa: E402

_yadefrag.checkRunningYade()
__all__ = list(_yadefrag.publish())

# Only now, because these need FESolver.
from yadefrag import attributes, bounds, lifecycle, mpy, solver  # noqa: E402
from yadefrag.about import about  # noqa: E402
from yadefrag.calls import inWords  # noqa: E402
from yadefrag.engines import engines  # noqa: E402
from yadefrag.ensemble import ensemble  # noqa: E402
from yadefrag.ensemble_table import EnsembleTable  # noqa: E402
from yadefrag.export import exportVTK  # noqa: E402
from yadefrag.fragments import (fragmentTable, plotFracture, plotFragmentSizes,  # noqa: E402
                                 recordFracture)
from yadefrag.geometry import (circle, grainJoints, readPolygon, rectangle, ring,  # noqa: E402
                                voronoi)
from yadefrag.mesh_files import readMesh  # noqa: E402
from yadefrag.order import inCurveOrder  # noqa: E402
from yadefrag.outline_report import outlineReport  # noqa: E402
from yadefrag.outlines import readOutline  # noqa: E402
from yadefrag.pictures import animate, plotMesh  # noqa: E402
from yadefrag.progress import runSteps  # noqa: E402
from yadefrag.recorder import FERecorder  # noqa: E402
from yadefrag.results import crackTable  # noqa: E402
from yadefrag.snapping import snapOutlines  # noqa: E402
from yadefrag.solver import rectangleMesh  # noqa: E402
from yadefrag.tradeoff import tradeoff  # noqa: E402
from yadefrag.tradeoff_table import TradeoffTable  # noqa: E402


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
lifecycle.install()
mpy.install()
bounds.install([name for name in __all__ if name.endswith('Collider')])
_renewDispatchers()
for _name in __all__:
    globals()[_name] = getattr(wrapper, _name)
    setattr(builtins, _name, globals()[_name])
    attributes.install(globals()[_name])

__all__ += ['rectangle', 'circle', 'ring', 'readPolygon', 'readOutline', 'readMesh',
            'outlineReport', 'snapOutlines', 'voronoi', 'grainJoints', 'rectangleMesh', 'plotMesh', 'animate',
            'exportVTK', 'runSteps', 'fragmentTable', 'plotFragmentSizes', 'recordFracture',
            'plotFracture', 'crackTable', 'engines', 'FERecorder', 'tradeoff', 'TradeoffTable',
            'ensemble', 'EnsembleTable', 'inCurveOrder', 'about']
for _name in __all__:
    if type(globals()[_name]) is type(inWords):
        globals()[_name] = inWords(globals()[_name])
__version__ = support.YADEFRAG
