"""The bending of the rotating blade in the trim: coupled flap-lag modes along the blade, harmonics around the disk.

    w = Σ_k W_k(r) q_k(ψ) + precone,    v = Σ_k V_k(r) q_k(ψ)

with modes at a pitch of reference (the built-in twist and a mean collective: what the pitch changes is computed at
every point, see `rotor.aero.bent_section`). One flap mode takes the place of rigid flapping: its harmonics 0 and 1 are
coning and first-harmonic flapping. Lengths are over R, forces in units of F = ρπR²(ΩR)²/N_b, one blade's share of C_T.

From L = ½ ∫ m (ẇ² + v̇² + (y0 + v)²) dr − ½ qᵀ K q − ∫ (w'² + v'²) ∫_r^R m v̇ dρ dr, in harmonics, with the air's loads,
the weight, springs and a damper at the hinges and the mass of the swept tip,

    m_k (q_k'' + ν_k² q_k) + Σ_l d_kl q_l' − (∫ E A_k dr)' + ∫ (G_w W_k' + G_v V_k' + M_w W_k'' + M_v V_k'') dr
        = ∫ (W_k F_z − V_k F_x) dr − g ∫ m W_k dr + y0 ∫ m V_k dr + Σ_j ∫ (w/r)(r W_k' + W_k d²/dψ²) Φ_j dr φ_j

with A_k = ∫_r^R m V_k dρ and y0 = e sin ζ, the distance of the steadily lagged blade's axis from the shaft. The third
term of L holds the Coriolis forces. y0 is solved for in the place of the lag mode's steady part: so all deflections
are those from the lagged blade, and small.

Left out: terms of third order in deflections, chordwise offsets of mass and tension, the drive train, and what the
tip's mass does to bending through pitch of the root.
"""

import math
from dataclasses import dataclass

import numpy as np

from rotor.aero.disk import Disk, element_edges
from rotor.aero.elastic import MODES as TORSION_MODES
from rotor.design.blade import Rotor
from rotor.design.twist import TwistLaw
from rotor.dynamics.bending import (
    BendingModes,
    bending_beam,
    bending_modes,
    blade_bending_modes,
    frequencies_by_kind,
)
from rotor.dynamics.torsion import blade_modes
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache
from rotor.support.units import GRAVITY

MODES = 4, 3
"""In flap and in lag: with the third lag mode, at 13.6/rev of the UH-60A, a blade can bend in flap about its own axes
where its pitch is not that of reference. With more, Fx and Fy at the hub change by less than 3 %, Fz by less than 6 %
(tested)."""
HARMONICS = 8
"""Highest harmonic of bending, and of the elastic twist with it."""
REFERENCE_COLLECTIVE = math.radians(8.0)
"""Pitch at 0.75 R of the modes. Our choice: loads do not depend on it but for the truncation (tested)."""
_STATIONS = 2001


@dataclass(frozen=True, eq=False)
class BladeBending:
    """Bending of one blade on its elements; inertia in units of F and R, angles in radians."""

    modes: BendingModes
    first: int
    """The mode in the place of rigid flapping."""
    lag: int
    """The lag mode of an articulated blade, which in its steady part is turned as a whole; −1 of a hingeless one."""
    frequency: Array
    """ν_k [per rev], (modes,)."""
    mass: Array
    """m_k, (modes,)."""
    shapes: Array
    """W_k, W_k', W_k'', V_k, V_k', V_k'', (6, modes, elements)."""
    outboard: Array
    """A_k, mean over each element, over all of the root in the first, (modes, elements)."""
    mass_outboard: Array
    """∫_r^R m dr in the same way, (elements,)."""
    damping: Array
    """d_kl, (modes, modes)."""
    load: Array
    """Modal loads of weight and, on a precone, of tension, (modes,)."""
    in_plane: Array
    """∫ m V_k dr, and of a spring at the lag hinge K_l V_k'/e, for y0 = e ζ, (modes,)."""
    precone: float
    """[rad]"""
    share: Array
    """See `BentData`, as the next two."""
    coupling: Array
    reference: Array
    r: Array
    """Stations of the integrals below, over R, (stations,)."""
    strips: Array
    """m dr there."""
    along: Array
    """Shapes there, (6, modes, stations)."""
    force: float
    """F [N]"""
    harmonics: int


