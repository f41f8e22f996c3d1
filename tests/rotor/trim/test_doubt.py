"""What uncertain inputs do to power: first order beside new trims, and what is said of it."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rotor
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.problem import Problem, build_problem
from rotor.design.design import Design
from rotor.design.uncertain import uncertain_inputs
from rotor.engine.linearise import Point, evaluate, transposed
from rotor.engine.newton import Factors
from rotor.support.assets import asset_path
from rotor.trim import analyse
from rotor.trim.analysis import Analysis
from rotor.trim.doubt import Doubt, DoubtRow, banded, doubt, other_models, sureness
from rotor.trim.power_changes import PARTS, by_part, power_changes
from tests.patched import Patch
from tests.uncertain import SIZES, either_side, patch_sections

CONDITIONS = {
    "µ 0.35": {"mu": 0.35},
    "µ 0.3": {"mu": 0.3},
    "µ 0.2": {"mu": 0.2},
    "hover": {"hover": True},
}
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
        "section_lift_percent", "section_moment", "drag_rise_mach", "drag_area_percent",
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
    print(
        f"{name} {condition}: {exact[0]:.0f} {row.power:.0f}, {exact[0] - exact[1]:.0f} {row.change:.0f} W"
    )
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
    assert found.sentence.startswith("Power 1380 ± ")


def test_the_drag_area_costs_its_drag_times_speed_and_a_little_more():
    """∂P/∂f is ½ρV³ at the shaft, and the rotor and the tail rotor that give that force take more."""
    here, _ = at_speed()
    design = here.design
    by_hand = (
        0.2 * design.fuselage.drag_area * 0.5 * design.condition.density * design.flight_speed**3
    )
    assert 1.0 < power_changes(Analysis(here).adjoint)["drag_area_percent"].sum() / by_hand < 1.25


@pytest.mark.parametrize("condition", CONDITIONS)
def test_the_errors_of_the_model_are_shares_of_induced_and_profile_power(condition: str):
    """At every speed, with what the tail rotor takes for them: its power at two torques of the main rotor."""
    here, there = (rotor.solve(design).require() for design in designs(condition))
    slope = (here.power.tail - there.power.tail) / (here.power.main_rotor - there.power.main_rotor)
    found = {row.name: row for row in doubt(here, there).rows}
    for name, power in (
        ("induced_power_percent", here.power.induced),
        ("profile_power_percent", here.power.profile),
    ):
        assert found[name].power == pytest.approx(
            0.01 * SIZES[name] * power * (1.0 + slope), rel=2e-3
        )


def test_of_a_difference_two_inflow_models_are_compared():
    """In hover, and where the other model has no trim, a part of induced power; both never change the power itself."""
    here, built = at_speed()
    others = [
        rotor.solve(replace(one.design, models=replace(one.design.models, inflow="pitt-peters")))
        for one in (here, built)
    ]
    half = 0.5 * (
        here.power.total - built.power.total - others[0].power.total + others[1].power.total
    )
    rows = {row.name: (row.power, row.change) for row in doubt(here, built).rows}
    assert rows["inflow_model_percent"] == (0.0, pytest.approx(half, rel=1e-3))
    assert "hover_wake_percent" not in rows
    hover, there = (rotor.solve(rotor.make_design(twist=twist, hover=True)) for twist in TWISTS)
    rows = {row.name: (row.power, row.change) for row in doubt(hover, there).rows}
    assert rows["hover_wake_percent"] == (
        0.0,
        pytest.approx(0.25 * (hover.power.induced - there.power.induced)),
    )
    assert "inflow_model_percent" not in rows
    slow = doubt(*(rotor.solve(rotor.make_design(twist=twist, mu=0.002)) for twist in TWISTS))
    (near,) = (row.change for row in slow.rows if row.name == "hover_wake_percent")
    assert near == pytest.approx(rows["hover_wake_percent"][1], rel=0.05)


def test_the_band_of_slow_flight_is_that_of_hover():
    """The wake of forward flight counts as far as hover's model does not, and the tip loss is of hover alone."""
    hover, slow = (doubt(rotor.solve(rotor.make_design(mu=mu)).require()) for mu in (0.0, 0.005))
    assert slow.band == pytest.approx(hover.band, rel=0.02)


@pytest.mark.parametrize(("off", "beside"), [("dynamic-stall", True), ("unsteady", False)])
def test_steady_flow_stands_beside_unsteady_flow_alone(off: str, beside: bool):
    models = other_models(rotor.make_design(mu=0.2, off=off))
    assert ("unsteady flow off" in models) == beside
    assert not any(
        design.models.unsteady for name, design in models.items() if name.startswith("unsteady")
    )


