"""What every kind of actuator answers for itself, and an actuator on a blade.

A kind derives from `Actuator`. What it does not say is that of a passive one: no mass, no moment, no drive.
"""

import math
import re
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from rotor.actuator.section import HostBlade, Placement, SectionSpec
from rotor.design.blade import BladeStructure
from rotor.design.design import Design
from rotor.dynamics.torsion import AddedStructure, TorsionBeam
from rotor.support.arrays import Array
from rotor.trim.solution import Solution

_UNITS = {
    "gpa": 1e9, "kg_m3": 1.0, "mm": 1e-3, "m": 1.0, "pm_v": 1e-12, "v": 1.0, "ppm": 1e-6, "nf_cm2": 1e-5, "c": 1.0,
    "nm": 1.0, "kg": 1.0, "w": 1.0, "s": 1.0, "deg": math.pi / 180.0,
}  # fmt: skip
"""SI of each unit at the end of a key of the data file."""
_UNIT = re.compile(rf"_({'|'.join(_UNITS)})$")


def in_si(row: Mapping[str, Any]) -> dict[str, Any]:
    """A row of the data file with numbers in SI, by keys without units."""
    ends = {key: _UNITS[unit[1]] if (unit := _UNIT.search(key)) else None for key in row}
    return {
        _UNIT.sub("", key): row[key] if unit is None else unit * row[key]
        for key, unit in ends.items()
    }


MOST_BOUNDS = 10.0
"""A value beyond this many times its limit is not printed: the laws it follows from do not hold there."""
LEAST_TIP_TWIST = math.radians(0.005)
"""An actuator of less range is too weak: its twist prints as 0.00° [rad]."""


@dataclass(frozen=True)
class DataProvenance:
    """Source of an actuator's numbers, and which of them are not verified."""

    source: str
    recalled: tuple[str, ...]
    """Keys of the data file that were recalled, not looked up."""
    assumed: tuple[str, ...]
    readiness: int
    """Step reached of `catalogue.STEPS`."""
    tested: str
    """The test that it is placed by."""

    @property
    def sourced(self) -> bool:
        """Whether no value is recalled or assumed, as `rotor.trim.doubt.sureness` asks."""
        return not (self.recalled or self.assumed)

    def warnings(self, name: str) -> tuple[str, ...]:
        """Caveats of using the numbers, one sentence each."""
        graded = (
            ("values from memory, to be verified", self.recalled),
            ("assumed values", self.assumed),
        )
        # Keys of the data file as words, their units left out.
        listed = (
            (grade, ", ".join(_UNIT.sub("", key).replace("_", " ") for key in keys))
            for grade, keys in graded
        )
        return tuple(f"{name}: {grade}: {keys}." for grade, keys in listed if keys)


@dataclass(frozen=True)
class MassBreakdown:
    """Added mass [kg]."""

    blades: int
    actuator: float = 0.0
    """Per blade."""
    wiring: float = 0.0
    """Per blade."""
    balance: float = 0.0
    """Per blade."""
    electronics: float = 0.0
    """Per aircraft."""

    @property
    def blade(self) -> float:
        """Mass added to one blade [kg]."""
        return self.actuator + self.wiring + self.balance

    @property
    def aircraft(self) -> float:
        """Mass added to the aircraft, including all blades [kg]."""
        return self.blades * self.blade + self.electronics


@dataclass(frozen=True)
class Drive:
    """Drive power of the actuators of all blades."""

    capacitance: float = 0.0
    """Capacitance of one blade's actuators [F]; 0 without voltage."""
    hold_power: float = 0.0
    """[W], all blades: only leakage for a ply."""
    slew_power: float = 0.0
    """Mean [W] while changing the twist of all blades by the swing, amplifier losses included."""
    slew_time: float = 0.0
    """[s]"""


@dataclass(frozen=True)
class Limit:
    """One constraint: its value, its bound and whether it is met."""

    name: str
    """Short and stable, for scripts."""
    ok: bool
    value: float
    bound: float
    unit: str
    sentence: str

    @property
    def far_above(self) -> bool:
        """Whether the value is so far above the bound that it says nothing: `MOST_BOUNDS` times, or any where the
        bound is 0."""
        return not self.ok and self.value > MOST_BOUNDS * self.bound


Swings = tuple[float, ...]
"""Twist of each segment as a share of its whole range, positive for tip up."""


