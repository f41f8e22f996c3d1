"""The structure and the materials of the UH-60A blade along its span (`assets/uh60a_structure.toml`)."""

from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Any

from rotor.design.aircraft import Aircraft
from rotor.design.blade import BladeStructure, Carried, Rotor
from rotor.dynamics.thin_wall import Material
from rotor.dynamics.torsion import AddedStructure, stiffer_blade
from rotor.support.assets import toml_asset


@dataclass(frozen=True, kw_only=True)
class BendingStructure(BladeStructure):
    """A blade whose section is known as well, as the models of actuators need."""

    chord: float
    """[m]"""
    axial_stiffness: float
    """EA [N]"""
    section_stiffness: float
    """GJ [N m²] to which the section model is calibrated."""


def structure_data() -> dict[str, Any]:
    """The parsed `assets/uh60a_structure.toml`."""
    return toml_asset("uh60a_structure.toml")


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
    """The part of `uh60a_structure` that a rotor file may state, for a radius R [m]."""
    known = uh60a_structure(radius)
    return BladeStructure(
        **{field.name: getattr(known, field.name) for field in fields(BladeStructure)}
    )


def heavier(rotor: Rotor, mass: float, span: tuple[float, float]) -> Rotor:
    """The rotor with a mass [kg] spread evenly over a span [m] of each blade."""
    blade = rotor.blade
    inner, outer = (end - blade.flap_hinge * rotor.radius for end in span)
    line = mass / (outer - inner)
    loaded = replace(
        blade,
        mass=blade.mass + mass,
        flap_static_moment=blade.flap_static_moment + line * (outer**2 - inner**2) / 2.0,
        flap_inertia=blade.flap_inertia + line * (outer**3 - inner**3) / 3.0,
    )
    return replace(rotor, blade=loaded)


def carrying(rotor: Rotor, carried: Carried, *, elastic: bool) -> Rotor:
    """The rotor with an actuator on its blades; `elastic`: its stiffness and inertia count too."""
    loaded = heavier(rotor, carried.blade_kg, carried.span_m)
    structure = loaded.blade.structure
    if elastic:
        line = carried.blade_kg / (carried.span_m[1] - carried.span_m[0])
        added = AddedStructure(carried.span_m, line, carried.inertia_kg_m, carried.added_gj_nm2)
        structure = stiffer_blade(uh60a_torsion(rotor.radius), carried.gj_factor, added)
    return replace(loaded, blade=replace(loaded.blade, structure=structure, carried=carried))


def titanium() -> Material:
    """The spar."""
    row = structure_data()["titanium"]
    young, nu = 1e9 * row["e_gpa"], row["nu"]
    return Material("titanium", young, young, nu, young / (2.0 * (1.0 + nu)), row["density_kg_m3"])


def glass() -> Material:
    """E-glass/epoxy, one direction."""
    row = structure_data()["glass"]
    moduli = (1e9 * row["e1_gpa"], 1e9 * row["e2_gpa"], row["nu12"], 1e9 * row["g12_gpa"])
    return Material("glass/epoxy", *moduli, row["density_kg_m3"])
