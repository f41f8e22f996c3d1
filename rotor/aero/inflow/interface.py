"""The interface of every forward-flight inflow model, and the wake that its answer depends on.

A model gives the inflow induced by a load on the disk. At a given wake (µ_x, µ_z, λ0) every model is linear in the
load, λ_i = A d + b, with A = 0 for the models that prescribe their inflow. The trim and its adjoint need the action of
A on fields and the solution of the feedback load → inflow → load; no model forms A.

Fields are (elements, azimuths); d = dC_T/dr of the whole rotor as if smeared; stacks of fields lead with their number.
"""

import math
from dataclasses import dataclass
from typing import Protocol

from rotor.aero.disk import Disk
from rotor.arrays import Array


@dataclass(frozen=True)
class Wake:
    """Flow through the disk by momentum theory; all over ΩR."""

    mu_x: float
    """Advance ratio in the disk plane, µ cos α."""
    mu_z: float
    """Advance ratio through the disk, µ sin α, positive down."""
    lambda0: float
    """Mean induced inflow of momentum theory."""

    @property
    def axial(self) -> float:
        return self.mu_z + self.lambda0

    @property
    def speed(self) -> float:
        return math.hypot(self.mu_x, self.axial)


class InflowFeedback(Protocol):
    """The feedback inflow → load → inflow for a pointwise load slope K = ∂d/∂λ_i."""

    def solve(self, fields: Array) -> Array:
        """z with z − A K z = fields, for a stack of fields."""
        ...

    def solve_transposed(self, field: Array) -> Array:
        """v with v − K Aᵀ v = field."""
        ...


class InflowResponse(Protocol):
    """The response of a model to one load at one wake."""

    @property
    def induced(self) -> Array:
        """λ_i"""
        ...

    @property
    def by_wake(self) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at fixed load, (3, elements, azimuths)."""
        ...

    def apply(self, fields: Array) -> Array:
        """A f: the inflow induced by a change of load f, for a stack of fields."""
        ...

    def apply_transposed(self, field: Array) -> Array:
        """Aᵀ f."""
        ...

    def feedback(self, slope: Array) -> InflowFeedback:
        """The feedback for K, (elements, azimuths)."""
        ...


class InflowModel(Protocol):
    """A forward-flight inflow model."""

    @property
    def name(self) -> str:
        """As on the command line."""
        ...

    @property
    def title(self) -> str:
        """As on the page."""
        ...

    @property
    def explanation(self) -> str:
        """One line for the page: what the model is, and its source."""
        ...

    @property
    def load_dependent(self) -> bool:
        """Whether the inflow responds to the load distribution (A ≠ 0).

        With a model that does not, Prandtl's factor multiplies the section lift; one that does has tip losses of its
        own.
        """
        ...

    def without_tip_loss(self) -> "InflowModel":
        """The model without tip loss; the model itself where tip loss is on the section lift or cannot be removed."""
        ...

    def with_wake_geometry(self, expected: Wake) -> "InflowModel":
        """The model with its wake geometry fixed as momentum theory expects; itself where the wake follows the trim."""
        ...

    def respond(self, disk: Disk, wake: Wake, load: Array) -> InflowResponse:
        """The response at a wake to a load d(r, ψ), which a model that is not load-dependent ignores."""
        ...
