"""The interface of every forward-flight inflow model.

On a disk a model is columns of the engine: what it adds to U_P, and where it answers the load, unknowns at every point
of the grid or a section that balances itself. At a given flow (µ_x, µ_z, λ0) every model is linear in the load.

Fields are (elements, azimuths); d = dC_T/dr of the whole rotor as if smeared.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rotor.aero.disk import Disk
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.momentum import DiskFlow
from rotor.aero.section import CHANNELS, FORCES, PAIRS, section
from rotor.design.design import TRIM_AZIMUTHS, Models
from rotor.design.quantities import LossOn
from rotor.engine.linearise import Nodes
from rotor.engine.memory import LagFactors
from rotor.engine.terms import ONE, Shape, Structure
from rotor.engine.waves import STEADY
from rotor.support.arrays import Array, Integers

Atoms = dict[Hashable, tuple[float, tuple[float, float, float]]]
"""Values of derived atoms, with slopes by (µ_x, µ_z, λ0)."""


class FlowTerms(NamedTuple):
    """What a model derives from a flow, with slopes by (µ_x, µ_z, λ0)."""

    atoms: Atoms
    live: Mapping[tuple[int, Shape], tuple[Array, Array]]
    """Functions along the blade that follow the flow, by channel and name: (elements,) and (3, elements)."""


@dataclass(frozen=True)
class SectionInterface:
    """The section model in the form that the engine's structure needs."""

    section: Callable[[Array, Any, bool, bool], tuple[Array, Array, Array]]
    pairs: tuple[tuple[int, int], ...]
    """Force and channel of each row of its partial derivatives."""
    channels: int
    forces: int
    balanced: int | None = None
    """The force in whose place it returns the inflow that it balances by itself; None without."""
    memory: Callable[[Array, Any], LagFactors] | None = None
    """How its forces follow the channels at other azimuths; None where they do not."""


def places_of(pairs: Sequence[tuple[int, int]], forces: int, channels: int) -> Integers:
    """Row of each force and channel among partial derivatives, −1 where they have none, (forces, channels)."""
    out = np.full((forces, channels), -1, dtype=np.int64)
    for row, pair in enumerate(pairs):
        out[pair] = row
    return out


PLAIN = SectionInterface(section, PAIRS, len(CHANNELS), len(FORCES))
"""The section of `rotor.aero.section`."""


class Losses(NamedTuple):
    """Prandtl's factors, for a model without tip losses of its own."""

    tip: bool
    hub: bool
    on: LossOn = "lift"
    """What the factors act on, see `Models.loss_on`."""
    spacing: float = 1.0
    """Factor on f of the tip, so on the distance between the sheets of the wake there."""


class InflowTerms:
    """A model on a disk, as parts of the engine's structure; one without unknowns of its own where nothing is said."""

    key: Hashable
    """Equal for terms of equal structure."""
    names: Sequence[Shape] = ()
    """The shapes of λ_i in the channel UP."""
    live: Sequence[tuple[int, Shape]] = ()
    """Channels and names of shapes that follow the flow; each has slopes by shaft tilt and λ0."""
    interface = PLAIN
    """The section that it needs."""
    least_azimuths = 1
    """Azimuths on which its equations are near those on all."""

    def unsteady(self, half_chord: Array) -> "InflowTerms":
        """The terms under sections that are unsteady; half_chord: over R, (elements,).

        Itself where nothing is shed: lift follows in the section.
        """
        del half_chord
        return self

    def build(self, structure: Structure) -> None:
        """Add derived atoms and columns."""

    def live_columns(self, structure: Structure) -> list[tuple[int, Shape, int, int]]:
        """Channel and name of each live shape, with the wave and the atom that multiply it."""
        del structure
        return [(channel, name, STEADY, ONE) for channel, name in self.live]

    def shapes(self) -> dict[Shape, Array]:
        """The functions along the blade by name, (elements,)."""
        return {}

    def follow(self, flow: DiskFlow, mu_z: float, sees_tilt: bool) -> FlowTerms:
        """At a flow; mu_z: axial flow as the blade elements see it, with `sees_tilt` that of the disk."""
        del flow, mu_z, sees_tilt
        return FlowTerms({}, {})

    def nodes(self, tolerance: float, thrust: float) -> Nodes | None:
        """Unknowns at every point of the grid, or None; tolerance: of these, thrust: C_T, for the size of steps."""
        del tolerance, thrust

    def off_disk(self, points: Array, nodes: Array | None) -> Array | None:
        """Mean over time of the inflow along the shaft at points off the disk, (points, 3) over R in axes of the shaft.

        nodes: what was solved for. None for a model that knows the disk alone.
        """
        del points, nodes

    def axial(self, flow: DiskFlow, u_t: Array) -> tuple[Array, Array]:
        """The matrix from an axisymmetric load to the mean inflow in axial flow, and its slopes by U_T at the load.

        (elements, elements) both; u_t: U_T, (elements,). Zero where the load does not change it.
        """
        del flow
        return np.zeros((len(u_t),) * 2), np.zeros((len(u_t),) * 2)


class InflowModel(ABC):
    """A forward-flight inflow model: all that others know of it, so a further one is a file with its `MODELS`."""

    name: str
    """Name on the command line."""
    title: str
    """Title on the page."""
    explanation: str
    """One line for the page: what the model is, and its source."""
    load_dependent: bool
    """Whether the inflow responds to the load distribution.

    A model that does not takes Prandtl's factors, see `Models.loss_on`; one that does has tip losses of its own.
    """
    fine_tip = False
    """Whether the elements are panels of a lifting line, which are finer towards the tip; else equally wide."""
    pointwise = True
    """Whether its section is that of `section`, not one that balances itself at each azimuth."""

    wake_along: str | None = None
    """Name of the model along whose trim its wake of vortices lies, and from whose trim it starts; None without such a
    wake, see `rotor.trim.forward`."""
    keeps_tips = False
    """Whether tip loss is part of its answer to the load, and cannot be left out."""
    usual = False
    """Whether most rotor codes have such a model: `rotor.trim.doubt` gives the power with it as well."""
    in_index_band = False
    """Whether `rotor.trim.hub_loads` gives the vibration index with it as well."""

    def grid(self, models: Models, blades: int) -> tuple[int, int]:
        """Elements and azimuths on which it is solved: those asked for. ValueError for more than it can have."""
        del blades
        return models.elements, models.azimuths or TRIM_AZIMUTHS

    @abstractmethod
    def on(self, disk: Disk, course: WakeCourse, losses: Losses) -> InflowTerms:
        """The model on a disk.

        course: along which a wake of vortices lies; losses: for a model that has none of its own.
        """
