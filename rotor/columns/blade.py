"""The blade as columns: pitch and flapping, and its elastic twist with the equations of torsion.

    θ  = θ_tw(r) + θ0 + θ1c cos ψ + θ1s sin ψ + Σ Φ_k(r) q_kh w_h(ψ) + θ_act(r, ψ)
    β  = β0 + β1c cos ψ + β1s sin ψ,    U_P gets (r − e) β' and, from the flow along a blade that slopes, µ_x β cos ψ

With the pitch rate θ', the modal frequency ν_k and the moments of `rotor.aero.elastic`, for every mode k and wave h,

    (1 − (h/ν_k)²) q_kh = g_k [harmonic h of ∫ Φ_k M dr + Σ_l ∫ Φ_k j Φ_l dr q_lh + j_k θ1 (h = 1) + w_k β0 (h = 0)]
                          − given

in radians, with g_k = 1/(m_k ν_k²). `given`: tension on the built-in twist, and what active twist adds.
"""

from collections.abc import Hashable
from typing import Protocol

from rotor.aero.problem import Problem
from rotor.aero.section import RATE, TH, UP, M
from rotor.arrays import Array
from rotor.engine.terms import Shape, Structure
from rotor.engine.waves import COS, SIN, STEADY, rate_of

CYCLIC = (("cyclic_1c", COS), ("cyclic_1s", SIN))
FLAPPING = (("coning", STEADY), ("flap_1c", COS), ("flap_1s", SIN))


def add_rigid_blade(s: Structure, *, bends: bool = False) -> None:
    """Collective, cyclic, and flapping where it is not a mode of bending."""
    z, mu_x = s.states, s.derived["mu_x"]
    s.column(TH, "one", STEADY, 1.0, z["collective"])
    for name, wave in CYCLIC:
        s.column(TH, "one", wave, 1.0, z[name])
    for name, wave in () if bends else FLAPPING:
        s.column(UP, "one", wave, 1.0, z[name], mu_x, times=COS)
        rate, factor = rate_of(wave)
        if factor:
            s.column(UP, "arm", rate, factor, z[name])


def add_pitch_rates(s: Structure) -> None:
    """θ' of the cyclic."""
    for name, wave in CYCLIC:
        if name in s.states:
            s.column(RATE, "one", *rate_of(wave), s.states[name])


class Freedom(Protocol):
    """Degrees of freedom of the blade beside rigid flapping: torsion here, and whatever is added to it."""

    @property
    def key(self) -> Hashable:
        """The same for the same columns and equations."""
        ...

    def numbers(self, problem: Problem) -> dict[Hashable, float]:
        """Values of the numbers in its equations, by name, in the order in which they are declared."""
        ...

    def declare(self, s: Structure) -> None:
        """Add its states."""
        ...

    def build(self, s: Structure) -> list[int]:
        """Add columns and equations; returns the states solved for, one for each equation."""
        ...

    def shapes(self, problem: Problem) -> dict[Shape, Array]:
        """Functions along the blade by name, (elements,), beside "one", "r" and "arm"."""
        ...


class Torsion:
    def __init__(self, modes: int, functions: int, *, bends: bool = False) -> None:
        """bends: whether bending adds the moments of the swept tip's mass."""
        self.modes, self.functions, self._bends = modes, functions, bends
        self.key: Hashable = "torsion", modes, functions, bends

    def numbers(self, problem: Problem) -> dict[Hashable, float]:
        """Of the equations in the head of this file."""
        torsion, given = problem.torsion, problem.given_torsion.tolist()
        assert torsion is not None
        out = dict[Hashable, float]()
        gain, coupling = torsion.gain.tolist(), (torsion.gain[:, None] * torsion.coupling).tolist()
        mass = (torsion.gain * torsion.modal_tip_mass).tolist()
        inertia, dynamic = (torsion.gain * torsion.modal_inertia).tolist(), torsion.dynamic.tolist()
        for k in range(self.modes):
            out |= {("gain", k): gain[k], ("gain of a wave", k): 2.0 * gain[k]}
            out |= {("tip mass", k): mass[k], ("inertia", k): inertia[k]}
            out |= {("coupling", k, other): coupling[k][other] for other in range(self.modes)}
            for h in range(self.functions):
                out |= {("dynamic", k, h): dynamic[k][h], ("given", k, h): given[k][h]}
        return out

    def declare(self, s: Structure) -> None:
        """The coordinates q_kh."""
        for k in range(self.modes):
            for h in range(self.functions):
                s.state(("twist", k, h))

    def build(self, s: Structure) -> list[int]:
        """Columns of the elastic twist and of all rates of pitch, equations of torsion."""
        z, free = s.states, list[int]()
        add_pitch_rates(s)
        for k in range(self.modes):
            for h in range(self.functions):
                own = z["twist", k, h]
                free.append(own)
                s.column(TH, ("mode", k), h, 1.0, own)
                s.column(RATE, ("mode", k), *rate_of(h), own)
                self._balance(s, k, h)
        return free

    def _balance(self, s: Structure, k: int, h: int) -> None:
        """The equation of one mode and one wave."""
        z, n, row = s.states, s.numbers, s.equation(("twist", k, h))
        s.term(row, 1.0, n["dynamic", k, h], z["twist", k, h])
        s.term(row, 1.0, n["given", k, h])
        s.term(row, -1.0, n["gain of a wave" if h else "gain", k], q=s.measure(M, ("mode", k), h))
        for other in range(self.modes):
            s.term(row, -1.0, n["coupling", k, other], z["twist", other, h])
        if h == STEADY and not self._bends:
            s.term(row, -1.0, n["tip mass", k], z["coning"])
        elif h in (COS, SIN):
            s.term(row, -1.0, n["inertia", k], z[CYCLIC[h - 1][0]])

    def shapes(self, problem: Problem) -> dict[Shape, Array]:
        """Φ_k"""
        assert problem.torsion is not None
        return {("mode", k): own for k, own in enumerate(problem.torsion.radial)}
