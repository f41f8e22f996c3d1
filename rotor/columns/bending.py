"""Bending of the blade as columns and equations; symbols as in `rotor.aero.bending` and `rotor.aero.bent_section`.

For every mode k and wave h, with f = 1 (h = 0) or 2 and g_k an inverse stiffness,

    g_k [m_k (ν_k² − h²) q_kh + Σ_l d_kl (q_l')_h
         + f · mean of w_h' E A_k + w_h (G_w W_k' + G_v V_k' + M_w W_k'' + M_v V_k'')]
      = g_k [f · mean of w_h (W_k F_z − V_k F_x) + load_k (h = 0) + Σ_j c_jk φ_jh]

Loads of the blades on the hub at N_b per revolution in axes that do not turn, as terms of the trim's equations.

x aft, y to starboard, z up. Each blade leaves on the hub its air loads less mass times acceleration. With the static
moments of the displaced blade X = ∫ m u dr, Y = ∫ m v dr, Z = ∫ m w dr, u = −½ ∫ (w'² + v'²) dr, and f_z = Σ F_z − Z'',

    F_x: F_r cos ψ + F_x sin ψ − (X cos ψ − Y sin ψ)''        M_x: m_f sin ψ + y0 f_z cos ψ
    F_y: F_r sin ψ − F_x cos ψ − (X sin ψ + Y cos ψ)''        M_y: −m_f cos ψ + y0 f_z sin ψ

m_f is e f_z at a hinge without a spring, which has no moment, and Σ r F_z − ∫ m r (w'' + w) dr at any other root.
The moment about the blade's axis goes into its pitch link and the swashplate, and is not among these. Summed over the
blades only multiples of N_b remain, N_b times those of one blade.
"""

from collections.abc import Hashable
from typing import cast

import numpy as np

from rotor.aero.bending import HARMONICS, BladeBending
from rotor.aero.bent_section import BENDING, GV, GW, KV, KW, MV, MW, SLOPES, SV, SW, B, E
from rotor.aero.problem import Problem
from rotor.aero.section import FR, FX, FZ, UP, UR, UT
from rotor.columns.blade import Freedom, Torsion
from rotor.engine.terms import ONE, Shape, Structure, Terms
from rotor.engine.waves import COS, SIN, STEADY, harmonic_of, rate_of, times_wave, wave_number
from rotor.support.arrays import Array

FLAPPING_STATES = ("coning", "flap_1c", "flap_1s")
"""What the first flap mode's coordinates of the waves 1, cos ψ and sin ψ are called."""
OFFSET: Hashable = ("bend", "offset")
"""y0 over R: how far the axis of the steadily lagged blade lies forward of the shaft, in the place of the steady
coordinate of the lag mode of an articulated blade."""


def bends(s: Structure) -> bool:
    """Whether a structure has bending."""
    return ("bend", 0, 1) in s.states or ("bend", 1, 1) in s.states


def coordinate(s: Structure, first: int, k: int, h: int) -> int:
    """The atom of q_kh."""
    return (
        s.states[FLAPPING_STATES[h]]
        if k == first and h < len(FLAPPING_STATES)
        else s.states["bend", k, h]
    )


def coordinates_of(b: BladeBending, s: Structure, z: Array) -> tuple[Array, float]:
    """q_kh of the states at z, (modes, functions), and y0 over R."""
    places = _all(s)
    q = np.zeros((len(b.mass), 1 + max(h for _, h, _ in places)))
    for k, h, atom in places:
        q[k, h] = z[atom]
    return q, float(z[s.states[OFFSET]]) if OFFSET in s.states else 0.0


def _all(s: Structure) -> list[tuple[int, int, int]]:
    """Mode, wave and atom of all coordinates."""
    coordinates = list[tuple[int, int, int]]()
    for name, atom in s.states.items():
        if isinstance(name, tuple) and name != OFFSET:
            kind, k, h = cast(tuple[str, int, int], name)
            if kind == "bend":
                coordinates.append((k, h, atom))
    present = {(k, h) for k, h, _ in coordinates}
    first = next(k for k, _, _ in coordinates if (k, 1) not in present)
    return [(first, h, s.states[name]) for h, name in enumerate(FLAPPING_STATES)] + coordinates


