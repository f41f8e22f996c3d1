"""Bending of the blade as columns and equations; symbols as in `rotor.aero.bending` and `rotor.aero.bent_section`.

For every mode k and wave h, with f = 1 (h = 0) or 2 and g_k an inverse stiffness,

    g_k [m_k (ν_k² − h²) q_kh + Σ_l d_kl (q_l')_h
         + f · mean of w_h' E A_k + w_h (G_w W_k' + G_v V_k' + M_w W_k'' + M_v V_k'')]
      = g_k [f · mean of w_h (W_k F_z − V_k F_x) + load_k (h = 0) + Σ_j c_jk φ_jh]
"""

from collections.abc import Hashable

import numpy as np

from rotor.aero.bending import HARMONICS
from rotor.aero.bent_section import BENDING, GV, GW, KV, KW, MV, MW, SLOPES, SV, SW, B, E
from rotor.aero.problem import Problem
from rotor.aero.section import FX, FZ, UP, UR, UT
from rotor.arrays import Array
from rotor.columns.blade import Freedom, Torsion
from rotor.columns.coordinates import FLAPPING_STATES, OFFSET, coordinate
from rotor.columns.hub_loads import OUTBOARD, HubLoadTerms, has_hub_loads
from rotor.engine.terms import Shape, Structure
from rotor.engine.waves import STEADY, harmonic_of, rate_of

FUNCTIONS = 1 + 2 * HARMONICS
"""Waves of bending."""


class Bending:
    """The modal coordinates in flap and lag."""

    functions = FUNCTIONS

    def __init__(self, problem: Problem) -> None:
        b, torsion = problem.bending, problem.torsion
        assert b is not None
        self.modes, self.first, self.lag = len(b.mass), b.first, b.lag
        self.twists = 0 if torsion is None else len(torsion.gain)
        self._hub = problem.design.rotor.blades, b.modes.beam.hingeless
        self.key: Hashable = "bending", self.modes, self.first, self.lag, self.twists, self.functions, self._hub

    def numbers(self, problem: Problem) -> dict[Hashable, float]:
        """Of the equations in the head of this file."""
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
            by_slope, by_acceleration = weight @ b.shapes[1].T, weight / problem.disk.r @ b.shapes[0].T
            tip = by_slope[..., None] - by_acceleration[..., None] * harmonic**2  # (twists, modes, harmonics)
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

    def declare(self, s: Structure) -> None:
        """The coordinates but for coning and first-harmonic flapping, which are the trim's; y0 for steady lag."""
        for k in range(self.modes):
            for h in range(self.functions):
                if k == self.lag and h == STEADY:
                    s.state(OFFSET)
                elif k != self.first or h >= len(FLAPPING_STATES):
                    s.state(("bend", k, h))

    def build(self, s: Structure) -> list[int]:
        """Columns of slopes, curvatures and velocities; equations of bending, and what they add to those of torsion."""
        n, slot = s.numbers, {channel: s.channels + channel for channel in SLOPES}
        for channel, name in ((SW, "W'"), (SV, "V'"), (KW, "W''"), (KV, "V''")):
            s.column(slot[channel], ("precone", name), STEADY, 1.0, n["precone"])
        s.column(UR, ("precone", "V"), STEADY, 1.0, n["precone"])
        free = list[int]()
        for k in range(self.modes):
            for h in range(self.functions):
                if k == self.lag and h == STEADY:
                    s.column(UR, "one", STEADY, 1.0, s.states[OFFSET])
                    free.append(s.states[OFFSET])
                    continue
                own = coordinate(s, self.first, k, h)
                if ("bend", k, h) in s.states:
                    free.append(own)
                rate, factor = rate_of(h)
                s.column(UP, ("W", k), rate, factor, own)
                s.column(UT, ("V", k), rate, factor, own)
                s.column(UR, ("V", k), h, 1.0, own)
                s.column(slot[B], ("outboard", k), rate, factor, own)
                for channel, name in ((SW, "W'"), (SV, "V'"), (KW, "W''"), (KV, "V''")):
                    s.column(slot[channel], (name, k), h, 1.0, own)
        for k in range(self.modes):
            for h in range(self.functions):
                self._balance(s, k, h)
        if has_hub_loads(self._hub[0]):
            HubLoadTerms(s, *self._hub)  # Its measures.
        return free

    def _balance(self, s: Structure, k: int, h: int) -> None:
        """The equation of one mode and one wave."""
        n, row, harmonic = s.numbers, s.equation(("bend", k, h)), harmonic_of(h)
        slot = {force: s.forces + force for force in BENDING}
        gain = n["bend gain", k, harmonic]
        steady_lag = k == self.lag and h == STEADY
        if not steady_lag:
            s.term(row, 1.0, n["bend stiffness", k, harmonic], coordinate(s, self.first, k, h))
        for sign, force, shape in (
            (-1.0, FZ, ("W", k)), (1.0, FX, ("V", k)), (1.0, slot[GW], ("W'", k)), (1.0, slot[GV], ("V'", k)),
            (1.0, slot[MW], ("W''", k)), (1.0, slot[MV], ("V''", k)),
        ):  # fmt: skip
            s.term(row, sign, gain, q=s.measure(force, shape, h))
        if h == STEADY:
            s.term(row, -1.0, n["bend load", k])
            if OFFSET in s.states:
                s.term(row, -1.0, n["in plane", k], s.states[OFFSET])
            if steady_lag:  # The shortened blade's mass is nearer to the shaft: −½ y0 ∫ E ∫_r^R m dρ dr.
                shortened = s.measure(slot[E], OUTBOARD, STEADY)
                s.term(row, 0.5, n["steady lag"], s.states[OFFSET], shortened)
        else:
            partner, factor = rate_of(h)
            s.term(row, factor, gain, q=s.measure(slot[E], ("outboard", k), partner))
            for other in range(self.modes):  # (q')_h = −factor/h · h q_partner: the rate of the partner is this wave.
                sign = -factor / harmonic
                s.term(row, sign, n["bend damping", k, other, harmonic], coordinate(s, self.first, other, partner))
        for j in range(self.twists):
            twist = s.states["twist", j, h]
            s.term(row, -1.0, n["tip on bending", j, k, harmonic], twist)
            if not steady_lag:
                own = coordinate(s, self.first, k, h)
                s.term(s.equations["twist", j, h], -1.0, n["tip on torsion", j, k, harmonic], own)

    def shapes(self, problem: Problem) -> dict[Shape, Array]:
        """Of modes and precone."""
        b = problem.bending
        assert b is not None
        out: dict[Shape, Array] = {OUTBOARD: b.mass_outboard}
        names = ("W", "W'", "W''", "V", "V'", "V''")
        for name, own in zip(names, b.shapes[:, b.first], strict=True):  # The rigid cone, in place of that of the mode.
            out["precone", name] = (1.0 if name == "W'" else 0.0) - own
        for k in range(self.modes):
            out["outboard", k] = b.outboard[k]
            for name, own in zip(names, b.shapes[:, k], strict=True):
                out[name, k] = own
        return out


def freedoms_of(problem: Problem, functions: int | None = None) -> tuple[Freedom, ...]:
    """Torsion and bending of a design; functions: waves of the elastic twist, by default those of its torsion."""
    torsion, bending = problem.torsion, problem.bending
    found = list[Freedom]()
    if torsion is not None:
        found.append(Torsion(len(torsion.gain), functions or torsion.functions, bends=bending is not None))
    if bending is not None:
        found.append(Bending(problem))
    return tuple(found)
