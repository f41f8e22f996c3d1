"""What uncertain inputs do to power: first order beside new trims, and what is said of it."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any

import numpy as np
import pytest

import rotor
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.momentum import glauert_inflow
from rotor.aero.problem import Problem, build_problem
from rotor.design.design import Design
from rotor.design.uncertain import uncertain_inputs
from rotor.support.assets import asset_path
from rotor.trim.analysis import Analysis
from rotor.trim.doubt import Doubt, DoubtRow, doubt, other_models, sureness
from rotor.trim.power_changes import hover_part, power_changes
from tests.patched import Patch
from tests.uncertain import SIZES, either_side, patch_sections

CONDITIONS = {"µ 0.35": {"mu": 0.35}, "µ 0.3": {"mu": 0.3}, "µ 0.2": {"mu": 0.2}, "hover": {"hover": True}}
TWISTS = ("linear:-12", "builtin")


def designs(condition: str) -> list[Design]:
    return [rotor.make_design(twist=twist, **CONDITIONS[condition]) for twist in TWISTS]  # type: ignore[arg-type]


def exactly(condition: str, name: str, patch: Patch) -> np.ndarray:
    """The change of both powers by new trims [W], half of that between an input larger and one smaller by its size."""
    ends = [
        [rotor.solve(changed).require().power.total for changed in either_side(name, design, patch)]
        for design in designs(condition)
    ]
    return 0.5 * (np.array(ends)[:, 0] - np.array(ends)[:, 1])


@pytest.mark.slow
@pytest.mark.parametrize("condition", CONDITIONS)
@pytest.mark.parametrize(
    "name",
    [
        "section_drag_percent", "section_lift_percent", "section_moment", "drag_rise_mach", "drag_area_percent",
        "torsional_stiffness_percent", "control_stiffness_percent", "torsional_inertia_percent",
    ],
)  # fmt: skip
def test_the_first_order_is_what_new_trims_give(name: str, condition: str, patch: Patch):
    """Within 15 % of the band, of the power and of the change of power between two twists."""
    here, built = (rotor.solve(design).require() for design in designs(condition))
    found = doubt(here, built)
    row = next((row for row in found.rows if row.name == name), None)
    if row is None:
        assert condition == "hover"
        assert name == "drag_area_percent"
        return
    assert found.change_band is not None
    assert row.change is not None
    exact = exactly(condition, name, patch)
    print(f"{name} {condition}: {exact[0]:.0f} {row.power:.0f}, {exact[0] - exact[1]:.0f} {row.change:.0f} W")
    assert row.power == pytest.approx(exact[0], abs=0.15 * found.band)
    assert row.change == pytest.approx(exact[0] - exact[1], abs=0.15 * found.change_band)


@lru_cache(maxsize=1)
def at_speed() -> tuple[rotor.Solution, rotor.Solution]:
    here, built = (rotor.solve(design).require() for design in designs("µ 0.3"))
    return here, built


def test_most_of_what_is_uncertain_is_so_for_both_twists():
    here, _ = at_speed()
    found = doubt(here, here)
    assert found.change == found.change_band == 0.0
    assert found.band > 0.0
    found = doubt(*at_speed())
    assert found.change_band is not None
    assert found.change_band < 0.15 * found.band
    assert found.sureness == "sure"
    assert found.sentence.startswith("Power 1379 ± ")


def test_the_drag_area_costs_its_drag_times_speed_and_a_little_more():
    """∂P/∂f is ½ρV³ at the shaft, and the rotor and the tail rotor that give that force take more."""
    here, _ = at_speed()
    design = here.design
    by_hand = 0.2 * design.fuselage.drag_area * 0.5 * design.condition.density * design.flight_speed**3
    assert 1.0 < power_changes(Analysis(here).adjoint)["drag_area_percent"] / by_hand < 1.25


def test_in_hover_the_drag_of_the_sections_costs_its_share_of_profile_power():
    """No state follows it but the inflow of annuli, which balances lift: profile power, and the tail rotor's part."""
    here = rotor.solve(rotor.make_design(hover=True)).require()
    tail = 1.0 + here.power.tail / here.power.main_rotor
    share = 0.01 * SIZES["section_drag_percent"] * here.power.profile * tail
    assert power_changes(Analysis(here).adjoint)["section_drag_percent"] == pytest.approx(share, rel=0.12)


