"""Tables that a spreadsheet reads: named with units, with their provenance, and adding up to the page's power."""

import csv
import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.charts.plots import SWEEP, PowerCurve
from explorer.export.provenance import blade_csv, disk_csv, power_csv
from explorer.model.inputs import Inputs, baseline_of
from rotor.trim.solve import solve

SOLUTION = solve(Inputs(advance_ratio=0.3).design())
BASELINE = baseline_of(SOLUTION.design)


def read(content: bytes) -> tuple[list[str], dict[str, np.ndarray]]:
    """Comments, and columns by name; NaN for what is empty."""
    lines = content.decode("utf-8").splitlines()
    comments = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    assert {len(row) for row in rows} == {len(rows[0])}
    values = np.array([[float(cell) if cell else math.nan for cell in row] for row in rows[1:]])
    return comments, {name: values[:, k] for k, name in enumerate(rows[0])}


def test_disk_holds_every_field_and_adds_up_to_thrust_and_power():
    asked = SOLUTION.design
    solution = solve(replace(asked, models=replace(asked.models, azimuths=24)))  # As solved.
    comments, columns = read(disk_csv(solution))
    disk, design = solution.disk, solution.design
    assert all("[" in name and name.endswith("]") for name in columns)
    assert len(columns["r/R [-]"]) == disk.cl.size
    for name in ("u_t", "u_p", "induced", "inflow", "mach", "cl", "cd", "cd_mach", "dct", "dcq"):
        assert_allclose(columns[f"{name} [-]"], getattr(disk, name).ravel(), rtol=1e-8, atol=1e-12)
    for name in ("theta", "alpha", "stall_margin"):
        assert_allclose(
            columns[f"{name} [deg]"], np.degrees(getattr(disk, name)).ravel(), rtol=1e-8, atol=1e-12
        )
    width = (
        np.repeat(disk.dr, len(disk.psi))
        * design.rotor.radius
        / len(disk.psi)
        * design.rotor.blades
    )
    assert columns["thrust per blade [N/m]"] @ width == pytest.approx(
        solution.ct * design.thrust_unit, rel=1e-7
    )
    assert columns["power per blade [W/m]"] @ width == pytest.approx(solution.power.shaft, rel=1e-7)
    assert f"segments:{-14},{-8}@0.5" in comments[0]
    assert any("advance ratio 0.3, 8322 kg, 0 m" in line for line in comments)
    assert any("rotor explorer" in line and "NumPy" in line for line in comments)


def test_caveats_are_in_the_comments():
    slow = solve(Inputs(advance_ratio=0.04).design())
    comments, _ = read(disk_csv(slow))
    assert any(line == f"# caveat: {slow.caveats[0].sentence}" for line in comments)


def test_the_blade_is_what_the_charts_show():
    _, columns = read(blade_csv(SOLUTION, BASELINE, 270.0))
    design = SOLUTION.design
    assert_allclose(
        columns["built-in twist [deg]"], np.degrees(design.twist(SOLUTION.disk.r)), rtol=1e-7
    )
    reverse = SOLUTION.disk.u_t[:, 90] <= 0.0  # 270° of 120 azimuths.
    assert reverse.any()
    assert_allclose(np.isnan(columns["alpha [deg]"]), reverse)
    assert_allclose(
        columns["alpha [deg]"][~reverse], np.degrees(SOLUTION.disk.alpha[~reverse, 90]), atol=1e-6
    )
    assert_allclose(columns["cl [-]"], SOLUTION.disk.cl[:, 90], rtol=1e-7)


def test_power_leaves_what_is_not_known_empty():
    known = np.linspace(900.0, 1500.0, len(SWEEP))
    holes = known.copy()
    holes[[3, -1]] = math.nan
    content = power_csv(SOLUTION, BASELINE, PowerCurve(known, known + 10.0, holes))
    _, columns = read(content)
    assert_allclose(columns["mu [-]"], SWEEP)
    assert_allclose(columns["total power [kW]"], known)
    assert_allclose(columns["power with ideal lift [kW]"], holes)
    assert b"nan" not in content.lower()
    assert columns["speed [kt]"][-1] == pytest.approx(
        SWEEP[-1] * SOLUTION.design.rotor.tip_speed * 3600 / 1852
    )


def test_a_hovering_rotor_has_the_same_columns():
    hover = solve(
        replace(SOLUTION.design, condition=replace(SOLUTION.design.condition, advance_ratio=0.0))
    )
    assert read(disk_csv(hover))[1].keys() == read(disk_csv(SOLUTION))[1].keys()
    assert b"nan" not in disk_csv(hover).lower()
