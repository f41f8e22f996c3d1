"""The 3D scene in a real browser: the blade twisted by hand, the turning rotor, the gloss of its surfaces."""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from watched import Watched

from explorer.picture.wake import tip_vortices
from explorer.state import Inputs
from rotor.trim.solve import solve

pytestmark = pytest.mark.browser
START = Inputs(law="two", two_inner=-14.0, two_outer=-8.0, two_division=0.5)
SIZE = (1280, 720)
ON_SCREEN = """r => {
    const viewer = window.__viserMutable, blade = viewer.nodeRefFromName['/rotor/blade_0'];
    blade.updateWorldMatrix(true, false);
    const at = blade.position.clone().set(r, -0.1, 0).applyMatrix4(blade.matrixWorld).project(viewer.camera);
    const box = viewer.canvas.getBoundingClientRect();
    return [box.left + (at.x + 1) / 2 * box.width, box.top + (1 - at.y) / 2 * box.height];
}"""
"""Pixel of a point of the reference blade, so far from its hinge [m]."""
_PASSIVE = "Unable to preventDefault inside passive event listener"
"""What the browser says of viser's own listener when a node is dragged."""
VORTEX = """() => {
    let first = null;
    window.__viserMutable.nodeRefFromName['/rotor/vortices']?.traverse(part => {
        const data = part.visible && part.geometry?.attributes?.instanceStart?.data;
        if (data) first = Array.from(data.array.slice(0, 3));
    });
    return first;
}"""
"""Where the first tip vortex begins [m]."""
AZIMUTH = """() => {
    const hinge = window.__viserMutable.nodeRefFromName['/rotor/blade_0'].position;
    return Math.atan2(hinge.y, hinge.x);
}"""


@pytest.fixture
def watched(shared: Watched) -> Iterator[Watched]:
    shared.reset()
    assert [value(shared, label) for label in ("Inboard", "Outboard", "Break point")] == [-14.0, -8.0, 0.5]
    shared.at_rest(lambda: shared.page.evaluate("() => window.__viserMutable.camera.position.toArray()"))
    yield shared
    assert [said for said in shared.complaints if _PASSIVE not in said] == []


def value(watched: Watched, label: str) -> float:
    return float(watched.row(label).locator("input:not([type=hidden])").last.input_value())