def test_in_hover_a_tenth_of_induced_power_is_uncertain_and_what_the_tail_takes_for_it():
    """The tail rotor's part follows from its power at two torques of the main rotor."""
    here, there = (rotor.solve(rotor.make_design(twist=twist, hover=True)).require() for twist in TWISTS)
    found = doubt(here, there)
    row = next(row for row in found.rows if row.name == "hover_induced_percent")
    slope = (here.power.tail - there.power.tail) / (here.power.main_rotor - there.power.main_rotor)
    induced = [one.power.induced for one in (here, there)]
    assert row.power == pytest.approx(0.1 * induced[0] * (1.0 + slope), rel=2e-3)
    assert row.change == pytest.approx(0.1 * (induced[0] - induced[1]) * (1.0 + slope), rel=0.1)
    assert found.band > abs(row.power)


def test_a_wake_in_flight_is_that_of_hover_by_the_skew_of_momentum_theory():
    """cos²χ with Glauert's inflow, which is found by iteration; it leaves 1 without a slope and falls all the way."""
    for thrust in (1e-4, 0.0067, 0.02):
        speeds = math.sqrt(0.5 * thrust) * np.geomspace(1e-3, 10.0, 40)
        parts = [hover_part(float(mu), thrust) for mu in speeds]
        for mu, part in zip(speeds.tolist(), parts, strict=True):
            inflow = glauert_inflow(thrust, mu, 0.0)[0]
            assert part == pytest.approx(inflow**2 / (mu**2 + inflow**2), rel=1e-9)
        assert hover_part(0.0, thrust) - parts[0] < 1e-5
        assert (np.diff(parts) < 0.0).all()


def test_the_band_of_slow_flight_is_that_of_hover():
    """The wake of forward flight counts as far as hover's model does not, and the tip loss is of hover alone."""
    hover, slow = (doubt(rotor.solve(rotor.make_design(mu=mu)).require()) for mu in (0.0, 0.005))
    assert slow.band == pytest.approx(hover.band, rel=0.02)


@pytest.mark.parametrize(("off", "beside"), [("dynamic-stall", True), ("unsteady", False)])
def test_steady_flow_stands_beside_unsteady_flow_alone(off: str, beside: bool):
    models = other_models(rotor.make_design(mu=0.2, off=off))
    assert ("unsteady flow off" in models) == beside
    assert not any(design.models.unsteady for name, design in models.items() if name.startswith("unsteady"))


def test_with_bending_the_rows_are_those_of_new_trims(patch: Patch):
    options = {"mu": 0.3, "bending": True}
    found = power_changes(Analysis(rotor.solve(rotor.make_design(**options)).require()).adjoint)
    ends: list[float] = []
    for sign in (1.0, -1.0):
        patch_sections("section_drag_percent", sign * SIZES["section_drag_percent"], patch)
        ends.append(rotor.solve(rotor.make_design(**options)).require().power.total)
    assert found["section_drag_percent"] == pytest.approx(0.5 * (ends[0] - ends[1]), rel=0.05)


def test_what_a_design_does_not_have_is_no_row():
    thesis = power_changes(Analysis(rotor.solve(rotor.make_design(mu=0.2, preset="thesis")).require()).adjoint)
    assert not {"torsional_stiffness_percent", "section_moment", "wake_transport_percent"} & set(thesis)
    stand = rotor.make_design(rotor="pca2", mu=0.2, trim="wind-tunnel", stand={"ct_over_sigma": 0.06})
    found = Analysis(rotor.solve(stand)).power_changes
    assert set(found) <= set(thesis) | {"wake_transport_percent", "wake_path_percent"}
    assert "drag_area_percent" not in found


@pytest.mark.parametrize("options", [{"hover": True}, {"mu": 0.2, "inflow": "drees", "loss_on": "inflow"}])
def test_tip_loss_is_as_in_new_trims(options: dict[str, Any], patch: Patch):
    here, there = (rotor.solve(rotor.make_design(twist=twist, **options)).require() for twist in TWISTS)
    found = doubt(here, there)
    row = next(row for row in found.rows if row.name == "tip_loss_percent")
    ends: list[list[float]] = []
    for sign in (1.0, -1.0):
        spacing = 1.0 / (1.0 + 0.01 * sign * SIZES["tip_loss_percent"])

        def other(design: Design, spacing: float = spacing) -> Problem:
            return replace(build_problem(design), tip_spacing=spacing)

        for solver in ("low_speed", "forward"):
            patch(f"rotor.trim.{solver}.build_problem", other)
        ends.append([rotor.solve(each.design).require().power.total for each in (here, there)])
    exact = 0.5 * (np.array(ends[0]) - np.array(ends[1]))
    assert found.change_band is not None
    assert row.change is not None
    assert exact[0] > 0.0
    assert row.power == pytest.approx(exact[0], abs=0.15 * found.band)
    assert row.change == pytest.approx(exact[0] - exact[1], abs=0.15 * found.change_band)


