"""Files of other programs: outlines and meshes that are read, bodies and records that are written."""

from yadefrag.io.export import exportVTK
from yadefrag.io.mesh_files import MeshFile, readMesh
from yadefrag.io.outline_report import outlineReport
from yadefrag.io.outlines import readOutline, readPolygon
from yadefrag.io.recorder import FERecorder

__all__ = ['FERecorder', 'MeshFile', 'exportVTK', 'outlineReport', 'readMesh', 'readOutline', 'readPolygon']
