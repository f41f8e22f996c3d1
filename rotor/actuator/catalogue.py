"""The actuators of `assets/actuators.toml`."""

import math
import re
import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

from rotor.assets import asset_path
from rotor.dynamics.structure import titanium
from rotor.dynamics.thin_wall import Layer, Material
from rotor.user_input import did_you_mean

Electrodes = Literal["interdigitated", "continuous"]

_UNITS = re.compile(r"_(gpa|kg_m3|mm|m|pm_v|v|ppm|nf_cm2|c|nm|kg|w|s|deg)$")


STEPS = ("numerical studies", "small-scale tests", "full-scale wind tunnel", "demonstrator", "production")
"""Of development, from 1. Source: Burke & Gatto, Review of Rotary-Wing Morphing Actuation Systems, Aerospace 13(3) 297,
2026."""


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

    @property
    def readiness_text(self) -> str:
        """The step and its test, for a reader."""
        return f"{self.readiness} of {len(STEPS)}, {STEPS[self.readiness - 1]}: {self.tested}"

    def warnings(self, name: str) -> tuple[str, ...]:
        """Caveats of using the numbers, one sentence each."""
        found: list[str] = []
        if self.recalled:
            found.append(f"{name}: recalled, not looked up, verify before use: {_listed(self.recalled)}.")
        if self.assumed:
            found.append(f"{name}: assumed: {_listed(self.assumed)}.")
        return tuple(found)


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
    low_swing: float
    """Low end of the maker's strain, as a fraction of `swing`."""
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
        """That many plies as one layer of a wall, switched through the whole range."""
        return Layer(self.material, plies * self.thickness, angle, self.swing)


@dataclass(frozen=True)
class TorqueTube:
    """A shape-memory tube that twists the blade by a moment over its span; `plies` counts tubes in each segment."""

    id: str
    name: str
    torque: float
    """[N m] per tube, blocking."""
    free_rotation: float
    """Of the unloaded tube [rad], where its torque has fallen to nothing."""
    link_stiffness: float
    """GJ of the passive tube that carries the torque along the segment [N m²]."""
    link_mass: float
    """Of that tube [kg/m]."""
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
    data = _data()
    listed: list[Actuator] = [_ply(row) for row in data["ply"]]
    listed += [_tube(row) for row in data["tube"]]
    listed += [_extension_twist(row) for row in data["extension_twist"]]
    return {actuator.id: actuator for actuator in listed}


def find_actuator(id: str) -> Actuator:
    """One actuator; ValueError names the known ones."""
    known = actuators()
    if id not in known:
        hint = did_you_mean(id, known) or ":"
        raise ValueError(f"actuator {id!r} is not known{hint} use one of {', '.join(known)}")
    return known[id]


@cache
def model_to_test() -> float:
    """Measured over predicted twist of a tested blade (low confidence)."""
    return float(_data()["derating"]["model_to_test"])


def derating(actuator: Actuator) -> float:
    """Usable fraction of the nominal twist: low-end strain times the ratio of test to model."""
    return actuator.low_swing * model_to_test() if isinstance(actuator, PiezoPly) else 1.0


def holding_caveats(actuator: Actuator) -> tuple[str, ...]:
    """Caveats of holding a twist for minutes."""
    if not isinstance(actuator, PiezoPly):
        return ()
    return (
        f"{actuator.id}: hysteresis of {100.0 * actuator.hysteresis:.0f} % and creep: holding a twist needs strain "
        "feedback or charge drive. Without voltage the blade returns to its jig twist.",
    )


@cache
def _data() -> dict[str, Any]:
    return tomllib.loads(asset_path("actuators.toml").read_text(encoding="utf-8"))


def _ply(row: dict[str, Any]) -> PiezoPly:
    return PiezoPly(
        id=row["id"],
        name=row["name"],
        electrodes=row["electrodes"],
        material=Material(
            row["name"],
            1e9 * row["e1_gpa"],
            1e9 * row["e2_gpa"],
            row["nu12"],
            1e9 * row["g12_gpa"],
            row["density_kg_m3"],
        ),
        thickness=1e-3 * row["thickness_mm"],
        d_along=1e-12 * row["d_along_pm_v"],
        d_across=1e-12 * row["d_across_pm_v"],
        electrode_gap=1e-3 * row["electrode_gap_mm"],
        voltage_range=(row["voltage_min_v"], row["voltage_max_v"]),
        swing=(1e-6 * row["swing_along_ppm"], 1e-6 * row["swing_across_ppm"]),
        low_swing=row["low_swing"],
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


def _listed(keys: tuple[str, ...]) -> str:
    """Keys of the data file as words, their units left out."""
    return ", ".join(_UNITS.sub("", key).replace("_", " ") for key in keys)