class Bending(Freedom):
    """The modal coordinates in flap and lag."""

    def __init__(self, problem: Problem) -> None:
        b, torsion = problem.bending, problem.torsion
        assert b is not None
        self.modes, self.first, self.lag, self.functions = (
            len(b.mass),
            b.first,
            b.lag,
            1 + 2 * b.harmonics,
        )
        self.twists = 0 if torsion is None else len(torsion.gain)
        self._hub = problem.design.rotor.blades, b.modes.beam.springs[0] > 0.0
        self.states = tuple(
            OFFSET if (k, h) == (self.lag, STEADY) else ("bend", k, h)
            for k in range(self.modes)
            for h in range(self.functions)
            if k != self.first
            or h >= len(FLAPPING_STATES)  # Coning and first-harmonic flapping are the trim's.
        )

    def numbers(self, problem: Problem) -> dict[Hashable, float]:
        """Numbers of the equations in the head of this file."""
        b, torsion = problem.bending, problem.torsion
        assert b is not None
        highest = harmonic_of(self.functions - 1)
        harmonic = np.arange(highest + 1)
        stiffness = b.mass[:, None] * (b.frequency[:, None] ** 2 - harmonic**2)
        gain = 1.0 / np.maximum(np.abs(stiffness), (b.mass * b.frequency**2)[:, None])
        out: dict[Hashable, float] = {"precone": b.precone}
        if self.lag >= 0:
            out["steady lag"] = float(gain[self.lag, 0]) / (1.0 - float(b.r[0]))
        load, in_plane = gain[:, 0] * b.load, gain[:, 0] * b.in_plane
        damping = gain[:, None, :] * b.damping[:, :, None] * harmonic
        if torsion is not None:
            weight = torsion.radial * (torsion.tip_mass * torsion.dr)
            by_slope, by_acceleration = (
                weight @ b.shapes[1].T,
                weight / problem.disk.r @ b.shapes[0].T,
            )
            # (twists, modes, harmonics)
            tip = by_slope[..., None] - by_acceleration[..., None] * harmonic**2
        else:
            tip = np.zeros((0, self.modes, highest + 1))
        for k in range(self.modes):
            out |= {("bend load", k): float(load[k]), ("in plane", k): float(in_plane[k])}
            for h in range(highest + 1):
                out["bend stiffness", k, h] = float(stiffness[k, h] * gain[k, h])
                out["bend gain", k, h] = float(gain[k, h]) * (2.0 if h else 1.0)
                for j in range(self.twists):
                    out["tip on bending", j, k, h] = float(tip[j, k, h] * gain[k, h])
                    assert torsion is not None
                    out["tip on torsion", j, k, h] = float(tip[j, k, h] * torsion.gain[j])
                for other in range(self.modes) if h else ():
                    out["bend damping", k, other, h] = float(damping[k, other, h])
        return out

    def build(self, s: Structure) -> None:
        """Columns of slopes, curvatures and velocities; equations of bending, and what they add to those of torsion."""
        n, slot = s.numbers, {channel: s.channels + channel for channel in SLOPES}
        for channel, name in ((SW, "W'"), (SV, "V'"), (KW, "W''"), (KV, "V''")):
            s.column(slot[channel], ("precone", name), STEADY, 1.0, n["precone"])
        s.column(UR, ("precone", "V"), STEADY, 1.0, n["precone"])
        for k in range(self.modes):
            for h in range(self.functions):
                if k == self.lag and h == STEADY:
                    s.column(UR, "one", STEADY, 1.0, s.states[OFFSET])
                    continue
                place = coordinate(s, self.first, k, h)
                rate, factor = rate_of(h)
                s.column(UP, ("W", k), rate, factor, place)
                s.column(UT, ("V", k), rate, factor, place)
                s.column(UR, ("V", k), h, 1.0, place)
                s.column(slot[B], ("outboard", k), rate, factor, place)
                for channel, name in ((SW, "W'"), (SV, "V'"), (KW, "W''"), (KV, "V''")):
                    s.column(slot[channel], (name, k), h, 1.0, place)
        for k in range(self.modes):
            for h in range(self.functions):
                self._balance(s, k, h)
        if has_hub_loads(self._hub[0], harmonic_of(self.functions - 1)):
            HubLoadTerms(s, *self._hub)  # Adds its measures to the structure.

    def _balance(self, s: Structure, k: int, h: int) -> None:
        """The equation of one mode and one wave."""
        n, row, harmonic = s.numbers, s.equation(("bend", k, h)), harmonic_of(h)
        slot = {force: s.forces + force for force in BENDING}
        gain = n["bend gain", k, harmonic]
        steady_lag = k == self.lag and h == STEADY
        if not steady_lag:
            s.term(row, 1.0, n["bend stiffness", k, harmonic], coordinate(s, self.first, k, h))
        for sign, force, shape in (
            (-1.0, FZ, ("W", k)),
            (1.0, FX, ("V", k)),
            (1.0, slot[GW], ("W'", k)),
            (1.0, slot[GV], ("V'", k)),
            (1.0, slot[MW], ("W''", k)),
            (1.0, slot[MV], ("V''", k)),
        ):
            s.term(row, sign, gain, q=s.measure(force, shape, h))
        if h == STEADY:
            s.term(row, -1.0, n["bend load", k])
            if OFFSET in s.states:
                s.term(row, -1.0, n["in plane", k], s.states[OFFSET])
            # The shortened blade's mass is nearer to the shaft: −½ y0 ∫ E ∫_r^R m dρ dr.
            if steady_lag:
                shortened = s.measure(slot[E], OUTBOARD, STEADY)
                s.term(row, 0.5, n["steady lag"], s.states[OFFSET], shortened)
        else:
            partner, factor = rate_of(h)
            s.term(row, factor, gain, q=s.measure(slot[E], ("outboard", k), partner))
            # (q')_h = −factor/h · h q_partner: the rate of the partner is this wave.
            for other in range(self.modes):
                sign = -factor / harmonic
                s.term(
                    row,
                    sign,
                    n["bend damping", k, other, harmonic],
                    coordinate(s, self.first, other, partner),
                )
        for j in range(self.twists):
            twist = s.states["twist", j, h]
            s.term(row, -1.0, n["tip on bending", j, k, harmonic], twist)
            if not steady_lag:
                place = coordinate(s, self.first, k, h)
                s.term(s.equations["twist", j, h], -1.0, n["tip on torsion", j, k, harmonic], place)

    def shapes(self, problem: Problem) -> dict[Shape, Array]:
        """Shapes of modes and precone."""
        b = problem.bending
        assert b is not None
        out: dict[Shape, Array] = {OUTBOARD: b.mass_outboard}
        names = ("W", "W'", "W''", "V", "V'", "V''")
        # The rigid cone, in place of that of the mode.
        for name, slope in zip(names, b.shapes[:, b.first], strict=True):
            out["precone", name] = (1.0 if name == "W'" else 0.0) - slope
        for k in range(self.modes):
            out["outboard", k] = b.outboard[k]
            for name, slope in zip(names, b.shapes[:, k], strict=True):
                out[name, k] = slope
        return out


