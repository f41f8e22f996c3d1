"""A design: everything that determines a result, as one value without arrays; and the models of the two presets.

Equality, hashing, caching, JSON and undo come from that. `fingerprint` is the same for equal values, so that a results
file can be matched with what it was computed from. A preset is a value of `Models`: `flight`, the best available
models, and `thesis`, those that the document states.
"""

import hashlib
import json
from dataclasses import dataclass, fields, is_dataclass, replace
from pathlib import Path
from typing import Any, Literal, cast

from rotor.design.active_twist import ActiveTwist, active_twist_record
from rotor.design.aircraft import Aircraft, FlightCondition, Fuselage, TailRotor, advance_ratio, number
from rotor.design.blade import Rotor, airfoils_spec
from rotor.design.twist import TwistLaw, ideal_tip_pitch, inline_spec, parse_twist


def fingerprint(value: object) -> str:
    """16 hexadecimal digits of SHA-256 over every field of a value made of dataclasses, tuples, lists and numbers."""
    return hashlib.sha256(_text(value).encode()).hexdigest()[:16]


def _text(value: Any) -> str:
    """The value with every field of every dataclass: their own `repr` may be shorter."""
    if is_dataclass(value) and not isinstance(value, type):
        inside = ", ".join(f"{field.name}={_text(getattr(value, field.name))}" for field in fields(value) if field.repr)
        return f"{type(value).__qualname__}({inside})"
    if type(value) is tuple:
        items = [_text(item) for item in cast(tuple[Any, ...], value)]
        return f"({items[0]},)" if len(items) == 1 else f"({', '.join(items)})"
    if type(value) is list:
        return f"[{', '.join(_text(item) for item in cast(list[Any], value))}]"
    return repr(value)


HoverInflow = Literal["annulus", "closed-form"]
Trim = Literal["propulsive", "thrust"]

FORMAT = "rotor-explorer design"
"""Of design files."""
VERSION = 2


@dataclass(frozen=True)
class Models:
    """The models of a computation. A preset is a value of this type."""

    inflow: str
    """Forward-flight inflow model by name, one of `rotor.aero.inflow.INFLOW_MODELS`."""
    hover_inflow: HoverInflow
    """`annulus`: balance with the real Cl(α); `closed-form`: eq. (3.3)."""
    trim: Trim
    """`propulsive`: weight, drag and first-harmonic flapping by collective, cyclic and shaft tilt;
    `thrust`: the resultant of weight and drag by collective, free flapping, no cyclic."""
    disk_axial_flow: bool
    """Whether the tilted shaft sees µ sin α through the disk (absent from eq. 3.6 as printed)."""
    blade_weight: bool
    """Whether gravity's static moment lowers the coning."""
    tail_rotor_solved: bool
    """True: the tail rotor balances the torque; False: five per cent of the main rotor (thesis §3.2)."""
    tip_loss: bool = True
    """Prandtl's tip factor, eq. (3.16). Off: F_tip = 1; a dynamic wake is then that of infinitely many blades."""
    hub_loss: bool = True
    """Root factor, eq. (3.17), where the inflow does not depend on the load. Off: F_hub = 1."""
    reverse_flow: bool = True
    """Whether blade elements in reverse flow carry load. Off: none inside the circle r < −µ sin ψ."""
    flapping: bool = True
    """Whether the blades flap. Off: rigid blades, β = 0, without cyclic; the hub carries the moments."""
    compressibility: bool = True
    """Whether section data depend on the Mach number. Off: data at Mach 0.3 everywhere."""
    fuselage: bool = True
    """Whether the airframe has drag, eq. (3.19). Off: drag area 0."""
    elements: int = 40
    """Blade elements, equally wide (eq. 3.14)."""
    azimuths: int = 120
    """Azimuth stations."""

    def __post_init__(self) -> None:
        if not 4 <= self.elements <= 1000:
            raise ValueError(f"{self.elements} blade elements are outside 4…1000: 40 is enough for plots and power")
        if not 8 <= self.azimuths <= 2000:
            raise ValueError(f"{self.azimuths} azimuths are outside 8…2000: 120 is enough for plots and power")