def test_with_bending_the_rows_are_those_of_new_trims(patch: Patch):
    options = {"mu": 0.3, "bending": True}
    found = power_changes(Analysis(rotor.solve(rotor.make_design(**options)).require()).adjoint)
    ends: list[float] = []
    for sign in (1.0, -1.0):
        patch_sections("drag_rise_mach", sign * SIZES["drag_rise_mach"], patch)
        ends.append(rotor.solve(rotor.make_design(**options)).require().power.total)
    assert found["drag_rise_mach"].sum() == pytest.approx(0.5 * (ends[0] - ends[1]), rel=0.05)


def test_what_a_design_does_not_have_is_no_row():
    thesis = power_changes(
        Analysis(rotor.solve(rotor.make_design(mu=0.2, preset="thesis")).require()).adjoint
    )
    assert not {"torsional_stiffness_percent", "section_moment", "wake_transport_percent"} & set(
        thesis
    )
    stand = rotor.make_design(
        rotor="pca2", mu=0.2, trim="wind-tunnel", stand={"ct_over_sigma": 0.06}
    )
    found = Analysis(rotor.solve(stand)).power_changes
    assert set(found) <= set(thesis) | {"wake_transport_percent", "wake_path_percent"}
    assert "drag_area_percent" not in found


@pytest.mark.parametrize(
    "options", [{"hover": True}, {"mu": 0.2, "inflow": "drees", "loss_on": "inflow"}]
)
def test_tip_loss_is_as_in_new_trims(options: dict[str, Any], patch: Patch):
    here, there = (
        rotor.solve(rotor.make_design(twist=twist, **options)).require() for twist in TWISTS
    )
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
    print(
        f"tip_loss_percent: {exact[0]:.0f} {row.power:.0f}, {exact[0] - exact[1]:.0f} {row.change:.0f} W"
    )
    assert exact[0] > 0.0
    assert row.power == pytest.approx(exact[0], abs=0.15 * found.band)
    assert row.change == pytest.approx(exact[0] - exact[1], abs=0.15 * found.change_band)


@pytest.mark.parametrize("mu", [0.1, 0.3])
def test_the_path_of_the_wake_is_as_in_new_trims(mu: float, patch: Patch):
    """Along Beddoes' path, for the power and for the difference; a design without a lifting line has no such row."""
    here, there = (rotor.solve(rotor.make_design(twist=twist, mu=mu)).require() for twist in TWISTS)
    row = next(row for row in doubt(here, there).rows if row.name == "wake_path_percent")
    patch("rotor.aero.problem.WakeCourse", partial(WakeCourse, beddoes=1.0))
    changes = [
        rotor.solve(one.design).require().power.total - one.power.total for one in (here, there)
    ]
    assert (row.power, row.change) == pytest.approx((changes[0], changes[0] - changes[1]), abs=1.5)
    assert abs(changes[0]) > 500.0
    linear = rotor.solve(rotor.make_design(mu=mu, inflow="pitt-peters")).require()
    assert "wake_path_percent" not in Analysis(linear).power_changes


@pytest.mark.parametrize("bending", [False, True])
def test_a_band_takes_few_evaluations_and_no_factors(
    bending: bool, monkeypatch: pytest.MonkeyPatch
):
    """One for each input of the rotor, fewer than a warm trim for the path of the wake, the factors of the gradient.

    The multipliers that tell parts of power apart take fewer products than those of the gradient, 3 to 5 where
    these take 5 to 9.
    """
    evaluations, evaluated = list[Point](), evaluate
    products, multiplied = list[Any](), transposed

    def counted(*given: Any, **others: Any) -> Point:
        evaluations.append(evaluated(*given, **others))
        return evaluations[-1]

    def product(point: Point, v: Any) -> Any:
        products.append(multiplied(point, v))
        return products[-1]

    for mu in (0.1, 0.2, 0.3):
        trim = analyse(rotor.make_design(mu=mu, twist="linear:-16", bending=bending))
        assert trim.gradient.by_element.any()
        with monkeypatch.context() as patched:
            patched.setattr(Factors, "of", None)
            for place in ("newton", "linearise"):
                patched.setattr(f"rotor.engine.{place}.evaluate", counted)
            patched.setattr("rotor.trim.power_changes.evaluate", counted)
            patched.setattr("rotor.engine.newton.transposed", product)
            assert len(trim.power_changes) > 10
        print(f"mu {mu}: {len(evaluations)}, {len(products)}")
        assert len(evaluations) <= 13  # 8 to 12
        assert 0 < len(products) <= 5
        evaluations.clear()
        products.clear()


