"""The tables of a rotor file: their keys as docs/rotor_file.md has them, with bounds, and what is made of each.

What depends on several tables is in `rotor.files.rotor_file`.
"""

import math
import re
from itertools import pairwise
from typing import Annotated, Any, Literal, cast

from msgspec import Meta, defstruct, field
from msgspec.structs import fields

from rotor.design.aircraft import SEA_LEVEL_DENSITY, ControlRange, Hub, TailRotor
from rotor.design.twist import LinearTwist, TableTwist, TwistLaw
from rotor.design.uncertain import UNCERTAIN
from rotor.files.declared import FileTable, Refusal, Share, Text, check_bounds, one_of

BAILEY_POLAR = (0.0087, -0.0216, 0.4)
"""c_d = δ0 + δ1 α + δ2 α² of Bailey, NACA Report 716 (1941): used for tail rotors without a polar."""
LIFT_SLOPE = 5.73
"""[1/rad], used for tail rotors without a lift slope."""
LOCK_NUMBER = 8.0
"""γ = ρ a c R⁴/I at sea level of blades whose mass and inertia are not given. Those of the
included helicopters are 4.8 to 9.8; power in hover does not depend on it."""

_Angle = Annotated[float, Meta(ge=-60.0, le=60.0)]
_Chord = Annotated[float, Meta(ge=0.005, le=3.0)]
_Stiffness = Annotated[float, Meta(ge=1e-3, le=1e10)]
_Coefficient = Annotated[float, Meta(ge=-10.0, le=10.0)]
_Area = Annotated[float, Meta(ge=0.0, le=50.0)]
_AngularSpeed = Annotated[float, Meta(ge=1.0, le=1000.0)]
_Rpm = Annotated[float, Meta(ge=10.0, le=10_000.0)]
_TipSpeed = Annotated[float, Meta(ge=20.0, le=340.0)]
_SPEEDS = ("speed_rpm", "tip_speed_m_s", "angular_speed_rad_s")


def _check_stations(
    place: str, stations: tuple[float, ...], key: str, values: tuple[float, ...]
) -> None:
    if len(stations) != len(values) or len(stations) < 2:
        raise Refusal(
            f"{place} has {len(stations)} and {key} {len(values)} values: give one value per station, at least two",
            key,
        )
    for low, high in pairwise(stations):
        if low == high:
            step = sorted((low, low + (0.001 if low < 0.5 else -0.001)))
            raise Refusal(
                f"{place} has {low:g} twice: for a step write {step[0]:g} and {step[1]:g}", place
            )
        if low > high:
            raise Refusal(
                f"{place} goes from {low:g} to {high:g}: write the stations in ascending order",
                place,
            )


class SpanTable(FileTable, frozen=True, kw_only=True):
    start_r: Share
    end_r: Share
    section: Text


