"""Pictures of bodies, their fragments and cracks, with Matplotlib."""

from yadefrag.plots.axes import fragmentColours
from yadefrag.plots.fragments import plotFracture, plotFragmentSizes
from yadefrag.plots.pictures import animate, plotMesh

__all__ = ['animate', 'fragmentColours', 'plotFracture', 'plotFragmentSizes', 'plotMesh']
