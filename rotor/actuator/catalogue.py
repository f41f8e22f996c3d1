"""What the data files say: actuators, engines of the shipped aircraft, and what published programmes reached."""

import math
import re
import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

import numpy as np

from rotor.design.aircraft import Aircraft
from rotor.dynamics.structure import listed_material, titanium
from rotor.dynamics.thin_wall import Layer, Material
from rotor.support.assets import asset_path
from rotor.support.user_input import did_you_mean

Electrodes = Literal["interdigitated", "continuous"]

_UNITS = re.compile(r"_(gpa|kg_m3|mm|m|pm_v|v|ppm|nf_cm2|c|nm|kg|w|s|deg)$")


STEPS = ("numerical studies", "small-scale tests", "full-scale wind tunnel", "demonstrator", "production")
"""Steps of development, from 1. Source: Burke & Gatto, Review of Rotary-Wing Morphing Actuation Systems,
Aerospace 13(3) 297, 2026."""


@dataclass(frozen=True)
class DataProvenance:
    """Source of an actuator's numbers, and which of them are not verified."""

    source: str
    recalled: tuple[str, ...]
    """Keys of the data file that were recalled, not looked up."""
    assumed: tuple[str, ...]
    readiness: int
    """Step reached of `STEPS`."""
    tested: str
    """The test that it is placed by."""

    def warnings(self, name: str) -> tuple[str, ...]:
        """Caveats of using the numbers, one sentence each."""
        graded = ("values from memory, to be verified", self.recalled), ("assumed values", self.assumed)
        # Keys of the data file as words, their units left out.
        listed = ((grade, ", ".join(_UNITS.sub("", key).replace("_", " ") for key in keys)) for grade, keys in graded)
        return tuple(f"{name}: {grade}: {keys}." for grade, keys in listed if keys)


@dataclass(frozen=True)
class PiezoPly:
    """A piezoelectric sheet bonded to, or cured into, the skin."""

    id: str
    name: str
    electrodes: Electrodes
    """`interdigitated`: field along the fibres, d33 works; `continuous`: field through the thickness, d31 works."""
    material: Material
    thickness: float
    """[m]"""
    d_along: float
    """Strain along the fibres over field [m/V], high field."""
    d_across: float
    electrode_gap: float
    """Distance between electrodes, the path of the field [m]."""
    voltage_range: tuple[float, float]
    """[V]"""
    swing: tuple[float, float]
    """Free strain along and across over the whole voltage range, peak to peak [-]."""
    capacitance_per_area: float
    """[F/m²]"""
    linear_strain: float
    """Tension along the fibres that the sheet follows linearly [-]."""
    largest_strain: float
    """[-]"""
    temperature_range: tuple[float, float]
    """[°C]"""
    hysteresis: float
    """Width of the strain loop over its height."""
    provenance: DataProvenance

    @property
    def voltage_swing(self) -> float:
        """Peak to peak [V]."""
        return self.voltage_range[1] - self.voltage_range[0]

    def layer(self, plies: int, angle: float) -> Layer:
        """The plies as one layer of a wall, driven through the whole voltage range."""
        return Layer(self.material, plies * self.thickness, angle, self.swing)


@dataclass(frozen=True)
class TorqueTube:
    """A shape-memory tube that twists the blade by a moment over its span; `plies` counts tubes in each segment."""

    id: str
    name: str
    torque: float
    """[N m] per tube, blocking."""
    free_rotation: float
    """Rotation of the unloaded tube [rad], where its torque has fallen to nothing."""
    link_stiffness: float
    """GJ of the passive tube that carries the torque along the segment [N m²]."""
    link_mass: float
    """Mass of the tube that links actuator and blade [kg/m]."""
    mass: float
    """Package near the hub [kg] per tube."""
    move_power: float
    """[W] per tube."""
    hold_power: float
    move_time: float
    """[s]"""
    diameter: float
    """[m]"""
    temperature_range: tuple[float, float]
    """[°C]"""
    provenance: DataProvenance

    def working_torque(self, compliance: float, length: float, count: int = 1) -> float:
        """Moment of `count` tubes side by side on a segment of a length [m] that twists by compliance [rad/(N m)].

        The tube's line T = T_b (1 − φ/φ_free) meets its load: φ = M c + (M/n) l/GJ_link. Source of the line between
        blocking torque and free rotation, and of tests against torsional springs: Prahlad & Chopra, AIAA 2002-1445
        (their curve is not straight). Range: heated through; hysteresis and the return stroke are not modelled.
        """
        load = count * compliance + length / self.link_stiffness
        return count * self.torque / (1.0 + self.torque * load / self.free_rotation)


