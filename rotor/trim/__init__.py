"""Trim in hover and forward flight: equations, Newton's method, adjoint gradient, power, and the `Solution`."""

from rotor.trim.adjoint import PitchGradient
from rotor.trim.analysis import Analysis, power_gradient
from rotor.trim.hub_loads import HubLoads
from rotor.trim.many import analyse_many
from rotor.trim.newton import DEFAULT_OPTIONS, Guess, SolverOptions
from rotor.trim.no_hub_loads import why_no_hub_loads
from rotor.trim.solution import DiskFields
from rotor.trim.solve import analyse

__all__ = (
    "DEFAULT_OPTIONS", "Analysis", "DiskFields", "Guess", "HubLoads", "PitchGradient", "SolverOptions", "analyse",
    "analyse_many", "power_gradient", "why_no_hub_loads",
)  # fmt: skip
