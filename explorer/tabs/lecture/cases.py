"""Flights and designs to begin from: what a lecturer sets with one click."""

from dataclasses import replace

from explorer.state import Inputs
from rotor.design.design import THESIS_MODELS

FLIGHTS = {"Hover": 0.0, "0.15": 0.15, "0.24": 0.24, "0.37": 0.37}
"""Advance ratios: hover, the bottom of the power curve, cruise, fast."""

_THESIS = Inputs(preset="thesis", law="linear", linear=-16.0, advance_ratio=0.0, inflow=THESIS_MODELS.inflow)
DOCUMENT: dict[str, Inputs] = {
    "Baseline, hover (−16°)": _THESIS,
    "Hover optimum (−13.5°)": replace(_THESIS, linear=-13.5),
    "Low speed, µ 0.10 (−12°)": replace(_THESIS, linear=-12.0, advance_ratio=0.1),
    "From µ 0.18 on (−8°)": replace(_THESIS, linear=-8.0, advance_ratio=0.18),
    "High speed, µ 0.35 (−4°)": replace(_THESIS, linear=-4.0, advance_ratio=0.35),
}
"""The document's own designs, as it states them (chapter 3): linear twist, its preset."""