@dataclass(frozen=True)
class ExtensionTwist:
    """A laminate that twists under centrifugal tension: passive, so only rotor speed changes its twist."""

    id: str
    name: str
    twist: float
    """Tip twist between standstill and full speed [rad]."""
    speed_change: float
    """Share by which the rotor may be slowed in flight."""
    provenance: DataProvenance

    @property
    def attainable(self) -> float:
        """Change of tip twist between full and lowered speed [rad]: twist goes with Ω²."""
        return self.twist * (1.0 - (1.0 - self.speed_change) ** 2)


Actuator = PiezoPly | TorqueTube | ExtensionTwist


@cache
def actuators() -> dict[str, Actuator]:
    """All actuators by id, in the order of the data file."""
    makers = {"ply": _ply, "tube": _tube, "extension_twist": _extension_twist}
    listed = [make(row) for kind, make in makers.items() for row in _data("actuators")[kind]]
    return {actuator.id: actuator for actuator in listed}


def find_actuator(id: str) -> Actuator:
    """One actuator; ValueError names the known ones."""
    known = actuators()
    if id not in known:
        hint = did_you_mean(id, known) or ":"
        raise ValueError(f"actuator {id!r} is not known{hint} use one of {', '.join(known)}")
    return known[id]


def holding_caveats(actuator: Actuator) -> tuple[str, ...]:
    """Caveats of holding a twist for minutes."""
    if not isinstance(actuator, PiezoPly):
        return ()
    return (
        f"{actuator.id} has {100.0 * actuator.hysteresis:.0f} % hysteresis and creeps, so holding a twist needs strain "
        "feedback or charge drive. Without voltage the blade returns to its built-in twist.",
    )


@cache
def _data(name: str) -> dict[str, Any]:
    return tomllib.loads(asset_path(f"{name}.toml").read_text(encoding="utf-8"))


def _ply(row: dict[str, Any]) -> PiezoPly:
    return PiezoPly(
        id=row["id"],
        name=row["name"],
        electrodes=row["electrodes"],
        material=listed_material(row["name"], row),
        thickness=1e-3 * row["thickness_mm"],
        d_along=1e-12 * row["d_along_pm_v"],
        d_across=1e-12 * row["d_across_pm_v"],
        electrode_gap=1e-3 * row["electrode_gap_mm"],
        voltage_range=(row["voltage_min_v"], row["voltage_max_v"]),
        swing=(1e-6 * row["swing_along_ppm"], 1e-6 * row["swing_across_ppm"]),
        capacitance_per_area=1e-5 * row["capacitance_nf_cm2"],
        linear_strain=1e-6 * row["linear_strain_ppm"],
        largest_strain=1e-6 * row["largest_strain_ppm"],
        temperature_range=(row["temperature_min_c"], row["temperature_max_c"]),
        hysteresis=row["hysteresis"],
        provenance=_provenance(row),
    )


def _tube(row: dict[str, Any]) -> TorqueTube:
    outer = 1e-3 * row["link_outer_mm"]
    inner = outer - 2e-3 * row["link_wall_mm"]
    metal = titanium()
    return TorqueTube(
        id=row["id"],
        name=row["name"],
        torque=row["torque_nm"],
        free_rotation=1e-6 * row["free_shear_ppm"] * row["length_m"] / (0.5e-3 * row["diameter_mm"]),
        link_stiffness=metal.g12 * math.pi / 32.0 * (outer**4 - inner**4),
        link_mass=metal.density * math.pi / 4.0 * (outer**2 - inner**2),
        mass=row["mass_kg"],
        move_power=row["move_power_w"],
        hold_power=row["hold_power_w"],
        move_time=row["move_time_s"],
        diameter=1e-3 * row["diameter_mm"],
        temperature_range=(row["temperature_min_c"], row["temperature_max_c"]),
        provenance=_provenance(row),
    )


def _extension_twist(row: dict[str, Any]) -> ExtensionTwist:
    return ExtensionTwist(
        id=row["id"],
        name=row["name"],
        twist=math.radians(row["twist_deg"]),
        speed_change=row["speed_change"],
        provenance=_provenance(row),
    )


def _provenance(row: dict[str, Any]) -> DataProvenance:
    return DataProvenance(row["source"], tuple(row["recalled"]), tuple(row["assumed"]), row["readiness"], row["tested"])


HORSEPOWER = 745.699872
"""[W]"""
POUND = 0.45359237
"""[kg]"""