@bytes_cache
@read_only
def build_bending(
    rotor: Rotor,
    disk: Disk,
    density: float,
    *,
    modes: tuple[int, int] = MODES,
    harmonics: int = HARMONICS,
    reference: float = REFERENCE_COLLECTIVE,
) -> BladeBending:
    """The bending of a rotor's blade, which must have the structure for it, in air of a density [kg/m³]."""
    blade, structure, radius, speed = (
        rotor.blade,
        rotor.blade.structure,
        rotor.radius,
        rotor.angular_speed,
    )
    assert structure is not None
    hingeless, root, springs = blade.hingeless, _root(rotor), _springs(rotor)
    stations = np.linspace(root, radius, 33)
    pitch = tuple((reference + rotor.builtin_twist(stations / radius)).tolist())
    blade_modes = blade_bending_modes(
        structure, speed, root, (tuple(stations.tolist()), pitch), modes, springs
    )
    force = density * math.pi * radius**2 * rotor.tip_speed**2 / rotor.blades
    scale, first = _scale(blade_modes, radius)
    lengths = np.array([1.0 / radius, 1.0, radius] * 2)[:, None, None] * scale[:, None]
    r = np.linspace(root, radius, _STATIONS)
    along, shapes = blade_modes.at(r) * lengths, blade_modes.at(disk.r * radius) * lengths
    widths = np.full(_STATIONS, (radius - root) / (_STATIONS - 1))
    widths[[0, -1]] *= 0.5
    strips = structure.at(r, structure.mass_per_length) * widths * (radius * speed**2 / force)
    frequency, precone = blade_modes.frequency / speed, blade.flap_rest
    mass = scale**2 * (speed**2 / force / radius)
    tension = np.interp(r, blade_modes.beam.r, blade_modes.beam.tension) * widths / (force * radius)
    load = -GRAVITY / (radius * speed**2) * (along[0] @ strips) - precone * (along[1] @ tension)
    load[first] += precone * mass[first] * frequency[first] ** 2
    slope = blade_modes.nodal[:, 0, 3] * scale  # At the root, 0 where it is held.
    lag, flap = (
        structure.at(disk.r * radius, ei)
        for ei in (structure.lag_stiffness, structure.flap_stiffness)
    )
    edges = element_edges(disk.dr) * radius
    outboard = _beyond(
        np.concatenate([strips * along[3], strips[None]]), along[1, first] ** 2 * widths, r, edges
    )
    inboard = widths * (r < edges[0]), edges[1] - edges[0]
    bent = along[[2, 5]].reshape(-1, _STATIONS), shapes[[2, 5]].reshape(-1, len(disk.r))
    turned = 2.0 * (reference + rotor.builtin_twist(disk.r))
    return BladeBending(
        modes=blade_modes,
        first=first,
        lag=-1 if hingeless else int(np.argmin(blade_modes.flap_share[:2])),
        frequency=frequency,
        mass=mass,
        shapes=shapes,
        outboard=outboard[:-1],
        mass_outboard=outboard[-1],
        damping=np.outer(slope, slope) * (structure.lag_damper * speed / (force * radius)),
        load=load,
        in_plane=along[3] @ strips + (0.0 if hingeless else springs[1] / (force * root) * slope),
        precone=precone,
        share=_with_root(along[1, [first]], shapes[1, [first]], *inboard),
        coupling=0.5 * (lag - flap) / (force * radius**2) * _with_root(*bent, *inboard),
        reference=np.stack([np.cos(turned), np.sin(turned)]),
        r=r / radius,
        strips=strips,
        along=along,
        force=force,
        harmonics=harmonics,
    )


