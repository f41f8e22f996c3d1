"""From a `Design` to a `Solution`: hover or trim, then power by parts, areas, caveats and message."""

import math
import time
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from scipy.optimize import brentq

from rotor.aero.display import areas, as_asked, stalled_parts
from rotor.aero.elements import BladeElements
from rotor.aero.problem import Problem
from rotor.aero.section import stall_margins
from rotor.aero.unsteady_section import apparent
from rotor.blas_threads import one_blas_thread
from rotor.columns.blade import Freedom
from rotor.columns.flight import check_freedoms, disk_sums
from rotor.design.design import Design, require_design
from rotor.design.quantities import CONDITION
from rotor.engine.waves import wave_grid
from rotor.trim.forward import FOLLOWING_PASSES, course_of, easier_condition, first_guess, trim_along, trim_on_course
from rotor.trim.hover import hover
from rotor.trim.hub_loads import hub_loads
from rotor.trim.low_speed import trim_problem, vortex_ring
from rotor.trim.newton import DEFAULT_OPTIONS, Guess, SolverOptions, TrimResult, newton
from rotor.trim.power import control_loads, hub_moment, power_budget, wind_forces
from rotor.trim.solution import DiskFields, ElasticTwist, Solution, Status
from rotor.trim.validity import MOST_STALLED, Trimmed, caveats, failure_sentence, implausible, stalled_sentence

_WITHIN = 0.02
"""How near the largest mass and speed are found, as a part of the way to them."""
_NO_TRIM = 2.0 * MOST_STALLED
"""Stalled part of the thrust that stands for no trim there."""
_SLOW = 0.15
"""Advance ratio from which the largest speed is looked for: the least power is near it."""

_ENERGY = 1e-6
"""Part of main-rotor power that may be missing where there are further freedoms. Our choice: trims close to 1e-7."""


@one_blas_thread()
def solve(
    design: Design,
    start: Solution | Guess | None = None,
    options: SolverOptions = DEFAULT_OPTIONS,
    *,
    freedoms: Sequence[Freedom] = (),
) -> Solution:
    """Trim a design: the controls, inflow and blade motion at which forces and moments balance.

    Parameters:
        design: what is trimmed, as `make_design` makes it.
        start: an earlier solution, or a guess, from which the iteration begins. The answer does not depend on it.
        options: limits of the iteration.
        freedoms: of the blade, beside those of the design, in forward flight with blades that do not bend.

    Returns:
        The trim of least power where there are several. A design that does not trim comes back as well, with
        `Status.NOT_CONVERGED` and one sentence in `message`.

    Raises:
        TypeError: a design, a start or a freedom is of another type.
        ValueError: there can be no freedoms here, or their equations and `power` contradict their columns.

    Example:
        >>> trim = rotor.solve(rotor.make_design(twist="linear:-8", mu=0.2))
        >>> trim.converged
        True
        >>> 0.0 < trim.power.induced < trim.power.main_rotor < trim.power.total  # [W]
        True
    """
    if not isinstance(start, Solution | Guess | None):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(f"start is {start!r:.80}: give an earlier solution or leave it out")
    return _refused(_once(require_design(design), start, options, freedoms), options)


def _limit(problem: Problem) -> float:
    """Stalled part of the thrust beyond which trims do not count."""
    by_document = problem.disk.fit_range is not None or problem.design.models.document_losses
    return math.inf if by_document else MOST_STALLED


def _refused(solution: Solution, options: SolverOptions) -> Solution:
    """The solution, without power where stalled sections carry more of the thrust than on rotors that were measured."""
    if solution.linear is None or not solution.converged or solution.design.hovering:
        return solution
    if solution.stalled_thrust <= _limit(solution.linear.problem):
        return solution
    sentence = stalled_sentence(solution.design, solution.stalled_thrust, *_largest(solution, options))
    return replace(solution, status=Status.NOT_CONVERGED, message=sentence, caveats=())


def _largest(solution: Solution, options: SolverOptions) -> tuple[float | None, float | None]:
    """Mass and advance ratio to which the trim can be followed with no more of the thrust stalled; None where not."""
    condition = solution.design.condition
    if condition.stand is not None:
        return None, None
    easy = easier_condition(solution.design, 0.0)
    slow = min(easy.advance_ratio, _SLOW)
    wanted = {"mass_kg": (easy.mass, condition.mass), "mu": (slow, condition.advance_ratio)}
    mass, mu = (_reach(solution, name, *ends, options) for name, ends in wanted.items())
    return mass, mu


