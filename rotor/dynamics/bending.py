"""Coupled flap-lag bending modes of a rotating, pretwisted blade.

With w up and v forward, normal to a straight blade axis that turns about the shaft, the pitch θ(r) of the section, and
the tension T(r) = Ω² ∫_r^R m ρ dρ,

    ½ ∫ [EI_f (w'' cos θ − v'' sin θ)² + EI_l (v'' cos θ + w'' sin θ)² + T (w'² + v'²) − m Ω² v²] dr  =  ½ qᵀ K q
    ½ ∫ m (ẇ² + v̇²) dr                                                                              =  ½ q̇ᵀ M q̇

Source: Houbolt & Brooks, NACA TR 1346 (1958), without torsion, chordwise offsets of mass and tension. At an articulated
root w = v = 0 and the slopes are free, or held by springs, ½ (K_f w'² + K_l v'²) more; at a hingeless one they vanish.
The axis is that of the steadily lagged blade: a hinge at e holds it at a distance y0 = e sin ζ from the shaft, which
shortens the arm r by e (1 − cos ζ) only.

Finite elements with cubic (Hermite) polynomials; integrals by Gauss' rule.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import eigh

from rotor.design.blade import BladeStructure
from rotor.support.arrays import Array, Integers, read_only
from rotor.support.bytes_cache import bytes_cache

ELEMENTS = 40
_PLACES, _SHARES = np.polynomial.legendre.leggauss(4)

Pitch = Callable[[Array], Array]
"""θ at radii r [m] → [rad]."""


@dataclass(frozen=True, eq=False)
class BendingBeam:
    """A blade in bending on Gauss points; arrays are (points,), four to an element."""

    nodes: Array
    """[m], (elements + 1,), the first at the hinge, or where the blade is held."""
    r: Array
    """[m]"""
    weight: Array
    """Weights of the points in an integral along the blade [m]."""
    mass: Array
    """[kg/m]"""
    tension: Array
    """[N]"""
    flap_stiffness: Array
    """EI [N m²]"""
    lag_stiffness: Array
    pitch: Array
    """[rad]"""
    angular_speed: float
    """[rad/s]"""
    springs: tuple[float, float]
    """Stiffness of the root against slopes in flap and lag [N m/rad]: 0 of a hinge, infinite where they are held."""


def bending_beam(
    structure: BladeStructure,
    angular_speed: float,
    root: float,
    pitch: Pitch,
    springs: tuple[float, float],
) -> BendingBeam:
    """The blade from its hinge, or from where it is held, at `root` [m]; springs: see `BendingBeam`.

    ValueError for a structure without stiffness in flap and lag.
    """
    if not structure.bends:
        raise ValueError(
            "the blade structure has no bending stiffness: give flap_stiffness_nm2 and lag_stiffness_nm2"
        )
    nodes = np.linspace(root, structure.radius, ELEMENTS + 1)
    half = 0.5 * np.diff(nodes)
    r = (nodes[:-1, None] + half[:, None] * (1.0 + _PLACES)).ravel()
    weight, mass = (half[:, None] * _SHARES).ravel(), structure.at(r, structure.mass_per_length)
    tension = structure.centrifugal_force(r, angular_speed, steps=4000)
    flap, lag = structure.at(r, structure.flap_stiffness), structure.at(r, structure.lag_stiffness)
    return BendingBeam(nodes, r, weight, mass, tension, flap, lag, pitch(r), angular_speed, springs)


def _polynomials(nodes: Array, r: Array) -> tuple[Integers, Array]:
    """Number of the element of each station, and its four polynomials with two derivatives, (stations, 3, 4)."""
    element = np.clip(np.searchsorted(nodes, r, side="right") - 1, 0, len(nodes) - 2).astype(
        np.int64
    )
    o = np.diff(nodes)[element]
    s = (r - nodes[element]) / o
    values = [
        1 - 3 * s**2 + 2 * s**3,
        o * (s - 2 * s**2 + s**3),
        3 * s**2 - 2 * s**3,
        o * (s**3 - s**2),
    ]
    slopes = [
        (6 * s**2 - 6 * s) / o,
        1 - 4 * s + 3 * s**2,
        (6 * s - 6 * s**2) / o,
        3 * s**2 - 2 * s,
    ]
    curvatures = [(12 * s - 6) / o**2, (6 * s - 4) / o, (6 - 12 * s) / o**2, (6 * s - 2) / o]
    return element, np.stack(
        [np.stack(polynomials, axis=-1) for polynomials in (values, slopes, curvatures)], axis=1
    )


@dataclass(frozen=True, eq=False)
class BendingModes:
    """The lowest natural modes in bending."""

    beam: BendingBeam
    frequency: Array
    """[rad/s], (modes,)."""
    nodal: Array
    """w, w', v, v' at the nodes, (modes, nodes, 4)."""

    def at(self, r: ArrayLike) -> Array:
        """w, w', w'', v, v', v'' at r [m], (6, modes, stations); zero inboard of the root."""
        radii = np.asarray(r, dtype=float)
        element, basis = _polynomials(self.beam.nodes, radii)
        ends = np.concatenate([np.take(self.nodal, element + k, axis=1) for k in range(2)], axis=2)
        # Of both ends, (modes, stations, 4) each.
        flap, lag = (
            ends[:, :, [0, 1, 4, 5]],
            ends[:, :, [2, 3, 6, 7]],
        )
        out = np.stack(
            [
                np.einsum("kn,mkn->mk", basis[:, d], ends_of)
                for ends_of in (flap, lag)
                for d in range(3)
            ]
        )
        return out * (radii >= self.beam.nodes[0])

    @property
    def flap_share(self) -> Array:
        """Part of the modal mass ∫ m (w² + v²) dr that moves in flap, (modes,)."""
        flap, lag = self.at(self.beam.r)[[0, 3]] ** 2 @ (self.beam.mass * self.beam.weight)
        return flap / (flap + lag)


def bending_modes(beam: BendingBeam, count: int) -> BendingModes:
    """The modes of lowest frequency, each with one unit of modal mass."""
    mass, stiffness = _matrices(beam)
    size = len(mass)
    fixed = [
        0,
        2,
        *(slope for slope, spring in zip((1, 3), beam.springs, strict=True) if math.isinf(spring)),
    ]
    free = np.setdiff1d(np.arange(size), fixed)
    squares, vectors = eigh(
        stiffness[np.ix_(free, free)],
        mass[np.ix_(free, free)],
        subset_by_index=[0, count - 1],
        driver="gvx",
    )
    nodal = np.zeros((count, size))
    nodal[:, free] = vectors.T
    return BendingModes(beam, np.sqrt(np.maximum(squares, 0.0)), nodal.reshape(count, -1, 4))


def _matrices(beam: BendingBeam) -> tuple[Array, Array]:
    """M and K, (4 nodes, 4 nodes) both; unknowns w, w', v, v' at each node."""
    element, basis = _polynomials(beam.nodes, beam.r)
    value, slope, curvature = (np.einsum("ka,kb->kab", basis[:, d], basis[:, d]) for d in range(3))
    cos, sin, flap, lag = (
        np.cos(beam.pitch),
        np.sin(beam.pitch),
        beam.flap_stiffness,
        beam.lag_stiffness,
    )
    up = flap * cos**2 + lag * sin**2
    forward, both = lag * cos**2 + flap * sin**2, (lag - flap) * sin * cos
    size = 4 * len(beam.nodes)
    mass, stiffness = np.zeros((size, size)), np.zeros((size, size))

    def add(
        matrix: Array,
        by_value: Array,
        by_slope: Array,
        by_curvature: Array,
        rows: int,
        columns: int,
    ) -> None:
        parts = (by_value, value), (by_slope, slope), (by_curvature, curvature)
        blocks = sum((beam.weight * factor)[:, None, None] * product for factor, product in parts)
        first = 4 * element[:, None] + np.array([0, 1, 4, 5])
        np.add.at(matrix, ((first + rows)[:, :, None], (first + columns)[:, None, :]), blocks)

    none = np.zeros_like(beam.r)
    for row in (0, 2):
        add(mass, beam.mass, none, none, row, row)
    add(stiffness, none, beam.tension, up, 0, 0)
    add(stiffness, -(beam.angular_speed**2) * beam.mass, beam.tension, forward, 2, 2)
    add(stiffness, none, none, both, 0, 2)
    add(stiffness, none, none, both, 2, 0)
    for slope, spring in zip((1, 3), beam.springs, strict=True):
        stiffness[slope, slope] += spring if math.isfinite(spring) else 0.0
    return mass, stiffness


@bytes_cache
@read_only
def blade_bending_modes(
    structure: BladeStructure,
    angular_speed: float,
    root: float,
    pitch: tuple[tuple[float, ...], ...],
    count: tuple[int, int],
    springs: tuple[float, float],
) -> BendingModes:
    """The modes of a blade whose pitch [rad] is linear between stations [m], (stations, angles).

    count: how many of those that move more in flap, and in lag.
    """
    stations, angles = (np.array(values) for values in pitch)

    def at(r: Array) -> Array:
        return np.interp(r, stations, angles)

    beam = bending_beam(structure, angular_speed, root, at, springs)
    modes = bending_modes(beam, 4 * max(count))
    flaps = modes.flap_share > 0.5
    chosen = np.sort(
        np.concatenate([np.flatnonzero(flaps)[: count[0]], np.flatnonzero(~flaps)[: count[1]]])
    )
    return BendingModes(modes.beam, modes.frequency[chosen], modes.nodal[chosen])


def frequencies_by_kind(modes: BendingModes) -> tuple[list[float], list[float]]:
    """Frequencies [per rev] of the modes that move more in flap, and of those that move more in lag."""
    per_rev, flaps = modes.frequency / modes.beam.angular_speed, modes.flap_share > 0.5
    return per_rev[flaps].tolist(), per_rev[~flaps].tolist()
