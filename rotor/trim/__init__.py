"""Trim in hover and forward flight: equations, Newton's method, adjoint gradient, power, and the `Solution`."""

from rotor.trim.adjoint import PitchGradient, power_gradient
from rotor.trim.analysis import Analysis
from rotor.trim.hub_loads import deflections, hub_loads, why_no_hub_loads
from rotor.trim.newton import DEFAULT_OPTIONS, Guess
from rotor.trim.solution import DiskFields, HubLoads
from rotor.trim.stability import stability_boundary

__all__ = (
    "DEFAULT_OPTIONS",
    "Analysis",
    "DiskFields",
    "Guess",
    "HubLoads",
    "PitchGradient",
    "deflections",
    "hub_loads",
    "power_gradient",
    "stability_boundary",
    "why_no_hub_loads",
)
