"""Trim in forward flight: the course of the wake, warm start, cold start, continuation from an easier condition.

The wake of a lifting line lies along the trim of the same rotor with linear inflow, its blade as built, and sections
that do not stall. That trim knows the tilt, the flapping and the mean inflow, and nothing of the twist
that is being designed. So one wake serves all twists of a condition, and the gradient by twist is exact. Laid along the
trim found with it, power moves by less than 0.3 % (tested). A free rotor finds its tilt, which linear inflow misses by
up to 2°: its wake is laid again along the trim found, once.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

from rotor.aero.disk import NO_DELAY, without_stall
from rotor.aero.display import stalled_parts
from rotor.aero.elements import TrimState
from rotor.aero.inflow import inflow_model
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.problem import LOW_MACH, Problem, build_problem
from rotor.columns.trims import trim_of
from rotor.design.aircraft import FlightCondition, Stand
from rotor.design.design import Design
from rotor.design.quantities import CONDITION, STAND
from rotor.support.bytes_cache import bytes_cache
from rotor.trim.newton import DEFAULT_OPTIONS, Guess, SolverOptions, TrimResult, newton

FAST = 0.25
"""µ from which simple estimates are a better start than the trim along which the wake lies. Our choice."""
SLOWEST = 1e-4
"""Advance ratio at which flight has become hover: power is that of hover to 1e-5 (tested)."""
FOLLOWING_PASSES = 25
"""Evaluations of the blade elements in one step of continuation: steps that converge take 6 to 20 in nearly all cases,
and a shorter step costs less than more of them. Our choice."""
EASY_LOADING = 0.045
"""C_W/σ, and C_T/σ on a stand, of a light rotor, which trims wherever one does. Our choice."""
_NEARLY = SolverOptions(
    residual_tolerance=1e-4, torsion_tolerance=1e-4, inflow_tolerance=1e-2, slopes=False
)
"""To which the blade as built is trimmed as a start: each twist is solved to the end from there. Our choice."""
_FINEST_OF_REST = 0.1
"""Step of continuation over the way left below which it gives up: so small a step means that trims end. Our choice."""


def with_course(problem: Problem) -> Problem:
    """The problem with the course of its wake; itself where the inflow has none, and in hover."""
    course = found_course(problem.design)
    return problem if course is None else replace(problem, course=course)


def found_course(design: Design) -> WakeCourse | None:
    """The course of the wake of a design; None where the inflow has none or it is not found, and in hover."""
    found = _trim_of_wake(design)
    return None if found is None else found[0]


def _trim_of_wake(design: Design) -> tuple[WakeCourse, TrimState] | None:
    """The course of the wake, and the trim along which it lies; None as for `found_course`."""
    if design.hovering or inflow_model(design.models.inflow).wake_along is None:
        return None
    models = replace(
        design.models, elastic_twist=False, bending=False, tip_loss=True, hub_loss=True
    )
    return _linear_trim(replace(as_built(design), models=models))


@bytes_cache
def _linear_trim(design: Design) -> tuple[WakeCourse, TrimState] | None:
    """The trim of a design with linear inflow and sections that do not stall, and its course; None where it has none.

    With a largest lift, trims end or fold before those of the design itself do, and there the wake would jump. Reverse
    flow carries no load here.
    """
    problem = linear_problem(replace(design, models=replace(design.models, reverse_flow=False)))
    tables = without_stall(problem.disk, None if design.models.compressibility else LOW_MACH)
    result = trim(
        replace(problem, disk=replace(problem.disk, tables=tables, delay=NO_DELAY)),
        options=SolverOptions(slopes=False),
    )
    return (along(result, problem.course), result.state) if result.converged else None


def course_of(problem: Problem) -> WakeCourse | None:
    """The course that the inflow's wake lies on; None for other inflow models, and in hover."""
    lies = problem.inflow.wake_along is not None and not problem.design.hovering
    return problem.course if lies else None


def along(result: TrimResult, course: WakeCourse) -> WakeCourse:
    """The course along a trim.

    The thesis' trim leaves µ sin α out of U_P, and its α is that of the disk, not of the shaft, from which the blades
    flap. Its wake still lies below the disk that carries weight and drag: with µ_z = 0 it would stay among the blades.
    """
    problem, state, flow = result.problem, result.state, result.linear.elements.flow
    design, tilt = problem.design, state.shaft_tilt
    if not design.models.disk_axial_flow:
        tilt -= state.flap_1c
    mu_x, mu_z = design.in_disk_axes(tilt)
    return replace(
        course,
        mu_x=mu_x,
        mu_z=mu_z,
        lambda0=flow.lambda0,
        coning=state.coning,
        flap_1c=state.flap_1c,
        flap_1s=state.flap_1s,
    )


