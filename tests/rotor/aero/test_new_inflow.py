"""A further inflow model is one file and one line: here a table of harmonics, whose numbers are made up."""

import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.aero.inflow import INFLOW_MODELS, DiskFlow
from rotor.aero.inflow.harmonic import HarmonicInflow
from rotor.aero.inflow.linear import MODELS
from rotor.design import LinearTwist
from rotor.design.quantities import LossOn
from rotor.trim import SolverOptions, power_gradient
from rotor.trim.doubt import other_models
from rotor.trim.hub_loads import band_inflows

NAME, FILE = "printed-table", "printed_table"
TEXT = '''"""The first and second harmonic of the inflow at five radii and four angles of the wake."""

import math

import numpy as np
from scipy.interpolate import PchipInterpolator

from rotor.aero.inflow.harmonic import HarmonicInflow
from rotor.engine.waves import wave_number

RADII, ANGLES = (0.0, 0.3, 0.6, 0.9, 1.0), np.radians([0.0, 45.0, 75.0, 90.0])
TABLE = np.array([
    [[0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0]],
    [[0.0, 0.1, 0.2, 0.4, 0.5], [0.0, 0.0, 0.02, 0.06, 0.08]],
    [[0.0, 0.2, 0.5, 0.8, 0.9], [0.0, 0.01, 0.05, 0.12, 0.15]],
    [[0.0, 0.3, 0.7, 1.1, 1.2], [0.0, 0.02, 0.08, 0.2, 0.25]],
])
"""By angle, harmonic and radius."""


class PrintedTable(HarmonicInflow):
    name, title, explanation = "printed-table", "Printed table", "Two harmonics."
    usual = in_index_band = True
    columns = [(wave_number(h, sine=False), str(k)) for h in (1, 2) for k in range(len(RADII))]

    def along(self, r):
        return {str(k): np.interp(r, RADII, row) for k, row in enumerate(np.eye(len(RADII)))}

    def gains(self, flow):
        return PchipInterpolator(ANGLES, TABLE)(math.atan2(flow.mu_x, abs(flow.axial))).ravel()


MODELS = (PrintedTable(),)
'''
COMMANDS = f"""
import sys
from rotor.aero.inflow import INFLOW_MODELS
sys.path.append(sys.argv[1])
import printed_table
INFLOW_MODELS["{NAME}"] = printed_table.MODELS[0]
from explorer.model.inputs import INFLOW_MENUS, Inputs
from rotor.__main__ import main
assert INFLOW_MENUS["inflow"]["{NAME}"] == "Printed table"
assert Inputs(inflow="{NAME}").design().models.inflow == "{NAME}"
sys.exit(main(["solve", "--mu", "0.2", "--inflow", "{NAME}", "--elements", "12", "--azimuths", "24"]))
"""


@pytest.fixture
def table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[HarmonicInflow]:
    """The model, from its file."""
    (tmp_path / f"{FILE}.py").write_text(TEXT, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    (model,) = import_module(FILE).MODELS
    assert isinstance(model, HarmonicInflow)
    monkeypatch.setitem(INFLOW_MODELS, NAME, model)
    yield model
    del sys.modules[FILE]


@pytest.mark.parametrize("loss_on", ["lift", "inflow"])
def test_a_table_of_harmonics_trims_and_has_its_harmonics_and_an_exact_gradient(
    table: HarmonicInflow, loss_on: LossOn
):
    """Harmonics: means over the azimuth. Gradient of power by twist: differences of trims, solved to 1e-13."""
    rate, step, tight = np.radians(-11.0), 2e-5, SolverOptions(residual_tolerance=1e-13)
    off = "tip-loss,hub-loss" if loss_on == "lift" else None
    made = make_design(mu=0.2, inflow=NAME, elements=20, azimuths=48, loss_on=loss_on, off=off)
    at = [
        solve(made.with_twist(LinearTwist(rate + k * step)), options=tight).require()
        for k in (-1, 0, 1)
    ]
    low, middle, high = at
    disk, state = middle.disk, middle.controls
    flow = DiskFlow(*made.in_disk_axes(state.shaft_tilt), state.lambda0)
    gains = np.asarray(table.gains(flow)).reshape(2, -1)
    mean = disk.induced.mean(axis=1)
    if loss_on == "lift":
        assert_allclose(mean, state.lambda0, rtol=1e-12)
    else:  # λ_i/F: all harmonics grow alike.
        assert mean[-1] > 1.1 * state.lambda0
    for h, k in enumerate(gains, start=1):
        found = 2.0 * (disk.induced * np.cos(h * disk.psi)).mean(axis=1)
        assert_allclose(
            found, mean * np.interp(disk.r, (0.0, 0.3, 0.6, 0.9, 1.0), k), rtol=1e-8, atol=1e-12
        )
    gradient = power_gradient(middle)
    exact = gradient.along((gradient.r - 0.75)[None])[0]
    assert_allclose(
        exact, (high.power.total - low.power.total) / (2.0 * step), atol=1e-6 * middle.power.total
    )


def test_differences_have_the_slopes_that_linear_models_have_by_hand():
    for flow in (
        DiskFlow(0.002, 0.0, 0.055),
        DiskFlow(0.1, 0.01, 0.03),
        DiskFlow(0.4, -0.01, 0.02),
    ):
        for model in MODELS:
            assert_allclose(
                HarmonicInflow.strengths(model, flow), model.strengths(flow), rtol=1e-8, atol=1e-9
            )


@pytest.mark.usefixtures("table")
def test_bands_ask_the_models():
    assert NAME in band_inflows()
    assert f"inflow {NAME}" in other_models(make_design(mu=0.2))
    assert f"inflow {NAME}" not in other_models(make_design(mu=0.0))  # It does not answer the load.


def test_commands_and_the_page_take_the_file(tmp_path: Path):
    (tmp_path / f"{FILE}.py").write_text(TEXT, encoding="utf-8")
    words = [sys.executable, "-c", COMMANDS, str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert NAME in done.stdout
