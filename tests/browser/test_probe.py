"""The probe, play, views and keys in a real browser."""

import math
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest
from watched import Watched

from explorer.model.inputs import Inputs
from explorer.picture.camera_views import Covered, View, fit, seen_at
from rotor.files.make_design import uh60a_rotor
from rotor.trim.solve import solve

SIZE = (1500, 940)  # Room for the disk between drawer, rail and cards.
START = Inputs(law="builtin")
RADIUS = uh60a_rotor("flight").radius


@pytest.fixture
def watched(shared: Watched) -> Iterator[Watched]:
    """As the test before left it."""
    if shared.page.evaluate("() => RX.state.bar.drawer") != "probe":
        shared.drawer("probe")
    yield shared
    assert shared.complaints == []


ON_BLADE = "/rotor/blade_0/probe"
"""The ring about the section that is probed."""


def pose(watched: Watched, name: str) -> list[float]:
    return watched.page.evaluate(
        "name => window.__viserMutable.nodeRefFromName[name].quaternion.toArray()", name
    )


def eye(watched: Watched) -> np.ndarray:
    """Where the camera is, in the axes of the rotor."""
    x, y, z = watched.page.evaluate(
        "() => window.__viserMutable.cameraControl.camera.position.toArray()"
    )
    return np.array([-z, -x, y])  # three.js has y up; the session's world is turned against it.


def _cover(watched: Watched) -> Covered:
    """What cards cover of the canvas, as the page says."""
    return Covered(*watched.page.evaluate("() => RX.covered"))


@cache
def _tilt() -> float:
    """Of the shaft [rad], which the camera follows."""
    return solve(START.design()).controls.shaft_tilt


def stands(watched: Watched, view: View) -> bool:
    """Whether the camera is where a view has it."""
    aspect = watched.page.evaluate(
        "() => (c => c.clientWidth / c.clientHeight)(document.querySelector('canvas'))"
    )
    place = eye(watched)
    wanted = fit(view, RADIUS, aspect, tilt=_tilt(), cover=_cover(watched)).position
    away = np.linalg.norm(place) / np.linalg.norm(wanted) - 1.0
    return bool(abs(away) < 0.02 and np.isclose(place[2], wanted[2], rtol=0.03))


def click_disk(watched: Watched, r: float, psi_deg: float) -> tuple[float, float]:
    """Click where the plan shows (r, ψ); the pixel of it."""
    box = watched.box(watched.page.locator("canvas").first)
    aspect = box["width"] / box["height"]
    camera = fit("top", RADIUS, aspect, cover=_cover(watched))
    psi = math.radians(psi_deg)
    point = RADIUS * r * np.array([[math.cos(psi), math.sin(psi), 0.0]])
    [(across, down)] = seen_at(camera, point, aspect)
    place = box["x"] + across * box["width"], box["y"] + down * box["height"]
    watched.page.mouse.click(*place)
    return place


def test_a_click_on_the_disk_sets_the_probe_and_shows_it(watched: Watched):
    page = watched.page
    page.evaluate("() => RX.send('drawer', '')")
    watched.until(lambda: not watched.seen(ON_BLADE))
    page.keyboard.press("2")
    watched.until(lambda: stands(watched, "top"))
    watched.at_rest(lambda: eye(watched).round(2).tolist())
    blade = pose(watched, "/rotor/blade_0")
    place = click_disk(watched, 0.6, 300.0)
    watched.until_changed(lambda: pose(watched, "/rotor/blade_0"), blade)
    page.wait_for_function(
        "() => document.querySelector('[data-explorer=probe-place]').innerText.includes('retreating')"
    )
    watched.until(lambda: watched.number("Radius r/R") == pytest.approx(0.6, abs=0.02))
    watched.until(lambda: watched.number("Azimuth") == pytest.approx(300.0, abs=2.0))
    watched.until(lambda: watched.seen(ON_BLADE))
    watched.reads("probe-alpha", "^α")
    label = page.locator('[data-explorer="labels"]').get_by_text("α")
    label.wait_for()

    def beside_the_place() -> bool:
        box = label.bounding_box()
        if box is None:  # Drawn anew at this moment.
            return False
        apart = box["x"] + box["width"] / 2 - place[0], box["y"] + box["height"] - place[1]
        return abs(apart[0]) < 40 and -60 < apart[1] < 20

    watched.until(beside_the_place)


