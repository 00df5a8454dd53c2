"""Many runs of a scene: speed against accuracy (tradeoff), statistics (ensemble)."""

from yadefrag.studies.ensemble_runs import ensemble
from yadefrag.studies.ensemble_table import EnsembleTable
from yadefrag.studies.scene_choices import Choices
from yadefrag.studies.table import EnsembleRow
from yadefrag.studies.tradeoff_grid import tradeoff
from yadefrag.studies.tradeoff_table import TradeoffRow, TradeoffTable

__all__ = ['Choices', 'EnsembleRow', 'EnsembleTable', 'TradeoffRow', 'TradeoffTable', 'ensemble', 'tradeoff']