def _stalled_thrust(result: TrimResult) -> float:
    """Stalled part of the thrust of a trim; of none, too much."""
    return stalled_parts(result.problem, result.linear.elements)[1] if result.converged else _NO_TRIM


def _reach(solution: Solution, name: str, easy: float, wanted: float, options: SolverOptions) -> float | None:
    """How far from an easy value of a quantity towards the one wanted it trims; None where not even there."""
    freedoms, few = solution.freedoms, replace(options, max_passes=FOLLOWING_PASSES)

    def problem_at(value: float) -> Problem:
        return trim_problem(CONDITION[name].put(solution.design, value), freedoms)

    if easy >= wanted:
        return None
    result = trim_on_course(problem_at(easy), None, options)
    if _stalled_thrust(result) > MOST_STALLED:
        return None
    trims = {easy: result}

    def too_much(value: float) -> float:
        """Stalled part of the thrust over what counts; what is wanted has too much, and so has what does not trim."""
        near = trims[max(trims)]
        if value == easy:
            return _stalled_thrust(near) - MOST_STALLED
        if value == wanted or options.asked_to_stop:
            return _NO_TRIM - MOST_STALLED
        ahead = newton(problem_at(value), replace(near.guess, factors=None), few)
        share = _stalled_thrust(ahead)
        if share <= MOST_STALLED:
            trims[value] = ahead
        return share - MOST_STALLED

    brentq(too_much, easy, wanted, xtol=_WITHIN * abs(wanted - easy), rtol=_WITHIN)
    return max(trims)


def _once(
    design: Design, start: Solution | Guess | None, options: SolverOptions, freedoms: Sequence[Freedom]
) -> Solution:
    """The trim of least power, however much is stalled."""
    begin = time.perf_counter()
    problem = trim_problem(design, freedoms)
    if freedoms:
        check_freedoms(problem)
    if vortex_ring(design):  # There is no steady wake: a state near it.
        once = replace(DEFAULT_OPTIONS, max_passes=1)
        near = hover(problem) if design.hovering else newton(problem, first_guess(problem), once)
        return _assemble(replace(near, converged=False), begin)
    guess = _guess(design, start) if isinstance(start, Solution) else start
    if design.hovering:
        return _assemble(hover(problem, guess, options), begin)
    result = trim_on_course(problem, guess, options, _limit(problem))
    solution = _assemble(result, begin)
    # With so much stall, or so implausible, it may not be the trim of least power.
    doubtful = solution.stalled_thrust > MOST_STALLED or not solution.converged
    if design.condition.stand is not None or not (result.converged and doubtful):
        return solution
    return _least_of_branches(solution, _limit(problem), options)


def _least_of_branches(solution: Solution, most_stalled: float, options: SolverOptions) -> Solution:
    """The trim of least power of a solution and the trim that belongs to those of easier conditions."""
    if solution.linear is None or options.asked_to_stop:
        return solution
    other = trim_along(solution.linear.problem, options, most_stalled)
    if other is None:
        return solution
    begin = time.perf_counter() - solution.elapsed
    other = _assemble(replace(other, passes=solution.passes + other.passes), begin)
    if not solution.converged or not other.converged:
        return other if other.converged else solution
    return other if other.power.total < solution.power.total else solution


def _guess(design: Design, earlier: Solution) -> Guess | None:
    """The trim of an earlier solution; None when it did not converge, or hovered and this design does not."""
    if not earlier.converged or (earlier.design.hovering and not design.hovering):
        return None
    return earlier.start