class StructureTable(FileTable, frozen=True, kw_only=True):
    """The fields are those of `BladeStructure`."""

    stations: tuple[Annotated[float, Meta(ge=0.0, le=30.0)], ...] = field(name="r_m")
    torsional_stiffness: tuple[Annotated[float, Meta(ge=1e-3, le=1e9)], ...] = field(name="gj_nm2")
    mass_per_length: tuple[Annotated[float, Meta(ge=1e-3, le=1e4)], ...] = field(name="mass_kg_m")
    torsional_inertia: tuple[Annotated[float, Meta(ge=1e-9, le=1e3)], ...] = field(
        name="torsional_inertia_kg_m"
    )
    flap_stiffness: tuple[_Stiffness, ...] = field(name="flap_stiffness_nm2", default=())
    lag_stiffness: tuple[_Stiffness, ...] = field(name="lag_stiffness_nm2", default=())
    tension_gyration: Share = field(name="tension_gyration_m2", default=0.0)
    clamp: Annotated[float, Meta(ge=0.0, le=15.0)] | None = field(name="clamp_m", default=None)
    control_stiffness: Annotated[float, Meta(ge=1e-3, le=1e12)] = field(
        name="control_stiffness_nm_rad"
    )
    pitch_horn: Annotated[float, Meta(ge=1e-3, le=2.0)] = field(name="pitch_horn_m")
    lag_damper: Annotated[float, Meta(ge=0.0, le=1e6)] = field(
        name="lag_damper_nm_s_rad", default=0.0
    )
    lag_spring: Annotated[float, Meta(ge=0.0, le=1e8)] | None = field(
        name="lag_spring_nm_rad", default=None
    )

    def __post_init__(self) -> None:
        for column in fields(self):
            values: Any = getattr(self, column.name)
            if (
                isinstance(values, tuple)
                and column.name != "stations"
                and (column.required or values)
            ):
                _check_stations(
                    "r_m", self.stations, column.encode_name, cast("tuple[float, ...]", values)
                )
        bending = {
            "flap_stiffness_nm2": self.flap_stiffness,
            "lag_stiffness_nm2": self.lag_stiffness,
        }
        given = [key for key, values in bending.items() if values]
        if len(given) == 1:
            raise Refusal(
                f"{given[0]} is given alone: give {' and '.join(bending)}, or neither", given[0]
            )


class BladeTable(FileTable, frozen=True, kw_only=True):
    chord_m: _Chord | tuple[_Chord, ...]
    chord_r: tuple[Share, ...] | None = None
    section: Text | None = None
    spans: Annotated[tuple[SpanTable, ...], Meta(min_length=1)] | None = None
    linear_twist_deg: _Angle | None = None
    twist_r: tuple[Share, ...] | None = None
    twist_deg: tuple[_Angle, ...] | None = None
    flap_hinge_m: Annotated[float, Meta(ge=0.0, le=9.0)] = 0.0
    flap_spring_nm_rad: Annotated[float, Meta(ge=0.0, le=1e8)] | None = None
    blade_mass_kg: Annotated[float, Meta(ge=1e-4, le=2000.0)] | None = None
    mass_per_length_kg_m: Annotated[float, Meta(ge=1e-4, le=200.0)] | None = None
    flap_inertia_kg_m2: Annotated[float, Meta(ge=1e-8, le=1e6)] | None = None
    flap_static_moment_kg_m: Annotated[float, Meta(ge=1e-6, le=1e5)] | None = None
    tip_sweep_deg: _Angle = 0.0
    tip_sweep_start_r: Annotated[float, Meta(ge=0.3, le=1.0)] | None = None
    surface_drag: Annotated[float, Meta(ge=0.5, le=3.0)] = 1.0
    structure: Literal["uh60a"] | StructureTable | None = None

    def __post_init__(self) -> None:
        for keys in (
            ("section", "spans"),
            ("linear_twist_deg", "twist_r"),
            ("linear_twist_deg", "twist_deg"),
            *([("blade_mass_kg", "mass_per_length_kg_m")] if self.weighed else []),
            *([("tip_sweep_start_r",)] if self.tip_sweep_deg else []),
        ):
            one_of(self, *keys)
        if self.linear_twist_deg is None:
            _check_stations("twist_r", self.twist_r or (), "twist_deg", self.twist_deg or ())
        if self.chord_r is not None or len(self.chords) != 1:
            stations = self.chord_r or ()
            _check_stations("chord_r", stations, "chord_m", self.chords_at(stations))
        before = 0.0
        for k, span in enumerate(self.spans or ()):
            if not before <= span.start_r < span.end_r:
                raise Refusal(
                    f"span of {span.section} runs {span.start_r:g}…{span.end_r:g}: write the spans in ascending order, "
                    "not overlapping",
                    *("spans", k, "start_r"),
                )
            before = span.end_r

    @property
    def chords(self) -> tuple[float, ...]:
        return self.chord_m if isinstance(self.chord_m, tuple) else (self.chord_m,)

    def chords_at(self, stations: tuple[float, ...]) -> tuple[float, ...]:
        """The chord at every station; a single value holds for all."""
        return self.chords * len(stations) if len(self.chords) == 1 else self.chords

    @property
    def weighed(self) -> bool:
        """Whether the mass of the blade is given."""
        return self.blade_mass_kg is not None or self.mass_per_length_kg_m is not None

    def masses(self, length: float, radius: float) -> tuple[float, float, float]:
        """Mass, flap inertia and static moment about the hinge; those of a uniform blade where only one is given, and
        of `LOCK_NUMBER` where none is.

        `length`: from the hinge outward [m]; eqs. (2.35), (2.37).
        """
        mass = self.blade_mass_kg or (self.mass_per_length_kg_m or 0.0) * length
        if not self.weighed:
            chord = sum(self.chords) / len(self.chords)
            inertia = (
                self.flap_inertia_kg_m2
                or SEA_LEVEL_DENSITY * LIFT_SLOPE * chord * radius**4 / LOCK_NUMBER
            )
            mass = 3.0 * inertia / length**2
        inertia = self.flap_inertia_kg_m2 or mass * length**2 / 3.0
        return mass, inertia, self.flap_static_moment_kg_m or mass * length / 2.0

    def twist(self, name: str) -> TwistLaw:
        if self.linear_twist_deg is not None:
            return LinearTwist(math.radians(self.linear_twist_deg))
        return TableTwist(
            self.twist_r or (), tuple(map(math.radians, self.twist_deg or ())), name=name
        )


