"""Random designs over everything that can be asked for.

Each is solved from a cold start, from a trim of a neighbour, and its residual is evaluated anew.
"""

import math
import re
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

import numpy as np

from rotor import Design, Solution, make_design, solve
from rotor.columns.flight import flight_system
from rotor.columns.hover import hover_system
from rotor.design.quantities import PRESETS
from rotor.engine.linearise import evaluate
from rotor.files.rotor_file import shipped_aircraft
from rotor.support.assets import MEASURED_ROTORS, SHIPPED_ROTORS
from rotor.support.blas_threads import one_blas_thread
from rotor.trim import Analysis
from rotor.trim.hover import _error
from rotor.trim.newton import DEFAULT_OPTIONS, _errors
from rotor.trim.validity import MOST_STALLED

SAME = 1e-6
"""Largest relative difference of power between a cold and a warm start."""
TRIMMABLE = 0.08, 0.40
"""C_W/σ and µ within which level flight must trim from the first attempt: see tests/rotor/trim/test_robustness.py."""


def draw(random: np.random.Generator, rotor: str) -> dict[str, Any]:
    """Arguments of `make_design`: rotor, preset, twist, speed, load, climb, n/rev inputs, stand, bending."""
    craft = shipped_aircraft(rotor)
    tested = craft.isolated or random.random() < 0.1
    # A stand needs the axial flow of the tilted disk.
    preset = PRESETS[int(not tested and random.random() < 0.2)]
    mu = 0.0 if random.random() < 0.1 else round(float(random.uniform(0.0005, 0.45)), 4)
    rate, break_at = (
        round(float(x), 3) for x in (random.uniform(-20.0, 5.0), random.uniform(0.3, 0.8))
    )
    twists = [
        None,
        f"linear:{rate}",
        f"segments:{rate},{round(float(random.uniform(-20.0, 5.0)), 3)}@{break_at}",
    ]
    asked: dict[str, Any] = {
        "rotor": rotor,
        "preset": preset,
        "mu": mu,
        "twist": twists[int(random.integers(3))],
    }
    if tested:
        trim = ("wind-tunnel", "wind-tunnel", "free-rotor", "controls")[int(random.integers(4))]
        trim = "wind-tunnel" if mu == 0.0 else trim
        tilt, load = (
            round(float(random.uniform(-10.0, 10.0)), 2),
            round(float(random.uniform(0.02, 0.11)), 4),
        )
        given = {"collective_deg": round(float(random.uniform(2.0, 12.0)), 2)}
        if trim != "controls" and random.random() < 0.7:
            given = {"ct_over_sigma": load}
        if mu > 0.0 and trim != "free-rotor":
            given["shaft_tilt_deg"] = tilt
        asked |= {"trim": trim, "stand": given}
    else:
        asked["mass_kg"] = round(craft.mass * float(random.uniform(0.6, 1.25)), 1)
        asked["altitude_m"] = round(float(random.uniform(0.0, 4000.0)), 1)
        if preset == "flight" and random.random() < 0.4:
            asked["climb_m_s"] = round(float(random.uniform(-10.0, 10.0)), 2)
    if preset == "flight":
        for name in ("pitch_per_rev", "twist_per_rev"):
            if random.random() < 0.2:
                n, size = int(random.integers(2, 7)), round(float(random.uniform(0.0, 2.0)), 2)
                asked[name] = f"{n}:{size}:{int(random.integers(360))}"
        structure = craft.rotor.blade.structure
        if (
            structure is not None
            and structure.flap_stiffness
            and not tested
            and random.random() < 0.3
        ):
            asked["bending"] = True
        if random.random() < 0.3:
            asked["inflow"] = ("pitt-peters", "drees", "local-momentum", "lifting-line")[
                int(random.integers(4))
            ]
    return {key: value for key, value in asked.items() if value is not None}


RIGHT = {"trimmed", "refused", "at the limit", "in deep stall"}
"""Kinds of outcomes that are none of a mistake."""
FIRST = 0.98
"""Part of plain level flights that the first attempt has to trim."""


@dataclass(frozen=True)
class Outcome:
    """What became of one design."""

    asked: dict[str, Any]
    kind: str
    """trimmed; refused, with its sentence; at the limit: refused from a cold start with a sentence that says how far
    trims were found, trimmed from a neighbour; in deep stall: two trims; or what is wrong."""
    said: str = ""
    first: bool = True
    """The first attempt finds the trim: no other start, continuation or branch is needed."""
    plain: bool = False
    """Level flight within `TRIMMABLE`."""
    stalled: float = 0.0
    """Part of the lift's moment from stalled sections, of the solution or where it ended."""


def try_design(asked: dict[str, Any]) -> Outcome:
    """Solve one design every way."""
    try:
        return _tried(asked, make_design(**asked))
    except Exception as error:
        return Outcome(asked, "crash", f"{type(error).__name__}: {error}")