def drag(watched: Watched, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Press, move in steps as a hand does, and stay pressed."""
    mouse = watched.page.mouse
    mouse.move(*start)
    watched.page.wait_for_timeout(300)
    mouse.down()
    for k in range(1, 11):
        mouse.move(*(a + (b - a) * k / 10 for a, b in zip(start, end, strict=True)))
        watched.page.wait_for_timeout(40)
    watched.answered()


def test_dragging_the_tip_up_turns_it_and_one_undo_takes_it_back(watched: Watched):
    page = watched.page
    camera: Any = page.evaluate("() => window.__viserMutable.camera.position.toArray()")
    x, y = page.evaluate(ON_SCREEN, 7.2)
    drag(watched, (x, y), (x, y - 80.0))
    page.wait_for_function("() => RX.state.hand?.place.startsWith('tip')")
    # While it is held, the camera stands still, and an arc shows the turn and the turn of least power.
    assert page.evaluate("() => window.__viserMutable.camera.position.toArray()") == pytest.approx(camera, abs=1e-6)
    turned = "RX.state.arc?.best !== null && RX.state.arc.to > RX.state.arc.from"
    page.wait_for_function(f"() => {turned} && RX.part('arc').childElementCount > 4")
    arc = page.evaluate("() => RX.state.arc")
    assert arc["to"] > arc["from"] > arc["best"]  # Turned up from −8 °/R, away from the optimum.
    assert arc["words"].startswith("+")
    page.mouse.up()
    page.wait_for_function("() => RX.state.hand === null && RX.state.arc === null")
    page.wait_for_function("() => !RX.part('arc').childElementCount")
    outer = watched.at_rest(lambda: value(watched, "Outboard"))
    assert outer > -7.0
    assert value(watched, "Inboard") == -14.0
    # Released, the camera follows the shaft tilt; an orbit would have moved it by metres.
    assert page.evaluate("() => window.__viserMutable.camera.position.toArray()") == pytest.approx(camera, abs=0.4)
    page.evaluate("() => RX.send('undo', '')")
    watched.until_changed(lambda: value(watched, "Outboard"), outer)
    assert watched.at_rest(lambda: value(watched, "Outboard")) == -8.0


def test_dragging_along_the_blade_moves_the_division(watched: Watched):
    start, end = (tuple(watched.page.evaluate(ON_SCREEN, r)) for r in (3.75, 4.6))
    drag(watched, start, end)
    watched.page.mouse.up()
    watched.until(lambda: value(watched, "Break point") != 0.5)
    moved = watched.at_rest(lambda: value(watched, "Break point"))
    assert moved == pytest.approx(0.5 + (4.6 - 3.75) / 8.18, abs=0.04)
    assert (value(watched, "Inboard"), value(watched, "Outboard")) == (-14.0, -8.0)


def test_play_turns_the_blades_smoothly_and_they_come_to_rest_where_the_view_has_them(watched: Watched):
    page = watched.page
    still = page.evaluate(AZIMUTH)
    page.evaluate("() => RX.send('play', '')")
    page.wait_for_function(f"still => Math.abs(({AZIMUTH})() - still) > 0.3", arg=still)

    def smooth() -> bool:
        """Nearly every frame moves it on, not 20 a second, and never back."""
        seen = page.evaluate(
            f"""async () => {{
                const seen = [];
                for (let k = 0; k < 40; k++) {{
                    await new Promise(requestAnimationFrame);
                    seen.push(({AZIMUTH})());
                }}
                return seen;
            }}"""
        )
        steps = [math.remainder(b - a, 2 * math.pi) for a, b in pairwise(seen)]
        return sum(step > 0.0 for step in steps) > 20 and min(steps) > -0.05

    watched.until(smooth)
    # Tip vortices turn with it: each begins at the tip of its blade.
    page.wait_for_function(f"() => ({VORTEX})()")
    tip, turned = page.evaluate(f"() => [({VORTEX})(), rotorScene.psi]")
    solution = solve(START.design())
    expected = tip_vortices(solution, [turned])[0][0, 0]
    np.testing.assert_allclose(tip, expected, atol=0.02)
    page.evaluate("() => RX.send('play', '')")
    page.wait_for_function("() => !RX.state.turn.playing")
    shown = watched.at_rest(lambda: round(page.evaluate(AZIMUTH), 3))
    stands = math.radians(float(page.evaluate("() => RX.state.turn.psi")))
    assert math.remainder(shown - stands, 2 * math.pi) == pytest.approx(0.0, abs=0.02)


def test_the_scene_dresses_its_surfaces(watched: Watched):
    """Gloss on the head, and flat pictures that do not hide what lies behind their corners."""
    watched.page.wait_for_function(
        """() => {
            const node = name => window.__viserMutable.nodeRefFromName[name];
            let head = null, field = null;
            node('/rotor/head').traverse(part => { if (part.isMesh) head = part.material; });
            node('/rotor/disk/field').traverse(part => { if (part.isMesh) field = part.material; });
            return head?.metalness === 0.55 && field?.depthWrite === false;
        }"""
    )


def test_the_speed_of_play_is_chosen_beside_the_button(watched: Watched):
    button = watched.page.locator(".rxf-turn [data-do=pace]")
    names = []
    for _ in range(3):
        names.append(button.inner_text())
        assert button.get_attribute("aria-label") == f"Speed of the turning rotor: {names[-1]}"
        button.click()
        watched.until_changed(button.inner_text, names[-1])
    assert names == ["normal", "fast", "slow"]
