"""What a solve returns: status and sentence, trim, fields over the disk, power by parts."""

import json
import math
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any, cast

import numpy as np

from rotor.aero.switches import switched_off
from rotor.aero.trim_state import TrimState
from rotor.arrays import Array
from rotor.design.active_twist import active_twist_record
from rotor.design.design import Design
from rotor.plots import plot_disk


class Status(Enum):
    """How a solve ended."""

    CONVERGED = "converged"
    NOT_CONVERGED = "not-converged"


@dataclass(frozen=True)
class Caveat:
    """A limit of validity that a solution exceeds."""

    name: str
    """Short and stable, for scripts, for example low-speed-inflow."""
    sentence: str
    """The sentence for the user."""


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
    """Stall angle less angle of attack [rad]: negative when stalled, π/2 in reverse flow."""
    dct: Array
    """dC_T/dr of the whole rotor as if smeared."""
    dcq: Array
    """dC_Q/dr over r: in-plane force opposing rotation, of the whole rotor as if smeared; dC_P/dr = r·dcq."""


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
    """Steady moments of the hub on the shaft [N m]."""

    roll: float
    """Positive towards the retreating side, as from lift on the advancing side."""
    pitch: float
    """Positive nose-up."""

    @property
    def size(self) -> float:
        return math.hypot(self.roll, self.pitch)