class MainRotorTable(BladeTable, frozen=True, kw_only=True):
    """The keys of the blade as it flies are beside those of the rotor."""

    blades: Annotated[int, Meta(ge=2, le=12)]
    radius_m: Annotated[float, Meta(ge=0.1, le=30.0)]
    angular_speed_rad_s: _AngularSpeed | None = None
    speed_rpm: _Rpm | None = None
    tip_speed_m_s: _TipSpeed | None = None
    root_cutout_r: Annotated[float, Meta(ge=0.02, le=0.8)]
    reference_chord_m: _Chord | None = None
    hub: Hub = "articulated"
    precone_deg: Annotated[float, Meta(ge=-10.0, le=20.0)] | None = None
    document: BladeTable | None = None
    """The blade as a document states it."""

    def __post_init__(self) -> None:
        BladeTable.__post_init__(self)
        one_of(self, *_SPEEDS)
        says = f"hub is {self.hub!r} with {self.blades} blades"
        if self.hub.startswith("teetering") and self.blades != 2:
            raise Refusal(f"{says}: a teetering hub has two blades, so write articulated", "hub")
        if self.hub == "gimballed" and self.blades < 3:
            raise Refusal(f"{says}: with two blades write teetering", "hub")


class TailRotorTable(FileTable, frozen=True, kw_only=True):
    blades: Annotated[int, Meta(ge=2, le=20)]
    radius_m: Annotated[float, Meta(ge=0.05, le=10.0)]
    angular_speed_rad_s: _AngularSpeed | None = None
    speed_rpm: _Rpm | None = None
    tip_speed_m_s: _TipSpeed | None = None
    chord_m: Annotated[float, Meta(ge=0.005, le=2.0)]
    arm_m: Annotated[float, Meta(ge=0.5, le=40.0)]
    cant_deg: _Angle = 0.0
    tip_loss: Annotated[float, Meta(ge=0.5, le=1.0)] | None = None
    drag_polar: tuple[_Coefficient, _Coefficient, _Coefficient] = BAILEY_POLAR
    lift_slope_per_rad: Annotated[float, Meta(ge=1.0, le=10.0)] = LIFT_SLOPE

    def __post_init__(self) -> None:
        one_of(self, *_SPEEDS)
        if self.drag_polar[0] <= 0.0:
            says = f"drag_polar is {list(self.drag_polar)}"
            raise Refusal(f"{says}: give δ0 > 0, δ1 and δ2 of δ0 + δ1 α + δ2 α²", "drag_polar")

    def rotor(self) -> TailRotor:
        return TailRotor(
            radius=self.radius_m,
            angular_speed=angular_speed(self),
            chord=self.chord_m,
            blades=self.blades,
            arm=self.arm_m,
            cant=math.radians(self.cant_deg),
            tip_loss=self.tip_loss or 1.0 - 0.5 * self.chord_m / self.radius_m,
            drag_polar=self.drag_polar,
            lift_slope=self.lift_slope_per_rad,
        )


