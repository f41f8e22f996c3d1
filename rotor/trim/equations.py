"""The equations of equilibrium in forward flight, and their exact Jacobian.

A trim is data: the quantities it solves for and, one for each, the equations that have to be met. Every equation is a
weighted sum of the sums over the disk (thrust, H-force, flap moments, torque), with weights that are constant or turn
with the shaft, plus a term of the trim state alone, in units of C_T. So they are matrices, made once for a trim, and
their exact derivatives follow from those of the sums.

`propulsive` (flight preset): collective, cyclic, shaft tilt and coning so that the vertical force carries the weight,
the forward force the drag, and the first-harmonic flapping has its given value. `thrust` (thesis preset): collective
and free flapping so that the thrust is the resultant of weight and drag; no cyclic. In both λ0 closes eq. (2.30) with
the axial flow of the tilted disk. Rigid blades have neither flapping nor cyclic among their unknowns: collective, λ0
and, where drag is balanced, the shaft tilt remain, and the hub carries the moments.

On a test stand (`rotor.design.stand`) no force is balanced. `wind-tunnel`: the collective gives the thrust, or is
given. `free-rotor`: the shaft tilt takes the torque away. `controls`: flapping and inflow are all that remain. Flapping
is free, or trimmed by cyclic. A hub that fixes the coning leaves it out of the unknowns.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from rotor.aero.elements import BladeElements, Problem
from rotor.aero.inflow import Wake
from rotor.aero.sums import N_SUMS, SUM_NAMES, Slopes, SumName, sum_array
from rotor.aero.trim_state import STATE_NAMES, TrimState, Unknown, places_of
from rotor.arrays import Array
from rotor.compiled import compiled
from rotor.design.design import Design

_NONE: Mapping[Any, float] = MappingProxyType({})


class Equation(NamedTuple):
    """One equation: (fixed + cos α · level + sin α · tilted) · sums + constant + by_state · state = 0, units of C_T."""

    fixed: Mapping[SumName, float] = _NONE
    """Weights on the sums over the disk."""
    level: Mapping[SumName, float] = _NONE
    """The same times the cosine of the shaft tilt."""
    tilted: Mapping[SumName, float] = _NONE
    """The same times its sine."""
    constant: float = 0.0
    by_state: Mapping[Unknown, float] = _NONE
    inflow: bool = False
    """Whether 2 λ0 V is part of it."""


Row = Callable[[Problem], Equation]


def vertical_force(problem: Problem) -> Equation:
    """Thrust and H-force carry the weight: C_T cos α + C_H sin α = C_W."""
    return Equation(level={"thrust": 1.0}, tilted={"drag": 1.0}, constant=-problem.weight)


def forward_force(problem: Problem) -> Equation:
    """Thrust and H-force pull the airframe's drag: C_T sin α − C_H cos α = D."""
    return Equation(tilted={"thrust": 1.0}, level={"drag": -1.0}, constant=-problem.drag)


def given_thrust(problem: Problem) -> Equation:
    """The thrust along the shaft is the resultant of weight and drag, or the one given on a test stand."""
    return Equation({"thrust": 1.0}, constant=-math.hypot(problem.weight, problem.drag))


def no_torque(problem: Problem) -> Equation:
    """The air turns the rotor: C_Q = 0."""
    del problem
    return Equation({"torque": 1.0})


def coning_moment(problem: Problem) -> Equation:
    """The mean flap moment carries coning and the blade's weight: ν² β0 + weight = Γ M0."""
    flap = problem.flap
    stiffness = flap.frequency_squared / flap.load_gain
    return Equation({"moment": 1.0}, constant=-flap.weight / flap.load_gain, by_state={"coning": -stiffness})


def flap_moment_1c(problem: Problem) -> Equation:
    """The cosine part of the flap moment: (ν² − 1) β1c = Γ M1c."""
    stiffness = (problem.flap.frequency_squared - 1.0) / problem.flap.load_gain
    return Equation({"moment_1c": 1.0}, by_state={"flap_1c": -stiffness})


def flap_moment_1s(problem: Problem) -> Equation:
    """The sine part of the flap moment: (ν² − 1) β1s = Γ M1s."""
    stiffness = (problem.flap.frequency_squared - 1.0) / problem.flap.load_gain
    return Equation({"moment_1s": 1.0}, by_state={"flap_1s": -stiffness})


def momentum(problem: Problem) -> Equation:
    """Mean inflow of momentum theory, eq. (2.30): 2 λ0 V = C_T with V = √(µ_x² + (µ_z + λ0)²)."""
    del problem
    return Equation({"thrust": -1.0}, inflow=True)


