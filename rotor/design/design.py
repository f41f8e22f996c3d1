"""A design: everything that determines a result, as one value without arrays; and the models of the two presets.

Equality, hashing, caching, JSON and undo come from that. `fingerprint` is the same for equal values, so that a results
file can be matched with what it was computed from. A preset is a value of `Models`: `flight`, the best available
models, and `thesis`, those that the document states.
"""

import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Unpack, cast

from rotor.design import quantities
from rotor.design.active_twist import (
    ActiveTwist,
    Harmonic,
    active_twist_record,
    check_root_pitch,
    harmonics_text,
    linear_active_twist,
    root_pitch,
)
from rotor.design.aircraft import (
    Aircraft,
    FlightCondition,
    Fuselage,
    TailRotor,
    changed_condition,
    in_words,
)
from rotor.design.blade import Rotor, airfoils_spec
from rotor.design.gust import Gust
from rotor.design.quantity import check_names
from rotor.design.twist import SumTwist, TwistLaw, ideal_tip_pitch, inline_spec, parse_twist
from rotor.support.user_input import check_suffix, shorten, write_whole


def fingerprint(value: object) -> str:
    """16 hexadecimal digits of SHA-256 over every field of a value made of dataclasses, tuples, lists and numbers."""
    return hashlib.sha256(_text(value).encode()).hexdigest()[:16]


def _text(value: Any) -> str:
    """The value with every field of every dataclass: their own `repr` may be shorter."""
    if is_dataclass(value) and not isinstance(value, type):
        inside = ", ".join(
            f"{field.name}={_text(getattr(value, field.name))}"
            for field in fields(value)
            if field.repr
        )
        return f"{type(value).__qualname__}({inside})"
    if type(value) is tuple:
        items = [_text(item) for item in cast(tuple[Any, ...], value)]
        return f"({items[0]},)" if len(items) == 1 else f"({', '.join(items)})"
    if type(value) is list:
        return f"[{', '.join(_text(item) for item in cast(list[Any], value))}]"
    return repr(value)


FORMAT = "rotor-explorer design"
"""Value of the key `format` in design files."""
VERSION = 2


BEYOND_DOCUMENT = (
    "elastic_twist", "unsteady", "dynamic_stall", "stall_delay", "surface_drag", "swept_tip", "radial_friction",
    "swirl", "download",
)  # fmt: skip
"""Switches of `Models` for effects that the document does not have."""

TRIM_AZIMUTHS, SHOWN_AZIMUTHS = 48, 120
"""Azimuths of a trim without a wake, and the least of the fields on the disk. Our choice: 48, on which dynamic stall is
followed in any case, err less than 40 elements do (`docs/validation/grid.md`, which `make trust` writes)."""


