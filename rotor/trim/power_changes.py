"""What uncertain inputs do to the power of a trim, to first order.

At a trim x of a design, with the multipliers a of power, Jᵀ a = ∂P/∂x, a neighbour d' of the design d costs

    ΔP = P(d', x) − P(d, x) − a·[R(d', x) − R(d, x)]:

one evaluation of its equations, of their sums alone where the airframe differs, and no new trim. The course of the
wake, and at low speed what hover adds, stay. Only another path of the wake has a trim x' of its own, because its change
is not small. A few steps towards it suffice: with P(d', x') in place of P(d', x), and R as well, what is left of R
counts to first order. Where that trim does not converge, the first order stands in the band by a name of its own.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from operator import attrgetter

import numpy as np

from rotor.aero.problem import Problem, build_problem
from rotor.aero.section import EARLIER_RISE, FX, FZ, MORE_LIFT, MORE_MOMENT, SCATTER
from rotor.columns.flight import flight_system, induced_air
from rotor.columns.hover import hover_system
from rotor.design.quantity import replaced
from rotor.design.uncertain import uncertain_inputs
from rotor.engine.linearise import evaluate, with_data, with_numbers
from rotor.support.arrays import Array
from rotor.trim.adjoint import Adjoint, tail_gain
from rotor.trim.forward import course_of
from rotor.trim.low_speed import hover_share
from rotor.trim.newton import FEW_DIGITS, LinearisedTrim, newton
from rotor.trim.power import PowerBudget, induced_power, outside_power
from rotor.trim.solution import Solution

WAKE_PATH, WAKE_SLOPE = "wake_path_percent", "wake_path_slope_percent"
_STEP_SHARE = 0.1
"""Part of its size by which an input is changed: small, so that what is found is the slope for both signs."""
_OF_PARTS = 1e-5
"""What the multipliers that attribute a change to parts of power may leave, over the right side."""

PARTS = ("induced", "profile", "parasite", "tail")
"""Parts of power to which a change is attributed; what dampers and gusts take counts as profile power."""


def by_part(power: PowerBudget) -> Array:
    """The power of each of `PARTS` [W], (4,), the rest in profile power."""
    return np.array(
        [
            power.induced,
            power.total - power.induced - power.parasite - power.tail,
            power.parasite,
            power.tail,
        ]
    )


def power_changes(adjoint: Adjoint) -> dict[str, Array]:
    """What every uncertain input does to the power of each of `PARTS` [W], (4,), where it is larger by its size.

    Of a free rotor, what the errors of the model do to its drag times speed. On a stand profile has propulsive power.
    """
    solution = adjoint.solution
    near = None if solution.design.models.trim == "free-rotor" else _PowerNearby(adjoint)
    changes = dict[str, Array]()
    for row in uncertain_inputs(solution.design):
        if row.name in _POWERS:
            if (power := _POWERS[row.name](solution)).any():
                changes[row.name] = 0.01 * row.size * power
        elif near is None:
            continue
        elif row.name == WAKE_PATH:
            if course_of(near.problem) is not None:
                if (change := near.along_beddoes(0.01 * row.size)) is not None:
                    changes[WAKE_PATH] = change
                else:
                    changes[WAKE_SLOPE] = (
                        near.change(near.along(_STEP_SHARE)) / _STEP_SHARE * 0.01 * row.size
                    )
        elif row.name not in _CHANGES:
            continue
        elif (changed := _CHANGES[row.name](near.problem, _STEP_SHARE * row.size)) is not None:
            changes[row.name] = near.change(changed) / _STEP_SHARE
    return changes


class _PowerNearby:
    """A trim, and the power of designs near it."""

    def __init__(self, adjoint: Adjoint) -> None:
        self.problem, self._point, self._terms = adjoint.problem, adjoint.point, adjoint.total_terms
        self._multipliers = adjoint.of_total
        self._of_induced = adjoint.multipliers(adjoint.measure(adjoint.induced_weights), _OF_PARTS)
        self._gain, self._guess = tail_gain(adjoint.solution), adjoint.solution.start
        self._start = self._powers(adjoint.trim)

    def _powers(self, trim: LinearisedTrim) -> Array:
        """Main-rotor power, and its induced and parasite parts [W], (3,)."""
        problem, point = trim.problem, trim.point
        parasite, climb = outside_power(problem)
        main = (
            float(self._terms.value(point.z, point.q)[0]) * problem.design.power_unit
            + parasite
            + climb
        )
        if problem.design.hovering:
            e = trim.elements
            induced = induced_power(problem, (e.induced, e.swirl), e.fz, e.fx)
        else:  # What else the blade elements have takes several times as long.
            induced = induced_power(
                problem, induced_air(problem, point)[:2], point.forces[FZ], point.forces[FX]
            )
        return np.array([main, induced, parasite])

    def change(self, problem: Problem) -> Array:
        """Power of a problem less that of the trim by `PARTS` [W], to first order."""
        point = self._point
        if problem.scatter is not self.problem.scatter and not problem.design.hovering:
            there = with_data(point, problem.grid_data(1))  # Only the section's own data are other.
            return self._difference(LinearisedTrim(problem, there))
        system = (hover_system if problem.design.hovering else flight_system)(problem)
        there = with_numbers(point, system)
        if problem.design.hovering or problem.design.fuselage == self.problem.design.fuselage:
            there = evaluate(system, system.grid, there.x, flow=problem.design.hovering)
        return self._difference(LinearisedTrim(problem, there))

    def along_beddoes(self, part: float) -> Array | None:
        """The same [W] by a new trim with the wake moved by a part of the way to Beddoes' path; None without a trim."""
        there = newton(self.along(part), self._guess, FEW_DIGITS)
        return self._difference(there.linear) if there.converged else None

    def along(self, part: float) -> Problem:
        """With the wake moved by that part."""
        return replace(self.problem, course=replace(self.problem.course, beddoes=part))

    def _difference(self, there: LinearisedTrim) -> Array:
        left = (there.point.residual - self._point.residual) * there.problem.design.power_unit
        missing = np.array([self._multipliers @ left, self._of_induced @ left, 0.0])
        main, induced, parasite = self._powers(there) - self._start - missing
        return np.array([induced, main - induced - parasite, parasite, main * (self._gain - 1.0)])


