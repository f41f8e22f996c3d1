"""Blades that bend on the page: drawn shape, loads over the hub, and their words."""

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from fake_bridge import PanelPage
from numpy.testing import assert_allclose

from explorer.model.inputs import Inputs, ViewState, with_rotor
from explorer.model.session_state import SessionState
from explorer.picture.blade_mesh import PAGE, blade_shape
from explorer.picture.picture import (
    BENDING_SHOWN,
    blade_pose,
    drawn_bending,
    flown_form,
    follows_azimuth,
    make_picture,
    rotate,
    turned_blades,
)
from explorer.sharing.share import inputs_from
from explorer.views import vibration
from explorer.views.vibration import VIBRATION
from rotor import Solution, hub_loads, solve
from rotor.columns.bending import coordinates_of
from rotor.support.arrays import Array
from rotor.trim import Analysis, HubLoads
from tests.rotor.root_loads import displacements

FAST = Inputs(law="builtin", advance_ratio=0.3, bending=True)
VIEW = ViewState(exaggeration=1.0)


@pytest.fixture(scope="module")
def bent() -> Solution:
    return solve(FAST.design()).require()


@pytest.fixture(scope="module")
def straight() -> Solution:
    return solve(replace(FAST, bending=False).design()).require()


@pytest.fixture(scope="module")
def loads(bent: Solution) -> HubLoads:
    found = hub_loads(bent, band=False)
    assert found is not None
    return found


def on_disk(solution: Solution, psi: float, points: Array) -> Array:
    """Points of a blade in the axes of the shaft, turned back to ψ = 0: outward, forward, up."""
    hinge = solution.design.rotor.blade.flap_hinge * solution.design.rotor.radius
    pose = blade_pose(solution.controls, psi, hinge, solution.design)
    at = rotate(pose.wxyz, points)
    cos, sin = math.cos(psi), math.sin(psi)
    return np.stack(
        [at[:, 0] * cos + at[:, 1] * sin, at[:, 1] * cos - at[:, 0] * sin, at[:, 2]], axis=1
    )


class TestDrawnBlade:
    @pytest.mark.parametrize("psi", [0.4, 2.0, 5.1])
    def test_it_is_moved_by_ten_times_what_the_trim_says(self, bent: Solution, psi: float):
        """Against displacements by which hub loads are tested, less flapping; a flapped blade is 4° steep: 1 %."""
        adjoint = Analysis(bent).adjoint
        b = adjoint.problem.bending
        assert b is not None
        q, _ = coordinates_of(b, adjoint.point.system.structure, adjoint.point.z)
        count = 360
        k = round(math.degrees(psi))
        psi = math.radians(k)
        _, v, w = (own[:, k] for own in displacements(b, q, 0.0, count))
        c, radius = bent.controls, bent.design.rotor.radius
        flap = c.coning + c.flap_1c * math.cos(psi) + c.flap_1s * math.sin(psi)
        shape = blade_shape(bent.design.rotor)
        expected = [
            np.interp(shape.r, b.r, radius * own, left=0.0)
            for own in (v, w - flap * (b.r - b.r[0]))
        ]
        crooked, plain = (
            flown_form(bent, VIEW, psi, shown).vertices(shape) for shown in (True, False)
        )
        moved = crooked - plain
        rings = moved[: -2 * PAGE.points - 2].reshape(-1, PAGE.points, 3)
        assert np.ptp(rings, axis=1).max() < 1e-12  # Each section as a whole.
        seen = on_disk(bent, psi, rings[:, 0]) / BENDING_SHOWN
        largest = float(np.abs(expected).max())
        assert largest > 0.01
        assert_allclose(seen[:, 1:].T, expected, atol=0.01 * largest)

    def test_every_blade_is_bent_at_its_own_azimuth_while_the_rotor_turns(self, bent: Solution):
        assert follows_azimuth(bent)
        forms, shape = turned_blades(bent, VIEW).forms, blade_shape(bent.design.rotor)
        for k, form in enumerate(forms):
            expected = flown_form(bent, VIEW, math.radians(VIEW.azimuth_deg) + 0.5 * math.pi * k)
            assert_allclose(form.vertices(shape), expected.vertices(shape), atol=1e-9)
        assert np.abs(forms[0].vertices(shape) - forms[1].vertices(shape)).max() > 0.1

    def test_files_show_it_straight_and_bending_off_is_straight(
        self, bent: Solution, straight: Solution
    ):
        """Nothing in them could say that it is drawn larger."""
        assert all(form.bent is None for form in make_picture(bent, VIEW, bent=False).blades.forms)
        assert drawn_bending(straight, [0.5, 1.0], 1.0) is None