@dataclass(frozen=True)
class Models:
    """The choice of models and the grid, as arguments of `make_design`. A preset is a value of this type."""

    inflow: str
    """Forward-flight inflow model by name, one of `rotor.aero.inflow.INFLOW_MODELS`."""
    hover_inflow: quantities.HoverInflow
    """`annulus`: balance with the real Cl(α); `closed-form`: eq. (3.3)."""
    trim: quantities.FlightTrim | quantities.StandTrim
    """`propulsive`: weight, drag and first-harmonic flapping by collective, cyclic and shaft tilt;
    `thrust`: the resultant of weight and drag by collective, free flapping, no cyclic. Those of a rotor on a test
    stand, which need `FlightCondition.stand`: see `rotor.design.aircraft`."""
    disk_axial_flow: bool
    """Whether the tilted shaft sees µ sin α through the disk (absent from eq. 3.6 as printed)."""
    blade_weight: bool
    """Whether gravity's static moment lowers the coning."""
    tail_rotor_solved: bool
    """True: the tail rotor balances the torque; False: five per cent of the main rotor (thesis §3.2)."""
    tip_loss: bool = True
    """Prandtl's tip factor, eq. (3.16). Off: F_tip = 1. A lifting line still has its blade tips."""
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
    swirl: bool = True
    """Whether the rotor turns the air it works in. Off: the air in the disk moves along the shaft only."""
    swept_tip: bool = True
    """Whether a swept tip sees the Mach number normal to its quarter chord. Off: as if straight."""
    radial_friction: bool = True
    """Whether section drag is along the whole velocity, yawed. Off: along that in the section's plane."""
    download: bool = True
    """Whether the rotor's wake presses on the fuselage. Off: thrust carries the weight alone."""
    surface_drag: bool = True
    """Whether drag is multiplied by the rotor file's factor for the surface of its blades. Off: section data alone."""
    elastic_twist: bool = True
    """Whether the blade twists under its loads. Off: rigid in torsion."""
    bending: bool = False
    """Whether a blade whose stiffness is known bends in flap and lag. Off: it flaps as a rigid blade."""
    unsteady: bool = True
    """Whether attached flow is unsteady, see `rotor.aero.unsteady_section`. Off: steady."""
    stall: bool = True
    """Whether sections stall. Off: as `rotor.airfoil.stall_onset.unstalled` has them; no vortex leaves."""
    dynamic_stall: bool = True
    """Whether sections follow the angle of attack with the lags of separation, and shed vortices where they stall. Off:
    they stall as the steady data say."""
    stall_delay: bool = True
    """Whether rotation delays stall where the chord is a large part of the radius, see `rotor.airfoil.stall_delay`.
    Off: an element stalls as its section does in two dimensions."""
    low_speed: quantities.LowSpeed = "wake"
    """`wake`: the inflow model of forward flight at any speed; `hover`: it passes over to the hover model as the speed
    falls to zero."""
    loss_on: quantities.LossOn = "lift"
    """Where Prandtl's factors act under linear inflow in forward flight. `lift`: F C_l; `inflow`: λ_i/F, as in
    eq. (3.3). In hover they are in the balance of the annulus."""
    document_losses: bool = False
    """Only the losses that the document has: whatever the switches of `BEYOND_DOCUMENT` say."""
    elements: int = 40
    """Blade elements, equally wide (eq. 3.14), unless the inflow is that of a lifting line."""
    azimuths: int | None = None
    """Azimuth stations of trim and fields; with a lifting line of the fields alone. None: a trim on `TRIM_AZIMUTHS`,
    fields on `SHOWN_AZIMUTHS`."""
    panels: int = 24
    """Elements of a blade that is a lifting line, finer towards the tip."""
    line_azimuths: int = 24
    """Azimuth stations on which a lifting line is solved, at least."""

    def has(self, name: str) -> bool:
        """Whether a switch, by name, is on and has an effect with these models."""
        return bool(getattr(self, name)) and not (self.document_losses and name in BEYOND_DOCUMENT)

    def __post_init__(self) -> None:
        for name in ("hover_inflow", "low_speed", "loss_on"):
            quantities.QUANTITIES[name].check_choice(getattr(self, name))
        if not 4 <= self.elements <= 1000:
            raise ValueError(
                f"{self.elements} blade elements are outside 4…1000: 40 is enough for plots and power"
            )
        if self.panels < 4 or self.line_azimuths < 8:
            raise ValueError(
                f"{self.panels} panels at {self.line_azimuths} azimuths are too few: give 4 and 8 or more"
            )
        if self.azimuths is not None and not 8 <= self.azimuths <= 2000:
            raise ValueError(
                f"{self.azimuths} azimuths are outside 8…2000: 120 is enough for plots and power"
            )