def test_arrow_keys_step_the_probe_and_leave_the_camera_alone(watched: Watched):
    page = watched.page
    page.evaluate("() => document.activeElement?.blur()")
    watched.at_rest(lambda: eye(watched).round(6).tolist())

    def place() -> tuple[float, float]:
        return watched.number("Radius r/R"), watched.number("Azimuth")

    (r, psi), camera = place(), eye(watched)
    for key in ("ArrowUp", "Shift+ArrowUp", "ArrowRight", "Shift+ArrowLeft"):
        before = place()
        page.keyboard.press(key)
        watched.until_changed(place, before)
    watched.until(lambda: watched.number("Radius r/R") == pytest.approx(r + 0.11, abs=1e-9))
    watched.until(
        lambda: watched.number("Azimuth") == pytest.approx((psi + 1 - 10) % 360, abs=1e-9)
    )
    np.testing.assert_allclose(eye(watched), camera, atol=1e-6)


def test_sliders_step_finely_and_coarsely_and_their_number_follows(watched: Watched):
    page, row = watched.page, watched.row("Adv. ratio")
    slider, field = row.get_by_role("slider"), watched.field("Adv. ratio")
    for key, change in (
        ("ArrowRight", 0.005),
        ("Shift+ArrowLeft", -0.05),
        ("PageUp", 0.05),
        ("ArrowLeft", -0.005),
    ):
        before = float(field.input_value())
        slider.focus()
        page.keyboard.press(key)
        wanted = round(min(max(before + change, 0.0), 0.45), 3)
        watched.until(lambda wanted=wanted: float(field.input_value()) == wanted)
        watched.until(
            lambda wanted=wanted: float(slider.get_attribute("aria-valuenow") or "nan") == wanted
        )
    field.focus()
    typed = field.input_value()
    page.keyboard.press("ArrowUp")
    watched.until(lambda: field.input_value() != typed)
    watched.until(
        lambda: float(slider.get_attribute("aria-valuenow") or "nan") == float(field.input_value())
    )
    page.keyboard.press("Escape")
    assert page.evaluate("() => document.activeElement.tagName") != "INPUT"


ON_MESH = """r => {
    const client = window.__viserMutable, blade = client.nodeRefFromName['/rotor/blade_0'];
    const box = client.canvas.getBoundingClientRect();
    let mesh = null;
    blade.traverse(one => { if (one.isMesh && !one.isLineSegments2) mesh ??= one; });
    const all = mesh.geometry.attributes.position, x = [...Array(all.count).keys()].map(k => all.getX(k));
    const near = x.reduce((a, b) => Math.abs(b - r) < Math.abs(a - r) ? b : a);
    const ring = x.flatMap((v, k) => v === near ? [k] : []);
    const mean = read => ring.reduce((sum, k) => sum + all[read](k), 0) / ring.length;
    blade.updateWorldMatrix(true, false);
    const middle = blade.position.clone().set(near, mean('getY'), mean('getZ')).applyMatrix4(blade.matrixWorld);
    const at = middle.project(client.camera);
    return [box.left + (at.x + 1) / 2 * box.width, box.top + (1 - at.y) / 2 * box.height, near];
}"""
"""Pixel of the middle of the drawn blade's section so far from the hinge [m], and how far that section is."""


@pytest.mark.parametrize("psi_deg", [60, 340])
def test_a_click_on_the_blade_picks_the_section_that_is_clicked_and_keeps_the_azimuth(
    watched: Watched, psi_deg: int
):
    page, hinge = watched.page, uh60a_rotor("flight").blade.flap_hinge * RADIUS
    page.keyboard.press("1")
    page.evaluate("psi => RX.send('azimuth', psi)", psi_deg)
    watched.until(lambda: watched.number("Azimuth") == psi_deg)
    for r in (0.98, 0.78, 0.54, 0.35):
        x, y, out = watched.at_rest(lambda r=r: page.evaluate(ON_MESH, r * RADIUS - hinge))
        page.mouse.move(x, y)
        watched.until(
            lambda: page.evaluate("() => window.__viserMutable.canvas.style.cursor") == "grab"
        )
        page.mouse.click(x, y)
        watched.until(
            lambda out=out: abs(watched.number("Radius r/R") - (out + hinge) / RADIUS) <= 0.02
        )
        watched.answered()
        assert watched.number("Azimuth") == psi_deg
        assert watched.seen(ON_BLADE)


def test_a_double_click_beside_the_disk_brings_the_camera_back(watched: Watched):
    page = watched.page
    # The drawer of a section that was pressed lies over the place beside the disk.
    page.keyboard.press("Escape")
    page.wait_for_function("() => !RX.state.bar.drawer")
    page.keyboard.press("1")
    before = watched.at_rest(lambda: eye(watched).round(2).tolist())
    box = watched.box(page.locator("canvas").first)
    x, y = box["x"] + 0.04 * box["width"], box["y"] + 0.35 * box["height"]
    watched.drag(x, y, by=(150.0, 40.0))
    watched.until_changed(lambda: eye(watched).round(2).tolist(), before)
    watched.at_rest(lambda: eye(watched).round(2).tolist())
    page.mouse.dblclick(x, y)
    watched.until(lambda: np.allclose(eye(watched), before, atol=0.05))