@dataclass(frozen=True, kw_only=True)
class Actuator(ABC):
    """An actuator with its data; each kind of actuator is a subclass."""

    id: str
    name: str
    provenance: DataProvenance
    temperature_range: tuple[float, float] | None
    """[°C]; None where nothing of it is limited by heat."""

    noun: ClassVar[tuple[str, str]]
    """One of it, and several."""
    settings: ClassVar[tuple[str, ...]] = ("plies", "span")
    """What of its placement can be chosen: without `span` it is the whole blade, with `chord` it lies on both skins.
    `crossed`: it can be laid so that it turns the tip the other way."""
    drive_noun: ClassVar[str] = "drive"
    drive_unit: ClassVar[str] = "%"
    follows_azimuth: ClassVar[bool] = False
    """Whether it is fast enough for n/rev."""
    range_limits: ClassVar[tuple[str, ...]] = ()
    """Names of the limits that only say that more twist is asked for than there is."""
    forbidden: ClassVar[str] = ""
    """Why its principle cannot work on such a rotor, as `forbidden by …`; empty where it can."""

    @classmethod
    def read(cls, row: Mapping[str, Any]) -> Self:
        """One row of its table in assets/actuators.toml, as by `in_si`, with the fields that all kinds have."""
        return cls(**{field.name: row[field.name] for field in fields(cls)})

    # In words

    @property
    @abstractmethod
    def mode(self) -> str:
        """The means of actuation in a few words, for example `d33 fibres`."""

    @property
    def properties(self) -> dict[str, str]:
        """The columns of table 5.1 that only this kind has, by heading."""
        return {}

    @property
    def caveats(self) -> tuple[str, ...]:
        """Caveats of the actuator's data, one sentence each."""
        return self.provenance.warnings(self.name)

    @property
    def on_skin(self) -> bool:
        """Whether the actuator lies on the skins; otherwise it is in the spar."""
        return "chord" in self.settings

    def count(self, placement: Placement) -> str:
        """Number of actuators in words, for example `2 plies`."""
        return f"{placement.plies} {self.noun[placement.plies > 1]}"

    def depth(self, placement: Placement) -> float:
        """Thickness of the sheet on a skin, or diameter of the rod in the spar, as drawn [m]."""
        return 0.0

    # Its drive

    @property
    def drive_range(self) -> tuple[float, float]:
        """Lowest and highest drive in `drive_unit`; the lowest is zero if it twists the tip one way only."""
        return 0.0, 100.0

    @property
    def drive_swing(self) -> float:
        """Drive over the whole range of twist, in the unit of the drive."""
        return self.drive_range[1]

    def swing_at(self, share: float) -> float:
        """The swing at a share of either side of the drive, −1…1; the two sides need not be alike."""
        return self.driven_at(share) / self.drive_swing

    def driven_at(self, share: float) -> float:
        """The drive at a share of either side, −1…1, in its unit."""
        low, high = self.drive_range
        return share * (high if share >= 0.0 else -low)

    def share_of(self, swing: float) -> float:
        """The share of either side of the drive, −1…1, that gives a swing: the inverse of `swing_at`."""
        side = self.drive_range[1] if swing >= 0.0 else -self.drive_range[0]
        return min(max(swing * self.drive_swing / side, -1.0), 1.0) if side else 0.0

    @property
    def retrofit_swings(self) -> tuple[float, float]:
        """Range of swings of a retrofit, which leaves the twist of the blade unchanged at zero drive."""
        low, high = (drive / self.drive_swing for drive in self.drive_range)
        return low, high

    def voltages(
        self, swings: tuple[Swings, ...], host: HostBlade
    ) -> tuple[tuple[float, ...], ...]:
        """Voltages of each segment, one for each leg [V]; empty where voltage does not drive it."""
        return ()

    # On a blade

    def masses(
        self, placement: Placement, blades: int, skin_area: float, length: float
    ) -> MassBreakdown:
        """Masses for a `skin_area` [m²] of one layer on both skins of a blade, and a `length` [m] of all segments."""
        return MassBreakdown(blades)

    def section(self, spec: SectionSpec, placement: Placement) -> tuple[float, float]:
        """GJ of the active section [N m²], and the moment that the actuator is driven by in it [N m]."""
        return spec.stiffness, 0.0

    def moments(
        self, moment: float, compliance: Array, lengths: Array, placement: Placement
    ) -> Array:
        """Moment of each segment [N m], whose tip turns by its compliance [rad/(N m)]; `moment`: that of `section`."""
        return np.full(len(lengths), moment)

    def shapes(self, moments: Array, units: Array, beam: TorsionBeam) -> Array:
        """Twist of each segment at its moment [rad]; `units`: at 1 N m, (segments, nodes)."""
        return moments[:, None] * units

    def drive(self, installed: "InstalledActuator", swings: Swings) -> Drive:
        """Power to hold the twist, and to slew by the swing of each segment."""
        return Drive()

    def harmonic_loss(
        self, installed: "InstalledActuator", per_rev: float, amplitude: float
    ) -> float:
        """Heat on one blade driven at a harmonic [W]; amplitude: over half the range."""
        return 0.0

    def limits(
        self, installed: "InstalledActuator", swings: Swings, solutions: Sequence[Solution]
    ) -> tuple[Limit, ...]:
        """Limits that only this kind has, for the required `swings`, which may exceed 1."""
        return ()


