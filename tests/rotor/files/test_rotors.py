"""The other rotors that ship: nothing in the physics is secretly the UH-60A's."""

import json
import math
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.files.design_file import design_from_record
from rotor.files.rotor_file import read_aircraft, shipped_aircraft
from rotor.support.assets import MEASURED_ROTORS, SHIPPED_ROTORS, asset_path
from tests.solved import SAME
from tests.tools.ideal_bound import find_bound

OTHERS = SHIPPED_ROTORS[1:]


def own(key: str) -> dict[str, str]:
    """A shipped rotor's file as if it were a user's."""
    return {"my.toml": asset_path(f"{key}.toml").read_text(encoding="utf-8")}


def test_shipped_rotors():
    blades = {key: shipped_aircraft(key).rotor.blades for key in SHIPPED_ROTORS}
    assert blades == {"uh60a": 4, "r22": 2, "s61": 5, "gazelle": 3, "bo105": 4}
    r22 = shipped_aircraft("r22").rotor
    assert_allclose(r22.angular_speed * 30.0 / math.pi, 530.0, atol=0.5)  # 104 % of 510 rpm
    assert_allclose(shipped_aircraft("s61").rotor.tip_speed / 0.3048, 659.0, atol=0.5)


ROTOR_FILES = (
    *(f"{key}.toml" for key in SHIPPED_ROTORS),
    *(f"rotors/{key}.toml" for key in MEASURED_ROTORS),
)


@pytest.mark.parametrize("file", ROTOR_FILES)
def test_every_number_has_a_source(file: str):
    """Each `key = value` has a comment with a grade. Stations have that of the values there."""
    without = ("name", "chord_r", "twist_r", "r_m")
    for line in asset_path(file).read_text(encoding="utf-8").splitlines():
        if re.match(r"^\w+ = (?!\[$)", line) and not line.startswith(without):
            assert re.search(r"#\s+[PSDXRA]\b", line), line


@pytest.mark.parametrize("key", OTHERS)
def test_hover_between_the_bounds_of_momentum_theory(key: str):
    """Figures of merit of full-scale rotors at design thrust lie between 0.6 and 0.8; none beats momentum theory."""
    solution = solve(make_design(rotor=key).at(mu=0.0)).require()
    assert solution.figure_of_merit is not None
    assert 0.60 < solution.figure_of_merit < 0.80
    assert 1.0 < (solution.induced_power_factor or 0.0) < 1.15


def test_the_r22_hovers_and_cruises_within_engine_power():
    """Indicative: 124 hp continuous, 131 hp for five minutes (flight manual), some 5 % of it for transmission and fan.

    Out of ground effect at full weight it hovers on less, and it reaches its limit of 102 kt on the continuous power.
    """
    design, horsepower = make_design(rotor="r22"), 745.7
    hover = solve(design.at(mu=0.0)).require().power.total / horsepower
    fastest = solve(design.at(speed_kt=102.0)).require().power.total / horsepower
    assert 90.0 < hover * 1.05 < 131.0
    assert 100.0 < fastest * 1.05 < 124.0


def test_the_thesis_preset_on_another_rotor_has_a_caveat():
    solution = solve(make_design(preset="thesis", rotor="r22", mu=0.2)).require()
    assert solution.design.twist == shipped_aircraft("r22").rotor.builtin_twist
    assert [one.name for one in solution.caveats] == ["thesis-models", "torque-without-drag"]
    assert "Robinson R22" in solution.caveats[0].sentence
    assert_allclose(solution.power.tail, 0.05 * solution.power.main_rotor, rtol=1e-12)


def test_without_or_with_another_hub_or_tail_rotor_there_is_a_caveat():
    text = own("r22")["my.toml"]
    craft = read_aircraft(
        "my.toml", {"my.toml": re.sub(r"(?s)\[tail_rotor\].*\[airframe\]", "[airframe]", text)}
    )
    solution = solve(make_design(rotor=craft, mu=0.2)).require()
    assert_allclose(solution.power.tail, 0.05 * solution.power.main_rotor, rtol=1e-12)
    assert "no-tail-rotor" in [one.name for one in solution.caveats]
    text = own("r22")["my.toml"].replace("teetering-with-coning-hinges", "teetering")
    solution = solve(make_design(rotor=read_aircraft("my.toml", {"my.toml": text}), mu=0.1))
    assert [one.name for one in solution.caveats] == ["teetering", "no-blade-structure"]
    assert [one.name for one in solve(make_design(rotor="r22", mu=0.1)).caveats] == [
        "no-blade-structure"
    ]


@pytest.mark.parametrize("key", SHIPPED_ROTORS)
def test_design_files_name_a_shipped_rotor_and_contain_a_users_own(key: str):
    design = make_design(rotor=key, twist="builtin", mu=0.23)
    assert design.to_dict()["rotor"] == key
    assert design_from_record(json.loads(json.dumps(design.to_dict()))) == design
    mine = make_design(rotor=read_aircraft("my.toml", own(key)), twist="builtin", mu=0.23)
    back = design_from_record(json.loads(json.dumps(mine.to_dict())))
    assert back == mine
    assert pickle.loads(pickle.dumps(mine)) == mine
    assert back.aircraft.key == ""


def test_design_files_without_a_rotor_are_the_uh60a():
    design = design_from_record({"format": "rotor-explorer design", "version": 2, "twist": "uh60a"})
    assert design.aircraft == shipped_aircraft("uh60a")


def test_a_shipped_twist_fits_any_rotor():
    design = make_design(rotor="r22", twist="uh60a+linear:2")
    assert design.twist.spec() == "uh60a+linear:2"
    assert make_design(twist="s61").twist == shipped_aircraft("s61").rotor.builtin_twist


@pytest.mark.slow
def test_fewer_blades_have_a_greater_bound():
    """Two blades lose more by their number than five: the least induced power is above momentum theory's by more."""
    bounds = {key: find_bound(make_design(rotor=key, mu=0.2)) for key in SHIPPED_ROTORS}
    assert (
        bounds["r22"].any_circulation
        > bounds["uh60a"].any_circulation
        > bounds["s61"].any_circulation
        > 1.0
    )


def test_rotor_flag(printed: Callable[..., str], answer: Callable[..., Any], tmp_path: Path):
    path = tmp_path / "mine.toml"
    path.write_text(own("r22")["my.toml"], encoding="utf-8")
    named, read = (answer("solve", "--rotor", rotor, "--hover") for rotor in ("r22", str(path)))
    assert named["power_w"] == pytest.approx(read["power_w"], rel=SAME)
    lines = printed("sweep", "--rotor", "s61", "--mu", "0.1,0.2", "--preset", "thesis").splitlines()
    assert len(lines) > 3
    assert lines[3].startswith("caveat: ")
