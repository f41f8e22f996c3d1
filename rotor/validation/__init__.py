"""The computed number beside every measured point of rotors that were tested. Nothing is fitted to these points, but
the wake path to the tip vortices of HART II."""

from rotor.validation.airloads import (
    CASES,
    FlownCase,
    MeasuredCurve,
    agreement,
    computed_curve,
    measured_curves,
)
from rotor.validation.compare import (
    Comparison,
    MeasuredSet,
    compare,
    compare_point,
    design_at,
    load_set,
    sets_of,
)
from rotor.validation.trust import TrustRow, coverage, trust_rows
from rotor.validation.uh60a import public_data

__all__ = (
    "CASES", "Comparison", "FlownCase", "MeasuredCurve", "MeasuredSet", "TrustRow", "agreement", "compare",
    "compare_point", "computed_curve", "coverage", "design_at", "load_set", "measured_curves", "public_data", "sets_of",
    "trust_rows",
)  # fmt: skip