def angular_speed(rotor: MainRotorTable | TailRotorTable) -> float:
    """Rotor speed [rad/s] of the table, from whichever of its keys gives it."""
    if rotor.speed_rpm is not None:
        return rotor.speed_rpm * math.pi / 30.0
    return rotor.angular_speed_rad_s or (rotor.tip_speed_m_s or 0.0) / rotor.radius_m


class AirframeTable(FileTable, frozen=True, kw_only=True):
    mass_kg: Annotated[float, Meta(ge=100.0, le=50_000.0)]
    drag_area_m2: _Area
    drag_area_low_m2: _Area | None = None
    drag_area_high_m2: _Area | None = None
    hover_download: Annotated[float, Meta(ge=0.0, le=0.3)] = 0.0
    installed_power_kw: Annotated[float, Meta(ge=1.0, le=50_000.0)] | None = None

    def band(self) -> tuple[float, float] | None:
        """The least and the largest drag area. Refusal for ends that are not on its two sides, or for one of them."""
        low, high = self.drag_area_low_m2, self.drag_area_high_m2
        if low is None and high is None:
            return None
        if low is None or high is None:
            raise Refusal(
                "only one of drag_area_low_m2 and drag_area_high_m2: give both, or neither",
                "airframe",
            )
        given = f"drag_area_low_m2 = {low:g} and drag_area_high_m2 = {high:g}"
        check_bounds(self.drag_area_m2, low, high, "airframe", "drag_area_m2", given=given)
        return low, high


class ControlsTable(FileTable, frozen=True, kw_only=True):
    collective_deg: tuple[_Angle, _Angle]
    lateral_deg: tuple[_Angle, _Angle]
    longitudinal_deg: tuple[_Angle, _Angle]
    phase_deg: Annotated[float, Meta(ge=-90.0, le=90.0)] = 0.0

    def range(self) -> ControlRange:
        """Refusal for stops in another order."""
        ends: list[tuple[float, float]] = []
        for key in ("collective_deg", "lateral_deg", "longitudinal_deg"):
            low, high = getattr(self, key)
            if low >= high:
                says = f"{key} is {[low, high]}"
                raise Refusal(
                    f"{says}: write both stops, the lower first, for example [-8.0, 8.0]",
                    "controls",
                    key,
                )
            ends.append((math.radians(low), math.radians(high)))
        return ControlRange(*ends, phase=math.radians(self.phase_deg))


_ROWS = [(row.name, Annotated[float, Meta(ge=0.0, le=row.largest)], None) for row in UNCERTAIN]
DoubtTable = defstruct("DoubtTable", _ROWS, bases=(FileTable,))
"""Sizes of uncertain inputs, by the names of `assets/doubt.toml`."""


class TopTable(FileTable, frozen=True, kw_only=True):
    """The file itself. Its main rotor, doubt and sections are read by their own tables."""

    name: Text
    main_rotor: dict[str, Any]
    tail_rotor: TailRotorTable | None = None
    airframe: AirframeTable | None = None
    controls: ControlsTable | None = None
    doubt: dict[str, Any] = field(default_factory=dict[str, Any])
    sections: dict[str, Any] = field(default_factory=dict[str, Any])

    def __post_init__(self) -> None:
        # A name appears in menus and tables.
        if not re.fullmatch(r"[\w .,'()+/-]{1,40}", self.name) or not self.name.strip():
            says = f"name is {self.name[:60]!r}"
            raise Refusal(
                f"{says}: use 1 to 40 letters, digits, blanks and . , ' ( ) + / -", "name"
            )