def _momentum_slopes(problem: Problem, flow: Wake) -> tuple[float, float]:
    """∂(2 λ0 V) by λ0 and by the shaft tilt: V ∂V = µ_x λ0, since µ_x dµ_x + µ_z dµ_z = 0."""
    tilts = problem.design.models.disk_axial_flow
    return (
        2.0 * (flow.speed + flow.lambda0 * flow.axial / flow.speed),
        2.0 * flow.lambda0**2 * flow.mu_x / flow.speed if tilts else 0.0,
    )


class _Equations(NamedTuple):
    """The equations of a trim as matrices."""

    weights: Array
    """Constant ones, those times cos α and those times sin α, (3, equations, sums)."""
    constant: Array
    by_state: Array
    """(equations, 8)"""
    inflow: Array
    """1 where 2 λ0 V is part of an equation, (equations,)."""


_SUM_PLACE = {name: k for k, name in enumerate(SUM_NAMES)}
_STATE_PLACE = {name: k for k, name in enumerate(STATE_NAMES)}


@lru_cache(maxsize=8)
def _equations(problem: Problem) -> _Equations:
    rows = [row(problem) for row in trim_of(problem.design).rows]
    weights, by_state = np.zeros((3, len(rows), N_SUMS)), np.zeros((len(rows), len(STATE_NAMES)))
    constant, inflow = np.zeros((2, len(rows)))
    for i, row in enumerate(rows):
        for k, mapping in enumerate((row.fixed, row.level, row.tilted)):
            for name, weight in mapping.items():
                weights[k, i, _SUM_PLACE[name]] = weight
        for unknown, slope in row.by_state.items():
            by_state[i, _STATE_PLACE[unknown]] = slope
        constant[i], inflow[i] = row.constant, row.inflow
    return _Equations(weights, constant, by_state, inflow)


@dataclass(frozen=True)
class Trim:
    """A way to trim: as many equations as unknowns."""

    unknowns: tuple[Unknown, ...]
    """The quantities solved for; all others keep their given values."""
    rows: tuple[Row, ...]

    def __post_init__(self) -> None:
        if len(self.unknowns) != len(self.rows):
            raise ValueError(f"{len(self.unknowns)} unknowns with {len(self.rows)} equations: give one for each")


_FORCES: dict[str, tuple[tuple[Unknown, ...], tuple[Row, ...]]] = {
    "propulsive": (("collective", "shaft_tilt"), (vertical_force, forward_force)),
    "thrust": (("collective",), (given_thrust,)),
    "wind-tunnel": (("collective",), (given_thrust,)),
    "free-rotor": (("shaft_tilt", "collective"), (no_torque, given_thrust)),
    "controls": ((), ()),
}
"""Unknowns and equations of each trim beside flapping and inflow; with the collective given it is no unknown."""


def trim_of(design: Design) -> Trim:
    """The unknowns and equations that a design solves."""
    models, stand = design.models, design.condition.stand
    given = stand is not None and stand.collective is not None
    return _trim(models.trim, given, models.flapping, design.rotor.precone is None, _cyclic_trims(design))


@cache
def _trim(name: str, given_collective: bool, flapping: bool, coning: bool, cyclic: bool) -> Trim:
    forces, rows = _FORCES[name]
    unknowns: list[Unknown] = list(forces)
    if given_collective and "collective" in unknowns:
        unknowns.remove("collective")
        rows = tuple(row for row in rows if row is not given_thrust)
    if flapping:  # Rigid blades do not flap, and no cyclic keeps the rotor from rolling.
        if coning:
            unknowns.append("coning")
            rows = (*rows, coning_moment)
        angles: tuple[Unknown, ...] = ("cyclic_1c", "cyclic_1s") if cyclic else ("flap_1c", "flap_1s")
        unknowns += angles
        rows = (*rows, flap_moment_1c, flap_moment_1s)
    return Trim((*unknowns, "lambda0"), (*rows, momentum))


def _cyclic_trims(design: Design) -> bool:
    """Whether cyclic keeps the first-harmonic flapping at its given value, or the blades flap freely."""
    stand = design.condition.stand
    return design.models.trim == "propulsive" if stand is None else stand.flapping == "trimmed"


def unknowns_of(design: Design) -> tuple[Unknown, ...]:
    """The quantities that a design solves for, in the order of the columns of `jacobian`."""
    return trim_of(design).unknowns