def test_a_double_click_on_a_slider_or_its_name_sets_the_default_and_can_be_undone(
    watched: Watched,
):
    watched.reset()
    page, row = watched.page, watched.row("Adv. ratio")
    default = watched.number("Adv. ratio")
    for target in (row.locator(".mantine-Slider-thumb"), row.locator("label").first):
        watched.press("Adv. ratio", "ArrowRight", 4)
        watched.until(lambda: watched.number("Adv. ratio") == pytest.approx(default + 0.02))
        watched.answered()
        target.dblclick()
        watched.until(lambda: watched.number("Adv. ratio") == default)
        watched.answered()
    page.evaluate("() => document.activeElement?.blur()")
    page.keyboard.press("Control+z")
    watched.until(lambda: watched.number("Adv. ratio") == pytest.approx(default + 0.02))
    row.locator("label").first.dblclick()
    watched.until(lambda: watched.number("Adv. ratio") == default)


def test_the_blade_stops_for_the_hand_that_takes_it(watched: Watched):
    page = watched.page
    # Its button is on a card: a drawer that a press on the disk has opened lies over it.
    page.keyboard.press("Escape")
    page.wait_for_function("() => !RX.state.bar.drawer")
    watched.drawer("probe")
    page.keyboard.press("Space")
    page.get_by_role("button", name="Stop the rotor").wait_for()
    radius = watched.number("Radius r/R")
    page.keyboard.press("ArrowUp")  # The radius alone: it plays on.
    watched.until(lambda: watched.number("Radius r/R") != radius)
    assert page.get_by_role("button", name="Stop the rotor").count()
    page.keyboard.press("Shift+ArrowRight")
    page.get_by_role("button", name="Turn the rotor").wait_for()


SEAT = """out => {
    const viewer = window.__viserMutable, blade = viewer.nodeRefFromName['/rotor/blade_0'];
    blade.updateWorldMatrix(true, false);
    const at = blade.position.clone().set(out, 0, 0).applyMatrix4(blade.matrixWorld).project(viewer.camera);
    const horizon = getComputedStyle(document.documentElement).getPropertyValue('--rx-horizon');
    return [(at.x + 1) / 2, (1 - at.y) / 2, parseFloat(horizon) / 100];
}"""
"""Where the section so far from the hinge [m] is on the canvas, from the left and from above, and the horizon."""


@pytest.mark.slow
def test_a_ride_goes_round_with_the_section_and_esc_leads_back(watched: Watched):
    page = watched.page
    page.keyboard.press("1")
    watched.until(lambda: stands(watched, "3d"))  # A busy machine begins the flight late.
    page.locator("[data-do=view][data-value=ride]").click()  # With the section of the drawer.
    card = page.locator("[data-explorer=ride]")
    card.wait_for()
    place = page.evaluate("() => [RX.state.ride.r, RX.state.ride.out]")
    assert place[1] == pytest.approx(place[0] * RADIUS, rel=1e-3)
    first = card.locator("b").inner_text()
    watched.until_changed(lambda: card.locator("b").inner_text(), first)
    # Beside the blade; elsewhere it sees the disk.
    watched.until(lambda: np.linalg.norm(eye(watched)) < 1.5 * RADIUS)
    assert card.locator("[data-flown]").count() == 1
    page.wait_for_timeout(1000)  # Until the camera has its seat.
    out = place[1] - uh60a_rotor("flight").blade.flap_hinge * RADIUS
    for _ in range(4):
        across, down, horizon = page.evaluate(SEAT, out)
        assert 0.3 < across < 0.7
        assert 0.02 < horizon < 0.35
        assert horizon < down < 0.8
        page.wait_for_timeout(1500)
    page.keyboard.press("Escape")
    card.wait_for(state="hidden")
    page.wait_for_function("() => !RX.state.ride")
    watched.until(lambda: np.linalg.norm(eye(watched)) > 3.0 * RADIUS)
    after = watched.at_rest(lambda: eye(watched).round(2).tolist())
    # The drawer has closed meanwhile: it is aimed for the room there is now.
    page.evaluate("() => RX.send('aim')")
    watched.answered()
    assert watched.at_rest(lambda: eye(watched).round(2).tolist()) == pytest.approx(after, abs=0.1)