Change = Callable[[Problem, float], Problem | None]
"""A problem where an input is larger by an amount in the unit of its name; None where it has no such input."""


def _section(row: int, unit: float = 1.0) -> Change:
    def change(problem: Problem, amount: float) -> Problem | None:
        if row == MORE_MOMENT and problem.torsion is None:
            return None
        if row == EARLIER_RISE and not problem.design.models.compressibility:
            return None
        return replace(problem, scatter=amount * unit * np.eye(len(SCATTER))[row])

    return change


def _larger(place: str, counts: Callable[[Problem], bool]) -> Change:
    """place: fields that lead to the number, or the numbers, from a design."""

    def change(problem: Problem, amount: float) -> Problem | None:
        value: float | tuple[float, ...] | None = (
            attrgetter(place)(problem.design) if counts(problem) else None
        )
        if not value:
            return None
        factor = 1.0 + 0.01 * amount
        larger = (
            tuple(factor * each for each in value) if isinstance(value, tuple) else factor * value
        )
        built = build_problem(replaced(problem.design, place.split("."), larger))
        air = replace(built.air, joined=problem.air.joined)
        return replace(built, course=problem.course, air=air, freedoms=problem.freedoms)

    return change


def _twists(problem: Problem) -> bool:
    return problem.torsion is not None


def _flies(problem: Problem) -> bool:
    return problem.design.condition.stand is None


def _wake_transport(problem: Problem, amount: float) -> Problem | None:
    if problem.design.hovering or problem.inflow.wake_along is None:
        return None
    # The hover model has no such wake.
    course, part = (
        problem.course,
        1.0 - hover_share(problem.design),
    )
    return replace(
        problem, course=replace(course, lambda0=course.lambda0 * (1.0 + 0.01 * part * amount))
    )


def _tip_loss(problem: Problem, amount: float) -> Problem | None:
    """1 − B, the part of the radius that does not lift, goes with 1/f."""
    if not problem.design.models.tip_loss or (
        problem.inflow.keeps_tips and not problem.design.hovering
    ):
        return None
    return replace(problem, tip_spacing=1.0 / (1.0 + 0.01 * amount))


_CHANGES: Mapping[str, Change] = {
    "section_lift_percent": _section(MORE_LIFT, 0.01),
    "section_moment": _section(MORE_MOMENT),
    "drag_rise_mach": _section(EARLIER_RISE),
    "drag_area_percent": _larger(
        "fuselage.drag_area", lambda problem: _flies(problem) and not problem.design.hovering
    ),
    "download_percent": _larger(
        "fuselage.hover_download",
        lambda problem: _flies(problem) and problem.design.models.has("download"),
    ),
    "torsional_stiffness_percent": _larger("rotor.blade.structure.torsional_stiffness", _twists),
    "control_stiffness_percent": _larger("rotor.blade.structure.control_stiffness", _twists),
    "torsional_inertia_percent": _larger("rotor.blade.structure.torsional_inertia", _twists),
    "wake_transport_percent": _wake_transport,
    "tip_loss_percent": _tip_loss,
}
"""By name, in the order of `assets/doubt.toml`."""
_POWERS: Mapping[str, Callable[[Solution], Array]] = {
    "induced_power_percent": lambda solution: (
        solution.power.induced * np.array([1, 0, 0, tail_gain(solution) - 1])
    ),
    "profile_power_percent": lambda solution: (
        solution.power.profile * np.array([0, 1, 0, tail_gain(solution) - 1])
    ),
    "tail_rotor_percent": lambda solution: solution.power.tail * np.array([0, 0, 0, 1]),
}
"""By name the powers of `PARTS` [W] that are uncertain by a share; of the rotor's, with the tail rotor's for it."""
