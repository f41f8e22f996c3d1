"""The ideal bound: the command reproduces the shipped table, and no trimmed rotor is below it."""

import csv
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

from rotor.__main__ import main
from rotor.assets import asset_path
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.ideal_bound import find_bound, ideal_factor, not_bounded
from rotor.trim.solve import solve


def rows(path: Path) -> list[dict[str, str]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@pytest.mark.slow
def test_the_command_reproduces_the_asset(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    path = tmp_path / "bound.csv"
    assert main(["ideal", "--mu", "0.3", "--mass-kg", "8322.4", "--csv", str(path)]) == 0
    capsys.readouterr()
    made = rows(path)[0]
    shipped = next(r for r in rows(asset_path("ideal_bound.csv")) if r["mu"] == "0.3" and r["mass_kg"] == "8322.4")
    assert list(made) == list(shipped)
    assert_allclose([float(v) for v in made.values()], [float(v) for v in shipped.values()], rtol=2e-3)


def test_too_slow_is_one_sentence(capsys: pytest.CaptureFixture[str]):
    assert main(["ideal", "--mu", "0:0.1:0.05"]) == 2
    assert "too low" in capsys.readouterr().err


def test_more_freedom_never_increases_the_bound():
    bound = find_bound(make_design(mu=0.2))
    assert 1.0 < bound.any_circulation < bound.lift_limited < bound.steady_twist < bound.linear_twist


@pytest.mark.parametrize("mu", [0.1, 0.2, 0.3])
def test_no_trimmed_blade_is_below_the_bound(mu: float):
    solution = solve(make_design(mu=mu, twist="linear:-14")).require()
    assert not_bounded(solution.design) == ""
    factor = ideal_factor(mu, solution.ct)
    assert factor is not None
    assert solution.induced_power_factor > factor


@pytest.mark.parametrize(
    ("design", "why"),
    [
        (make_design(mu=0.2, inflow="local-momentum"), "this inflow"),
        (make_design(mu=0.06), "passes over to hover"),
        (make_design(rotor="s61", mu=0.2), "this rotor"),
        (make_design(mu=0.2, climb_m_s=2.0), "level flight"),
        (make_design(mu=0.42), "0.40"),
    ],
)
def test_it_is_compared_only_with_what_it_bounds(design: Design, why: str):
    assert why in not_bounded(design)


def test_bound_at_the_ends_of_the_table():
    assert ideal_factor(0.0, 0.0065) == 1.0
    assert ideal_factor(0.42, 0.0065) is None
    factor = ideal_factor(0.2, 0.006509)
    assert factor is not None
    assert_allclose(factor, 1.1481, atol=1e-3)