@dataclass(frozen=True, repr=False)
class Design:
    """Everything that determines a result: rotor, twist, flight condition and models.

    A design never changes: `design.at(mu=0.3)` is one at another flight condition, `design.with_twist("linear:-8")` one
    with another twist, `make_design(case=design, …)` one with anything else. What it holds is read as
    `design.condition.mass`.
    """

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
    pitch_per_rev: tuple[Harmonic, ...] = ()
    """Root pitch at 2 to 8/rev, beside collective and cyclic, in forward flight: higher-harmonic control."""
    gust: Gust | None = None
    """How the air moves beside the climb; None in still air. Files and the command line have none."""

    def __post_init__(self) -> None:
        check_root_pitch(self.pitch_per_rev)
        object.__setattr__(self, "rotor", self.rotor.at_speed(self.condition.rotor_speed_percent))
        trim, stand = self.models.trim, self.condition.stand
        for row in quantities.AIRFRAME.values():
            row.check(row.of(self))
        if self.condition.climb_speed and not self.models.disk_axial_flow:
            raise ValueError(
                f"rate of climb {self.condition.climb_speed:g} m/s: the document's equations (3.3), (3.6) are those of "
                "level flight; use the preset flight, or leave the rate of climb out"
            )
        if self.gust is not None and not self.models.disk_axial_flow:
            raise ValueError(
                f"{self.gust!r:.80}: the document's equations are those of still air; use preset flight"
            )
        if (trim in quantities.STAND_TRIMS) != (stand is not None):
            raise ValueError(
                f"trim {trim!r} {'needs' if stand is None else 'does not use'} the inputs of a test stand: "
                f"{'give them' if stand is None else 'leave them out'}, or choose another trim"
            )
        if stand is None:
            return
        if not self.models.disk_axial_flow:
            raise ValueError(
                f"trim {trim!r} needs the axial flow of the tilted disk: use the preset flight"
            )
        if trim == "free-rotor" and self.hovering:
            raise ValueError("a free rotor needs wind to turn it: give an advance ratio above 0")
        if trim == "controls" and stand.collective is None:
            raise ValueError(
                "trim 'controls' needs a collective: give one, or use trim 'wind-tunnel', which also takes a thrust"
            )
        if trim == "controls" and stand.flapping != "free":
            raise ValueError(
                "trim 'controls' needs free flapping: set flapping to free, or use trim 'wind-tunnel'"
            )
        if self.hovering and (stand.hub_roll or stand.hub_pitch):
            raise ValueError(
                "in hover the rotor is balanced annulus by annulus, without hub moments: leave them out"
            )
        if stand.flapping == "hub-moments" and self.rotor.flap_frequency_squared <= 1.0 + 1e-9:
            hinged = (
                "rigid blades, which have no cyclic"
                if self.rotor.blade.rigid
                else "blades hinged at the shaft"
            )
            raise ValueError(
                f"hub moments cannot be trimmed on {hinged}, which carry none: give flapping trimmed"
            )
        if self.hovering and (stand.cyclic_1c or stand.cyclic_1s):
            raise ValueError(
                "in hover the rotor is balanced annulus by annulus, without cyclic: leave cyclic out"
            )

    def __repr__(self) -> str:
        condition = self.condition
        speed = "hover" if self.hovering else f"mu={condition.advance_ratio:.4g}"
        inflow = self.models.hover_inflow if self.hovering else self.models.inflow
        load = f"{condition.mass:.0f} kg, {condition.altitude:.0f} m"
        if condition.stand is not None:
            height = f", {condition.altitude:.0f} m" if condition.altitude else ""
            load = f"{self.models.trim}: {condition.stand}{height}"
        load = ", ".join((load, *in_words(self.unusual)))
        carried = (
            "" if self.rotor.blade.carried is None else f"with {self.rotor.blade.carried.name}, "
        )
        return (
            f"Design({self.aircraft.name}, twist {self.jig.spec()}, {carried}{speed}, {load}, "
            f"preset {self.preset}, inflow {inflow})"
        )

    def at(
        self,
        *,
        mu: float | None = None,
        hover: bool = False,
        **flight: Unpack[quantities.Flight[float | None]],
    ) -> "Design":
        """This design at another flight condition; what is left out stays as it is.

        The arguments are those of `make_design`; `mu`, `speed_kt` and `hover` exclude one another.
        Raises TypeError or ValueError with one sentence that names the value and the remedy.
        """
        check_names(Design.at, flight, quantities.SWEPT, _other_change)
        tip_speed = self.rotor.at_speed(100.0).tip_speed
        asked = {"mu": mu, "hover": hover, **flight}
        return with_numbers(
            replace(self, condition=changed_condition(self.condition, tip_speed, asked)), asked
        )

    def with_twist(self, twist: TwistLaw | str) -> "Design":
        """This design with another twist: a law, or a SPEC as `parse_twist` reads it.

        In a SPEC `builtin` is this rotor's own twist, and `ideal` the ideal twist for this weight in hover.
        """
        if isinstance(twist, TwistLaw):
            return replace(self, twist=twist)
        builtin = self.rotor.builtin_twist
        return replace(
            self, twist=parse_twist(twist, builtin=builtin, ideal_tip_pitch=self._ideal_tip_pitch)
        )

    def _ideal_tip_pitch(self) -> float:
        """θ_tip [rad] of the ideal twist for this weight in hover."""
        blade = self.rotor.blade
        slope = float(blade.installed(blade.spans[0].section).table.lift_slope(0.3))
        return ideal_tip_pitch(self.weight_coefficient, self.rotor.solidity, slope)

    def to_dict(self) -> dict[str, Any]:
        """The record of a design file: texts, numbers and lists only. ValueError for a gust, which files have not."""
        if self.gust is not None:
            raise ValueError(
                f"design files have no {self.gust!r:.80}: write replace(design, gust=None)"
            )
        carried = self.rotor.blade.carried
        changed = self.bare.rotor.at_speed(100.0) != self.aircraft.rotor_for(self.preset)
        airfoils = airfoils_spec(self.rotor) if changed else None
        switches = [field.name for field in fields(Models) if field.default is True]
        preset, stand = preset_models(self.preset), self.condition.stand
        return {
            "format": FORMAT,
            "version": VERSION,
            "rotor": self.aircraft.record(),
            "preset": self.preset,
            "twist": inline_spec(self.twist),
            **{
                row.key: row.of(self)
                for row in quantities.NUMBERS.values()
                if row.written or row.of(self) != row.usual(self)
            },
            "inflow": self.models.inflow,
            **{
                name: getattr(self.models, name)
                for name in ("hover_inflow", "low_speed", "loss_on", *switches, *quantities.OPTIONS)
                if name in switches or getattr(self.models, name) != getattr(preset, name)
            },
            **{
                name: asked
                for name, asked in grid_arguments(self.models, preset).items()
                if asked is not None
            },
            **({"airfoils": airfoils} if airfoils else {}),
            **self._per_rev_record(),
            **({} if stand is None else {"trim": self.models.trim, "stand": stand.record()}),
            **({} if carried is None else {"actuator": asdict(carried)}),
        }

    def _per_rev_record(self) -> dict[str, Any]:
        """Pitch that follows the azimuth; a twist linear from the root cut-out as on the command line."""
        active, record = self.active_twist, dict[str, Any]()
        if self.linear_active_twist:
            record["twist_per_rev"] = harmonics_text(self.linear_active_twist)
        elif active is not None:
            record["active_twist"] = active_twist_record(active)
        return record | (
            {"pitch_per_rev": harmonics_text(self.pitch_per_rev)} if self.pitch_per_rev else {}
        )

    def save(self, path: str | Path) -> None:
        """Write a design file, JSON, which `load_design` reads; ValueError for the suffix of another format."""
        check_suffix(path, ".json")
        write_whole(path, json.dumps(self.to_dict(), indent=2) + "\n")

    @property
    def jig(self) -> TwistLaw:
        """The built-in twist law, without the twist that an actuator on the blades adds."""
        law, carried = self.twist, self.rotor.blade.carried
        return (
            law.base if isinstance(law, SumTwist) and carried and law.name == carried.name else law
        )

    @property
    def bare(self) -> "Design":
        """This design without an actuator on its blades: its mass, stiffness and twist."""
        if (carried := self.rotor.blade.carried) is None:
            return self
        usual = self.aircraft.rotor_for(self.preset).blade
        own = ("mass", "flap_static_moment", "flap_inertia", "structure", "carried")
        blade = replace(self.rotor.blade, **{name: getattr(usual, name) for name in own})
        condition = replace(
            self.condition, mass=round(self.condition.mass - carried.aircraft_kg, 9)
        )
        return replace(
            self, twist=self.jig, condition=condition, rotor=replace(self.rotor, blade=blade)
        )

    @property
    def numbers(self) -> dict[str, float]:
        """The numbers of `rotor.design.quantities.NUMBERS` by name, each in the unit of its name."""
        return {name: row.of(self) for name, row in quantities.NUMBERS.items()}

    @property
    def unusual(self) -> dict[str, float]:
        """The entries of `numbers` that differ from ordinary level flight of the aircraft as built."""
        return {
            name: row.of(self)
            for name, row in quantities.UNUSUAL.items()
            if row.of(self) != row.usual(self)
        }

    @property
    def linear_active_twist(self) -> tuple[Harmonic, ...]:
        """Harmonics of the active twist if it is linear from the root cut-out to the tip; empty otherwise."""
        active, root = self.active_twist, self.rotor.blade.root_cutout
        return (
            active.harmonics
            if active and active == linear_active_twist(active.harmonics, root)
            else ()
        )

    @property
    def active_waves(self) -> tuple[Harmonic, ...]:
        """Harmonics of the active twist; empty for a design without it."""
        return () if self.active_twist is None else self.active_twist.harmonics

    @property
    def pitch_waves(self) -> tuple[ActiveTwist, ...]:
        """Harmonics of prescribed pitch, active twist and n/rev root pitch; empty in hover."""
        if self.hovering:
            return ()
        pitch = (root_pitch(self.pitch_per_rev),) if self.pitch_per_rev else ()
        return pitch if self.active_twist is None else (self.active_twist, *pitch)

    @property
    def airspeed(self) -> float:
        """V = µΩR, horizontal [m/s]."""
        return self.condition.advance_ratio * self.rotor.tip_speed

    @property
    def flight_speed(self) -> float:
        """Airspeed along the flight path [m/s]."""
        return math.hypot(self.airspeed, self.vertical_speed)

    @property
    def vertical_speed(self) -> float:
        """V_c, up through the air [m/s]: the rate of climb less the uniform gust. Rotor, wake, airframe and power read
        it here; what blades meet on top of it is in `rotor.aero.air`."""
        return self.condition.climb_speed - (0.0 if self.gust is None else self.gust.uniform)

    @property
    def vertical_ratio(self) -> float:
        """Climb ratio µ_c = V_c/(ΩR) [-]."""
        return self.vertical_speed / self.rotor.tip_speed

    def in_disk_axes(self, tilt: float) -> tuple[float, float]:
        """Velocity of flight along and through a disk tilted by α [rad]: µ cos α − µ_c sin α, µ sin α + µ_c cos α."""
        mu, climb, cos, sin = (
            self.condition.advance_ratio,
            self.vertical_ratio,
            math.cos(tilt),
            math.sin(tilt),
        )
        return mu * cos - climb * sin, mu * sin + climb * cos

    @property
    def drag(self) -> float:
        """Drag of the airframe [N] against the flight path, eq. (3.19); 0 where the models leave it out, and on a test
        stand."""
        if not self.models.fuselage or self.condition.stand is not None:
            return 0.0
        return self.fuselage.drag(self.condition.density, self.flight_speed)

    @property
    def drag_parts(self) -> tuple[float, float]:
        """Coefficients of drag over ρA(ΩR)², aft and down.

        In a climbing turn less what n W pulls back along the path beyond the weight: (n − 1) W sin γ.
        """
        speed, here = self.flight_speed, self.condition
        if speed == 0.0 or here.stand is not None:
            return 0.0, 0.0
        drag = (
            self.drag - (here.load - here.weight) * self.vertical_speed / speed
        ) / self.thrust_unit
        return drag * (self.airspeed / speed), drag * (self.vertical_speed / speed)

    @property
    def elastic(self) -> bool:
        """Whether the blade twists under its loads: the effect is on and the structure of the blade is known."""
        return self.models.has("elastic_twist") and self.rotor.blade.structure is not None

    @property
    def flaps(self) -> bool:
        """Whether the blades flap: the effect is on and the hub is not rigid."""
        return self.models.flapping and not self.rotor.blade.rigid

    @property
    def hovering(self) -> bool:
        """Whether the advance ratio is zero."""
        return self.condition.advance_ratio == 0.0

    @property
    def weight_coefficient(self) -> float:
        """C_W = n W/(ρ A (ΩR)²); on a test stand the thrust coefficient given, or where the collective is given what
        blade element theory expects of an untwisted blade."""
        stand = self.condition.stand
        if stand is None:
            return self.condition.load / self.thrust_unit
        if stand.ct_over_sigma is not None:
            return stand.ct_over_sigma * self.rotor.solidity
        if stand.collective is not None:
            return self._estimated_thrust(stand.collective)
        return (stand.thrust or 0.0) / self.thrust_unit

    def _estimated_thrust(self, collective: float) -> float:
        """C_T = ½σa(|θ|(1 + 3/2 µ²)/3 − λ/2) with a = 5.9 and λ = √(C_T/2) or C_T/2µ, never below 0.02 σ."""
        sigma, mu = self.rotor.solidity, self.condition.advance_ratio
        ct = 0.0
        for _ in range(20):
            inflow = ct / (2.0 * math.hypot(mu, math.sqrt(ct / 2.0))) if ct > 0.0 else 0.0
            free = 0.5 * 5.9 * sigma * (abs(collective) * (1.0 + 1.5 * mu**2) / 3.0 - 0.5 * inflow)
            ct = 0.5 * (ct + max(free, 0.02 * sigma))
        return ct

    @property
    def reynolds_per_metre(self) -> float:
        """ΩR over the kinematic viscosity [1/m]: Reynolds number of a chord of 1 m at the tip in hover."""
        return self.rotor.tip_speed * self.condition.density / self.condition.viscosity

    @property
    def tip_mach(self) -> float:
        """ΩR over the speed of sound [-]."""
        stand = self.condition.stand
        if stand is not None and stand.tip_mach is not None:
            return stand.tip_mach
        return self.rotor.tip_speed / self.condition.sound_speed

    @cached_property
    def thrust_unit(self) -> float:
        """ρ A (ΩR)² [N], eq. (2.11)."""
        return self.condition.density * self.rotor.disk_area * self.rotor.tip_speed**2

    @property
    def thrust_per_metre(self) -> float:
        """Load on one blade [N/m] for a value of 1 of a coefficient per r/R, such as `dct`."""
        return self.thrust_unit / (self.rotor.blades * self.rotor.radius)

    @cached_property
    def power_unit(self) -> float:
        """ρ A (ΩR)³ [W], eq. (2.12)."""
        return self.thrust_unit * self.rotor.tip_speed


