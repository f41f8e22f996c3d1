"""The scene of one session: what the page is told, lines at rest, ranges held, A beside B, the turning rotor."""

import json
import math
from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import viser

from explorer.hosting import viser_compat
from explorer.model.inputs import ViewState
from explorer.picture.blade_mesh import blade_shape, overlay_segments
from explorer.picture.fields import FIELDS, Field, usual_range
from explorer.picture.picture import field_values, flown_twist
from explorer.picture.polar import DrawnSolution, polar_grid
from explorer.scene.controller import SceneController
from explorer.scene.overlays import OtherBlade
from rotor import Solution, make_design, solve
from rotor.design.twist import LinearTwist

ROTOR = make_design().rotor
VIEW = ViewState()


class Shown:
    """What a display was told."""

    def __init__(self) -> None:
        self.calls: list[tuple[str, tuple[float, float], bool, tuple[bool, bool]]] = []

    def show_range(
        self,
        field: Field,
        colour_range: tuple[float, float],
        faded: bool,
        beyond: tuple[bool, bool],
    ) -> None:
        self.calls.append((field.title, colour_range, faded, beyond))


class Page:
    """A scene without a browser: its handles, and the scripts that the page would run."""

    def __init__(self, server: viser.ViserServer) -> None:
        self.scripts: list[str] = []
        queue = SimpleNamespace(queue_message=lambda message: self.scripts.append(message.source))
        client: Any = SimpleNamespace(
            scene=server.scene, atomic=nullcontext, flush=lambda: None, _websock_connection=queue
        )
        self.shown = Shown()
        camera: Any = SimpleNamespace(follow=lambda tilt: None)
        self.controller = SceneController(client, camera, ROTOR, self.shown.show_range)
        self._nodes = server.scene._handle_from_node_name

    def __getitem__(self, name: str) -> Any:
        return self._nodes[name]

    def told(self, function: str) -> list[Any]:
        """The arguments of each call of a function of the page."""
        begin = f"rotorDisk.{function}("
        return [
            json.loads(f"[{script[len(begin) : -1]}]")
            for script in self.scripts
            if script.startswith(begin)
        ]

    def pitch(self, node: str) -> list[float]:
        """Of each ring of the blade that was shaped last there [rad]."""
        return next(forms[node][0] for (forms,) in reversed(self.told("form")) if node in forms)