def state(solution: Solution, pinned: Solution | None = None) -> SessionState:
    return SessionState(FAST, VIEW, solution, solution, pinned)


@pytest.fixture
def page() -> PanelPage:
    return PanelPage(VIBRATION, inputs=FAST, texts=("switch.bending",))


class TestPanel:
    def test_the_index_comes_at_once_and_its_band_at_rest(
        self, page: PanelPage, bent: Solution, loads: HubLoads
    ):
        page.show(state(bent))
        next(page.updater.work(soon=False))  # Newer input leaves the band for later.
        row = page.shown["vibration"]
        assert row.index == f"{loads.index:.1f}"
        assert row.band == "band over inflow models: computing"
        assert "0.5 aft, 0.67 to starboard, 1 vertical" in row.title
        assert row.at == "at 4/rev"
        page.rest()
        low, high = map(float, re.findall(r"[\d.]+", page.shown["vibration"].band))
        assert low <= float(row.index) <= high
        assert low < high
        assert re.fullmatch(r"[+−]\d+\.\d kW here", page.shown["switch.bending"])
        assert page.shown["hub_labels"][0].text == "bending × 10"

    def test_it_is_compared_with_a_also_where_a_is_rigid(
        self, page: PanelPage, bent: Solution, straight: Solution
    ):
        """3/rev twist against the same blade without; A's index is that of the same blade with bending."""
        twisted = solve(
            inputs_from("1;uh60a;mu=0.3;bending=true;twist_per_rev=3:1:60").design()
        ).require()
        page.show(state(twisted, straight))
        assert page.shown["vibration"].change == ""
        page.rest()
        row, of_a = page.shown["vibration"], hub_loads(bent, band=False)
        percent, low, high = (
            float(end.replace("−", "-")) for end in re.findall(r"[+−]?\d+", row.change)
        )
        assert percent == pytest.approx(100.0 * (float(row.index) / of_a.index - 1.0), abs=2.0)
        assert low <= percent <= high
        assert low < high
        assert row.kind == ("good" if high < 0.0 else "bad" if low > 0.0 else "")
        assert row.change.endswith("% vs. A" if row.kind else "% vs. A: unclear")

    def test_slow_flight_and_unknown_blades_have_a_sentence(self, page: PanelPage):
        slow = solve(replace(FAST, advance_ratio=0.15).design()).require()
        page.show(state(slow))
        assert page.shown["vibration"].sentence.startswith("Hub loads are not shown below µ 0.2")
        assert page.shown["vibration"].index == ""
        assert [one.text for one in page.shown["hub_labels"]] == ["bending × 10"]
        page.show(
            state(solve(replace(with_rotor(FAST, "r22"), advance_ratio=0.2).design()).require())
        )
        assert "the stiffness of the Robinson R22 blade" in page.shown["vibration"].sentence
        assert page.shown["hub_labels"] == []
        assert page.shown["switch.bending"].startswith("The stiffness of the Robinson R22 blade")

    def test_a_rotor_on_a_stand_has_its_thrust_for_weight(self, page: PanelPage):
        hart = solve(replace(with_rotor(FAST, "hart2"), advance_ratio=0.3).design()).require()
        page.show(state(hart))
        assert page.shown["vibration"].unit == "% of thrust"

    def test_without_bending_nothing_is_computed(
        self, page: PanelPage, straight: Solution, monkeypatch: pytest.MonkeyPatch
    ):
        def never(*_: Any, **__: Any) -> None:
            raise AssertionError("computed without bending")

        for name in ("hub_loads", "solve", "analyse"):
            monkeypatch.setattr(vibration, name, never)
        page.show(state(straight))
        page.rest()
        assert page.shown["vibration"] is None