@dataclass(frozen=True)
class Engines:
    """The engines of one aircraft: fuel flow of each over its shaft power, as a table or a polynomial.

    Power is that of the rotors: losses of gearboxes and accessories are not in it. At sea level; where a change of some
    kilowatts is asked for, the slope of the curve counts, which is less than the specific consumption.
    """

    count: int
    name: str
    table: tuple[tuple[float, float], ...]
    """(power [W], flow [kg/s]), rising; straight lines between and beyond. Empty: the polynomial counts."""
    polynomial: tuple[float, ...]
    """Flow [kg/s] over power [hp], lowest power first."""
    source: str
    caveat: str
    """What the numbers are not; empty for those of the engine itself."""

    def flow(self, power: float) -> float:
        """Fuel flow of all engines [kg/s] at the power of the rotors [W], shared evenly; no fuel is given back."""
        each = max(power, 0.0) / self.count
        if not self.table:
            return self.count * float(np.polynomial.Polynomial(self.polynomial)(each / HORSEPOWER))
        x, y = np.array(self.table).T
        k = int(np.clip(np.searchsorted(x, each) - 1, 0, len(x) - 2))
        slope = (y[k + 1] - y[k]) / (x[k + 1] - x[k])
        return self.count * float(y[k] + slope * (each - x[k]))


def engines_of(aircraft: Aircraft) -> Engines | None:
    """The engines of a shipped aircraft; None without a source for their fuel flow."""
    row = _data("engines").get(aircraft.key)
    if row is None:
        return None
    points = zip(row.get("power_hp", ()), row.get("flow_lb_h", ()), strict=True)
    return Engines(
        count=row["engines"],
        name=row["name"],
        table=tuple((HORSEPOWER * power, POUND / 3600.0 * flow) for power, flow in points),
        polynomial=tuple(row.get("polynomial_kg_s", ())),
        source=row["source"],
        caveat=row["caveat"],
    )


def fuel_caveats(aircraft: Aircraft) -> tuple[str, ...]:
    """A sentence on what is unknown about the aircraft's fuel flow."""
    engines = engines_of(aircraft)
    if engines is None:
        return (f"The fuel flow of the {aircraft.name} engines has no source, so savings are given as power only.",)
    return (f"Fuel: {engines.caveat} ({engines.source}).",) if engines.caveat else ()


Control = Literal["active twist", "root pitch", "trailing-edge flap"]
Evidence = Literal["computed", "wind tunnel", "flight"]


@dataclass(frozen=True, kw_only=True)
class Programme:
    """One published result. Changes are against the same rotor without active control [%]; None: not stated."""

    name: str
    short: str
    """For a label beside a point."""
    rotor: str
    control: Control
    kind: Evidence
    per_rev: tuple[int, ...] = ()
    """Harmonics driven; empty where the text does not say."""
    amplitude_deg: tuple[float, float] | None = None
    """Lowest and highest, at the tip or at the root, as `control` says."""
    vibration_percent: tuple[float, float] | None = None
    """Lowest and highest change; negative is less vibration."""
    vibration: str = ""
    """Which measure of vibration that is; empty without one."""
    power_percent: float | None = None
    """Change of rotor power as stated; negative is less."""
    lift_to_drag_percent: float | None = None
    """Change of the rotor's effective lift-to-drag ratio as stated; positive is better."""
    together: bool
    """Whether vibration and power belong to the same input at the same condition."""
    grade: str
    """P authors' own text, S press or another text that quotes them, T quoted by the source document."""
    source: str
    note: str

    @property
    def power_change_percent(self) -> float | None:
        """Change of power [%]: as stated, else that of L/D turned into power at the same lift and speed.

        P ∝ 1/(L/D), so ΔP/P = 1/(1 + ΔL/D) − 1; it counts the rotor's propulsive force as power.
        """
        if self.power_percent is not None or self.lift_to_drag_percent is None:
            return self.power_percent
        return 100.0 * (1.0 / (1.0 + 0.01 * self.lift_to_drag_percent) - 1.0)


@cache
def programmes() -> tuple[Programme, ...]:
    """All published results, in the order of the data file."""
    return tuple(_programme(row) for row in _data("active_twist_programmes")["programme"])


def _programme(row: dict[str, Any]) -> Programme:
    ranges = ("per_rev", "amplitude_deg", "vibration_percent")
    pairs: dict[str, Any] = {key: tuple(row[key]) for key in ranges if key in row}
    return Programme(**(row | pairs))
