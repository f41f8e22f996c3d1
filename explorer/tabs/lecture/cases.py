"""Flights and designs of the source document to begin from."""

from dataclasses import replace

from explorer.model.inputs import Inputs, preset_inflow

FLIGHTS = {"Hover": 0.0, "0.15": 0.15, "0.24": 0.24, "0.37": 0.37}
"""Advance ratios: hover, minimum power, cruise, high speed."""

_THESIS = Inputs(preset="thesis", law="linear", linear=-16.0, advance_ratio=0.0, **preset_inflow("thesis"))
_STATED = {"hover optimum, −13.5°": (0.0, -13.5), "hover, −16°": (0.0, -16.0), "from µ 0.18, −8°": (0.18, -8.0)}
"""What the source document states (chapter 3): advance ratio, linear twist [°]. It does not say of what length."""
_SPAN = 1.0 - _THESIS.design().rotor.blade.root_cutout
DOCUMENT: dict[str, Inputs] = {
    f"Document: {title} {unit}": replace(_THESIS, advance_ratio=mu, linear=round(twist / length, 1))
    for unit, length in (("root to tip", _SPAN), ("per radius", 1.0))
    for title, (mu, twist) in _STATED.items()
}
"""In both readings of its twist, in its preset; first the one that gives more of its statements."""
EXAMPLES: dict[str, Inputs] = {
    "Example: low speed, µ 0.10, −12°": replace(_THESIS, linear=-12.0, advance_ratio=0.1),
    "Example: high speed, µ 0.35, −4°": replace(_THESIS, linear=-4.0, advance_ratio=0.35),
}
"""Our own cases in the preset of the document, which prints no advance ratio for low and high speed."""
CASES = {**DOCUMENT, **EXAMPLES}
"""The menu."""
