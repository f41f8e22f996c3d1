"""The structure and the materials of the UH-60A blade along its span (`assets/uh60a_structure.toml`)."""

import tomllib
from dataclasses import dataclass, fields
from functools import cache
from typing import Any

from rotor.design.aircraft import Aircraft
from rotor.design.blade import BladeStructure
from rotor.dynamics.thin_wall import Material
from rotor.support.assets import asset_path


@dataclass(frozen=True, kw_only=True)
class BendingStructure(BladeStructure):
    """A blade whose section is known as well, as the models of actuators need."""

    chord: float
    """[m]"""
    axial_stiffness: float
    """EA [N]"""
    section_stiffness: float
    """GJ [N m²] to which the section model is calibrated."""


@cache
def structure_data() -> dict[str, Any]:
    """The parsed `assets/uh60a_structure.toml`."""
    return tomllib.loads(asset_path("uh60a_structure.toml").read_text(encoding="utf-8"))


KNOWN_BLADE = "uh60a"
"""The rotor whose blade structure is known."""


def check_blade(aircraft: Aircraft) -> None:
    """Raise ValueError for a rotor whose blade structure is not known."""
    if aircraft.key != KNOWN_BLADE:
        raise ValueError(
            f"The structure of the {aircraft.name} blade is not known, and actuators are computed for the UH-60A only: "
            "choose that rotor."
        )


@cache
def uh60a_structure(radius: float = 8.1788) -> BendingStructure:
    """The UH-60A blade; `radius` [m] is the rotor's."""
    data = structure_data()
    stations, blade = data["stations"], data["blade"]
    return BendingStructure(
        radius=radius,
        chord=blade["chord_m"],
        clamp=blade["clamp_m"],
        stations=tuple(stations["r_m"]),
        torsional_stiffness=tuple(stations["gj_nm2"]),
        mass_per_length=tuple(stations["mass_kg_m"]),
        torsional_inertia=tuple(stations["torsional_inertia_kg_m"]),
        flap_stiffness=tuple(stations["flap_stiffness_nm2"]),
        lag_stiffness=tuple(stations["lag_stiffness_nm2"]),
        lag_damper=blade["lag_damper_nm_s_rad"],
        axial_stiffness=blade["axial_stiffness_n"],
        tension_gyration=blade["tension_gyration_m2"],
        control_stiffness=blade["control_stiffness_nm_rad"],
        pitch_horn=blade["pitch_horn_m"],
        section_stiffness=blade["section_gj_nm2"],
    )


@cache
def uh60a_torsion(radius: float) -> BladeStructure:
    """What of `uh60a_structure` a rotor file may state; radius R [m]."""
    known = uh60a_structure(radius)
    return BladeStructure(**{field.name: getattr(known, field.name) for field in fields(BladeStructure)})


def titanium() -> Material:
    """The spar."""
    row = structure_data()["titanium"]
    young, nu = 1e9 * row["e_gpa"], row["nu"]
    return Material("titanium", young, young, nu, young / (2.0 * (1.0 + nu)), row["density_kg_m3"])


def glass() -> Material:
    """E-glass/epoxy, one direction."""
    return listed_material("glass/epoxy", structure_data()["glass"])


def listed_material(name: str, row: dict[str, Any]) -> Material:
    """A material of one direction as the data files list it."""
    moduli = (1e9 * row["e1_gpa"], 1e9 * row["e2_gpa"], row["nu12"], 1e9 * row["g12_gpa"])
    return Material(name, *moduli, row["density_kg_m3"])
