"""Flight conditions and designs that a lecturer sets with one click."""

from dataclasses import replace

from explorer.state import Inputs
from rotor.design.design import THESIS_MODELS

FLIGHTS = {"Hover": 0.0, "0.15": 0.15, "0.24": 0.24, "0.37": 0.37}
"""Advance ratios: hover, minimum power, cruise, high speed."""

_THESIS = Inputs(preset="thesis", law="linear", linear=-16.0, advance_ratio=0.0, inflow=THESIS_MODELS.inflow)
DOCUMENT: dict[str, Inputs] = {
    "Document: hover, −16° (baseline)": _THESIS,
    "Document: hover optimum, −13.5°": replace(_THESIS, linear=-13.5),
    "Document: from µ 0.18, −8°": replace(_THESIS, linear=-8.0, advance_ratio=0.18),
}
"""Designs whose twist and flight condition the source document states (chapter 3): linear twist, its preset."""
EXAMPLES: dict[str, Inputs] = {
    "Example: low speed, µ 0.10, −12°": replace(_THESIS, linear=-12.0, advance_ratio=0.1),
    "Example: high speed, µ 0.35, −4°": replace(_THESIS, linear=-4.0, advance_ratio=0.35),
}
"""Our own cases in the preset of the document, which prints no advance ratio for low and high speed."""
CASES = {**DOCUMENT, **EXAMPLES}
"""The menu."""
