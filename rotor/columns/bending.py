"""Bending of the blade as columns and equations; symbols, and what the section makes of them, as in `rotor.aero.bending`
and `rotor.aero.bent_section`. For every mode k and wave h, with f = 1 (h = 0) or 2 and g_k an inverse stiffness,

    g_k [m_k (ν_k² − h²) q_kh + Σ_l d_kl (q_l')_h + f (mean of w_h' E A_k + w_h (G_w W_k' + G_v V_k' + M_w W_k'' + M_v V_k''))]
        = g_k [f · mean of w_h (W_k F_z − V_k F_x) + load_k (h = 0) + Σ_j c_jk φ_jh]
"""

from collections.abc import Hashable

import numpy as np

from rotor.aero.bending import HARMONICS, BladeBending
from rotor.aero.bent_section import BENDING, GV, GW, KV, KW, MV, MW, SLOPES, SV, SW, B, E
from rotor.aero.problem import Problem
from rotor.aero.section import FR, FX, FZ, UP, UR, UT
from rotor.arrays import Array
from rotor.columns.blade import Freedom, Torsion
from rotor.engine.terms import ONE, Shape, Structure
from rotor.engine.waves import STEADY, harmonic_of, rate_of

FUNCTIONS = 1 + 2 * HARMONICS
"""Waves of bending."""
FLAPPING_STATES = ("coning", "flap_1c", "flap_1s")
"""What the first flap mode's coordinates of the waves 1, cos ψ and sin ψ are called."""
_INDUCED_FACTOR, _PROFILE_DRAG = 1.15, 0.010
"""Textbook values for the torque that the lag angle of reference is estimated by (Leishman, Principles of Helicopter
Aerodynamics, 2006, §5.4)."""


def lag_offset(problem: Problem) -> float:
    """y0 over R: how far the shaft lies behind the axis of the steadily lagged blade, by momentum theory."""
    bending, wake, rotor = problem.bending, problem.expected, problem.design.rotor
    assert bending is not None
    if bending.modes.beam.hingeless or rotor.blade.flap_hinge == 0.0:
        return 0.0
    thrust, mu = problem.weight, wake.mu_x
    torque = thrust * ((_INDUCED_FACTOR - 1.0) * wake.lambda0 + wake.axial)
    torque += rotor.solidity * _PROFILE_DRAG / 8.0 * (1.0 + 4.65 * mu**2)
    return torque / bending.lag_moment


def bends(s: Structure) -> bool:
    """Whether a structure has bending."""
    return any(isinstance(name, tuple) and name[0] == "bend" for name in s.states)


def coordinate(s: Structure, first: int, k: int, h: int) -> int:
    """The atom of q_kh."""
    return s.states[FLAPPING_STATES[h]] if k == first and h < len(FLAPPING_STATES) else s.states["bend", k, h]


