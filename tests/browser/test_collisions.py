"""In every mode and state, at five sizes: no two words, nor a word and a mark, that overlap, none cut, nothing behind
anything; and the scene is framed anew whenever its room changes."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser
from watched import WAIT, Watched, opened

from explorer.app import App

pytestmark = pytest.mark.slow

COLLIDE, FRAME = (
    (Path(__file__).parent / name).read_text(encoding="utf-8")
    for name in ("collisions.js", "framing.js")
)
WINDOWS = {"desk": [(1500, 940), (1280, 720)], "sheet": [(812, 734), (390, 844), (844, 390)]}
"""Sizes of one page: in each state it is drawn out, or turned as a telephone is. One with a sheet opens with it."""
CAMERA = "() => [RX.covered, window.__viserMutable.camera.position.toArray().map(x => Math.round(10 * x))]"
FAR = 3
"""[dm] between a camera that has followed its room and one that is aimed anew; it stands 300 dm away."""
States = Iterator[tuple[str, str]]
"""Name of a state that the page is in now, and the view of its scene; empty: the scene is not looked at."""


def send(watched: Watched, *message: Any) -> None:
    watched.page.evaluate("message => RX.send(...message)", list(message))


def found(watched: Watched, view: str) -> list[str]:
    """What is wrong in this state."""
    # Where it pressed last it would bring the hint of what stands there now.
    watched.page.mouse.move(1, 1)
    look = f"view => [...({COLLIDE})(), ...(view && ({FRAME})(view))]"
    covered, stands = watched.at_rest(lambda: watched.page.evaluate(CAMERA))
    faults = watched.page.evaluate(look, view) and watched.at_rest(
        lambda: watched.page.evaluate(look, view)
    )
    if view:
        send(watched, "aim")
        now_covered, framed = watched.at_rest(lambda: watched.page.evaluate(CAMERA))
        far = max(abs(now - then) for now, then in zip(framed, stands, strict=True)) > FAR
        if far and now_covered == covered:  # The notice of a search grows with its words.
            faults.append(
                f"{view} is not framed anew: the camera stood at {stands} dm, an aim puts it at {framed} dm"
            )
    return faults


def explore(watched: Watched) -> States:
    page = watched.page
    watched.answered(wholly=True)
    yield "at rest", "3d"
    for drawer in ("open", "share", "details", "probe", "trust", "lecture", "settings"):
        watched.drawer(drawer)
        yield drawer, "3d"
    send(watched, "drawer", "")
    yield "drawer closed", "3d"
    for view in ("blade", "side"):
        send(watched, "view", view)
        yield view, view
    send(watched, "view", "disk")
    page.wait_for_function("() => RX.state.plan?.values")
    yield "disk", ""
    send(watched, "view", "3d")
    send(watched, "pin")
    page.wait_for_function("() => RX.state.bar.pinned")
    watched.type("Δ outboard", 8.0)
    send(watched, "difference", "on")
    yield "B less A", "3d"
    send(watched, "region", "wipe")
    yield "A beside B", "3d"
    send(watched, "region", "wipe")
    send(watched, "view", "disk")
    page.wait_for_function("() => RX.state.plan?.values")
    yield "disk of B", ""
    watched.reset()
    send(watched, "view", "3d")
    page.evaluate("() => document.activeElement?.blur()")
    page.keyboard.press("g")
    page.wait_for_function("() => RX.state.twisting")
    watched.drawn()  # Keys are heard from the frame on that shows it.
    for times, name in ((2, "tip held"), (9, "tip far from the least")):
        for _ in range(times):
            page.keyboard.press("Shift+ArrowUp")
            watched.answered()
        page.wait_for_function("() => RX.state.hand?.best")
        yield name, ""
    page.keyboard.press("Escape")
    page.wait_for_function(
        "() => !RX.state.twisting && !document.documentElement.hasAttribute('data-twisting')"
    )
    yield "let go", "3d"


def optimise(watched: Watched) -> States:
    page = watched.page
    watched.mode("optimise")
    yield "before a search", "3d"
    watched.choose("Concept", "Three segments, free break points")
    begin = page.locator("[data-dock-region=right]").get_by_role(
        "button", name="Optimise", exact=True
    )
    begin.click()
    page.locator("[data-explorer=notice]").wait_for(state="visible")
    yield "while it searches", "3d"
    # It is left to end by itself: one that is stopped at its first design has nothing to preview.
    page.wait_for_function("() => RX.state.notice?.text.startsWith('Previewing')", timeout=4 * WAIT)
    yield "after it", "3d"
    page.locator("[data-part=notice] [data-do=discard]").click()
    watched.section("Map")
    page.get_by_role("button", name="Compute map").click()
    watched.reads("map-least", r"Least [\d\s.]+ kW at")
    yield "map", "3d"
    watched.section("Schedule")
    yield "schedule", "3d"


def actuate(watched: Watched) -> States:
    page = watched.page
    watched.mode("actuate")
    page.wait_for_function("() => RX.state.earns?.kind === 'ready'", timeout=4 * WAIT)
    page.wait_for_function("() => RX.state.dial_matrix", timeout=4 * WAIT)
    watched.answered(wholly=True)
    yield "at rest", "actuator"
    watched.drawer("trust")
    yield "drawer", "actuator"
    send(watched, "drawer", "")
    yield "drawer closed", "actuator"
    for leg in (1, 3):
        send(watched, "fly", leg)
        page.wait_for_function("() => RX.state.earns?.kind === 'ready'", timeout=4 * WAIT)
        yield f"flown, leg {leg}", "actuator"
    watched.type("Voltage", 77)
    watched.answered(wholly=True)
    yield "driven", "actuator"
    send(watched, "suppose", "on")
    page.wait_for_function("() => RX.state.suppose?.chart", timeout=4 * WAIT)
    yield "what would pay", "actuator"
    send(watched, "suppose", "off")
    page.get_by_text("Twist at n/rev", exact=True).dispatch_event("click")
    enlarge = page.locator("[data-dial-large]").first
    enlarge.evaluate("button => button.click()")
    page.wait_for_function("() => document.documentElement.dataset.enlarged")
    yield "dial enlarged", ""
    page.keyboard.press("Escape")
    for view in ("3d", "disk", "blade", "side"):
        send(watched, "view", view)
        yield view, view if view != "disk" else ""


def lecture(watched: Watched) -> States:
    page = watched.page
    watched.drawer("lecture")
    page.get_by_role("button", name="Start the lecture").click()
    for step in (1, 2):
        page.wait_for_selector(f'[data-explorer="lecture"][data-step="{step}"]')
        page.wait_for_function(
            "k => RX.state.steps[k].control.words.length > 0", arg=step - 1, timeout=4 * WAIT
        )
        yield f"step {step}", ""
        page.locator(f'.rxs-list > [data-step="{step}"] .rxs-guess button').first.click()
        page.wait_for_function("() => RX.state.lecture.answer")
        yield f"step {step}, answered", ""
        page.get_by_role("button", name="Next", exact=True).click()
    page.get_by_role("button", name="End", exact=True).click()
    page.wait_for_selector('[data-explorer="lecture"]', state="hidden")
    yield "ended", "3d"


@pytest.fixture(scope="module", params=WINDOWS)
def sized(
    request: pytest.FixtureRequest, browser: Browser, app: App
) -> Iterator[tuple[Watched, list[tuple[int, int]]]]:
    """A page for all modes, and its sizes: to bring about a state takes far longer than to look at it."""
    sizes = WINDOWS[request.param]
    watched = opened(browser, app.address, size=sizes[0])
    watched.quiet()
    yield watched, sizes
    watched.close()


@pytest.mark.parametrize(
    "states", [explore, optimise, actuate, lecture], ids=lambda states: states.__name__
)
def test_nothing_collides(
    sized: tuple[Watched, list[tuple[int, int]]], states: Callable[[Watched], States]
):
    watched, sizes = sized
    watched.reset()
    send(watched, "view", "3d")
    wrong = {}
    for state, view in states(watched):
        for wide, high in sizes:
            watched.page.set_viewport_size({"width": wide, "height": high})
            if faults := found(watched, view):
                wrong[f"{state}, {wide} × {high}"] = faults
        sizes = sizes[::-1]  # The next state begins at the size at which this one ends.
    assert wrong == {}
    assert watched.complaints == []