def _assemble(result: TrimResult, begin: float) -> Solution:
    problem, design, elements = result.problem, result.problem.design, result.linear.elements
    x, states = result.point.x, result.point.system.structure.states
    total = disk_sums(result.linear.point)
    shown = as_asked(problem, elements)
    fields = _fields(*shown)
    power = power_budget(problem, elements, total)
    work, said = (1e-3 * matrix * design.power_unit for matrix in (total.motion, total.damping))
    if result.converged and problem.freedoms and 1e3 * abs(work - said) > _ENERGY * abs(power.main_rotor):
        raise ValueError(
            f"The air gives the motion of the blades {work:.4g} kW, and the freedoms' power says {said:.4g} kW: make "
            "their columns, equations and power agree."
        )
    moment = hub_moment(problem, elements)
    lift, drag = wind_forces(elements, total)
    newtons = design.thrust_unit
    reverse, stalled, stalled_thrust = areas(shown[0].disk, shown[1], fields.stall_margin)
    converged = result.converged
    message = "Trimmed."
    if not converged:
        message = vortex_ring(design) or failure_sentence(design, result.reached, _stalled(result, stalled))
    if converged and (refused := implausible(problem, elements, total)):
        converged, message = False, refused
    trimmed = Trimmed(
        problem, total, fields, stalled, moment, power, _elastic(problem, elements, shown), elements.state
    )
    climb = design.condition.climb_speed
    least = 0.0 if climb >= 0.0 else -math.inf
    if converged and design.condition.stand is None and not least < power.main_rotor < math.inf:
        converged = False
        message = (
            f"Not trimmed: the trim found needs {power.main_rotor / 1e3:.0f} kW, impossible in "
            f"{'a climb' if climb else 'level flight'}; lower the advance ratio or the mass."
        )
    return Solution(
        design=design,
        status=Status.CONVERGED if converged else Status.NOT_CONVERGED,
        message=message,
        caveats=tuple(caveats(trimmed)) if converged else (),
        controls=elements.state,
        disk=fields,
        last_power=power,
        hub_moment=moment,
        ct=total.thrust,
        lift_and_drag=(lift * newtons, drag * newtons),
        cp=power.main_rotor / (newtons * design.rotor.tip_speed),
        reverse_flow_area=reverse,
        stalled_area=stalled,
        stalled_thrust=stalled_thrust,
        residual=result.residual,
        passes=result.passes,
        elapsed=time.perf_counter() - begin,
        elastic=trimmed.elastic,
        start=result.guess,
        wake_course=course_of(problem),
        linear=result.linear,
        freedoms=problem.freedoms,
        freedom_states={str(name): float(x[states[name]]) for freedom in problem.freedoms for name in freedom.states},
        find_hub_loads=partial(hub_loads, solve=solve),
    )


def _elastic(problem: Problem, elements: BladeElements, shown: tuple[Problem, BladeElements]) -> ElasticTwist | None:
    """shown: both on the azimuths of the solution."""
    structure = problem.design.rotor.blade.structure
    if problem.torsion is None or elements.torsion is None or structure is None:
        return None
    coordinates, torsion = elements.torsion.coordinates, problem.torsion
    moment, power = control_loads(*shown)
    if shown[0] is not problem:
        _, power = control_loads(problem, elements)
    return ElasticTwist(
        coordinates=coordinates,
        shapes=torsion.radial,
        frequencies=torsion.frequency,
        tip=coordinates.sum(axis=0) @ wave_grid(torsion.functions, len(shown[0].disk.psi)).at,
        along_blade=elements.torsion.twist.mean(axis=1),
        control_moment=moment,
        pitch_link_load=moment / structure.pitch_horn,
        control_power=power * problem.design.power_unit,
    )


_SHOWN = ("theta", "u_t", "u_p", "induced", "alpha", "mach", "cl", "cd", "cd_mach")
"""Fields of `DiskFields` that are those of the blade elements."""


def _fields(problem: Problem, elements: BladeElements) -> DiskFields:
    disk, e = problem.disk, elements
    return DiskFields(
        r=disk.r,
        dr=disk.dr,
        psi=disk.psi,
        **{name: getattr(e, name) for name in _SHOWN},
        inflow=e.induced + e.flow.mu_z,
        stall_margin=stall_margins(e.alpha, e.mach, e.u_t, disk.section, disk.weight, disk.offset, disk.stall),
        dct=e.fz,
        dcq=e.fx,
        elastic_twist=e.torsion.twist if e.torsion is not None else None,
        unsteady=e.unsteady,
        find_apparent=partial(apparent, e, problem.half_chord) if problem.unsteady else None,
    )


def _stalled(result: TrimResult, last: float) -> float:
    """Stalled part of the disk at the nearest trim found; without one `last`, in the last attempt."""
    if result.nearest is None:
        return last
    return stalled_parts(result.nearest.problem, result.nearest.linear.elements)[0]
