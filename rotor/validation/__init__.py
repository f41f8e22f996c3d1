"""Our number beside every measured point of rotors that were tested. Nothing is fitted to these points."""

from rotor.validation.airloads import FlownCase, MeasuredCurve, measured_curves
from rotor.validation.compare import Comparison, compare, compare_point, design_at
from rotor.validation.measured import MeasuredSet, load_set, sets_of
from rotor.validation.trust import SensitivityRow, TrustRow, sensitivity_rows, trust_rows

__all__ = (
    "Comparison",
    "FlownCase",
    "MeasuredCurve",
    "MeasuredSet",
    "SensitivityRow",
    "TrustRow",
    "compare",
    "compare_point",
    "design_at",
    "load_set",
    "measured_curves",
    "sensitivity_rows",
    "sets_of",
    "trust_rows",
)