@pytest.mark.parametrize("mu", [0.1, 0.3])
def test_the_path_of_the_wake_is_as_in_new_trims(mu: float, patch: Patch):
    """Along Beddoes' path, for the power and for the difference; a design without a lifting line has no such row."""
    here, there = (rotor.solve(rotor.make_design(twist=twist, mu=mu)).require() for twist in TWISTS)
    row = next(row for row in doubt(here, there).rows if row.name == "wake_path_percent")
    patch("rotor.aero.problem.WakeCourse", partial(WakeCourse, beddoes=1.0))
    changes = [rotor.solve(one.design).require().power.total - one.power.total for one in (here, there)]
    assert (row.power, row.change) == pytest.approx((changes[0], changes[0] - changes[1]), abs=5.0)
    assert abs(changes[0]) > 500.0
    linear = rotor.solve(rotor.make_design(mu=mu, inflow="pitt-peters")).require()
    assert "wake_path_percent" not in Analysis(linear).power_changes


def test_a_free_rotor_has_no_band():
    solution = rotor.solve(rotor.make_design(rotor="pca2", mu=0.2, trim="free-rotor", stand={"ct_over_sigma": 0.07}))
    with pytest.raises(RuntimeError, match="takes no power"):
        doubt(solution)


@pytest.mark.parametrize(("change", "band", "word"), [(-2.0, 1.0, "sure"), (1.5, 1.0, "likely"), (0.3, 1.0, "unclear")])
def test_the_words_follow_the_ratio(change: float, band: float, word: str):
    assert sureness(change, band).startswith(word)


def test_the_sentence_has_no_digit_that_the_band_does_not_allow():
    row = DoubtRow("section_moment", "section moment", 0.01, "x", power=52e3, change=6.3e3)
    found = Doubt(901.4e3, (row,), against=917.9e3)
    assert found.sentence == "Power 901 ± 52 kW. It saves 1.8 ± 0.7 %: sure."
    nothing = Doubt(901.4e3, (replace(row, change=2.7e3),), against=902.3e3)
    assert nothing.sentence == "Power 901 ± 52 kW. It saves 0.1 ± 0.3 %: unclear."
    assert Doubt(901.4e3, (replace(row, change=-1e3),), 880e3).sentence.endswith("It costs 2.43 ± 0.11 %: sure.")
    assert Doubt(901.4e3, (replace(row, change=0.03),), 880e3).sentence.endswith("It costs 2.43 ± 0.01 %: sure.")
    same = Doubt(901.4e3, (replace(row, change=0.03),), 901.4e3 + 0.01)
    assert (same.sureness, same.change_words) == (None, "")
    assert same.sentence == "Power 901 ± 52 kW. It neither saves nor costs."


def test_a_rotor_file_states_its_own(tmp_path_factory: pytest.TempPathFactory):
    text = asset_path("r22.toml").read_text(encoding="utf-8")
    path = tmp_path_factory.mktemp("own") / "mine.toml"
    path.write_text(text + "\n[doubt]\nsection_drag_percent = 3.0\n", encoding="utf-8")
    design = rotor.make_design(rotor=rotor.load_rotor(path), mu=0.2)
    sizes = {row.name: (row.size, row.source) for row in uncertain_inputs(design)}
    assert sizes["section_drag_percent"] == (3.0, "rotor file")
    assert sizes["drag_area_percent"][0] == pytest.approx(50.0 * (0.50 - 0.31) / 0.40)
    path.write_text(text + "\n[doubt]\nsection_drag = 3.0\n", encoding="utf-8")
    with pytest.raises(ValueError, match="section_drag"):
        rotor.load_rotor(path)


def test_the_command_says_it_and_its_json_has_the_rows(printed: Callable[..., str], answer: Callable[..., Any]):
    words = ("solve", "--mu", "0.3", "--twist", "linear:-12", "--doubt")
    assert "Against the blade as built it saves" in printed(*words)
    found = answer(*words)["doubt"]
    assert {"total_w", "against", "change_w", "change_band_w", "rows", "models"} <= set(found)
    assert {"inflow pitt-peters", "bending"} <= set(found["models"])
    assert found["change_w"] == pytest.approx(found["power_w"] - found["against_w"])
    assert math.hypot(*(row["power_w"] for row in found["rows"])) == pytest.approx(found["total_w"])
