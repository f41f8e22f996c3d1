"""The structure of a blade along its span (`assets/uh60a_structure.toml`), and the rotating blade in torsion.

Twist along the span under an actuation moment, and the first natural frequency, follow from

    (GJ_e φ')' − Ω² I_θ φ = M_a',   φ = 0 at the pitch bearing,   GJ_e φ' = M_a at the free tip

with the trapeze effect GJ_e = GJ + F_c k_A² (the centrifugal force untwists the blade) and the tennis-racket
moment −Ω² I_θ φ per length (propeller moment, small angles, I_zz − I_yy ≈ I_θ). Uniform blade:
φ_tip = (M_a/GJ_e) tanh(λL)/λ, λ² = Ω² I_θ/GJ_e. Source: Houbolt & Brooks, NACA TR 1346 (1958).
Range: no coupling with bending, stiff control system. Linear finite elements, exact integrals of piecewise values.
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import eigh, solveh_banded

from rotor.arrays import Array
from rotor.assets import asset_path
from rotor.design.aircraft import Aircraft
from rotor.dynamics.thin_wall import Material


@dataclass(frozen=True)
class BladeStructure:
    """Stiffness and mass along one blade; stations in metres, values linear between them and constant beyond."""

    radius: float
    """[m]"""
    chord: float
    """[m]"""
    clamp: float
    """Radius of the pitch bearing [m]."""
    stations: tuple[float, ...]
    torsional_stiffness: tuple[float, ...]
    """GJ [N m²]"""
    mass_per_length: tuple[float, ...]
    """[kg/m]"""
    torsional_inertia: tuple[float, ...]
    """I_θ [kg m]"""
    flap_stiffness: tuple[float, ...]
    """EI [N m²]"""
    lag_stiffness: tuple[float, ...]
    axial_stiffness: float
    """EA [N]"""
    tension_gyration: float
    """k_A² [m²], the square of the polar radius of gyration of the part that carries the tension."""
    section_stiffness: float
    """GJ [N m²] to which the section model is calibrated."""
    reference_mass: float
    """Blade mass [kg] to which added mass is compared."""

    def at(self, r: ArrayLike, values: tuple[float, ...]) -> Array:
        """One of the distributions at r [m]."""
        return np.interp(np.asarray(r, dtype=float), self.stations, values)

    def centrifugal_force(self, r: ArrayLike, angular_speed: float, steps: int = 400) -> Array:
        """F_c(r) = Ω² ∫_r^R m ρ dρ [N] at r [m]."""
        grid = np.linspace(0.0, self.radius, steps + 1)
        pull = self.at(grid, self.mass_per_length) * grid
        strips = 0.5 * (pull[1:] + pull[:-1]) * np.diff(grid)
        outward = np.concatenate((np.cumsum(strips[::-1])[::-1], [0.0]))
        return angular_speed**2 * np.interp(np.asarray(r, dtype=float), grid, outward)


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
def uh60a_structure(radius: float = 8.1788) -> BladeStructure:
    """The UH-60A blade; `radius` [m] is the rotor's."""
    data = structure_data()
    stations, blade = data["stations"], data["blade"]
    return BladeStructure(
        radius=radius,
        chord=blade["chord_m"],
        clamp=blade["clamp_m"],
        stations=tuple(stations["r_m"]),
        torsional_stiffness=tuple(stations["gj_nm2"]),
        mass_per_length=tuple(stations["mass_kg_m"]),
        torsional_inertia=tuple(stations["torsional_inertia_kg_m"]),
        flap_stiffness=tuple(stations["flap_stiffness_nm2"]),
        lag_stiffness=tuple(stations["lag_stiffness_nm2"]),
        axial_stiffness=blade["axial_stiffness_n"],
        tension_gyration=blade["tension_gyration_m2"],
        section_stiffness=blade["section_gj_nm2"],
        reference_mass=blade["reference_mass_kg"],
    )


@cache
def titanium() -> Material:
    """The spar."""
    row = structure_data()["titanium"]
    young, nu = 1e9 * row["e_gpa"], row["nu"]
    return Material("titanium", young, young, nu, young / (2.0 * (1.0 + nu)), row["density_kg_m3"])


@cache
def glass() -> Material:
    """E-glass/epoxy, one direction."""
    row = structure_data()["glass"]
    return Material(
        "glass/epoxy", 1e9 * row["e1_gpa"], 1e9 * row["e2_gpa"], row["nu12"], 1e9 * row["g12_gpa"], row["density_kg_m3"]
    )


