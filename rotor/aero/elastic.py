"""The elastic twist of the rotating blade in the trim: modes along the blade, harmonics around the disk.

The blade twists by φ(r, ψ) = Σ_k Φ_k(r) q_k(ψ), with the lowest rotating torsion modes Φ_k and q_k a Fourier series.
With the pitch θ = θ_jig + θ_control + φ (and active twist), θ_control with its n/rev root pitch, and the modal
frequencies ν_k [per rev],

    m_k (q_k'' + ν_k² q_k) = ∫ Φ_k [ dC_M/dr − j (θ_rigid'' + ½ sin 2θ − φ) + w β0 ] dr
                             − ∫ Φ_k' F_c k_A² (θ_jig + θ_act)' dr

in units of ρπR⁵Ω²/N_b, with j the torsional inertia, θ_rigid the pitch without φ, and w the mass of the swept tip
times its offset and its radius: the centrifugal force of the coned mass behind the axis lifts the nose. The propeller
moment is kept with its sine; ν_k² holds its linear part, hence + φ. Tension unwinds a twisted blade (last term).
dC_M/dr is the moment of the air, see `rotor.aero.section`. Active twist θ_act is what the actuator makes of a blade at
rest: its moment is GJ θ_act', and φ is the rest of the answer. Source: Houbolt & Brooks, NACA TR 1346 (1958), without
bending.

Left out: coupling with bending in flap and lag, the reaction of the swept tip's mass on flapping (0.3 % of the flap
moment), and that of first-harmonic flapping on it, which is zero for a hinge at the shaft.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from rotor.aero.disk import Disk
from rotor.airfoil.c81 import C81Block
from rotor.airfoil.section_table import (
    N_ALPHA,
    N_MACH,
    SectionTable,
    bicubic_coefficients,
    mach_nodes,
)
from rotor.airfoil.sections import Section
from rotor.design.active_twist import HIGHEST
from rotor.design.blade import Rotor
from rotor.dynamics.torsion import TorsionModes, blade_modes
from rotor.engine.waves import wave_grid
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache

MODES = 2
"""Torsion modes of the trim: power within 0.03 % and the mean twist of the tip within 0.03° of six modes (tested)."""
HARMONICS = HIGHEST
"""Highest harmonic of the elastic twist: that which active twist or root pitch may have, so that power with it begins
at that without. From 4 on power moves by less than 0.05 %."""


@dataclass(frozen=True, eq=False)
class BladeTorsion:
    """Torsion of one blade on its elements; moments in units of ρπR⁵Ω²/N_b, per unit of r where distributed."""

    modes: TorsionModes
    frequency: Array
    """ν_k [per rev], (modes,)."""
    radial: Array
    """Φ_k, (modes, elements)."""
    dr: Array
    """Element widths over R, (elements,)."""
    functions: int
    """Number of waves 1, cos ψ, sin ψ, … of the elastic twist."""
    gain: Array
    """1/(m_k ν_k²): modal moment to radians, (modes,)."""
    dynamic: Array
    """1 − (h/ν_k)², (modes, functions)."""
    inertia: Array
    """j of each element, the root inboard of the lifting blade with the first, (elements,)."""
    coupling: Array
    """∫ Φ_k j Φ_l dr, (modes, modes)."""
    tension: Array
    """∫ Φ_k' F_c k_A² θ' dr of a twist given at the elements, (modes, elements)."""
    own_tension: Array
    """Tension on a twist, with another twist in the place of Φ_k, (elements, elements)."""
    moment_gain: Array
    """½σ c/R, (elements,)."""
    damping: Array
    """N_b (c/R)³/8, (elements,)."""
    lag: Array
    """Offset of the swept quarter chord behind the pitch axis, over R, (elements,)."""
    tip_mass: Array
    """w, (elements,)."""
    moment_tables: Array
    """C_m, (sections, α cells, Mach cells, 1, 4, 4)."""
    moment_unit: float
    """ρπR⁵Ω²/N_b [N m]."""

    def modal(self, along: Array) -> Array:
        """∫ Φ_k f dr of a distribution, (elements,) → (modes,)."""
        return self.radial * self.dr @ along

    def harmonics(self, around: Array) -> Array:
        """Amplitudes 1, cos ψ, sin ψ, … of functions of azimuth, (…, azimuths) → (…, functions)."""
        means = around @ wave_grid(self.functions, around.shape[-1]).mean
        means[..., 1:] *= 2.0
        return means


REVERSE_FLOW_DEG = (165.0, 172.0)
"""Angles of attack over which the moment passes from that of the section data to that of attached reverse flow."""


@bytes_cache
@read_only
def moment_table(table: SectionTable, only_mach: float | None) -> Array:
    """C_m of a section about the quarter chord, (α cells, Mach cells, 4, 4); zero where its source has none.

    Near ±180° the air attaches to the trailing edge first and its force acts at the three-quarter chord, half a chord
    behind the axis: C_m = −½ C_n (thin-airfoil theory). Section data rarely resolve that.
    """
    if table.moment_coefficients is None:
        return np.zeros((N_ALPHA, N_MACH, 4, 4))
    held = table if only_mach is None else table.held_at(only_mach)
    assert held.moment_coefficients is not None
    degrees, mach = np.linspace(-180.0, 0.5 * N_ALPHA - 180.0, N_ALPHA + 1), mach_nodes()
    alpha = np.deg2rad(degrees)[:, None]
    flow, moment = held(alpha, mach), held.moment(alpha, mach)
    assert moment is not None
    start, end = REVERSE_FLOW_DEG
    t = np.clip((np.abs(degrees) - start) / (end - start), 0.0, 1.0)[:, None]
    share = t * t * (3.0 - 2.0 * t)
    reversed_flow = -0.5 * (flow.cl * np.cos(alpha) + flow.cd * np.sin(alpha))
    ends = C81Block(mach, degrees, (1.0 - share) * moment + share * reversed_flow)
    cells = np.abs(degrees[:-1] + 0.25) > start
    out = held.moment_coefficients.copy()
    out[cells] = bicubic_coefficients(ends)[cells]
    return out


@bytes_cache
@read_only
def _moment_tables(sections: tuple[Section, ...], only_mach: float | None) -> Array:
    """`BladeTorsion.moment_tables`; kept apart from the blades, which share them."""
    return np.stack([moment_table(item.table, only_mach) for item in sections])[:, :, :, None]


@bytes_cache
@read_only
def build_torsion(
    rotor: Rotor,
    disk: Disk,
    density: float,
    *,
    only_mach: float | None,
    swept: bool,
    highest: int,
    count: int = MODES,
) -> BladeTorsion:
    """The torsion of the rotor's blade, which must have a structure, on a grid in air of a density [kg/m³].

    highest: harmonic; count: modes.
    """
    torsion = _at_unit_density(
        rotor, disk, only_mach=only_mach, swept=swept, highest=highest, count=count
    )
    lighter = ("inertia", "coupling", "tension", "own_tension", "tip_mass")
    scaled = {name: getattr(torsion, name) / density for name in lighter}
    return replace(
        torsion, **scaled, gain=torsion.gain * density, moment_unit=torsion.moment_unit * density
    )


@bytes_cache
def _at_unit_density(
    rotor: Rotor, disk: Disk, *, only_mach: float | None, swept: bool, highest: int, count: int
) -> BladeTorsion:
    """Torsion of the blade in air of 1 kg/m³; modes and tables take most of the time."""
    blade, structure, radius = rotor.blade, rotor.blade.structure, rotor.radius
    assert structure is not None
    modes = blade_modes(structure, rotor.angular_speed, count)
    radial, functions = modes.at(disk.r * radius), 1 + 2 * highest
    harmonic = (np.arange(functions) + 1) // 2
    unit = math.pi * radius**5 / rotor.blades  # Times Ω² [N m].
    frequency = modes.frequency / rotor.angular_speed
    inertia = structure.at(disk.r * radius, structure.torsional_inertia) * radius / unit
    root = 0.5 * (structure.clamp / radius + disk.root)
    inner = float(structure.at(root * radius, structure.torsional_inertia)) * (
        disk.root * radius - structure.clamp
    )
    inertia[0] += max(inner, 0.0) / (unit * disk.dr[0])
    chord = disk.half_solidity * 2.0 * math.pi / rotor.blades
    behind = np.maximum(disk.r - blade.tip_sweep_start, 0.0) * (
        math.tan(blade.tip_sweep) if swept else 0.0
    )
    mass = structure.at(disk.r * radius, structure.mass_per_length)
    tension, own_tension = _tension(modes, disk, radius)
    return BladeTorsion(
        modes=modes,
        frequency=frequency,
        radial=radial,
        dr=disk.dr,
        functions=functions,
        gain=unit / (modes.inertia * frequency**2),
        dynamic=1.0 - (harmonic / frequency[:, None]) ** 2,
        inertia=inertia,
        coupling=radial * (inertia * disk.dr) @ radial.T,
        tension=tension / (unit * rotor.angular_speed**2),
        own_tension=own_tension / (unit * rotor.angular_speed**2),
        moment_gain=disk.half_solidity * chord,
        damping=rotor.blades * chord**3 / 8.0,
        lag=behind,
        tip_mass=mass * behind * disk.r * radius**3 / unit,
        moment_tables=_moment_tables(disk.sections, only_mach),
        moment_unit=unit * rotor.angular_speed**2,
    )


def _tension(modes: TorsionModes, disk: Disk, radius: float) -> tuple[Array, Array]:
    """∫ Φ' F_c k_A² θ' dr [N m/rad] for θ linear between element centres and constant beyond."""
    length = np.diff(modes.r)
    hats = np.stack([np.interp(modes.r, disk.r * radius, unit) for unit in np.eye(len(disk.r))])
    hat_slopes, mode_slopes = np.diff(hats) / length, np.diff(modes.shape) / length
    weight = modes.pull * length
    return mode_slopes * weight @ hat_slopes.T, hat_slopes * weight @ hat_slopes.T