def with_numbers(design: Design, asked: Mapping[str, Any]) -> Design:
    """The design with the numbers asked for outside its flight condition, by name; None leaves one as it is.

    Raises TypeError or ValueError with one sentence for a value that is no number or lies outside.
    """
    for name, row in quantities.AIRFRAME.items():
        if asked.get(name) is not None:
            if design.condition.stand is not None and row.in_flight:
                raise ValueError(
                    f"{name} {asked[name]} has no effect on a test stand: leave it out, or trim a flight"
                )
            design = row.put(design, row.read(asked[name]))
    return design


FLIGHT_MODELS = Models(
    inflow="lifting-line",
    hover_inflow="annulus",
    trim="propulsive",
    disk_axial_flow=True,
    blade_weight=True,
    tail_rotor_solved=True,
    low_speed="hover",
)
THESIS_MODELS = Models(
    inflow="pitt-peters-15pi/23",
    hover_inflow="closed-form",
    trim="thrust",
    disk_axial_flow=False,
    blade_weight=False,
    tail_rotor_solved=False,
    loss_on="inflow",
    document_losses=True,
    azimuths=120,
)


def _other_change(name: str) -> str:
    """The code that changes a quantity which `at` does not take; empty for what is none."""
    if name == "twist":
        return "design.with_twist(…)"
    return (
        f"rotor.make_design(case=design, {name}=…)"
        if name in quantities.ARGUMENTS and name != "case"
        else ""
    )


