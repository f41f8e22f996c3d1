"""The seam behind which every forward-flight inflow model stands.

A model answers a load on the disk with an induced inflow. At a given wake (µ_x, µ_z, λ0) all of them are linear in the
load, λ_i = A d + b, with A = 0 for the models that prescribe their inflow. What the trim and its adjoint need of A is
how it acts on fields, and the solution of the loop load → inflow → load; no model ever writes A down.

Fields are (elements, azimuths); d = dC_T/dr of the whole rotor as if smeared; stacks of fields lead with their number.
"""

from typing import Protocol

from rotor.aero.disk import Disk
from rotor.aero.inflow.wake_state import Wake
from rotor.arrays import Array


class LoadLoop(Protocol):
    """The loop inflow → load → inflow for a pointwise load slope K = ∂d/∂λ_i."""

    def solve(self, fields: Array) -> Array:
        """z with z − A K z = fields, for a stack of fields."""
        ...

    def solve_transposed(self, field: Array) -> Array:
        """v with v − K Aᵀ v = field."""
        ...


class Response(Protocol):
    """A model's answer at one wake and load."""

    @property
    def induced(self) -> Array:
        """λ_i"""
        ...

    @property
    def by_wake(self) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at fixed load, (3, elements, azimuths)."""
        ...

    def drive(self, fields: Array) -> Array:
        """A f: the inflow that a change of load drives, for a stack of fields."""
        ...

    def drive_transposed(self, field: Array) -> Array:
        """Aᵀ f."""
        ...

    def loop(self, slope: Array) -> LoadLoop:
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
    def reacts(self) -> bool:
        """Whether the inflow answers to where the load is (A ≠ 0).

        A model that does not react takes Prandtl's factor on the section lift; one that does has its blade tips in its
        own wake.
        """
        ...

    def without_tip_loss(self) -> "InflowModel":
        """The model of a rotor that loses nothing at its tips; itself, where that is not the model's to say."""
        ...

    def laid_out(self, expected: Wake) -> "InflowModel":
        """The model for a problem whose wake momentum theory expects so; itself, where the trim moves the wake."""
        ...

    def respond(self, disk: Disk, wake: Wake, load: Array) -> Response:
        """The answer at a wake to a load d(r, ψ); a model that does not react ignores the load."""
        ...