def unpacked(text: str) -> np.ndarray:
    """Numbers 0…255 from their differences, as `disk.js` reads them."""
    steps = np.array([ord(letter) - ord("#") for letter in text])
    return np.cumsum(np.where(steps % 2, -(steps + 1) // 2, steps // 2)) % 256


@pytest.fixture
def page() -> Iterator[Page]:
    server = viser_compat.quiet_server("127.0.0.1", 0, "test")
    yield Page(server)
    viser_compat.quiet_stop(server)


@pytest.fixture(scope="module")
def changed() -> Solution:
    return solve(replace(make_design(mu=0.3), twist=LinearTwist(math.radians(-6.0)))).require()


class TestFrame:
    def test_the_disk_goes_as_numbers_once(self, page: Page, fast: Solution):
        """Values within a step of the 254 of the colour range, margins with the sign that they have."""
        view = replace(VIEW, field="Mach number")
        page.controller.draw(fast, view, None)
        page.controller.draw_at_rest()
        ((root, numbers),) = page.told("paint")
        assert root == "/rotor"
        radii, azimuths, inner, _ = numbers["grid"]
        grid, drawn = polar_grid(fast.disk, radii, azimuths), DrawnSolution(fast)
        assert inner == pytest.approx(fast.disk.edges[0])
        values, u_t, attached, _ = (unpacked(text).reshape(grid.shape) for text in numbers["texts"])
        field = FIELDS["Mach number"]
        shown = field.low + (values - 1) / 254.0 * (field.high - field.low)
        np.testing.assert_allclose(
            shown, field.sample(drawn, grid).clip(field.low, field.high), atol=0.9 / 500
        )
        for margin, exact in ((u_t, drawn.flow(grid).u_t), (attached, drawn.flow(grid).attached)):
            sure = np.abs(exact) > 1e-3
            assert np.array_equal((margin > 128)[sure], (exact > 0.0)[sure])

    def test_every_blade_has_the_twist_of_its_azimuth(self, page: Page, changed: Solution):
        page.controller.draw(changed, VIEW, None)
        for k in (0, 2):
            twist = flown_twist(changed, math.radians(VIEW.azimuth_deg + 90.0 * k))
            expected = blade_shape(ROTOR).pitch(twist, VIEW.exaggeration)
            np.testing.assert_allclose(page.pitch(f"/rotor/blade_{k}"), expected, atol=1e-5)

    def test_a_turned_blade_leaves_the_disk_alone(self, page: Page, fast: Solution):
        page.controller.draw(fast, VIEW, None)
        page.controller.draw(fast, replace(VIEW, azimuth_deg=120.0), None)
        assert len(page.told("paint")) == 1
        hub = page["/rotor/blade_0"].position
        assert math.degrees(math.atan2(hub[1], hub[0])) == pytest.approx(120.0)


class TestScale:
    def test_it_is_that_of_the_disk_that_is_drawn(
        self, page: Page, fast: Solution, changed: Solution
    ):
        """B − A by itself, but each as it is where A is wiped over B; none where no disk is in sight."""
        field, view = FIELDS[VIEW.field], replace(VIEW, difference=True)
        assert page.controller.scale is None
        page.controller.draw(fast, view, None, changed)
        page.controller.draw_at_rest()
        difference = page.controller.scale
        assert difference[0].note
        assert difference[1] == page.controller.held_range(difference[0]) != (field.low, field.high)
        page.controller.draw(fast, replace(view, wipe=True), None, changed)
        assert page.controller.scale == (field, (field.low, field.high))
        page.controller.set_behind(True)
        assert page.controller.scale is None


def rigid(solution: Solution) -> Solution:
    design = solution.design
    return solve(replace(design, models=replace(design.models, elastic_twist=False))).require()


class TestOverlay:
    def test_an_unchanged_blade_is_seen_against_its_own_jig_shape(self, page: Page, fast: Solution):
        """By its edges alone: its surface would cut the flown one at small angles."""
        page.controller.draw(fast, VIEW, None)
        page.controller.draw_at_rest()
        assert page["/rotor/blade_0/overlay"].visible
        assert not page["/rotor/blade_0/other"].visible
        flown = flown_twist(fast, math.radians(VIEW.azimuth_deg))
        edges = overlay_segments(
            ROTOR, ROTOR.builtin_twist, flown, VIEW.exaggeration, math.radians(0.25)
        )
        np.testing.assert_allclose(page["/rotor/blade_0/overlay"].points, edges, atol=1e-5)

    def test_it_turns_with_the_elastic_twist_of_the_blade(self, page: Page, changed: Solution):
        """The jig shape stands still in the blade's axes; another blade has the elastic twist of each azimuth."""
        page.controller.draw(changed, VIEW, None)
        before = np.array(page.pitch("/rotor/blade_0/other"))
        page.controller.draw(changed, replace(VIEW, azimuth_deg=270.0), None)
        assert np.abs(page.pitch("/rotor/blade_0/other") - before).max() > math.radians(1.0)

    def test_the_blade_as_built_stands_behind_a_changed_one(
        self, page: Page, fast: Solution, changed: Solution
    ):
        page.controller.draw(rigid(fast), VIEW, None)
        assert not page["/rotor/blade_0/other"].visible
        page.controller.draw(changed, VIEW, None)
        assert page["/rotor/blade_0/other"].visible
        assert not page["/rotor/blade_0/overlay"].visible  # Its edges follow at rest.
        page.controller.draw_at_rest()
        assert page["/rotor/blade_0/overlay"].visible

    def test_another_blade_can_take_its_place(self, page: Page, changed: Solution):
        other = OtherBlade(ROTOR, changed.design.twist, (255, 176, 0))
        page.controller.draw(rigid(changed), VIEW, other)
        assert not page["/rotor/blade_0/other"].visible  # The same twist: nothing to tell apart.
        page.controller.draw(changed, VIEW, replace(other, twist=LinearTwist(-0.3)))
        assert page["/rotor/blade_0/other"].visible
        assert tuple(page["/rotor/blade_0/other"].color) == (255, 176, 0)


class TestRanges:
    def test_a_range_holds_across_designs_until_a_fit_is_asked_for(self, page: Page):
        view = replace(VIEW, field="Thrust dT/dr")
        light, heavy = (
            solve(make_design(mu=0.3, mass_kg=mass)).require() for mass in (5200.0, 10500.0)
        )
        for solution in (light, heavy):
            page.controller.draw(solution, view, None)
            page.controller.draw_at_rest()
        assert {held for _, held, _, _ in page.shown.calls} == {
            usual_range(FIELDS["Thrust dT/dr"], ROTOR)
        }
        for order, fits in (("Rescale", True), ("Default", False)):
            page.controller.order_range(order)
            page.controller.draw(heavy, replace(view, azimuth_deg=30.0 + 10.0 * fits), None)
            assert (page.shown.calls[-1][1] != usual_range(FIELDS["Thrust dT/dr"], ROTOR)) == fits

    @pytest.mark.parametrize("rotor", ["uh60a", "r22", "bo105"])
    def test_usual_ranges_show_the_field_of_any_rotor(self, rotor: str):
        """Hardly anything beyond, and not all of it in a few colours: also for rotors of other size and speed.

        But for dynamic stall, of which there is little in ordinary flight.
        """
        for mu in (0.1, 0.2, 0.3):
            solution = solve(make_design(rotor=rotor, mu=mu)).require()
            for field in FIELDS.values():
                values = field_values(solution, field)
                if values.size:
                    low, high = usual_range(field, solution.design.rotor)
                    seen = np.quantile(values, (0.02, 0.98))
                    case = field.title, mu, low, high, seen
                    # Where nothing is stalled the vortex is zero to some digits.
                    hair = 1e-3 * (high - low)
                    assert np.mean((values < low - hair) | (values > high)) < 0.13, case
                    assert (
                        field.two_sided
                        or field.needs == "unsteady"
                        or seen[1] - seen[0] > 0.18 * (high - low)
                    ), case


class TestWipe:
    def test_a_stands_at_the_place_of_b_at_rest(
        self, page: Page, fast: Solution, changed: Solution
    ):
        page.controller.draw(changed, replace(VIEW, wipe=True), None, fast)
        page.controller.draw_at_rest()
        assert page["/compared"].visible
        assert page.pitch("/compared/blade_0") != page.pitch("/rotor/blade_0")
        assert [root for root, _ in page.told("paint")] == ["/rotor", "/compared"]
        assert sum(script.startswith("rotorScene.compare({") for script in page.scripts) == 1
        page.controller.draw(changed, VIEW, None)
        page.controller.draw_at_rest()
        assert not page["/compared"].visible
        assert page.scripts[-1] == "rotorScene.compare(null)"


class TestPlay:
    def test_the_page_turns_the_blades_and_the_scene_leaves_them(self, page: Page, fast: Solution):
        page.controller.draw(fast, VIEW, None)
        page.controller.draw_at_rest()
        assert page["/rotor/vortices"].visible
        before = page["/rotor/blade_0"].wxyz.copy()
        page.controller.play(True)
        page.controller.draw(fast, replace(VIEW, azimuth_deg=90.0), None)
        assert np.array_equal(page["/rotor/blade_0"].wxyz, before)
        assert page.scripts[-1] == f"rotorScene.turn({math.pi / 2:.4f})"
        assert page["/rotor/vortices"].visible  # The page moves them too.
        page.controller.play(False)
        assert page.scripts[-1] == "rotorScene.stop()"
        assert not np.array_equal(page["/rotor/blade_0"].wxyz, before)
        assert page["/rotor/vortices"].visible

    def test_a_slider_that_moves_meanwhile_changes_how_the_blades_flap(
        self, page: Page, fast: Solution, changed: Solution
    ):
        page.controller.draw(fast, VIEW, None)
        page.controller.play(True)
        page.controller.draw(changed, VIEW, None)
        told = [script for script in page.scripts if script.startswith("rotorScene.move")]
        assert len(told) == 2
        assert f"{changed.controls.coning}" in told[-1]


class TestOverlays:
    def test_vortices_are_switched(self, page: Page, fast: Solution):
        for wake in (True, False):
            page.controller.draw(fast, replace(VIEW, wake=wake), None)
            page.controller.draw_at_rest()
            assert page["/rotor/vortices"].visible == wake

    def test_a_lost_trim_greys_the_disk(self, page: Page, fast: Solution):
        page.controller.draw(fast, VIEW, None)
        page.controller.fade(fast, VIEW)
        assert page.shown.calls[-1][2]
        vivid, grey = (
            np.frombuffer(bytes.fromhex(ink["map"]), np.uint8).reshape(-1, 3).astype(int)
            for _, ink in page.told("ink")
        )
        assert np.ptp(vivid, axis=1).mean() > 50
        assert np.array_equal(grey, np.repeat(grey[:, :1], 3, axis=1))
        assert page.told("paint")[-1][1]["texts"][2:] == [None, None]  # Nothing is marked on it.
