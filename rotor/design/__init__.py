"""Data types: twist laws, blade, rotor, aircraft, flight condition, and the `Design` that holds them. No arrays."""

from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.aircraft import Flapping, Stand
from rotor.design.twist import (
    REFERENCE_RADIUS,
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    SumTwist,
    TableTwist,
    TwistLaw,
)

__all__ = (
    "REFERENCE_RADIUS", "ActiveTwist", "Flapping", "Harmonic", "IdealTwist", "LinearTwist", "PiecewiseLinearTwist",
    "QuadraticTwist", "SplineTwist", "Stand", "SumTwist", "TableTwist", "TwistLaw",
)  # fmt: skip
