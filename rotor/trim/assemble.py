"""From where Newton's method ended to a `Solution`: power by parts and message; areas, fields, caveats when read."""

import math
import time
from dataclasses import replace
from functools import partial

import numpy as np

from rotor.aero.display import at_display_azimuths, regions, stalled_parts
from rotor.aero.elements import BladeElements
from rotor.aero.problem import Problem
from rotor.aero.section import stall_margins
from rotor.aero.unsteady_section import apparent
from rotor.columns.bending import coordinates_of
from rotor.columns.flight import disk_sums
from rotor.design.design import Design
from rotor.engine.waves import wave_grid
from rotor.support.blas_threads import one_blas_thread
from rotor.support.units import power_text
from rotor.trim.analysis import Analysis
from rotor.trim.forward import course_of
from rotor.trim.low_speed import axial_ring, vortex_ring
from rotor.trim.newton import TrimResult
from rotor.trim.power import PowerBudget, control_loads, hub_moment, power_budget, wind_forces
from rotor.trim.solution import Deflections, DiskFields, ElasticTwist, Shown, Solution, Status
from rotor.trim.validity import CaveatInputs, caveats, failure_sentence, implausible

_ENERGY_TOLERANCE = 1e-6
"""Part of main-rotor power that may be missing where there are further freedoms. Our choice: trims close to 1e-7."""


def assemble(result: TrimResult, begin: float) -> Analysis:
    """The solution, with its equations, of a trim that began at `begin` [s] of `time.perf_counter`.

    ValueError where the equations and `power` of further freedoms contradict their columns.
    """
    problem, design, elements = result.problem, result.problem.design, result.linear.elements
    x, states = result.point.x, result.point.system.structure.states
    total = disk_sums(result.linear.point)
    power = power_budget(problem, elements, total)
    work, freed = (1e-3 * matrix * design.power_unit for matrix in (total.motion, total.damping))
    if (
        result.converged
        and problem.freedoms
        and 1e3 * abs(work - freed) > _ENERGY_TOLERANCE * abs(power.main_rotor)
    ):
        raise ValueError(
            f"The air does {work:.4g} kW of work on the moving blades, but the freedoms report {freed:.4g} kW: make "
            "their columns, equations and power agree."
        )
    lift, drag = wind_forces(elements, total)
    newtons = design.thrust_unit
    refused = (
        _refused(result) or implausible(problem, elements, total) or _impossible(design, power)
    )
    solution = Solution(
        design=design,
        status=Status.NOT_CONVERGED if refused else Status.CONVERGED,
        message=refused or "Trimmed.",
        controls=elements.state,
        last_power=power,
        hub_moment=hub_moment(problem, elements),
        ct=total.thrust,
        lift_and_drag=(lift * newtons, drag * newtons),
        cp=power.main_rotor / (newtons * design.rotor.tip_speed),
        residual=result.residual,
        passes=result.passes,
        elapsed=time.perf_counter() - begin,
        find_shown=shown_of,
        evaluated=(problem, elements),
        start=result.guess,
        wake_course=course_of(problem),
        freedoms=problem.freedoms,
        deflections=_deflections(result),
        freedom_states={
            str(name): float(x[states[name]])
            for freedom in problem.freedoms
            for name in freedom.states
        },
    )
    return Analysis(solution, result.linear)


def evaluated(solution: Solution) -> tuple[Problem, BladeElements]:
    """The problem and the blade elements on the azimuths of the trim; a light solution is evaluated once more."""
    if solution.evaluated is not None:
        return solution.evaluated
    linear = Analysis(solution).linear
    return linear.problem, linear.elements


@one_blas_thread()
def shown_of(solution: Solution) -> Shown:
    """What is shown of a solution, from its blade elements, or from its equations evaluated once more."""
    problem, elements = evaluated(solution)
    asked = at_display_azimuths(problem, elements)
    fields = _fields(*asked)
    seen = regions(asked[0].disk, asked[1])
    shown = Shown(fields, seen, _elastic(problem, elements, asked))
    if not solution.converged:
        return shown
    return replace(shown, caveats=tuple(caveats(CaveatInputs(problem, solution, shown))))


def _refused(result: TrimResult) -> str:
    """Why there is no trim, as a sentence."""
    if not result.steady:
        return axial_ring(result.problem.design)
    if result.converged:
        return ""
    design = result.problem.design
    stalled = stalled_parts(result.problem, result.linear.elements)[0]
    return vortex_ring(design) or failure_sentence(design, stalled)


def _impossible(design: Design, power: PowerBudget) -> str:
    """Why no flight needs this power, as a sentence."""
    climb = design.vertical_speed
    if (
        design.condition.stand is not None
        or (0.0 if climb >= 0.0 else -math.inf) < power.main_rotor < math.inf
    ):
        return ""
    return (
        f"Not trimmed: the trim found needs {power_text(power.main_rotor)}, impossible in "
        f"{'a climb' if climb else 'level flight'}; lower the advance ratio or the mass."
    )


def _elastic(
    problem: Problem, elements: BladeElements, shown: tuple[Problem, BladeElements]
) -> ElasticTwist | None:
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


def _deflections(result: TrimResult) -> Deflections | None:
    bending, point, state = (
        result.problem.bending,
        result.linear.point,
        result.linear.elements.state,
    )
    if bending is None:
        return None
    q, _ = coordinates_of(bending, point.system.structure, point.z)
    q = q.copy()
    q[bending.first, 0] -= bending.precone
    r, up, forward = (one[..., ::20] for one in (bending.r, bending.along[0], bending.along[3]))
    up = up.T @ q
    up[:, 0] += bending.precone * (r - r[0])
    flapping = np.array([state.coning, state.flap_1c, state.flap_1s])
    up[:, : min(3, up.shape[1])] -= np.outer(r - r[0], flapping)[:, : up.shape[1]]
    radius = result.problem.design.rotor.radius
    return Deflections(r, radius * up, radius * (forward.T @ q))


def _fields(problem: Problem, elements: BladeElements) -> DiskFields:
    disk, e = problem.disk, elements
    return DiskFields(
        r=disk.r,
        dr=disk.dr,
        psi=disk.psi,
        **{
            name: getattr(e, name)
            for name in (
                "theta",
                "u_t",
                "u_p",
                "u_r",
                "induced",
                "alpha",
                "mach",
                "cl",
                "cd",
                "cd_mach",
            )
        },
        inflow=e.induced + e.flow.mu_z,
        stall_margin=stall_margins(e.alpha, e.mach, e.u_t, disk.weight, disk.offset, disk.stall),
        dct=e.fz,
        dcq=e.fx,
        dcr=e.fr,
        elastic_twist=e.torsion.twist if e.torsion is not None else None,
        unsteady=e.unsteady,
        find_apparent=partial(apparent, e, problem.half_chord) if problem.unsteady else None,
    )
