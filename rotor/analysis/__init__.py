"""Results from many solutions: sweeps, the power waterfall, the ideal bound."""

from rotor.analysis.ideal_bound import find_bound, ideal_factor, not_bounded
from rotor.analysis.series import SweepTable, Waterfall, between_drag_areas, sweep, waterfall

__all__ = (
    "SweepTable",
    "Waterfall",
    "between_drag_areas",
    "find_bound",
    "ideal_factor",
    "not_bounded",
    "sweep",
    "waterfall",
)
