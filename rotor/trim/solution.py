"""What a solve returns: status and sentence, trim, fields over the disk, power by parts."""

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np

from rotor.arrays import Array
from rotor.design.design import Design


class Status(Enum):
    """How a solve ended."""

    CONVERGED = "converged"
    NOT_CONVERGED = "not-converged"


@dataclass(frozen=True)
class Caveat:
    """A reason to read the numbers with care."""

    name: str
    """Short and stable, for scripts, for example low-speed-inflow."""
    sentence: str
    """What the user reads."""


@dataclass(frozen=True)
class Controls:
    """The trim, all angles in radians. θ = θ0 + θ1c cos ψ + θ1s sin ψ, β likewise."""

    collective: float
    """θ0, the pitch at 0.75 R."""
    cyclic_1c: float
    cyclic_1s: float
    shaft_tilt: float
    """α, positive forward."""
    coning: float
    """β0, positive up."""
    flap_1c: float
    """β1c, negative when the disk tilts back."""
    flap_1s: float
    lambda0: float
    """Mean induced inflow of momentum theory, over ΩR."""


@dataclass(frozen=True, eq=False)
class DiskFields:
    """The flow and the loads over the disk; arrays are (elements, azimuths) unless said otherwise."""

    r: Array
    """Element centres y/R, (elements,)."""
    dr: float
    """Element width over R."""
    psi: Array
    """Azimuth [rad], 0 over the tail, (azimuths,)."""
    theta: Array
    """Pitch with twist [rad]."""
    u_t: Array
    """In-plane velocity normal to the blade, over ΩR."""
    u_p: Array
    """Velocity down through the blade, over ΩR."""
    induced: Array
    """λ_i, over ΩR."""
    inflow: Array
    """Total inflow through the disk, µ_z + λ_i, over ΩR."""
    alpha: Array
    """Angle of attack at the blade's reference line [rad], in (−π, π]."""
    mach: Array
    cl: Array
    cd: Array
    cd_mach: Array
    """∂C_d/∂M, whose value 0.1 marks drag divergence."""
    stall_margin: Array
    """Angle of attack left before stall [rad], negative when stalled; NaN-free, π/2 in reverse flow."""
    dct: Array
    """dC_T/dr of the whole rotor as if smeared."""
    dcq: Array
    """In-plane force dC_H-like loading (drag direction) of the whole rotor as if smeared; dC_P/dr = r·dcq."""


@dataclass(frozen=True)
class PowerBudget:
    """Power by parts [W]."""

    induced: float
    """Σ λ_i dF_z"""
    profile: float
    """Σ U dD, dissipation"""
    parasite: float
    """D·V"""
    tail: float
    shaft: float
    """Torque × Ω. In the flight preset it equals `main_rotor` to rounding; in the thesis preset it is not power."""

    @property
    def main_rotor(self) -> float:
        return self.induced + self.profile + self.parasite

    @property
    def total(self) -> float:
        return self.main_rotor + self.tail


@dataclass(frozen=True)
class HubMoment:
    """Steady moments that the rotor head hands to the shaft [N m]."""

    roll: float
    """Positive towards the retreating side: lift on the advancing side lifts that side."""
    pitch: float
    """Positive nose-up."""

    @property
    def size(self) -> float:
        return math.hypot(self.roll, self.pitch)


@dataclass(frozen=True, eq=False)
class Solution:
    """One trimmed (or honestly untrimmed) rotor."""

    design: Design
    status: Status
    message: str
    caveats: tuple[Caveat, ...]
    controls: Controls
    disk: DiskFields
    power: PowerBudget
    hub_moment: HubMoment
    ct: float
    cp: float
    """Main-rotor power over ρA(ΩR)³, eq. (2.12)."""
    reverse_flow_area: float
    """Part of the disk πR² with U_T < 0 on the blade (0…1)."""
    stalled_area: float
    """Part of the disk πR² beyond the stall angle, reverse flow not counted (0…1)."""
    residual: float
    """Largest trim residual, as a fraction of the weight (moments: of weight × radius)."""
    passes: int
    """Blade-element passes used."""
    elapsed: float
    """[s]"""

    @property
    def converged(self) -> bool:
        return self.status is Status.CONVERGED

    @property
    def ct_over_sigma(self) -> float:
        return self.ct / self.design.rotor.solidity

    @property
    def figure_of_merit(self) -> float | None:
        """Ideal over actual main-rotor power, hover only."""
        if not self.design.hovering or self.cp <= 0.0:
            return None
        return max(self.ct, 0.0) ** 1.5 / np.sqrt(2.0).item() / self.cp

    @property
    def induced_power_factor(self) -> float:
        """κ = C_Pi/(C_T λ0): induced power over that of an even load, momentum theory's C_T λ0."""
        return self.power.induced / (self.ct * self.controls.lambda0 * self.design.power_unit)

    @property
    def lift_to_drag(self) -> float | None:
        """Rotor L/D_e = W V/(P_induced + P_profile), forward flight only."""
        rotor_power = self.power.induced + self.power.profile
        if self.design.hovering or rotor_power <= 0.0:
            return None
        return self.design.condition.weight * self.design.airspeed / rotor_power

    def require(self) -> "Solution":
        """This solution, or RuntimeError with its sentence when it did not converge."""
        if not self.converged:
            raise RuntimeError(self.message)
        return self