def _tried(asked: dict[str, Any], design: Design) -> Outcome:
    tries: list[int] = []
    solution = solve(design, options=replace(DEFAULT_OPTIONS, stop=lambda: bool(tries.append(1))))
    plain = _plain(design)
    first = not tries or _same(
        solution, solve(design, options=replace(DEFAULT_OPTIONS, stop=lambda: True))
    )
    if said := wrong(solution):
        return Outcome(asked, "wrong", said, first, plain, solution.stalled_moment)
    mu = design.condition.advance_ratio
    neighbour = (
        solve(design.at(mu=max(0.97 * mu, mu - 0.01)))
        if mu
        else solve(design.with_twist("linear:-9"))
    )
    warm = solve(design, neighbour)
    stalled = max(solution.stalled_moment, warm.stalled_moment)
    kind, said = "trimmed", ""
    if solution.converged != warm.converged:
        kind = "at the limit" if "of the disk is stalled" in solution.message else "other status"
        said = f"cold {solution.message} warm {warm.message}"
    elif not solution.converged:
        kind, said = "refused", solution.message
    elif not _same(solution, warm):
        kind = "in deep stall" if stalled > MOST_STALLED else "other power"
        said = (
            f"cold {solution.last_power.main_rotor:.3f} W, warm {warm.last_power.main_rotor:.3f} W"
        )
    return Outcome(asked, kind, said, first, plain, stalled)


def _same(one: Solution, other: Solution) -> bool:
    """Whether both trimmed, with the same power."""
    power, scale = (
        one.last_power.main_rotor,
        max(abs(one.last_power.main_rotor), one.last_power.profile),
    )
    return (
        one.converged
        and other.converged
        and abs(power - other.last_power.main_rotor) <= SAME * scale
    )


def _plain(design: Design) -> bool:
    condition = design.condition
    if (
        condition.stand is not None
        or condition.climb_speed
        or design.pitch_per_rev
        or design.active_twist
    ):
        return False
    loading = design.weight_coefficient / design.rotor.solidity
    return loading <= TRIMMABLE[0] and condition.advance_ratio <= TRIMMABLE[1]


def wrong(solution: Solution) -> str:
    """What no solution may be: not finite, not closed, without a sentence; nothing where all is well."""
    message = solution.message
    if (
        not message.endswith(".")
        or "\n" in message
        or re.search(r"\bnan\b|\binf\b", message.lower())
    ):
        return f"message {message!r}"
    for caveat in solution.caveats:
        if not caveat.sentence.endswith(".") or "\n" in caveat.sentence:
            return f"caveat {caveat.sentence!r}"
    if not solution.converged:
        return "" if message.startswith("Not trimmed:") else f"message {message!r}"
    if message != "Trimmed.":
        return f"message {message!r}"
    for name in (*(field.name for field in fields(solution.disk)), "apparent"):
        if name in ("unsteady", "find_apparent"):  # A value of its own arrays, and no value.
            continue
        values = getattr(solution.disk, name)
        if values is not None and not np.isfinite(values).all():
            return f"{name} is not finite"
    numbers = [
        *asdict(solution.last_power).values(),
        *(getattr(solution.controls, f.name) for f in fields(solution.controls)),
    ]
    if not all(math.isfinite(value) for value in numbers if isinstance(value, float)):
        return "a power or a control is not finite"
    return _open(solution)


def _open(solution: Solution) -> str:
    """The equations built anew and evaluated at the solution; nothing where they hold."""
    problem, options = Analysis(solution).linear.problem, DEFAULT_OPTIONS
    if problem.design.hovering:
        system = hover_system(problem)
        point = evaluate(system, system.grid, Analysis(solution).linear.point.x)
        stand = problem.design.condition.stand
        given = stand is not None and stand.collective is not None  # Then no thrust is to be met.
        thrust = 0.0 if given else abs(float(point.residual[0]))
        error = max(thrust / problem.scale, _error(point, problem, 0 if given else 1))
        return "" if error <= 2.0 * options.accepted_hover else f"hover is open by {error:.1e}"
    system = flight_system(problem)
    point = evaluate(system, system.grid, Analysis(solution).linear.point.x)
    trim, elastic, inflow = _errors(point, options)
    held = max(trim, elastic) <= options.accepted_residual and inflow <= options.accepted_inflow
    return "" if held else f"open by {trim:.1e}, torsion {elastic:.1e}, inflow {inflow:.1e}"


def run(count: int, seed: int) -> list[Outcome]:
    """`count` designs, all rotors in turn; the same for the same seed."""
    random, rotors = np.random.default_rng(seed), (*SHIPPED_ROTORS, *MEASURED_ROTORS)
    with one_blas_thread():
        return [try_design(draw(random, rotors[k % len(rotors)])) for k in range(count)]


def share(outcomes: list[Outcome]) -> float:
    """Part of the plain level flights that the first attempt trims."""
    chosen = [one for one in outcomes if one.plain]
    return sum(one.kind == "trimmed" and one.first for one in chosen) / max(len(chosen), 1)
