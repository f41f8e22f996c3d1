"""The equations of equilibrium in forward flight, and their exact Jacobian.

A trim is data: the quantities it solves for and, one for each, the equations that have to be met. Every equation is a
weighted sum of the sums over the disk (thrust, H-force, flap moments, torque) plus a term of the trim state alone, in
units of C_T, so that its exact derivatives follow from those of the sums.

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
from functools import cache
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from rotor.aero.elements import BladeElements, Problem
from rotor.aero.inflow import Wake
from rotor.aero.sums import N_SUMS, SUM_NAMES, Slopes, SumName, sum_array
from rotor.aero.trim_state import TrimState, Unknown
from rotor.arrays import Array
from rotor.design.design import Design

_NONE: Mapping[Any, float] = MappingProxyType({})


class Equation(NamedTuple):
    """One equation at a trim state: weights · sums + rest = 0, in units of C_T."""

    weights: Mapping[SumName, float]
    """Weights on the sums over the disk."""
    rest: float = 0.0
    """Part that does not depend on the loads."""
    slopes: Mapping[Unknown, float] = _NONE
    """∂rest by the unknowns."""
    by_tilt: Mapping[SumName, float] = _NONE
    """∂weights by the shaft tilt."""


_PLACE = {name: k for k, name in enumerate(SUM_NAMES)}

Row = Callable[[Problem, TrimState, Wake], Equation]


def vertical_force(problem: Problem, state: TrimState, flow: Wake) -> Equation:
    """Thrust and H-force carry the weight: C_T cos α + C_H sin α = C_W."""
    del flow
    cos, sin = math.cos(state.shaft_tilt), math.sin(state.shaft_tilt)
    return Equation({"thrust": cos, "drag": sin}, -problem.weight, by_tilt={"thrust": -sin, "drag": cos})


def forward_force(problem: Problem, state: TrimState, flow: Wake) -> Equation:
    """Thrust and H-force pull the airframe's drag: C_T sin α − C_H cos α = D."""
    del flow
    cos, sin = math.cos(state.shaft_tilt), math.sin(state.shaft_tilt)
    return Equation({"thrust": sin, "drag": -cos}, -problem.drag, by_tilt={"thrust": cos, "drag": sin})


def given_thrust(problem: Problem, state: TrimState, flow: Wake) -> Equation:
    """The thrust along the shaft is the resultant of weight and drag, or the one given on a test stand."""
    del state, flow
    return Equation({"thrust": 1.0}, -math.hypot(problem.weight, problem.drag))


def no_torque(problem: Problem, state: TrimState, flow: Wake) -> Equation:
    """The air turns the rotor: C_Q = 0."""
    del problem, state, flow
    return Equation({"torque": 1.0})


def coning_moment(problem: Problem, state: TrimState, flow: Wake) -> Equation:
    """The mean flap moment carries coning and the blade's weight: ν² β0 + weight = Γ M0."""
    del flow
    flap = problem.flap
    stiffness = flap.frequency_squared / flap.load_gain
    rest = -(flap.weight + flap.frequency_squared * state.coning) / flap.load_gain
    return Equation({"moment": 1.0}, rest, {"coning": -stiffness})


def flap_moment_1c(problem: Problem, state: TrimState, flow: Wake) -> Equation:
    """The cosine part of the flap moment: (ν² − 1) β1c = Γ M1c."""
    del flow
    stiffness = (problem.flap.frequency_squared - 1.0) / problem.flap.load_gain
    return Equation({"moment_1c": 1.0}, -stiffness * state.flap_1c, {"flap_1c": -stiffness})


def flap_moment_1s(problem: Problem, state: TrimState, flow: Wake) -> Equation:
    """The sine part of the flap moment: (ν² − 1) β1s = Γ M1s."""
    del flow
    stiffness = (problem.flap.frequency_squared - 1.0) / problem.flap.load_gain
    return Equation({"moment_1s": 1.0}, -stiffness * state.flap_1s, {"flap_1s": -stiffness})


