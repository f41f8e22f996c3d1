"""From a `Design` to a `Solution`: hover or trim, then power by parts, areas, caveats and the sentence."""

import math
import time

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, build_problem
from rotor.aero.sums import disk_sums
from rotor.blas_threads import one_blas_thread
from rotor.design.design import Design, require_design
from rotor.trim.forward import guess_of, trim
from rotor.trim.hover import HoverResult, hover
from rotor.trim.newton import Guess, TrimResult
from rotor.trim.options import DEFAULT_OPTIONS, SolverOptions
from rotor.trim.power import hub_moment, power_budget
from rotor.trim.solution import DiskFields, Solution, Status
from rotor.trim.validity import caveats, failure_sentence


@one_blas_thread()
def solve(design: Design, start: Solution | Guess | None = None, options: SolverOptions = DEFAULT_OPTIONS) -> Solution:
    """Trim the design; `start` is any earlier solution, or a guess, from which the iteration begins.

    Always returns: a design that does not trim comes back with `Status.NOT_CONVERGED` and one sentence.
    """
    begin = time.perf_counter()
    if not isinstance(start, Solution | Guess | None):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(f"start is {start!r:.80}: give an earlier solution or leave it out")
    problem = build_problem(require_design(design))
    guess = _guess(design, start) if isinstance(start, Solution) else start
    if design.hovering:
        result: HoverResult | TrimResult = hover(problem, guess.state.collective if guess else None, options)
    else:
        result = trim(problem, guess, options)
    return _assemble(problem, result, begin)


def _guess(design: Design, earlier: Solution) -> Guess | None:
    """The trim of an earlier solution; None when it did not converge, or hovered and this design does not."""
    if not earlier.converged or (earlier.design.hovering and not design.hovering):
        return None
    return guess_of(earlier)


def _assemble(problem: Problem, result: HoverResult | TrimResult, begin: float) -> Solution:
    design, elements = problem.design, result.elements
    total = disk_sums(problem, elements)
    fields = _fields(problem, elements)
    power = power_budget(problem, elements)
    moment = hub_moment(problem, elements)
    area = _areas(problem, fields)
    converged = result.converged
    message = "Trimmed." if converged else failure_sentence(design, result.reached, area["stalled"])
    if converged and not 0.0 < power.main_rotor < math.inf:
        converged = False
        message = (
            f"The trim found takes {power.main_rotor / 1e3:.0f} kW, which is impossible in level flight: "
            "lower the advance ratio or the mass."
        )
    return Solution(
        design=design,
        status=Status.CONVERGED if converged else Status.NOT_CONVERGED,
        message=message,
        caveats=caveats(problem, elements, area["stalled"], moment) if converged else (),
        controls=elements.state,
        disk=fields,
        last_power=power,
        hub_moment=moment,
        ct=total.thrust,
        cp=power.main_rotor / design.power_unit,
        reverse_flow_area=area["reverse"],
        stalled_area=area["stalled"],
        residual=result.residual,
        passes=result.passes,
        elapsed=time.perf_counter() - begin,
    )


def _fields(problem: Problem, elements: BladeElements) -> DiskFields:
    disk, loads = problem.disk, elements.loads
    return DiskFields(
        r=disk.r,
        dr=disk.dr,
        psi=disk.psi,
        theta=elements.theta,
        u_t=elements.u_t,
        u_p=elements.u_p,
        induced=elements.induced,
        inflow=elements.induced + elements.flow.mu_z,
        alpha=loads[kernel.ALPHA],
        mach=loads[kernel.MACH],
        cl=loads[kernel.CL],
        cd=loads[kernel.CD],
        cd_mach=loads[kernel.CD_MACH],
        stall_margin=kernel.stall_margins(
            loads[kernel.ALPHA], loads[kernel.MACH], elements.u_t, disk.section, disk.weight, disk.offset, disk.stall
        ),
        dct=loads[kernel.FZ],
        dcq=loads[kernel.FX],
    )


def _areas(problem: Problem, fields: DiskFields) -> dict[str, float]:
    """Reverse-flow and stalled parts of πR²."""
    disk = problem.disk
    cell = 2.0 * disk.r[:, None] * disk.dr / len(disk.psi)
    reverse = fields.u_t < 0.0
    return {
        "reverse": float((cell * reverse).sum()),
        "stalled": float((cell * ((fields.stall_margin < 0.0) & ~reverse)).sum()),
    }
