"""The interface of every forward-flight inflow model, and the wake that its answer depends on.

On a disk a model is columns of the engine: what it adds to U_P, and where it answers the load, unknowns at every point
of the grid or a section that balances itself. At a given wake (µ_x, µ_z, λ0) every model is linear in the load.

Fields are (elements, azimuths); d = dC_T/dr of the whole rotor as if smeared.
"""

import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, Self

import numpy as np

from rotor.aero.disk import Disk
from rotor.aero.lifting_line.geometry import WakeCourse
from rotor.aero.section import CHANNELS, FORCES, PAIRS, section
from rotor.arrays import Array
from rotor.design.design import Models
from rotor.engine.linearise import Nodes
from rotor.engine.memory import Memory
from rotor.engine.terms import Shape, Structure


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


class Followed(NamedTuple):
    """What a model makes of a wake, each with slopes by (µ_x, µ_z, λ0)."""

    atoms: Mapping[Hashable, tuple[float, tuple[float, float, float]]]
    """Values of its derived atoms."""
    live: Mapping[tuple[int, Shape], tuple[Array, Array]]
    """Functions along the blade that follow the wake, by channel and name: (elements,) and (3, elements)."""


@dataclass(frozen=True)
class SectionInterface:
    """A section as the engine's structure takes it."""

    section: Callable[[Array, Any, bool, bool], tuple[Array, Array, Array]]
    pairs: tuple[tuple[int, int], ...]
    """Force and channel of each row of its partial derivatives."""
    channels: int
    forces: int
    balanced: int | None = None
    """The force in whose place it returns the inflow that it balances by itself; None without."""
    memory: Callable[[Array, Any], Memory] | None = None
    """How its forces follow the channels at other azimuths; None where they do not."""


PLAIN = SectionInterface(section, PAIRS, len(CHANNELS), len(FORCES))
"""That of `rotor.aero.section`."""


class InflowTerms(Protocol):
    """A model on a disk, as parts of the engine's structure."""

    @property
    def key(self) -> Hashable:
        """The same for the same structure."""
        ...

    def unsteady(self, half_chord: Array) -> "InflowTerms":
        """The same under sections that are unsteady; half_chord: over R, (elements,)."""
        ...

    @property
    def names(self) -> Sequence[Shape]:
        """The shapes of λ_i in the channel UP."""
        ...

    @property
    def live(self) -> Sequence[tuple[int, Shape]]:
        """Channels and names of shapes that follow the wake; each has slopes by shaft tilt and λ0."""
        ...

    @property
    def interface(self) -> "SectionInterface":
        """The section that it needs."""
        ...

    @property
    def least_azimuths(self) -> int:
        """Azimuths on which its equations are near those on all."""
        ...

    def build(self, structure: Structure) -> None:
        """Add derived atoms and columns."""
        ...

    def shapes(self) -> dict[Shape, Array]:
        """Functions along the blade by name, (elements,)."""
        ...

    def follow(self, wake: Wake, mu_z: float, sees_tilt: bool) -> Followed:
        """At a wake; mu_z: axial flow as the blade elements see it, with `sees_tilt` that of the wake."""
        ...

    def start(self) -> Array:
        """A first guess of its nodes, (points,)."""
        ...

    def nodes(self, tolerance: float, thrust: float) -> Nodes | None:
        """Unknowns at every point of the grid, or None; tolerance: of these, thrust: C_T, for the size of steps."""
        ...

    def axial(self, wake: Wake, u_t: Array) -> tuple[Array, Array]:
        """The matrix from an axisymmetric load to the mean inflow in axial flow, and its slopes by U_T at the load.

        (elements, elements) both; u_t: U_T, (elements,).
        """
        ...


class WithoutNodes:
    """The part of `InflowTerms` that is the same for all models without unknowns of their own."""

    def unsteady(self, half_chord: Array) -> Self:
        """Itself: nothing is shed, lift follows in the section."""
        del half_chord
        return self

    def start(self) -> Array:
        """No nodes."""
        return np.zeros(0)

    def nodes(self, tolerance: float, thrust: float) -> Nodes | None:
        """None."""
        return None


class GridAsAsked:
    """The part of `InflowModel` that is the same for all models that are solved on the grid asked for."""

    fine_tip = False
    pointwise = True

    def grid(self, models: Models, blades: int) -> tuple[int, int]:
        """That of the models, of equally wide elements."""
        del blades
        return models.elements, models.azimuths


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
        """Whether the inflow responds to the load distribution.

        With a model that does not, Prandtl's factor multiplies the section lift; one that does has tip losses of its
        own.
        """
        ...

    @property
    def fine_tip(self) -> bool:
        """Whether the elements are panels of a lifting line, which are finer towards the tip; else equally wide."""
        ...

    @property
    def pointwise(self) -> bool:
        """Whether its section is that of `section`, not one that balances itself at each azimuth."""
        ...

    def grid(self, models: Models, blades: int) -> tuple[int, int]:
        """Elements and azimuths on which it is solved."""
        ...

    def without_tip_loss(self) -> "InflowModel":
        """The model without tip loss; the model itself where tip loss is on the section lift or cannot be removed."""
        ...

    def on(self, disk: Disk, course: WakeCourse, losses: tuple[bool, bool]) -> InflowTerms:
        """The model on a disk.

        course: along which a wake of vortices lies; losses: whether Prandtl's factors at tip and hub apply, for a model
        that leaves them to the section lift.
        """
        ...
