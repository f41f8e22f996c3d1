"""`warm`: compiles all kernels ahead."""

import argparse
from functools import partial
from typing import Any

import numpy as np

from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.problem import build_problem
from rotor.columns.flight import flight_system
from rotor.command.common import add_command
from rotor.design.quantities import PRESETS
from rotor.engine.linearise import jacobian
from rotor.files.make_design import make_design
from rotor.support.compiled import compiled_in_parallel, log_compiling, why_not_kept
from rotor.trim.analysis import power_gradient
from rotor.trim.solve import analyse, solve


def add_parser(commands: Any) -> None:
    add_command(
        commands,
        "warm",
        run,
        "Compile and keep all kernels; else each command compiles what it needs.",
    )


def run(_: argparse.Namespace) -> int:
    log_compiling()
    compile_all()
    unkept = why_not_kept()
    print(unkept or "All kernels are compiled.")
    return 1 if unkept else 0


def compile_lags() -> None:
    """Compile dynamic stall and its memory alone, which do not call the section and are not called by it."""
    system = flight_system(build_problem(make_design(mu=0.2)))
    channels = np.repeat(system.grid.steady[:, :, None], system.grid.waves.azimuths, axis=2)
    assert system.memory is not None
    factors = system.memory(channels, system.grid.data)
    factors.transposed(np.zeros((len(factors.left), *channels.shape[1:])))
    factors.by_inputs(system.grid.waves)


lags_beside = partial(
    compiled_in_parallel,
    compile_lags,
    "rotor.aero.dynamic_stall",
    "rotor.aero.stalling_section",
    "rotor.engine.memory",
)
"""Within, a second process compiles what `compile_lags` does: nearly half of all."""


def compile_all() -> None:
    """Compile every kernel of the solver: both presets in flight and hover, blades that bend, stall with lags."""
    with lags_beside():
        for preset in PRESETS:
            for advance_ratio in (0.2, 0.0):
                power_gradient(solve(make_design(preset=preset, mu=advance_ratio)))
        for name in (name for name, model in INFLOW_MODELS.items() if not model.pointwise):
            power_gradient(solve(make_design(mu=0.2, inflow=name)))
        bent = analyse(make_design(mu=0.2, bending=True))
        power_gradient(bent)
        jacobian(bent.adjoint.point)  # As Newton's method needs it far from a solution.