def trim_on_course(
    problem: Problem, start: Guess | None, options: SolverOptions, most_stalled: float = math.inf
) -> TrimResult:
    """`trim`, and of a free rotor once more with its wake along the trim found."""
    result = trim(problem, start, options, most_stalled)
    if (
        problem.design.models.trim != "free-rotor"
        or problem.inflow.wake_along is None
        or not result.converged
    ):
        return result
    again = trim(replace(problem, course=along(result, problem.course)), result.guess, options)
    return replace(again, passes=result.passes + again.passes)


def trim(
    problem: Problem,
    start: Guess | None = None,
    options: SolverOptions = DEFAULT_OPTIONS,
    most_stalled: float = math.inf,
) -> TrimResult:
    """Trim a forward-flight problem from a guess, or from simple estimates.

    Tries the warm start, then a cold start, then continuation from a lighter, slower rotor, as far as stalled sections
    carry no more than `most_stalled` of the lift's moment.
    """
    passes, of_start = 0, False
    best: TrimResult | None = None
    for guess in chain([] if start is None else [start], first_guesses(problem)):
        if best is not None and options.asked_to_stop:
            break
        result = newton(problem, guess, options)
        passes += result.passes
        if result.converged and not _hangs_under_its_wake(problem, result):
            return replace(result, passes=passes)
        result = replace(result, converged=False)
        # What a refusal says depends on the design alone: an attempt from the warm start counts if it is the only one.
        best = result if best is None or of_start or result.residual < best.residual else best
        of_start = guess is start
    assert best is not None
    if options.asked_to_stop:
        return replace(best, passes=passes)
    return _continue(problem, best, passes, options, most_stalled)


def trim_along(
    problem: Problem, options: SolverOptions = DEFAULT_OPTIONS, most_stalled: float = math.inf
) -> TrimResult | None:
    """The trim that belongs to those of easier conditions, whatever Newton's method finds; None where none is reached.

    Beyond the largest lift a rotor balances the same weight once more, deep in stall and at a multiple of the power.
    Continuation stays on the branch of attached flow, on which rotors fly.
    """
    hopeless = newton(problem, first_guess(problem), replace(options, max_passes=1))
    result = _continue(problem, replace(hopeless, converged=False), 1, options, most_stalled)
    return result if result.converged else None


def linear_problem(design: Design) -> Problem:
    """The design with the inflow along which its wake lies, and steady sections."""
    linear = inflow_model(design.models.inflow).wake_along
    assert linear is not None
    models = replace(design.models, inflow=linear, dynamic_stall=False, unsteady=False)
    return build_problem(replace(design, models=models))


def first_guesses(problem: Problem) -> Iterator[Guess]:
    """States from which the iteration begins, one after another: a free rotor has more than one equilibrium."""
    if (built := start_as_built(problem)) is not None:
        yield built
    yield from _simple_guesses(problem)
    if problem.design.models.trim == "free-rotor":
        guess = first_guess(problem)
        for share in (0.5, 1.7, 3.0):
            yield Guess(replace(guess.state, shaft_tilt=share * guess.state.shaft_tilt))


def as_built(design: Design) -> Design:
    """The design with the twist of the blade as built, which does not move."""
    return replace(design, twist=design.rotor.builtin_twist, active_twist=None, pitch_per_rev=())


def start_as_built(problem: Problem) -> Guess | None:
    """The trim of the blade as built at the condition of a problem, where a lifting line starts; None elsewhere."""
    design, free = problem.design, problem.design.models.trim == "free-rotor"
    if problem.inflow.wake_along is None or free or problem.freedoms or problem.air.joined:
        return None
    return _trim_as_built(as_built(design))


@bytes_cache
def _trim_as_built(design: Design) -> Guess | None:
    """From where all twists of a condition start, with factors that serve them all; None where it is not found."""
    problem = with_course(build_problem(design))
    results = (newton(problem, guess, _NEARLY) for guess in _simple_guesses(problem))
    return next((result.guess for result in results if result.converged), None)


def _simple_guesses(problem: Problem) -> Iterator[Guess]:
    slow = problem.design.condition.advance_ratio < FAST
    if slow and (near := _trim_of_wake(problem.design)) is not None:
        yield Guess(near[1])
    yield first_guess(problem)


def _hangs_under_its_wake(problem: Problem, result: TrimResult) -> bool:
    """Whether a free rotor with given collective was found at the equilibrium with negative thrust."""
    return problem.design.models.trim == "free-rotor" and result.thrust < 0.0


