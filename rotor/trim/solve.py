"""From a `Design` to a `Solution`: hover or trim, then power by parts, areas, caveats and the sentence."""

import math
import time

from rotor.aero import kernel
from rotor.aero.elements import (
    COLLECTIVE,
    CONING,
    CYCLIC_1C,
    CYCLIC_1S,
    FLAP_1C,
    FLAP_1S,
    LAMBDA0,
    SHAFT_TILT,
    Pass,
    Problem,
    lay_out,
)
from rotor.aero.sums import sums
from rotor.blas_threads import one_blas_thread
from rotor.design.design import Design, require_design
from rotor.trim.forward import guess_of, trim
from rotor.trim.hover import HoverResult, hover
from rotor.trim.newton import Guess, TrimResult
from rotor.trim.power import hub_moment, power_budget
from rotor.trim.solution import Controls, DiskFields, Solution, Status
from rotor.trim.validity import caveats, failure_sentence


@one_blas_thread()
def solve(design: Design, start: Solution | Guess | None = None) -> Solution:
    """Trim the design; `start` is any earlier solution to begin from, or a guess made from several.

    Always returns: a design that does not trim comes back with `Status.NOT_CONVERGED` and one sentence.
    """
    begin = time.perf_counter()
    problem = lay_out(require_design(design))
    if not isinstance(start, Solution | Guess | None):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(f"start is {start!r:.80}: give an earlier solution or leave it out")
    guess = _guess(design, start) if isinstance(start, Solution) else start
    if design.hovering:
        ended: HoverResult | TrimResult = hover(problem, None if guess is None else float(guess.state[COLLECTIVE]))
    else:
        ended = trim(problem, guess)
    return _assemble(problem, ended, begin)


def _guess(design: Design, earlier: Solution) -> Guess | None:
    """What an earlier solution offers: nothing when it did not converge, or hovered and this one flies."""
    if not earlier.converged or (earlier.design.hovering and not design.hovering):
        return None
    return guess_of(earlier)


def _assemble(problem: Problem, ended: HoverResult | TrimResult, begin: float) -> Solution:
    design, one = problem.design, ended.last
    total = sums(problem, one)
    fields = _fields(problem, one)
    power = power_budget(problem, one)
    moment = hub_moment(problem, one)
    area = _areas(problem, fields)
    converged = ended.converged
    message = "Trimmed." if converged else failure_sentence(design, ended.reached, area["stalled"])
    if converged and not 0.0 < power.main_rotor < math.inf:
        converged = False
        message = (
            f"The trim found takes {power.main_rotor / 1e3:.0f} kW, which no level flight can: "
            "lower the advance ratio or the weight."
        )
    return Solution(
        design=design,
        status=Status.CONVERGED if converged else Status.NOT_CONVERGED,
        message=message,
        caveats=caveats(problem, one, area["stalled"], moment) if converged else (),
        controls=_controls(one),
        disk=fields,
        last_power=power,
        hub_moment=moment,
        ct=total.thrust,
        cp=power.main_rotor / design.power_unit,
        reverse_flow_area=area["reverse"],
        stalled_area=area["stalled"],
        residual=ended.residual,
        passes=ended.passes,
        elapsed=time.perf_counter() - begin,
    )


def _fields(problem: Problem, one: Pass) -> DiskFields:
    disk, loads = problem.disk, one.loads
    return DiskFields(
        r=disk.r,
        dr=disk.dr,
        psi=disk.psi,
        theta=one.theta,
        u_t=one.u_t,
        u_p=one.u_p,
        induced=one.induced,
        inflow=one.induced + one.flow.mu_z,
        alpha=loads[kernel.ALPHA],
        mach=loads[kernel.MACH],
        cl=loads[kernel.CL],
        cd=loads[kernel.CD],
        cd_mach=loads[kernel.CD_MACH],
        stall_margin=kernel.stall_margins(
            loads[kernel.ALPHA], loads[kernel.MACH], one.u_t, disk.section, disk.weight, disk.offset, disk.stall
        ),
        dct=loads[kernel.FZ],
        dcq=loads[kernel.FX],
    )


def _areas(problem: Problem, fields: DiskFields) -> dict[str, float]:
    """Reverse-flow and stalled parts of πR²."""
    disk = problem.disk
    ring = 2.0 * disk.r[:, None] * disk.dr / len(disk.psi)
    reverse = fields.u_t < 0.0
    return {
        "reverse": float((ring * reverse).sum()),
        "stalled": float((ring * ((fields.stall_margin < 0.0) & ~reverse)).sum()),
    }


def _controls(one: Pass) -> Controls:
    state = [float(value) for value in one.state]
    return Controls(
        collective=state[COLLECTIVE],
        cyclic_1c=state[CYCLIC_1C],
        cyclic_1s=state[CYCLIC_1S],
        shaft_tilt=state[SHAFT_TILT],
        coning=state[CONING],
        flap_1c=state[FLAP_1C],
        flap_1s=state[FLAP_1S],
        lambda0=state[LAMBDA0],
    )
