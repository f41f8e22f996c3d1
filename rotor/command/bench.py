"""`bench`: times of evaluations, trims, searches and studies, beside scipy's root and dynbem."""

import argparse
import importlib
import json
import os
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.optimize import root  # pyright: ignore[reportMissingTypeStubs, reportUnknownVariableType]

from rotor.aero.elements import Problem, build_problem, evaluate_elements
from rotor.command.common import add_command
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import CONCEPTS, find_concept
from rotor.optimisation.objective import WeightedCondition
from rotor.optimisation.schedule import Plan, run_plan
from rotor.optimisation.search import Search, run_search
from rotor.study.chunks import evaluate_points
from rotor.study.point import trim_of
from rotor.study.study_file import read_study
from rotor.trim.adjoint import power_gradient
from rotor.trim.equations import residuals, unknowns_of
from rotor.trim.forward import first_guess
from rotor.trim.newton import Guess, newton
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

TARGETS_S = {
    "optimum, two segments": 1.0,
    "optimum, three segments, 16 starts": 5.0,
    "schedule, 15 conditions, 8 concepts": 60.0,
}
"""Targets of the project [s], flight preset, one core for an optimum, two for the schedule."""

_SEARCH_ADVANCE_RATIOS = (0.1, 0.2, 0.3)


def measure_searches(*, long: bool) -> dict[str, float]:
    """Seconds by name; mean over three advance ratios, bands included. `long` adds the schedule."""
    figures: dict[str, float] = {}
    for name, concept, starts in (
        ("optimum, two segments", "two-segment", 6),
        ("optimum, three segments, 16 starts", "three-segment", 16),
    ):
        elapsed = 0.0
        for mu in _SEARCH_ADVANCE_RATIOS:
            design = make_design(preset="flight", mu=mu)
            solve(design)  # Builds the grid and the wake once, as an open page has done.
            elapsed += run_search(Search(design, find_concept(concept), starts=starts)).elapsed
        figures[name] = elapsed / len(_SEARCH_ADVANCE_RATIOS)
    if long:
        design = make_design(preset="flight")
        ratios = [0.0, *(0.05 + 0.025 * k for k in range(1, 15))]
        conditions = tuple(WeightedCondition(replace(design.condition, advance_ratio=mu)) for mu in ratios)
        begin = time.perf_counter()
        run_plan(Plan(design, tuple(CONCEPTS.values()), conditions), processes=min(2, os.cpu_count() or 1))
        figures["schedule, 15 conditions, 8 concepts"] = time.perf_counter() - begin
    return figures


TARGET_PER_SECOND = 55.0
"""10⁵ trims with the dynamic wake on two cores in 15 minutes."""
_POINTS = 200


def measure_batch() -> dict[str, float]:
    """Trims a second of processor time, one core; the middle of the shipped study of 10⁵ sampled trims."""
    study = read_study("hundred_thousand.toml").study
    first = study.chunks // 2 * study.chunk
    designs = [trim_of(values, study) for values in study.values(first, first + _POINTS)]
    return {
        "each by itself": _points_per_second(lambda: [solve(design) for design in designs]),
        "as a study works them off": _points_per_second(lambda: evaluate_points(study, first, first + _POINTS)),
    }


def _points_per_second(call: Callable[[], Any]) -> float:
    begin = time.process_time()
    call()
    return _POINTS / (time.process_time() - begin)


TARGETS_MS = {
    "evaluation": 0.5,
    "trim, cold": 5.0,
    "trim, warm": 2.0,
    "dynamic wake, cold": 10.0,
    "dynamic wake, warm": 6.0,
}
"""Targets of the project [ms], 40 × 120, on a laptop-class core; linear inflow where nothing else is said."""

_ADVANCE_RATIOS = (0.1, 0.15, 0.2, 0.25, 0.3, 0.35)