def test_a_path_of_the_wake_without_a_trim_stays_in_the_band(patch: Patch):
    """To first order, about as large as the new trim, and by a name of its own."""
    here, _ = at_speed()
    trimmed = {row.name: row.power for row in doubt(here).rows}
    patch("rotor.trim.power_changes.newton", lambda *_: SimpleNamespace(converged=False))
    found = {row.name: row.power for row in doubt(Analysis(here)).rows}
    assert trimmed.keys() - found.keys() == {"wake_path_percent"}
    assert found.keys() - trimmed.keys() == {"wake_path_slope_percent"}
    assert found["wake_path_slope_percent"] == pytest.approx(trimmed["wake_path_percent"], rel=0.3)


def test_the_band_of_a_free_rotor_is_that_of_its_drag():
    """Its drag times speed is induced and profile power: no power comes from the shaft."""
    free, driven = (
        rotor.solve(
            rotor.make_design(rotor="pca2", mu=0.2, trim=trim, stand={"ct_over_sigma": 0.07})
        ).require()
        for trim in ("free-rotor", "wind-tunnel")
    )
    found, power = doubt(free), free.power
    assert found.power == pytest.approx(free.lift_and_drag[1] * free.design.airspeed, rel=1e-3)
    shares = (
        0.01 * SIZES[f"{part}_power_percent"] * getattr(power, part)
        for part in ("induced", "profile")
    )
    assert found.band == pytest.approx(math.hypot(*shares))
    assert found.sentence.startswith("Drag times speed ")
    with pytest.raises(ValueError, match="no saving is known"):
        doubt(driven, free)


@pytest.mark.parametrize(
    ("change", "band", "word"), [(-2.0, 1.0, "sure"), (1.5, 1.0, "likely"), (0.3, 1.0, "unclear")]
)
def test_the_words_follow_the_ratio(change: float, band: float, word: str):
    assert sureness(change, band).startswith(word)


@pytest.mark.parametrize(
    ("change", "band", "words"),
    [
        (1.004, 0.502, "1.0 ± 0.5 %: sure"),
        (0.996, 0.502, "1.00 ± 0.51 %: likely"),
        (11.9, 12.1, "12 ± 13 %: unclear"),
        (1.1379, 1.1381, "1.1 ± 1.2 %: unclear"),
        (0.08103, 0.08104, "0.08 ± 0.09 %: unclear"),
        (54.41, 18.62, "54 ± 19 %: sure"),
        (29.6, 14.9, "29 ± 15 %: likely"),
        (21.45, 10.7, "21 ± 10 %: sure"),
        (19.8, 9.93, "19 ± 10 %: likely"),
        (412.0, 186.4, "412 ± 186 %: sure"),
        (0.0123, 0.0036, "0.012 ± 0.004 %: sure"),
    ],
)
def test_the_digits_are_those_of_the_band(change: float, band: float, words: str):
    """Where rounding to the nearest would change the word, one of the two is rounded the other way."""
    assert banded(change, band, "%") == words


def near_the_words() -> list[tuple[float, float]]:
    """Changes and bands, a third each of any ratio and of ratios at which the word changes."""
    draw = np.random.default_rng(1)
    bands = 10.0 ** draw.uniform(-2.0, 2.5, 6000)
    ratios = draw.choice([1.0, 2.0, 3.7], 6000) * (1.0 + draw.normal(0.0, 0.05, 6000))
    return list(zip((bands * ratios).tolist(), bands.tolist(), strict=True))


def test_the_printed_pair_has_the_word_of_the_exact_one_in_every_unit():
    for exact_change, exact_band in near_the_words():
        word = sureness(exact_change, exact_band)
        for unit in (1.0, 0.7457, 9.04):
            change = exact_change / unit
            band = exact_band / unit
            numbers, _, printed_word = banded(change, band, "kW").partition(": ")
            size, within = numbers.removesuffix(" kW").split(" ± ")
            assert printed_word == word
            assert sureness(float(size), float(within)) == word, numbers
            behind = within.partition(".")[2]
            assert len(size.partition(".")[2]) == len(behind), numbers
            assert not behind or len(within.replace(".", "").lstrip("0")) <= 2, numbers
            assert float(size) == pytest.approx(change, abs=1.0001 * 10.0 ** -len(behind))
            assert float(within) == pytest.approx(band, abs=1.0001 * 10.0 ** -len(behind))


def test_a_word_that_a_value_without_a_source_lowers_says_why():
    assert banded(9.0, 1.0, "kW", sourced=False) == ("9.0 ± 1.0 kW: likely, from estimated data")
    assert banded(1.5, 1.0, "kW", sourced=False) == "1.5 ± 1.0 kW: likely"
    assert banded(0.5, 1.0, "kW", sourced=False) == "0.5 ± 1.0 kW: unclear"


