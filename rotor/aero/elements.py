"""The blade elements at a trim: velocities, forces and the flow at the sections, and their sums over the disk."""

from dataclasses import dataclass, fields
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from rotor.aero.inflow.interface import DiskFlow
from rotor.aero.section import FLOW, FR, FX, FZ
from rotor.support.arrays import Array, ShortRepr

Unknown = Literal[
    "collective", "cyclic_1c", "cyclic_1s", "shaft_tilt", "coning", "flap_1c", "flap_1s", "lambda0"
]
"""Name of one of the eight quantities, any of which a trim may solve for."""


@dataclass(frozen=True)
class TrimState:
    """Controls, flapping and mean inflow of a trim, angles in radians.

    θ = θ0 + θ1c cos ψ + θ1s sin ψ, and β likewise.
    """

    collective: float = 0.0
    """θ0, the pitch at 0.75 R [rad]."""
    cyclic_1c: float = 0.0
    cyclic_1s: float = 0.0
    shaft_tilt: float = 0.0
    """α [rad], positive forward."""
    coning: float = 0.0
    """β0 [rad], positive up."""
    flap_1c: float = 0.0
    """β1c [rad], negative when the disk tilts back."""
    flap_1s: float = 0.0
    lambda0: float = 0.0
    """Mean induced inflow of momentum theory, over ΩR."""

    @classmethod
    def from_array(cls, values: ArrayLike) -> "TrimState":
        """The state of eight numbers in the order of the fields."""
        return cls(*np.asarray(values, dtype=float).tolist())

    def array(self) -> Array:
        """The eight numbers of the state, in the order of the fields."""
        return np.array(list(vars(self).values()), dtype=float)


STATE_NAMES: tuple[Unknown, ...] = tuple(field.name for field in fields(TrimState))  # pyright: ignore[reportAssignmentType]
"""The eight names, in the order of `TrimState.array`."""


@dataclass(frozen=True, eq=False)
class TwistState:
    """The elastic twist; fields are (elements, azimuths)."""

    coordinates: Array
    """Amplitude of every mode in 1, cos ψ, sin ψ, … [rad], (modes, functions)."""
    twist: Array
    """φ [rad]"""
    moment: Array
    """M of `rotor.aero.section`: that of the air with the propeller moment."""


@dataclass(frozen=True, eq=False)
class BentState:
    """The bending of the blade at a trim state."""

    channels: Array
    """Slopes, curvatures and B, see `rotor.aero.bent_section`, (5, elements, azimuths)."""
    lift: Array
    """d²w/dψ², (elements, azimuths)."""


@dataclass(frozen=True, eq=False, repr=False)
class Unsteady(ShortRepr):
    """The state of dynamic stall at the blade elements, (elements, azimuths) each."""

    separation: Array
    """f″: where the flow leaves the upper surface, over the chord; 1 attached, 0 separated from the leading edge."""
    vortex: Array
    """C_nᵛ, the normal force of the vortex that leaves a stalled leading edge."""
    moment: Array
    """What is added to C_m."""


@dataclass(frozen=True, eq=False)
class BladeElements:
    """The blade elements at a trim state. Fields are (elements, azimuths), names as in `rotor.aero.section`."""

    state: TrimState
    flow: DiskFlow
    """µ_x, µ_z as the blade elements see them, and λ0."""
    theta: Array
    """Pitch with twist [rad]."""
    u_t: Array
    u_p: Array
    u_r: Array
    loss: Array
    """F"""
    rate: Array
    """dθ/dψ"""
    beta: Array
    """Flapping angle, (azimuths,)."""
    induced: Array
    """λ_i"""
    swirl: Array
    """Swirl of the air in the disk, over ΩR, in the direction of rotation: U_T is less by it, (elements,)."""
    fz: Array
    fx: Array
    fr: Array
    alpha: Array
    mach: Array
    cl: Array
    cd: Array
    cd_mach: Array
    torsion: TwistState | None = None
    """None for a rigid blade."""
    bent: BentState | None = None
    """State of a blade that bends. Velocities and forces are then in axes that turn with the hub, not its slopes."""
    rates: Array | None = None
    """θ'', U_T' and U_P' in unsteady flow, see `rotor.aero.unsteady_section`, (3, elements, azimuths)."""
    unsteady: Unsteady | None = None
    """None without dynamic stall."""


@dataclass(frozen=True)
class DiskSums:
    """Sums over the disk as coefficients over ρA(ΩR)²."""

    thrust: float
    """C_T along the shaft, eq. (3.12)."""
    drag: float
    """C_H, aft in the hub plane: Σ (F_x sin ψ + F_r cos ψ − β F_z cos ψ); F_r of a blade that bends holds its lean."""
    torque: float
    """C_Q: Σ r F_x, of a blade that lies forward of its azimuth by y with Σ y F_r."""
    motion: float = 0.0
    """Power of the air on the blade's motion, over ρA(ΩR)³."""
    damping: float = 0.0
    """That which dampers of further freedoms take."""


FLOW_FIELDS = ("theta", "u_t", "u_p", "u_r", "loss", "rate", "induced")
SECTION_FIELDS = ("fz", "fx", "fr", "alpha", "mach", "cl", "cd", "cd_mach")
"""Fields of `BladeElements` by element and azimuth: what meets the section, and what comes of it."""


def section_fields(forces: Array, flow: Array) -> dict[str, Any]:
    """`SECTION_FIELDS` and `unsteady` by name, of the forces and the flow of a section.

    A section with dynamic stall has the fields of `Unsteady` after `section.FLOW`.
    """
    steady, further = flow[: len(FLOW)], flow[len(FLOW) :]
    values = dict(zip(SECTION_FIELDS, (forces[FZ], forces[FX], forces[FR], *steady), strict=True))
    return values | {"unsteady": Unsteady(*further) if len(further) else None}


def over_azimuths(values: Array, azimuths: int) -> Array:
    """Spread values that do not change with azimuth, (elements,) → (elements, azimuths)."""
    return np.repeat(values[:, None], azimuths, axis=1)