def freedoms_of(problem: Problem, functions: int | None = None) -> tuple[Freedom, ...]:
    """Torsion and bending of a design; functions: waves of the elastic twist, by default those of its torsion."""
    torsion, bending = problem.torsion, problem.bending
    freedoms = list[Freedom]()
    if torsion is not None:
        freedoms.append(
            Torsion(len(torsion.gain), functions or torsion.functions, bends=bending is not None)
        )
    if bending is not None:
        freedoms.append(Bending(problem))
    return tuple(freedoms)


LOADS = ("fx", "fy", "fz", "mx", "my")
"""Each with its cosine and its sine at N_b ψ."""
OUTBOARD = "mass outboard"
"""∫_r^R m dr, by which E has X."""


def has_hub_loads(blades: int, harmonics: int = HARMONICS) -> bool:
    """Whether the harmonics of bending reach those that N_b/rev at the hub comes from."""
    return blades + 1 <= harmonics


class HubLoadTerms:
    """The terms of a blade; or only their measures, which a structure needs before it is finished."""

    def __init__(
        self, s: Structure, blades: int, sprung: bool, bending: BladeBending | None = None
    ) -> None:
        self._s, self._blades, self._sprung, self._bending = s, blades, sprung, bending
        self.rows = list[tuple[int, int, int, int, float]]()
        for row in range(2 * len(LOADS)):
            wave = wave_number(blades, sine=row % 2 == 1)
            load = LOADS[row // 2]
            if load == "fz":
                self._vertical(row, wave, STEADY, 1.0)
            elif load in ("fx", "fy"):
                along, across, sign = (COS, SIN, 1.0) if load == "fx" else (SIN, COS, -1.0)
                self._in_plane(row, wave, along, across, sign)
            else:
                about, beside, sign = (SIN, COS, 1.0) if load == "mx" else (COS, SIN, -1.0)
                self._moment(row, wave, about, beside, sign)

    def _measured(
        self,
        row: int,
        waves: tuple[int, int],
        force: int,
        shape: str,
        factor: float,
        atom: int = ONE,
    ) -> None:
        for product, share in times_wave(*waves):
            self.rows.append(
                (row, self._s.measure(force, shape, product), atom, ONE, 2.0 * factor * share)
            )

    def _moving(
        self,
        row: int,
        waves: tuple[int, int],
        shapes: Array,
        lever: str,
        factor: float,
        atom: int = ONE,
    ) -> None:
        """factor · atom · Σ_k shapes_k q_k, or minus its second derivative, or minus what both add up to."""
        bending = self._bending
        if bending is None:
            return
        for product, share in times_wave(*waves):
            squared = harmonic_of(product) ** 2
            gain = {"at rest": 1.0, "inertia": squared, "moment of inertia": squared - 1.0}[lever]
            for k, shape in enumerate(shapes.tolist()):
                place = coordinate(self._s, bending.first, k, product)
                self.rows.append((row, 0, place, atom, factor * share * gain * shape))

    def _static(self, which: int, arm: bool = False) -> Array:
        """∫ m (r) W_k dr or ∫ m V_k dr, (modes,)."""
        bending = self._bending
        return (
            np.zeros(0)
            if bending is None
            else bending.along[which] @ (bending.strips * (bending.r if arm else 1.0))
        )

    def _vertical(self, row: int, wave: int, times: int, factor: float, atom: int = ONE) -> None:
        self._measured(row, (wave, times), FZ, "one", factor, atom)
        self._moving(row, (wave, times), self._static(0), "inertia", factor, atom)

    def _in_plane(self, row: int, wave: int, along: int, across: int, sign: float) -> None:
        square = float(self._blades**2)
        self._measured(row, (wave, along), FR, "one", 1.0)
        self._measured(row, (wave, across), FX, "one", sign)
        self._measured(row, (wave, along), self._s.forces + E, OUTBOARD, -0.5 * square)
        self._moving(row, (wave, across), self._static(3), "at rest", -sign * square)

    def _moment(self, row: int, wave: int, about: int, beside: int, sign: float) -> None:
        if self._sprung:
            self._measured(row, (wave, about), FZ, "r", sign)
            self._moving(row, (wave, about), self._static(0, arm=True), "moment of inertia", sign)
        else:
            hinge = 1.0 if self._bending is None else float(self._bending.r[0])
            self._vertical(row, wave, about, sign * hinge)
        if OFFSET in self._s.states:
            self._vertical(row, wave, beside, 1.0, self._s.states[OFFSET])


def hub_load_terms(s: Structure, blades: int, bending: BladeBending) -> Terms:
    """Cosine and sine of each of `LOADS` in turn, over ρA(ΩR)² and for moments R."""
    return Terms.of(
        HubLoadTerms(s, blades, bending.modes.beam.springs[0] > 0.0, bending).rows, 2 * len(LOADS)
    )
