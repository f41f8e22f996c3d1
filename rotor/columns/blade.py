"""The blade as columns: pitch and flapping, and its elastic twist with the equations of torsion.

    θ  = θ_tw(r) + θ0 + θ1c cos ψ + θ1s sin ψ + Σ Φ_k(r) q_kh w_h(ψ) + θ_act(r, ψ)
    β  = β0 + β1c cos ψ + β1s sin ψ,    U_P gets (r − e) β' and, from the flow along a blade that slopes, µ_x β cos ψ

With the pitch rate θ', the modal frequency ν_k and the moments of `rotor.aero.elastic`, for every mode k and wave h,

    (1 − (h/ν_k)²) q_kh = g_k [harmonic h of ∫ Φ_k M dr + Σ_l ∫ Φ_k j Φ_l dr q_lh + j_k θ1 (h = 1) + w_k β0 (h = 0)]
                          − given

in radians, with g_k = 1/(m_k ν_k²). `given`: tension on the built-in twist, and what active twist adds.
"""

from abc import ABC, abstractmethod
from collections.abc import Hashable

from rotor.aero.problem import Problem
from rotor.aero.section import FR, FX, FZ, RATE, TH, UP, UR, UT, M
from rotor.aero.unsteady_section import DTH, DUP, DUT
from rotor.engine.terms import ONE, Addend, Shape, Structure, Sum
from rotor.engine.waves import COS, SIN, STEADY, rate_of, times_wave
from rotor.support.arrays import Array

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


def add_accelerations(s: Structure, first: int, slopes: int | None = None) -> None:
    """Rates of θ', U_T and U_P, from the columns that there are by now: without the inflow.

    first: the channel of θ'' (`rotor.aero.unsteady_section`). slopes: that of w', then v', of a blade that bends, along
    which wind blows: w' µ_x cos ψ is in its U_P. No wave is added beyond the highest.
    """
    by_rate = {RATE: first + DTH, UT: first + DUT, UP: first + DUP}
    moved = [
        (by_rate[column[0]], column, (column[2], 1.0), column[4])
        for column in s.columns
        if column[0] in by_rate
    ]
    highest = max(column[2] for column in s.columns)
    if slopes is not None:
        by_slope, mu_x = {slopes: first + DUP, slopes + 1: first + DUT}, s.derived["mu_x"]
        for column in s.columns:
            if column[0] in by_slope:
                assert column[4] == ONE
                waves = (wave for wave in times_wave(column[2], COS) if wave[0] <= highest)
                moved += [(by_slope[column[0]], column, product, mu_x) for product in waves]
    for channel, (source, row, _, i, _, factor), (wave, share), j in moved:
        rate, by_rate_of_wave = rate_of(wave)
        s.column(channel, list(s.shapes[source])[row], rate, factor * share * by_rate_of_wave, i, j)


_POWER = {UT: (1.0, FX), UP: (-1.0, FZ), UR: (1.0, FR)}
"""Sign and force of each velocity in U dD = U_T F_x − U_P F_z + U_R F_r."""


def power_of_air(s: Structure) -> tuple[Sum, Sum, Sum]:
    """H and C_Q of the blade, and the power that the air gives its motion, from the columns that there are by now.

    By virtual power: what a velocity has of µ_x is the place of its force in H; what else U_R has is the arm of F_r
    about the shaft; what else U_T and U_P have is the blade's own velocity, away from the air and up.
    """
    mu_x, drag, motion = s.derived["mu_x"], Sum(), Sum()
    torque = [(1.0, ONE, ONE, s.measure(FX, "r", STEADY))]
    for channel, row, wave, i, j, factor in s.columns:
        if channel not in _POWER:
            continue
        sign, force = _POWER[channel]
        measure = s.measure(force, list(s.shapes[channel])[row], wave)
        if mu_x in (i, j):
            drag.append((sign * factor, i + j - mu_x, ONE, measure))
        elif channel == UR:
            torque.append((factor, i, j, measure))
        else:
            motion.append((-sign * factor, i, j, measure))
    return drag, torque, motion


class Freedom(ABC):
    """Degrees of freedom of the blade beyond rigid flapping, such as torsion and bending; subclass it to add others.

    A freedom is a value. Its class and its fields, which must be hashable, determine its columns and equations; only
    `numbers` and `shapes` depend on the design. Lengths are over R, time is ψ, and forces are those of all blades
    over ρA(ΩR)².
    """

    states: tuple[Hashable, ...]
    """Names of its states, each with an equation."""

    @property
    def key(self) -> Hashable:
        """Equal for equal columns and equations: class and fields."""
        return type(self), *vars(self).items()

    @abstractmethod
    def numbers(self, problem: Problem) -> dict[Hashable, float]:
        """Values of the numbers in its equations, by name."""

    @abstractmethod
    def build(self, s: Structure) -> None:
        """Add columns and equations, one for each state.

        Columns of U_T and U_P without µ_x are velocities of the blade; those of U_R, how far it lies forward.
        """

    def shapes(self, problem: Problem) -> dict[Shape, Array]:
        """Functions along the blade by name, (elements,), in addition to "one", "r" and "arm"; by default none."""
        del problem
        return {}

    def power(self, s: Structure) -> list[Addend]:
        """Shaft power that its dampers dissipate, over ρA(ΩR)³; by default none.

        It must equal the power that the air puts into the blades' motion: `solve` checks this and refuses otherwise.
        """
        del s
        return []


class Torsion(Freedom):
    def __init__(self, modes: int, functions: int, *, bends: bool = False) -> None:
        """bends: whether bending adds the moments of the swept tip's mass."""
        self.modes, self.functions, self._bends = modes, functions, bends
        self.states = tuple(("twist", k, h) for k in range(modes) for h in range(functions))

    def numbers(self, problem: Problem) -> dict[Hashable, float]:
        """Numbers of the equations in the head of this file."""
        torsion, given = problem.torsion, problem.given_torsion.tolist()
        assert torsion is not None
        out = dict[Hashable, float]()
        gain, coupling = torsion.gain.tolist(), (torsion.gain[:, None] * torsion.coupling).tolist()
        mass = (torsion.gain * torsion.modal(torsion.tip_mass)).tolist()
        inertia, dynamic = (
            (torsion.gain * torsion.modal(torsion.inertia)).tolist(),
            torsion.dynamic.tolist(),
        )
        for k in range(self.modes):
            out |= {("gain", k): gain[k], ("gain of a wave", k): 2.0 * gain[k]}
            out |= {("tip mass", k): mass[k], ("inertia", k): inertia[k]}
            out |= {("coupling", k, other): coupling[k][other] for other in range(self.modes)}
            for h in range(self.functions):
                out |= {("dynamic", k, h): dynamic[k][h], ("given", k, h): given[k][h]}
        return out

    def build(self, s: Structure) -> None:
        """Columns of the elastic twist and of all rates of pitch, equations of torsion."""
        add_pitch_rates(s)
        for k in range(self.modes):
            for h in range(self.functions):
                state = s.states["twist", k, h]
                s.column(TH, ("mode", k), h, 1.0, state)
                s.column(RATE, ("mode", k), *rate_of(h), state)
                self._balance(s, k, h)

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
        return {("mode", k): mode for k, mode in enumerate(problem.torsion.radial)}
