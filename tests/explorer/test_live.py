"""The page that travels: its polynomials against trims, what it refuses, and that it is one file."""

import base64
import hashlib
import json
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from explorer import __main__ as command
from explorer.export import fitted as module
from explorer.export.fitted import Fitted, fitted
from explorer.export.live import live_html
from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.units import UNITS, units_of
from rotor import Design, make_design, solve, solve_many
from rotor.support.arrays import Array
from rotor.trim.doubt import doubt
from tests.tools.lint_web import html_faults

PLAIN = make_design(mu=0.2, twist="segments:-12,-6@0.5", inflow="drees", elements=16, azimuths=36)
WORDS = re.compile(r"\b(nan|NaN|None|inf)\b")


@pytest.fixture(scope="module")
def made() -> Fitted:
    return fitted(solve(PLAIN))


@pytest.fixture(scope="module")
def page(made: Fitted) -> str:
    return live_html(made.solution)


def errors(made: Fitted, count: int) -> Array:
    """Of total power at random twists [W]."""
    x = np.random.default_rng(7).uniform(-1.0, 1.0, (count, len(made.family.handles)))
    exact = np.array([one.power.total for one in solve_many([made.family.design(at) for at in x])])
    return np.abs(made.at(made.power["total"], x) - exact)


class TestPolynomials:
    def test_at_other_twists_the_error_is_below_the_one_stated(self, made: Fitted):
        assert errors(made, 40).max() < made.error < module.TOLERANCE * made.solution.power.total

    @pytest.mark.slow
    @pytest.mark.parametrize(
        "design",
        [
            make_design(mu=0.2, twist="segments:-12,-6@0.5"),
            make_design(mu=0.3, twist="quadratic:8,-14"),
            make_design(twist="segments:-16,-12,-6@0.4,0.75", mu=0.15),
        ],
    )
    def test_also_with_the_wake_that_answers_the_load(self, design: Design):
        made = fitted(solve(design))
        assert errors(made, 60).max() < made.error

    def test_the_design_itself_is_exact_in_power_and_its_parts(self, made: Fitted):
        here, power = made.family.here[None], made.solution.power
        assert made.at(made.power["total"], here)[0] == pytest.approx(power.total, rel=1e-9)
        for name in ("induced", "profile", "parasite", "tail"):
            assert made.at(made.power[name], here)[0] == pytest.approx(
                getattr(power, name), rel=1e-3
            )
        parts = sum(coefficients for name, coefficients in made.power.items() if name != "total")
        assert np.allclose(parts, made.power["total"], rtol=0.0, atol=1e-6)

    def test_the_bands_are_those_of_a_trim(self, made: Fitted):
        x = np.array([0.4, -0.5, 0.3])
        exact = doubt(solve(made.family.design(x)), made.solution)
        power, change = (float(np.hypot.reduce(made.at(rows, x[None])[0])) for rows in made.doubts)
        assert power == pytest.approx(exact.band, rel=0.01)
        assert change == pytest.approx(exact.change_band, rel=0.05)
        assert np.abs(made.at(made.doubts[1], made.family.here[None])).max() < 1e-6

    def test_the_band_in_hover_has_its_kink_at_the_design_itself(self):
        """By how far the blades differ: as large as a trim says far away, and half as large half way there."""
        made = fitted(solve(make_design(hover=True, twist="linear:-10", elements=16, azimuths=36)))
        for x in (-0.9, -0.4, -0.1, 0.1, 0.4, 0.9):
            at = made.family.here + np.array([x]) * (1.0 - np.abs(made.family.here))
            exact = doubt(solve(made.family.design(at)), made.solution)
            band = float(np.hypot.reduce(made.at(made.doubts[1], at[None])[0]))
            assert band == pytest.approx(exact.change_band, rel=0.05), x

    def test_no_trim_within_the_sliders_needs_less_than_the_best(self, made: Fitted):
        values, best = made.best
        assert (
            best.power.total < min(trim.solution.power.total for trim in made.tested) + made.error
        )
        for value, handle in zip(values, made.family.handles, strict=True):
            assert handle.form.low <= value <= handle.form.high

    def test_sliders_end_where_the_error_would_be_too_large(
        self, made: Fitted, monkeypatch: pytest.MonkeyPatch
    ):
        monkeypatch.setattr(module, "TOLERANCE", 0.3 * made.error / made.solution.power.total)
        narrow = fitted(made.solution)
        assert narrow.error < 0.3 * made.error
        assert narrow.family.handles[0].half < made.family.handles[0].half
        monkeypatch.setattr(module, "TOLERANCE", 1e-9)
        with pytest.raises(ValueError, match="near its twist the power would be"):
            fitted(made.solution)