def add_parser(commands: Any) -> None:
    """Register the command."""
    parser = add_command(commands, "bench", "time evaluations and trims beside scipy's root and dynbem")
    parser.add_argument("--long", action="store_true", help="time a schedule of all concepts as well, about a minute")
    parser.add_argument("--json", action="store_true", help="machine-readable output")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Exit code 0: targets are printed, not enforced."""
    figures, notes = measure()
    searches = measure_searches(long=args.long)
    batch = measure_batch()
    if args.json:
        answer = {
            "ms": figures, "targets_ms": TARGETS_MS, "seconds": searches, "targets_s": TARGETS_S,
            "trims_per_second_and_core": batch, "target_per_second": TARGET_PER_SECOND, "notes": notes,
        }  # fmt: skip
        print(json.dumps(answer, indent=2, allow_nan=False))
        return 0
    print("median milliseconds, 40 × 120, flight preset, mean of µ 0.10…0.35; inflow linear unless named\n")
    for name, value in figures.items():
        target = f"   target ≤ {TARGETS_MS[name]:g}" if name in TARGETS_MS else ""
        print(f"{name:<34}{value:10.3f}{target}")
    print("\nseconds, preset's own inflow\n")
    for name, value in searches.items():
        print(f"{name:<38}{value:6.2f}   target ≤ {TARGETS_S[name]:g}")
    print("\ntrims a second and core (processor time), dynamic wake, sampled over speed, weight, altitude and twist\n")
    for name, value in batch.items():
        print(f"{name:<38}{value:6.0f}   target ≥ {TARGET_PER_SECOND:g}")
    print()
    cold = figures["trim, cold"]
    for name, value in figures.items():
        if "hybr" in name or ("dynbem" in name and "trim" in name):
            print(f"{name} takes {value / cold:.0f} × our cold trim")
    for note in notes:
        print(f"note: {note}", file=sys.stderr)
    return 0


def measure() -> tuple[dict[str, float], list[str]]:
    """Figures [ms] by name, and notes on what could not be measured."""
    linear, wake = _cases("pitt-peters"), _cases("dynamic-wake")
    problems = [build_problem(design) for design in linear.designs]
    passes = [newton(problem, first_guess(problem)).elements for problem in problems]
    figures = {
        "evaluation": _mean(lambda k: evaluate_elements(problems[k], passes[k].state), 50),
        "trim, cold": _mean(lambda k: solve(linear.designs[k]), 15),
        "trim, warm": _mean(lambda k: solve(linear.nearby[k], linear.solutions[k]), 15),
        "hover, cold": _time(lambda: solve(make_design(preset="flight", mu=0.0)), 15),
        "dynamic wake, cold": _mean(lambda k: solve(wake.designs[k]), 15),
        "dynamic wake, warm": _mean(lambda k: solve(wake.nearby[k], wake.solutions[k]), 15),
        "gradient by twist, dynamic wake": _mean(lambda k: power_gradient(wake.solutions[k]), 15),
        "trim, scipy hybr, no Jacobian": _mean(lambda k: _hybr(problems[k], first_guess(problems[k])), 3),
    }
    notes: list[str] = []
    try:
        figures |= _dynbem(linear.designs[2])
    except ImportError:
        notes.append("dynbem is not installed: pip install 'rotor-explorer[test]' adds that baseline")
    return figures, notes


@dataclass(frozen=True, eq=False)
class _Cases:
    """Designs over speed, their solutions, and the designs one slider step away."""

    designs: list[Design]
    nearby: list[Design]
    solutions: list[Solution]


def _cases(inflow: str) -> _Cases:
    def at(mu: float, twist: str) -> Design:
        design = make_design(preset="flight", twist=twist, mu=mu)
        return replace(design, models=replace(design.models, inflow=inflow))

    designs = [at(mu, "linear:-16") for mu in _ADVANCE_RATIOS]
    nearby = [at(mu + 0.002, "linear:-15.5") for mu in _ADVANCE_RATIOS]
    return _Cases(designs, nearby, [solve(design) for design in designs])


def _hybr(problem: Problem, start: Guess) -> None:
    """The same residual through scipy's Powell hybrid method with finite differences."""
    unknowns = unknowns_of(problem.design.models)

    def residual(x: Any) -> Any:
        state = replace(start.state, **dict(zip(unknowns, x.tolist(), strict=True)))
        return residuals(problem, evaluate_elements(problem, state))

    root(residual, start.state.array(unknowns), method="hybr", tol=1e-10)


def _dynbem(design: Design) -> dict[str, float]:
    """dynbem (MIT, Rust): one evaluation of its Pitt–Peters model, and its trim of the hub moments by cyclic."""
    dynbem: Any = importlib.import_module("dynbem")

    main, mu = design.rotor, design.condition.advance_ratio
    alpha = np.radians(np.arange(-180.0, 180.5, 1.0))
    polar = dynbem.TabulatedPolar(alpha, 1.1 * np.sin(2 * alpha), 0.01 + 1.2 * np.sin(alpha) ** 2)
    stations = np.linspace(main.blade.root_cutout, 1.0, 20)
    twisted = {
        "r_stations_m": list(stations * main.radius),
        "chord_stations_m": [main.reference_chord] * len(stations),
        "twist_stations_deg": list(-16.0 * (stations - 0.75)),
    }
    blade = dynbem.BladeGeometry(
        main.blades, main.radius, main.blade.root_cutout * main.radius, main.reference_chord, 0.0, 40, **twisted
    )
    definition = dynbem.RotorDefinition(
        blade,
        dynbem.LinearPolarParameters(0.1, 6.0, 0.009, 12.0),
        control=dynbem.ControlProperties(swashplate_pitch_gain_rad=1.0),
    )
    model = dynbem.PittPetersModel(definition, polar, 120)
    inputs = dynbem.RotorInputs(
        collective_rad=0.15, tilt_lon=0.0, tilt_lat=0.0, R_hub=np.eye(3),
        v_hub_world=np.array([mu * main.tip_speed, 0.0, 0.0]), wind_world=np.zeros(3),
        omega_rad_s=main.angular_speed, rho_kg_m3=design.condition.density,
    )  # fmt: skip
    state = dynbem.PittPetersRotorState(0.01, 0.0, 0.0)
    return {
        "dynbem evaluation": _time(lambda: model.compute_forces(inputs, state), 50),
        "dynbem cyclic trim": _time(
            lambda: dynbem.solve_trim_cyclic(model, state, inputs, tilt_min=-0.26, tolerance_Nm=10.0),
            3,
        ),
    }


def _mean(call: Callable[[int], Any], runs: int) -> float:
    return statistics.fmean(_time(lambda k=k: call(k), runs) for k in range(len(_ADVANCE_RATIOS)))


def _time(call: Callable[[], Any], runs: int) -> float:
    """Median milliseconds of a call, one warm-up first."""
    call()
    times: list[float] = []
    for _ in range(runs):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return 1e3 * statistics.median(times)