def first_guess(problem: Problem) -> Guess:
    """A state from momentum theory and mean blade angles."""
    design = problem.design
    mu = design.condition.advance_ratio
    ct = math.hypot(problem.weight, problem.drag)
    flow = problem.expected
    # C_T = ½σa(θ(1 + 3/2 µ²)/3 − λ/2) for an untwisted blade, a near 2π·0.95.
    collective = (
        3.0 * (2.0 * ct / (design.rotor.solidity * 5.9) + 0.5 * flow.axial) / (1.0 + 1.5 * mu**2)
    )
    coning = problem.flap.load_gain * 0.7 * ct - problem.flap.droop
    state = TrimState(
        collective=collective,
        shaft_tilt=math.atan2(problem.drag, problem.weight),
        coning=coning,
        lambda0=flow.lambda0,
    )
    stand = design.condition.stand
    if stand is not None:
        state = replace(state, shaft_tilt=math.atan2(flow.mu_z, flow.mu_x))
    if stand is not None and stand.collective is not None:
        state = replace(state, collective=stand.collective)
    if "cyclic_1c" in trim_of(design).unknowns:
        cyclic = {"cyclic_1s": -8.0 / 3.0 * mu * collective, "cyclic_1c": 4.0 / 3.0 * mu * coning}
        return Guess(
            replace(
                state, **cyclic, flap_1c=design.condition.flap_1c, flap_1s=design.condition.flap_1s
            )
        )
    return Guess(
        replace(state, flap_1c=-8.0 / 3.0 * mu * collective, flap_1s=-4.0 / 3.0 * mu * coning)
    )


def _easier(design: Design, t: float) -> Problem:
    """The design in the flight condition of `easier_condition`."""
    return build_problem(replace(design, condition=easier_condition(design, t)))


def easier_condition(design: Design, t: float) -> FlightCondition:
    """The condition between a light rotor in level flight at moderate speed (t = 0) and the wanted one (t = 1)."""
    condition = design.condition
    speed = condition.advance_ratio
    easy_speed = min(max(speed, 0.08), 0.2)
    if condition.stand is not None:
        return replace(
            condition,
            advance_ratio=easy_speed + t * (speed - easy_speed),
            stand=_easier_stand(condition.stand, design, t),
        )
    blade_loading = design.weight_coefficient / design.rotor.solidity
    easy_mass = min(
        condition.mass,
        max(EASY_LOADING * condition.mass / max(blade_loading, 1e-9), CONDITION["mass_kg"].low),
    )
    return replace(
        condition,
        advance_ratio=easy_speed + t * (speed - easy_speed),
        mass=easy_mass + t * (condition.mass - easy_mass),
        climb_speed=t * condition.climb_speed,
    )


def _easier_stand(stand: Stand, design: Design, t: float) -> Stand:
    """The stand on the way from a light rotor with little tilt (t = 0) to the wanted one (t = 1)."""
    if stand.shaft_tilt is not None and design.models.trim != "free-rotor":
        stand = replace(stand, shaft_tilt=stand.shaft_tilt * (0.3 + 0.7 * t))
    if stand.collective is not None:
        return stand
    wanted = min(design.weight_coefficient / design.rotor.solidity, STAND["ct_over_sigma"].high)
    easy = min(wanted, EASY_LOADING)
    return replace(stand, thrust=None, ct_over_sigma=easy + t * (wanted - easy))


def _continue(
    problem: Problem, best: TrimResult, passes: int, options: SolverOptions, most_stalled: float
) -> TrimResult:
    """The trim followed from an easier condition in adaptive steps; `best` where it ends on the way."""
    design = problem.design
    easy = _easier(design, 0.0)
    result = newton(easy, first_guess(easy), options)
    passes += result.passes
    if not result.converged:
        return replace(best, passes=passes)
    following = replace(options, max_passes=min(options.max_passes, FOLLOWING_PASSES))
    t, step = 0.0, 0.25
    latest, before = (0.0, result), None
    for _ in range(options.continuation_steps):
        if t >= 1.0 or step < max(options.smallest_continuation_step, _FINEST_OF_REST * (1.0 - t)):
            break
        if passes >= options.most_passes or options.asked_to_stop:
            break
        ahead = min(1.0, t + step)
        near = problem if ahead == 1.0 else _easier(design, ahead)
        guess = latest[1].guess
        if before is not None:
            guess = guess.ahead(before[1].guess, (ahead - t) / (t - before[0]))
        result = newton(near, replace(guess, box=None), following)
        passes += result.passes
        follows = result.converged and not _hangs_under_its_wake(near, result)
        if follows and (
            ahead == 1.0 or stalled_parts(near, result.linear.elements)[1] <= most_stalled
        ):
            before, latest, t = latest, (ahead, result), ahead
            step *= 1.7
        else:
            step *= 0.4
    if t >= 1.0:
        return replace(result, passes=passes, led=True)
    return replace(best, passes=passes)
