"""States, powers, fields, slopes and bands of many designs, to the bit."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .designs import all_designs
from .record import Record

NUMBERS = (
    "status", "message", "controls", "last_power", "hub_moment", "ct", "cp", "cq", "ct_over_sigma", "torque",
    "lift_and_drag", "residual", "passes", "freedom_states", "deflections", "reverse_flow_area", "stalled_area",
    "stalled_thrust", "stalled_moment", "least_margin", "caveats", "elastic", "figure_of_merit",
    "induced_power_factor", "lift_to_drag", "blade_frequencies", "disk",
)  # fmt: skip
"""What is read of every solution."""
FIELDS = ("fz", "fx", "inflow", "theta", "u_t", "u_p", "u_r", "rate", "swirl")
"""Fields over the disk: of each the gradient of a weighted sum is asked."""
WEIGHTED = (
    "as built", "hover", "slow", "bent", "thesis", "2/rev twist", "tunnel, tilted", "inflow local-momentum",
    "without dynamic-stall",
)  # fmt: skip
"""Designs of which gradients of weighted fields are asked."""
LOADED = ("bent", "bent, linear", "fast", "hart2", "bo105")
"""Designs of which hub loads are asked: each takes a trim with every inflow model."""
OTHER_MODELS = ("as built", "hover", "tunnel, tilted")
"""Designs that are solved with every other model."""


def write(record: Record) -> None:
    """Every design's own answers, then those of pairs and of steps."""
    solved = dict[str, Any]()
    for name, arguments in all_designs().items():
        analysis = keep_solution(record, name, arguments)
        if analysis is not None and analysis.solution.converged:
            solved[name] = analysis
            record.scenario(f"{name}/slopes", keep_derived, name, analysis)
    for name, other in (
        ("as built", "inflow drees"),
        ("hover", "hover, linear"),
        ("twist linear:-8", "twist builtin"),
    ):
        record.ask(f"{name} > {other}/doubt", "rotor.doubt", solved[other], against=solved[name])
    for name in OTHER_MODELS:
        record.ask(f"{name}/doubt with models", "rotor.doubt", solved[name], models=True)
    for name in LOADED:
        record.ask(f"{name}/hub loads", "rotor.hub_loads", solved[name])
    for name in WEIGHTED:
        record.scenario(f"{name}/weighted", keep_weighted_gradients, name, solved[name])
    record.scenario("steps", keep_steps)


def keep_solution(record: Record, name: str, arguments: Mapping[str, Any]) -> Any:
    """The analysis of a design, with all that is read of its solution kept; None where there is no design."""
    design = record.make(f"{name}/design", "rotor.make_design", **arguments)
    if design is None:
        return None
    record.keep(f"{name}/design", str(design))
    record.keep(f"{name}/file", design.to_dict())
    analysis = record.make(f"{name}/solution", "rotor.trim.solve.analyse", design)
    if analysis is None:
        return None
    for number in NUMBERS:
        record.ask_attribute(f"{name}/{number}", analysis.solution, number)
    record.keep(f"{name}/printed", repr(analysis.solution))
    record.ask(f"{name}/record", "rotor.solution_record", analysis.solution)
    return analysis


def keep_derived(record: Record, name: str, analysis: Any) -> None:
    """Keep the loads along a blade, the gradients of power, and how uncertain inputs change it."""
    record.ask(f"{name}/distribution", "rotor.distribution", analysis.solution)
    for objective in ("total", "induced"):
        record.ask(f"{name}/gradient of {objective}", "rotor.power_gradient", analysis, objective)
    changes = record.make(
        f"{name}/changes", "rotor.trim.power_changes.power_changes", analysis.adjoint
    )
    if changes is not None:
        record.keep(f"{name}/changes", changes)
    record.ask(f"{name}/doubt", "rotor.doubt", analysis)


def keep_weighted_gradients(record: Record, name: str, analysis: Any) -> None:
    """Keep the gradient by pitch of a weighted sum of each field over the disk; the weights are drawn once."""
    shape = analysis.adjoint.problem.disk.shape
    for field in FIELDS:
        weights = np.random.default_rng(1).normal(size=shape)
        measure = record.make(
            f"{name}/weighted {field}", "rotor.trim.adjoint.ElementSlopes", **{field: weights}
        )
        if measure is not None:
            record.ask(
                f"{name}/weighted {field}",
                "rotor.trim.adjoint.Adjoint.by_pitch",
                analysis.adjoint,
                measure,
            )


def keep_steps(record: Record) -> None:
    """Keep trims that each start from the one before, as those of a slider do, and from its direction."""
    last = None
    for k, mu in enumerate((0.2, 0.21, 0.22, 0.25, 0.1, 0.05, 0.0, 0.15)):
        design = record.make(f"step {k}", "rotor.make_design", mu=mu, twist="linear:-10")
        last = record.make(f"step {k}", "rotor.solve", design, last)
        if last is not None:
            record.keep(f"step {k}/power", last.last_power)
            record.keep(f"step {k}/passes", last.passes)
            record.keep(f"step {k}/controls", last.controls)
