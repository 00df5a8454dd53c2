"""Files of other programs: outlines and meshes that are read, bodies and records that are written."""

from yadefrag.fe.mesh import MeshFile
from yadefrag.io.mesh_files import readMesh
from yadefrag.io.outlines import outlineReport, readOutline, readPolygon
from yadefrag.io.recorder import FERecorder, exportVTK

__all__ = ['FERecorder', 'MeshFile', 'exportVTK', 'outlineReport', 'readMesh', 'readOutline', 'readPolygon']