@pytest.mark.parametrize(
    ("design", "sentence"),
    [
        (PLAIN.with_twist("ideal"), "has no sliders"),
        (PLAIN.at(mass_kg=30000.0), "not trimmed"),
        (make_design(rotor="pca2", trim="free-rotor"), "takes no power"),
    ],
)
def test_what_has_no_page_is_one_sentence(design: Design, sentence: str):
    with pytest.raises(ValueError, match=sentence):
        fitted(solve(design))


@pytest.mark.parametrize("concept", ["linear", "two-segment"])
def test_with_an_actuator_on_board_sliders_are_its_drives(concept: str):
    bare = make_design(mu=0.2, inflow="drees", elements=16, azimuths=36)
    design = ActuatorInputs(concept=concept, drives=(50.0,) * 5).apply(bare)
    made = fitted(solve(design))
    here = made.family.design(made.family.here)
    assert np.allclose(
        here.twist(np.linspace(0.2, 1.0, 9)), design.twist(np.linspace(0.2, 1.0, 9)), atol=1e-9
    )
    assert made.at(made.power["total"], made.family.here[None])[0] == pytest.approx(
        made.solution.power.total
    )
    driven = ActuatorInputs(concept=concept, drives=(-40.0, 80.0)).apply(bare)
    volts = (-200.0, 1200.0)[: len(made.family.handles)]
    exact = solve(driven).power.total
    x = made.family.scaled(volts)
    assert np.abs(x).max() <= 1.0
    assert float(made.at(made.power["total"], x[None])[0]) == pytest.approx(
        exact, abs=made.error + 1.0
    )
    page = live_html(made.solution)
    assert "with MFC P1 at 750" in page
    assert "The power of the drive is not included." in page


def test_in_hover_and_in_other_units_it_is_made_as_well():
    hover = live_html(
        solve(make_design(twist="linear:-12", hover=True)), units_of("Aviation", PLAIN.aircraft)
    )
    assert "in hover with twist " in hover
    assert UNITS["Aviation"].power[0].symbol in hover
    assert not WORDS.search(hover)


def scripts_of(page: str) -> Sequence[str]:
    return re.findall(r"<script>(.*?)</script>", page, re.DOTALL)


class TestFile:
    def test_is_one_small_file_that_requests_nothing(self, page: str):
        assert html_faults(page) == []
        assert len(page.encode()) < 700_000
        assert re.findall(r'\b(?:src|href|srcset|data)="(?!data:|#)[^"]+"', page) == []
        ids = re.findall(r'\sid="([^"]+)"', page)
        assert len(set(ids)) == len(ids)
        assert not WORDS.search(page.partition("<script")[0])

    def test_only_its_own_scripts_may_run(self, page: str):
        policy = re.search(r'Content-Security-Policy" content="([^"]+)"', page)
        assert policy is not None
        hashes = [
            base64.b64encode(hashlib.sha256(each.encode()).digest()).decode()
            for each in scripts_of(page)
        ]
        allowed = " ".join(f"&#x27;sha256-{each}&#x27;" for each in hashes)
        assert f"script-src {allowed};".replace("&#x27;", "'") in policy[1].replace(
            "&#x27;", "'"
        ).replace("&#39;", "'")
        assert "connect-src 'none'" in policy[1].replace("&#x27;", "'").replace("&#39;", "'")

    def test_says_its_error_and_what_it_was_measured_with(self, made: Fitted, page: str):
        assert f"fitted to {len(made.trims)} trims" in page
        stated = re.search(r'data-live="error">([\d.]+)', page)
        assert stated is not None
        assert made.error <= 1e3 * float(stated[1]) <= made.error + 10.0

    def test_the_command_writes_it(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
        design, out = tmp_path / "a.json", tmp_path / "out.html"
        PLAIN.save(design)
        assert command.main(["report", str(design), "--live", "--out", str(out)]) == 0
        assert capsys.readouterr().out.startswith(f"{out}: ")
        model = re.search(
            r'id="model" type="application/json">(.*?)</script>', out.read_text("utf-8"), re.DOTALL
        )
        assert model is not None
        assert json.loads(model[1])["unit"] == "kW"
        assert command.main(["report", str(design), str(design), "--live"]) == 2
        assert "--live takes one design" in capsys.readouterr().err