SPANS = """() => ['[data-explorer=ride]', '.rxf-views', '.rxf-power', 'footer.rxf-strip', 'canvas'].map(name => {
    const {top, bottom} = document.querySelector(name).getBoundingClientRect();
    return [top, bottom];
})"""
"""Top and bottom [px] of a ride's card, of what stands beside it, and of the canvas."""
LEFT = """() => !RX.state.ride && !RX.state.ride_cost && RX.state.bar.drawer === ''
    && !document.documentElement.hasAttribute('data-ride') && document.querySelector('[data-explorer=ride]').hidden
    && ![...document.querySelectorAll('[data-turn]')].some(line => line.getAttribute('d'))"""
"""Whether nothing of a ride is left: card, price, drawer, lines on charts."""


@pytest.mark.slow
@pytest.mark.parametrize("way", ["Escape", "cross", "scene", "Ride", "Side"])
def test_the_view_ride_leaves_the_page_as_it_was(watched: Watched, way: str):
    page = watched.page
    page.keyboard.press("Escape")
    page.wait_for_function("() => !RX.state.bar.drawer")
    page.keyboard.press("1")
    watched.until(lambda: stands(watched, "3d"))
    azimuth = page.evaluate("() => RX.state.turn.psi")
    view = page.locator("[data-do=view][data-value=ride]")
    view.click()
    card = page.locator("[data-explorer=ride]")
    card.locator("b").wait_for()
    assert view.get_attribute("aria-pressed") == "true"
    watched.until(lambda: bool(page.evaluate(MARKED)))
    assert (
        page.locator("footer.rxf-strip").evaluate("strip => getComputedStyle(strip).opacity") == "1"
    )
    # At once: a ride ends by itself, and on a busy machine rest comes late.
    (top, bottom), *others, (above, below) = page.evaluate(SPANS)
    assert all(top >= end or bottom <= begin for begin, end in others)
    match way:
        case "Escape":
            page.keyboard.press("Escape")
        case "cross":
            card.get_by_role("button", name="Leave the blade").click()
        case "scene":
            assert above < top - 40.0 < below
            page.mouse.click(600.0, top - 40.0)
        case _:
            page.locator(".rxf-views").get_by_role("button", name=way).click()
    page.wait_for_function(LEFT)
    if way == "Side":
        watched.until(lambda: stands(watched, "side"))
    else:
        watched.until(lambda: stands(watched, "3d"))
    assert page.evaluate("() => RX.state.views.now") == ("side" if way == "Side" else "3d")
    watched.until(lambda: page.evaluate("() => RX.state.turn.psi") == azimuth)


MARKED = "() => [...document.querySelectorAll('[data-turn]')].some(line => line.getAttribute('d'))"


@pytest.mark.slow
def test_at_the_end_of_its_turn_a_ride_has_counted_what_stall_costs(watched: Watched):
    page = watched.page
    # With no section in the drawer it rides with the one over which most air separates.
    page.keyboard.press("Escape")
    page.wait_for_function("() => !RX.state.bar.drawer")
    page.evaluate("() => RX.send('slide', ['mass_t', 9.8])")
    watched.answered(wholly=True)
    page.keyboard.press("5")
    page.wait_for_function("() => RX.state.ride_cost?.spent.length && !RX.state.ride_cost.stale")
    ring = page.locator("[data-explorer=ride] [data-ring]")
    ring.locator("[data-separated]").first.wait_for(state="attached")
    at_end = "() => { const t = document.querySelector('[data-ring]')?.textContent; return t && !/so far/.test(t); }"
    page.wait_for_function(at_end)
    cost = page.locator("[data-cost]").text_content() or ""
    words = page.locator("[data-explorer=ride-cost]").inner_text()
    assert float(cost) > 1.0
    assert words.startswith("Stall costs ")
    assert words.endswith(f" {cost} kW")
    page.wait_for_function(LEFT)
    watched.reset()


def test_keys_are_listed_and_the_palette_finds_them(watched: Watched):
    page = watched.page
    page.keyboard.press("Shift+?")
    page.wait_for_selector("dialog.rx-dialog")
    text = page.locator("dialog.rx-dialog").inner_text()
    assert "Play or pause the rotor" in text
    page.keyboard.press("Escape")
    page.wait_for_selector("dialog.rx-dialog", state="detached")
    page.keyboard.press("Control+k")
    page.get_by_placeholder("Search commands").fill("hover")
    page.locator(".mantine-Spotlight-action", has_text="Hover").click()
    page.wait_for_function(
        "() => document.querySelector('[data-explorer=speed]').innerText === 'hover'"
    )
    page.locator("[class*=Spotlight-overlay]").wait_for(state="detached")
    watched.answered()
    page.keyboard.press("k")
    page.wait_for_function(
        "() => document.querySelector('[data-explorer=speed]').innerText.includes('191 km/h')"
    )