@dataclass(frozen=True, repr=False)
class Design:
    """A rotor, its twist, the flight condition and the models."""

    preset: str
    aircraft: Aircraft
    """The aircraft the design is based on: its name, hub and baseline twist."""
    rotor: Rotor
    twist: TwistLaw
    condition: FlightCondition
    fuselage: Fuselage
    tail_rotor: TailRotor | None
    models: Models
    active_twist: ActiveTwist | None = None
    """Twist as a function of azimuth, added to the twist law in forward flight."""

    def __repr__(self) -> str:
        condition = self.condition
        speed = "hover" if self.hovering else f"mu={condition.advance_ratio:.4g}"
        inflow = self.models.hover_inflow if self.hovering else self.models.inflow
        return (
            f"Design({self.aircraft.name}, twist {self.twist.spec()}, {speed}, {condition.mass:.0f} kg, "
            f"{condition.altitude:.0f} m, preset {self.preset}, inflow {inflow})"
        )

    def at(
        self,
        *,
        mu: float | None = None,
        speed_kt: float | None = None,
        hover: bool = False,
        mass_kg: float | None = None,
        altitude_m: float | None = None,
    ) -> "Design":
        """The same design at another flight condition; what is left out stays as it is.

        `mu` (advance ratio), `speed_kt` (airspeed in knots) and `hover` exclude one another.
        Raises TypeError or ValueError with one sentence that names the value and the remedy.
        """
        old = self.condition
        mu = advance_ratio(self.rotor.tip_speed, mu, speed_kt, hover)
        condition = replace(
            old,
            advance_ratio=old.advance_ratio if mu is None else mu,
            mass=old.mass if mass_kg is None else number("mass_kg", mass_kg, "8000"),
            altitude=old.altitude if altitude_m is None else number("altitude_m", altitude_m, "1500"),
        )
        return replace(self, condition=condition)

    def with_twist(self, twist: TwistLaw | str) -> "Design":
        """The same design with another twist: a law, or a SPEC as `parse_twist` reads it.

        In a SPEC `builtin` is this rotor's own twist, and `ideal` the ideal twist for this weight in hover.
        """
        if isinstance(twist, TwistLaw):
            return replace(self, twist=twist)
        rotor = self.rotor
        slope = float(rotor.blade.installed(rotor.blade.spans[0].section).table.lift_slope(0.3))
        tip_pitch = ideal_tip_pitch(self.weight_coefficient, rotor.solidity, slope)
        return replace(self, twist=parse_twist(twist, builtin=rotor.builtin_twist, ideal_tip_pitch=tip_pitch))

    def to_dict(self) -> dict[str, Any]:
        """The record of a design file: texts, numbers and lists only."""
        changed = self.rotor != self.aircraft.rotor_for(self.preset)
        airfoils = airfoils_spec(self.rotor) if changed else None
        switches = [field.name for field in fields(Models) if field.default is True]
        return {
            "format": FORMAT,
            "version": VERSION,
            "rotor": self.aircraft.record(),
            "preset": self.preset,
            "twist": inline_spec(self.twist),
            "advance_ratio": self.condition.advance_ratio,
            "mass_kg": self.condition.mass,
            "altitude_m": self.condition.altitude,
            "inflow": self.models.inflow,
            **{name: getattr(self.models, name) for name in switches},
            **({"airfoils": airfoils} if airfoils else {}),
            **({"active_twist": active_twist_record(self.active_twist)} if self.active_twist else {}),
        }

    def save(self, path: str | Path) -> None:
        """Write a design file, which `load_design` reads."""
        Path(path).write_text(json.dumps(self.to_dict(), indent=2) + "\n", encoding="utf-8")

    @property
    def airspeed(self) -> float:
        """V = µΩR [m/s]"""
        return self.condition.advance_ratio * self.rotor.tip_speed

    @property
    def drag(self) -> float:
        """Drag of the airframe [N], eq. (3.19); 0 where the models leave it out."""
        if not self.models.fuselage:
            return 0.0
        return self.fuselage.drag(self.condition.density, self.airspeed)

    @property
    def hovering(self) -> bool:
        return self.condition.advance_ratio == 0.0

    @property
    def weight_coefficient(self) -> float:
        """C_W = W/(ρ A (ΩR)²)"""
        return self.condition.weight / self.thrust_unit

    @property
    def thrust_unit(self) -> float:
        """ρ A (ΩR)² [N], eq. (2.11)."""
        return self.condition.density * self.rotor.disk_area * self.rotor.tip_speed**2

    @property
    def power_unit(self) -> float:
        """ρ A (ΩR)³ [W], eq. (2.12)."""
        return self.thrust_unit * self.rotor.tip_speed


PRESETS = ("flight", "thesis")

FLIGHT_MODELS = Models(
    inflow="dynamic-wake",
    hover_inflow="annulus",
    trim="propulsive",
    disk_axial_flow=True,
    blade_weight=True,
    tail_rotor_solved=True,
)
THESIS_MODELS = Models(
    inflow="pitt-peters-15pi/23",
    hover_inflow="closed-form",
    trim="thrust",
    disk_axial_flow=False,
    blade_weight=False,
    tail_rotor_solved=False,
)


def check_preset(preset: str) -> None:
    """Raise ValueError for a preset that does not exist."""
    if preset not in PRESETS:
        raise ValueError(f"preset {preset!r} is not known: use {' or '.join(PRESETS)}")


def require_design(design: Design) -> Design:
    """The design; TypeError with one sentence for anything else, which a notebook may pass."""
    if not isinstance(design, Design):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(f"design is {design!r:.80}: give what rotor.make_design or rotor.load_design returns")
    return design
