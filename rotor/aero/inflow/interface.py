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
    """Flow through the disk as momentum theory sees it; all over ΩR."""

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
    """The loop inflow → load → inflow for a pointwise load slope K = ∂d/∂λ_i."""

    def solve(self, fields: Array) -> Array:
        """z with z − A K z = fields, for a stack of fields."""
        ...

    def solve_transposed(self, field: Array) -> Array:
        """v with v − K Aᵀ v = field."""
        ...


class InflowResponse(Protocol):
    """A model's answer at one wake and load."""

    @property
    def induced(self) -> Array:
        """λ_i"""
        ...

    @property
    def by_wake(self) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at fixed load, (3, elements, azimuths)."""
        ...

    def apply(self, fields: Array) -> Array:
        """A f: the inflow that a change of load drives, for a stack of fields."""
        ...

    def apply_transposed(self, field: Array) -> Array:
        """Aᵀ f."""
        ...

    def feedback(self, slope: Array) -> InflowFeedback:
        """The loop for K, (elements, azimuths)."""
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
        """One line for the page: what it is, and from whom."""
        ...

    @property
    def load_dependent(self) -> bool:
        """Whether the inflow answers to where the load is (A ≠ 0).

        A model that does not react takes Prandtl's factor on the section lift; one that does has its blade tips in its
        own wake.
        """
        ...

    def without_tip_loss(self) -> "InflowModel":
        """The model of a rotor that loses nothing at its tips; itself, where that is not the model's to say."""
        ...

    def with_wake_geometry(self, expected: Wake) -> "InflowModel":
        """The model for a problem whose wake momentum theory expects so; itself, where the trim moves the wake."""
        ...

    def respond(self, disk: Disk, wake: Wake, load: Array) -> InflowResponse:
        """The answer at a wake to a load d(r, ψ); a model that does not react ignores the load."""
        ...