def test_the_sentence_has_no_digit_that_the_band_does_not_allow():
    row = DoubtRow("section_moment", "section moment", 0.01, "x", power=52e3, change=6.3e3)
    found = Doubt(901.4e3, (row,), against=917.9e3)
    assert found.sentence == "Power 901 ± 52 kW. It saves 1.8 ± 0.7 %: sure."
    assert replace(found, sourced=False).sentence.endswith(
        "It saves 1.8 ± 0.7 %: likely, from estimated data."
    )
    light = Doubt(45.37e3, (replace(row, power=1.2e3),))
    assert light.sentence == "Power 45.4 ± 1.2 kW."
    nothing = Doubt(901.4e3, (replace(row, change=2.7e3),), against=902.3e3)
    assert nothing.sentence == "Power 901 ± 52 kW. It saves 0.1 ± 0.3 %: unclear."
    assert Doubt(901.4e3, (replace(row, change=-1e3),), 880e3).sentence.endswith(
        "It costs 2.43 ± 0.11 %: sure."
    )
    assert Doubt(901.4e3, (replace(row, change=0.03),), 880e3).sentence.endswith(
        "It costs 2.43 ± 0.01 %: sure."
    )
    same = Doubt(901.4e3, (replace(row, change=0.03),), 901.4e3 + 0.01)
    assert same.sureness is None
    assert same.sentence == "Power 901 ± 52 kW. It neither saves nor costs."


def test_a_rotor_file_states_its_own(tmp_path_factory: pytest.TempPathFactory):
    text = asset_path("r22.toml").read_text(encoding="utf-8")
    path = tmp_path_factory.mktemp("own") / "mine.toml"
    path.write_text(text + "\n[doubt]\nsection_lift_percent = 3.0\n", encoding="utf-8")
    design = rotor.make_design(rotor=rotor.load_rotor(path), mu=0.2)
    sizes = {row.name: (row.size, row.source) for row in uncertain_inputs(design)}
    assert sizes["section_lift_percent"] == (3.0, "rotor file")
    assert sizes["drag_area_percent"][0] == pytest.approx(50.0 * (0.50 - 0.31) / 0.40)
    path.write_text(text + "\n[doubt]\nsection_lift = 3.0\n", encoding="utf-8")
    with pytest.raises(ValueError, match="section_lift"):
        rotor.load_rotor(path)


def test_the_command_says_it_and_its_json_has_the_rows(
    printed: Callable[..., str], answer: Callable[..., Any]
):
    words = ("solve", "--mu", "0.3", "--twist", "linear:-12", "--doubt")
    assert "Against the blade as built it saves" in printed(*words)
    found = answer(*words)["doubt"]
    assert {"total_w", "against", "change_w", "change_band_w", "rows", "models"} <= set(found)
    assert {"inflow pitt-peters", "bending"} <= set(found["models"])
    assert found["change_w"] == pytest.approx(found["power_w"] - found["against_w"])
    assert math.hypot(*(row["power_w"] for row in found["rows"])) == pytest.approx(found["total_w"])


@pytest.mark.parametrize("condition", CONDITIONS)
def test_the_band_of_a_part_of_power_is_that_of_new_trims(condition: str):
    """Of each part by itself: a stiffer blade changes induced and profile power, and those of the tail rotor follow."""
    here, there = (rotor.solve(design).require() for design in designs(condition))
    found = doubt(here, there)
    row = next(row for row in found.rows if row.name == "torsional_stiffness_percent")

    def slope(solution: rotor.Solution) -> Any:
        """Change of the parts where the blade is stiffer by its size."""
        structure = solution.design.rotor.blade.structure
        assert structure is not None
        ends: list[Any] = []
        for factor in (1.01, 0.99):
            stiffness = tuple(factor * each for each in structure.torsional_stiffness)
            stiffer = replace(structure, torsional_stiffness=stiffness)
            blade = replace(solution.design.rotor.blade, structure=stiffer)
            design = replace(solution.design, rotor=replace(solution.design.rotor, blade=blade))
            ends.append(by_part(rotor.solve(design).require().power))
        return (ends[0] - ends[1]) * 0.5 * SIZES["torsional_stiffness_percent"]

    exact = slope(here) - slope(there)
    assert row.changes == pytest.approx(exact, abs=0.03 * float(np.abs(exact).max()))
    assert sum(row.changes) == pytest.approx(row.change)
    for k, part in enumerate(PARTS):
        assert found.part_bands[part] == pytest.approx(
            math.hypot(*(each.changes[k] for each in found.rows))
        )
    main = math.hypot(*(sum(each.changes[: PARTS.index("tail")]) for each in found.rows))
    assert found.part_bands["main_rotor"] == pytest.approx(main)
    assert doubt(here).part_bands == {}