class Bending:
    """The modal coordinates in flap and lag."""

    def __init__(self, modes: int, first: int, twists: int, functions: int = FUNCTIONS) -> None:
        """first: the mode in the place of rigid flapping; twists: torsion modes with as many waves or more."""
        self.modes, self.first, self.twists, self.functions = modes, first, twists, functions
        self.key: Hashable = "bending", modes, first, twists, functions

    def numbers(self, problem: Problem) -> dict[Hashable, float]:
        """Of the equations in the head of this file."""
        b, torsion = problem.bending, problem.torsion
        assert b is not None
        offset, highest = lag_offset(problem), harmonic_of(self.functions - 1)
        harmonic = np.arange(highest + 1)
        stiffness = b.mass[:, None] * (b.frequency[:, None] ** 2 - harmonic**2)
        gain = 1.0 / np.maximum(np.abs(stiffness), (b.mass * b.frequency**2)[:, None])
        out: dict[Hashable, float] = {"lag offset": offset, "precone": b.precone}
        load = gain[:, 0] * (b.load + offset * b.in_plane)
        damping = gain[:, None, :] * b.damping[:, :, None] * harmonic
        if torsion is not None:
            weight = torsion.radial * (torsion.tip_mass * torsion.dr)
            by_slope, by_acceleration = weight @ b.shapes[1].T, weight / problem.disk.r @ b.shapes[0].T
            tip = by_slope[..., None] - by_acceleration[..., None] * harmonic**2  # (twists, modes, harmonics)
        else:
            tip = np.zeros((0, self.modes, highest + 1))
        for k in range(self.modes):
            out["bend load", k] = float(load[k])
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
        """The coordinates but for coning and first-harmonic flapping, which are the trim's."""
        for k in range(self.modes):
            for h in range(self.functions):
                if k != self.first or h >= len(FLAPPING_STATES):
                    s.state(("bend", k, h))

    def build(self, s: Structure) -> list[int]:
        """Columns of slopes, curvatures and velocities; equations of bending, and what they add to those of torsion."""
        n, slot = s.numbers, {channel: s.channels + channel for channel in SLOPES}
        s.column(UR, "one", STEADY, 1.0, n["lag offset"])
        for channel, name in ((SW, "precone slope"), (KW, "precone curvature"), (KV, "precone lag curvature")):
            s.column(slot[channel], name, STEADY, 1.0, n["precone"])
        free = list[int]()
        for k in range(self.modes):
            for h in range(self.functions):
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
        return free

    def _balance(self, s: Structure, k: int, h: int) -> None:
        """The equation of one mode and one wave."""
        n, row, harmonic = s.numbers, s.equation(("bend", k, h)), harmonic_of(h)
        slot = {force: s.forces + force for force in BENDING}
        gain = n["bend gain", k, harmonic]
        s.term(row, 1.0, n["bend stiffness", k, harmonic], coordinate(s, self.first, k, h))
        for sign, force, shape in (
            (-1.0, FZ, ("W", k)), (1.0, FX, ("V", k)), (1.0, slot[GW], ("W'", k)), (1.0, slot[GV], ("V'", k)),
            (1.0, slot[MW], ("W''", k)), (1.0, slot[MV], ("V''", k)),
        ):  # fmt: skip
            s.term(row, sign, gain, q=s.measure(force, shape, h))
        if h == STEADY:
            s.term(row, -1.0, n["bend load", k])
        else:
            partner, factor = rate_of(h)
            s.term(row, factor, gain, q=s.measure(slot[E], ("outboard", k), partner))
            for other in range(self.modes):  # (q')_h = −factor/h · h q_partner: the rate of the partner is this wave.
                sign = -factor / harmonic
                s.term(row, sign, n["bend damping", k, other, harmonic], coordinate(s, self.first, other, partner))
        for j in range(self.twists):
            twist = s.states["twist", j, h]
            s.term(row, -1.0, n["tip on bending", j, k, harmonic], twist)
            s.term(
                s.equations["twist", j, h], -1.0, n["tip on torsion", j, k, harmonic], coordinate(s, self.first, k, h)
            )  # fmt: skip

    def shapes(self, problem: Problem) -> dict[Shape, Array]:
        """Of modes and precone."""
        b = problem.bending
        assert b is not None
        out: dict[Shape, Array] = {
            "precone slope": 1.0 - b.shapes[1, b.first],
            "precone curvature": -b.shapes[2, b.first],
            "precone lag curvature": -b.shapes[5, b.first],
        }
        for k in range(self.modes):
            out["outboard", k] = b.outboard[k]
            for name, own in zip(("W", "W'", "W''", "V", "V'", "V''"), b.shapes[:, k], strict=True):
                out[name, k] = own
        return out


def freedoms_of(problem: Problem, functions: int | None = None) -> tuple[Freedom, ...]:
    """Torsion and bending of a design; functions: waves of the elastic twist, by default those of its torsion."""
    torsion, bending = problem.torsion, problem.bending
    found = list[Freedom]()
    if torsion is not None:
        found.append(Torsion(len(torsion.gain), functions or torsion.functions, bends=bending is not None))
    if bending is not None:
        found.append(Bending(len(bending.mass), bending.first, 0 if torsion is None else len(torsion.gain)))
    return tuple(found)


def coordinates_of(b: BladeBending, s: Structure, z: Array) -> Array:
    """q_kh of the states at z, (modes, functions)."""
    modes = len(b.mass)
    functions = sum(isinstance(name, tuple) and name[:2] == ("bend", modes - 1 - (b.first == modes - 1)) for name in s.states)
    return np.array([[z[coordinate(s, b.first, k, h)] for h in range(functions)] for k in range(modes)])


def torque_terms(s: Structure) -> list[tuple[float, int, int, int]]:
    """C_Q = Σ r F_x + (y0 + v) F_r, as factor · z_i z_j Q: (factor, z_i, z_j, measure)."""
    terms = [(1.0, ONE, ONE, s.measure(FX, "r", STEADY))]
    if bends(s):
        terms.append((1.0, s.numbers["lag offset"], ONE, s.measure(FR, "one", STEADY)))
        terms += [(1.0, atom, ONE, s.measure(FR, ("V", k), h)) for k, h, atom in _all(s)]
    return terms


def bending_work(s: Structure) -> list[tuple[float, int, int, int]]:
    """Power that the air does on bending, Σ (W_k F_z − V_k F_x) q_k', in the same form."""
    terms = list[tuple[float, int, int, int]]()
    for k, h, atom in _all(s):
        rate, factor = rate_of(h)
        if factor:
            terms.append((factor, atom, ONE, s.measure(FZ, ("W", k), rate)))
            terms.append((-factor, atom, ONE, s.measure(FX, ("V", k), rate)))
    return terms


def _all(s: Structure) -> list[tuple[int, int, int]]:
    """Mode, wave and atom of all coordinates."""
    own = [(name[1], name[2], atom) for name, atom in s.states.items() if isinstance(name, tuple) and name[0] == "bend"]
    present = {(k, h) for k, h, _ in own}
    first = next(k for k, _, _ in own if (k, 0) not in present)
    return [(first, h, s.states[name]) for h, name in enumerate(FLAPPING_STATES)] + own
