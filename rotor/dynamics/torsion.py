"""The rotating blade in torsion: natural modes, and twist under the moment of an actuator.

    (GJ_e φ')' − Ω² I_θ φ = M_a',   GJ_e φ' = K_θ φ + M_a at the pitch bearing,   GJ_e φ' = M_a at the free tip

with the trapeze effect GJ_e = GJ + F_c k_A² (the centrifugal force untwists the blade), the tennis-racket moment
−Ω² I_θ φ per length (propeller moment, small angles, I_zz − I_yy ≈ I_θ) and the stiffness K_θ of the control system;
φ = 0 at the bearing where that is taken as stiff. Uniform and clamped: φ_tip = (M_a/GJ_e) tanh(λL)/λ,
λ² = Ω² I_θ/GJ_e. Source: Houbolt & Brooks, NACA TR 1346 (1958).
Range: no coupling with bending. Linear finite elements, exact integrals of piecewise values.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import eigh, solveh_banded

from rotor.design.blade import BladeStructure
from rotor.support.arrays import Array, read_only
from rotor.support.blas_threads import one_blas_thread
from rotor.support.bytes_cache import bytes_cache

ELEMENTS = 240


@dataclass(frozen=True, eq=False)
class TorsionBeam:
    """A blade discretised for torsion: elements between nodes, values at element centres."""

    r: Array
    """Nodes [m], (elements + 1,), the first at the pitch bearing."""
    stiffness: Array
    """GJ_e, trapeze effect included [N m²], (elements,)."""
    inertia: Array
    """I_θ [kg m], (elements,)."""
    pull: Array
    """F_c k_A² within `stiffness` [N m²], (elements,)."""
    angular_speed: float
    """[rad/s]"""
    control_stiffness: float = math.inf
    """K_θ at the first node [N m/rad]."""


@dataclass(frozen=True)
class AddedStructure:
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
    addition: AddedStructure | None = None,
    control: bool = False,
) -> TorsionBeam:
    """The blade turning at a speed [rad/s], GJ × `scale`, with an addition; on its `control` system, or clamped."""
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
    pull = force * structure.tension_gyration
    spring = structure.control_stiffness if control else math.inf
    return TorsionBeam(r, stiffness + pull, inertia, pull, angular_speed, spring)


def added_pull(addition: AddedStructure, r: ArrayLike, angular_speed: float) -> Array:
    """Centrifugal force of the addition outboard of r [N]: ½mΩ²(r2² − r²)."""
    low, high = addition.span
    inner = np.clip(np.asarray(r, dtype=float), low, high)
    return 0.5 * addition.mass_per_length * angular_speed**2 * (high**2 - inner**2)


def stiffer_blade(
    structure: BladeStructure, scale: float, addition: AddedStructure
) -> BladeStructure:
    """The blade with GJ × `scale` and an addition, as a structure with stations of its own."""
    low, high = addition.span
    edge = 1e-6 * structure.radius
    ends = (low - edge, low + edge, high - edge, high + edge)
    stations = np.unique([*structure.stations, *ends])
    inside = (stations > low) & (stations < high)

    def column(values: tuple[float, ...], factor: float, added: float) -> tuple[float, ...]:
        return tuple((factor * structure.at(stations, values) + inside * added).tolist())

    return replace(
        structure,
        stations=tuple(stations.tolist()),
        torsional_stiffness=column(structure.torsional_stiffness, scale, addition.stiffness),
        mass_per_length=column(structure.mass_per_length, 1.0, addition.mass_per_length),
        torsional_inertia=column(structure.torsional_inertia, 1.0, addition.torsional_inertia),
        flap_stiffness=column(structure.flap_stiffness, 1.0, 0.0) if structure.bends else (),
        lag_stiffness=column(structure.lag_stiffness, 1.0, 0.0) if structure.bends else (),
    )


def twist_under_moment(beam: TorsionBeam, moment: Array) -> Array:
    """φ at the nodes [rad] of the clamped blade under a steady M_a [N m] per element."""
    stiffness, _ = _matrices(beam)
    load = np.zeros(len(beam.r))
    load[1:] += moment
    load[:-1] -= moment
    return np.concatenate(([0.0], solveh_banded(stiffness[:, 1:], load[1:], lower=True)))


def torsion_frequency(beam: TorsionBeam) -> float:
    """First torsion frequency over Ω [per rev]; uniform and clamped ω² ≈ (π/2L)² GJ/I_θ + Ω²."""
    return float(torsion_modes(beam, 1).frequency[0]) / beam.angular_speed


@dataclass(frozen=True, eq=False)
class TorsionModes:
    """The lowest natural modes of a rotating blade in torsion, each one radian at the tip."""

    r: Array
    """Nodes [m], (nodes,)."""
    shape: Array
    """Φ at the nodes [-], (modes, nodes)."""
    frequency: Array
    """[rad/s], (modes,)."""
    inertia: Array
    """∫ I_θ Φ² dr [kg m²], (modes,)."""
    pull: Array
    """F_c k_A² at the element centres [N m²], (nodes − 1,)."""

    def at(self, r: ArrayLike) -> Array:
        """Φ at r [m], (modes, stations); zero inboard of the pitch bearing."""
        radii = np.asarray(r, dtype=float)
        rows: list[Array] = [np.interp(radii, self.r, row, left=0.0) for row in self.shape]
        return np.stack(rows)

    @property
    def stiffness(self) -> Array:
        """Modal stiffness [N m/rad], (modes,)."""
        return self.inertia * self.frequency**2


def torsion_modes(beam: TorsionBeam, count: int) -> TorsionModes:
    """The lowest modes of the rotating blade; propeller and trapeze stiffness and the control spring included.

    Without rotation a uniform, clamped blade has the frequencies π(2n − 1)/2 √(GJ/I_θ)/L; rotation adds Ω² to the
    square of each.
    """
    stiffness, mass = _matrices(beam)
    held = math.isinf(beam.control_stiffness)
    matrices = [_dense(band)[1:, 1:] if held else _dense(band) for band in (stiffness, mass)]
    with one_blas_thread():
        squares, vectors = eigh(*matrices, subset_by_index=[0, count - 1])
    shape = np.pad(vectors.T, ((0, 0), (1, 0))) if held else vectors.T
    tip = shape[:, -1]
    return TorsionModes(
        beam.r, shape / tip[:, None], np.sqrt(np.maximum(squares, 0.0)), 1.0 / tip**2, beam.pull
    )


@bytes_cache
@read_only
def blade_modes(structure: BladeStructure, angular_speed: float, count: int) -> TorsionModes:
    """The modes of a blade at a rotor speed [rad/s], on its control system."""
    return torsion_modes(torsion_beam(structure, angular_speed, control=True), count)


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
    stiffness += beam.angular_speed**2 * mass
    if math.isfinite(beam.control_stiffness):
        stiffness[0, 0] += beam.control_stiffness
    return stiffness, mass


def _dense(banded: Array) -> Array:
    """The full matrix of a lower banded one."""
    diagonal, off = banded[0], banded[1, :-1]
    return np.diag(diagonal) + np.diag(off, 1) + np.diag(off, -1)