def momentum(problem: Problem, state: TrimState, flow: Wake) -> Equation:
    """Mean inflow of momentum theory, eq. (2.30): 2 λ0 V = C_T with V = √(µ_x² + (µ_z + λ0)²)."""
    del state
    slopes: dict[Unknown, float] = {"lambda0": 2.0 * (flow.speed + flow.lambda0 * flow.axial / flow.speed)}
    if problem.design.models.disk_axial_flow:  # V ∂V = µ_x λ0, since µ_x dµ_x + µ_z dµ_z = 0.
        slopes["shaft_tilt"] = 2.0 * flow.lambda0**2 * flow.mu_x / flow.speed
    return Equation({"thrust": -1.0}, 2.0 * flow.lambda0 * flow.speed, slopes)


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
    state, design = start, problem.design
    condition, models, stand = design.condition, design.models, design.condition.stand
    if not models.flapping:
        state = replace(state, coning=0.0, cyclic_1c=0.0, cyclic_1s=0.0, flap_1c=0.0, flap_1s=0.0)
    elif _cyclic_trims(design):
        state = replace(state, flap_1c=condition.flap_1c, flap_1s=condition.flap_1s)
    elif stand is not None:
        state = replace(state, cyclic_1c=stand.cyclic_1c, cyclic_1s=stand.cyclic_1s)
    else:
        state = replace(state, cyclic_1c=0.0, cyclic_1s=0.0)
    if models.flapping and design.rotor.precone is not None:
        state = replace(state, coning=design.rotor.precone)
    if models.trim == "thrust":
        state = replace(state, shaft_tilt=math.atan2(problem.drag, problem.weight))
    if stand is not None:
        if models.trim != "free-rotor":
            state = replace(state, shaft_tilt=stand.tilt)
        if stand.collective is not None:
            state = replace(state, collective=stand.collective)
    return replace(state, lambda0=max(state.lambda0, 1e-4))


@dataclass(frozen=True, eq=False)
class Balance:
    """How far the forces are from balance."""

    equations: tuple[Equation, ...]
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
        matrix = np.zeros((len(self.equations), len(unknowns)))
        column = {unknown: k for k, unknown in enumerate(unknowns)}
        for row, equation in zip(matrix, self.equations, strict=True):
            for unknown, slope in equation.slopes.items():
                if unknown in column:
                    row[column[unknown]] += slope
            if equation.by_tilt and "shaft_tilt" in column:
                by_tilt = (slope * self.sums[_PLACE[name]] for name, slope in equation.by_tilt.items())
                row[column["shaft_tilt"]] += sum(by_tilt)
        return matrix


def balance(problem: Problem, state: TrimState, flow: Wake, sums: Array) -> Balance:
    """The residuals, and how they depend on the sums over the disk, (6,)."""
    equations = tuple(row(problem, state, flow) for row in trim_of(problem.design).rows)
    weights, rest = np.zeros((len(equations), N_SUMS)), np.array([equation.rest for equation in equations])
    for k, equation in enumerate(equations):
        for name, weight in equation.weights.items():
            weights[k, _PLACE[name]] = weight
    return Balance(equations, weights, sums, rest + weights @ sums)


def balance_of(problem: Problem, elements: BladeElements) -> Balance:
    """The same of blade elements."""
    return balance(problem, elements.state, elements.flow, sum_array(problem, elements))


def residuals(problem: Problem, elements: BladeElements) -> Array:
    """Residual of each trim equation in units of C_T, (equations,)."""
    return balance_of(problem, elements).error


def jacobian(problem: Problem, elements: BladeElements, slopes: Slopes) -> Array:
    """Exact derivatives of `residuals` by the unknowns, (equations, unknowns)."""
    return balance_of(problem, elements).jacobian(slopes)