@dataclass(frozen=True, eq=False, repr=False)
class Solution:
    """A trimmed rotor, or the last iterate of one that did not trim."""

    design: Design
    status: Status
    message: str
    caveats: tuple[Caveat, ...]
    controls: TrimState
    disk: DiskFields
    last_power: PowerBudget
    """Power by parts of the last iterate, converged or not; `power` is the same for a converged solution only."""
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

    def __repr__(self) -> str:
        state = f"{self.status.value}: {self.message}"
        if self.caveats:
            state += f" Caveats: {', '.join(caveat.name for caveat in self.caveats)}."
        power = "power: none, the rotor is not in trim"
        if self.converged:
            parts = ("induced", "profile", "parasite", "tail")
            kilowatts = ", ".join(f"{part} {getattr(self.power, part) / 1e3:.1f}" for part in parts)
            power = f"power {self.power.total / 1e3:.1f} kW: {kilowatts}"
        return f"{self.design}\n{state}\n{power}"

    @property
    def converged(self) -> bool:
        return self.status is Status.CONVERGED

    @property
    def power(self) -> PowerBudget:
        """Power by parts. Raises RuntimeError when the solution did not converge: it has no power then."""
        if not self.converged:
            raise RuntimeError(
                f"This solution has no power because it did not converge. {self.message} "
                "The power of the last iterate is in last_power."
            )
        return self.last_power

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
        """κ = C_Pi/(C_T λ0): induced power over that of uniform loading by momentum theory."""
        return self.last_power.induced / (self.ct * self.controls.lambda0 * self.design.power_unit)

    @property
    def lift_to_drag(self) -> float | None:
        """Rotor L/D_e = W V/(P_induced + P_profile), forward flight only."""
        rotor_power = self.last_power.induced + self.last_power.profile
        if self.design.hovering or rotor_power <= 0.0:
            return None
        return self.design.condition.weight * self.design.airspeed / rotor_power

    def require(self) -> "Solution":
        """This solution, or RuntimeError with its sentence when it did not converge."""
        if not self.converged:
            raise RuntimeError(self.message)
        return self

    def to_dict(self) -> dict[str, Any]:
        """The record that `rotor solve --json` prints: numbers and texts only, null for what did not converge."""
        design, controls, power = self.design, self.controls, self.last_power
        values: dict[str, Any] = {
            "power_w": {
                "total": power.total,
                "main_rotor": power.main_rotor,
                "induced": power.induced,
                "profile": power.profile,
                "parasite": power.parasite,
                "tail": power.tail,
            },
            "ct": self.ct,
            "cp": self.cp,
            "ct_over_sigma": self.ct_over_sigma,
            "collective_deg": math.degrees(controls.collective),
            "cyclic_1c_deg": math.degrees(controls.cyclic_1c),
            "cyclic_1s_deg": math.degrees(controls.cyclic_1s),
            "coning_deg": math.degrees(controls.coning),
            "flap_1c_deg": math.degrees(controls.flap_1c),
            "flap_1s_deg": math.degrees(controls.flap_1s),
            "shaft_tilt_deg": math.degrees(controls.shaft_tilt),
            "lambda0": controls.lambda0,
            "reverse_flow_area_percent": 100.0 * self.reverse_flow_area,
            "stalled_area_percent": 100.0 * self.stalled_area,
        }
        return {
            "status": self.status.value,
            "message": self.message,
            "caveats": [caveat.sentence for caveat in self.caveats],
            "mu": design.condition.advance_ratio,
            "speed_m_s": design.airspeed,
            "preset": design.preset,
            "inflow": design.models.inflow if not design.hovering else design.models.hover_inflow,
            "twist": design.twist.spec(),
            **({} if design.active_twist is None else {"active_twist": active_twist_record(design.active_twist)}),
            **self._switches(),
            **(values if self.converged else _emptied(values)),
            "elapsed_ms": 1e3 * self.elapsed,
        }

    def _switches(self) -> dict[str, Any]:
        """What is switched off, and the hub moment, which is then not zero; nothing for the full model."""
        off = switched_off(self.design.models)
        if not off:
            return {}
        moment = self.hub_moment if self.converged else None
        return {
            "switched_off": [switch.flag for switch in off],
            "hub_moment_n_m": {"roll": moment and moment.roll, "pitch": moment and moment.pitch},
        }

    def save(self, path: str | Path) -> None:
        """Write the design and, under `solution`, its results as JSON; `load_design` reads the design back."""
        record = {**self.design.to_dict(), "solution": self.to_dict()}
        Path(path).write_text(json.dumps(record, indent=2, allow_nan=False) + "\n", encoding="utf-8")

    def plot(self, field: str = "alpha", ax: Any = None) -> Any:
        """Draw a field of `disk` over the disk seen from above, nose up; returns the matplotlib axes.

        Raises ValueError for a field that does not exist, RuntimeError when the solution did not converge, and
        ImportError with the remedy where matplotlib is missing.
        """
        if field not in DISK_LABELS:
            raise ValueError(f"field {field!r} is not known: use one of {', '.join(DISK_LABELS)}")
        disk = self.require().disk
        label, scale = DISK_LABELS[field]
        return plot_disk(disk.r, disk.psi, scale * getattr(disk, field), label, ax)


def _emptied(values: dict[str, Any]) -> dict[str, Any]:
    """The same keys without values."""
    return {
        key: _emptied(cast(dict[str, Any], value)) if isinstance(value, dict) else None for key, value in values.items()
    }


_DEGREES = math.degrees(1.0)
DISK_LABELS: dict[str, tuple[str, float]] = {
    "alpha": ("Angle of attack [°]", _DEGREES),
    "theta": ("Pitch [°]", _DEGREES),
    "stall_margin": ("Stall margin [°]", _DEGREES),
    "induced": ("Induced inflow λi", 1.0),
    "inflow": ("Total inflow λ", 1.0),
    "u_t": ("Tangential velocity U_T/ΩR", 1.0),
    "u_p": ("Perpendicular velocity U_P/ΩR", 1.0),
    "mach": ("Mach number", 1.0),
    "cl": ("Lift coefficient", 1.0),
    "cd": ("Drag coefficient", 1.0),
    "dct": ("Thrust loading dC_T/dr", 1.0),
    "dcq": ("In-plane loading dC_H/dr", 1.0),
}
"""Fields that `Solution.plot` draws: label, and factor from SI to the unit of the label."""