def with_given_values(problem: Problem, start: TrimState) -> TrimState:
    """The start with every quantity that is not solved for at its given value."""
    design = problem.design
    condition, models, stand = design.condition, design.models, design.condition.stand
    given: dict[str, float] = {"lambda0": max(start.lambda0, 1e-4)}
    if not models.flapping:
        given |= {"coning": 0.0, "cyclic_1c": 0.0, "cyclic_1s": 0.0, "flap_1c": 0.0, "flap_1s": 0.0}
    elif _cyclic_trims(design):
        given |= {"flap_1c": condition.flap_1c, "flap_1s": condition.flap_1s}
    else:
        given |= {"cyclic_1c": stand.cyclic_1c if stand else 0.0, "cyclic_1s": stand.cyclic_1s if stand else 0.0}
    if models.flapping and design.rotor.precone is not None:
        given["coning"] = design.rotor.precone
    if models.trim == "thrust":
        given["shaft_tilt"] = math.atan2(problem.drag, problem.weight)
    if stand is not None:
        if models.trim != "free-rotor":
            given["shaft_tilt"] = stand.tilt
        if stand.collective is not None:
            given["collective"] = stand.collective
    return replace(start, **given)


class Balance(NamedTuple):
    """How far the forces are from balance."""

    problem: Problem
    tilt: float
    """α"""
    flow: Wake
    weights: Array
    """On the sums over the disk, (equations, sums)."""
    sums: Array
    """The sums over the disk, in the order of `SumName`."""
    error: Array
    """Residual of each trim equation in units of C_T, (equations,)."""

    def jacobian(self, slopes: Slopes) -> Array:
        """Exact derivatives of the residuals by the unknowns, (equations, unknowns)."""
        return self.weights @ slopes.sums + self.besides_sums(slopes.unknowns)

    def besides_sums(self, unknowns: tuple[Unknown, ...]) -> Array:
        """The part of `jacobian` that is not through the sums over the disk."""
        weights, _, by_state, inflow = _equations(self.problem)
        slopes = _momentum_slopes(self.problem, self.flow)
        return _besides_sums(weights, by_state, inflow, self.tilt, slopes, self.sums, places_of(unknowns))


_LAMBDA0, _TILT = STATE_NAMES.index("lambda0"), STATE_NAMES.index("shaft_tilt")


@compiled()
def _besides_sums(
    weights: Any, by_state: Any, momentum: Any, tilt: float, slopes: Any, sums: Any, places: Any
) -> Any:  # fmt: skip
    """`Balance.besides_sums`; slopes: ∂(2 λ0 V) by λ0 and by the shaft tilt; places: of the unknowns in the state."""
    turned = math.cos(tilt) * weights[2] - math.sin(tilt) * weights[1]
    out = np.empty((len(by_state), len(places)))
    for i in range(len(out)):
        for k in range(len(places)):
            out[i, k] = by_state[i, places[k]]
            if places[k] == _LAMBDA0:
                out[i, k] += slopes[0] * momentum[i]
            if places[k] == _TILT:
                out[i, k] += slopes[1] * momentum[i]
                for n in range(len(sums)):
                    out[i, k] += turned[i, n] * sums[n]
    return out


def balance(problem: Problem, state: TrimState, flow: Wake, sums: Array) -> Balance:
    """The residuals, and how they depend on the sums over the disk, (6,)."""
    inflow = 2.0 * flow.lambda0 * flow.speed
    weights, error = _residuals(*_equations(problem), state.array(), state.shaft_tilt, inflow, sums)
    return Balance(problem, state.shaft_tilt, flow, weights, sums, error)


@compiled()
def _residuals(
    weights: Any, constant: Any, by_state: Any, momentum: Any, state: Any, tilt: float, inflow: float, sums: Any
) -> Any:  # fmt: skip
    """Weights on the sums, (equations, sums), and residuals, (equations,); inflow: 2 λ0 V."""
    found = weights[0] + math.cos(tilt) * weights[1] + math.sin(tilt) * weights[2]
    error = constant + inflow * momentum
    for i in range(len(error)):
        for k in range(len(state)):
            error[i] += by_state[i, k] * state[k]
        for k in range(len(sums)):
            error[i] += found[i, k] * sums[k]
    return found, error


def balance_of(problem: Problem, elements: BladeElements) -> Balance:
    """The same of blade elements."""
    return balance(problem, elements.state, elements.flow, sum_array(problem, elements))


def residuals(problem: Problem, elements: BladeElements) -> Array:
    """Residual of each trim equation in units of C_T, (equations,)."""
    return balance_of(problem, elements).error


def jacobian(problem: Problem, elements: BladeElements, slopes: Slopes) -> Array:
    """Exact derivatives of `residuals` by the unknowns, (equations, unknowns)."""
    return balance_of(problem, elements).jacobian(slopes)