ELEMENTS = 240


@dataclass(frozen=True, eq=False)
class TorsionBeam:
    """A blade discretised for torsion: elements between nodes, values at element centres."""

    r: Array
    """Nodes [m], (elements + 1,), the first fixed in pitch."""
    stiffness: Array
    """GJ_e, trapeze effect included [N m²], (elements,)."""
    inertia: Array
    """I_θ [kg m], (elements,)."""
    angular_speed: float
    """[rad/s]"""

    @property
    def centres(self) -> Array:
        return 0.5 * (self.r[1:] + self.r[:-1])


@dataclass(frozen=True)
class Addition:
    """Mass, inertia and stiffness that the actuator adds between two radii."""

    span: tuple[float, float]
    """[m]"""
    mass_per_length: float
    """[kg/m]"""
    torsional_inertia: float
    """[kg m]"""
    stiffness: float
    """GJ added [N m²]."""


def torsion_beam(
    structure: BladeStructure,
    angular_speed: float,
    *,
    scale: float = 1.0,
    addition: Addition | None = None,
    trapeze: bool = True,
) -> TorsionBeam:
    """The blade with GJ × `scale` and an addition."""
    edges = np.linspace(structure.clamp, structure.radius, ELEMENTS + 1)
    r = np.unique(np.concatenate((edges, addition.span))) if addition else edges
    centres = 0.5 * (r[1:] + r[:-1])
    stiffness = scale * structure.at(centres, structure.torsional_stiffness)
    inertia = structure.at(centres, structure.torsional_inertia)
    force = structure.centrifugal_force(centres, angular_speed)
    if addition:
        inside = (centres > addition.span[0]) & (centres < addition.span[1])
        stiffness = stiffness + inside * addition.stiffness
        inertia = inertia + inside * addition.torsional_inertia
        force = force + added_pull(addition, centres, angular_speed)
    if trapeze:
        stiffness = stiffness + force * structure.tension_gyration
    return TorsionBeam(r, stiffness, inertia, angular_speed)


def added_pull(addition: Addition, r: ArrayLike, angular_speed: float) -> Array:
    """Centrifugal force of the addition outboard of r [N]: ½mΩ²(r2² − r²)."""
    low, high = addition.span
    inner = np.clip(np.asarray(r, dtype=float), low, high)
    return 0.5 * addition.mass_per_length * angular_speed**2 * (high**2 - inner**2)


def twist_under_moment(beam: TorsionBeam, moment: Array, *, per_rev: float = 0.0) -> Array:
    """φ at the nodes [rad] under M_a [N m] per element, steady or as the amplitude at `per_rev` × Ω, undamped."""
    stiffness, mass = _matrices(beam)
    if per_rev:
        stiffness = stiffness - (per_rev * beam.angular_speed) ** 2 * mass
    load = np.zeros(len(beam.r))
    load[1:] += moment
    load[:-1] -= moment
    if per_rev:
        free = _dense(stiffness)
        return np.concatenate(([0.0], np.linalg.solve(free, load[1:])))
    return np.concatenate(([0.0], solveh_banded(stiffness[:, 1:], load[1:], lower=True)))


def torsion_frequency(beam: TorsionBeam) -> float:
    """First torsion frequency over Ω [per rev]; uniform and clamped ω² ≈ (π/2L)² GJ/I_θ + Ω²."""
    stiffness, mass = _matrices(beam)
    lowest = eigh(_dense(stiffness), _dense(mass), eigvals_only=True, subset_by_index=[0, 0])[0]
    return float(np.sqrt(lowest)) / beam.angular_speed


def _matrices(beam: TorsionBeam) -> tuple[Array, Array]:
    """Stiffness (propeller moment included) and mass, lower banded, (2, nodes)."""
    length = np.diff(beam.r)
    spring = beam.stiffness / length
    weight = beam.inertia * length / 6.0
    nodes = len(beam.r)
    stiffness, mass = np.zeros((2, nodes)), np.zeros((2, nodes))
    for band, diagonal, off in ((stiffness, spring, -spring), (mass, 2.0 * weight, weight)):
        band[0, 1:] += diagonal
        band[0, :-1] += diagonal
        band[1, :-1] += off
    return stiffness + beam.angular_speed**2 * mass, mass


def _dense(banded: Array) -> Array:
    """The full matrix, without the fixed node."""
    diagonal, off = banded[0, 1:], banded[1, 1:-1]
    return np.diag(diagonal) + np.diag(off, 1) + np.diag(off, -1)
