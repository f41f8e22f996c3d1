"""From a `Design` to a `Solution`: hover or trim, then power by parts, areas, caveats and message."""

import math
import time
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from rotor.aero.display import areas, as_asked, unsteady_part
from rotor.aero.elements import BladeElements
from rotor.aero.problem import Problem
from rotor.aero.section import stall_margins
from rotor.blas_threads import one_blas_thread
from rotor.columns.blade import Freedom
from rotor.columns.flight import check_freedoms, disk_sums
from rotor.design.design import Design, require_design
from rotor.engine.waves import wave_grid
from rotor.trim.forward import course_of, first_guess, trim_along, trim_on_course
from rotor.trim.hover import hover
from rotor.trim.hub_loads import hub_loads
from rotor.trim.low_speed import trim_problem
from rotor.trim.newton import DEFAULT_OPTIONS, Guess, SolverOptions, TrimResult, newton
from rotor.trim.power import control_loads, hub_moment, power_budget, wind_forces
from rotor.trim.solution import DiskFields, ElasticTwist, Solution, Status
from rotor.trim.validity import caveats, failure_sentence, implausible, vortex_ring

SUSPECT_STALL = 0.25
"""Part of the disk. Trims of attached flow end at about this share; those beyond the largest lift have 0.4 or more."""

_ENERGY = 1e-6
"""Part of main-rotor power that may be missing where there are further freedoms. Our choice: trims close to 1e-7."""


@one_blas_thread()
def solve(
    design: Design, start: Solution | Guess | None = None, options: SolverOptions = DEFAULT_OPTIONS, *,
    freedoms: Sequence[Freedom] = (),
) -> Solution:  # fmt: skip
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
    begin = time.perf_counter()
    if not isinstance(start, Solution | Guess | None):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(f"start is {start!r:.80}: give an earlier solution or leave it out")
    problem = trim_problem(require_design(design), freedoms)
    if freedoms:
        check_freedoms(problem)
    if vortex_ring(design):  # There is no steady wake: a state near it.
        once = replace(DEFAULT_OPTIONS, max_passes=1)
        near = hover(problem) if design.hovering else newton(problem, first_guess(problem), once)
        return _assemble(replace(near, converged=False), begin)
    guess = _guess(design, start) if isinstance(start, Solution) else start
    result = (hover if design.hovering else trim_on_course)(problem, guess, options)
    solution = _assemble(result, begin)
    if _may_be_of_another_branch(solution, result) and not options.asked_to_stop:
        other = trim_along(problem, options)
        if other is not None:
            return _least(solution, _assemble(replace(other, passes=result.passes + other.passes), begin))
    return solution


def _may_be_of_another_branch(solution: Solution, result: TrimResult) -> bool:
    """Whether forward flight closes with so much stall, or so implausibly, that it may not be the trim of least power.

    Free of charge for every other design.
    """
    flight = not solution.design.hovering and solution.design.condition.stand is None
    return flight and result.converged and (solution.stalled_area > SUSPECT_STALL or not solution.converged)


def _least(one: Solution, other: Solution) -> Solution:
    """That of two solutions which converged with the lesser power."""
    if not one.converged or not other.converged:
        return other if other.converged else one
    return other if other.power.total < one.power.total else one


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
    work, said = (1e-3 * own * design.power_unit for own in (total.motion, total.damping))
    if result.converged and problem.freedoms and 1e3 * abs(work - said) > _ENERGY * abs(power.main_rotor):
        raise ValueError(
            f"The air gives the motion of the blades {work:.4g} kW, and the freedoms' power says {said:.4g} kW: make "
            "their columns, equations and power agree."
        )
    moment = hub_moment(problem, elements)
    lift, drag = wind_forces(elements, total)
    newtons = design.thrust_unit
    reverse, stalled, stalled_thrust = areas(shown[0].disk, shown[1], fields.stall_margin, fields.unsteady)
    converged = result.converged
    message = "Trimmed."
    if not converged:
        message = vortex_ring(design) or failure_sentence(design, result.reached, _stalled(result, stalled))
    if converged and (refused := implausible(problem, elements, total)):
        converged, message = False, refused
    elastic, climb = _elastic(problem, elements, shown), design.condition.climb_speed
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
        caveats=tuple(caveats(problem, total, fields, stalled, moment, power, elastic)) if converged else (),
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
        elastic=elastic,
        start=result.guess,
        wake_course=course_of(problem),
        linear=result.linear,
        freedoms=problem.freedoms,
        freedom_states={str(name): float(x[states[name]]) for own in problem.freedoms for name in own.states},
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


def _fields(problem: Problem, elements: BladeElements) -> DiskFields:
    disk, e = problem.disk, elements
    return DiskFields(
        r=disk.r,
        dr=disk.dr,
        psi=disk.psi,
        theta=e.theta,
        u_t=e.u_t,
        u_p=e.u_p,
        induced=e.induced,
        inflow=e.induced + e.flow.mu_z,
        alpha=e.alpha,
        mach=e.mach,
        cl=e.cl,
        cd=e.cd,
        cd_mach=e.cd_mach,
        stall_margin=stall_margins(e.alpha, e.mach, e.u_t, disk.section, disk.weight, disk.offset, disk.stall),
        dct=e.fz,
        dcq=e.fx,
        elastic_twist=e.torsion.twist if e.torsion is not None else None,
        unsteady=unsteady_part(problem, e),
    )


def _stalled(result: TrimResult, last: float) -> float:
    """Stalled part of the disk at the nearest trim found; without one `last`, in the last attempt."""
    if result.nearest is None:
        return last
    problem, elements = as_asked(result.nearest.problem, result.nearest.linear.elements)
    fields = _fields(problem, elements)
    return areas(problem.disk, elements, fields.stall_margin, fields.unsteady)[1]