def _scale(modes: BendingModes, radius: float) -> tuple[Array, int]:
    """By which modes of one unit of modal mass are multiplied, so that they move the tip by R, and the flap mode in the
    place of rigid flapping, which moves it by R less the hinge; and its number."""
    tip = modes.at([radius])[:, :, 0]
    first = int(np.flatnonzero(modes.flap_share > 0.5)[0])
    scale = (
        radius
        / np.take_along_axis(tip[[0, 3]], np.argmax(np.abs(tip[[0, 3]]), axis=0)[None], axis=0)[0]
    )
    scale[first] = (radius - modes.beam.nodes[0]) / tip[0, first]
    return scale, first


def _beyond(strips: Array, weights: Array, r: Array, edges: Array) -> Array:
    """Sums of strips outboard, mean over each element by weights, over all of the root too in the first.

    strips: (rows, stations), weights: (stations,) → (rows, elements). Elements between stations are interpolated.
    """
    sums = np.cumsum(strips[:, ::-1], axis=1)[:, ::-1] - 0.5 * strips
    count = len(edges) - 1
    cell = np.clip(np.searchsorted(edges, r, side="right") - 1, 0, count - 1)
    inside = np.bincount(cell, weights, count)
    means = np.stack([np.bincount(cell, row * weights, count) for row in sums]) / np.where(
        inside, inside, 1.0
    )
    middle = 0.5 * (edges[1:] + edges[:-1])
    between: list[Array] = [np.interp(middle, r, row) for row in sums]
    return np.where(inside, means, np.stack(between))


def _with_root(along: Array, shapes: Array, inboard: Array, width: float) -> Array:
    """1, and at the first element by how much more it weighs as it stands for the blade inboard of it, in squares.

    along: (shapes, stations), shapes: (shapes, elements); inboard: widths of the stations there, 0 elsewhere.
    """
    out = np.ones(shapes.shape[1])
    out[0] += float((along**2).sum(axis=0) @ inboard) / (float((shapes[:, 0] ** 2).sum()) * width)
    return out


@dataclass(frozen=True)
class BladeFrequencies:
    """Natural frequencies of the rotating blade [per rev], by the kind of motion that dominates."""

    flap: tuple[float, ...]
    lag: tuple[float, ...]
    torsion: tuple[float, ...]


def blade_frequencies(rotor: Rotor, twist: TwistLaw, collective: float) -> BladeFrequencies | None:
    """Frequencies of the blade at a twist and a collective [rad]; None where its stiffness in bending is not known."""
    structure = rotor.blade.structure
    if structure is None or not structure.bends:
        return None

    def pitch(r: Array) -> Array:
        return collective + twist(r / rotor.radius)

    beam = bending_beam(structure, rotor.angular_speed, _root(rotor), pitch, _springs(rotor))
    flap, lag = frequencies_by_kind(bending_modes(beam, sum(MODES)))
    torsion = (
        blade_modes(structure, rotor.angular_speed, TORSION_MODES).frequency / rotor.angular_speed
    )
    return BladeFrequencies(tuple(flap), tuple(lag), tuple(torsion.tolist()))


def can_bend(rotor: Rotor) -> bool:
    """Whether the stiffness of the blade is known, and its root: held, or with its hinges away from the shaft."""
    structure = rotor.blade.structure
    return (
        structure is not None
        and structure.bends
        and (rotor.blade.hingeless or rotor.blade.flap_hinge > 0.0)
    )


def _springs(rotor: Rotor) -> tuple[float, float]:
    """Root springs of a bending blade, flap and lag [N m/rad]. That of a hingeless blade in flap is in its EI."""
    blade, structure = rotor.blade, rotor.blade.structure
    assert structure is not None
    held = math.inf if blade.hingeless else 0.0
    return held or blade.flap_spring, held if structure.lag_spring is None else structure.lag_spring


def _root(rotor: Rotor) -> float:
    """Where the bending blade begins [m]."""
    structure = rotor.blade.structure
    assert structure is not None
    return structure.clamp if rotor.blade.hingeless else rotor.blade.flap_hinge * rotor.radius