def with_models(design: Design, **changes: Any) -> Design:
    """The design with some of its models changed."""
    return replace(design, models=replace(design.models, **changes))


def with_grid(models: Models, elements: int | None = None, azimuths: int | None = None) -> Models:
    """The models on so many blade elements and azimuths, whatever the inflow model; None leaves the present number."""
    asked = {
        "elements": elements,
        "panels": elements,
        "azimuths": azimuths,
        "line_azimuths": azimuths,
    }
    return replace(models, **{name: value for name, value in asked.items() if value is not None})


def grid_arguments(models: Models, plain: Models) -> dict[str, int | None]:
    """The arguments of `with_grid` that make these models of a preset's; None for its own numbers."""
    asked_for = dict[str, int | None]()
    for asked, line in (("elements", "panels"), ("azimuths", "line_azimuths")):
        values = {
            getattr(models, name)
            for name in (asked, line)
            if getattr(models, name) != getattr(plain, name)
        }
        asked_for[asked] = min(values - {None}, default=None)
    return asked_for


def preset_models(preset: str) -> Models:
    """The models that a preset names; ValueError for a preset that does not exist."""
    check_preset(preset)
    return THESIS_MODELS if preset == "thesis" else FLIGHT_MODELS


def check_preset(preset: str) -> None:
    """Raise ValueError for a preset that does not exist."""
    if preset not in quantities.PRESETS:
        raise ValueError(f"preset {preset!r} is not known: use {' or '.join(quantities.PRESETS)}")


def require_design(design: Design) -> Design:
    """The design; TypeError with one sentence for anything else, which a notebook may pass."""
    if not isinstance(design, Design):  # pyright: ignore[reportUnnecessaryIsInstance]
        what = shorten(repr(design), 80)
        raise TypeError(
            f"design is {what}: give what rotor.make_design or rotor.load_design returns"
        )
    return design