@dataclass(frozen=True, eq=False)
class InstalledActuator:
    """One actuator on one blade. Angles are peak to peak over the whole voltage range, nominal, rotating."""

    actuator: Actuator
    placement: Placement
    host: HostBlade
    section_stiffness: float
    """GJ of the active section [N m²]."""
    moment: float
    """M_a [N m], of tubes the largest of the segments; 0 for a passive laminate."""
    twist_rate: float
    """θ'_a of the section, not rotating [rad/m]."""
    segment_areas: tuple[float, ...]
    """Areas of one layer on one blade, both skins, by segment [m²]."""
    masses: MassBreakdown
    added: AddedStructure
    beam: TorsionBeam
    r: Array
    """Nodes, r/R, (nodes,)."""
    shapes: Array
    """Twist of each segment alone [rad], zero at the pitch bearing, (segments, nodes)."""
    rest_shapes: Array
    """Twist of each segment on the blade at rest: what is added to an elastic blade, whose trim finds the rest."""
    blade: BladeStructure
    """The blade in torsion with the actuator's stiffness, inertia and mass."""
    frequency: float
    """First torsion [per rev]."""

    @property
    def count(self) -> str:
        """How many of it there are, as text."""
        return self.actuator.count(self.placement)

    @property
    def electronics_span(self) -> tuple[float, float]:
        """Ends of the drive electronics, r/R (figure 5.8), between flap hinge and active span."""
        return float(self.r[0]) + 0.02, self.placement.span[0] - 0.02

    @property
    def skin_area(self) -> float:
        """Area of one layer on one blade, both skins [m²]."""
        return math.fsum(self.segment_areas)

    @property
    def attainable(self) -> float:
        """Twist from root to tip, the sum of all segments [rad]."""
        return float(self.segment_twists.sum())

    @property
    def too_weak(self) -> bool:
        """Whether it hardly moves: its twist prints as 0.00°."""
        return self.attainable < LEAST_TIP_TWIST

    @property
    def segment_twists(self) -> Array:
        """Twist of each segment, root to tip [rad]."""
        return np.abs(self.shapes[:, -1])

    def shapes_in(self, design: Design) -> Array:
        """What each segment adds to the design's twist law [rad], (segments, nodes)."""
        return self.rest_shapes if design.elastic else self.shapes

    def on(self, design: Design) -> Design:
        """The design with the stiffness and inertia of this blade, where it is elastic."""
        if not design.elastic:
            return design
        rotor = design.rotor
        return replace(
            design, rotor=replace(rotor, blade=replace(rotor.blade, structure=self.blade))
        )

    def change(self, swings: ArrayLike, r: ArrayLike) -> Array:
        """Twist at r/R for each segment's swing (−1…1 of its whole range) [rad], zero at the pitch bearing."""
        total: Array = np.asarray(swings, dtype=float) @ self.shapes
        return np.interp(np.asarray(r, dtype=float), self.r, total)

    def tip(self, swings: ArrayLike) -> float:
        """Twist in flight: what the actuator adds at the tip of the rotating blade [rad], nose up positive.

        With tension and propeller moment, which take 7 % of what the blade at rest gains (`rest_shapes`), without the
        air: that takes another 1 to 5 % in trims of the UH-60A's blade, and 10 % of one half as stiff.
        """
        return float(np.asarray(swings, dtype=float) @ self.shapes[:, -1])

    def limit(self, r: ArrayLike) -> Array:
        """Largest change of twist relative to the root at r/R, either way [rad]: the bound an optimiser needs."""
        total: Array = np.abs(self.shapes).sum(axis=0)
        return np.interp(np.asarray(r, dtype=float), self.r, total)
